/** @file waves.h  A trembling or wandering: a sum of sines of random frequencies, 1 rms.
 *
 *      sim_waves_t slow;
 *      sim_waves_init(&slow, 0.03, 0.3, &rng);
 *      tilt_rad += 0.05 * sim_waves_at(&slow, t_s);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_WAVES_H
#define INSOLE_SIM_WAVES_H

#include "insole/base/rng.h"
#include "sim/algebra.h"

enum { SIM_WAVES = 6 };

typedef struct {
    double radps[SIM_WAVES], phase_rad[SIM_WAVES];
} sim_waves_t;

/** One frequency in each of six bands of equal ratio from low to high. */
static inline void sim_waves_init(sim_waves_t *waves, double low_hz, double high_hz,
                                  insole_rng_t *rng)
{
    for (int i = 0; i < SIM_WAVES; i++) {
        double share = (i + (double)insole_rng_uniform(rng)) / SIM_WAVES;
        waves->radps[i] = 2.0 * SIM_PI * low_hz * pow(high_hz / low_hz, share);
        waves->phase_rad[i] = 2.0 * SIM_PI * (double)insole_rng_uniform(rng);
    }
}

static inline double sim_waves_at(const sim_waves_t *waves, double t_s)
{
    double sum = 0.0;
    for (int i = 0; i < SIM_WAVES; i++) {
        sum += sin(waves->radps[i] * t_s + waves->phase_rad[i]);
    }
    return sum * sqrt(2.0 / SIM_WAVES);
}

#endif
