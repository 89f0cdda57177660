/** @file plan_parts.h  Where one can walk in a plan, and whether one can get there.
 *
 *  The plan is sampled on a fine raster. A person is a disc of PLAN_PARTS_BODY_M that touches no
 *  wall; two places are of one part when the disc gets from one to the other.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PLAN_PARTS_H
#define INSOLE_HOST_PLAN_PARTS_H

#include <stddef.h>

#include "plan_file.h"

/** Half the width of a person [m]. */
#define PLAN_PARTS_BODY_M 0.2

/** Any gap so wide is taken for a door [m]. */
#define PLAN_PARTS_DOOR_M 0.7

/** No gap so narrow is [m]: a step of the coarsest raster leads from one side to the other of a gap
 *  a little narrower than a person. */
#define PLAN_PARTS_CRACK_M 0.28

typedef struct {
    double area_m2;     /**< where the person's middle can be */
    plan_point_t place; /**< one of its places, near its middle */
} plan_part_t;

typedef struct {
    double walkable_m2; /**< inside the outlines and outside the holes */
    bool is_searched;   /**< false: the plan is so large that doors would be missed */
    plan_part_t *parts; /**< the largest first; none when not searched */
    size_t count, room;
} plan_parts_t;

/** Parts of less than 1 m^2 are left out: nooks between walls. */
void plan_parts_find(plan_parts_t *parts, const insole_floor_plan_t *plan);

void plan_parts_free(plan_parts_t *parts);

#endif
