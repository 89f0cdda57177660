/* SPDX-License-Identifier: MIT */
#include "replay.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
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
    event_t event;
    while (estimator_event(&run->estimator, &event)) {
        bool is_pace = event.kind == EVENT_STRIDE || event.kind == EVENT_STEP;
        run->facts->strides += is_pace ? 1u : 0u;
        run->facts->walked_m += event.length_m;
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

/* Radio has put a track on the map that no start did. */
static void note_place(run_t *run, const track_row_t *fix)
{
    bool is_somewhere = fix->state == INSOLE_FIX_TRACK || fix->state == INSOLE_FIX_SEARCH;
    if (!run->facts->knows_place && is_somewhere && estimator_is_placed(&run->estimator)) {
        run->facts->knows_place = run->facts->knows_heading = true;
        run->facts->start_us = fix->t_us;
    }
}

static const insole_floor_plan_t *plan_of(const run_t *run)
{
    return run->request->site != NULL ? run->request->site->building.plan : NULL;
}

/* A track that walls stand in or that is a little beside its corridor is no track elsewhere. */
static void note_outside(run_t *run, const track_row_t *fix)
{
    static const insole_real_t well_outside_m = INSOLE_R(2.0);
    const insole_floor_plan_t *plan = plan_of(run);
    insole_real_t x_m = to_real(fix->x_m), y_m = to_real(fix->y_m), distance_m = well_outside_m;
    if (plan == NULL || !run->facts->knows_place || insole_floor_plan_inside(plan, x_m, y_m)) {
        return;
    }
    (void)insole_floor_plan_clearance(plan, x_m, y_m, well_outside_m, &distance_m);
    run->facts->fusion.outside += distance_m < well_outside_m ? 0u : 1u;
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
        run->facts->states[fix.state]++;
        note_place(run, &fix);
        note_outside(run, &fix);
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

/* A start where the plan says that nobody can be. */
static void check_start(run_t *run, const record_t *start)
{
    const insole_floor_plan_t *plan = plan_of(run);
    insole_real_t x_m = to_real(start->value[0]), y_m = to_real(start->value[1]);
    insole_real_t distance_m = (insole_real_t)REPLAY_FAR_M;
    if (plan != NULL && !insole_floor_plan_inside(plan, x_m, y_m)) {
        (void)insole_floor_plan_clearance(plan, x_m, y_m, distance_m, &distance_m);
        run->facts->fusion.starts_outside = true;
        run->facts->fusion.start_distance_m = (double)distance_m;
    }
}

static void tell_start(run_t *run, const record_t *start)
{
    if (method_is_radio_alone(run->request->method)) {
        return;
    }
    run->facts->start_us = run->facts->knows_place ? run->facts->start_us : start->t_us;
    run->facts->knows_place = true;
    run->facts->knows_heading = run->facts->knows_heading || !isnan(start->value[2]);
    check_start(run, start);
    estimator_push(&run->estimator, start);
}

/* Of radio alone each fix is a row; the IMU makes rows due. */
static void begin_at(run_t *run, int64_t first_us)
{
    row_maker_init(&run->rows, run->request->rate_hz);
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

/* Index of an access point, in the file that the tracker uses. */
static uint32_t number_of(const run_t *run, uint32_t id)
{
    const site_t *site = run->request->site;
    const id_table_t *ids = &run->stream.session.ids;
    return run->estimator.is_phone ? radiomap_file_number(&site->radiomap_file, ids, id)
                                   : ap_file_number(&site->ap_file, ids, id);
}

/* Ids of the log become indexes of access points. */
static void push_radio(run_t *run, const record_t *record)
{
    const replay_request_t *request = run->request;
    record_t known = *record;
    bool is_left_out = record->kind == RECORD_RSS ? request->no_rss : request->no_range;
    if (request->site != NULL && !is_left_out) {
        known.id = number_of(run, record->id);
        estimator_push(&run->estimator, &known);
    }
}

static void take_record(run_t *run, const record_t *record)
{
    if (record->kind == RECORD_TRUTH) {
        track_add_record(&run->facts->truth, record);
    } else if (record->kind == RECORD_IMU) {
        push_reading(run, record);
    } else if (record->kind == RECORD_RSS || record->kind == RECORD_RANGE) {
        push_radio(run, record);
    } else if (record->kind == RECORD_MAG) {
        estimator_push(&run->estimator, record);
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
    bool is_good = sensor_stream_open(&run->stream, request->logs, request->log_count,
                                      request->accel_unit, request->gyro_unit, failure);
    run->stream.is_radio_enough = method_is_radio_alone(request->method);
    return is_good && (run->sink->begin == NULL ||
                       run->sink->begin(run->sink->context, &run->stream.session, failure));
}

/* ---- facts ------------------------------------------------------------------------------ */

static void count_ids(const run_t *run, replay_fusion_t *facts)
{
    const id_table_t *ids = &run->stream.session.ids;
    facts->ids = ids->count;
    for (size_t i = 0u; i < ids->count && run->request->site != NULL; i++) {
        facts->unknown_ids += number_of(run, (uint32_t)i) == AP_FILE_UNKNOWN ? 1u : 0u;
    }
}

static void copy_cloud(const insole_fusion_memory_t *memory, track_t *cloud)
{
    track_row_t row;
    memset(&row, 0, sizeof row);
    for (uint32_t i = 0u; i < memory->count; i++) {
        if (insole_particle_lives(&memory->particles[i])) {
            row.x_m = (double)memory->particles[i].x_m;
            row.y_m = (double)memory->particles[i].y_m;
            track_add(cloud, &row);
        }
    }
}

static void gather_cloud(const foot_estimator_t *foot, replay_fusion_t *facts)
{
    const insole_particle_filter_t *particles = &foot->fusion.particles;
    facts->waits = foot->fusion.radio.counts;
    facts->starts = foot->fusion.counts.starts;
    facts->particles = particles->counts;
    facts->has_offset = particles->field.learned > 0u;
    facts->offset_db = (double)particles->field.offset_db;
    if (particles->has_fix) {
        copy_cloud(&foot->memory, &facts->cloud);
    }
}

static void gather_fusion(const run_t *run, replay_fusion_t *facts)
{
    const foot_estimator_t *foot = &run->estimator.foot;
    const insole_building_t *building = &foot->building;
    facts->is_fused = foot->is_fused || run->request->method == METHOD_WIFI;
    facts->walls = building->plan != NULL ? building->plan->wall_count : 0u;
    facts->aps = building->ap_count;
    facts->radio = foot->counts;
    facts->leaves_radiomap = run->request->leaves_radiomap;
    count_ids(run, facts);
    gather_cloud(foot, facts);
}

static void gather_foot(run_t *run)
{
    const insole_foot_tracker_t *foot = &run->estimator.foot.fusion.foot;
    run->facts->screen = foot->screen.counts;
    run->facts->foot = foot->counts;
    run->facts->gravity_mps2 = (double)foot->still_bias.gravity_mps2;
    run->facts->rests = foot->still_bias.rests;
    gather_fusion(run, &run->facts->fusion);
}

/* The particles of a phone, and the plan they walk in. */
static void gather_flock(const phone_parts_t *parts, replay_facts_t *facts)
{
    const insole_floor_plan_t *plan = parts->step_cloud.building.plan;
    bool has_flock = parts->memory.particles != NULL;
    facts->phone.particles = has_flock ? parts->memory.count : 0u;
    facts->fusion.walls = has_flock && plan != NULL ? plan->wall_count : 0u;
}

static void gather_phone(run_t *run)
{
    const phone_estimator_t *phone = &run->estimator.phone;
    const insole_radio_map_t *map = phone->parts.map;
    replay_phone_t *facts = &run->facts->phone;
    for (int k = 0; k < INSOLE_CARRY_POSITIONS; k++) {
        facts->carried[k] = phone->carried[k];
    }
    run->facts->screen = phone->tracker.screen.counts;
    run->facts->gravity_mps2 = (double)phone->tracker.still_bias.gravity_mps2;
    run->facts->rests = phone->tracker.still_bias.rests;
    run->facts->fusion.radio = phone->counts;
    gather_flock(&phone->parts, run->facts);
    count_ids(run, &run->facts->fusion);
    facts->points = map != NULL ? map->point_count : 0u;
    facts->aps = map != NULL ? map->ap_count : 0u;
    facts->unplaced = phone->tracker.radio.unplaced;
    facts->magnetic = phone->tracker.counts.magnetic;
    facts->starts = phone->tracker.place.starts;
    facts->gaps = phone->tracker.counts.gaps;
}

static void gather_facts(run_t *run)
{
    memcpy(run->facts->seen, run->stream.seen, sizeof run->facts->seen);
    run->facts->method = run->request->method;
    if (run->estimator.is_phone) {
        gather_phone(run);
    } else {
        gather_foot(run);
    }
}

static estimator_setup_t setup_of(const replay_request_t *request)
{
    const site_t *site = request->site;
    estimator_setup_t setup = {.settings = &request->settings,
                               .method = request->method,
                               .building = site != NULL ? &site->building : NULL,
                               .particles = request->particles,
                               .seed = request->seed,
                               .is_smooth = request->is_smooth};
    setup.map = site != NULL && site_has_radiomap(site) ? &site->radiomap_file.map : NULL;
    return setup;
}

bool replay_run(const replay_request_t *request, const replay_sink_t *sink, replay_facts_t *facts,
                failure_t *failure)
{
    run_t *run = memory_new(1u, sizeof *run);
    const estimator_setup_t setup = setup_of(request);
    memset(facts, 0, sizeof *facts);
    run->request = request;
    run->sink = sink;
    run->facts = facts;
    row_maker_init(&run->rows, method_is_radio_alone(request->method) ? 0.0 : request->rate_hz);
    bool is_good = estimator_init(&run->estimator, &setup) ||
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
    track_free(&facts->fusion.cloud);
}
