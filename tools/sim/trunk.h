/** @file trunk.h  Where the walker's trunk is and looks: between the feet.
 *
 *  From one footfall to the next it goes evenly from the middle of the last two footfalls to that
 *  of the next two, and looks along the mean of their yaws.
 *
 *      sim_place_t at = sim_trunk_at(&steps, t_s);           z on the sole's level
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_TRUNK_H
#define INSOLE_SIM_TRUNK_H

#include "sim/steps.h"

sim_place_t sim_trunk_at(const sim_steps_t *steps, double t_s);

#endif
