/** @file sensor_stream.h  A session as an estimator wants it: IMU readings whole and in SI units.
 *
 *  session -> units -> imu_pairer. ACC and GYR become IMU; all other records pass as they are.
 *
 *      sensor_stream_open(&stream, paths, count, "g", "dps", &failure);
 *      while (sensor_stream_next(&stream, &record, &failure) == READ_ONE) ...
 *      sensor_stream_close(&stream);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SENSOR_STREAM_H
#define INSOLE_HOST_SENSOR_STREAM_H

#include "imu_pairer.h"
#include "session.h"
#include "units.h"

typedef struct {
    session_t session;
    units_t units;
    imu_pairer_t pairer;
    unsigned long seen[RECORD_KINDS]; /**< records in the logs, by kind */
    bool is_radio_enough; /**< signal strengths or ranges must be there instead of IMU readings */
    bool has_ended;
} sensor_stream_t;

/** @param accel_unit,gyro_unit as on the command line; NULL: m/s^2 and rad/s */
bool sensor_stream_open(sensor_stream_t *stream, const char *const *paths, size_t count,
                        const char *accel_unit, const char *gyro_unit, failure_t *failure);

/** Fails for a malformed line, for units that look wrong, and at the end of a session that
 *  nothing can be made of. */
read_t sensor_stream_next(sensor_stream_t *stream, record_t *record, failure_t *failure);

void sensor_stream_close(sensor_stream_t *stream);

#endif
