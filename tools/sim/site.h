/** @file site.h  What the user of a simulated log gets to know about the building.
 *
 *  `plan.csv` is the scenario's plan as it is. `aps.csv` tells what the scenario's file tells;
 * where `radio.near = surveyed` its near_dbm is what a survey would have found 1.5 m from each
 * access point.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_SITE_H
#define INSOLE_SIM_SITE_H

#include <stdint.h>

#include "sim/scenario.h"

/** Makes a file in a folder; NULL when that cannot be done. */
FILE *sim_site_create(const char *folder, const char *name, sim_error_t *error);

/** Closes it; false when something did not reach it. NULL is no file, and false. */
bool sim_site_close(FILE *stream);

/** Writes plan.csv and aps.csv into a folder, if the scenario names them. */
bool sim_site_write(const char *scenario_path, const sim_scenario_t *scenario, uint64_t seed,
                    const char *folder, sim_error_t *error);

#endif
