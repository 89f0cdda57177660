/** @file readings.h  A whole session's IMU readings in memory, for calibrations that look twice.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_READINGS_H
#define INSOLE_HOST_READINGS_H

#include <stddef.h>
#include <stdint.h>

#include "failure.h"

typedef struct {
    double t_s; /**< since the first reading */
    double accel_mps2[3], gyro_radps[3];
} reading_t;

typedef struct {
    reading_t *at;
    size_t count, room;
} readings_t;

/** Reads a session (a file, a folder or `-`). Readings with a bad field or stamp are left out. */
bool readings_load(readings_t *readings, const char *path, const char *accel_unit,
                   const char *gyro_unit, failure_t *failure);

void readings_free(readings_t *readings);

/** Mean and scatter of a stretch of readings. */
typedef struct {
    double accel_mps2[3], gyro_radps[3];
    double accel_std_mps2[3], gyro_std_radps[3];
} stretch_t;

/** @param from,to numbers of readings, `to` not included; at least one */
void readings_describe(const readings_t *readings, size_t from, size_t to, stretch_t *stretch);

/** Does the sensor rest in this stretch: does it neither turn nor shake? */
bool stretch_is_rest(const stretch_t *stretch);

double vector_length(const double v[3]);

#endif
