/* SPDX-License-Identifier: MIT */
#include "sim/shadow.h"

#include <math.h>

#include "sim/algebra.h"

static const double largest_wave = 20.0; /* times 1 / length */

/* Wave number below which the share 1 - u of the spectrum (1 + k^2)^(-3/2) in the plane lies. */
static double wave_number(double u)
{
    return fmin(largest_wave, sqrt(1.0 / (u * u) - 1.0));
}

void sim_shadow_init(sim_shadow_t *shadow, double sigma, double length_m, insole_rng_t *rng)
{
    shadow->amplitude = sigma * sqrt(2.0 / SIM_SHADOW_WAVES);
    for (int i = 0; i < SIM_SHADOW_WAVES; i++) {
        double rank =
            (i + 1.0 - (double)insole_rng_uniform(rng)) / SIM_SHADOW_WAVES; /* in (0, 1] */
        double k = wave_number(rank) / length_m;
        double direction = 2.0 * SIM_PI * (double)insole_rng_uniform(rng);
        shadow->x_radpm[i] = k * cos(direction);
        shadow->y_radpm[i] = k * sin(direction);
        shadow->phase_rad[i] = 2.0 * SIM_PI * (double)insole_rng_uniform(rng);
    }
}

double sim_shadow_at(const sim_shadow_t *shadow, double x_m, double y_m)
{
    double sum = 0.0;
    for (int i = 0; i < SIM_SHADOW_WAVES; i++) {
        sum += cos(shadow->x_radpm[i] * x_m + shadow->y_radpm[i] * y_m + shadow->phase_rad[i]);
    }
    return shadow->amplitude * sum;
}
