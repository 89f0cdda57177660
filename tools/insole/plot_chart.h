/** @file plot_chart.h  A picture of curves over an axis, as SVG.
 *
 *      chart_line_t line = {.name = "error"};
 *      chart_add(&line, 0.5, 1.2);
 *      chart_t chart = {.title = "...", .lines = &line, .line_count = 1, .x_high = 10.0, ...};
 *      chart_write(&chart, "error.svg", &failure);
 *      chart_free(&line);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PLOT_CHART_H
#define INSOLE_HOST_PLOT_CHART_H

#include <stddef.h>
#include <stdio.h>

#include "failure.h"

typedef struct {
    double x, y;
} chart_point_t;

/** An empty line is all zeros but its name. */
typedef struct {
    const char *name; /**< for the legend */
    chart_point_t *points;
    size_t count, room;
} chart_line_t;

typedef struct {
    const char *title, *subtitle;
    const char *x_name, *y_name;
    double x_low, x_high, y_low, y_high; /**< what is shown; points beyond lie on the edge */
    const chart_line_t *lines;           /**< coloured as tracks are, by their number */
    size_t line_count;
} chart_t;

void chart_add(chart_line_t *line, double x, double y);

void chart_free(chart_line_t *line);

/** The picture alone, for a page of its own. */
void chart_draw(FILE *file, const chart_t *chart);

/** @param path a file, or `-` for standard output */
bool chart_write(const chart_t *chart, const char *path, failure_t *failure);

#endif
