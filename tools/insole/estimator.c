/* SPDX-License-Identifier: MIT */
#include "estimator.h"

#include <string.h>

#include "number.h"

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

bool estimator_init(estimator_t *estimator, const settings_t *settings)
{
    memset(estimator, 0, sizeof *estimator);
    estimator->sensor = settings->sensor;
    return insole_foot_tracker_init(&estimator->foot, &settings->foot) == INSOLE_OK;
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

bool estimator_next(estimator_t *estimator, track_row_t *fix)
{
    insole_fix_t library_fix;
    if (insole_foot_tracker_next(&estimator->foot, &library_fix) != INSOLE_OK) {
        return false;
    }
    convert_fix(&library_fix, fix);
    take_stride(estimator);
    watch_stance(estimator, fix->t_us);
    estimator->fix_us = fix->t_us;
    return true;
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
