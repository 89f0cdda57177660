/** @file errands.h  The orders of a scenario with every errand and survey turned into walks.
 *
 *  Each errand leads to a goal of the scenario, drawn from the seed, or where it names none to any
 *  place where one can stand, along a way that keeps clear of the walls, and stops there a while.
 *  A survey leads to all points of a grid (grid.h) that can be reached, the nearest first, and
 * stops at each. Where the scenario has a plan no order to walk may cross a wall.
 *
 *      sim_list_t orders;
 *      if (!sim_errands_plan(&scenario, seed, &orders, &error)) ...
 *      sim_list_free(&orders);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_ERRANDS_H
#define INSOLE_SIM_ERRANDS_H

#include <stdint.h>

#include "sim/scenario.h"

/** @param orders  a new list of sim_order_t without errands and surveys
 *  A refusal blames the order's line and leaves nothing to free. */
bool sim_errands_plan(const sim_scenario_t *scenario, uint64_t seed, sim_list_t *orders,
                      sim_error_t *error);

#endif
