/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_gait.h"

#include <stddef.h>

#include "insole/move/heading.h"
#include "insole/sense/carry_table.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)
#define HALF INSOLE_R(0.5)

enum { FACES_ANY = 1, FACES_CARRIED = 2 };

/* Time constant of how a phone lies, over the swing of a leg. */
static const insole_real_t LIE_S = INSOLE_R(1.0);

/* A direction of the gait so far from the mean is its other end. */
static const insole_real_t OTHER_END_RAD = INSOLE_R(2.0);

static const insole_turn_t nothing = {ZERO, ZERO};

const insole_phone_gait_config_t insole_phone_gait_defaults = {
    INSOLE_PHONE_GAIT_KEYS(INSOLE_CONFIG_DEFAULT)};

insole_status_t insole_phone_gait_check(const insole_phone_gait_config_t *config)
{
    typedef insole_phone_gait_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_PHONE_GAIT_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_phone_gait_init(insole_phone_gait_t *gait,
                                       const insole_phone_gait_config_t *config,
                                       insole_walk_heading_t *heading, insole_carry_t *carry,
                                       const insole_carry_forest_t *forest)
{
    if (!gait) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_phone_gait_check(config);
    if (status != INSOLE_OK) {
        return status;
    }
    if (forest && insole_carry_forest_check(forest) != INSOLE_OK) {
        return INSOLE_ERR_DATA;
    }
    *gait = (insole_phone_gait_t){
        .config = *config, .heading = heading, .carry = carry, .forest = forest};
    return INSOLE_OK;
}

/* ---- how the phone is carried ----------------------------------------------------------- */

static insole_real_t variance_of(const insole_turn_t *sum, insole_real_t floor_rad)
{
    insole_real_t information = insole_sqrt(sum->cos * sum->cos + sum->sin * sum->sin);
    insole_real_t most_rad2 = INSOLE_HEADING_MOST_R2;
    return information > ZERO ? insole_min(insole_square(floor_rad) + ONE / information, most_rad2)
                              : most_rad2;
}

static void tell_askew(const insole_phone_gait_t *g, insole_phone_walk_t *walk)
{
    const insole_turn_t *sum = &g->askew.sum;
    insole_phone_lie_t *lie = &walk->lie;
    lie->is_known = insole_abs(sum->cos) + insole_abs(sum->sin) > ZERO;
    lie->askew_rad = insole_atan2(sum->sin, sum->cos);
    lie->askew = insole_turn(lie->askew_rad);
    lie->var_rad2 = variance_of(sum, g->config.sigma_gait_rad);
}

/* That of the position where it is asked and has one; else 1. */
static insole_real_t of_position(int32_t position, insole_real_t ear, insole_real_t swing,
                                 insole_real_t pocket)
{
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

static void tell_position(const insole_phone_gait_t *g, insole_phone_walk_t *walk)
{
    const insole_phone_gait_config_t *c = &g->config;
    insole_phone_lie_t *lie = &walk->lie;
    lie->position = g->carry && g->forest ? g->carry->told : INSOLE_CARRY_NONE;
    bool is_asked = c->faces == FACES_CARRIED;
    bool is_known = is_asked && lie->position >= 0;
    bool is_ahead = is_known && lie->position == c->ahead_position;
    lie->is_aside = is_ahead && g->askew.is_aside;
    lie->is_askew =
        g->heading && (c->faces == FACES_ANY || lie->is_aside || (is_known && !is_ahead));
    int32_t position = is_asked ? lie->position : INSOLE_CARRY_NONE;
    lie->length = of_position(position, c->length_ear, c->length_swing, c->length_pocket);
    lie->rise = of_position(position, c->rise_ear, c->rise_swing, c->rise_pocket);
}

static void forget_askew(insole_phone_gait_t *g, insole_phone_walk_t *walk)
{
    g->askew = (insole_phone_askew_t){.sum = nothing, .up = g->up};
    walk->lie.is_ahead = false;
    tell_askew(g, walk);
    tell_position(g, walk);
}

static void gait_begin(void *state, insole_phone_walk_t *walk)
{
    insole_phone_gait_t *g = state;
    g->up = insole_vec3_zero();
    forget_askew(g, walk);
}

static bool gait_work(void *state, insole_phone_walk_t *walk)
{
    insole_phone_gait_t *g = state;
    insole_carry_news_t news;
    if (!g->carry || !g->forest) {
        return false;
    }
    int32_t before = g->carry->told;
    if (insole_carry_next(g->carry, g->forest, &news) != INSOLE_OK) {
        return false;
    }
    if (news.told != before) {
        forget_askew(g, walk);
    }
    return true;
}

/* ---- samples ---------------------------------------------------------------------------- */

/* A phone that is tipped over is carried in another way. */
static void watch_lie(insole_phone_gait_t *g, insole_phone_walk_t *walk, insole_quat_t q,
                      insole_real_t dt_s)
{
    insole_mat3_t C = insole_quat_to_mat3(q);
    insole_vec3_t up = C.r2; /* what is up in n, seen from b */
    insole_real_t share = dt_s / (LIE_S + dt_s);
    insole_vec3_t mean =
        insole_vec3_add(g->up, insole_vec3_scale(insole_vec3_sub(up, g->up), share));
    insole_real_t length = insole_vec3_norm(mean);
    g->up = length > INSOLE_R(0.1) ? insole_vec3_scale(mean, ONE / length) : up;
    bool is_first = !(insole_vec3_max_abs(g->askew.up) > ZERO);
    if (is_first || insole_vec3_dot(g->up, g->askew.up) < insole_cos(g->config.tipped_rad)) {
        forget_askew(g, walk);
    }
}

static void gait_push(void *state, insole_phone_walk_t *walk, const insole_attitude_t *attitude,
                      const insole_imu_t *imu)
{
    insole_phone_gait_t *g = state;
    if (g->heading) {
        insole_sym3_t P = insole_attitude_covariance(attitude);
        insole_real_t dt_s = imu->t_us > walk->t_us ? insole_seconds(walk->t_us, imu->t_us) : ZERO;
        watch_lie(g, walk, attitude->q, insole_min(dt_s, ONE));
        (void)insole_walk_heading_push(g->heading, attitude->q, &P, imu->accel_mps2, imu->t_us);
    }
    if (g->carry) {
        (void)insole_carry_push(g->carry, imu->t_us, imu->accel_mps2, &imu->gyro_radps, NULL);
    }
}

/* ---- steps ------------------------------------------------------------------------------ */

/* Many steps and a certain end are asked: real hands that point ahead are never judged aside. */
static void judge_aside(insole_phone_gait_t *g, insole_phone_walk_t *walk, bool is_certain)
{
    const insole_phone_gait_config_t *c = &g->config;
    insole_real_t off_rad = insole_abs(walk->lie.askew_rad);
    bool was_aside = g->askew.is_aside;
    bool is_aside =
        is_certain && off_rad > c->aside_rad && g->askew.steps >= (uint32_t)c->aside_steps;
    bool is_near = off_rad < HALF * c->aside_rad;
    g->askew.is_aside = was_aside ? !is_near : is_aside;
    walk->lie.is_ahead = is_certain && is_near && g->askew.steps >= (uint32_t)c->aside_steps;
    if (g->askew.is_aside != was_aside) {
        tell_position(g, walk);
    }
}

/* Takes what one step says; the variance of it weighs. */
static void learn_askew(insole_phone_gait_t *g, insole_phone_walk_t *walk, insole_real_t device_rad,
                        const insole_walked_t *walked, uint64_t begin_us)
{
    insole_turn_t *sum = &g->askew.sum;
    insole_real_t askew_rad = walked->direction_rad - device_rad;
    insole_real_t mean_rad = walk->lie.is_known ? walk->lie.askew_rad : askew_rad;
    if (insole_abs(insole_wrap_pi(askew_rad - mean_rad)) > OTHER_END_RAD) {
        if (!walked->is_certain) {
            return;
        }
        *sum = nothing;
        g->askew.steps = 0u;
    }
    insole_real_t weight = ONE / (walked->variance_rad2 + INSOLE_R(1.0e-3));
    insole_turn_t turn = insole_turn(askew_rad);
    sum->cos = g->config.gait_keep * sum->cos + weight * turn.cos;
    sum->sin = g->config.gait_keep * sum->sin + weight * turn.sin;
    walk->lie.since_us = g->askew.steps == 0u ? begin_us : walk->lie.since_us;
    g->askew.steps++;
    tell_askew(g, walk);
    judge_aside(g, walk, walked->is_certain);
}

static bool gait_step(void *state, insole_phone_walk_t *walk, const insole_footfall_t *footfall,
                      insole_pace_t *pace)
{
    insole_phone_gait_t *g = state;
    insole_walked_t walked;
    insole_real_t device_rad;
    if (!g->heading || insole_walk_heading_step(g->heading, footfall, &walked) != INSOLE_OK ||
        insole_phone_way_direction(&walk->way, footfall, &device_rad) != INSOLE_OK) {
        return true;
    }
    learn_askew(g, walk, device_rad, &walked, footfall->begin_us);
    if (walk->lie.is_askew && g->config.gait == 1) {
        pace->heading_rad = walked.direction_rad; /* [PhoneUKF (38)] */
        pace->var_heading_rad2 = walked.is_certain ? walked.variance_rad2 : INSOLE_HEADING_MOST_R2;
        return true;
    }
    return !walk->lie.is_askew;
}

const insole_phone_guide_calls_t insole_phone_gait_calls = {gait_begin, gait_push, gait_step,
                                                            gait_work};
