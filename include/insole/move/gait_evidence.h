/** @file gait_evidence.h  Which part of a walker's motion goes ahead, and which end of it that is.
 *
 *  Frames  n: local level, z up.
 *
 *  Along the way a trunk moves at the frequency of the steps; it sways at half of it. The trunk
 *  falls from midstance to heel strike and is pushed on meanwhile: its forward acceleration leads
 *  the vertical one by a quarter of a step, that of a hand or a leg by less, none by more than a
 *  half. An arm or a thigh swings farther and higher ahead than back: at the frequency of a stride
 *  the forward acceleration goes with the vertical one, where a pendulum's own rise, twice as fast,
 *  does not take part.
 *
 *      S = insole_gait_ahead_scatter(&moments, sway_weight);
 *      v = insole_gait_ahead(&moments, lead_rad, tilt_rad2);        points ahead
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_GAIT_EVIDENCE_H
#define INSOLE_MOVE_GAIT_EVIDENCE_H

#include "insole/move/gait_motion.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The scatter of a window, of which all that is not of a step's frequency counts `sway_weight`:
 *  an arm that swings still outweighs its own sway. 1: the scatter itself. */
insole_sym3_t insole_gait_ahead_scatter(const insole_gait_moments_t *moments,
                                        insole_real_t sway_weight);

/** Products of the level acceleration with the vertical one, of a step's frequency and of a
 *  stride's, weighed by their size: at most of length 1 in the level plane.
 *  @param lead_rad   phase by which a step's forward acceleration leads the vertical one
 *  @param tilt_rad2  variance of a tilt: what it may have feigned counts less */
insole_vec3_t insole_gait_ahead(const insole_gait_moments_t *moments, insole_real_t lead_rad,
                                insole_real_t tilt_rad2);

#ifdef __cplusplus
}
#endif

#endif
