/* SPDX-License-Identifier: MIT */
#include "sim/waves.h"

#include "near.h"
#include "suite.h"

START_TEST(they_have_one_rms)
{
    insole_rng_t rng;
    double squares = 0.0, sum = 0.0;
    int n = 400000;
    sim_waves_t waves;
    insole_rng_seed(&rng, 3);
    sim_waves_init(&waves, 0.5, 5.0, &rng);
    for (int i = 0; i < n; i++) {
        double value = sim_waves_at(&waves, 0.01 * i);
        squares += value * value / n;
        sum += value / n;
    }
    ASSERT_NEAR(sqrt(squares), 1.0, 0.01, "1");
    ASSERT_NEAR(sum, 0.0, 0.01, "1");
}
END_TEST

START_TEST(frequencies_are_spread_over_the_band)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 4);
    for (int draw = 0; draw < 100; draw++) {
        sim_waves_t waves;
        sim_waves_init(&waves, 2.0, 2.0 * 64.0, &rng);
        for (int i = 0; i < SIM_WAVES; i++) { /* one in each octave */
            double hz = waves.radps[i] / (2.0 * SIM_PI);
            ASSERT_AT_LEAST(hz, 2.0 * pow(2.0, i) - 1e-9, "Hz");
            ASSERT_AT_MOST(hz, 4.0 * pow(2.0, i) + 1e-9, "Hz");
        }
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/waves");
    suite_add(suite, "rms", they_have_one_rms);
    suite_add(suite, "band", frequencies_are_spread_over_the_band);
    return suite;
}
