/* SPDX-License-Identifier: MIT */
#include "readings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "sensor_stream.h"

/* A sensor on a desk stays below; one in a hand does not. */
static const double rest_gyro_std_radps = 0.03, rest_accel_std_mps2 = 0.4;

/* No gyroscope worth its name has a larger bias. */
static const double rest_gyro_radps = 0.2;

static bool is_good_record(const record_t *record, const readings_t *readings, double t_s)
{
    double sum = 0.0;
    for (int i = 0; i < RECORD_VALUES; i++) {
        sum += record->value[i];
    }
    return isfinite(sum) && (readings->count == 0u || t_s > readings->at[readings->count - 1u].t_s);
}

static void add(readings_t *readings, const record_t *record, int64_t *first_us)
{
    *first_us = readings->count == 0u ? record->t_us : *first_us;
    double t_s = 1e-6 * (double)(record->t_us - *first_us);
    if (!is_good_record(record, readings, t_s)) {
        return;
    }
    readings->at =
        memory_room(readings->at, &readings->room, readings->count + 1u, sizeof *readings->at);
    reading_t *reading = &readings->at[readings->count++];
    reading->t_s = t_s;
    memcpy(reading->accel_mps2, record->value, sizeof reading->accel_mps2);
    memcpy(reading->gyro_radps, record->value + 3, sizeof reading->gyro_radps);
}

static read_t load(readings_t *readings, sensor_stream_t *stream, failure_t *failure)
{
    record_t record;
    int64_t first_us = 0;
    read_t answer;
    while ((answer = sensor_stream_next(stream, &record, failure)) == READ_ONE) {
        if (record.kind == RECORD_IMU) {
            add(readings, &record, &first_us);
        }
    }
    return answer;
}

bool readings_load(readings_t *readings, const char *path, const char *accel_unit,
                   const char *gyro_unit, failure_t *failure)
{
    sensor_stream_t *stream = memory_new(1u, sizeof *stream);
    memset(readings, 0, sizeof *readings);
    bool is_good = sensor_stream_open(stream, &path, 1u, accel_unit, gyro_unit, failure) &&
                   load(readings, stream, failure) == READ_END;
    sensor_stream_close(stream);
    free(stream);
    if (is_good && readings->count < 2u) {
        return failure_input(failure, "%s: fewer than two good readings", path);
    }
    return is_good;
}

void readings_free(readings_t *readings)
{
    free(readings->at);
    memset(readings, 0, sizeof *readings);
}

/* Mean and standard deviation of value `i` of the six. */
static void describe_value(const readings_t *readings, size_t from, size_t to, int i, double *mean,
                           double *std)
{
    double sum = 0.0, squares = 0.0;
    for (size_t k = from; k < to; k++) {
        const reading_t *r = &readings->at[k];
        double value = i < 3 ? r->accel_mps2[i] : r->gyro_radps[i - 3];
        double step = value - sum; /* the running mean */
        sum += step / (double)(k - from + 1u);
        squares += step * (value - sum);
    }
    *mean = sum;
    *std = sqrt(squares / (double)(to - from));
}

void readings_describe(const readings_t *readings, size_t from, size_t to, stretch_t *stretch)
{
    for (int i = 0; i < 3; i++) {
        describe_value(readings, from, to, i, &stretch->accel_mps2[i], &stretch->accel_std_mps2[i]);
        describe_value(readings, from, to, 3 + i, &stretch->gyro_radps[i],
                       &stretch->gyro_std_radps[i]);
    }
}

double vector_length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

bool stretch_is_rest(const stretch_t *stretch)
{
    bool is_rest = vector_length(stretch->gyro_radps) < rest_gyro_radps;
    for (int i = 0; i < 3; i++) {
        is_rest = is_rest && stretch->accel_std_mps2[i] < rest_accel_std_mps2 &&
                  stretch->gyro_std_radps[i] < rest_gyro_std_radps;
    }
    return is_rest;
}
