/** @file grid.h  Reference points of a survey: on a square grid or on lines, where one can stand.
 *
 *      sim_list_t points;
 *      if (!sim_grid(&plan, 3.0, 0.45, &points)) ...          out of memory
 *      const sim_point_t *first = sim_list_at(&points, 0);
 *      sim_list_free(&points);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_GRID_H
#define INSOLE_SIM_GRID_H

#include "sim/scenario.h"

/** Points of the grid that begins half a spacing from the corner of the plan, row by row, of those
 *  that are inside and keep the clearance from walls.
 *  @param points  a new list of sim_point_t; empty for a plan without walls */
bool sim_grid(const sim_plan_t *plan, double spacing_m, double clearance_m, sim_list_t *points);

/** Reference points of a scenario: the same on its lines, or, where it has none, on the grid. The
 *  spacing on a line is the nearest to `spacing_m` that fits its length. */
bool sim_reference_points(const sim_scenario_t *scenario, double spacing_m, sim_list_t *points);

#endif
