/* SPDX-License-Identifier: MIT */
#include "reproduce_search.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "number.h"
#include "progress.h"
#include "reproduce_walk.h"
#include "score.h"

bool reproduce_search_has_axes(const reproduce_paper_t *paper)
{
    bool has_axes = false;
    for (int row = 0; row < paper->row_count; row++) {
        has_axes = has_axes || paper->rows[row].axis_count > 0;
    }
    return has_axes;
}

int reproduce_search_count(const reproduce_row_t *row)
{
    int count = 1;
    for (int i = 0; i < row->axis_count; i++) {
        count *= row->axes[i].count;
    }
    return count;
}

void reproduce_search_begin(reproduce_search_t *search, reproduction_t *reproduction)
{
    const reproduce_paper_t *paper = reproduction->paper;
    memset(search, 0, sizeof *search);
    search->reproduction = reproduction;
    for (int row = 0; row < paper->row_count; row++) {
        if (paper->rows[row].axis_count > 0) {
            search->sums_m[row] = memory_new((size_t)reproduce_search_count(&paper->rows[row]),
                                             sizeof *search->sums_m[row]);
        }
    }
}

/* The last axis counts fastest. */
static int value_of(const reproduce_row_t *row, int combination, int axis)
{
    for (int i = row->axis_count - 1; i > axis; i--) {
        combination /= row->axes[i].count;
    }
    return combination % row->axes[axis].count;
}

char *reproduce_search_settings(const reproduce_row_t *row, int combination)
{
    enum { ROOM = 64 * REPRODUCE_AXES };
    char *text = memory_new(ROOM, 1u);
    for (int i = 0; i < row->axis_count; i++) {
        char number[NUMBER_ROOM];
        const reproduce_axis_t *axis = &row->axes[i];
        size_t used = strlen(text);
        snprintf(text + used, ROOM - used, "%s%s=%s", i > 0 ? " " : "", axis->key,
                 number_short(number, axis->values[value_of(row, combination, i)]));
    }
    return text;
}

/* ---- trying ----------------------------------------------------------------------------- */

/* Sum of the errors on the present walk. */
static bool try_settings(const reproduction_t *reproduction, const reproduce_row_t *row,
                         double *sum_m, failure_t *failure)
{
    const track_t *truth = &reproduction->truth;
    track_t track = {NULL, 0u, 0u};
    bool is_good = reproduce_track(reproduction, row, &track, failure);
    double *errors_m = memory_new(truth->count + 1u, sizeof *errors_m);
    if (is_good) {
        score_errors(&track, truth, errors_m);
    }
    for (size_t i = 0u; i < truth->count; i++) {
        *sum_m += errors_m[i];
    }
    free(errors_m);
    track_free(&track);
    return is_good;
}

/* What is tried stands behind what the row has: of a key set twice the last counts. */
static bool try_combination(reproduce_search_t *search, int row, int combination,
                            failure_t *failure)
{
    reproduce_row_t tried = search->reproduction->paper->rows[row];
    char *values = reproduce_search_settings(&tried, combination);
    const char *own = tried.settings != NULL ? tried.settings : "";
    size_t room = strlen(own) + strlen(values) + 2u;
    char *settings = memory_new(room, 1u);
    snprintf(settings, room, "%s %s", own, values);
    tried.settings = settings;
    bool is_good =
        try_settings(search->reproduction, &tried, &search->sums_m[row][combination], failure);
    free(settings);
    free(values);
    return is_good;
}

static bool search_row(reproduce_search_t *search, int row, progress_t *progress, int walk,
                       failure_t *failure)
{
    const reproduction_t *reproduction = search->reproduction;
    const reproduce_paper_t *paper = reproduction->paper;
    int combinations = reproduce_search_count(&paper->rows[row]);
    unsigned long long rows = (unsigned)paper->row_count;
    unsigned long long before = (unsigned)walk * rows + (unsigned)row;
    bool is_good = true;
    for (int i = 0; is_good && i < combinations; i++) {
        is_good = try_combination(search, row, i, failure);
        progress_step(progress, 1000u * before + 1000u * (unsigned)i / (unsigned)combinations,
                      1000u * rows * (unsigned)reproduction->request.runs);
    }
    return is_good;
}

static bool search_walk(reproduce_search_t *search, int walk, progress_t *progress,
                        failure_t *failure)
{
    reproduction_t *reproduction = search->reproduction;
    bool is_good = reproduce_open_walk(reproduction, walk, failure);
    for (int row = 0; is_good && row < reproduction->paper->row_count; row++) {
        is_good = search->sums_m[row] == NULL || search_row(search, row, progress, walk, failure);
    }
    search->error_count += reproduction->truth.count;
    reproduce_close_walk(reproduction);
    return is_good;
}

bool reproduce_search_run(reproduce_search_t *search, failure_t *failure)
{
    progress_t progress;
    progress_begin(&progress);
    bool is_good = reproduce_survey(search->reproduction, failure);
    for (int walk = 0; is_good && walk < search->reproduction->request.runs; walk++) {
        is_good = search_walk(search, walk, &progress, failure);
    }
    progress_end(&progress);
    return is_good;
}

/* ---- out -------------------------------------------------------------------------------- */

int reproduce_search_best(const reproduce_search_t *search, int row)
{
    const double *sums_m = search->sums_m[row];
    int best = 0;
    for (int i = 1; i < reproduce_search_count(&search->reproduction->paper->rows[row]); i++) {
        best = sums_m[i] < sums_m[best] ? i : best;
    }
    return best;
}

static void print_axis(FILE *file, const reproduce_axis_t *axis, int best)
{
    fprintf(file, "  %s:", axis->key);
    for (int i = 0; i < axis->count; i++) {
        char number[NUMBER_ROOM];
        fprintf(file, i == best ? " [%s]" : " %s", number_short(number, axis->values[i]));
    }
    fputc('\n', file);
}

static void print_row(const reproduce_search_t *search, FILE *file, int row)
{
    const reproduce_row_t *asked = &search->reproduction->paper->rows[row];
    char number[NUMBER_ROOM];
    int best = reproduce_search_best(search, row);
    double mean_m = search->sums_m[row][best] / (double)search->error_count;
    fprintf(file, "%s: mean %s m of %d combinations\n", asked->label,
            number_fixed(number, mean_m, 3), reproduce_search_count(asked));
    for (int i = 0; i < asked->axis_count; i++) {
        print_axis(file, &asked->axes[i], value_of(asked, best, i));
    }
}

void reproduce_search_print(const reproduce_search_t *search, FILE *file)
{
    const reproduction_t *reproduction = search->reproduction;
    fprintf(file, "[%s] best settings of %d walk%s from seed %llu on; the best are in brackets\n",
            reproduction->paper->name, reproduction->request.runs,
            reproduction->request.runs == 1 ? "" : "s",
            (unsigned long long)reproduction->request.seed);
    for (int row = 0; row < reproduction->paper->row_count; row++) {
        if (search->sums_m[row] != NULL) {
            print_row(search, file, row);
        }
    }
}

void reproduce_search_free(reproduce_search_t *search)
{
    for (int row = 0; row < REPRODUCE_ROWS; row++) {
        free(search->sums_m[row]);
    }
}
