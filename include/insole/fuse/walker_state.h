/** @file walker_state.h  Where a walker is, how frame n lies on the map, and what fixes are off by.
 *
 *  Source  Our own.
 *  Frames  m: map.  n: level; heading in m = heading in n + offset.
 *
 *      insole_walker_state_t s = {.spot = spot, .scale = 1, .P = P};
 *      insole_walker_state_wander(&s, var_offset_rad2);
 *      lever = insole_walker_state_lever(&s, way_in_n);
 *      insole_walker_state_learn(&s, seen, count);
 *      insole_walker_state_settle(&s);
 *
 *  While the direction is known, the last two states are offset and scale, and a filter over them
 *  is an extended one; the mean way is shortened by exp(-variance / 2). When it is known less
 *  well, they are the complex number c by which a way in n becomes one in m. In c all is linear:
 *  mean and covariance are right however little is known, also of a direction that nobody knows,
 *  and no linearisation can go wrong. An offset that wanders acts on c with its exact moments.
 *
 *  It is changed over to c when the offset's 1-sigma grows beyond 0.5 rad, with the exact moments
 * of scale exp(i offset), and back once that is within 0.35 rad. The scale rests in the
 *  meantime: c knows it less well.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_WALKER_STATE_H
#define INSOLE_FUSE_WALKER_STATE_H

#include "insole/fuse/walker_cov.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    bool is_wide;             /**< the last two states are c, not offset and scale */
    insole_spot_t spot;       /**< m */
    insole_real_t offset_rad; /**< from n to m, (-pi, pi], unless wide */
    insole_real_t scale;      /**< of lengths, 0.25 .. 4; rests while wide */
    insole_real_t var_scale;  /**< if wide: of the scale that rests */
    insole_turn_t c;          /**< if wide; its length is not one */
    insole_spot_t bias;       /**< m, what fixes are off by */
    insole_walker_cov_t P;
} insole_walker_state_t;

/** Where a way in n leads in m, and how that changes with each of the last two states. */
typedef struct {
    insole_spot_t moved, by_first, by_second;
} insole_walker_lever_t;

/** A number z = h' x + noise, which differs by `innovation` from what is expected. */
typedef struct {
    insole_walker_column_t h;
    insole_real_t innovation, variance;
} insole_walker_seen_t;

/** Covariance of the last two states. */
static inline insole_sym2_t insole_walker_state_turn(const insole_walker_state_t *state)
{
    return insole_walker_cov_pair(&state->P, INSOLE_WALKER_TURN);
}

/** exp(-variance): the square of the mean of a direction that is wrong by so much, never quite 0.
 */
insole_real_t insole_walker_kept(insole_real_t var_rad2);

/** Variances along and across of a direction of unit length, of whose mean's square this is left:
 *  x_m along, y_m across. */
insole_spot_t insole_walker_scatter(insole_real_t left);

insole_walker_lever_t insole_walker_state_lever(const insole_walker_state_t *state,
                                                insole_spot_t way);

/** From n to m, (-pi, pi]. */
insole_real_t insole_walker_state_offset(const insole_walker_state_t *state);

/** Of the offset: up to pi^2 / 3, which says that nothing is known. */
insole_real_t insole_walker_state_var_offset(const insole_walker_state_t *state);

/** Of the scale. */
insole_real_t insole_walker_state_var_scale(const insole_walker_state_t *state);

/** The scale changes by a random number of this variance, and is no less known than `most`. */
void insole_walker_state_stretch(insole_walker_state_t *state, insole_real_t variance,
                                 insole_real_t most);

/** The offset turns by a random angle of this variance. @param var_rad2 >= 0 */
void insole_walker_state_wander(insole_walker_state_t *state, insole_real_t var_rad2);

/** One number after the other; their noises are independent. What would carry the position out of
 *  reach is nonsense and changes nothing. */
void insole_walker_state_learn(insole_walker_state_t *state, const insole_walker_seen_t *seen,
                               int count);

/** Back from c to offset and scale, if the direction is known well enough. Of what c tells of the
 *  scale and of the scale that rested, what is known better counts alone. */
void insole_walker_state_settle(insole_walker_state_t *state);

#ifdef __cplusplus
}
#endif

#endif
