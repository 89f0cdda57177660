/** @file way.h  Ways through a building that keep clear of its walls.
 *
 *  A grid of squares whose middles are far enough from every wall; the way with fewest squares is
 *  found by going outwards from its beginning, then pulled straight where the straight line keeps
 *  clear as well.
 *
 *      sim_way_map_t map;
 *      if (!sim_way_map(&map, &plan, 0.45)) ...               out of memory, or no walls at all
 *      if (sim_way_find(&map, from, to, &points)) ...          list of sim_point_t, both ends too
 *      sim_way_map_free(&map);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_WAY_H
#define INSOLE_SIM_WAY_H

#include "sim/plan.h"

typedef struct {
    const sim_plan_t *plan;
    double clearance_m, square_m;
    sim_point_t low; /**< corner of the first square */
    long columns, rows;
    unsigned char *is_free; /**< row by row */
} sim_way_map_t;

/** The plan must outlive the map and have walls. False when there is no memory. */
bool sim_way_map(sim_way_map_t *map, const sim_plan_t *plan, double clearance_m);

/** Far enough from every wall, and where one can be. */
bool sim_way_can_stand(const sim_way_map_t *map, sim_point_t p);

/** @param points  gets the way, if there is one, as a new list of sim_point_t
 *  @return false when there is no way, or no memory: then nothing is to be freed */
bool sim_way_find(const sim_way_map_t *map, sim_point_t from, sim_point_t to, sim_list_t *points);

void sim_way_map_free(sim_way_map_t *map);

#endif
