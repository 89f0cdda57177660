/** @file shadow.h  A random field over the plane: shadowing that changes slowly from place to
 * place.
 *
 *  A sum of cosines of random wave vectors and phases. Its covariance over many seeds is
 *  sigma^2 exp(-distance / length); the wave numbers are drawn from the spectrum of that, evenly
 *  by rank, and cut at 20 / length, so that the field is smooth.
 *
 *      sim_shadow_t shadow;
 *      sim_shadow_init(&shadow, 3.5, 4.0, &rng);
 *      loss_db = sim_shadow_at(&shadow, x_m, y_m);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_SHADOW_H
#define INSOLE_SIM_SHADOW_H

#include "insole/base/rng.h"

enum { SIM_SHADOW_WAVES = 64 };

typedef struct {
    double amplitude;
    double x_radpm[SIM_SHADOW_WAVES], y_radpm[SIM_SHADOW_WAVES], phase_rad[SIM_SHADOW_WAVES];
} sim_shadow_t;

/** @param length_m  distance at which the correlation is 1/e; > 0 */
void sim_shadow_init(sim_shadow_t *shadow, double sigma, double length_m, insole_rng_t *rng);

double sim_shadow_at(const sim_shadow_t *shadow, double x_m, double y_m);

#endif
