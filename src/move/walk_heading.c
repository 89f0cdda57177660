/* SPDX-License-Identifier: MIT */
#include "insole/move/walk_heading.h"

#include <string.h>

#include "insole/move/gait_evidence.h"
#include "insole/move/heading.h"
#include "insole/move/walk_axis.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)
#define HALF INSOLE_R(0.5)
#define TWO  INSOLE_R(2.0)

static const insole_real_t LARGEST_RAD2 = INSOLE_R(100.0);
static const insole_real_t MOST_SPREAD = INSOLE_R(1.0e6); /* and of no end without scatter */
static const insole_real_t UNKNOWN_RAD2 = INSOLE_PI * INSOLE_PI / INSOLE_R(3.0);

const insole_walk_heading_config_t insole_walk_heading_defaults = {
    INSOLE_WALK_HEADING_KEYS(INSOLE_CONFIG_DEFAULT)};

static insole_status_t refuse(insole_walk_heading_t *walk, insole_status_t why)
{
    walk->refused++;
    return why;
}

static insole_status_t check(const insole_walk_heading_config_t *config)
{
    typedef insole_walk_heading_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_WALK_HEADING_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_walk_heading_init(insole_walk_heading_t *walk,
                                         const insole_walk_heading_config_t *config)
{
    if (!walk || !config) {
        return INSOLE_ERR_NULL;
    }
    if (check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(walk, 0, sizeof *walk);
    walk->config = *config;
    return insole_yaw_track_init(&walk->yaw, config->tipped_rad);
}

/* ---- samples ---------------------------------------------------------------------------- */

static bool is_unit(insole_quat_t q)
{
    insole_real_t norm2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    return insole_abs(norm2 - ONE) <= INSOLE_R(0.02);
}

static bool is_variance(insole_real_t v)
{
    return v >= ZERO && v <= LARGEST_RAD2;
}

static bool is_cov(const insole_sym3_t *P)
{
    insole_real_t most =
        insole_vec3_max_abs(insole_vec3(P->xy, P->xz, P->yz)); /* passes over what is none */
    return is_variance(P->xx) && is_variance(P->yy) && is_variance(P->zz) && most <= LARGEST_RAD2 &&
           insole_is_finite(P->xy + P->xz + P->yz);
}

insole_status_t insole_walk_heading_push(insole_walk_heading_t *walk, insole_quat_t q,
                                         const insole_sym3_t *cov_rad2, insole_vec3_t accel_mps2,
                                         uint64_t t_us)
{
    if (!walk || !cov_rad2) {
        return INSOLE_ERR_NULL;
    }
    if (!is_unit(q) || !is_cov(cov_rad2) || !insole_vec3_is_finite(accel_mps2)) {
        return refuse(walk, INSOLE_ERR_VALUE);
    }
    insole_heading_t device = insole_heading(q, cov_rad2);
    insole_vec3_t force_n = insole_quat_rotate(q, accel_mps2); /* [PhoneUKF (20)-(22)] */
    insole_yaw_track_t yaw = walk->yaw;
    bool tipped = insole_yaw_track_push(&yaw, q, t_us);
    bool follows = walk->config.turned_by == 0;
    insole_gait_facing_t facing = {device.heading_rad, follows ? yaw.turned_rad : ZERO};
    insole_status_t status = insole_gait_motion_push(&walk->motion, force_n, &facing, t_us);
    if (status != INSOLE_OK) {
        return refuse(walk, status);
    }
    walk->yaw = yaw;
    if (follows && tipped) {
        memset(&walk->memory, 0, sizeof walk->memory);
    }
    walk->cov_rad2 = *cov_rad2;
    walk->device_var_rad2 = device.variance_rad2;
    return INSOLE_OK;
}

/* ---- methods ---------------------------------------------------------------------------- */

/* What is seen of a step, and of those before it that are looked at with it. */
typedef struct {
    insole_gait_moments_t moments;
    insole_walk_energies_t energies; /* of the scatter */
    insole_sym3_t P;                 /* of the attitude, with what that does not know */
    insole_real_t tilt_rad2;         /* in it, about each axis */
    insole_sym3_t steps_own;         /* scatter in which a sway counts little */
    insole_vec3_t ahead;             /* evidence, and what is up in it */
} seen_t;

/* A method's answer for a step. */
typedef struct {
    insole_walk_axis_t axis;
    insole_real_t spread; /* what is across it over what is along */
    insole_spot_t pull;   /* evidence: longer and along the walk, the better */
} look_t;

static look_t by_axis(const seen_t *seen, const insole_gait_memory_t *memory)
{
    insole_walk_energies_t e = insole_walk_energies(memory->scatter);
    look_t look = {.axis = insole_walk_axis_of(memory->scatter)};
    look.pull = insole_spot(seen->ahead.x, seen->ahead.y);
    look.spread = e.most * e.least / insole_square(e.most - e.least);
    return look;
}

/* Paper, 2 and 7.2: at one moment of the step the forward acceleration dominates. */
static look_t by_moment(const seen_t *seen)
{
    insole_vec3_t way = seen->moments.falling_mps2;
    look_t look = {.axis = insole_walk_axis_along(way)};
    look.spread = seen->energies.least / insole_square(insole_vec3_level(way));
    insole_real_t per = ONE / insole_sqrt(TWO * seen->energies.most);
    insole_real_t feigned = seen->tilt_rad2 * seen->moments.scatter.zz;
    per *= seen->energies.most / (seen->energies.most + feigned);
    look.pull = insole_spot(per * way.x, per * way.y);
    return look;
}

static look_t by_gait(const seen_t *seen)
{
    look_t look = {.axis = insole_walk_axis_along(seen->ahead)};
    look.pull = insole_spot(seen->ahead.x, seen->ahead.y);
    insole_real_t ratio = seen->energies.least / seen->energies.most;
    look.spread = ratio / insole_spot_dot(look.pull, look.pull);
    return look;
}

static look_t look_by(int32_t method, const seen_t *seen, const insole_gait_memory_t *memory)
{
    if (method == INSOLE_WALK_HEADING_UDIRECT) {
        return by_moment(seen);
    }
    return method == INSOLE_WALK_HEADING_GAIT ? by_gait(seen) : by_axis(seen, memory);
}

/* ---- steps ------------------------------------------------------------------------------ */

static insole_walk_heading_row_t joined(insole_walk_heading_row_t row,
                                        const insole_footfall_t *footfall)
{
    bool follows = row.count > 0u && row.end_us == footfall->begin_us;
    row.count = follows ? row.count : 0u;
    for (uint32_t i = INSOLE_WALK_HEADING_STEPS - 1u; i > 0u; i--) {
        row.begins_us[i] = row.begins_us[i - 1u];
    }
    row.begins_us[0] = footfall->begin_us;
    row.end_us = footfall->end_us;
    row.count += row.count < INSOLE_WALK_HEADING_STEPS ? 1u : 0u;
    return row;
}

/* The newest steps, as many as shall be looked at and are still remembered. */
static insole_gait_window_t window_of(const insole_walk_heading_t *walk,
                                      const insole_walk_heading_row_t *row)
{
    const insole_walk_heading_config_t *c = &walk->config;
    uint32_t steps = c->method == INSOLE_WALK_HEADING_UDIRECT ? 1u : (uint32_t)c->steps;
    steps = steps < row->count ? steps : row->count;
    while (steps > 1u && !insole_gait_motion_reaches(&walk->motion, row->begins_us[steps - 1u])) {
        steps--;
    }
    insole_gait_window_t window = {row->begins_us[steps - 1u], row->end_us, steps};
    return window;
}

/* Gathers evidence, then takes the end of the axis that it is for. */
static void choose_end(insole_walk_heading_t *walk, insole_real_t rad, insole_spot_t pull,
                       insole_walked_t *walked)
{
    walk->memory.pull = insole_spot_add(walk->memory.pull, pull);
    insole_turn_t turn = insole_turn(rad);
    insole_real_t evidence = insole_spot_dot(walk->memory.pull, insole_spot(turn.cos, turn.sin));
    rad += evidence < ZERO ? INSOLE_PI : ZERO;
    walked->direction_rad = insole_wrap_pi(rad); /* [PhoneUKF (31)] */
    walked->evidence = insole_abs(evidence);
    walked->is_certain = walked->evidence >= walk->config.certain_evidence;
}

/* What the attitude does not know of its tilt is added; what is levelled by the mean force has none
 * of its tilt. */
static insole_sym3_t cov_of(const insole_walk_heading_t *walk)
{
    insole_real_t tilt_rad2 = insole_square(walk->config.sigma_tilt_rad);
    insole_sym3_t tilt = insole_sym3_diagonal(tilt_rad2, tilt_rad2, ZERO);
    insole_sym3_t upright = insole_sym3_diagonal(ZERO, ZERO, walk->cov_rad2.zz);
    return insole_sym3_add(walk->config.level == 1 ? upright : walk->cov_rad2, tilt);
}

/* From one walk to the next. */
static insole_real_t pause_before(const insole_walk_heading_t *walk,
                                  const insole_walk_heading_row_t *row)
{
    bool paused = row->count == 1u && walk->row.count > 0u && row->begins_us[0] > walk->row.end_us;
    return paused ? insole_seconds(walk->row.end_us, row->begins_us[0]) : ZERO;
}

static void fade(insole_walk_heading_t *walk, insole_real_t facing_rad, insole_real_t pause_s)
{
    const insole_walk_heading_config_t *c = &walk->config;
    insole_real_t faded = insole_exp(-pause_s / c->forget_s);
    insole_gait_memory_fade(&walk->memory, facing_rad, faded * c->axis_keep, faded * c->keep_share);
}

static void see(insole_walk_heading_t *walk, seen_t *seen)
{
    const insole_walk_heading_config_t *c = &walk->config;
    if (c->level == 1) {
        insole_gait_memory_level(&walk->memory, &seen->moments);
    }
    seen->P = cov_of(walk);
    seen->tilt_rad2 = HALF * (seen->P.xx + seen->P.yy);
    seen->energies = insole_walk_energies(seen->moments.scatter);
    seen->steps_own = insole_gait_ahead_scatter(&seen->moments, c->sway_weight);
    seen->ahead = insole_gait_ahead(&seen->moments, c->lead_rad, seen->tilt_rad2);
}

/* Steps that were looked at together share what they moved: so much of their number is not new. */
static insole_real_t share_of_one(const insole_walk_heading_t *walk)
{
    insole_real_t together = insole_min((insole_real_t)walk->config.steps, walk->memory.steps);
    bool is_mean = walk->config.method == INSOLE_WALK_HEADING_RMPCA;
    return is_mean ? together / walk->memory.steps : ONE;
}

/* Beside that of the attitude. */
static insole_real_t variance_of(const insole_walk_heading_t *walk, const seen_t *seen,
                                 insole_real_t spread)
{
    const insole_walk_heading_config_t *c = &walk->config;
    insole_real_t per = share_of_one(walk);
    return insole_square(c->sigma_rad) + insole_square(c->turn_share * seen->moments.turned_rad) +
           per * c->wander_share * insole_gait_memory_wander(&walk->memory) +
           per * c->scatter_share * insole_min(spread, MOST_SPREAD);
}

static void find_direction(insole_walk_heading_t *walk, const seen_t *seen, insole_walked_t *walked)
{
    bool is_mean = walk->config.method == INSOLE_WALK_HEADING_RMPCA;
    insole_gait_memory_add(&walk->memory, seen->steps_own);
    look_t look = look_by(walk->config.method, seen, &walk->memory);
    insole_real_t alone_rad = is_mean ? insole_walk_axis_of(seen->steps_own).rad : look.axis.rad;
    insole_gait_memory_note(&walk->memory, alone_rad, walk->config.keep_share);
    insole_real_t off_rad, variance_rad2; /* of the small angle, [PhoneUKF (19)] */
    insole_walk_axis_through(&look.axis, seen->P, &off_rad, &variance_rad2);
    choose_end(walk, look.axis.rad + off_rad, look.pull, walked);
    walked->variance_rad2 = variance_rad2 + variance_of(walk, seen, look.spread);
}

static void find_device(const insole_walk_heading_t *walk, const seen_t *seen,
                        insole_walked_t *walked)
{
    walked->direction_rad = seen->moments.device_rad;
    walked->variance_rad2 = walk->device_var_rad2;
    walked->evidence = ZERO;
    walked->is_certain = true;
}

static void answer(insole_walk_heading_t *walk, const seen_t *seen, insole_walked_t *walked)
{
    walked->t_us = walk->row.end_us;
    walked->rms_mps2 = insole_sqrt(seen->energies.most);
    walked->ratio = seen->energies.least / seen->energies.most;
    if (walk->config.method == INSOLE_WALK_HEADING_DEVICE) {
        find_device(walk, seen, walked);
    } else {
        find_direction(walk, seen, walked);
    }
    walked->variance_rad2 = insole_min(walked->variance_rad2, UNKNOWN_RAD2);
}

insole_status_t insole_walk_heading_step(insole_walk_heading_t *walk,
                                         const insole_footfall_t *footfall, insole_walked_t *walked)
{
    if (!walk || !footfall || !walked) {
        return INSOLE_ERR_NULL;
    }
    if (footfall->begin_us >= footfall->end_us ||
        (walk->row.count > 0u && footfall->end_us <= walk->row.end_us)) {
        return refuse(walk, INSOLE_ERR_TIME);
    }
    insole_walk_heading_row_t row = joined(walk->row, footfall);
    insole_gait_window_t window = window_of(walk, &row);
    seen_t seen;
    insole_status_t status = insole_gait_motion_look(&walk->motion, &window, &seen.moments);
    if (status != INSOLE_OK) {
        return refuse(walk, status);
    }
    if (!(insole_walk_energies(seen.moments.scatter).most >=
          insole_square(walk->config.least_mps2))) {
        return refuse(walk, INSOLE_ERR_STATE);
    }
    fade(walk, seen.moments.facing_rad, pause_before(walk, &row));
    see(walk, &seen);
    walk->row = row;
    answer(walk, &seen, walked);
    return INSOLE_OK;
}
