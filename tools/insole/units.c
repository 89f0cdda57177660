/* SPDX-License-Identifier: MIT */
#include "units.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "number.h"
#include "statistics.h"

static const char *const accel_names[] = {"mps2", "g", "mg"};
static const double accel_factor[] = {1.0, 9.80665, 0.00980665};
static const char *const gyro_names[] = {"radps", "dps"};
static const double gyro_factor[] = {1.0, 0.017453292519943295};

/* Feet stay below 35 rad/s; degrees per second pass 40 in every step. */
static const double fast_radps = 40.0;
static const double fast_share_limit = 0.2;
static const double fast_share_memory = 200.0; /* readings */

static int find_name(const char *const *names, int count, const char *name)
{
    for (int i = 0; i < count; i++) {
        if (strcmp(names[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

bool units_init(units_t *units, const char *accel, const char *gyro, failure_t *failure)
{
    memset(units, 0, sizeof *units);
    int accel_unit = accel == NULL ? ACCEL_MPS2 : find_name(accel_names, 3, accel);
    int gyro_unit = gyro == NULL ? GYRO_RADPS : find_name(gyro_names, 2, gyro);
    if (accel_unit < 0) {
        return failure_usage(failure, "insole: --accel-unit %s: expected mps2, g or mg", accel);
    }
    if (gyro_unit < 0) {
        return failure_usage(failure, "insole: --gyro-unit %s: expected radps or dps", gyro);
    }
    units->accel = (accel_unit_t)accel_unit;
    units->gyro = (gyro_unit_t)gyro_unit;
    return true;
}

/* The unit in which a walking or resting sensor reads this much; -1: none. */
static int unit_of_median(double norm)
{
    static const double low[] = {5.0, 0.5, 500.0}, high[] = {30.0, 2.0, 2000.0};
    for (int unit = ACCEL_MPS2; unit <= ACCEL_MG; unit++) {
        if (norm >= low[unit] && norm <= high[unit]) {
            return unit;
        }
    }
    return -1;
}

static bool judge_accel(const units_t *units, failure_t *failure)
{
    double norm[UNITS_READINGS];
    memcpy(norm, units->norm, sizeof norm);
    double median = statistics_percentile(norm, (size_t)units->norms, 50.0);
    int unit = unit_of_median(median);
    char number[NUMBER_ROOM];
    if (unit >= 0 && unit != (int)units->accel) {
        return failure_input(failure,
                             "insole: the accelerometer looks like %s (median of |a| is %s): "
                             "use --accel-unit %s",
                             accel_names[unit], number_short(number, median), accel_names[unit]);
    }
    return true;
}

static bool watch_accel(units_t *units, const double a[3], failure_t *failure)
{
    double norm = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    if (units->norms == UNITS_READINGS || !isfinite(norm)) {
        return true;
    }
    units->norm[units->norms++] = norm;
    return units->norms < UNITS_READINGS || judge_accel(units, failure);
}

static bool watch_gyro(units_t *units, const double w[3], failure_t *failure)
{
    double rate = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    units->fast_share += ((rate > fast_radps ? 1.0 : 0.0) - units->fast_share) / fast_share_memory;
    if (units->gyro == GYRO_RADPS && units->fast_share > fast_share_limit) {
        return failure_input(failure, "insole: the gyroscope looks like degrees per second (it "
                                      "keeps beyond 40 rad/s): use --gyro-unit dps");
    }
    return true;
}

static void scale(double value[3], double factor)
{
    for (int i = 0; i < 3; i++) {
        value[i] *= factor;
    }
}

bool units_apply(units_t *units, record_t *record, failure_t *failure)
{
    double *gyro = record->value + (record->kind == RECORD_IMU ? 3 : 0);
    if (record->kind == RECORD_IMU || record->kind == RECORD_ACC) {
        if (!watch_accel(units, record->value, failure)) {
            return false;
        }
        scale(record->value, accel_factor[units->accel]);
    }
    if (record->kind == RECORD_IMU || record->kind == RECORD_GYR) {
        scale(gyro, gyro_factor[units->gyro]);
        return watch_gyro(units, gyro, failure);
    }
    return true;
}

bool units_finish(const units_t *units, failure_t *failure)
{
    bool is_short = units->norms >= 10 && units->norms < UNITS_READINGS;
    return !is_short || judge_accel(units, failure);
}
