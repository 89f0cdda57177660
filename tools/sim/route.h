/** @file route.h  The orders of a scenario as a path that can be walked.
 *
 *  Corners are rounded by arcs; where the way turns back sharply the walker stops and turns on the
 *  spot, and so they do wherever they set off in another direction than they look. The path is a
 *  list of sections; within a section the walker does not stop.
 *
 *  Frame: m or n, x and y level, z up; headings counter-clockwise from +x.
 *
 *      sim_route_t route;
 *      if (!sim_route_plan(&scenario.orders, &scenario.settings.walk, &route, &error)) ...
 *      sim_route_free(&route);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_ROUTE_H
#define INSOLE_SIM_ROUTE_H

#include "sim/list.h"
#include "sim/settings.h"

/** A point of the path, and where one looks there. */
typedef struct {
    double x_m, y_m, z_m, heading_rad;
} sim_place_t;

/** A straight line or an arc. */
typedef struct {
    double begin_m; /**< of the section's length */
    double length_m;
    sim_place_t from;
    double curvature; /**< 1/m; positive turns left, 0 is straight */
    double speed_mps; /**< asked for here */
} sim_piece_t;

typedef enum {
    SIM_SECTION_STAND,
    SIM_SECTION_TURN,
    SIM_SECTION_WALK,
    SIM_SECTION_STAIRS
} sim_section_kind_t;

typedef struct {
    sim_section_kind_t kind;
    sim_place_t from, to;
    double seconds;             /**< stand */
    double length_m;            /**< walk, stairs: level */
    double end_speed_mps;       /**< walk, stairs: 0 where the walker stops */
    size_t first_piece, pieces; /**< walk, stairs */
} sim_section_t;

typedef struct {
    sim_list_t sections; /**< of sim_section_t */
    sim_list_t pieces;   /**< of sim_piece_t */
    double length_m;     /**< of the whole path, level */
} sim_route_t;

/** A refusal blames the order's line and leaves nothing to free. */
bool sim_route_plan(const sim_list_t *orders, const sim_walk_settings_t *walk, sim_route_t *route,
                    sim_error_t *error);

/** Point of a walk or of stairs at `s_m` from the section's beginning; z is that of a ramp. */
sim_place_t sim_route_at(const sim_route_t *route, const sim_section_t *section, double s_m);

/** Largest speed at `s_m` that still lets the walker slow down by `accel_mps2` for what comes. */
double sim_route_speed(const sim_route_t *route, const sim_section_t *section, double s_m,
                       double accel_mps2);

void sim_route_free(sim_route_t *route);

#endif
