/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_tracker.h"

#include "insole/base/fastmath.h"

#define ZERO INSOLE_R(0.0)

/* The start's heading is the direction of the first two strides; before they are done, that of
 * the way so far, once it is long enough to have one. */
enum { START_STRIDES = 2 };
static const insole_real_t WAY_WITH_DIRECTION_M = INSOLE_R(0.3);

/* A stride older than this says nothing about the walker's velocity. */
static const uint64_t WALK_MEMORY_US = 1500000u;

/* Share of its length by which a stride of the model may be wrong. */
static const insole_real_t MODEL_ERROR_SHARE = INSOLE_R(0.1);

static const insole_real_t FARTHEST_M = INSOLE_R(1.0e6); /* a start beyond is an error */
static const insole_real_t TURNS_RAD = INSOLE_R(100.0);  /* and so is such a heading */

const insole_foot_tracker_config_t insole_foot_tracker_defaults = {
    INSOLE_FOOT_TRACKER_KEYS(INSOLE_CONFIG_DEFAULT){INSOLE_SCREEN_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_ZERO_VELOCITY_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_ZUPT_EKF_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_STRIDE_KEYS(INSOLE_CONFIG_DEFAULT)}};

static insole_status_t init_parts(insole_foot_tracker_t *t,
                                  const insole_foot_tracker_config_t *config)
{
    insole_status_t status = insole_screen_init(&t->screen, &config->screen);
    if (status == INSOLE_OK) {
        status = insole_still_bias_init(&t->still_bias, &config->still_bias);
    }
    if (status == INSOLE_OK) {
        status = insole_zero_velocity_init(&t->zero_velocity, &config->zero_velocity);
    }
    if (status == INSOLE_OK) {
        status = insole_zupt_ekf_init(&t->zupt_ekf, &config->zupt_ekf);
    }
    if (status == INSOLE_OK) {
        status = insole_stride_init(&t->strides, &config->stride);
    }
    return status;
}

insole_status_t insole_foot_tracker_init(insole_foot_tracker_t *tracker,
                                         const insole_foot_tracker_config_t *config)
{
    if (!tracker || !config) {
        return INSOLE_ERR_NULL;
    }
    if (!(true INSOLE_FOOT_TRACKER_KEYS(INSOLE_CONFIG_IN_RANGE))) {
        return INSOLE_ERR_VALUE;
    }
    static const insole_foot_tracker_t blank;
    *tracker = blank;
    tracker->config = *config;
    return init_parts(tracker, config);
}

static bool is_plausible(const insole_start_t *start)
{
    bool place = insole_abs(start->x_m) <= FARTHEST_M && insole_abs(start->y_m) <= FARTHEST_M &&
                 start->sigma_m >= ZERO && start->sigma_m <= FARTHEST_M;
    bool heading = insole_abs(start->heading_rad) <= TURNS_RAD && start->sigma_rad >= ZERO &&
                   start->sigma_rad <= TURNS_RAD;
    return place && (heading || !start->has_heading);
}

insole_status_t insole_foot_tracker_start(insole_foot_tracker_t *tracker,
                                          const insole_start_t *start)
{
    if (!tracker || !start) {
        return INSOLE_ERR_NULL;
    }
    if (!is_plausible(start)) {
        tracker->counts.refused++;
        return INSOLE_ERR_VALUE;
    }
    tracker->start = *start;
    tracker->has_start = true;
    return INSOLE_OK;
}

/* ---- samples in ------------------------------------------------------------------------- */

static insole_status_t take_clean(insole_foot_tracker_t *t, const insole_clean_t *clean)
{
    (void)insole_still_bias_push(&t->still_bias, &clean->imu);
    return insole_zero_velocity_push(&t->zero_velocity, &clean->imu, clean->marks);
}

insole_status_t insole_foot_tracker_imu(insole_foot_tracker_t *tracker, const insole_imu_t *imu)
{
    if (!tracker || !imu) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = INSOLE_OK;
    if (tracker->finished) {
        status = INSOLE_ERR_STATE;
    } else if (insole_ring_is_full(&tracker->zero_velocity.ring)) {
        status = INSOLE_ERR_ROOM;
    }
    if (status != INSOLE_OK) {
        tracker->counts.refused++;
        return status;
    }
    insole_clean_t clean;
    if (insole_screen_push(&tracker->screen, imu, &clean) == INSOLE_OK) {
        status = take_clean(tracker, &clean);
    }
    return status;
}

insole_status_t insole_foot_tracker_finish(insole_foot_tracker_t *tracker)
{
    if (!tracker) {
        return INSOLE_ERR_NULL;
    }
    insole_clean_t clean;
    if (!tracker->finished && insole_screen_finish(&tracker->screen, &clean) == INSOLE_OK) {
        (void)take_clean(tracker, &clean);
    }
    tracker->finished = true;
    return insole_zero_velocity_finish(&tracker->zero_velocity);
}

/* ---- attitude --------------------------------------------------------------------------- */

/* Sums the present stance; true when it has given all it can: it is long enough, or over. */
static bool stance_is_summed(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    if (!s->still) {
        return t->still_count > 0u;
    }
    if (t->still_count == 0u) {
        t->still_since_us = s->imu.t_us;
        t->still_accel = insole_vec3_zero();
    }
    t->still_accel = insole_vec3_add(t->still_accel, s->imu.accel_mps2);
    t->still_count++;
    insole_real_t lasted_s = (insole_real_t)(s->imu.t_us - t->still_since_us) * INSOLE_R(1.0e-6);
    return lasted_s >= t->config.align_s;
}

static bool align(insole_foot_tracker_t *t, const insole_labelled_t *s, insole_real_t yaw_rad,
                  insole_real_t sigma_tilt_rad)
{
    if (!stance_is_summed(t, s)) {
        return false;
    }
    insole_vec3_t mean =
        insole_vec3_scale(t->still_accel, INSOLE_R(1.0) / (insole_real_t)t->still_count);
    t->still_count = 0u;
    t->zupt_ekf.gravity_mps2 = t->still_bias.gravity_mps2;
    return insole_zupt_ekf_align(&t->zupt_ekf, mean, sigma_tilt_rad, yaw_rad, s->imu.t_us) ==
           INSOLE_OK;
}

/* The first attitude: from a rest as good as it gets, from a stance of a walk as told. */
static void align_first(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    bool rest = s->plain && s->imu.t_us - t->still_since_us > 0u && t->still_bias.rests > 0u;
    insole_real_t tilt = rest ? t->config.zupt_ekf.sigma_tilt_rad : t->config.sigma_moving_tilt_rad;
    if (align(t, s, ZERO, tilt)) {
        t->counts.aligned_moving = !rest;
        t->aligned_us = s->imu.t_us;
    }
}

/* ---- motion ----------------------------------------------------------------------------- */

static void coast(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    bool walking = t->walk_us > 0u && s->imu.t_us - t->walk_us < WALK_MEMORY_US;
    insole_vec3_t velocity = walking ? t->walk_mps : insole_vec3_zero();
    (void)insole_zupt_ekf_coast(&t->zupt_ekf, velocity, t->config.sigma_walk_mps, s->imu.t_us);
}

/* A gap begins: attitude and velocity are worth nothing until the foot stands again. */
static void begin_coast(insole_foot_tracker_t *t)
{
    t->coasting = true;
    t->still_count = 0u;
    t->counts.coasts++;
}

static void end_coast(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    if (align(t, s, t->stance_yaw_rad, t->config.sigma_moving_tilt_rad)) {
        t->coasting = false;
        t->counts.realigned++;
        t->zupt_ekf.P.aa.zz += insole_square(t->config.sigma_gap_yaw_rad);
        t->has_floor = false;
        insole_stride_restart(&t->strides);
    }
}

/* Floors are level: a stance that differs little in height from the last stands as high. */
static void level_floor(insole_foot_tracker_t *t)
{
    insole_real_t z = t->zupt_ekf.p_m.z;
    if (t->has_floor && insole_abs(z - t->floor_m) < t->config.floor_step_m) {
        (void)insole_zupt_ekf_correct_height(&t->zupt_ekf, t->floor_m, t->config.sigma_floor_m);
    } else {
        t->floor_m = z;
        t->has_floor = true;
    }
}

static void navigate(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    insole_imu_t imu = s->imu;
    imu.gyro_radps = insole_vec3_sub(imu.gyro_radps, t->still_bias.gyro_bias_radps);
    t->zupt_ekf.gravity_mps2 = t->still_bias.gravity_mps2;
    (void)insole_zupt_ekf_predict(&t->zupt_ekf, &imu, s->tag & INSOLE_MARK_CLIP);
    if (s->still) {
        if (insole_zupt_ekf_correct(&t->zupt_ekf, 0) == INSOLE_OK) {
            t->counts.corrections++;
        }
        t->stance_yaw_rad = insole_quat_yaw(t->zupt_ekf.q);
    } else if (t->was_still) {
        level_floor(t);
    }
}

/* ---- strides ---------------------------------------------------------------------------- */

static void note_walk(insole_foot_tracker_t *t, const insole_stride_t *stride, uint64_t t_us)
{
    insole_real_t lasted_s = (insole_real_t)(stride->end_us - stride->begin_us) * INSOLE_R(1.0e-6);
    insole_real_t gait_s = insole_max(lasted_s * INSOLE_R(1.6), INSOLE_R(0.5));
    t->walk_mps = insole_vec3_scale(stride->displacement_m, INSOLE_R(1.0) / gait_s);
    t->walk_mps.z = ZERO;
    t->walk_us = t_us;
    t->heading_n_rad = stride->heading_rad;
    t->pdr_m.x += stride->model_length_m * insole_cos(stride->heading_rad);
    t->pdr_m.y += stride->model_length_m * insole_sin(stride->heading_rad);
    t->pdr_m.z += stride->displacement_m.z;
    t->pdr_var_m2 += insole_square(MODEL_ERROR_SHARE * stride->model_length_m);
}

static void count_stride(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    insole_stride_input_t in = {s->imu.t_us, t->zupt_ekf.p_m, insole_quat_yaw(t->zupt_ekf.q),
                                t->zupt_ekf.force_mps2.z, s->still};
    if (insole_stride_push(&t->strides, &in, &t->stride) == INSOLE_OK) {
        t->has_stride = true;
        note_walk(t, &t->stride, s->imu.t_us);
        if (t->anchor.strides_left > 0u) {
            t->anchor.strides_left--;
        }
    }
}

/* ---- from n to m ------------------------------------------------------------------------ */

static insole_vec3_t position_n(const insole_foot_tracker_t *t)
{
    return t->config.method == INSOLE_FOOT_PDR ? t->pdr_m : t->zupt_ekf.p_m;
}

static void reach_start(insole_foot_tracker_t *t, uint64_t t_us)
{
    if (!t->has_start || t_us < t->start.t_us) {
        return;
    }
    insole_foot_anchor_t *a = &t->anchor;
    a->anchor_n_m = position_n(t);
    a->anchor_m_m = insole_vec3(t->start.x_m, t->start.y_m, a->anchor_m_m.z);
    a->var_m2 = insole_square(t->start.sigma_m);
    a->strides_left = 0u;
    a->t_us = t_us;
    if (t->start.has_heading) {
        a->heading_rad = t->start.heading_rad;
        a->var_rad2 = insole_square(t->start.sigma_rad);
        a->strides_left = START_STRIDES;
    }
    t->has_start = false;
}

static void turn_to_heading(insole_foot_tracker_t *t)
{
    insole_vec3_t way = insole_vec3_sub(position_n(t), t->anchor.anchor_n_m);
    if (t->anchor.strides_left > 0u &&
        way.x * way.x + way.y * way.y > insole_square(WAY_WITH_DIRECTION_M)) {
        t->anchor.yaw_rad = insole_wrap_pi(t->anchor.heading_rad - insole_atan2(way.y, way.x));
    }
}

static void rotate_covariance(insole_fix_t *fix, insole_real_t c, insole_real_t s, insole_sym3_t P)
{
    insole_real_t cs2 = INSOLE_R(2.0) * c * s * P.xy;
    fix->var_x_m2 = c * c * P.xx - cs2 + s * s * P.yy;
    fix->var_y_m2 = s * s * P.xx + cs2 + c * c * P.yy;
    fix->cov_xy_m2 = c * s * (P.xx - P.yy) + (c * c - s * s) * P.xy;
}

static insole_fix_state_t fix_state(const insole_foot_tracker_t *t, const insole_fix_t *fix)
{
    if (!t->zupt_ekf.aligned) {
        return INSOLE_FIX_ALIGN;
    }
    if (fix->var_x_m2 + fix->var_y_m2 > insole_square(t->config.lost_sigma_m)) {
        return INSOLE_FIX_LOST;
    }
    return t->coasting ? INSOLE_FIX_COAST : INSOLE_FIX_TRACK;
}

/* Rounding may leave the variance of what has just been fixed a hair below zero. */
static void keep_positive(insole_fix_t *fix)
{
    fix->var_x_m2 = insole_max(fix->var_x_m2, ZERO);
    fix->var_y_m2 = insole_max(fix->var_y_m2, ZERO);
    fix->var_z_m2 = insole_max(fix->var_z_m2, ZERO);
    fix->var_heading_rad2 = insole_max(fix->var_heading_rad2, ZERO);
}

static void make_fix(const insole_foot_tracker_t *t, uint64_t t_us, insole_fix_t *fix)
{
    const insole_foot_anchor_t *a = &t->anchor;
    insole_real_t c = insole_cos(a->yaw_rad), s = insole_sin(a->yaw_rad);
    insole_vec3_t d = insole_vec3_sub(position_n(t), a->anchor_n_m);
    insole_vec3_t way = insole_vec3(c * d.x - s * d.y, s * d.x + c * d.y, d.z);
    insole_sym3_t P = t->config.method == INSOLE_FOOT_PDR
                          ? insole_sym3_add_diagonal(t->zupt_ekf.P.pp, t->pdr_var_m2)
                          : t->zupt_ekf.P.pp;
    insole_real_t drift =
        (insole_real_t)(t_us - a->t_us) * INSOLE_R(1.0e-6) * t->config.yaw_drift_radps;
    insole_real_t var_yaw = a->var_rad2 + insole_square(t->zupt_ekf.aligned ? drift : ZERO);
    rotate_covariance(fix, c, s, P);
    fix->t_us = t_us;
    fix->position_m = insole_vec3_add(a->anchor_m_m, way);
    fix->heading_rad = insole_wrap_pi(t->heading_n_rad + a->yaw_rad);
    fix->var_x_m2 += a->var_m2 + var_yaw * way.y * way.y;
    fix->var_y_m2 += a->var_m2 + var_yaw * way.x * way.x;
    fix->cov_xy_m2 -= var_yaw * way.x * way.y;
    fix->var_z_m2 = P.zz;
    fix->var_heading_rad2 = t->zupt_ekf.P.aa.zz + var_yaw;
    keep_positive(fix);
    fix->state = fix_state(t, fix);
}

/* ---- fixes out -------------------------------------------------------------------------- */

static void advance(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    if (!t->zupt_ekf.aligned) {
        align_first(t, s);
    } else {
        if ((s->tag & INSOLE_MARK_GAP) != 0u && !t->coasting) {
            begin_coast(t);
        }
        if (t->coasting) {
            coast(t, s);
            end_coast(t, s);
        } else {
            navigate(t, s);
            count_stride(t, s);
        }
    }
    t->counts.fixes++;
    t->counts.still += s->still ? 1u : 0u;
    t->counts.stances += s->still && !t->was_still ? 1u : 0u;
    t->was_still = s->still;
}

insole_status_t insole_foot_tracker_next(insole_foot_tracker_t *tracker, insole_fix_t *fix)
{
    if (!tracker || !fix) {
        return INSOLE_ERR_NULL;
    }
    insole_labelled_t s;
    if (insole_zero_velocity_next(&tracker->zero_velocity, &s) != INSOLE_OK) {
        return INSOLE_ERR_STATE;
    }
    if (tracker->counts.fixes == 0u) {
        tracker->anchor.t_us = s.imu.t_us;
    }
    advance(tracker, &s);
    reach_start(tracker, s.imu.t_us);
    turn_to_heading(tracker);
    make_fix(tracker, s.imu.t_us, fix);
    return INSOLE_OK;
}

insole_status_t insole_foot_tracker_stride(insole_foot_tracker_t *tracker, insole_stride_t *stride)
{
    if (!tracker || !stride) {
        return INSOLE_ERR_NULL;
    }
    if (!tracker->has_stride) {
        return INSOLE_ERR_STATE;
    }
    *stride = tracker->stride;
    tracker->has_stride = false;
    return INSOLE_OK;
}
