/* SPDX-License-Identifier: MIT */
#include "score.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "files.h"
#include "near.h"
#include "score_print.h"
#include "statistics.h"
#include "suite.h"

static track_t track, truth;
static score_t score;

static void add(track_t *to, double t_s, double x_m, double y_m, double z_m)
{
    track_row_t row;
    memset(&row, 0, sizeof row);
    row.t_us = (int64_t)llround(1e6 * t_s);
    row.x_m = x_m;
    row.y_m = y_m;
    row.z_m = z_m;
    row.state = INSOLE_FIX_TRACK;
    track_add(to, &row);
}

static void clear(void)
{
    track_free(&track);
    track_free(&truth);
}

static double uniform(double low, double high)
{
    return low + (high - low) * (rand() / (double)RAND_MAX);
}

static const double unknown = (double)NAN;

/* ---- statistics ------------------------------------------------------------------------- */

START_TEST(statistics_of_hand_computed_numbers)
{
    double values[] = {4.0, 1.0, 3.0, 2.0};
    ASSERT_NEAR(statistics_mean(values, 4u), 2.5, 1e-15, "");
    ASSERT_NEAR(statistics_std(values, 4u), sqrt(1.25), 1e-15, "");
    ASSERT_NEAR(statistics_rms(values, 4u), sqrt(7.5), 1e-15, "");
    ASSERT_NEAR(statistics_percentile(values, 4u, 0.0), 1.0, 0.0, "");
    ASSERT_NEAR(statistics_percentile(values, 4u, 100.0), 4.0, 0.0, "");
    ASSERT_NEAR(statistics_percentile(values, 4u, 50.0), 2.5, 1e-15, "");
    ASSERT_NEAR(statistics_percentile(values, 4u, 75.0), 3.25, 1e-15, "");
    ASSERT_NEAR(statistics_percentile(values, 1u, 95.0), 1.0, 0.0, "");
    ASSERT_NEAR(statistics_percentile(values, 0u, 95.0), 0.0, 0.0, "");
    ASSERT_NEAR(statistics_mean(values, 0u), 0.0, 0.0, "");
    ASSERT_NEAR(statistics_std(values, 0u), 0.0, 0.0, "");
}
END_TEST

/* ---- association ------------------------------------------------------------------------ */

/* Track: x = t at 1 Hz for 5 s. Errors by hand: 0, 0.5, 1, 2. */
START_TEST(a_score_by_hand)
{
    for (int i = 0; i <= 5; i++) {
        add(&track, i, i, 0.0, 0.1);
    }
    add(&truth, 0.0, 0.0, 0.0, 0.0);
    add(&truth, 1.5, 1.0, 0.0, 0.0);
    add(&truth, 3.0, 3.0, 1.0, 0.0);
    add(&truth, 5.0, 5.0, -2.0, 0.3);
    score_compute(&track, &truth, ALIGN_NONE, &score);
    ck_assert_uint_eq(score.n, 4u);
    ck_assert_uint_eq(score.missing, 0u);
    ASSERT_NEAR(score.mean_m, 0.875, 1e-12, "m");
    ASSERT_NEAR(score.rms_m, sqrt((0.25 + 1.0 + 4.0) / 4.0), 1e-12, "m");
    ASSERT_NEAR(score.std_m, sqrt(5.25 / 4.0 - 0.875 * 0.875), 1e-12, "m");
    ASSERT_NEAR(score.min_m, 0.0, 1e-12, "m");
    ASSERT_NEAR(score.max_m, 2.0, 1e-12, "m");
    ASSERT_NEAR(score.p50_m, 0.75, 1e-12, "m");
    ASSERT_NEAR(score.p75_m, 1.25, 1e-12, "m");
    ASSERT_NEAR(score.p90_m, 1.7, 1e-12, "m");
    ASSERT_NEAR(score.p95_m, 1.85, 1e-12, "m");
    ASSERT_NEAR(score.end_2d_m, 2.0, 1e-12, "m");
    ASSERT_NEAR(score.end_3d_m, sqrt(4.04), 1e-12, "m");
    double length = 1.0 + sqrt(5.0) + sqrt(13.0);
    ASSERT_NEAR(score.distance_m, length, 1e-12, "m");
    ASSERT_NEAR(score.end_percent, 200.0 / length, 1e-12, "%");
    ASSERT_NEAR(score.z_rms_m, sqrt((3.0 * 0.01 + 0.04) / 4.0), 1e-12, "m");
    clear();
}
END_TEST

START_TEST(errors_one_by_one)
{
    double errors[3] = {-1.0, -1.0, -1.0};
    add(&track, 0.0, 0.0, 0.0, 0.0);
    add(&track, 1.0, 1.0, 0.0, 0.0);
    add(&truth, 0.5, 0.5, 2.0, 0.0);
    add(&truth, 1.0, 4.0, 4.0, 0.0);
    add(&truth, 9.0, 1.0, 0.0, 0.0); /* 8 s after the track */
    score_errors(&track, &truth, errors);
    ASSERT_NEAR(errors[0], 2.0, 1e-12, "m");
    ASSERT_NEAR(errors[1], 5.0, 1e-12, "m");
    ASSERT_NEAR(errors[2], SCORE_MISSING_M, 1e-12, "m");
    clear();
}
END_TEST

START_TEST(points_without_a_place_count_thirty_metres)
{
    add(&track, 1.0, 0.0, 0.0, 0.0);
    add(&track, 3.0, 0.0, 0.0, 0.0); /* 2 s: still joined */
    add(&track, 5.1, 0.0, 0.0, 0.0); /* 2.1 s: a hole */
    add(&truth, 0.4, 0.0, 0.0, 0.0); /* 0.6 s before the track */
    add(&truth, 0.5, 1.0, 0.0, 0.0);
    add(&truth, 2.0, 1.0, 0.0, 0.0);
    add(&truth, 3.0, 1.0, 0.0, 0.0); /* the hole begins at once, but a row is there */
    add(&truth, 4.0, 1.0, 0.0, 0.0);
    add(&truth, 5.6, 1.0, 0.0, 0.0);
    add(&truth, 5.7, 1.0, 0.0, 0.0); /* 0.6 s after it */
    score_compute(&track, &truth, ALIGN_NONE, &score);
    ck_assert_uint_eq(score.missing, 3u);
    ASSERT_NEAR(score.max_m, 30.0, 0.0, "m");
    ASSERT_NEAR(score.mean_m, (3.0 * 30.0 + 4.0) / 7.0, 1e-12, "m");
    ASSERT_NEAR(score.end_2d_m, 30.0, 0.0, "m");
    ck_assert(isnan(score.end_3d_m));
    clear();
}
END_TEST

/* A start told at 2.135 s between two rows: the track was elsewhere before. */
START_TEST(a_leap_is_not_walked)
{
    add(&track, 2.1, 0.0, 0.0, 0.0);
    add(&track, 2.2, 78.0, 53.0, 0.0);
    add(&track, 2.3, 79.9, 53.0, 0.0); /* 19 m/s: still interpolated */
    add(&truth, 2.1, 0.0, 0.0, 0.0);
    add(&truth, 2.135, 78.0, 53.0, 0.0);
    add(&truth, 2.25, 78.95, 53.0, 0.0);
    score_compute(&track, &truth, ALIGN_NONE, &score);
    ck_assert_uint_eq(score.missing, 0u);
    ASSERT_NEAR(score.max_m, 0.0, 1e-9, "m");
    clear();
}
END_TEST

START_TEST(an_empty_track_misses_everything)
{
    add(&truth, 0.0, 0.0, 0.0, 0.0);
    add(&truth, 1.0, 5.0, 0.0, 0.0);
    for (int alignment = ALIGN_NONE; alignment <= ALIGN_SE2; alignment++) {
        score_compute(&track, &truth, (alignment_t)alignment, &score);
        ck_assert_uint_eq(score.missing, 2u);
        ASSERT_NEAR(score.rms_m, 30.0, 1e-12, "m");
        ASSERT_NEAR(score.motion.turn_rad, 0.0, 0.0, "rad");
        ck_assert(isnan(score.z_rms_m));
    }
    clear();
}
END_TEST

START_TEST(height_is_left_out_where_it_is_not_known)
{
    add(&track, 0.0, 0.0, 0.0, 1.0);
    add(&track, 1.0, 0.0, 0.0, 1.0);
    add(&truth, 0.0, 0.0, 0.0, unknown);
    add(&truth, 1.0, 0.0, 0.0, 0.5);
    score_compute(&track, &truth, ALIGN_NONE, &score);
    ASSERT_NEAR(score.z_rms_m, 0.5, 1e-12, "m");
    ASSERT_NEAR(score.end_3d_m, 0.5, 1e-12, "m");
    truth.rows[1].z_m = unknown;
    score_compute(&track, &truth, ALIGN_NONE, &score);
    ck_assert(isnan(score.z_rms_m) && isnan(score.end_3d_m));
    clear();
}
END_TEST

/* ---- alignment -------------------------------------------------------------------------- */

/* Makes a random walk as truth, and a track that a rigid motion brings onto it. */
static void make_moved_walk(motion_t *motion, double noise_m, bool about_start)
{
    double x = 0.0, y = 0.0;
    clear();
    motion->turn_rad = uniform(-3.1, 3.1);
    motion->x_m = about_start ? 0.0 : uniform(-50.0, 50.0);
    motion->y_m = about_start ? 0.0 : uniform(-50.0, 50.0);
    motion->z_m = about_start ? 0.0 : uniform(-5.0, 5.0);
    double c = cos(motion->turn_rad), s = sin(motion->turn_rad);
    for (int i = 0; i < 60; i++) {
        add(&truth, i, x, y, 0.1 * i);
        double dx = x - motion->x_m, dy = y - motion->y_m;
        add(&track, i, c * dx + s * dy + uniform(-noise_m, noise_m),
            -s * dx + c * dy + uniform(-noise_m, noise_m), 0.1 * i - motion->z_m);
        x += uniform(-0.5, 1.5);
        y += uniform(-1.0, 1.0);
    }
}

START_TEST(random_rigid_motions_are_found_again)
{
    motion_t motion;
    srand(11);
    for (int trial = 0; trial < 50; trial++) {
        make_moved_walk(&motion, 0.0, false);
        score_compute(&track, &truth, ALIGN_SE2, &score);
        ASSERT_AT_MOST(score.max_m, 1e-9, "m");
        ASSERT_AT_MOST(score.z_rms_m, 1e-9, "m");
        ASSERT_NEAR(remainder(score.motion.turn_rad - motion.turn_rad, 2.0 * acos(-1.0)), 0.0,
                    1e-10, "rad");
        ASSERT_NEAR(score.motion.x_m, motion.x_m, 1e-9, "m");
        ASSERT_NEAR(score.motion.y_m, motion.y_m, 1e-9, "m");
        ASSERT_NEAR(score.motion.z_m, motion.z_m, 1e-9, "m");
    }
    clear();
}
END_TEST

START_TEST(random_turns_about_the_start_are_found_again)
{
    motion_t motion;
    srand(12);
    for (int trial = 0; trial < 50; trial++) {
        make_moved_walk(&motion, 0.0, true);
        score_compute(&track, &truth, ALIGN_YAW, &score);
        ASSERT_AT_MOST(score.max_m, 1e-9, "m");
        ASSERT_NEAR(remainder(score.motion.turn_rad - motion.turn_rad, 2.0 * acos(-1.0)), 0.0,
                    1e-10, "rad");
    }
    clear();
}
END_TEST

/* No small change of the motion found may lessen the sum of squares. */
START_TEST(the_alignment_is_the_best_there_is)
{
    motion_t unused;
    srand(13);
    for (int trial = 0; trial < 10; trial++) {
        make_moved_walk(&unused, 1.0, false);
        score_compute(&track, &truth, ALIGN_SE2, &score);
        double best = score.rms_m;
        motion_t found = score.motion;
        for (int k = 0; k < 200; k++) {
            double rms, squares = 0.0;
            motion_t other = found;
            other.turn_rad += uniform(-0.05, 0.05);
            other.x_m += uniform(-0.5, 0.5);
            other.y_m += uniform(-0.5, 0.5);
            for (size_t i = 0u; i < track.count; i++) {
                track_row_t row = track.rows[i];
                score_move(&other, &row);
                squares +=
                    pow(row.x_m - truth.rows[i].x_m, 2.0) + pow(row.y_m - truth.rows[i].y_m, 2.0);
            }
            rms = sqrt(squares / (double)track.count);
            ASSERT_AT_LEAST(rms, best, "m");
        }
    }
    clear();
}
END_TEST

START_TEST(yaw_leaves_the_start_where_it_is)
{
    for (int i = 0; i <= 10; i++) {
        add(&track, i, 5.0 + i, 1.0, 0.0);
        add(&truth, i, 5.0, 1.5 + i, 0.0);
    }
    score_compute(&track, &truth, ALIGN_YAW, &score);
    ASSERT_NEAR(score.motion.turn_rad, acos(0.0), 1e-9, "rad");
    ASSERT_NEAR(score.max_m, 0.5, 1e-9, "m");
    ASSERT_NEAR(score.min_m, 0.5, 1e-9, "m");
    clear();
}
END_TEST

START_TEST(a_loop_is_scored_by_what_fails_to_close)
{
    for (int i = 0; i <= 40; i++) { /* a square of 10 m sides that ends 0.5 m off, 0.2 m high */
        static const double corner[5][2] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0.3, 0.4}};
        int side = i < 40 ? i / 10 : 3;
        double share = i < 40 ? 0.1 * (i % 10) : 1.0;
        add(&track, i, corner[side][0] + share * (corner[side + 1][0] - corner[side][0]),
            corner[side][1] + share * (corner[side + 1][1] - corner[side][1]), 0.005 * i);
    }
    add(&truth, 0.0, 3.0, 4.0, 1.0);
    add(&truth, 40.0, 3.0, 4.0, 1.0);
    score_compute(&track, &truth, ALIGN_SE2, &score);
    ASSERT_NEAR(score.end_2d_m, 0.5, 1e-9, "m");
    ASSERT_NEAR(score.end_3d_m, hypot(0.5, 0.2), 1e-9, "m");
    ASSERT_NEAR(score.distance_m, 39.6, 0.05, "m");
    ASSERT_NEAR(score.end_percent, 100.0 * 0.5 / score.distance_m, 1e-9, "%");
    clear();
}
END_TEST

START_TEST(a_walk_between_two_points_is_turned_towards_the_end)
{
    for (int i = 0; i <= 10; i++) {
        add(&track, i, 0.0, i, 0.0);
    }
    add(&truth, 0.0, 2.0, 3.0, unknown);
    add(&truth, 10.0, 12.5, 3.0, unknown);
    score_compute(&track, &truth, ALIGN_SE2, &score);
    ASSERT_NEAR(score.min_m, 0.0, 1e-9, "m");
    ASSERT_NEAR(score.end_2d_m, 0.5, 1e-9, "m");
    ASSERT_NEAR(score.motion.turn_rad, -acos(0.0), 1e-9, "rad");
    clear();
}
END_TEST

START_TEST(nobody_walked)
{
    add(&track, 0.0, 1.0, 0.0, 0.0);
    add(&truth, 0.0, 0.0, 0.0, 0.0);
    score_compute(&track, &truth, ALIGN_NONE, &score);
    ASSERT_NEAR(score.end_2d_m, 1.0, 0.0, "m");
    ASSERT_NEAR(score.distance_m, 0.0, 0.0, "m");
    ck_assert(isnan(score.end_percent));
    clear();
}
END_TEST

/* The covariance turns with the row: R P R' computed the long way. */
START_TEST(a_moved_row_takes_its_covariance_along)
{
    const motion_t motion = {0.7, 1.0, -2.0, 0.5};
    track_row_t row;
    memset(&row, 0, sizeof row);
    row.x_m = 3.0;
    row.heading_rad = 3.0;
    row.var_x_m2 = 4.0;
    row.var_y_m2 = 1.0;
    row.cov_xy_m2 = 0.5;
    score_move(&motion, &row);
    const double R[2][2] = {{cos(0.7), -sin(0.7)}, {sin(0.7), cos(0.7)}};
    const double P[2][2] = {{4.0, 0.5}, {0.5, 1.0}};
    double Q[2][2] = {{0.0, 0.0}, {0.0, 0.0}};
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            for (int k = 0; k < 2; k++) {
                for (int l = 0; l < 2; l++) {
                    Q[i][j] += R[i][k] * P[k][l] * R[j][l];
                }
            }
        }
    }
    ASSERT_NEAR(row.var_x_m2, Q[0][0], 1e-12, "m^2");
    ASSERT_NEAR(row.var_y_m2, Q[1][1], 1e-12, "m^2");
    ASSERT_NEAR(row.cov_xy_m2, Q[0][1], 1e-12, "m^2");
    ASSERT_NEAR(row.x_m, 3.0 * cos(0.7) + 1.0, 1e-12, "m");
    ASSERT_NEAR(row.y_m, 3.0 * sin(0.7) - 2.0, 1e-12, "m");
    ASSERT_NEAR(row.z_m, 0.5, 1e-12, "m");
    ASSERT_NEAR(row.heading_rad, 3.7 - 2.0 * acos(-1.0), 1e-12, "rad");
}
END_TEST

/* ---- printing --------------------------------------------------------------------------- */

START_TEST(a_score_is_printed)
{
    add(&track, 0.0, 1.0, 0.0, 0.0);
    add(&truth, 0.0, 0.0, 0.0, unknown);
    add(&truth, 9.0, 0.0, 0.0, unknown);
    score_compute(&track, &truth, ALIGN_NONE, &score);
    FILE *file = tmpfile();
    score_print(file, &score);
    ck_assert_str_eq(
        text_of(file),
        "score against the truth, in the plane (as it is)\n"
        "  points                2\n"
        "  missing               1 without a place in the track, counted as 30 m each\n"
        "  mean             15.500 m\n  std              14.500 m\n  rms              21.225 m\n"
        "  max              30.000 m\n  min               1.000 m\n  50 %             15.500 m\n"
        "  75 %             22.750 m\n  90 %             27.100 m\n  95 %             28.550 m\n"
        "  end              30.000 m\n  end in 3-D            -\n  distance          0.000 m\n"
        "  end/distance          -\n  height rms            -\n");
    clear();
}
END_TEST

START_TEST(a_score_is_told_as_json)
{
    add(&track, 0.0, 1.0, 0.0, 0.0);
    add(&truth, 0.0, 0.0, 0.0, unknown);
    score_compute(&track, &truth, ALIGN_NONE, &score);
    FILE *file = tmpfile();
    json_t json;
    json_begin(&json, file);
    score_json(&json, NULL, &score);
    const char *text = text_of(file);
    ck_assert_ptr_nonnull(strstr(text, "\"align\": \"none\",\n"));
    ck_assert_ptr_nonnull(strstr(text, "\"n\": 1,\n"));
    ck_assert_ptr_nonnull(strstr(text, "\"rms_m\": 1.0000,\n"));
    ck_assert_ptr_nonnull(strstr(text, "\"z_rms_m\": null\n}\n"));
    clear();
}
END_TEST

START_TEST(alignments_have_names)
{
    alignment_t alignment;
    failure_t failure;
    ck_assert(score_alignment_parse("none", &alignment, &failure) && alignment == ALIGN_NONE);
    ck_assert(score_alignment_parse("yaw", &alignment, &failure) && alignment == ALIGN_YAW);
    ck_assert(score_alignment_parse("se2", &alignment, &failure) && alignment == ALIGN_SE2);
    ck_assert(!score_alignment_parse("sim3", &alignment, &failure));
    ck_assert_str_eq(failure.text, "insole: --align sim3: expected none, yaw or se2");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("score");
    suite_add(suite, "statistics", statistics_of_hand_computed_numbers);
    suite_add(suite, "by hand", a_score_by_hand);
    suite_add(suite, "missing", points_without_a_place_count_thirty_metres);
    suite_add(suite, "leap", a_leap_is_not_walked);
    suite_add(suite, "empty", an_empty_track_misses_everything);
    suite_add(suite, "height", height_is_left_out_where_it_is_not_known);
    suite_add(suite, "se2", random_rigid_motions_are_found_again);
    suite_add(suite, "yaw", random_turns_about_the_start_are_found_again);
    suite_add(suite, "best", the_alignment_is_the_best_there_is);
    suite_add(suite, "yaw pivot", yaw_leaves_the_start_where_it_is);
    suite_add(suite, "loop", a_loop_is_scored_by_what_fails_to_close);
    suite_add(suite, "two points", a_walk_between_two_points_is_turned_towards_the_end);
    suite_add(suite, "nobody", nobody_walked);
    suite_add(suite, "errors", errors_one_by_one);
    suite_add(suite, "covariance", a_moved_row_takes_its_covariance_along);
    suite_add(suite, "text", a_score_is_printed);
    suite_add(suite, "json", a_score_is_told_as_json);
    suite_add(suite, "names", alignments_have_names);
    return suite;
}
