/** @file steps.h  The footfalls of a walk: when and where each foot comes down.
 *
 *  Left and right follow each other, beside the path; the walker speeds up and slows down from
 *  step to step, takes whole steps to every stop and closes the feet there. Lengths, durations,
 *  sideways places and yaws vary by a seeded amount; the feet of a standing walker do not.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_STEPS_H
#define INSOLE_SIM_STEPS_H

#include <stdint.h>

#include "sim/route.h"

enum { SIM_SIDE_RIGHT = -1, SIM_SIDE_LEFT = 1 };

typedef enum { SIM_GAIT_WALK, SIM_GAIT_RUN, SIM_GAIT_STAIRS, SIM_GAIT_SHUFFLE } sim_gait_kind_t;

typedef struct {
    int side;
    sim_gait_kind_t kind;
    double strike_s;   /**< when the heel comes down */
    double swing_s;    /**< how long the foot has been in the air then */
    double pace_s;     /**< duration of the step: since the other foot's strike */
    sim_place_t place; /**< of the foot's origin when flat, and its yaw */
} sim_step_t;

typedef struct {
    sim_list_t steps; /**< of sim_step_t; the first two are where the feet stand at the start */
    double end_s;     /**< of the last standing */
} sim_steps_t;

/** Time 0 is the beginning of the lead-in. A refusal leaves nothing to free. */
bool sim_steps_plan(const sim_route_t *route, const sim_place_t *start,
                    const sim_settings_t *settings, uint64_t seed, sim_steps_t *steps,
                    sim_error_t *error);

void sim_steps_free(sim_steps_t *steps);

#endif
