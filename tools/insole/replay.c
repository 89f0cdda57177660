/* SPDX-License-Identifier: MIT */
#include "replay.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "progress.h"
#include "row_maker.h"

typedef struct {
    const replay_request_t *request;
    const replay_sink_t *sink;
    replay_facts_t *facts;
    sensor_stream_t stream;
    estimator_t estimator;
    row_maker_t rows;
} run_t;

static bool give_events(run_t *run, failure_t *failure)
{
    foot_event_t event;
    while (estimator_event(&run->estimator, &event)) {
        run->facts->strides += event.is_stride ? 1u : 0u;
        run->facts->walked_m += event.is_stride ? event.length_m : 0.0;
        if (run->sink->event != NULL && !run->sink->event(run->sink->context, &event, failure)) {
            return false;
        }
    }
    return true;
}

static bool give_rows(run_t *run, failure_t *failure)
{
    track_row_t row;
    while (row_maker_take(&run->rows, &row)) {
        if (run->sink->row != NULL && !run->sink->row(run->sink->context, &row, failure)) {
            return false;
        }
    }
    return true;
}

/* The fixes that are ready. */
static bool give_fixes(run_t *run, failure_t *failure)
{
    track_row_t fix;
    while (estimator_take(&run->estimator, &fix)) {
        run->facts->first_us = run->facts->fixes == 0u ? fix.t_us : run->facts->first_us;
        run->facts->last_us = fix.t_us;
        run->facts->last = fix;
        run->facts->fixes++;
        row_maker_push(&run->rows, &fix);
        if (!give_rows(run, failure)) {
            return false;
        }
    }
    return true;
}

/* Everything that the tracker can tell by now. */
static bool drain(run_t *run, failure_t *failure)
{
    bool is_good = true;
    while (is_good && estimator_step(&run->estimator)) {
        is_good = give_fixes(run, failure) && give_events(run, failure);
    }
    return is_good;
}

static void tell_start(run_t *run, const record_t *start)
{
    run->facts->start_us = run->facts->knows_place ? run->facts->start_us : start->t_us;
    run->facts->knows_place = true;
    run->facts->knows_heading = run->facts->knows_heading || !isnan(start->value[2]);
    estimator_push(&run->estimator, start);
}

static void begin_at(run_t *run, int64_t first_us)
{
    row_maker_begin(&run->rows, first_us);
    if (run->request->has_start) {
        record_t start = run->request->start;
        start.t_us = first_us;
        tell_start(run, &start);
    }
}

static void push_reading(run_t *run, const record_t *imu)
{
    const double *w = imu->value + 3;
    double rate = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    if (run->facts->readings++ == 0u) {
        begin_at(run, imu->t_us);
    }
    run->facts->fastest_radps = rate > run->facts->fastest_radps ? rate : run->facts->fastest_radps;
    estimator_push(&run->estimator, imu);
}

static void take_record(run_t *run, const record_t *record)
{
    if (record->kind == RECORD_TRUTH) {
        track_add_record(&run->facts->truth, record);
    } else if (record->kind == RECORD_IMU) {
        push_reading(run, record);
    } else if (record->kind == RECORD_START && !run->request->has_start &&
               !run->request->no_start) {
        tell_start(run, record);
    }
}

static bool run_stream(run_t *run, failure_t *failure)
{
    progress_t progress;
    record_t record;
    read_t answer = READ_ONE;
    bool is_good = true;
    progress_begin(&progress);
    while (is_good && (answer = sensor_stream_next(&run->stream, &record, failure)) == READ_ONE) {
        take_record(run, &record);
        is_good = drain(run, failure);
        progress_show(&progress, session_bytes_read(&run->stream.session),
                      run->stream.session.bytes);
    }
    progress_end(&progress);
    if (!is_good || answer == READ_FAILED) {
        return false;
    }
    estimator_finish(&run->estimator);
    if (!drain(run, failure)) {
        return false;
    }
    estimator_settle(&run->estimator);
    return give_fixes(run, failure);
}

static bool open_stream(run_t *run, failure_t *failure)
{
    const replay_request_t *request = run->request;
    return sensor_stream_open(&run->stream, request->logs, request->log_count, request->accel_unit,
                              request->gyro_unit, failure) &&
           (run->sink->begin == NULL ||
            run->sink->begin(run->sink->context, &run->stream.session, failure));
}

static void gather_facts(run_t *run)
{
    const insole_foot_tracker_t *foot = &run->estimator.foot;
    memcpy(run->facts->seen, run->stream.seen, sizeof run->facts->seen);
    run->facts->screen = foot->screen.counts;
    run->facts->foot = foot->counts;
    run->facts->gravity_mps2 = (double)foot->still_bias.gravity_mps2;
    run->facts->rests = foot->still_bias.rests;
}

bool replay_run(const replay_request_t *request, const replay_sink_t *sink, replay_facts_t *facts,
                failure_t *failure)
{
    run_t *run = memory_new(1u, sizeof *run);
    memset(facts, 0, sizeof *facts);
    run->request = request;
    run->sink = sink;
    run->facts = facts;
    row_maker_init(&run->rows, request->rate_hz);
    bool is_good = estimator_init(&run->estimator, &request->settings, request->is_smooth) ||
                   failure_input(failure, "insole: the tracker does not take these settings");
    is_good = is_good && open_stream(run, failure) && run_stream(run, failure);
    gather_facts(run);
    sensor_stream_close(&run->stream);
    estimator_free(&run->estimator);
    free(run);
    return is_good;
}

void replay_facts_free(replay_facts_t *facts)
{
    track_free(&facts->truth);
}
