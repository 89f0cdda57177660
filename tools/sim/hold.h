/** @file hold.h  How a phone is carried: where it is and how it is turned on a moving trunk.
 *
 *  Four ways: looked at in the hand before the chest, at the ear, in the hand of an arm that
 *  swings, in a trouser pocket on the thigh. Each has a turn of its own when nothing moves, and
 *  deviates from it by a vector that stays well below a half turn, so that two ways can be blended.
 *
 *  Axes: trunk ahead, left, up, on the way's heading; origin at the soles' level under the hips.
 *  Phone: x to the right, y to the top edge, z out of the screen.
 *
 *      sim_hold_t hold;
 *      sim_hold_init(&hold, &settings.phone, leg_m, seed);
 *      sim_held_t at = sim_hold_at(&hold, SIM_POSE_HAND, &torso, &trunk, t_s);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_HOLD_H
#define INSOLE_SIM_HOLD_H

#include "sim/torso.h"
#include "sim/waves.h"

typedef struct {
    sim_phone_settings_t settings;
    double size; /**< of the person: 1 for a leg of 0.9 m */
    double side; /**< of the arm or leg: 1 left, -1 right */
    double rock;
    sim_mat3_t rest[SIM_POSES]; /**< trunk from phone when nothing moves */
    sim_waves_t wander[3], tremor[3];
} sim_hold_t;

typedef struct {
    sim_vec3_t at_m;     /**< trunk axes */
    sim_vec3_t turn_rad; /**< after `rest`, about trunk axes */
} sim_held_t;

void sim_hold_init(sim_hold_t *hold, const sim_phone_settings_t *settings, double leg_m,
                   uint64_t seed);

/** @param pose   one of SIM_POSE_*
 *  @param torso  that carries it; what arms do comes later
 *  @param trunk  its motion now */
sim_held_t sim_hold_at(const sim_hold_t *hold, int32_t pose, const sim_torso_t *torso,
                       const sim_trunk_motion_t *trunk, double t_s);

#endif
