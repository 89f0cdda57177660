/* SPDX-License-Identifier: MIT */
#include "reproduce.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "platform.h"
#include "progress.h"
#include "reproduce_draw.h"
#include "reproduce_walk.h"
#include "score.h"
#include "statistics.h"

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
    return reproduce_set(&reproduction->paper_settings, paper->settings, failure) &&
           reproduce_set(&reproduction->our_settings, none, failure);
}

/* ---- errors ----------------------------------------------------------------------------- */

static double share_below(const double *sorted, size_t count, double limit)
{
    size_t below = 0u;
    while (below < count && sorted[below] < limit) {
        below++;
    }
    return count > 0u ? (double)below / (double)count : 0.0;
}

static reproduce_figures_t figures_of(const double *errors_m, size_t count)
{
    double *sorted_m = memory_new(count + 1u, sizeof *sorted_m);
    memcpy(sorted_m, errors_m, count * sizeof *sorted_m);
    reproduce_figures_t figures = {
        .m = {[REPRODUCE_MIN] = statistics_percentile(sorted_m, count, 0.0),
              [REPRODUCE_MAX] = statistics_percentile(sorted_m, count, 100.0),
              [REPRODUCE_MEAN] = statistics_mean(errors_m, count),
              [REPRODUCE_RMS] = statistics_rms(errors_m, count),
              [REPRODUCE_STD] = statistics_std(errors_m, count),
              [REPRODUCE_75] = statistics_percentile(sorted_m, count, 75.0),
              [REPRODUCE_90] = statistics_percentile(sorted_m, count, 90.0),
              [REPRODUCE_NEAR] = 100.0 * share_below(sorted_m, count, 1.0)}};
    free(sorted_m);
    return figures;
}

static reproduce_figures_t mean_of_walks(const reproduction_t *reproduction, int row)
{
    const reproduce_figures_t *walks = reproduction->results[row].walks;
    double share = 1.0 / reproduction->request.runs;
    reproduce_figures_t means = {{0.0}};
    for (int i = 0; i < reproduction->request.runs; i++) {
        for (int k = 0; k < REPRODUCE_FIGURES; k++) {
            means.m[k] += share * walks[i].m[k];
        }
    }
    return means;
}

reproduce_figures_t reproduce_means(const reproduction_t *reproduction, int row)
{
    const reproduce_result_t *result = &reproduction->results[row];
    return reproduction->paper->is_pooled ? figures_of(result->errors_m, result->error_count)
                                          : mean_of_walks(reproduction, row);
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
    if (!reproduce_track(reproduction, &reproduction->paper->rows[row], &reproduction->tracks[row],
                         failure)) {
        return false;
    }
    score_row(reproduction, row, walk);
    return true;
}

/* ---- pictures --------------------------------------------------------------------------- */

static bool draw(const reproduction_t *reproduction, const reproduce_drawing_t *drawing,
                 failure_t *failure)
{
    size_t count = (size_t)drawing->count;
    return drawing->shown_m > 0.0
               ? reproduce_draw_shares(reproduction, drawing->rows, count, drawing->shown_m,
                                       &drawing->picture, failure)
               : reproduce_draw_tracks(reproduction, drawing->rows, count, &drawing->picture,
                                       failure);
}

/* Those of the first walk, while its files are there, or those of all. */
static bool draw_all(const reproduction_t *reproduction, bool is_first_walk, failure_t *failure)
{
    const reproduce_paper_t *paper = reproduction->paper;
    const reproduce_more_t *more = paper->more;
    bool is_good = true;
    if (reproduction->request.out == NULL) {
        return true;
    }
    for (int i = 0; is_good && i < paper->drawing_count; i++) {
        if (is_first_walk == !(paper->drawings[i].shown_m > 0.0)) {
            is_good = draw(reproduction, &paper->drawings[i], failure);
        }
    }
    bool (*own)(const reproduction_t *, failure_t *) = NULL;
    if (more != NULL) {
        own = is_first_walk ? more->draw_walk : more->draw;
    }
    return is_good && (own == NULL || own(reproduction, failure));
}

/* ---- all walks -------------------------------------------------------------------------- */

static bool begin_more(reproduction_t *reproduction, failure_t *failure)
{
    const reproduce_more_t *more = reproduction->paper->more;
    if (more == NULL) {
        return true;
    }
    reproduction->more = more->size > 0u ? memory_new(1u, more->size) : NULL;
    return more->begin == NULL || more->begin(reproduction, failure);
}

static bool measure_more(reproduction_t *reproduction, failure_t *failure)
{
    const reproduce_more_t *more = reproduction->paper->more;
    return more == NULL || more->walk == NULL || more->walk(reproduction, failure);
}

static bool measure_walk(reproduction_t *reproduction, int walk, progress_t *progress,
                         failure_t *failure)
{
    int rows = reproduction->paper->row_count;
    unsigned long long all = (unsigned long long)reproduction->request.runs * (unsigned)rows;
    unsigned long long before = (unsigned long long)walk * (unsigned)rows;
    bool is_good = reproduce_open_walk(reproduction, walk, failure);
    for (int row = 0; is_good && row < rows; row++) {
        is_good = measure_row(reproduction, row, walk, failure);
        progress_step(progress, before + (unsigned)row + 1u, all);
    }
    is_good = is_good && measure_more(reproduction, failure) &&
              (walk > 0 || draw_all(reproduction, true, failure));
    reproduce_close_walk(reproduction);
    return is_good;
}

bool reproduce_measure(reproduction_t *reproduction, failure_t *failure)
{
    progress_t progress;
    progress_begin(&progress);
    bool is_good = begin_more(reproduction, failure) && reproduce_survey(reproduction, failure);
    for (int walk = 0; is_good && walk < reproduction->request.runs; walk++) {
        is_good = measure_walk(reproduction, walk, &progress, failure);
    }
    progress_end(&progress);
    return is_good && draw_all(reproduction, false, failure);
}

void reproduce_free(reproduction_t *reproduction)
{
    const reproduce_more_t *more = reproduction->paper->more;
    for (int i = 0; i < REPRODUCE_ROWS; i++) {
        free(reproduction->results[i].walks);
        free(reproduction->results[i].errors_m);
    }
    if (reproduction->more != NULL && more->free != NULL) {
        more->free(reproduction);
    }
    free(reproduction->more);
    if (reproduction->folder != NULL) {
        platform_remove_folder(reproduction->folder);
    }
    free(reproduction->folder);
}
