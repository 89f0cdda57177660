/** @file torso.h  The trunk of a walker in motion, twice continuously differentiable.
 *
 *  The way is that of trunk.h with its corners in time rounded. On it come, in the walk:
 *
 *  - rise and fall: a leg of length l that stands on the ground carries the hips on an arc, so that
 *    they are l - sqrt(l^2 - d^2) lower where they are d ahead of or behind the foot. Knees and
 *    ankles leave a share of it; from step to step the weight changes feet within a part of the
 *    step. In a run the leg gives way in the middle of its stance instead;
 *  - surge: what the height gains the speed loses, in part;
 *  - sway and lean over the foot that carries, nod within the step, twist against the legs;
 *  - a ringing after each heel strike.
 *
 *  Frame: m or n, z up; z counts on the soles' level.
 *
 *      sim_torso_t torso;
 *      if (!sim_torso_plan(&steps, &settings.person, &person, seed, &torso, &error)) ...
 *      sim_trunk_motion_t now = sim_torso_at(&torso, t_s);       any t, in any order
 *      sim_torso_free(&torso);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_TORSO_H
#define INSOLE_SIM_TORSO_H

#include "sim/algebra.h"
#include "sim/person.h"
#include "sim/steps.h"

enum { SIM_RIGHT, SIM_LEFT, SIM_SIDES };

/** From one event to the next the trunk's way is straight and even. */
typedef struct {
    double t_s;
    double at[4];   /**< x, y, z, heading without jumps of 2 pi */
    double rate[4]; /**< from here on, 1/s */
} sim_way_knot_t;

/** A time in which one foot carries, or both do. */
typedef struct {
    double begin_s, length_s;
    double handover_s; /**< half of the time in which the weight comes */
    double x_m, y_m;   /**< of the foot, or the middle of both */
    int side;          /**< SIM_SIDE_*; 0: standing on both */
    double bounce;     /**< times the arc */
    double size;       /**< of all else: step length over 0.7 m */
    double leg_rad;    /**< legs to each side of upright at the ends */
    double surge_m;
} sim_stance_t;

typedef struct {
    double t_s, size;
    int foot; /**< SIM_RIGHT, SIM_LEFT */
} sim_jolt_t;

typedef struct {
    sim_list_t knots, stances, jolts;
    sim_person_settings_t settings;
    double leg_m;
} sim_torso_t;

typedef struct {
    sim_vec3_t position_m;  /**< of the hips, without their height over the soles */
    double heading_rad;     /**< without twist; no jumps of 2 pi */
    double rise_m;          /**< bounce and ringing, part of position.z; walking below 0 */
    sim_vec3_t turn_rad;    /**< small, about ahead, left, up */
    double size;            /**< of the steps, over 0.7 m; 0 standing */
    double thigh_rad;       /**< of the left leg ahead of upright; the right leg has minus that */
    double lift[SIM_SIDES]; /**< 0 to 1 to 0 while that leg swings */
    double jolt_s2[SIM_SIDES]; /**< what is left of that foot's strike, upwards: m per m/s^2 */
} sim_trunk_motion_t;

/** A refusal leaves nothing to free. */
bool sim_torso_plan(const sim_steps_t *steps, const sim_person_settings_t *settings,
                    const sim_person_t *person, uint64_t seed, sim_torso_t *torso,
                    sim_error_t *error);

sim_trunk_motion_t sim_torso_at(const sim_torso_t *torso, double t_s);

/** How far bounce and ringing move the trunk upwards. */
double sim_torso_rise(const sim_torso_t *torso, double t_s);

void sim_torso_free(sim_torso_t *torso);

#endif
