/* SPDX-License-Identifier: MIT */
#include "insole/place/spot_mixture.h"

#include "fingerprints.h"
#include "suite.h"

enum { PLACES = 500 };

static insole_rng_t rng;
static insole_spot_t spots[PLACES];
static double logs[PLACES];

static insole_spot_mixture_t mix(uint32_t count)
{
    insole_spot_mixture_t mixture = insole_spot_mixture_empty();
    for (uint32_t i = 0; i < count; i++) {
        insole_spot_mixture_add(&mixture, i, spots[i], (insole_real_t)logs[i]);
    }
    return mixture;
}

static void scatter(uint32_t count, double far_m, double wide)
{
    for (uint32_t i = 0; i < count; i++) {
        spots[i].x_m = (insole_real_t)(far_m + prints_uniform(&rng, -50.0, 50.0));
        spots[i].y_m = (insole_real_t)(-far_m + prints_uniform(&rng, -20.0, 20.0));
        logs[i] = (double)(insole_real_t)prints_uniform(&rng, -wide, wide);
    }
}

/* Weights of every scale, near and far from the origin. */
START_TEST(direct_sums)
{
    static const double far_m[] = {0.0, 0.0, 0.0, 1e4}, wide[] = {0.1, 3.0, 1000.0, 3.0};
    double rounding = PLACES * (double)INSOLE_REAL_EPSILON; /* of a sum, relative, at worst */
    insole_rng_seed(&rng, 20u);
    for (int round = 0; round < 100; round++) {
        scatter(PLACES, far_m[_i], wide[_i]);
        insole_spot_mixture_t mixture = mix(PLACES);
        prints_moments_t m = prints_moments(spots, logs, PLACES);
        insole_radio_fix_t fix = {0};
        double spread_m2 = 4.0 + 1.5 * (m.xx + m.yy) + far_m[_i]; /* far away a place itself is rounded */
        insole_spot_mixture_cov(&mixture, mixture.mean, INSOLE_R(2.0), INSOLE_R(1.5), &fix);
        ASSERT_NEAR(fix.spot.x_m, m.x_m, 1e-4 + 1e-6 * far_m[_i], "m");
        ASSERT_NEAR(fix.spot.y_m, m.y_m, 1e-4 + 1e-6 * far_m[_i], "m");
        ASSERT_NEAR(fix.var_x_m2, 4.0 + 1.5 * m.xx, spread_m2 * rounding, "m2");
        ASSERT_NEAR(fix.cov_xy_m2, 1.5 * m.xy, spread_m2 * rounding, "m2");
        ASSERT_NEAR(fix.var_y_m2, 4.0 + 1.5 * m.yy, spread_m2 * rounding, "m2");
        ck_assert_uint_eq(fix.likeliest, m.likeliest);
        ck_assert_uint_eq(fix.points, PLACES);
        ASSERT_NEAR(fix.log_weight, logs[m.likeliest], 0.0, "");
    }
}
END_TEST

/* Only differences of the logarithms count; order does not. */
START_TEST(common_factor_and_order)
{
    insole_rng_seed(&rng, 21u);
    scatter(40, 0.0, 4.0);
    insole_spot_mixture_t before = mix(40);
    for (int i = 0; i < 40; i++) {
        logs[i] -= 64.0;
    }
    for (int i = 0; i < 20; i++) {
        insole_spot_t spot = spots[i];
        double log_weight = logs[i];
        spots[i] = spots[39 - i];
        logs[i] = logs[39 - i];
        spots[39 - i] = spot;
        logs[39 - i] = log_weight;
    }
    insole_spot_mixture_t after = mix(40);
    ASSERT_NEAR(after.mean.x_m, before.mean.x_m, 1e-4, "m");
    ASSERT_NEAR(after.mean.y_m, before.mean.y_m, 1e-4, "m");
    ASSERT_NEAR(after.xx / after.weight, before.xx / before.weight, 2e-3, "m2");
    ASSERT_NEAR(after.yy / after.weight, before.yy / before.weight, 2e-3, "m2");
    ck_assert_uint_eq(after.likeliest, 39u - before.likeliest);
}
END_TEST

/* About another place than the mean, the mean square grows by the square of the way. */
START_TEST(about_another_place)
{
    insole_rng_seed(&rng, 22u);
    scatter(30, 0.0, 2.0);
    insole_spot_mixture_t mixture = mix(30);
    prints_moments_t m = prints_moments(spots, logs, 30);
    insole_radio_fix_t fix = {0};
    insole_spot_mixture_cov(&mixture, mixture.top, INSOLE_R(1.0), INSOLE_R(2.0), &fix);
    double x_m = (double)spots[m.likeliest].x_m - m.x_m,
           y_m = (double)spots[m.likeliest].y_m - m.y_m;
    ASSERT_NEAR(fix.var_x_m2, 1.0 + 2.0 * (m.xx + x_m * x_m), 5e-3, "m2");
    ASSERT_NEAR(fix.cov_xy_m2, 2.0 * (m.xy + x_m * y_m), 5e-3, "m2");
    ASSERT_NEAR(fix.var_y_m2, 1.0 + 2.0 * (m.yy + y_m * y_m), 5e-3, "m2");
    ASSERT_NEAR(fix.spot.x_m, spots[m.likeliest].x_m, 0.0, "m");
}
END_TEST

START_TEST(one_place_and_equals)
{
    spots[0].x_m = 3;
    spots[0].y_m = -4;
    spots[1] = spots[0];
    logs[0] = logs[1] = -1e30;
    for (uint32_t count = 1; count <= 2u; count++) {
        insole_spot_mixture_t mixture = mix(count);
        insole_radio_fix_t fix = {0};
        insole_spot_mixture_cov(&mixture, mixture.mean, INSOLE_R(2.0), INSOLE_R(1.0), &fix);
        ASSERT_NEAR(fix.spot.x_m, 3.0, 0.0, "m");
        ASSERT_NEAR(fix.spot.y_m, -4.0, 0.0, "m");
        ASSERT_NEAR(fix.var_x_m2, 4.0, 0.0, "m2");
        ASSERT_NEAR(fix.cov_xy_m2, 0.0, 0.0, "m2");
        ck_assert_uint_eq(fix.likeliest, 0u);
    }
}
END_TEST

START_TEST(what_is_not_finite_is_passed_over)
{
    insole_rng_seed(&rng, 23u);
    scatter(10, 0.0, 2.0);
    insole_spot_mixture_t mixture = mix(10), before = mixture;
    insole_spot_t bad = {(insole_real_t)NAN, 0};
    insole_spot_mixture_add(&mixture, 10, bad, 0);
    insole_spot_mixture_add(&mixture, 10, spots[0], (insole_real_t)NAN);
    insole_spot_mixture_add(&mixture, 10, spots[0], (insole_real_t)INFINITY);
    insole_spot_mixture_add(&mixture, 10, spots[0], -(insole_real_t)INFINITY);
    ck_assert_mem_eq(&mixture, &before, sizeof mixture);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("spot_mixture");
    suite_add_loop(suite, "direct sums", direct_sums, 4);
    suite_add(suite, "common factor and order", common_factor_and_order);
    suite_add(suite, "about another place", about_another_place);
    suite_add(suite, "one place, equals", one_place_and_equals);
    suite_add(suite, "not finite", what_is_not_finite_is_passed_over);
    return suite;
}
