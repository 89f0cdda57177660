/* SPDX-License-Identifier: MIT */
#include "reproduce.h"

#ifdef INSOLE_HOST_HAS_SIMULATOR

#include <stdlib.h>
#include <string.h>

#include "columns.h"
#include "config_keys.h"
#include "memory.h"
#include "platform.h"
#include "progress.h"
#include "score.h"
#include "session.h"
#include "sim/write.h"
#include "statistics.h"
#include "track_reader.h"

/* Surveys have seeds of their own: what their radio hears by chance the walk's does not. */
static const uint64_t first_survey = UINT64_C(1) << 40;

/* Columns of the footfalls. */
enum { STEP_KIND, STEP_TIME, STEP_FOOT, STEP_COLUMNS };

/* A place told so vaguely is none: the particles begin where radio says. */
static const double vague_place_m = 900.0;

static bool set_all(settings_t *settings, const char *const *pairs, failure_t *failure)
{
    settings_init(settings);
    for (; *pairs != NULL; pairs++) {
        if (!config_set_pair(settings, *pairs, failure)) {
            return false;
        }
    }
    return true;
}

bool reproduce_begin(reproduction_t *reproduction, const reproduce_paper_t *paper,
                     const reproduce_request_t *request, failure_t *failure)
{
    static const char *const none[] = {NULL};
    memset(reproduction, 0, sizeof *reproduction);
    reproduction->paper = paper;
    reproduction->request = *request;
    for (int i = 0; i < paper->row_count; i++) {
        reproduction->results[i].walks =
            memory_new((size_t)request->runs, sizeof *reproduction->results[i].walks);
    }
    if (request->out != NULL && !platform_make_folder(request->out)) {
        return failure_input(failure, "%s: cannot be made", request->out);
    }
    reproduction->folder = platform_scratch_folder();
    if (reproduction->folder == NULL) {
        return failure_input(failure, "insole: no folder for the walks can be made: TMPDIR names "
                                      "where");
    }
    return set_all(&reproduction->paper_settings, paper->settings, failure) &&
           set_all(&reproduction->our_settings, none, failure);
}

/* ---- a walk ----------------------------------------------------------------------------- */

static void drop_walk(reproduction_t *reproduction)
{
    for (int i = 0; i < reproduction->paper->row_count; i++) {
        track_free(&reproduction->tracks[i]);
    }
    track_free(&reproduction->truth);
    site_free(&reproduction->site);
    site_free(&reproduction->bare);
    memset(reproduction->tracks, 0, sizeof reproduction->tracks);
    memset(&reproduction->truth, 0, sizeof reproduction->truth);
    memset(&reproduction->site, 0, sizeof reproduction->site);
    memset(&reproduction->bare, 0, sizeof reproduction->bare);
}

static bool is_counted(const reproduction_t *reproduction, int64_t t_us)
{
    return 1e-6 * (double)t_us >= reproduction->paper->begin_s;
}

static void add_place(reproduction_t *reproduction, const track_t *whole, double t_s)
{
    track_row_t row;
    memset(&row, 0, sizeof row);
    row.t_us = (int64_t)(1e6 * t_s + 0.5);
    if (is_counted(reproduction, row.t_us) && track_place(whole, row.t_us, &row.x_m, &row.y_m)) {
        track_add(&reproduction->truth, &row);
    }
}

/* Of a walker who turns on the spot no step leads anywhere. */
static read_t read_step(reproduction_t *reproduction, const track_t *whole, columns_t *steps,
                        failure_t *failure)
{
    double t_s = 0.0;
    read_t answer = columns_next(steps, failure);
    const char *kind = answer == READ_ONE ? columns_id(steps, failure) : NULL;
    if (answer != READ_ONE) {
        return answer;
    }
    if (kind == NULL || !columns_number(steps, STEP_TIME, &t_s, failure)) {
        return READ_FAILED;
    }
    if (strcmp(kind, "shuffle") != 0) {
        add_place(reproduction, whole, t_s);
    }
    return READ_ONE;
}

static bool take_steps(reproduction_t *reproduction, const track_t *whole, failure_t *failure)
{
    static const column_t columns[STEP_COLUMNS] = {[STEP_KIND] = {"kind", 0.0, 0.0},
                                                   [STEP_TIME] = {"t", 0.0, 1e6},
                                                   [STEP_FOOT] = {"foot", 0.0, 0.0}};
    static const columns_layout_t layout = {columns, STEP_COLUMNS, STEP_COLUMNS, STEP_KIND};
    columns_t steps;
    read_t answer = READ_FAILED;
    char *path = platform_join(reproduction->folder, "steps.csv");
    if (columns_open(&steps, &layout, path, failure)) {
        do {
            answer = read_step(reproduction, whole, &steps, failure);
        } while (answer == READ_ONE);
        columns_close(&steps);
    }
    free(path);
    return answer == READ_END;
}

static void take_all(reproduction_t *reproduction, const track_t *whole)
{
    for (size_t i = 0u; i < whole->count; i++) {
        if (is_counted(reproduction, whole->rows[i].t_us)) {
            track_add(&reproduction->truth, &whole->rows[i]);
        }
    }
}

static bool read_truth(reproduction_t *reproduction, failure_t *failure)
{
    track_t whole = {NULL, 0u, 0u};
    char *path = platform_join(reproduction->folder, "truth.csv");
    bool is_good = track_read(&whole, path, failure);
    if (is_good && reproduction->paper->scored == REPRODUCE_AT_STEPS) {
        is_good = take_steps(reproduction, &whole, failure);
    } else if (is_good) {
        take_all(reproduction, &whole);
    }
    track_free(&whole);
    free(path);
    return is_good;
}

static bool open_walk(reproduction_t *reproduction, failure_t *failure)
{
    const insole_propagation_config_t *propagation = &reproduction->our_settings.propagation;
    char *plan = platform_join(reproduction->folder, "plan.csv");
    char *aps = platform_join(reproduction->folder, "aps.csv");
    char *map = reproduction->paper->survey != NULL
                    ? platform_join(reproduction->folder, "radiomap.csv")
                    : NULL;
    bool is_good = site_open(&reproduction->site, plan, aps, map, propagation, failure) &&
                   site_open(&reproduction->bare, NULL, aps, map, propagation, failure) &&
                   read_truth(reproduction, failure);
    free(plan);
    free(aps);
    free(map);
    return is_good;
}

static bool simulate(const reproduction_t *reproduction, const char *name, uint64_t seed,
                     failure_t *failure)
{
    char error[sizeof failure->text];
    char *scenario = platform_join(reproduction->request.maps, name);
    int status =
        sim_write_scenario(scenario, reproduction->folder, seed, NULL, error, sizeof error);
    free(scenario);
    if (status != 0) {
        failure_input(failure, "%s", error);
        return failure_add(failure, " (--maps DIR tells where the maps are)");
    }
    return true;
}

/* What the survey leaves is overwritten by the walk, but for the radio map. */
static bool make_walk(reproduction_t *reproduction, failure_t *failure)
{
    const reproduce_paper_t *paper = reproduction->paper;
    return (paper->survey == NULL ||
            simulate(reproduction, paper->survey, reproduction->seed + first_survey, failure)) &&
           simulate(reproduction, paper->scenario, reproduction->seed, failure) &&
           open_walk(reproduction, failure);
}

/* ---- a row on it ------------------------------------------------------------------------ */

static bool find_start(const char *log, record_t *start, failure_t *failure)
{
    session_t session;
    bool is_found = false;
    bool is_open = session_open(&session, &log, 1u, failure);
    while (is_open && !is_found && session_next(&session, start, failure) == READ_ONE) {
        is_found = start->kind == RECORD_START;
    }
    session_close(&session);
    return is_found || (is_open && failure_input(failure, "%s: no start record", log));
}

/* A phone's methods know how many they want. */
static uint32_t particles_of(method_t method)
{
    return method_tracker(method) == TRACKER_PHONE ? 0u : (uint32_t)REPLAY_PARTICLES;
}

bool reproduce_replay(const reproduction_t *reproduction, const reproduce_row_t *row,
                      const replay_sink_t *sink, failure_t *failure)
{
    char *log = platform_join(reproduction->folder, "log.csv");
    const char *const logs[] = {log};
    replay_facts_t facts;
    replay_request_t request = {.logs = logs,
                                .log_count = 1u,
                                .settings = row->is_ours ? reproduction->our_settings
                                                         : reproduction->paper_settings,
                                .tracker = method_tracker(row->method),
                                .method = row->method,
                                .site = row->lacks_plan ? &reproduction->bare : &reproduction->site,
                                .particles = particles_of(row->method),
                                .seed = reproduction->seed,
                                .rate_hz = 10.0,
                                .has_start = row->starts_by_radio};
    bool is_good =
        (row->setting == NULL || config_set_pair(&request.settings, row->setting, failure)) &&
        (!row->starts_by_radio || find_start(log, &request.start, failure));
    if (is_good) {
        request.start.value[3] = vague_place_m;
        is_good = replay_run(&request, sink, &facts, failure);
        replay_facts_free(&facts);
    }
    free(log);
    return is_good;
}

static bool keep_row(void *context, const track_row_t *row, failure_t *failure)
{
    (void)failure;
    track_add(context, row);
    return true;
}

static reproduce_figures_t figures_of(const double *errors_m, size_t count)
{
    reproduce_figures_t figures = {.m = {[REPRODUCE_MIN] = count > 0u ? errors_m[0] : 0.0,
                                         [REPRODUCE_MEAN] = statistics_mean(errors_m, count),
                                         [REPRODUCE_RMS] = statistics_rms(errors_m, count),
                                         [REPRODUCE_STD] = statistics_std(errors_m, count)}};
    for (size_t i = 0u; i < count; i++) {
        double *max_m = &figures.m[REPRODUCE_MAX], *min_m = &figures.m[REPRODUCE_MIN];
        *max_m = errors_m[i] > *max_m ? errors_m[i] : *max_m;
        *min_m = errors_m[i] < *min_m ? errors_m[i] : *min_m;
    }
    return figures;
}

static void score_row(reproduction_t *reproduction, int row, int walk)
{
    reproduce_result_t *result = &reproduction->results[row];
    size_t count = reproduction->truth.count;
    result->errors_m = memory_room(result->errors_m, &result->error_room,
                                   result->error_count + count, sizeof *result->errors_m);
    double *errors_m = result->errors_m + result->error_count;
    score_errors(&reproduction->tracks[row], &reproduction->truth, errors_m);
    result->error_count += count;
    result->walks[walk] = figures_of(errors_m, count);
}

static bool measure_row(reproduction_t *reproduction, int row, int walk, failure_t *failure)
{
    const replay_sink_t sink = {&reproduction->tracks[row], NULL, keep_row, NULL};
    if (!reproduce_replay(reproduction, &reproduction->paper->rows[row], &sink, failure)) {
        return false;
    }
    score_row(reproduction, row, walk);
    return true;
}

/* ---- all walks -------------------------------------------------------------------------- */

static bool measure_walk(reproduction_t *reproduction, int walk, progress_t *progress,
                         failure_t *failure)
{
    const reproduce_paper_t *paper = reproduction->paper;
    int all = reproduction->request.runs * paper->row_count;
    reproduction->seed = reproduction->request.seed + (uint64_t)walk;
    bool is_good = make_walk(reproduction, failure);
    for (int row = 0; is_good && row < paper->row_count; row++) {
        is_good = measure_row(reproduction, row, walk, failure);
        progress_step(progress, (unsigned long long)(walk * paper->row_count + row + 1),
                      (unsigned long long)all);
    }
    if (is_good && walk == 0 && reproduction->request.out != NULL) {
        is_good = paper->draw_walk(reproduction, failure);
    }
    drop_walk(reproduction);
    return is_good;
}

bool reproduce_measure(reproduction_t *reproduction, failure_t *failure)
{
    progress_t progress;
    bool is_good = true;
    progress_begin(&progress);
    for (int walk = 0; is_good && walk < reproduction->request.runs; walk++) {
        is_good = measure_walk(reproduction, walk, &progress, failure);
    }
    progress_end(&progress);
    return is_good && (reproduction->request.out == NULL ||
                       reproduction->paper->draw_all(reproduction, failure));
}

void reproduce_free(reproduction_t *reproduction)
{
    for (int i = 0; i < REPRODUCE_ROWS; i++) {
        free(reproduction->results[i].walks);
        free(reproduction->results[i].errors_m);
    }
    if (reproduction->folder != NULL) {
        platform_remove_folder(reproduction->folder);
    }
    free(reproduction->folder);
}

#endif
