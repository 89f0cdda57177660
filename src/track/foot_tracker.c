/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_tracker.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)

/* What a rate that is interpolated over a gap may be wrong by. */
static const insole_real_t BRIDGE_ACCEL_MPS2 = INSOLE_R(4.0);
static const insole_real_t BRIDGE_GYRO_RADPS = INSOLE_R(0.7);

INSOLE_COLD insole_status_t insole_foot_tracker_init(insole_foot_tracker_t *tracker,
                                                     const insole_foot_tracker_config_t *config)
{
    if (!tracker) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_foot_config_check(config);
    if (status != INSOLE_OK) {
        return status;
    }
    memset(tracker, 0, sizeof *tracker);
    memcpy(&tracker->config, config, sizeof tracker->config); /* both begin with the list */
    (void)insole_screen_init(&tracker->screen, &config->screen);
    (void)insole_still_bias_init(&tracker->still_bias, &config->still_bias);
    (void)insole_zero_velocity_init(&tracker->zero_velocity, &config->zero_velocity);
    (void)insole_zupt_ekf_init(&tracker->zupt_ekf, &config->zupt_ekf);
    (void)insole_stride_init(&tracker->strides, &config->stride);
    (void)insole_foot_walk_init(&tracker->walk);
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_foot_tracker_start(insole_foot_tracker_t *tracker,
                                                      const insole_start_t *start)
{
    if (!tracker) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_foot_anchor_check(start);
    if (status != INSOLE_OK) {
        tracker->counts.refused++;
        return status;
    }
    tracker->start = *start;
    tracker->has_start = true;
    return INSOLE_OK;
}

/* ---- samples in ------------------------------------------------------------------------- */

insole_status_t insole_foot_tracker_imu(insole_foot_tracker_t *tracker, const insole_imu_t *imu)
{
    if (!tracker || !imu) {
        return INSOLE_ERR_NULL;
    }
    if (tracker->finished || insole_zero_velocity_is_full(&tracker->zero_velocity)) {
        tracker->counts.refused++;
        return tracker->finished ? INSOLE_ERR_STATE : INSOLE_ERR_ROOM;
    }
    insole_clean_t room;
    const insole_clean_t *clean = insole_screen_take(&tracker->screen, imu, &room);
    if (clean) {
        insole_still_bias_take(&tracker->still_bias, &clean->imu);
        insole_zero_velocity_take(&tracker->zero_velocity, &clean->imu, clean->marks);
    }
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_foot_tracker_finish(insole_foot_tracker_t *tracker)
{
    if (!tracker) {
        return INSOLE_ERR_NULL;
    }
    insole_clean_t clean;
    while (!tracker->finished && insole_screen_finish(&tracker->screen, &clean) == INSOLE_OK) {
        (void)insole_still_bias_push(&tracker->still_bias, &clean.imu);
        (void)insole_zero_velocity_push(&tracker->zero_velocity, &clean.imu, clean.marks);
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
    return insole_seconds(t->still_since_us, s->imu.t_us) >= t->config.align_s;
}

INSOLE_COLD static bool align(insole_foot_tracker_t *t, const insole_labelled_t *s,
                              insole_real_t sigma_tilt_rad, insole_vec3_t *mean_accel)
{
    if (!stance_is_summed(t, s)) {
        return false;
    }
    *mean_accel = insole_vec3_scale(t->still_accel, INSOLE_R(1.0) / (insole_real_t)t->still_count);
    t->still_count = 0u;
    t->unmeasured_s = ZERO; /* its velocity is none */
    t->zupt_ekf.gravity_mps2 = t->still_bias.gravity_mps2;
    return insole_zupt_ekf_align(&t->zupt_ekf, *mean_accel, sigma_tilt_rad, ZERO, s->imu.t_us) ==
           INSOLE_OK;
}

/* The first attitude: from a rest as good as it gets, from a stance of a walk as told. */
INSOLE_COLD static void align_first(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    if (t->counts.fixes == 0u) {
        (void)insole_foot_anchor_init(&t->anchor, t->config.yaw_drift_radps, s->imu.t_us);
    }
    bool rest = s->plain && s->imu.t_us - t->still_since_us > 0u && t->still_bias.rests > 0u;
    insole_real_t tilt = rest ? t->zupt_ekf.config.sigma_tilt_rad : t->config.sigma_moving_tilt_rad;
    insole_vec3_t mean_accel;
    if (align(t, s, tilt, &mean_accel)) {
        t->counts.aligned_moving = !rest;
        t->first_q = t->stance_q = t->zupt_ekf.q;
        t->anchor.t_us = s->imu.t_us;
    }
}

/* ---- motion ----------------------------------------------------------------------------- */

/* Where the errors of position are counted from. */
INSOLE_COLD static void forget_place(insole_foot_tracker_t *t)
{
    (void)insole_zupt_ekf_settle(&t->zupt_ekf);
    insole_zupt_cov_forget_place(&t->zupt_ekf.P);
    t->walk.place_m2 = ZERO;
}

/* Floors are level: a stance that differs little in height from the last stands as high. */
INSOLE_COLD static void level_floor(insole_foot_tracker_t *t)
{
    insole_real_t z = t->zupt_ekf.p_m.z;
    if (t->has_floor && insole_abs(z - t->floor_m) < t->config.floor_step_m) {
        (void)insole_zupt_ekf_correct_height(&t->zupt_ekf, t->floor_m, t->config.sigma_floor_m);
    } else {
        t->floor_m = z;
        t->has_floor = true;
    }
}

/* A stance is measured where it begins, after a gap in it, and else from time to time. */
static void measure_stance(insole_foot_tracker_t *t, bool after_gap)
{
    insole_zupt_ekf_t *ekf = &t->zupt_ekf;
    t->unmeasured_s = (t->was_still ? t->unmeasured_s : ZERO) + ekf->dt_s;
    bool is_due = t->unmeasured_s + INSOLE_R(0.5) * ekf->dt_s >= t->config.correct_every_s;
    if (is_due || after_gap || !t->was_still) {
        bool is_taken = insole_zupt_ekf_correct(ekf, t->unmeasured_s, 0) == INSOLE_OK;
        t->counts.corrections += is_taken ? 1u : 0u;
        t->unmeasured_s = ZERO;
    }
}

/* The sample loses its gyro bias. */
static void navigate(insole_foot_tracker_t *t, insole_labelled_t *s)
{
    s->imu.gyro_radps = insole_vec3_sub(s->imu.gyro_radps, t->still_bias.gyro_bias_radps);
    t->zupt_ekf.gravity_mps2 = t->still_bias.gravity_mps2;
    (void)insole_zupt_ekf_predict(&t->zupt_ekf, &s->imu, s->tag & INSOLE_MARK_CLIP);
    if (s->still) {
        measure_stance(t, (s->tag & INSOLE_MARK_GAP) != 0u);
        t->stance_q = t->zupt_ekf.q;
        t->stance_us = s->imu.t_us;
    } else if (t->was_still) {
        level_floor(t);
    }
}

/* ---- strides ---------------------------------------------------------------------------- */

/* True when a stride ends. */
INSOLE_APART static bool push_stride(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    insole_real_t yaw = s->still ? insole_quat_turn(t->first_q, t->zupt_ekf.q) : ZERO;
    insole_stride_input_t in = {s->imu.t_us, t->zupt_ekf.p_m, yaw, t->zupt_ekf.force_mps2.z,
                                s->still};
    if (insole_stride_push(&t->strides, &in, &t->stride) != INSOLE_OK) {
        return false;
    }
    t->has_stride = true;
    (void)insole_foot_walk_stride(&t->walk, &t->stride, s->imu.t_us);
    return true;
}

static bool count_stride(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    return !insole_stride_go_on(&t->strides, s->imu.t_us, t->zupt_ekf.force_mps2.z, s->still) &&
           push_stride(t, s);
}

/* ---- from n to m ------------------------------------------------------------------------ */

static const insole_vec3_t *position_n(const insole_foot_tracker_t *t)
{
    return t->config.method == INSOLE_FOOT_PDR ? &t->walk.place_m : &t->zupt_ekf.p_m;
}

static insole_fix_state_t fix_state(const insole_foot_tracker_t *t, const insole_fix_t *fix)
{
    bool lost = fix->var_x_m2 + fix->var_y_m2 > insole_square(t->config.lost_sigma_m);
    return !t->zupt_ekf.aligned ? INSOLE_FIX_ALIGN
           : lost               ? INSOLE_FIX_LOST
           : t->coasting        ? INSOLE_FIX_COAST
                                : INSOLE_FIX_TRACK;
}

static void make_fix(const insole_foot_tracker_t *t, insole_fix_t *fix, uint64_t t_us)
{
    fix->t_us = t_us;
    fix->heading_rad = t->walk.heading_rad;
    fix->var_heading_rad2 = t->zupt_ekf.P.aa.zz;
    if (t->config.method == INSOLE_FOOT_PDR) {
        insole_sym3_t P = insole_sym3_add_diagonal(t->zupt_ekf.P.pp, t->walk.place_m2);
        (void)insole_foot_anchor_put(&t->anchor, &t->walk.place_m, &P, fix);
    } else {
        (void)insole_foot_anchor_put(&t->anchor, &t->zupt_ekf.p_m, &t->zupt_ekf.P.pp, fix);
    }
    fix->state = fix_state(t, fix);
}

INSOLE_APART static void reach_start(insole_foot_tracker_t *t, uint64_t t_us)
{
    if (t_us < t->start.t_us) {
        return;
    }
    (void)insole_foot_anchor_start(&t->anchor, &t->start, *position_n(t), t_us);
    forget_place(t);
    if (t->start.has_heading) {
        insole_zupt_cov_forget_yaw(&t->zupt_ekf.P);
    }
    t->has_start = false;
}

/* ---- gaps ------------------------------------------------------------------------------- */

/* A short gap: the rates in it lie between those at its ends, more or less. */
static void bridge(insole_foot_tracker_t *t, insole_labelled_t *s)
{
    insole_zupt_ekf_t *ekf = &t->zupt_ekf;
    insole_vec3_t accel = insole_vec3_add(ekf->last_accel_mps2, insole_zupt_ekf_accel_bias(ekf));
    insole_vec3_t gyro = insole_vec3_add(ekf->last_gyro_radps, t->still_bias.gyro_bias_radps);
    s->imu.accel_mps2 = insole_vec3_middle(accel, s->imu.accel_mps2);
    s->imu.gyro_radps = insole_vec3_middle(gyro, s->imu.gyro_radps);
    insole_real_t gap_s = insole_seconds(ekf->t_us, s->imu.t_us);
    insole_real_t var_v = insole_square(BRIDGE_ACCEL_MPS2 * gap_s);
    insole_real_t var_a = insole_square(BRIDGE_GYRO_RADPS * gap_s);
    (void)insole_zupt_ekf_settle(ekf);
    ekf->P.vv = insole_sym3_add_diagonal(ekf->P.vv, var_v);
    ekf->P.aa = insole_sym3_add_diagonal(ekf->P.aa, var_a);
    navigate(t, s);
    t->counts.bridged++;
}

/* A long gap: attitude and velocity are worth nothing until the foot stands again. */
static void begin_coast(insole_foot_tracker_t *t)
{
    t->coasting = true;
    t->still_count = 0u;
    t->counts.coasts++;
    (void)insole_foot_walk_cease(&t->walk, t->zupt_ekf.t_us);
}

/* The foot stands again, turned by what is usual and somewhat more or less. */
INSOLE_COLD static void end_coast(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    insole_vec3_t mean_accel;
    if (!align(t, s, t->config.sigma_moving_tilt_rad, &mean_accel)) {
        return;
    }
    insole_real_t bow = insole_foot_walk_bow(&t->walk, insole_seconds(t->stance_us, s->imu.t_us));
    insole_quat_t turn = insole_quat_from_yaw(bow);
    t->zupt_ekf.q = insole_quat_level(insole_quat_mul(turn, t->stance_q), mean_accel);
    t->coasting = false;
    t->has_floor = false;
    t->counts.realigned++;
    insole_stride_restart(&t->strides);
}

/* True when the sample has been used up. */
INSOLE_COLD static bool cross_gap(insole_foot_tracker_t *t, insole_labelled_t *s)
{
    insole_real_t gap_s = insole_seconds(t->zupt_ekf.t_us, s->imu.t_us);
    t->gap_turn_rad2 += insole_square(t->config.sigma_gap_turn_rad_rts) * gap_s;
    if (t->coasting) {
        return false;
    }
    if (gap_s > t->config.bridge_s) {
        begin_coast(t);
        return false;
    }
    bridge(t, s);
    return true;
}

/* The foot stands for the first time after a gap: what lies before is left behind. */
INSOLE_APART static void leave_gap(insole_foot_tracker_t *t, uint64_t t_us)
{
    if (!t->coasting) {
        insole_fix_t fix;
        make_fix(t, &fix, t_us);
        (void)insole_foot_anchor_renew(&t->anchor, &fix, *position_n(t), t->gap_turn_rad2);
        forget_place(t);
        t->gap_turn_rad2 = ZERO;
    }
}

INSOLE_APART static void coast(insole_foot_tracker_t *t, const insole_labelled_t *s)
{
    insole_vec3_t way;
    insole_real_t per_s = INSOLE_R(1.0) / insole_seconds(t->zupt_ekf.t_us, s->imu.t_us);
    (void)insole_foot_walk_on(&t->walk, t->zupt_ekf.t_us, s->imu.t_us, &way);
    (void)insole_zupt_ekf_coast(&t->zupt_ekf, insole_vec3_scale(way, per_s),
                                t->config.sigma_walk_mps, s->imu.t_us);
    end_coast(t, s);
}

/* One sample of the aligned filter; true when a stride ends. */
static bool move(insole_foot_tracker_t *t, insole_labelled_t *s)
{
    bool bridged = (s->tag & INSOLE_MARK_GAP) != 0u && cross_gap(t, s);
    if (t->coasting) {
        coast(t, s);
    } else if (!bridged) {
        navigate(t, s);
    }
    return !t->coasting && count_stride(t, s);
}

/* ---- fixes out -------------------------------------------------------------------------- */

/* True when a stride ends. */
static bool advance(insole_foot_tracker_t *t, insole_labelled_t *s)
{
    bool stride_ended = false;
    if (t->zupt_ekf.aligned) {
        stride_ended = move(t, s);
    } else {
        align_first(t, s);
    }
    t->counts.fixes++;
    if (s->still) {
        t->counts.still++;
        t->counts.stances += t->was_still ? 0u : 1u;
    }
    t->was_still = s->still;
    return stride_ended;
}

/* The next labelled sample becomes a fix. */
INSOLE_APART INSOLE_FLAT static insole_status_t use(insole_foot_tracker_t *t, insole_fix_t *fix)
{
    insole_labelled_t s;
    insole_zero_velocity_give(&t->zero_velocity, &s);
    bool stride_ended = advance(t, &s);
    if (s.still && t->gap_turn_rad2 > ZERO) {
        leave_gap(t, s.imu.t_us);
    }
    if (t->has_start) {
        reach_start(t, s.imu.t_us);
    }
    if (t->anchor.strides_left > 0u) {
        (void)insole_foot_anchor_follow(&t->anchor, *position_n(t), stride_ended);
    }
    make_fix(t, fix, s.imu.t_us);
    return INSOLE_OK;
}

insole_status_t insole_foot_tracker_next(insole_foot_tracker_t *tracker, insole_fix_t *fix)
{
    if (!tracker || !fix) {
        return INSOLE_ERR_NULL;
    }
    return insole_zero_velocity_has_next(&tracker->zero_velocity) ? use(tracker, fix)
                                                                  : INSOLE_ERR_STATE;
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
