/** @file changes.h  When the phone is carried another way, and when a standing walker fidgets.
 *
 *  Changes are those of the scenario, or, without any, drawn by seed.
 *
 *      sim_changes_t changes;
 *      if (!sim_changes_plan(&scenario, &torso, end_s, seed, &changes, &error)) ...
 *      sim_changes_free(&changes);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_CHANGES_H
#define INSOLE_SIM_CHANGES_H

#include "sim/scenario.h"
#include "sim/torso.h"

/** The phone is turned about and back. */
typedef struct {
    double begin_s, length_s;
    sim_vec3_t turn_rad; /**< the furthest, about ahead, left, up */
} sim_fidget_t;

typedef struct {
    sim_list_t poses;   /**< of sim_pose_change_t; the first at 0 s */
    sim_list_t fidgets; /**< of sim_fidget_t, one after the other */
} sim_changes_t;

/** A refusal leaves nothing to free. */
bool sim_changes_plan(const sim_scenario_t *scenario, const sim_torso_t *torso, double end_s,
                      uint64_t seed, sim_changes_t *changes, sim_error_t *error);

void sim_changes_free(sim_changes_t *changes);

#endif
