/** @file plan_shape.h  Distances, crossings and insides of a plan as it is drawn.
 *
 *  Plain searches through all lines, in double: for looking at a plan once, not for tracking.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PLAN_SHAPE_H
#define INSOLE_HOST_PLAN_SHAPE_H

#include "plan_file.h"

/** Twice the area of the triangle; positive when p, q, r turn left. */
double plan_turn(plan_point_t p, plan_point_t q, plan_point_t r);

/** Distance of p from the piece from a to b. */
double plan_piece_distance(plan_point_t p, plan_point_t a, plan_point_t b);

/** Do the pieces from a to b and from c to d go through each other? Touching does not count.
 *  @param[out] where they do */
bool plan_pieces_cross(plan_point_t a, plan_point_t b, plan_point_t c, plan_point_t d,
                       plan_point_t *where);

/** Distance of p from the nearest piece of the line. */
double plan_line_distance(const plan_line_t *line, plan_point_t p);

/** Does the ring run around p? */
bool plan_ring_holds(const plan_line_t *ring, plan_point_t p);

/** Area of a ring that does not cross itself. */
double plan_ring_area(const plan_line_t *ring);

/** How far p lies outside all outlines of a floor; 0 inside. Infinite without an outline. */
double plan_distance_outside(const plan_file_t *plan, size_t floor, plan_point_t p);

#endif
