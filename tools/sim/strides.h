/** @file strides.h  Makes the movement of one foot out of the footfalls of both.
 *
 *  Times of the pitch's transitions are shares of the swing's duration; their sizes grow with the
 *  stride. The tables in strides.c hold what makes a walk a walk and a run a run.
 *
 *      sim_gait_t gait;
 *      if (!sim_strides_plan(&steps, &settings.gait, seed, &gait, &error)) ...
 *      sim_strides_free(&gait);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_STRIDES_H
#define INSOLE_SIM_STRIDES_H

#include "sim/gait.h"

/** A refusal leaves nothing to free. */
bool sim_strides_plan(const sim_steps_t *steps, const sim_gait_settings_t *settings, uint64_t seed,
                      sim_gait_t *gait, sim_error_t *error);

void sim_strides_free(sim_gait_t *gait);

#endif
