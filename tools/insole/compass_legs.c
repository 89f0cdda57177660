/* SPDX-License-Identifier: MIT */
#include "compass_legs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "insole/move/attitude_ekf.h"
#include "insole/move/heading.h"
#include "insole/move/magnetic.h"
#include "memory.h"
#include "sensor_stream.h"
#include "track.h"

enum { FEWEST_SESSIONS = 5 };

/* A way is straight when this long before and after it leads the same way, within so much. */
static const int64_t around_us = 1000000;
static const double straight_rad = 0.2, slowest_mps = 0.5;

/* A leg lasts no longer than the first, no shorter than the second. */
static const int64_t leg_us = 5000000, shortest_leg_us = 2000000, gap_us = 500000;

/* Compass minus heading, in the level frame. */
typedef struct {
    int64_t t_us;
    double turn_rad;
} sight_t;

typedef struct {
    insole_attitude_t attitude;
    sight_t *sights;
    size_t count, room;
    track_t truth;
} reader_t;

/* ---- one session ------------------------------------------------------------------------ */

static insole_vec3_t vector_of(const double value[3])
{
    return insole_vec3(to_real(value[0]), to_real(value[1]), to_real(value[2]));
}

static void take_field(reader_t *reader, const record_t *record)
{
    insole_real_t azimuth_rad;
    if (insole_magnetic_azimuth(&reader->attitude, vector_of(record->value), &azimuth_rad) !=
        INSOLE_OK) {
        return;
    }
    insole_heading_t heading = insole_heading(reader->attitude.q, NULL);
    const sight_t sight = {record->t_us, (double)azimuth_rad - (double)heading.heading_rad};
    reader->sights = memory_room(reader->sights, &reader->room, reader->count + 1u, sizeof sight);
    reader->sights[reader->count++] = sight;
}

static void take_record(reader_t *reader, const record_t *record)
{
    if (record->kind == RECORD_IMU) {
        const insole_imu_t imu = {to_library_us(record->t_us), vector_of(record->value),
                                  vector_of(record->value + 3)};
        (void)insole_attitude_push(&reader->attitude, insole_attitude_ekf, &imu, 0u);
    } else if (record->kind == RECORD_MAG) {
        take_field(reader, record);
    } else if (record->kind == RECORD_TRUTH) {
        track_add_record(&reader->truth, record);
    }
}

static bool read_session(reader_t *reader, const char *path, const char *accel_unit,
                         const char *gyro_unit, failure_t *failure)
{
    sensor_stream_t *stream = memory_new(1u, sizeof *stream);
    record_t record;
    read_t answer = READ_FAILED;
    if (sensor_stream_open(stream, &path, 1u, accel_unit, gyro_unit, failure)) {
        while ((answer = sensor_stream_next(stream, &record, failure)) == READ_ONE) {
            take_record(reader, &record);
        }
    }
    sensor_stream_close(stream);
    free(stream);
    track_sort(&reader->truth);
    return answer == READ_END;
}

/* ---- legs ------------------------------------------------------------------------------- */

static double wrap(double angle_rad)
{
    return atan2(sin(angle_rad), cos(angle_rad));
}

/* Direction of the truth from one time to another. @return false: it stands, or is not known */
static bool find_way(const track_t *truth, int64_t from_us, int64_t to_us, double *way_rad)
{
    double x0, y0, x1, y1;
    if (!track_place(truth, from_us, &x0, &y0) || !track_place(truth, to_us, &x1, &y1)) {
        return false;
    }
    *way_rad = atan2(y1 - y0, x1 - x0);
    return hypot(x1 - x0, y1 - y0) >= slowest_mps * 1e-6 * (double)(to_us - from_us);
}

static bool find_straight(const track_t *truth, int64_t t_us, double *way_rad)
{
    double before_rad, after_rad;
    return find_way(truth, t_us - around_us, t_us, &before_rad) &&
           find_way(truth, t_us, t_us + around_us, &after_rad) &&
           find_way(truth, t_us - around_us, t_us + around_us, way_rad) &&
           fabs(wrap(after_rad - before_rad)) <= straight_rad;
}

/* The leg in the making. */
typedef struct {
    int64_t begin_us, end_us;
    double way_rad; /* of its first sight */
    double cos_sum, sin_sum;
    size_t count;
} leg_t;

static void close_leg(compass_legs_t *legs, leg_t *leg)
{
    if (leg->count > 0u && leg->end_us - leg->begin_us >= shortest_leg_us) {
        const compass_leg_t made = {legs->sessions, atan2(leg->sin_sum, leg->cos_sum)};
        legs->legs = memory_room(legs->legs, &legs->room, legs->count + 1u, sizeof made);
        legs->legs[legs->count++] = made;
    }
    memset(leg, 0, sizeof *leg);
}

static bool goes_on(const leg_t *leg, int64_t t_us, double way_rad)
{
    return leg->count > 0u && t_us - leg->end_us <= gap_us && t_us - leg->begin_us <= leg_us &&
           fabs(wrap(way_rad - leg->way_rad)) <= straight_rad;
}

static void add_sight(compass_legs_t *legs, leg_t *leg, const sight_t *sight, double way_rad)
{
    double north_rad = way_rad + sight->turn_rad;
    if (!goes_on(leg, sight->t_us, way_rad)) {
        close_leg(legs, leg);
        leg->begin_us = sight->t_us;
        leg->way_rad = way_rad;
    }
    leg->end_us = sight->t_us;
    leg->cos_sum += cos(north_rad);
    leg->sin_sum += sin(north_rad);
    leg->count++;
}

static void make_legs(compass_legs_t *legs, const reader_t *reader)
{
    leg_t leg;
    double way_rad;
    memset(&leg, 0, sizeof leg);
    for (size_t i = 0u; i < reader->count; i++) {
        if (find_straight(&reader->truth, reader->sights[i].t_us, &way_rad)) {
            add_sight(legs, &leg, &reader->sights[i], way_rad);
        }
    }
    close_leg(legs, &leg);
    legs->sessions++;
}

static bool check(const reader_t *reader, const char *path, failure_t *failure)
{
    if (reader->truth.count < 2u) {
        return failure_input(failure,
                             "%s: no truth: expected truth records, or a file t,x,y in the same "
                             "folder",
                             path);
    }
    return reader->count > 0u || failure_input(failure,
                                               "%s: no magnetic field: expected mag records, or "
                                               "columns mx,my,mz beside ax,ay,az,gx,gy,gz",
                                               path);
}

bool compass_legs_add(compass_legs_t *legs, const char *path, const char *accel_unit,
                      const char *gyro_unit, failure_t *failure)
{
    reader_t reader;
    memset(&reader, 0, sizeof reader);
    bool is_good = insole_attitude_init(&reader.attitude, &insole_attitude_defaults) == INSOLE_OK &&
                   read_session(&reader, path, accel_unit, gyro_unit, failure) &&
                   check(&reader, path, failure);
    if (is_good) {
        make_legs(legs, &reader);
    }
    track_free(&reader.truth);
    free(reader.sights);
    return is_good;
}

/* ---- mean ------------------------------------------------------------------------------- */

/* Legs that err together, those of a session or each by itself, pull the mean together. */
static double error_of(const compass_legs_t *legs, double north_rad)
{
    bool is_by_session = legs->sessions >= FEWEST_SESSIONS;
    double squares = 0.0, pull = 0.0, groups = 0.0;
    for (size_t i = 0u; i < legs->count; i++) {
        bool is_last = i + 1u == legs->count || !is_by_session ||
                       legs->legs[i + 1u].session != legs->legs[i].session;
        pull += wrap(legs->legs[i].north_rad - north_rad);
        if (is_last) {
            squares += pull * pull;
            groups += 1.0;
            pull = 0.0;
        }
    }
    return sqrt(squares * groups / fmax(1.0, groups - 1.0)) / (double)legs->count;
}

void compass_legs_mean(const compass_legs_t *legs, compass_north_t *north)
{
    double cos_sum = 0.0, sin_sum = 0.0, squares = 0.0;
    for (size_t i = 0u; i < legs->count; i++) {
        cos_sum += cos(legs->legs[i].north_rad);
        sin_sum += sin(legs->legs[i].north_rad);
    }
    north->north_rad = atan2(sin_sum, cos_sum);
    for (size_t i = 0u; i < legs->count; i++) {
        double off_rad = wrap(legs->legs[i].north_rad - north->north_rad);
        squares += off_rad * off_rad;
    }
    north->scatter_rad = sqrt(squares / (double)legs->count);
    north->error_rad = error_of(legs, north->north_rad);
}

void compass_legs_free(compass_legs_t *legs)
{
    free(legs->legs);
    memset(legs, 0, sizeof *legs);
}
