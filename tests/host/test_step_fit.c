/* SPDX-License-Identifier: MIT */
#include "step_fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "near.h"
#include "suite.h"

static step_walks_t walks;

static double uniform(double low, double high)
{
    return low + (high - low) * rand() / (double)RAND_MAX;
}

static double gauss(void)
{
    double sum = 0.0;
    for (int i = 0; i < 12; i++) {
        sum += uniform(0.0, 1.0);
    }
    return sum - 6.0;
}

/* ---- footfalls that are known ----------------------------------------------------------- */

enum { STEPS = 90 };

typedef double (*length_t)(const insole_footfall_t *step);

static double hz_of(const insole_footfall_t *step)
{
    return 1e6 / (double)(step->end_us - step->begin_us);
}

static double root_length(const insole_footfall_t *step)
{
    return 0.37 * pow((double)step->range_mps2, 0.25);
}

static double linear_length(const insole_footfall_t *step)
{
    double sigma = (double)step->accel_sigma_mps2;
    return -0.3 * hz_of(step) + 0.02 * sigma * sigma + 1.1;
}

static double mixed_length(const insole_footfall_t *step)
{
    return 0.6 - 0.2 * hz_of(step) + 0.2 * sqrt((double)step->range_mps2);
}

static double constant_length(const insole_footfall_t *step)
{
    (void)step;
    return 0.71;
}

static const length_t lengths[] = {root_length, linear_length, mixed_length, constant_length};
static const double told[][STEP_COEFFICIENTS] = {
    {0.37}, {-0.3, 0.02, 1.1}, {0.6, -0.2, 0.2}, {0.71}};

/* A walk north whose pace changes now and then; the truth is told at every footfall. `factor`: how
 * much longer this person's steps are; `scatter`: of every single one. */
static void add_walk(length_t length, double factor, double scatter)
{
    insole_footfall_t steps[STEPS];
    track_t truth = {NULL, 0u, 0u};
    double way_m = 0.0, lasted_s = 0.5, range = 5.0;
    uint64_t t_us = to_library_us(-3000000);
    track_row_t row;
    memset(&row, 0, sizeof row);
    memset(steps, 0, sizeof steps);
    for (int i = 0; i < STEPS; i++) {
        if (i % 15 == 0) {
            lasted_s = uniform(0.42, 0.7);
            range = uniform(2.0, 12.0);
        }
        row.t_us = to_log_us(t_us);
        row.y_m = way_m;
        track_add(&truth, &row);
        steps[i].begin_us = t_us;
        t_us += (uint64_t)(1e6 * (lasted_s + uniform(-0.01, 0.01)));
        steps[i].end_us = t_us;
        steps[i].range_mps2 = (insole_real_t)(range + uniform(-0.5, 0.5));
        steps[i].accel_sigma_mps2 = (insole_real_t)(0.35 * range + uniform(-0.3, 0.3));
        way_m += factor * length(&steps[i]) + scatter * gauss();
    }
    row.t_us = to_log_us(t_us);
    row.y_m = way_m;
    track_add(&truth, &row);
    step_walks_add_steps(&walks, steps, STEPS, &truth, 0.0);
    track_free(&truth);
}

START_TEST(known_coefficients_come_back)
{
    const step_model_t *model = &step_models[_i];
    step_fit_t fit;
    srand(31u + (unsigned)_i);
    for (int i = 0; i < 3; i++) {
        add_walk(lengths[_i], 1.0, 0.0);
    }
    ck_assert_uint_eq(walks.steps, 3u * STEPS);
    ck_assert_uint_ge(walks.count, 9u);
    step_fit(&fit, model, &walks);
    ck_assert(fit.is_told);
    for (int k = 0; k < model->count; k++) {
        ASSERT_NEAR(fit.value[k], told[_i][k], 1e-4, "");
        ASSERT_AT_MOST(fit.error[k], 1e-4, "");
    }
    ASSERT_AT_MOST(fit.segment_m, 1e-3, "m");
    ASSERT_AT_MOST(fit.session_share, 1e-4, "");
    step_walks_free(&walks);
}
END_TEST

/* Persons differ by 8 %, which the segments of one walk share: the standard errors know it. */
START_TEST(standard_errors_hold_what_persons_differ)
{
    enum { TRIALS = 60, PERSONS = 12 };
    const step_model_t *root = &step_models[INSOLE_STEP_LENGTH_ROOT];
    double squares = 0.0, error = 0.0;
    srand(41);
    for (int trial = 0; trial < TRIALS; trial++) {
        step_fit_t fit;
        for (int i = 0; i < PERSONS; i++) {
            add_walk(root_length, 1.0 + 0.08 * gauss(), 0.03);
        }
        step_fit(&fit, root, &walks);
        ck_assert(fit.is_told);
        squares += (fit.value[0] - 0.37) * (fit.value[0] - 0.37) / TRIALS;
        error += fit.error[0] / TRIALS;
        step_walks_free(&walks);
    }
    ASSERT_NEAR(sqrt(squares), 0.37 * 0.08 / sqrt(PERSONS), 0.3 * 0.37 * 0.08 / sqrt(PERSONS), "");
    ASSERT_NEAR(error / sqrt(squares), 1.0, 0.3, "");
}
END_TEST

/* All steps alike: only their number tells the distance. */
START_TEST(what_steady_walks_cannot_tell_is_not_told)
{
    insole_footfall_t step = {0, 0, 1, 4, 2};
    insole_footfall_t steps[STEPS];
    track_t truth = {NULL, 0u, 0u};
    track_row_t row;
    step_fit_t fit;
    memset(&row, 0, sizeof row);
    for (int i = 0; i < STEPS; i++) {
        step.begin_us = to_library_us(500000 * i);
        step.end_us = to_library_us(500000 * (i + 1));
        steps[i] = step;
        row.t_us = 500000 * i;
        row.x_m = 0.7 * i + 0.02 * gauss();
        track_add(&truth, &row);
    }
    for (int i = 0; i < 3; i++) {
        step_walks_add_steps(&walks, steps, STEPS, &truth, 0.0);
    }
    step_fit(&fit, &step_models[INSOLE_STEP_LENGTH_LINEAR], &walks);
    ck_assert(!fit.is_told);
    step_fit(&fit, &step_models[INSOLE_STEP_LENGTH_MIXED], &walks);
    ck_assert(!fit.is_told);
    step_fit(&fit, &step_models[INSOLE_STEP_LENGTH_CONSTANT], &walks);
    ck_assert(fit.is_told);
    ASSERT_NEAR(fit.value[0], 0.7, 0.01, "m");
    step_fit(&fit, &step_models[INSOLE_STEP_LENGTH_ROOT], &walks);
    ASSERT_NEAR(fit.value[0], 0.7 / sqrt(2.0), 0.01, "");
    track_free(&truth);
    step_walks_free(&walks);
}
END_TEST

/* Features as the models of the library take them: their lengths agree. */
START_TEST(features_are_those_of_the_library)
{
    insole_step_length_config_t config = insole_step_length_defaults;
    srand(51);
    for (int i = 0; i < 200; i++) {
        insole_footfall_t step = {1000, 0, 1, (insole_real_t)uniform(3.0, 12.0),
                                  (insole_real_t)uniform(1.0, 4.0)};
        step.end_us = step.begin_us + (uint64_t)uniform(2.5e5, 1.2e6);
        for (config.model = 0; config.model <= INSOLE_STEP_LENGTH_CONSTANT; config.model++) {
            const double values[][STEP_COEFFICIENTS] = {
                {(double)config.root_scale},
                {(double)config.linear_alpha, (double)config.linear_beta,
                 (double)config.linear_gamma},
                {(double)config.mixed_a, (double)config.mixed_b, (double)config.mixed_c},
                {(double)config.constant_m}};
            step_fit_t fit = {true, {0.0}, {0.0}, 0.0, 0.0};
            step_segment_t segment = {0u, 0.0, {0.0}};
            insole_real_t length_m;
            memcpy(fit.value, values[config.model], sizeof fit.value);
            step_features(&step, segment.sum);
            ck_assert_int_eq(insole_step_length(&config, &step, &length_m), INSOLE_OK);
            double mine_m = step_fit_length(&fit, &step_models[config.model], &segment);
            mine_m = fmin(fmax(mine_m, (double)config.min_m), (double)config.max_m);
            ASSERT_NEAR(mine_m, (double)length_m, 1e-5, "m");
        }
    }
}
END_TEST

START_TEST(steps_across_a_cut_count_in_both_segments)
{
    track_t truth = {NULL, 0u, 0u};
    track_row_t row;
    insole_footfall_t steps[20];
    double sum = 0.0;
    memset(&row, 0, sizeof row);
    memset(steps, 0, sizeof steps);
    for (int i = 0; i < 20; i++) {
        steps[i].begin_us = to_library_us(1000000 * i);
        steps[i].end_us = to_library_us(1000000 * (i + 1));
    }
    for (int i = 0; i <= 2; i++) { /* cuts at 0, 6.25 and 20 s */
        row.t_us = i == 1 ? 6250000 : 10000000 * i;
        row.x_m = 11.0 * i;
        track_add(&truth, &row);
    }
    step_walks_add_steps(&walks, steps, 20u, &truth, 0.0);
    ck_assert_uint_eq(walks.count, 2u);
    ASSERT_NEAR(walks.segments[0].sum[STEP_ONE], 6.25, 1e-9, "steps");
    for (size_t i = 0u; i < 2u; i++) {
        sum += walks.segments[i].sum[STEP_ONE];
        ASSERT_NEAR(walks.segments[i].distance_m, 11.0, 1e-9, "m");
    }
    ASSERT_NEAR(sum, 20.0, 1e-9, "steps");
    track_free(&truth);
    step_walks_free(&walks);
}
END_TEST

/* A rest of two minutes between two walks is no walk; neither is the jitter of the truth there. */
START_TEST(segments_without_steps_are_left_out)
{
    track_t truth = {NULL, 0u, 0u};
    track_row_t row;
    insole_footfall_t steps[20];
    memset(&row, 0, sizeof row);
    memset(steps, 0, sizeof steps);
    for (int i = 0; i < 20; i++) {
        steps[i].begin_us = to_library_us(500000 * i);
        steps[i].end_us = to_library_us(500000 * (i + 1));
    }
    for (int i = 0; i <= 40; i++) {
        row.t_us = 250000 * i;
        row.x_m = 0.3 * i;
        track_add(&truth, &row);
    }
    for (int i = 0; i < 100; i++) { /* stands, seen within 0.2 m */
        row.t_us += 1000000;
        row.y_m = 0.1 * (i % 3);
        track_add(&truth, &row);
    }
    row.t_us += 10000000; /* carried on without a step */
    row.x_m += 15.0;
    track_add(&truth, &row);
    step_walks_add_steps(&walks, steps, 20u, &truth, 0.0);
    ck_assert_uint_eq(walks.count, 1u);
    ck_assert_uint_eq(walks.without_steps, 1u);
    track_free(&truth);
    step_walks_free(&walks);
}
END_TEST

/* What is printed can be set. */
START_TEST(keys_are_those_of_the_library)
{
#define NAME(kind, key, value, low, high, unit, text) #key,
    static const char *const keys[] = {INSOLE_STEP_LENGTH_KEYS(NAME)};
    for (size_t m = 0u; m < sizeof step_models / sizeof step_models[0]; m++) {
        for (int k = 0; k < step_models[m].count; k++) {
            bool is_there = false;
            for (size_t i = 0u; i < sizeof keys / sizeof keys[0]; i++) {
                is_there = is_there || strcmp(keys[i], step_models[m].key[k]) == 0;
            }
            ck_assert_msg(is_there, "%s", step_models[m].key[k]);
        }
    }
}
END_TEST
Suite *insole_suite(void)
{
    Suite *suite = suite_create("host/step_fit");
    suite_add_loop(suite, "fit", known_coefficients_come_back, 4);
    suite_add(suite, "fit", standard_errors_hold_what_persons_differ);
    suite_add(suite, "fit", what_steady_walks_cannot_tell_is_not_told);
    suite_add(suite, "walks", features_are_those_of_the_library);
    suite_add(suite, "walks", steps_across_a_cut_count_in_both_segments);
    suite_add(suite, "walks", segments_without_steps_are_left_out);
    suite_add(suite, "keys", keys_are_those_of_the_library);
    return suite;
}
