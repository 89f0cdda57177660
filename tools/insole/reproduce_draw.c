/* SPDX-License-Identifier: MIT */
#include "reproduce_draw.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "platform.h"
#include "plot.h"
#include "statistics.h"

enum { SHARES = 1000 };

bool reproduce_draw_chart(const reproduction_t *reproduction, const chart_t *chart,
                          const reproduce_picture_t *picture, failure_t *failure)
{
    chart_t named = *chart;
    named.title = picture->title;
    named.subtitle = picture->subtitle;
    char *path = platform_join(reproduction->request.out, picture->file);
    bool is_good = chart_write(&named, path, failure);
    free(path);
    return is_good;
}

/* ---- tracks ----------------------------------------------------------------------------- */

bool reproduce_draw_ways(const reproduction_t *reproduction, const track_t *tracks,
                         const char *const *labels, size_t count,
                         const reproduce_picture_t *picture, failure_t *failure)
{
    const plot_t plot = {.title = picture->title,
                         .subtitle = picture->subtitle,
                         .tracks = tracks,
                         .names = labels,
                         .track_count = count,
                         .truth = &reproduction->truth,
                         .site = &reproduction->site};
    char *path = platform_join(reproduction->request.out, picture->file);
    bool is_good = plot_write(&plot, path, failure);
    free(path);
    return is_good;
}

/* The walk itself, without the standing before it. */
static track_t cut_track(const reproduction_t *reproduction, int row)
{
    const track_t *whole = &reproduction->tracks[row];
    track_t cut = {NULL, 0u, 0u};
    for (size_t i = 0u; i < whole->count; i++) {
        if (1e-6 * (double)whole->rows[i].t_us >= reproduction->paper->begin_s) {
            track_add(&cut, &whole->rows[i]);
        }
    }
    return cut;
}

bool reproduce_draw_tracks(const reproduction_t *reproduction, const int *rows, size_t count,
                           const reproduce_picture_t *picture, failure_t *failure)
{
    track_t tracks[REPRODUCE_ROWS];
    const char *labels[REPRODUCE_ROWS];
    for (size_t i = 0u; i < count; i++) {
        tracks[i] = cut_track(reproduction, rows[i]);
        labels[i] = reproduction->paper->rows[rows[i]].label;
    }
    bool is_good = reproduce_draw_ways(reproduction, tracks, labels, count, picture, failure);
    for (size_t i = 0u; i < count; i++) {
        track_free(&tracks[i]);
    }
    return is_good;
}

/* ---- shares ----------------------------------------------------------------------------- */

void reproduce_add_shares(chart_line_t *line, double *values, size_t count, double shown)
{
    (void)statistics_percentile(values, count, 0.0);
    for (size_t i = 0u; count > 0u && i <= SHARES; i++) {
        double value = values[i * (count - 1u) / SHARES];
        if (value <= shown) {
            chart_add(line, value, 100.0 / SHARES * (double)i);
        }
    }
}

static void add_row(chart_line_t *line, const reproduce_result_t *result, double shown_m)
{
    double *sorted_m = memory_new(result->error_count, sizeof *sorted_m);
    memcpy(sorted_m, result->errors_m, result->error_count * sizeof *sorted_m);
    reproduce_add_shares(line, sorted_m, result->error_count, shown_m);
    free(sorted_m);
}

bool reproduce_draw_shares(const reproduction_t *reproduction, const int *rows, size_t count,
                           double shown_m, const reproduce_picture_t *picture, failure_t *failure)
{
    chart_line_t lines[REPRODUCE_ROWS];
    memset(lines, 0, sizeof lines);
    for (size_t i = 0u; i < count; i++) {
        lines[i].name = reproduction->paper->rows[rows[i]].label;
        add_row(&lines[i], &reproduction->results[rows[i]], shown_m);
    }
    const chart_t chart = {.x_name = "error [m]",
                           .y_name = "errors below it [%]",
                           .x_high = shown_m,
                           .y_high = 100.0,
                           .lines = lines,
                           .line_count = count};
    bool is_good = reproduce_draw_chart(reproduction, &chart, picture, failure);
    for (size_t i = 0u; i < count; i++) {
        chart_free(&lines[i]);
    }
    return is_good;
}
