/** @file plot_frame.h  The page of a plot: what is where, axes, grid and scale bar.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PLOT_FRAME_H
#define INSOLE_HOST_PLOT_FRAME_H

#include <stdio.h>

#include "track.h"

/** Part of the plane, in metres. Empty when low > high. */
typedef struct {
    double x_low, x_high, y_low, y_high;
} plot_area_t;

typedef struct {
    double width, height;            /**< of the page, pixels */
    double left, right, top, bottom; /**< of the field with the tracks, pixels */
    double pixels_per_m;
    plot_area_t area; /**< what the field shows */
} plot_frame_t;

plot_area_t plot_area_empty(void);

/** Makes the area hold every row of the track. */
void plot_area_add(plot_area_t *area, const track_t *track);

/** Makes the area hold a place. */
void plot_area_add_place(plot_area_t *area, double x_m, double y_m);

plot_frame_t plot_frame(plot_area_t area);

/** Pixels of a place. */
double plot_x(const plot_frame_t *frame, double x_m);
double plot_y(const plot_frame_t *frame, double y_m);

/** The largest of 1, 2 or 5 times a power of ten that is at most `limit`. */
double plot_round(double limit);

/** Grid, ticks with their numbers, names of the axes, scale bar. */
void plot_frame_draw(FILE *file, const plot_frame_t *frame);

#endif
