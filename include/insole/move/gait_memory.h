/** @file gait_memory.h  What is kept of a walker's steps: how they moved, and which end is ahead.
 *
 *  Frames  n: local level, z up, turned about the vertical with who carries the phone.
 *
 *  Sums over the steps that are slowly forgotten. When the walker turns, they turn along.
 *
 *      on each step, from gait_motion.h:
 *          insole_gait_memory_fade(&memory, moments.facing_rad, 0.9, 0.9);
 *          insole_gait_memory_level(&memory, &moments);
 *          insole_gait_memory_add(&memory, S);
 *          insole_gait_memory_note(&memory, insole_walk_axis_of(S).rad, 0.9);
 *          axis = insole_walk_axis_of(memory.scatter);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_GAIT_MEMORY_H
#define INSOLE_MOVE_GAIT_MEMORY_H

#include "insole/move/gait_motion.h"

#ifdef __cplusplus
extern "C" {
#endif

/** All zero: nothing is kept. */
typedef struct {
    insole_real_t facing_rad;  /**< n, where the walker faced in the last step */
    insole_vec3_t force_mps2;  /**< n, sum of the mean forces */
    insole_sym3_t scatter;     /**< n, each step's over its energy */
    insole_real_t steps;       /**< that these sums are of; those half forgotten count half */
    insole_spot_t pull;        /**< n, evidence for a direction, gathered by whoever has it */
    uint32_t axes;             /**< that are known: 0, 1, 2 */
    insole_real_t axis_rad[2]; /**< n, of the two newest steps alone, newest first, either end */
    insole_real_t wander;      /**< mean square of the sine between such axes of the same foot */
} insole_gait_memory_t;

/** Turns all to where the walker faces now, and keeps shares of it: of what tells the axis, of the
 *  evidence for its end. */
void insole_gait_memory_fade(insole_gait_memory_t *memory, insole_real_t facing_rad,
                             insole_real_t axis_share, insole_real_t pull_share);

/** Takes the mean force of a step, then turns what is told of it so that the mean force of all
 *  points up: over whole strides of who walks evenly, gravity is all that is left. A tilt over
 *  0.3 rad is none. */
void insole_gait_memory_level(insole_gait_memory_t *memory, insole_gait_moments_t *moments);

/** Takes the scatter of a step. */
void insole_gait_memory_add(insole_gait_memory_t *memory, insole_sym3_t scatter);

/** Takes the direction of a step alone, either end of it.
 *  @param share  kept of `wander` */
void insole_gait_memory_note(insole_gait_memory_t *memory, insole_real_t axis_rad,
                             insole_real_t share);

/** Variance of the axis of one step, from how they wander [rad^2]. */
insole_real_t insole_gait_memory_wander(const insole_gait_memory_t *memory);

#ifdef __cplusplus
}
#endif

#endif
