/* SPDX-License-Identifier: MIT */
#include "estimator.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "number.h"

/* Fixes that are smoothed together, and how many of them wait for the next window: at 200 Hz 164 s
 * and 41 s, far longer than a later stance reaches back. */
enum { SMOOTH_FIXES = 32768, SMOOTH_KEEP = 8192 };

/* The library counts from 0 and never back; a log may begin before its own zero. */
static const uint64_t log_zero_us = UINT64_C(1) << 62;

static uint64_t to_library(int64_t t_us)
{
    return log_zero_us + (uint64_t)t_us;
}

static int64_t to_log(uint64_t t_us)
{
    return (int64_t)(t_us - log_zero_us);
}

/* What does not fit a real becomes not-a-number, which the library knows how to refuse. */
static insole_real_t to_real(double value)
{
    return fabs(value) <= (double)INSOLE_REAL_MAX ? (insole_real_t)value
                                                  : (insole_real_t)NUMBER_UNKNOWN;
}

bool estimator_init(estimator_t *estimator, const settings_t *settings, bool is_smooth)
{
    memset(estimator, 0, sizeof *estimator);
    estimator->sensor = settings->sensor;
    estimator->is_smooth = is_smooth;
    if (is_smooth) {
        estimator->nodes = memory_new(SMOOTH_FIXES, sizeof *estimator->nodes);
        estimator->fixes = memory_new(SMOOTH_FIXES, sizeof *estimator->fixes);
        (void)insole_foot_smooth_init(&estimator->past, estimator->nodes, estimator->fixes,
                                      SMOOTH_FIXES);
    }
    return insole_foot_tracker_init(&estimator->foot, &settings->foot) == INSOLE_OK;
}

void estimator_free(estimator_t *estimator)
{
    free(estimator->nodes);
    free(estimator->fixes);
}

static void push_start(estimator_t *estimator, const record_t *record)
{
    const double *v = record->value;
    insole_start_t start;
    memset(&start, 0, sizeof start);
    start.t_us = to_library(record->t_us);
    start.x_m = to_real(v[0]);
    start.y_m = to_real(v[1]);
    start.has_heading = !isnan(v[2]);
    start.heading_rad = start.has_heading ? to_real(v[2]) : INSOLE_R(0.0);
    start.sigma_m = to_real(isnan(v[3]) ? START_SIGMA_M : v[3]);
    start.sigma_rad = to_real(isnan(v[4]) ? START_SIGMA_RAD : v[4]);
    (void)insole_foot_tracker_start(&estimator->foot, &start);
}

static void push_imu(estimator_t *estimator, const record_t *record)
{
    const double *v = record->value;
    insole_imu_t imu = {to_library(record->t_us),
                        {to_real(v[0]), to_real(v[1]), to_real(v[2])},
                        {to_real(v[3]), to_real(v[4]), to_real(v[5])}};
    settings_correct(&estimator->sensor, &imu);
    (void)insole_foot_tracker_imu(&estimator->foot, &imu);
}

void estimator_push(estimator_t *estimator, const record_t *record)
{
    if (record->kind == RECORD_IMU) {
        push_imu(estimator, record);
    } else if (record->kind == RECORD_START) {
        push_start(estimator, record);
    }
}

void estimator_finish(estimator_t *estimator)
{
    (void)insole_foot_tracker_finish(&estimator->foot);
}

static void take_stride(estimator_t *estimator)
{
    insole_stride_t stride;
    if (insole_foot_tracker_stride(&estimator->foot, &stride) != INSOLE_OK) {
        return;
    }
    double heading = (double)stride.heading_rad + (double)estimator->foot.anchor.yaw_rad;
    foot_event_t event = {to_log(stride.begin_us),
                          to_log(stride.end_us),
                          true,
                          (double)stride.length_m,
                          (double)stride.displacement_m.z,
                          remainder(heading, 6.283185307179586),
                          (double)stride.turn_rad,
                          (double)stride.model_length_m,
                          (double)stride.accel_min_mps2,
                          (double)stride.accel_max_mps2};
    estimator->stride = event;
    estimator->has_stride = true;
}

/* A stance has ended when the foot no longer stands as it did at the fix before. */
static void watch_stance(estimator_t *estimator, int64_t t_us)
{
    bool is_still = estimator->foot.was_still;
    if (is_still && !estimator->is_still) {
        estimator->stance_begin_us = t_us;
    }
    if (!is_still && estimator->is_still) {
        memset(&estimator->stance, 0, sizeof estimator->stance);
        estimator->stance.begin_us = estimator->stance_begin_us;
        estimator->stance.end_us = estimator->fix_us;
        estimator->has_stance = true;
    }
    estimator->is_still = is_still;
}

static void convert_fix(const insole_fix_t *from, track_row_t *to)
{
    to->t_us = to_log(from->t_us);
    to->x_m = (double)from->position_m.x;
    to->y_m = (double)from->position_m.y;
    to->z_m = (double)from->position_m.z;
    to->heading_rad = (double)from->heading_rad;
    to->var_x_m2 = (double)from->var_x_m2;
    to->cov_xy_m2 = (double)from->cov_xy_m2;
    to->var_y_m2 = (double)from->var_y_m2;
    to->var_z_m2 = (double)from->var_z_m2;
    to->var_heading_rad2 = (double)from->var_heading_rad2;
    to->state = from->state;
}

static void remember(estimator_t *estimator)
{
    const insole_foot_tracker_t *foot = &estimator->foot;
    if (insole_foot_smooth_push(&estimator->past, foot, &estimator->fix) == INSOLE_ERR_ROOM) {
        (void)insole_foot_smooth_run(&estimator->past, SMOOTH_KEEP);
        estimator->is_held = true;
    }
}

bool estimator_step(estimator_t *estimator)
{
    if (insole_foot_tracker_next(&estimator->foot, &estimator->fix) != INSOLE_OK) {
        return false;
    }
    take_stride(estimator);
    watch_stance(estimator, to_log(estimator->fix.t_us));
    estimator->fix_us = to_log(estimator->fix.t_us);
    if (estimator->is_smooth) {
        remember(estimator);
    } else {
        estimator->has_fix = true;
    }
    return true;
}

/* A fix that found no room is remembered once the older ones have left. */
static bool take_smooth(estimator_t *estimator, insole_fix_t *fix)
{
    if (insole_foot_smooth_take(&estimator->past, fix) == INSOLE_OK) {
        return true;
    }
    if (estimator->is_held) {
        estimator->is_held = false;
        (void)insole_foot_smooth_push(&estimator->past, &estimator->foot, &estimator->fix);
    }
    return false;
}

bool estimator_take(estimator_t *estimator, track_row_t *fix)
{
    insole_fix_t smoothed;
    bool is_smooth = estimator->is_smooth && take_smooth(estimator, &smoothed);
    if (!is_smooth && !estimator->has_fix) {
        return false;
    }
    convert_fix(is_smooth ? &smoothed : &estimator->fix, fix);
    estimator->has_fix = false;
    return true;
}

void estimator_settle(estimator_t *estimator)
{
    if (estimator->is_smooth) {
        (void)insole_foot_smooth_run(&estimator->past, 0u);
    }
}

bool estimator_event(estimator_t *estimator, foot_event_t *event)
{
    if (estimator->has_stance) {
        *event = estimator->stance;
        estimator->has_stance = false;
        return true;
    }
    bool has_stride = estimator->has_stride;
    *event = has_stride ? estimator->stride : *event;
    estimator->has_stride = false;
    return has_stride;
}
