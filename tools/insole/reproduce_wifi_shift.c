/* SPDX-License-Identifier: MIT */
#include "reproduce_wifi_shift.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "platform.h"
#include "progress.h"
#include "reproduce_walk.h"
#include "score.h"
#include "statistics.h"
#include "track_reader.h"

/* Errors count from here on: the first step comes then. */
static const int64_t begin_us = 3000000;

/* ---- the site ----------------------------------------------------------------------------- */

static bool simulate(const wifi_shift_t *study, const char *name, const char *folder, uint64_t seed,
                     failure_t *failure)
{
    char *scenario = platform_join("exhibition_hall", name);
    bool is_good = reproduce_simulate(study->request.maps, scenario, folder, seed, NULL, failure);
    free(scenario);
    return is_good;
}

/* So many of all access points, evenly spread over their list. */
static bool is_kept(size_t number, size_t all, int count)
{
    size_t kept = (size_t)count;
    return (number + 1u) * kept / all != number * kept / all;
}

/* The number of the access point of a line of the radio map; the header has none. */
static bool keeps_line(const char *line, const id_table_t *sorted, int count)
{
    const char *id = strchr(line, ',');
    id = id != NULL ? strchr(id + 1, ',') : NULL;
    for (size_t i = 0u; id != NULL && i < sorted->count; i++) {
        const char *name = sorted->names[i];
        size_t length = strlen(name);
        if (strncmp(id + 1, name, length) == 0 && id[1u + length] == ',') {
            return is_kept(i, sorted->count, count);
        }
    }
    return true;
}

/* A radio map without some of the access points. */
static bool thin_out(const char *from, const char *to, const id_table_t *ids, int count,
                     failure_t *failure)
{
    char line[512];
    uint32_t *numbers = memory_new(ids->count, sizeof *numbers);
    id_table_t sorted;
    memset(&sorted, 0, sizeof sorted);
    radiomap_file_sort_ids(ids, &sorted, numbers);
    FILE *source = fopen(from, "r"), *target = fopen(to, "w");
    while (source != NULL && target != NULL && fgets(line, sizeof line, source) != NULL) {
        if (keeps_line(line, &sorted, count)) {
            fputs(line, target);
        }
    }
    bool is_good = source != NULL && target != NULL && ferror(source) == 0 && fflush(target) == 0;
    if (source != NULL) {
        fclose(source);
    }
    if (target != NULL) {
        fclose(target);
    }
    id_table_free(&sorted);
    free(numbers);
    return is_good || failure_input(failure, "%s: cannot be written", to);
}

static bool open_thin(wifi_shift_t *study, int count, const char *plan, const char *radiomap,
                      failure_t *failure)
{
    char *thin = platform_join(study->survey_folder, "thin.csv");
    bool is_good =
        thin_out(radiomap, thin, &study->sites[0].radiomap_file.ids, wifi_shift_counts[count],
                 failure) &&
        site_open(&study->sites[count], plan, NULL, thin, &insole_propagation_defaults, failure);
    free(thin);
    return is_good;
}

static bool open_sites(wifi_shift_t *study, failure_t *failure)
{
    char *plan = platform_join(study->survey_folder, "plan.csv");
    char *radiomap = platform_join(study->survey_folder, "radiomap.csv");
    bool is_good =
        site_open(&study->sites[0], plan, NULL, radiomap, &insole_propagation_defaults, failure) &&
        site_open(&study->bare, plan, NULL, NULL, &insole_propagation_defaults, failure);
    for (int count = 1; is_good && count < WIFI_SHIFT_COUNTS; count++) {
        is_good = open_thin(study, count, plan, radiomap, failure);
    }
    free(plan);
    free(radiomap);
    return is_good;
}

bool wifi_shift_begin(wifi_shift_t *study, const reproduce_request_t *request, failure_t *failure)
{
    memset(study, 0, sizeof *study);
    study->request = *request;
    if (request->out != NULL && !platform_make_folder(request->out)) {
        return failure_input(failure, "%s: cannot be made", request->out);
    }
    study->survey_folder = platform_scratch_folder();
    study->walk_folder = platform_scratch_folder();
    if (study->survey_folder == NULL || study->walk_folder == NULL) {
        return failure_input(failure, "insole: no folder for the walks can be made: TMPDIR names "
                                      "where");
    }
    return simulate(study, "wifi_shift_survey", study->survey_folder, request->seed, failure) &&
           open_sites(study, failure);
}

/* ---- a row on a walk ---------------------------------------------------------------------- */

static void add_errors(wifi_shift_error_t *sum, const track_t *track, const track_t *truth)
{
    double *errors_m = memory_new(truth->count, sizeof *errors_m);
    score_errors(track, truth, errors_m);
    sum->mean_m += statistics_mean(errors_m, truth->count);
    sum->std_m += statistics_std(errors_m, truth->count);
    free(errors_m);
}

static bool measure_row(wifi_shift_t *study, const wifi_shift_walk_t *walk, int row, int count,
                        failure_t *failure)
{
    const wifi_shift_row_t *asked = &wifi_shift_rows[row];
    const char *const logs[] = {walk->log};
    track_t track = {NULL, 0u, 0u};
    const replay_sink_t sink = {&track, NULL, reproduce_keep_row, NULL};
    replay_facts_t facts;
    replay_request_t request = {.logs = logs,
                                .log_count = 1u,
                                .tracker = TRACKER_PHONE,
                                .method = asked->method,
                                .site = asked->lacks_radio ? &study->bare : &study->sites[count],
                                .seed = walk->seed,
                                .rate_hz = 10.0,
                                .no_start = !asked->is_told};
    bool is_good = reproduce_set(&request.settings, asked->settings, failure);
    if (is_good) {
        is_good = replay_run(&request, &sink, &facts, failure);
        replay_facts_free(&facts);
    }
    if (is_good) {
        add_errors(&study->sums[row][count][walk->path], &track, &walk->truth);
    }
    track_free(&track);
    return is_good;
}

/* ---- all walks ---------------------------------------------------------------------------- */

/* Before the first step, there may be no fix yet, and the place be nowhere. */
static bool read_truth(track_t *truth, const char *path, failure_t *failure)
{
    track_t whole = {NULL, 0u, 0u};
    bool is_good = track_read(&whole, path, failure);
    for (size_t i = 0u; i < whole.count; i++) {
        if (whole.rows[i].t_us >= begin_us) {
            track_add(truth, &whole.rows[i]);
        }
    }
    track_free(&whole);
    return is_good;
}

static bool open_walk(const wifi_shift_t *study, wifi_shift_walk_t *walk, failure_t *failure)
{
    char name[32];
    snprintf(name, sizeof name, "wifi_shift_%d.scenario", walk->path + 1);
    char *truth = platform_join(study->walk_folder, "truth.csv");
    walk->log = platform_join(study->walk_folder, "log.csv");
    bool is_good = simulate(study, name, study->walk_folder, walk->seed, failure) &&
                   read_truth(&walk->truth, truth, failure);
    free(truth);
    return is_good;
}

static bool measure_walk(wifi_shift_t *study, int path, uint64_t seed, failure_t *failure)
{
    wifi_shift_walk_t walk = {.path = path, .seed = seed};
    bool is_good = open_walk(study, &walk, failure);
    for (int row = 0; is_good && row < WIFI_SHIFT_ROWS; row++) {
        int counts = wifi_shift_rows[row].is_in_table_4 ? WIFI_SHIFT_COUNTS : 1;
        for (int count = 0; is_good && count < counts; count++) {
            is_good = measure_row(study, &walk, row, count, failure);
        }
    }
    is_good = is_good && wifi_shift_hunt(study, &walk, failure);
    track_free(&walk.truth);
    free(walk.log);
    return is_good;
}

bool wifi_shift_measure(wifi_shift_t *study, failure_t *failure)
{
    progress_t progress;
    int all = study->request.runs * WIFI_SHIFT_PATHS;
    bool is_good = true;
    progress_begin(&progress);
    for (int i = 0; is_good && i < all; i++) {
        uint64_t seed = study->request.seed + (uint64_t)(i / WIFI_SHIFT_PATHS);
        is_good = measure_walk(study, i % WIFI_SHIFT_PATHS, seed, failure);
        progress_step(&progress, (unsigned long long)i + 1u, (unsigned long long)all);
    }
    progress_end(&progress);
    return is_good && (study->request.out == NULL || wifi_shift_draw(study, failure));
}

wifi_shift_error_t wifi_shift_mean(const wifi_shift_t *study, int row, int count, int path)
{
    const wifi_shift_error_t *sum = &study->sums[row][count][path];
    bool is_there = count == 0 || wifi_shift_rows[row].is_in_table_4;
    double walks = is_there ? study->request.runs : NUMBER_UNKNOWN;
    return (wifi_shift_error_t){sum->mean_m / walks, sum->std_m / walks};
}

void wifi_shift_free(wifi_shift_t *study)
{
    char *const folders[] = {study->survey_folder, study->walk_folder};
    for (int count = 0; count < WIFI_SHIFT_COUNTS; count++) {
        site_free(&study->sites[count]);
    }
    site_free(&study->bare);
    for (int i = 0; i < 2; i++) {
        if (folders[i] != NULL) {
            platform_remove_folder(folders[i]);
        }
        free(folders[i]);
    }
}
