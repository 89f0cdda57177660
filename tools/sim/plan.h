/** @file plan.h  A building as the simulator sees it: walls, and where one can stand.
 *
 *  The format is described in maps/README.md. All searches go through every wall: slow and plain.
 *
 *      sim_plan_t plan;
 *      if (!sim_plan_read(stream, &plan, &error)) ...        error.line, error.text
 *      if (sim_plan_clearance(&plan, here, there) > 0.3) ... the way is free
 *      sim_plan_free(&plan);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_PLAN_H
#define INSOLE_SIM_PLAN_H

#include <stdio.h>

#include "sim/error.h"
#include "sim/list.h"

typedef struct {
    double x_m, y_m;
} sim_point_t;

/** One straight piece of a wall. */
typedef struct {
    sim_point_t a, b;
    size_t line;    /**< number of the ring or wall that it is a piece of */
    double loss_db; /**< not-a-number: the plan does not tell */
} sim_wall_t;

/** A closed line; its pieces are the walls from `first` on. */
typedef struct {
    size_t first, count;
    bool is_hole;
} sim_ring_t;

/** The first floor of the file. */
typedef struct {
    sim_list_t walls; /**< of sim_wall_t */
    sim_list_t rings; /**< of sim_ring_t */
    size_t lines;     /**< rings and inner walls together */
} sim_plan_t;

/** Nothing anywhere: no wall stands in the way, and one can stand everywhere. */
sim_plan_t sim_plan_empty(void);

/** Reads to the end of the stream. A refusal leaves nothing to free. */
bool sim_plan_read(FILE *stream, sim_plan_t *plan, sim_error_t *error);

static inline const sim_wall_t *sim_plan_wall(const sim_plan_t *plan, size_t number)
{
    return (const sim_wall_t *)sim_list_at(&plan->walls, number);
}

/** Does the straight way from p to q cross the wall? Of two pieces that meet on the way and go on
 *  to its other side one is crossed. */
bool sim_wall_is_crossed(const sim_wall_t *wall, sim_point_t p, sim_point_t q);

/** Least distance of the wall from the straight way from p to q; 0 when it is crossed. */
double sim_wall_distance(const sim_wall_t *wall, sim_point_t p, sim_point_t q);

/** Least distance of the straight way from p to q from any wall; 0 when it crosses one, infinite
 *  without walls. */
double sim_plan_clearance(const sim_plan_t *plan, sim_point_t p, sim_point_t q);

/** Inside an outline, if there is one, and in no hole. */
bool sim_plan_is_inside(const sim_plan_t *plan, sim_point_t p);

/** Smallest box around all walls; false without walls. */
bool sim_plan_box(const sim_plan_t *plan, sim_point_t *low, sim_point_t *high);

void sim_plan_free(sim_plan_t *plan);

#endif
