/** @file radio.h  How strong the access points of a building are at a place: the simulator's truth.
 *
 *      mean = p0 - 10 n lg(distance) - walls - shadowing - body(angle) + receiver
 *      received = steps(mean + fading), if heard
 *
 *  p0, n and the loss of each wall differ from what aps.csv and plan.csv tell by amounts that
 *  belong to the building; several walls take less than their sum; shadowing is a field of its own
 *  for each access point (shadow.h); the body takes most from what comes from behind; fading is
 *  that of a direct path with scattered ones (Rice); people who walk in between take some; weak
 * signals are heard by chance. A matched model has the told p0, n and walls, and white noise alone;
 * it hears what has a mean above the floor.
 *
 *      sim_radio_t radio;
 *      if (!sim_radio_open(&radio, &scenario, seed, &error)) ...
 *      if (sim_radio_hear(&radio, ap, at_m, heading_rad, &dbm)) ...
 *      sim_radio_close(&radio);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_RADIO_H
#define INSOLE_SIM_RADIO_H

#include "sim/algebra.h"
#include "sim/scenario.h"
#include "sim/seeds.h"
#include "sim/shadow.h"

/** An access point as it is. */
typedef struct {
    sim_vec3_t at_m;
    double p0_dbm, exponent;
    sim_shadow_t shadow;
    double crowd; /**< how much of the way people take now: Gauss-Markov, 1-sigma 1 */
} sim_source_t;

typedef struct {
    sim_radio_settings_t settings; /**< without what the model does not have */
    const sim_plan_t *plan;
    sim_list_t sources;   /**< of sim_source_t, in the order of the file */
    sim_list_t losses_db; /**< of double: of each ring and inner wall */
    double offset_db;     /**< of the receiver */
    insole_rng_t noise, people;
} sim_radio_t;

/** The scenario must outlive the radio. A refusal leaves nothing to free. */
bool sim_radio_open(sim_radio_t *radio, const sim_scenario_t *scenario, uint64_t seed,
                    sim_error_t *error);

/** Received strength without fading, steps and chance.
 *  @param heading_rad  where the walker looks */
double sim_radio_mean(const sim_radio_t *radio, size_t ap, sim_vec3_t at_m, double heading_rad);

/** People walk about for some time, >= 0 s. */
void sim_radio_wait(sim_radio_t *radio, double seconds);

/** One reading; false when the access point is not heard. Draws the same amount of chance for
 *  every reading. */
bool sim_radio_hear(sim_radio_t *radio, size_t ap, sim_vec3_t at_m, double heading_rad,
                    double *dbm);

/** Mean over places round the access point, 1.5 m off and at the height of the radio, that no wall
 *  parts from it, and over all directions to look. */
double sim_radio_near(const sim_radio_t *radio, size_t ap, double z_m);

void sim_radio_close(sim_radio_t *radio);

#endif
