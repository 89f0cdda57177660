/** @file carried.h  What scores the log of a phone, and no estimator sees: pose.csv and steps.csv.
 *
 *  `pose.csv`, header `t,pose`: from then on the phone is carried that way, hand, ear, swing or
 *  pocket, or on its way from one to the other, change. `steps.csv`, header `t,foot,kind`: every
 *  footfall, kind walk, run, stairs or shuffle (turning on the spot).
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_CARRIED_H
#define INSOLE_SIM_CARRIED_H

#include "sim/walk.h"

/** Writes both files into the folder, if the walker has a phone. */
bool sim_carried_write(const sim_walk_t *walk, const char *folder, sim_error_t *error);

#endif
