/** @file magnet.h  The magnetic field of a building, and what a phone's magnetometer reads of it.
 *
 *      field = earth + dipoles of pieces of steel            outer frame
 *      reading = steps(soft iron x field in the phone + hard iron + noise)
 *
 *  The steel belongs to the building of `radio.building`: its places are drawn over the box of the
 *  plan, at all heights; without a plan there is none. y of the plan is north but for the
 *  declination. The phone's own iron is drawn by the walk's seed.
 *
 *      sim_magnet_t magnet;
 *      if (!sim_magnet_open(&magnet, &scenario, seed, &error)) ...
 *      sim_vec3_t reading_ut = sim_magnet_read(&magnet, &pose);
 *      sim_magnet_close(&magnet);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_MAGNET_H
#define INSOLE_SIM_MAGNET_H

#include "sim/algebra.h"
#include "sim/scenario.h"
#include "sim/seeds.h"

/** A piece of steel. */
typedef struct {
    sim_vec3_t at_m, moment_am2;
} sim_steel_t;

typedef struct {
    sim_magnet_settings_t settings;
    sim_vec3_t earth_ut;
    sim_list_t steel; /**< of sim_steel_t */
    sim_mat3_t soft;
    sim_vec3_t hard_ut;
    insole_rng_t noise;
} sim_magnet_t;

/** A refusal leaves nothing to free. */
bool sim_magnet_open(sim_magnet_t *magnet, const sim_scenario_t *scenario, uint64_t seed,
                     sim_error_t *error);

/** The field at a place, outer frame. */
sim_vec3_t sim_magnet_field(const sim_magnet_t *magnet, sim_vec3_t at_m);

/** One reading, phone axes. */
sim_vec3_t sim_magnet_read(sim_magnet_t *magnet, const sim_pose_t *pose);

void sim_magnet_close(sim_magnet_t *magnet);

#endif
