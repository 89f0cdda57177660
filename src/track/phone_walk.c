/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_walk.h"

#include <stddef.h>

#include "insole/move/heading.h"
#include "insole/sense/carry_table.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

const insole_phone_walk_config_t insole_phone_walk_defaults = {
    INSOLE_PHONE_WALK_KEYS(INSOLE_CONFIG_DEFAULT){INSOLE_STEP_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_STEP_LENGTH_KEYS(INSOLE_CONFIG_DEFAULT)}};

enum { FACES_ANY = 1, FACES_CARRIED = 2 };

/* A peak without one before it has no duration yet. */
static const uint64_t LONGEST_STEP_US = 1000000u;

/* Time constant of how a phone lies, over the swing of a leg. */
static const insole_real_t LIE_S = INSOLE_R(1.0);

/* A direction of the gait so far from the mean is its other end. */
static const insole_real_t OTHER_END_RAD = INSOLE_R(2.0);

static const insole_turn_t nothing = {ZERO, ZERO};

static insole_status_t check_own(const insole_phone_walk_config_t *config)
{
    typedef insole_phone_walk_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_PHONE_WALK_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_phone_walk_check(const insole_phone_walk_config_t *config)
{
    if (!config) {
        return INSOLE_ERR_NULL;
    }
    bool all = check_own(config) == INSOLE_OK && insole_step_check(&config->step) == INSOLE_OK &&
               insole_step_length_check(&config->step_length) == INSOLE_OK;
    return all ? INSOLE_OK : INSOLE_ERR_VALUE;
}

insole_status_t insole_phone_walk_init(insole_phone_walk_t *walk,
                                       const insole_phone_walk_config_t *config,
                                       const insole_phone_gait_t *gait)
{
    if (!walk) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_phone_walk_check(config);
    if (status != INSOLE_OK) {
        return status;
    }
    if (gait && gait->forest && insole_carry_forest_check(gait->forest) != INSOLE_OK) {
        return INSOLE_ERR_DATA;
    }
    *walk = (insole_phone_walk_t){.config = *config};
    if (gait) {
        walk->gait = *gait;
    }
    (void)insole_step_init(&walk->steps, &config->step);
    return insole_phone_way_init(&walk->way);
}

/* ---- how the phone is carried ----------------------------------------------------------- */

int32_t insole_phone_walk_position(const insole_phone_walk_t *walk)
{
    bool knows = walk->gait.carry && walk->gait.forest;
    return knows ? walk->gait.carry->told : INSOLE_CARRY_NONE;
}

static bool goes_by_gait(const insole_phone_walk_t *w)
{
    int32_t position = insole_phone_walk_position(w);
    bool is_aside = position >= 0 && position != w->config.ahead_position;
    return w->gait.heading &&
           (w->config.faces == FACES_ANY || (w->config.faces == FACES_CARRIED && is_aside));
}

/* That of the position where it is asked and has one; else 1. */
static insole_real_t of_position(const insole_phone_walk_t *w, insole_real_t ear,
                                 insole_real_t swing, insole_real_t pocket)
{
    int32_t position =
        w->config.faces == FACES_CARRIED ? insole_phone_walk_position(w) : INSOLE_CARRY_NONE;
    switch (position) {
    case INSOLE_CARRY_EAR:
        return ear;
    case INSOLE_CARRY_SWING:
        return swing;
    case INSOLE_CARRY_POCKET:
        return pocket;
    default:
        return ONE;
    }
}

static void follow_position(insole_phone_walk_t *w)
{
    const insole_phone_walk_config_t *c = &w->config;
    insole_real_t times = of_position(w, c->rise_ear, c->rise_swing, c->rise_pocket);
    w->steps.config.rise_share = insole_min(times * c->step.rise_share, ONE);
}

static void forget_askew(insole_phone_walk_t *w)
{
    w->askew.sum = nothing;
    w->askew.up = w->up;
}

bool insole_phone_walk_work(insole_phone_walk_t *walk)
{
    insole_carry_news_t news;
    if (!walk || !walk->gait.carry || !walk->gait.forest) {
        return false;
    }
    int32_t before = walk->gait.carry->told;
    if (insole_carry_next(walk->gait.carry, walk->gait.forest, &news) != INSOLE_OK) {
        return false;
    }
    if (news.told != before) {
        forget_askew(walk);
        follow_position(walk);
    }
    return true;
}

/* A phone that is tipped over is carried in another way. */
static void watch_lie(insole_phone_walk_t *w, insole_quat_t q, insole_real_t dt_s)
{
    insole_mat3_t C = insole_quat_to_mat3(q);
    insole_vec3_t up = C.r2; /* what is up in n, seen from b */
    insole_real_t share = dt_s / (LIE_S + dt_s);
    insole_vec3_t mean =
        insole_vec3_add(w->up, insole_vec3_scale(insole_vec3_sub(up, w->up), share));
    insole_real_t length = insole_vec3_norm(mean);
    w->up = length > INSOLE_R(0.1) ? insole_vec3_scale(mean, ONE / length) : up;
    bool is_first = !(insole_vec3_max_abs(w->askew.up) > ZERO);
    if (is_first || insole_vec3_dot(w->up, w->askew.up) < insole_cos(w->config.tipped_rad)) {
        forget_askew(w);
    }
}

/* ---- directions ------------------------------------------------------------------------- */

/* Takes what one step says; the variance of it weighs. */
static void learn_askew(insole_phone_walk_t *w, insole_real_t device_rad,
                        const insole_walked_t *walked)
{
    insole_turn_t *sum = &w->askew.sum;
    insole_real_t askew_rad = walked->direction_rad - device_rad;
    bool is_first = !(insole_abs(sum->cos) + insole_abs(sum->sin) > ZERO);
    insole_real_t mean_rad = is_first ? askew_rad : insole_atan2(sum->sin, sum->cos);
    if (insole_abs(insole_wrap_pi(askew_rad - mean_rad)) > OTHER_END_RAD) {
        if (!walked->is_certain) {
            return;
        }
        *sum = nothing;
    }
    insole_real_t weight = ONE / (walked->variance_rad2 + INSOLE_R(1.0e-3));
    insole_turn_t turn = insole_turn(askew_rad);
    sum->cos = w->config.gait_keep * sum->cos + weight * turn.cos;
    sum->sin = w->config.gait_keep * sum->sin + weight * turn.sin;
}

static insole_real_t askew_variance(const insole_phone_walk_t *w)
{
    const insole_turn_t *sum = &w->askew.sum;
    insole_real_t information = insole_sqrt(sum->cos * sum->cos + sum->sin * sum->sin);
    insole_real_t floor_rad2 = insole_square(w->config.sigma_gait_rad);
    return information > ZERO ? insole_min(floor_rad2 + ONE / information, INSOLE_HEADING_MOST_R2)
                              : INSOLE_HEADING_MOST_R2;
}

bool insole_phone_walk_is_directed(const insole_phone_walk_t *walk)
{
    const insole_turn_t *sum = &walk->askew.sum;
    return !goes_by_gait(walk) || insole_abs(sum->cos) + insole_abs(sum->sin) > ZERO;
}

static insole_real_t askew(const insole_phone_walk_t *w)
{
    return insole_atan2(w->askew.sum.sin, w->askew.sum.cos);
}

/* Length, and the direction in which the phone points, or its mean askew from it. */
static bool pace_of(const insole_phone_walk_t *w, const insole_footfall_t *footfall,
                    insole_pace_t *pace)
{
    if (insole_step_length(&w->config.step_length, footfall, &pace->length_m) != INSOLE_OK ||
        insole_phone_way_direction(&w->way, footfall, &pace->heading_rad) != INSOLE_OK) {
        return false;
    }
    insole_real_t var_ahead_rad2 = insole_square(w->config.sigma_ahead_rad);
    if (goes_by_gait(w)) {
        pace->heading_rad = insole_wrap_pi(pace->heading_rad + askew(w));
        var_ahead_rad2 = askew_variance(w);
    }
    if (w->config.step_length.model != INSOLE_STEP_LENGTH_CONSTANT) {
        pace->length_m *=
            of_position(w, w->config.length_ear, w->config.length_swing, w->config.length_pocket);
    }
    pace->var_length_m2 = insole_square(w->config.sigma_length_share * pace->length_m);
    pace->var_heading_rad2 = w->yaw_rad2 + var_ahead_rad2;
    return true;
}

/* The gait is asked for every step: it knows its end from those before. */
static void ask_gait(insole_phone_walk_t *w, const insole_footfall_t *footfall, insole_pace_t *pace)
{
    insole_walked_t walked;
    insole_real_t device_rad;
    if (!w->gait.heading ||
        insole_walk_heading_step(w->gait.heading, footfall, &walked) != INSOLE_OK ||
        insole_phone_way_direction(&w->way, footfall, &device_rad) != INSOLE_OK) {
        return;
    }
    learn_askew(w, device_rad, &walked);
    if (!goes_by_gait(w)) {
        return;
    }
    if (w->config.gait == 1) {
        pace->heading_rad = walked.direction_rad; /* [PhoneUKF (38)] */
        pace->var_heading_rad2 = walked.is_certain ? walked.variance_rad2 : INSOLE_HEADING_MOST_R2;
    } else {
        (void)pace_of(w, footfall, pace);
    }
}

insole_turn_t insole_phone_walk_ahead(const insole_phone_walk_t *walk)
{
    insole_turn_t ahead = walk->ahead;
    if (goes_by_gait(walk)) {
        insole_turn_t turn = insole_turn(askew(walk));
        insole_spot_t way = insole_turn_way(turn, insole_spot(ahead.cos, ahead.sin));
        ahead.cos = way.x_m;
        ahead.sin = way.y_m;
    }
    return ahead;
}

/* ---- steps that are shown, not told ----------------------------------------------------- */

/* Their way up to a time. */
static insole_spot_t held_way(const insole_phone_walk_t *w, uint64_t until_us)
{
    insole_spot_t sum = {ZERO, ZERO};
    insole_footfall_t footfall;
    insole_pace_t pace;
    bool shows = w->steps.held >= (uint32_t)w->config.shown_steps;
    for (uint32_t i = 0u; shows && insole_step_held(&w->steps, i, &footfall) == INSOLE_OK; i++) {
        if (footfall.end_us - footfall.begin_us > LONGEST_STEP_US) {
            footfall.begin_us = footfall.end_us - LONGEST_STEP_US;
        }
        if (pace_of(w, &footfall, &pace)) {
            sum = insole_spot_add_scaled(sum, insole_phone_way_share(&footfall, until_us),
                                         insole_pace_way(&pace, ZERO));
        }
    }
    return sum;
}

/* Anew only when peaks have come or gone. */
static void show_held(insole_phone_walk_t *w)
{
    if (w->steps.held != w->shown_count || w->steps.last_us != w->shown_end_us) {
        w->shown = held_way(w, UINT64_MAX);
        w->shown_count = w->steps.held;
        w->shown_end_us = w->steps.last_us;
    }
}

insole_spot_t insole_phone_walk_since(const insole_phone_walk_t *walk, uint64_t t_us)
{
    return insole_spot_sub(insole_phone_way_since(&walk->way, t_us), held_way(walk, t_us));
}

/* ---- samples in, steps out -------------------------------------------------------------- */

static void face(insole_phone_walk_t *w, const insole_attitude_t *attitude, const insole_imu_t *imu)
{
    insole_sym3_t P = insole_attitude_covariance(attitude);
    insole_heading_t heading = insole_heading(attitude->q, &P);
    w->ahead = heading.ahead;
    w->yaw_rad2 = heading.variance_rad2;
    (void)insole_phone_way_face(&w->way, imu->t_us, heading.ahead);
    if (w->gait.heading) {
        insole_real_t dt_s = imu->t_us > w->t_us ? insole_seconds(w->t_us, imu->t_us) : ZERO;
        watch_lie(w, attitude->q, insole_min(dt_s, ONE));
        (void)insole_walk_heading_push(w->gait.heading, attitude->q, &P, imu->accel_mps2,
                                       imu->t_us);
    }
    if (w->gait.carry) {
        (void)insole_carry_push(w->gait.carry, imu->t_us, imu->accel_mps2, &imu->gyro_radps, NULL);
    }
}

insole_status_t insole_phone_walk_push(insole_phone_walk_t *walk, const insole_attitude_t *attitude,
                                       const insole_imu_t *imu)
{
    if (!walk || !attitude || !imu) {
        return INSOLE_ERR_NULL;
    }
    if (attitude->aligned) {
        face(walk, attitude, imu);
    }
    walk->t_us = imu->t_us;
    insole_status_t status = insole_step_push(&walk->steps, imu->t_us, imu->accel_mps2);
    show_held(walk);
    return status;
}

insole_status_t insole_phone_walk_next(insole_phone_walk_t *walk, insole_footfall_t *footfall,
                                       insole_pace_t *pace)
{
    if (!walk || !footfall || !pace) {
        return INSOLE_ERR_NULL;
    }
    while (insole_step_next(&walk->steps, footfall) == INSOLE_OK) {
        if (pace_of(walk, footfall, pace)) {
            ask_gait(walk, footfall, pace);
            (void)insole_phone_way_go(&walk->way, footfall, insole_pace_way(pace, ZERO));
            return INSOLE_OK;
        }
    }
    return INSOLE_ERR_STATE;
}
