/** @file walk_axis.h  The direction of a motion in the level plane, and what a tilt makes of it.
 *
 *  Source  [PhoneUKF] 5.3, eqs. (19), (23)-(25), (29)-(30).
 *  Frames  n: local level, z up.
 *
 *      insole_walk_axis_t axis = insole_walk_axis_of(S);               of the largest energy
 *      insole_walk_axis_through(&axis, P, &off_rad, &variance_rad2);   P: of the attitude
 *
 *  A scatter matrix of 3x3 is all that the principal axis and the unscented transform of its error
 *  need: a wrong attitude turns the matrix.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_WALK_AXIS_H
#define INSOLE_MOVE_WALK_AXIS_H

#include "insole/base/sym2.h"
#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    bool is_axis;      /**< of S, two-ended; else the direction of `way` */
    insole_sym3_t S;   /**< scatter, n */
    insole_vec3_t way; /**< n */
    insole_real_t rad; /**< the angle as the attitude stands */
} insole_walk_axis_t;

/** Energies along the principal axis of the level plane and across it. */
typedef struct {
    insole_real_t most, least;
} insole_walk_energies_t;

insole_walk_energies_t insole_walk_energies(insole_sym3_t S);

/** The principal axis of a scatter matrix in the level plane, counted from x. */
insole_walk_axis_t insole_walk_axis_of(insole_sym3_t S);

/** The direction of a vector. */
insole_walk_axis_t insole_walk_axis_along(insole_vec3_t way);

/** Mean and variance of the angle over the errors of the attitude, by the unscented transform.
 *  @param cov_rad2  of the small rotation in n
 *  @param off_rad   mean less the angle as the attitude stands */
void insole_walk_axis_through(const insole_walk_axis_t *axis, insole_sym3_t cov_rad2,
                              insole_real_t *off_rad, insole_real_t *variance_rad2);

#ifdef __cplusplus
}
#endif

#endif
