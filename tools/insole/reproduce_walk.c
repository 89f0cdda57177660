/* SPDX-License-Identifier: MIT */
#include "reproduce_walk.h"

#include <stdlib.h>
#include <string.h>

#include "columns.h"
#include "config_keys.h"
#include "memory.h"
#include "number.h"
#include "platform.h"
#include "session.h"
#include "sim/write.h"
#include "track_reader.h"

/* Surveys have seeds of their own: what their radio hears by chance the walk's does not. */
static const uint64_t first_survey = UINT64_C(1) << 40;

/* Columns of the footfalls. */
enum { STEP_KIND, STEP_TIME, STEP_FOOT, STEP_COLUMNS };

/* A place told so vaguely is none: the particles begin where radio says. */
static const double vague_place_m = 900.0;

/* ---- scenarios -------------------------------------------------------------------------- */

bool reproduce_simulate(const char *maps, const char *scenario, const char *folder, uint64_t seed,
                        const char *set, failure_t *failure)
{
    char error[sizeof failure->text];
    char *path = platform_join(maps, scenario);
    int status = sim_write_scenario_with(path, folder, seed, set, NULL, error, sizeof error);
    free(path);
    if (status != 0) {
        failure_input(failure, "%s", error);
        return failure_add(failure, " (--maps DIR tells where the maps are)");
    }
    return true;
}

static bool survey_for(const reproduction_t *reproduction, uint64_t seed, failure_t *failure)
{
    return reproduce_simulate(reproduction->request.maps, reproduction->paper->survey,
                              reproduction->folder, seed + first_survey, NULL, failure);
}

bool reproduce_survey(const reproduction_t *reproduction, failure_t *failure)
{
    return !reproduction->paper->shares_survey || survey_for(reproduction, 0u, failure);
}

/* ---- truth ------------------------------------------------------------------------------ */

static bool is_counted(const reproduction_t *reproduction, int64_t t_us)
{
    return 1e-6 * (double)t_us >= reproduction->paper->begin_s;
}

static void add_place(reproduction_t *reproduction, double t_s)
{
    track_row_t row;
    memset(&row, 0, sizeof row);
    row.t_us = (int64_t)(1e6 * t_s + 0.5);
    if (is_counted(reproduction, row.t_us) &&
        track_place(&reproduction->whole, row.t_us, &row.x_m, &row.y_m)) {
        track_add(&reproduction->truth, &row);
    }
}

/* Of a walker who turns on the spot no step leads anywhere. */
static read_t read_step(reproduction_t *reproduction, columns_t *steps, failure_t *failure)
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
        add_place(reproduction, t_s);
    }
    return READ_ONE;
}

static bool take_steps(reproduction_t *reproduction, failure_t *failure)
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
            answer = read_step(reproduction, &steps, failure);
        } while (answer == READ_ONE);
        columns_close(&steps);
    }
    free(path);
    return answer == READ_END;
}

static void take_all(reproduction_t *reproduction)
{
    const track_t *whole = &reproduction->whole;
    for (size_t i = 0u; i < whole->count; i++) {
        if (is_counted(reproduction, whole->rows[i].t_us)) {
            track_add(&reproduction->truth, &whole->rows[i]);
        }
    }
}

static bool read_truth(reproduction_t *reproduction, failure_t *failure)
{
    char *path = platform_join(reproduction->folder, "truth.csv");
    bool is_good = track_read(&reproduction->whole, path, failure);
    free(path);
    if (is_good && reproduction->paper->scored == REPRODUCE_AT_STEPS) {
        return take_steps(reproduction, failure);
    }
    take_all(reproduction);
    return is_good;
}

/* ---- a walk ----------------------------------------------------------------------------- */

static bool open_sites(reproduction_t *reproduction, failure_t *failure)
{
    const insole_propagation_config_t *propagation = &reproduction->our_settings.propagation;
    char *plan = platform_join(reproduction->folder, "plan.csv");
    char *aps = platform_join(reproduction->folder, "aps.csv");
    char *map = reproduction->paper->survey != NULL
                    ? platform_join(reproduction->folder, "radiomap.csv")
                    : NULL;
    bool is_good = site_open(&reproduction->site, plan, aps, map, propagation, failure) &&
                   site_open(&reproduction->bare, NULL, aps, map, propagation, failure) &&
                   site_open(&reproduction->deaf, NULL, aps, NULL, propagation, failure);
    free(plan);
    free(aps);
    free(map);
    return is_good;
}

/* What the survey leaves is overwritten by the walk, but for the radio map. */
bool reproduce_open_walk(reproduction_t *reproduction, int walk, failure_t *failure)
{
    const reproduce_paper_t *paper = reproduction->paper;
    bool has_survey = paper->survey != NULL && !paper->shares_survey;
    reproduction->seed = reproduction->request.seed + (uint64_t)walk;
    reproduction->kind = paper->kinds != NULL
                             ? &paper->kinds[reproduction->seed % (uint64_t)paper->kind_count]
                             : NULL;
    return (!has_survey || survey_for(reproduction, reproduction->seed, failure)) &&
           reproduce_simulate(reproduction->request.maps, paper->scenario, reproduction->folder,
                              reproduction->seed,
                              reproduction->kind != NULL ? reproduction->kind->scenario : NULL,
                              failure) &&
           open_sites(reproduction, failure) && read_truth(reproduction, failure);
}

static void drop_track(track_t *track)
{
    track_free(track);
    memset(track, 0, sizeof *track);
}

static void drop_site(site_t *site)
{
    site_free(site);
    memset(site, 0, sizeof *site);
}

void reproduce_close_walk(reproduction_t *reproduction)
{
    for (int i = 0; i < reproduction->paper->row_count; i++) {
        drop_track(&reproduction->tracks[i]);
    }
    drop_track(&reproduction->whole);
    drop_track(&reproduction->truth);
    drop_site(&reproduction->site);
    drop_site(&reproduction->bare);
    drop_site(&reproduction->deaf);
}

/* ---- settings --------------------------------------------------------------------------- */

bool reproduce_set(settings_t *settings, const char *const *pairs, failure_t *failure)
{
    settings_init(settings);
    for (; *pairs != NULL; pairs++) {
        if (!config_set_pair(settings, *pairs, failure)) {
            return false;
        }
    }
    return true;
}

/* `key=value key=value`; NULL: none. */
static bool set_words(settings_t *settings, const char *words, failure_t *failure)
{
    char *copy = memory_text(words != NULL ? words : "");
    bool is_good = true;
    for (char *word = strtok(copy, " "); is_good && word != NULL; word = strtok(NULL, " ")) {
        is_good = config_set_pair(settings, word, failure);
    }
    free(copy);
    return is_good;
}

static bool set_row(settings_t *settings, const reproduction_t *reproduction,
                    const reproduce_row_t *row, failure_t *failure)
{
    bool is_ours = row->is_ours;
    const char *of_kind =
        !is_ours && reproduction->kind != NULL ? reproduction->kind->settings : NULL;
    *settings = is_ours ? reproduction->our_settings : reproduction->paper_settings;
    return set_words(settings, of_kind, failure) && set_words(settings, row->settings, failure);
}

/* ---- a row on a walk --------------------------------------------------------------------- */

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

static const site_t *site_of(const reproduction_t *reproduction, const reproduce_row_t *row)
{
    if (row->lacks_radio) {
        return &reproduction->deaf;
    }
    return row->lacks_plan ? &reproduction->bare : &reproduction->site;
}

/* What is told in place of the log's start. */
static bool set_start(replay_request_t *request, const reproduce_row_t *row, failure_t *failure)
{
    request->has_start = row->start != REPRODUCE_START_TOLD;
    if (!request->has_start) {
        return true;
    }
    if (!find_start(request->logs[0], &request->start, failure)) {
        return false;
    }
    if (row->start == REPRODUCE_START_BY_RADIO) {
        request->start.value[3] = vague_place_m;
    } else {
        request->start.value[2] = request->start.value[4] = NUMBER_UNKNOWN;
    }
    return true;
}

bool reproduce_replay(const reproduction_t *reproduction, const reproduce_row_t *row,
                      const replay_sink_t *sink, failure_t *failure)
{
    char *log = platform_join(reproduction->folder, "log.csv");
    const char *const logs[] = {log};
    replay_facts_t facts;
    replay_request_t request = {.logs = logs,
                                .log_count = 1u,
                                .tracker = method_tracker(row->method),
                                .method = row->method,
                                .site = site_of(reproduction, row),
                                .particles = particles_of(row->method),
                                .seed = reproduction->seed,
                                .rate_hz = 10.0};
    bool is_good =
        set_row(&request.settings, reproduction, row, failure) && set_start(&request, row, failure);
    if (is_good) {
        is_good = replay_run(&request, sink, &facts, failure);
        replay_facts_free(&facts);
    }
    free(log);
    return is_good;
}

bool reproduce_keep_row(void *context, const track_row_t *row, failure_t *failure)
{
    (void)failure;
    track_add(context, row);
    return true;
}

bool reproduce_track(const reproduction_t *reproduction, const reproduce_row_t *row, track_t *track,
                     failure_t *failure)
{
    const replay_sink_t sink = {track, NULL, reproduce_keep_row, NULL};
    return reproduce_replay(reproduction, row, &sink, failure);
}
