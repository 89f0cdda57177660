/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_walk.h"

#include <stddef.h>

#include "insole/move/heading.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

const insole_phone_walk_config_t insole_phone_walk_defaults = {
    INSOLE_PHONE_WALK_KEYS(INSOLE_CONFIG_DEFAULT){INSOLE_STEP_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_STEP_LENGTH_KEYS(INSOLE_CONFIG_DEFAULT)}};

/* A peak without one before it has no duration yet. */
static const uint64_t LONGEST_STEP_US = 1000000u;

static const insole_phone_lie_t ahead = {
    .askew = {ONE, ZERO}, .position = INSOLE_PHONE_NO_POSITION, .length = ONE, .rise = ONE};

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

INSOLE_COLD insole_status_t insole_phone_walk_init(insole_phone_walk_t *walk,
                                                   const insole_phone_walk_config_t *config,
                                                   const insole_phone_guide_t *guide)
{
    if (!walk) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_phone_walk_check(config);
    if (status != INSOLE_OK) {
        return status;
    }
    *walk = (insole_phone_walk_t){.config = *config, .lie = ahead};
    (void)insole_step_init(&walk->steps, &config->step);
    (void)insole_phone_way_init(&walk->way);
    if (guide && guide->calls) {
        walk->guide = *guide;
        guide->calls->begin(guide->state, walk);
    }
    return INSOLE_OK;
}

/* ---- how the phone lies ----------------------------------------------------------------- */

INSOLE_COLD bool insole_phone_walk_work(insole_phone_walk_t *walk)
{
    if (!walk || !walk->guide.calls || !walk->guide.calls->work(walk->guide.state, walk)) {
        return false;
    }
    walk->steps.config.rise_share = insole_min(walk->lie.rise * walk->config.step.rise_share, ONE);
    return true;
}

bool insole_phone_walk_is_directed(const insole_phone_walk_t *walk)
{
    return !walk->lie.is_askew || walk->lie.is_known;
}

/* Length, and the direction in which the phone points, or its mean askew from it. */
INSOLE_COLD static bool pace_of(const insole_phone_walk_t *w, const insole_footfall_t *footfall,
                                insole_pace_t *pace)
{
    if (insole_step_length(&w->config.step_length, footfall, &pace->length_m) != INSOLE_OK ||
        insole_phone_way_direction(&w->way, footfall, &pace->heading_rad) != INSOLE_OK) {
        return false;
    }
    insole_real_t var_ahead_rad2 = insole_square(w->config.sigma_ahead_rad);
    if (w->lie.is_askew) {
        pace->heading_rad = insole_wrap_pi(pace->heading_rad + w->lie.askew_rad);
        var_ahead_rad2 = w->lie.var_rad2;
    }
    if (w->config.step_length.model != INSOLE_STEP_LENGTH_CONSTANT) {
        pace->length_m *= w->lie.length;
    }
    pace->var_length_m2 = insole_square(w->config.sigma_length_share * pace->length_m);
    pace->var_heading_rad2 = w->yaw_rad2 + var_ahead_rad2;
    return true;
}

/* The guide is asked for every step: the gait knows its end from those before. */
static void ask_guide(insole_phone_walk_t *w, const insole_footfall_t *footfall,
                      insole_pace_t *pace)
{
    const insole_phone_guide_t *guide = &w->guide;
    if (guide->calls && !guide->calls->step(guide->state, w, footfall, pace)) {
        (void)pace_of(w, footfall, pace);
    }
}

insole_turn_t insole_phone_walk_ahead(const insole_phone_walk_t *walk)
{
    insole_turn_t turn = walk->ahead;
    if (walk->lie.is_askew) {
        insole_spot_t way = insole_turn_way(walk->lie.askew, insole_spot(turn.cos, turn.sin));
        turn.cos = way.x_m;
        turn.sin = way.y_m;
    }
    return turn;
}

/* ---- steps that are shown, not told ----------------------------------------------------- */

/* Their way up to a time. */
INSOLE_COLD static insole_spot_t held_way(const insole_phone_walk_t *w, uint64_t until_us)
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

INSOLE_COLD insole_spot_t insole_phone_walk_since(const insole_phone_walk_t *walk, uint64_t t_us)
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
    if (w->guide.calls) {
        w->guide.calls->push(w->guide.state, w, attitude, imu);
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
            ask_guide(walk, footfall, pace);
            (void)insole_phone_way_go(&walk->way, footfall, insole_pace_way(pace, ZERO));
            return INSOLE_OK;
        }
    }
    return INSOLE_ERR_STATE;
}
