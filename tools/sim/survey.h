/** @file survey.h  What a survey finds at its reference points: radiomap.csv.
 *
 *  Header `x,y,id,mean_dbm,std_dbm,count`: for every point and access point, of the readings made
 *  while the walker stood there. Readings that come late count where they were heard.
 *
 *      if (!sim_survey_write(walk, &scenario, &heard, "out", &error)) ...
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_SURVEY_H
#define INSOLE_SIM_SURVEY_H

#include "sim/scans.h"

/** Writes the file into the folder, if the scenario has surveys.
 *  @param heard  of the walk, by sim_scans_make */
bool sim_survey_write(const sim_walk_t *walk, const sim_scenario_t *scenario,
                      const sim_list_t *heard, const char *folder, sim_error_t *error);

#endif
