/** @file units.h  Units of the sensors: converted when told, recognised when wrong, never guessed.
 *
 *  The median of |a| over the first readings tells m/s^2 from g and mg; a turn rate beyond 40 rad/s
 *  that lasts tells degrees per second from rad/s. What contradicts the units told is refused with
 *  the option that would set it right.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_UNITS_H
#define INSOLE_HOST_UNITS_H

#include "failure.h"
#include "record.h"

typedef enum { ACCEL_MPS2, ACCEL_G, ACCEL_MG } accel_unit_t;
typedef enum { GYRO_RADPS, GYRO_DPS } gyro_unit_t;

/** Readings that the median is taken of. */
enum { UNITS_READINGS = 100 };

typedef struct {
    accel_unit_t accel;
    gyro_unit_t gyro;
    double norm[UNITS_READINGS]; /**< |a| as written in the log */
    int norms;
    double fast_share; /**< running share of readings that turn faster than feet do */
} units_t;

/** @param accel,gyro names of units as on the command line; NULL: the log format's own */
bool units_init(units_t *units, const char *accel, const char *gyro, failure_t *failure);

/** Converts an IMU, ACC or GYR record to m/s^2 and rad/s. @return false when the units look wrong
 */
bool units_apply(units_t *units, record_t *record, failure_t *failure);

/** The same judgement for a log that was too short for the running one. */
bool units_finish(const units_t *units, failure_t *failure);

#endif
