/** @file scans.h  What the radio of a walk puts into the log, and when.
 *
 *      sim_list_t heard;
 *      if (!sim_scans_make(walk, &scenario, seed, &heard, &error)) ...
 *      const sim_heard_t *first = sim_list_at(&heard, 0);    in the order of the log
 *      sim_list_free(&heard);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_SCANS_H
#define INSOLE_SIM_SCANS_H

#include "sim/radio.h"
#include "sim/walk.h"

/** One access point of one scan. */
typedef struct {
    double t_s;   /**< in the log */
    double age_s; /**< how long before that it was heard */
    size_t ap;
    double dbm;
} sim_heard_t;

/** All that is heard in the time of the walk, into a list of sim_heard_t; nothing when the
 *  scenario has no access points. A refusal leaves nothing to free. */
bool sim_scans_make(const sim_walk_t *walk, const sim_scenario_t *scenario, uint64_t seed,
                    sim_list_t *heard, sim_error_t *error);

#endif
