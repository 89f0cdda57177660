/* SPDX-License-Identifier: MIT */
#include "insole/move/step_length.h"

#include <string.h>

#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "setting.h"
#include "suite.h"

static insole_step_length_config_t config;
static insole_footfall_t step;

static void setup(void)
{
    config = insole_step_length_defaults;
    memset(&step, 0, sizeof step);
    step.begin_us = 7000000u;
    step.end_us = 7500000u;
    step.peak_mps2 = INSOLE_R(3.0);
    step.range_mps2 = INSOLE_R(6.25);
    step.accel_sigma_mps2 = INSOLE_R(3.0);
}

static double length_m(void)
{
    insole_real_t answer = INSOLE_R(-1.0);
    ck_assert_int_eq(insole_step_length(&config, &step, &answer), INSOLE_OK);
    return (double)answer;
}

START_TEST(models_by_hand)
{
    config.root_degree = INSOLE_R(2.0);
    config.root_scale = INSOLE_R(0.3);
    ASSERT_NEAR(length_m(), 0.3 * 2.5, 1e-6, "m");
    config.model = INSOLE_STEP_LENGTH_LINEAR;
    config.linear_alpha = INSOLE_R(0.2);
    config.linear_beta = INSOLE_R(0.03);
    config.linear_gamma = INSOLE_R(-0.1);
    ASSERT_NEAR(length_m(), 0.2 * 2.0 + 0.03 * 9.0 - 0.1, 1e-6, "m");
    config.model = INSOLE_STEP_LENGTH_MIXED;
    config.mixed_a = INSOLE_R(0.25);
    config.mixed_b = INSOLE_R(0.1);
    config.mixed_c = INSOLE_R(0.2);
    ASSERT_NEAR(length_m(), 0.25 + 0.1 * 2.0 + 0.2 * 2.5, 1e-6, "m");
    config.model = INSOLE_STEP_LENGTH_CONSTANT;
    config.constant_m = INSOLE_R(0.71);
    ASSERT_NEAR(length_m(), 0.71, 1e-6, "m");
}
END_TEST

/* The root of every degree against libm, in double. */
START_TEST(root_of_every_degree)
{
    worst_t worst = {0.0, 0.0};
    config.max_m = INSOLE_R(3.0);
    config.min_m = INSOLE_R(0.01);
    for (double degree = 1.0; degree <= 12.0; degree += 0.25) {
        for (double range = 0.02; range < 100.0; range *= 1.3) {
            config.root_degree = (insole_real_t)degree;
            step.range_mps2 = (insole_real_t)range;
            double expected =
                (double)config.root_scale * pow((double)step.range_mps2, 1.0 / degree);
            expected = fmin(fmax(expected, (double)config.min_m), 3.0);
            worst_note(&worst, fabs(length_m() / expected - 1.0), degree);
        }
    }
    ASSERT_WORST(worst, 3e-6, "of the length");
}
END_TEST

START_TEST(root_grows_with_the_range)
{
    double last_m = 0.0;
    for (double range = 0.5; range < 60.0; range *= 1.2) {
        step.range_mps2 = (insole_real_t)range;
        ck_assert(length_m() > last_m);
        last_m = length_m();
    }
    step.range_mps2 = 0;
    ASSERT_NEAR(length_m(), config.min_m, 0.0, "m");
}
END_TEST

START_TEST(defaults_are_a_walkers)
{
    for (int model = 0; model <= 3; model++) {
        config.model = model;
        step.end_us = step.begin_us + 540000u;
        step.range_mps2 = INSOLE_R(6.9);
        step.accel_sigma_mps2 = INSOLE_R(3.3);
        ASSERT_NEAR(length_m(), 0.66, 0.03, "m");
    }
}
END_TEST

START_TEST(frequency_has_ends)
{
    config.model = INSOLE_STEP_LENGTH_LINEAR;
    config.linear_alpha = INSOLE_R(0.3);
    config.linear_beta = config.linear_gamma = 0;
    step.end_us = step.begin_us + 300000u;
    double shortest = length_m();
    step.end_us = step.begin_us + 1u;
    ASSERT_NEAR(length_m(), shortest, 0.0, "m");
    ASSERT_NEAR(shortest, 0.3 / 0.3, 1e-6, "m");
    step.end_us = step.begin_us + 1000000u;
    double longest = length_m();
    step.end_us = UINT64_MAX;
    ASSERT_NEAR(length_m(), longest, 0.0, "m");
    ASSERT_NEAR(longest, 0.3, 1e-6, "m");
}
END_TEST

/* Whatever the coefficients and the step, the length is one of a human being. */
START_TEST(length_stays_within_its_ends)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 9u);
    worst_t inside = {0.0, 0.0};
    for (int i = 0; i < 20000; i++) {
        config.model = i % 3;
        config.linear_alpha = sample_between(&rng, -5, 5);
        config.linear_beta = sample_between(&rng, -1, 1);
        config.mixed_b = sample_between(&rng, -5, 5);
        config.mixed_c = sample_between(&rng, -5, 5);
        config.root_degree = sample_between(&rng, 1, 12);
        step.range_mps2 = (insole_real_t)pow(10.0, (double)sample_between(&rng, -37, 6));
        step.accel_sigma_mps2 = (insole_real_t)pow(10.0, (double)sample_between(&rng, -37, 6));
        double m = length_m();
        worst_require(&inside, m >= (double)config.min_m && m <= (double)config.max_m, i);
    }
    ASSERT_ALL_HELD(inside);
}
END_TEST

static void refuse(insole_status_t expected)
{
    insole_real_t answer = INSOLE_R(7.0);
    ck_assert_int_eq(insole_step_length(&config, &step, &answer), expected);
    ASSERT_NEAR(answer, 7.0, 0.0, "m");
}

START_TEST(bad_steps_are_refused)
{
    static const double BAD[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, -0.001, 1.001e6};
    for (int i = 0; i < 5; i++) {
        setup();
        step.range_mps2 = (insole_real_t)BAD[i];
        refuse(INSOLE_ERR_VALUE);
        setup();
        step.accel_sigma_mps2 = (insole_real_t)BAD[i];
        refuse(INSOLE_ERR_VALUE);
    }
    setup();
    step.end_us = step.begin_us;
    refuse(INSOLE_ERR_TIME);
    step.end_us = step.begin_us - 1u;
    refuse(INSOLE_ERR_TIME);
}
END_TEST

static insole_status_t judge(void)
{
    insole_real_t answer;
    return insole_step_length(&config, &step, &answer);
}

START_TEST(settings_have_ends){INSOLE_STEP_LENGTH_KEYS(SETTING_HAS_ENDS)} END_TEST

    START_TEST(bad_arguments_are_refused)
{
    insole_real_t answer;
    ck_assert_int_eq(insole_step_length(NULL, &step, &answer), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_length(&config, NULL, &answer), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_length(&config, &step, NULL), INSOLE_ERR_NULL);
}
END_TEST

static void add(Suite *suite, const char *behaviour, const TTest *test)
{
    TCase *tcase = tcase_create(behaviour);
    tcase_add_checked_fixture(tcase, setup, NULL);
    tcase_add_test(tcase, test);
    suite_add_tcase(suite, tcase);
}

Suite *insole_suite(void)
{
    Suite *suite = suite_create("step_length");
    add(suite, "by hand", models_by_hand);
    add(suite, "root", root_of_every_degree);
    add(suite, "growing", root_grows_with_the_range);
    add(suite, "defaults", defaults_are_a_walkers);
    add(suite, "frequency", frequency_has_ends);
    add(suite, "ends", length_stays_within_its_ends);
    add(suite, "bad steps", bad_steps_are_refused);
    add(suite, "settings", settings_have_ends);
    add(suite, "bad arguments", bad_arguments_are_refused);
    return suite;
}
