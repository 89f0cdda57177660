/* SPDX-License-Identifier: MIT */
#include "sensor_stream.h"

#include <string.h>

#include "record_line.h"

bool sensor_stream_open(sensor_stream_t *stream, const char *const *paths, size_t count,
                        const char *accel_unit, const char *gyro_unit, failure_t *failure)
{
    memset(stream, 0, sizeof *stream);
    imu_pairer_init(&stream->pairer);
    return units_init(&stream->units, accel_unit, gyro_unit, failure) &&
           session_open(&stream->session, paths, count, failure);
}

static bool refuse_mixture(const sensor_stream_t *stream, failure_t *failure)
{
    if (stream->seen[RECORD_IMU] > 0u && stream->seen[RECORD_ACC] + stream->seen[RECORD_GYR] > 0u) {
        return failure_input(failure,
                             "%s: the session holds imu records as well as acc or gyr "
                             "records: expected one or the other",
                             stream->session.logs[0]->reader.lines.name);
    }
    return true;
}

static read_t check_radio(const sensor_stream_t *stream, failure_t *failure)
{
    if (stream->seen[RECORD_RSS] + stream->seen[RECORD_RANGE] > 0u) {
        return READ_END;
    }
    failure_input(failure, "%s: no rss or range record in the session: expected rss,t,id,dbm",
                  stream->session.logs[0]->reader.lines.name);
    return READ_FAILED;
}

/* A session that nothing can be made of. */
static read_t check_end(const sensor_stream_t *stream, failure_t *failure)
{
    const char *name = stream->session.logs[0]->reader.lines.name;
    const unsigned long *seen = stream->seen;
    if (!units_finish(&stream->units, failure)) {
        return READ_FAILED;
    }
    if (stream->is_radio_enough) {
        return check_radio(stream, failure);
    }
    if (seen[RECORD_IMU] > 0u || (seen[RECORD_ACC] > 0u && seen[RECORD_GYR] > 0u)) {
        return READ_END;
    }
    record_kind_t missing = seen[RECORD_ACC] > 0u ? RECORD_GYR : RECORD_ACC;
    bool has_one = seen[RECORD_ACC] + seen[RECORD_GYR] > 0u;
    failure_input(failure, "%s: no %s record in the session: expected %s", name,
                  has_one ? record_line_kind_name(missing) : "imu",
                  has_one ? "both acc and gyr" : "imu,t,ax,ay,az,gx,gy,gz");
    return READ_FAILED;
}

/* Hands on what waits in the pairer, one by one. */
static read_t end_session(sensor_stream_t *stream, record_t *record, failure_t *failure)
{
    stream->has_ended = true;
    imu_pairer_finish(&stream->pairer);
    return imu_pairer_take(&stream->pairer, record) ? READ_ONE : check_end(stream, failure);
}

read_t sensor_stream_next(sensor_stream_t *stream, record_t *record, failure_t *failure)
{
    while (!stream->has_ended) {
        if (imu_pairer_take(&stream->pairer, record)) {
            return READ_ONE;
        }
        read_t answer = session_next(&stream->session, record, failure);
        if (answer == READ_END) {
            break;
        }
        if (answer == READ_FAILED) {
            return READ_FAILED;
        }
        stream->seen[record->kind]++;
        if (!refuse_mixture(stream, failure) || !units_apply(&stream->units, record, failure)) {
            return READ_FAILED;
        }
        if (record->kind != RECORD_ACC && record->kind != RECORD_GYR) {
            return READ_ONE;
        }
        imu_pairer_push(&stream->pairer, record);
    }
    return end_session(stream, record, failure);
}

void sensor_stream_close(sensor_stream_t *stream)
{
    session_close(&stream->session);
}
