/* SPDX-License-Identifier: MIT */
#include "step_walks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "insole/sense/step.h"
#include "memory.h"
#include "sensor_stream.h"

/* Long enough that where the feet stood at its ends does not matter. */
static const double segment_m = 10.0;

/* The way is measured in legs of this length: jitter of a standing measurement is not walked. */
static const double leg_m = 0.5;

/* Of a segment so much of the time must be steps. */
static const double least_share = 0.5;

/* ---- steps of a session ----------------------------------------------------------------- */

typedef struct {
    insole_step_counter_t counter;
    insole_footfall_t *steps;
    size_t count, room;
    track_t truth;
} session_steps_t;

static void take_reading(session_steps_t *session, const record_t *record)
{
    const double *a = record->value;
    insole_vec3_t accel = insole_vec3(to_real(a[0]), to_real(a[1]), to_real(a[2]));
    insole_footfall_t footfall;
    (void)insole_step_push(&session->counter, to_library_us(record->t_us), accel);
    while (insole_step_next(&session->counter, &footfall) == INSOLE_OK) {
        session->steps =
            memory_room(session->steps, &session->room, session->count + 1u, sizeof footfall);
        session->steps[session->count++] = footfall;
    }
}

static bool read_session(session_steps_t *session, const char *path, const step_source_t *source,
                         failure_t *failure)
{
    sensor_stream_t *stream = memory_new(1u, sizeof *stream);
    record_t record;
    read_t answer = READ_FAILED;
    if (sensor_stream_open(stream, &path, 1u, source->accel_unit, source->gyro_unit, failure)) {
        while ((answer = sensor_stream_next(stream, &record, failure)) == READ_ONE) {
            if (record.kind == RECORD_IMU) {
                take_reading(session, &record);
            } else if (record.kind == RECORD_TRUTH) {
                track_add_record(&session->truth, &record);
            }
        }
    }
    sensor_stream_close(stream);
    free(stream);
    track_sort(&session->truth);
    return answer == READ_END;
}

void step_features(const insole_footfall_t *footfall, double feature[STEP_FEATURES])
{
    const insole_step_length_config_t *config = &insole_step_length_defaults;
    double lasted_s = 1e-6 * (double)(footfall->end_us - footfall->begin_us);
    double range = (double)footfall->range_mps2, sigma = (double)footfall->accel_sigma_mps2;
    feature[STEP_ONE] = 1.0;
    feature[STEP_HZ] = 1.0 / fmin(fmax(lasted_s, (double)config->min_s), (double)config->max_s);
    feature[STEP_VARIANCE] = sigma * sigma;
    feature[STEP_SQUARE_ROOT] = sqrt(range);
    feature[STEP_ROOT] = pow(range, 1.0 / (double)config->root_degree);
}

/* ---- segments --------------------------------------------------------------------------- */

static void add_segment(step_walks_t *walks, const step_segment_t *segment)
{
    walks->segments =
        memory_room(walks->segments, &walks->room, walks->count + 1u, sizeof *segment);
    walks->segments[walks->count++] = *segment;
}

/* Share of the step's time that lies between two times. */
static double share_within(const insole_footfall_t *step, int64_t from_us, int64_t to_us)
{
    int64_t begin_us = to_log_us(step->begin_us), end_us = to_log_us(step->end_us);
    int64_t first_us = begin_us > from_us ? begin_us : from_us;
    int64_t last_us = end_us < to_us ? end_us : to_us;
    return last_us > first_us ? (double)(last_us - first_us) / (double)(end_us - begin_us) : 0.0;
}

/* The steps of a segment of known length between two times. */
static void take_segment(step_walks_t *walks, const insole_footfall_t *steps, size_t count,
                         const track_row_t *from, const track_row_t *to, double distance_m)
{
    step_segment_t segment = {walks->sessions, distance_m, {0.0}};
    double feature[STEP_FEATURES], walked_us = 0.0;
    for (size_t i = 0u; i < count; i++) {
        double share = share_within(&steps[i], from->t_us, to->t_us);
        step_features(&steps[i], feature);
        walked_us += share * (double)(steps[i].end_us - steps[i].begin_us);
        for (int k = 0; k < STEP_FEATURES; k++) {
            segment.sum[k] += share * feature[k];
        }
    }
    if (walked_us < least_share * (double)(to->t_us - from->t_us)) {
        walks->without_steps++;
    } else {
        add_segment(walks, &segment);
    }
}

static void cut_truth(step_walks_t *walks, const insole_footfall_t *steps, size_t count,
                      const track_t *truth)
{
    const track_row_t *begin = truth->rows, *last = begin;
    double way_m = 0.0;
    for (size_t i = 1u; i < truth->count; i++) {
        const track_row_t *row = &truth->rows[i];
        double leg = hypot(row->x_m - last->x_m, row->y_m - last->y_m);
        if (leg < leg_m) {
            continue;
        }
        way_m += leg;
        last = row;
        if (way_m >= segment_m) {
            take_segment(walks, steps, count, begin, row, way_m);
            begin = row;
            way_m = 0.0;
        }
    }
    if (way_m >= 0.5 * segment_m) {
        take_segment(walks, steps, count, begin, last, way_m);
    }
}

static void take_all(step_walks_t *walks, const insole_footfall_t *steps, size_t count,
                     double distance_m)
{
    step_segment_t segment = {walks->sessions, distance_m, {0.0}};
    double feature[STEP_FEATURES];
    for (size_t i = 0u; i < count; i++) {
        step_features(&steps[i], feature);
        for (int k = 0; k < STEP_FEATURES; k++) {
            segment.sum[k] += feature[k];
        }
    }
    add_segment(walks, &segment);
}

void step_walks_add_steps(step_walks_t *walks, const insole_footfall_t *steps, size_t count,
                          const track_t *truth, double distance_m)
{
    if (distance_m > 0.0) {
        take_all(walks, steps, count, distance_m);
    } else {
        cut_truth(walks, steps, count, truth);
    }
    walks->steps += count;
    walks->sessions++;
}

static bool check(const session_steps_t *session, const char *path, double distance_m,
                  failure_t *failure)
{
    if (distance_m == 0.0 && session->truth.count < 2u) {
        return failure_input(failure,
                             "%s: how far was it? Expected truth records, a file t,x,y in the same "
                             "folder, or --distance M",
                             path);
    }
    return session->count > 0u ||
           failure_input(failure, "%s: no steps: expected a walk of five or more", path);
}

bool step_walks_add(step_walks_t *walks, const char *path, const step_source_t *source,
                    failure_t *failure)
{
    session_steps_t *session = memory_new(1u, sizeof *session);
    bool is_good = insole_step_init(&session->counter, &insole_step_defaults) == INSOLE_OK &&
                   read_session(session, path, source, failure) &&
                   check(session, path, source->distance_m, failure);
    if (is_good) {
        step_walks_add_steps(walks, session->steps, session->count, &session->truth,
                             source->distance_m);
    }
    track_free(&session->truth);
    free(session->steps);
    free(session);
    return is_good;
}

void step_walks_free(step_walks_t *walks)
{
    free(walks->segments);
    memset(walks, 0, sizeof *walks);
}
