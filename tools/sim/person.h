/** @file person.h  Who walks with the phone: what differs from person to person, drawn by seed.
 *
 *      sim_person_t person = sim_person(&settings.person, seed);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_PERSON_H
#define INSOLE_SIM_PERSON_H

#include "sim/settings.h"

typedef struct {
    double leg_m;  /**< height of the hips over the soles */
    double steps;  /**< step length over that of the settings at the same speed */
    double bounce; /**< share of the rise and fall over stiff legs */
} sim_person_t;

/** Nobody is more than two sigmas from the mean. */
sim_person_t sim_person(const sim_person_settings_t *settings, uint64_t seed);

#endif
