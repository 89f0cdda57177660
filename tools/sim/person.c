/* SPDX-License-Identifier: MIT */
#include "sim/person.h"

#include <math.h>

#include "sim/seeds.h"

static double varied(insole_rng_t *rng, double spread)
{
    return 1.0 + spread * fmax(-2.0, fmin(2.0, (double)insole_rng_normal(rng)));
}

sim_person_t sim_person(const sim_person_settings_t *settings, uint64_t seed)
{
    insole_rng_t rng;
    sim_seed(&rng, seed, SIM_SEED_PERSON);
    double size = varied(&rng, settings->leg_spread);
    double habit = varied(&rng, settings->step_spread);
    sim_person_t person = {settings->leg_m * size, size * habit,
                           settings->bounce * varied(&rng, settings->bounce_spread)};
    return person;
}
