/** @file plot_plan.h  A floor plan and its access points on the page of a plot.
 *
 *      plot_area_t area = plot_area_empty();
 *      plot_plan_area(&area, &plan);            and the tracks
 *      plot_frame_t frame = plot_frame(area);
 *      plot_frame_draw(file, &frame);
 *      plot_plan_draw(file, &frame, &plan);     and the tracks over it
 *
 *  Walls are the darker and the thicker the more they cost the radio; holes are hatched. What
 *  reaches out of the frame is cut off.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PLOT_PLAN_H
#define INSOLE_HOST_PLOT_PLAN_H

#include "ap_file.h"
#include "plan_file.h"
#include "plot_frame.h"

/** Room for the style of a wall. */
enum { PLOT_PLAN_STYLE = 128 };

/** Fill and edge of holes, after plot_plan_draw has begun. */
#define PLOT_PLAN_HOLE "fill=\"url(#hole)\""

/** Makes the area hold the plan's first floor. */
void plot_plan_area(plot_area_t *area, const plan_file_t *plan);

/** The first floor. Once a page, after plot_frame_draw. */
void plot_plan_draw(FILE *file, const plot_frame_t *frame, const plan_file_t *plan);

/** Access points inside the frame, with their names where there is room: rather not across walls
 *  of the plan, and never across each other. */
void plot_plan_draw_aps(FILE *file, const plot_frame_t *frame, const plan_file_t *plan,
                        const ap_file_t *aps);

/** The mark of one access point. */
void plot_plan_mark(FILE *file, double x, double y);

/** How a wall of this loss is drawn; NUMBER_UNKNOWN: the plan does not tell. @return buffer */
const char *plot_plan_wall_style(char buffer[PLOT_PLAN_STYLE], double loss_db);

#endif
