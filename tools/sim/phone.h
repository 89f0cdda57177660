/** @file phone.h  A phone that somebody carries: its pose at any time.
 *
 *  Trunk (torso.h), the way it is carried (hold.h) and when that changes (changes.h) in one body
 *  for motion.h. A change goes smoothly from one place and turn to the other.
 *
 *      sim_phone_t phone;
 *      if (!sim_phone_plan(&scenario, &steps, seed, &phone, &error)) ...
 *      sim_pose_t pose = sim_phone_pose(&phone, t_s);           any t, in any order
 *      sim_phone_free(&phone);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_PHONE_H
#define INSOLE_SIM_PHONE_H

#include "sim/changes.h"
#include "sim/hold.h"

typedef struct {
    sim_torso_t torso;
    sim_hold_t hold;
    sim_changes_t changes;
} sim_phone_t;

/** A refusal leaves nothing to free. */
bool sim_phone_plan(const sim_scenario_t *scenario, const sim_steps_t *steps, uint64_t seed,
                    sim_phone_t *phone, sim_error_t *error);

/** Outer frame from phone. */
sim_pose_t sim_phone_pose(const sim_phone_t *phone, double t_s);

void sim_phone_free(sim_phone_t *phone);

#endif
