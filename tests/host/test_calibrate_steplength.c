/* SPDX-License-Identifier: MIT */
#include "calibrate.h"

#include <math.h>
#include <stdlib.h>

#include "calibrations.h"
#include "insole/move/step_length.h"
#include "mall.h"
#include "near.h"
#include "suite.h"

static failure_t failure;

static const double pi = 3.14159265358979;

static const option_t options[] = {{"distance", "M", ""},
                                   {"accel-unit", "UNIT", ""},
                                   {"gyro-unit", "UNIT", ""},
                                   {NULL, NULL, NULL}};

static const char *calibrate(const char *distance, const char *const *sessions, size_t count)
{
    char words[64];
    snprintf(words, sizeof words, "%s%s", distance != NULL ? "--distance=" : "",
             distance != NULL ? distance : "");
    return calibrated(calibrate_steplength, options, words, sessions, count, &failure);
}

/* A phone that bobs at 2 Hz for `seconds`, walking at 1.4 m/s. */
static const char *write_walk(const char *name, double seconds, bool has_truth)
{
    const char *path = scratch(name);
    FILE *file = fopen(path, "wb");
    for (int i = 0; i < (int)(50.0 * seconds); i++) {
        double t = 0.02 * i;
        fprintf(file, "imu,%.2f,0,0,%.4f,0,0,0\n", t, 9.81 + 2.5 * sin(4.0 * pi * t));
        if (has_truth && i % 50 == 0) {
            fprintf(file, "truth,%.2f,%.3f,5\n", t, 1.4 * t);
        }
    }
    fclose(file);
    return path;
}

START_TEST(a_walk_of_known_distance_tells_the_step)
{
    const char *const path = write_walk("known.csv", 60.0, false);
    const char *text = calibrate("84", &path, 1u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    ASSERT_NEAR(value_of(text, "step_length.constant_m"), 0.7, 0.02, "m");
    ck_assert_ptr_nonnull(strstr(text, "84.0 m in 1 segment of 1 session"));
    ck_assert_ptr_nonnull(strstr(text, "# root: one distance tells no error"));
    ck_assert_ptr_nonnull(strstr(text, "# mixed is not observable"));
    ck_assert_ptr_null(strstr(text, "+-"));
}
END_TEST

START_TEST(the_truth_tells_the_distance)
{
    const char *const path = write_walk("truth.csv", 60.0, true);
    const char *text = calibrate(NULL, &path, 1u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    ASSERT_NEAR(value_of(text, "step_length.constant_m"), 0.7, 0.01, "m");
    ck_assert_ptr_nonnull(strstr(text, "of 1 session\n"));
    ck_assert_ptr_nonnull(strstr(text, "step_length.root_degree = 4.0\n"));
}
END_TEST

START_TEST(what_tells_nothing_is_refused)
{
    const char *const pair[] = {write_walk("a.csv", 30.0, false), write_walk("b.csv", 30.0, false)};
    const char *const brief = write_walk("brief.csv", 6.0, false);
    const char *const still = scratch("still.csv");
    const char *const late = scratch("late.csv");
    FILE *file = fopen(still, "wb");
    for (int i = 0; i < 500; i++) {
        fprintf(file, "imu,%.2f,0,0,9.81,0,0,0\n", 0.02 * i);
    }
    fclose(file);
    file = fopen(late, "wb");
    fputs("truth,1000,0,0\ntruth,1010,15,0\n", file);
    for (int i = 0; i < 1500; i++) {
        fprintf(file, "imu,%.2f,0,0,%.4f,0,0,0\n", 0.02 * i, 9.81 + 2.5 * sin(0.08 * pi * i));
    }
    fclose(file);
    const struct {
        const char *distance, *const *sessions;
        size_t count;
        const char *says;
        int exit_code;
    } refusals[] = {
        {"50", pair, 2u, "insole calibrate steplength: --distance is that of one LOG",
         EXIT_WRONG_USAGE},
        {"-3", pair, 1u, "--distance -3: expected a number from 1 to 1000000", EXIT_WRONG_USAGE},
        {NULL, pair, 2u, "a.csv: how far was it? Expected truth records", EXIT_BAD_INPUT},
        {"50", &still, 1u, "still.csv: no steps: expected a walk of five or more", EXIT_BAD_INPUT},
        {"50", &brief, 1u, "steps: expected 20 or more", EXIT_BAD_INPUT},
        {NULL, &late, 1u, "no steps within the times of 10 m of truth", EXIT_BAD_INPUT},
    };
    for (size_t i = 0u; i < sizeof refusals / sizeof refusals[0]; i++) {
        ck_assert_ptr_null(
            calibrate(refusals[i].distance, refusals[i].sessions, refusals[i].count));
        ck_assert_msg(strstr(failure.text, refusals[i].says) != NULL, "%s", failure.text);
        ck_assert_int_eq(failure.exit_code, refusals[i].exit_code);
    }
}
END_TEST

/* ---- recordings ------------------------------------------------------------------------- */

/* The defaults were made of these walks by other means. */
START_TEST(recorded_walks_tell_what_the_defaults_are)
{
    static char paths[MALL_WALKS][MALL_PATH];
    const char *sessions[MALL_WALKS];
    size_t count = 0u;
    for (int i = 0; i < MALL_WALKS; i++) {
        mall_path(paths[count], i, "");
        sessions[count] = paths[count];
        count += i % 4 != 0 ? 1u : 0u; /* the others are for tests */
    }
    char path[MALL_PATH];
    mall_path(path, 0, "imu.csv");
    if (!recorded_is_there(path)) {
        return;
    }
    const char *text = calibrate(NULL, sessions, count);
    ck_assert_msg(text != NULL, "%s", failure.text);
    printf("%s", text);
    ASSERT_NEAR(value_of(text, "step_length.root_scale"),
                (double)insole_step_length_defaults.root_scale, 3 * 0.0045, "");
    ASSERT_NEAR(value_of(text, "step_length.constant_m"),
                (double)insole_step_length_defaults.constant_m, 3 * 0.0095, "m");
    ASSERT_AT_MOST(strtod(strstr(text, "root: distances are off by ") + 27, NULL), 9.0, "%");
    ASSERT_AT_MOST(strtod(strstr(text, "constant: distances are off by ") + 31, NULL), 12.0, "%");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("host/calibrate_steplength");
    suite_add(suite, "command", a_walk_of_known_distance_tells_the_step);
    suite_add(suite, "command", the_truth_tells_the_distance);
    suite_add(suite, "command", what_tells_nothing_is_refused);
    suite_add(suite, "recordings", recorded_walks_tell_what_the_defaults_are);
    return suite;
}
