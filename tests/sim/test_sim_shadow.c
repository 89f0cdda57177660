/* SPDX-License-Identifier: MIT */
#include "sim/shadow.h"

#include "near.h"
#include "suite.h"

enum { FIELDS = 400, POINTS = 30 };

/* Mean of f(p) f(p + lag) over many fields and places. */
static double covariance(double sigma, double length_m, double lag_x_m, double lag_y_m)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 7);
    double sum = 0.0;
    for (int i = 0; i < FIELDS; i++) {
        sim_shadow_t shadow;
        sim_shadow_init(&shadow, sigma, length_m, &rng);
        for (int k = 0; k < POINTS; k++) {
            double x = 3.1 * length_m * k, y = 2.3 * length_m * (k % 5);
            sum += sim_shadow_at(&shadow, x, y) * sim_shadow_at(&shadow, x + lag_x_m, y + lag_y_m);
        }
    }
    return sum / (FIELDS * POINTS);
}

START_TEST(its_spread_is_as_asked_for)
{
    ASSERT_NEAR(sqrt(covariance(3.5, 4.0, 0.0, 0.0)), 3.5, 0.1, "dB");
    ASSERT_NEAR(covariance(0.0, 4.0, 0.0, 0.0), 0.0, 0.0, "dB");
}
END_TEST

static const double lags[] = {0.25, 0.5, 1.0, 1.5, 2.0, 3.0}; /* in lengths */

START_TEST(correlation_falls_with_distance_in_every_direction)
{
    for (size_t i = 0; i < sizeof lags / sizeof lags[0]; i++) {
        double lag = lags[i] * 4.0, expected = exp(-lags[i]);
        ASSERT_NEAR(covariance(1.0, 4.0, lag, 0.0), expected, 0.05, "1");
        ASSERT_NEAR(covariance(1.0, 4.0, 0.0, -lag), expected, 0.05, "1");
        ASSERT_NEAR(covariance(1.0, 4.0, 0.6 * lag, 0.8 * lag), expected, 0.05, "1");
    }
}
END_TEST

START_TEST(the_length_stretches_the_field)
{
    sim_shadow_t a, b;
    insole_rng_t rng;
    insole_rng_seed(&rng, 3);
    sim_shadow_init(&a, 2.0, 1.0, &rng);
    insole_rng_seed(&rng, 3);
    sim_shadow_init(&b, 2.0, 5.0, &rng);
    for (int i = 0; i < 50; i++) {
        ASSERT_NEAR(sim_shadow_at(&b, 5.0 * i, -3.0 * i), sim_shadow_at(&a, 1.0 * i, -0.6 * i),
                    1e-9, "dB");
    }
}
END_TEST

START_TEST(it_is_smooth)
{
    sim_shadow_t shadow;
    insole_rng_t rng;
    insole_rng_seed(&rng, 4);
    sim_shadow_init(&shadow, 3.5, 4.0, &rng);
    worst_t step = {0.0, 0.0}, bend = {0.0, 0.0};
    for (int i = 0; i < 10000; i++) {
        double x = 0.01 * i, h = 0.01;
        double f0 = sim_shadow_at(&shadow, x - h, 0.0), f1 = sim_shadow_at(&shadow, x, 0.0);
        double f2 = sim_shadow_at(&shadow, x + h, 0.0);
        worst_note(&step, fabs(f2 - f1), x);
        worst_note(&bend, fabs(f2 - 2.0 * f1 + f0), x);
    }
    ASSERT_WORST(step, 0.1, "dB in 1 cm");
    ASSERT_WORST(bend, 0.005, "dB in 1 cm");
}
END_TEST

START_TEST(each_draw_is_another_field)
{
    sim_shadow_t a, b;
    insole_rng_t rng;
    insole_rng_seed(&rng, 5);
    double sum = 0.0;
    for (int i = 0; i < 300; i++) {
        sim_shadow_init(&a, 1.0, 4.0, &rng);
        sim_shadow_init(&b, 1.0, 4.0, &rng);
        sum += sim_shadow_at(&a, 0.0, 0.0) * sim_shadow_at(&b, 0.0, 0.0) / 300.0;
    }
    ASSERT_NEAR(sum, 0.0, 0.2, "1");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/shadow");
    suite_add(suite, "spread", its_spread_is_as_asked_for);
    suite_add(suite, "correlation", correlation_falls_with_distance_in_every_direction);
    suite_add(suite, "length", the_length_stretches_the_field);
    suite_add(suite, "smooth", it_is_smooth);
    suite_add(suite, "draws", each_draw_is_another_field);
    return suite;
}
