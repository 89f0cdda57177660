/** @file reproduce_draw.h  Pictures that the papers have in common, into the folder asked for.
 *
 *      const reproduce_picture_t picture = {"figure7.svg", "Tracks", "As figure 7 of [PhoneEKF]"};
 *      reproduce_draw_tracks(reproduction, numbers, 4u, &picture, &failure);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPRODUCE_DRAW_H
#define INSOLE_HOST_REPRODUCE_DRAW_H

#include "plot_chart.h"
#include "reproduce.h"

/** Writes a chart; title and subtitle are the picture's. */
bool reproduce_draw_chart(const reproduction_t *reproduction, const chart_t *chart,
                          const reproduce_picture_t *picture, failure_t *failure);

/** Any tracks over the building and the truth. */
bool reproduce_draw_ways(const reproduction_t *reproduction, const track_t *tracks,
                         const char *const *labels, size_t count,
                         const reproduce_picture_t *picture, failure_t *failure);

/** The tracks of some rows, from where errors count; at most REPRODUCE_ROWS. */
bool reproduce_draw_tracks(const reproduction_t *reproduction, const int *rows, size_t count,
                           const reproduce_picture_t *picture, failure_t *failure);

/** How many of the errors of some rows are how small, over all walks; at most REPRODUCE_ROWS.
 *  @param shown_m what is shown of them */
bool reproduce_draw_shares(const reproduction_t *reproduction, const int *rows, size_t count,
                           double shown_m, const reproduce_picture_t *picture, failure_t *failure);

/** Adds to a line which share of some values is smaller than each, in percent.
 *  @param values  are sorted */
void reproduce_add_shares(chart_line_t *line, double *values, size_t count, double shown);

#endif
