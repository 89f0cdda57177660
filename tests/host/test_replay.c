/* SPDX-License-Identifier: MIT */
#include "replay.h"

#include <stdlib.h>

#include "files.h"
#include "foot_walk.h"
#include "near.h"
#include "replay_result.h"
#include "scoring.h"
#include "suite.h"

/* 20 strides of 1.3 m, 7 degrees left in each. */
static const foot_walk_t bend = {2.0, 1.3, 0.12, 200.0, 20, -3.25};

static replay_result_t result;

static const char *write_walk(const foot_walk_t *walk, const char *name, const char *head)
{
    const char *path = scratch(name);
    FILE *file = fopen(path, "wb");
    fputs(head, file);
    foot_walk_write(walk, file);
    fclose(file);
    return path;
}

static replay_request_t request_of(const char *const *path)
{
    replay_request_t request;
    memset(&request, 0, sizeof request);
    request.logs = path;
    request.log_count = 1u;
    request.rate_hz = 10.0;
    settings_init(&request.settings);
    request.settings.fusion.foot.zupt_ekf.roll_height_m =
        INSOLE_R(0.0); /* this foot does not roll */
    return request;
}

static const track_row_t *last_row(void)
{
    return &result.rows.rows[result.rows.count - 1u];
}

START_TEST(a_walk_is_found_again)
{
    const char *const path = write_walk(&bend, "walk.csv", "");
    replay_request_t request = request_of(&path);
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.facts.strides, 20u);
    ck_assert_uint_eq(result.rows.count, 261u); /* 26 s at 10 Hz */
    for (size_t i = 0u; i < result.rows.count; i++) {
        const track_row_t *row = &result.rows.rows[i];
        foot_pose_t pose = foot_walk_pose(&bend, 1e-6 * (double)row->t_us - bend.begin_s);
        ck_assert_int_eq(row->t_us, -3250000 + 100000 * (int64_t)i);
        ASSERT_NEAR(row->x_m, pose.x_m, 0.05, "m");
        ASSERT_NEAR(row->y_m, pose.y_m, 0.05, "m");
        ASSERT_NEAR(row->z_m, pose.z_m, 0.05, "m");
        ck_assert(row->var_x_m2 >= 0.0 && row->var_y_m2 >= 0.0 && row->var_z_m2 >= 0.0);
    }
    ck_assert_int_eq(last_row()->state, INSOLE_FIX_TRACK);
    replay_result_clear(&result);
}
END_TEST

START_TEST(strides_and_stances_are_told)
{
    const char *const path = write_walk(&bend, "walk.csv", "");
    replay_request_t request = request_of(&path);
    int strides = 0, stances = 0;
    int64_t end_us = INT64_MIN;
    replay_result_run(&result, &request);
    for (int i = 0; i < result.count; i++) {
        const event_t *event = &result.list[i];
        ck_assert_int_ge(event->end_us, event->begin_us);
        if (event->kind == EVENT_STRIDE) {
            double lift_s = bend.begin_s + bend.rest_s + strides * (SWING_S + STANCE_S);
            ASSERT_NEAR(event->length_m, 1.3, 0.01, "m");
            ASSERT_NEAR(1e-6 * (double)event->begin_us, lift_s, 0.08, "s");
            ASSERT_NEAR(1e-6 * (double)event->end_us, lift_s + SWING_S, 0.08, "s");
            ASSERT_NEAR(event->turn_rad, 0.12, 0.005, "rad");
            ASSERT_NEAR(remainder(event->heading_rad - 0.12 * strides, 6.283185307179586), 0.0,
                        0.02, "rad");
            strides++;
        } else {
            ck_assert_int_gt(event->begin_us, end_us);
            end_us = event->end_us;
            stances++;
        }
    }
    ck_assert_int_eq(strides, 20);
    ck_assert_int_ge(stances, 20);
    ASSERT_NEAR(result.facts.walked_m, 26.0, 0.1, "m");
    replay_result_clear(&result);
}
END_TEST

/* ---- starts ----------------------------------------------------------------------------- */

START_TEST(a_start_in_the_log_is_used)
{
    const char *const path = write_walk(&bend, "start.csv", "start,-3.25,100,50,1.57079633\n");
    replay_request_t request = request_of(&path);
    replay_result_run(&result, &request);
    ck_assert(result.facts.knows_place && result.facts.knows_heading);
    ASSERT_NEAR(result.rows.rows[0].x_m, 100.0, 1e-4, "m");
    ASSERT_NEAR(result.rows.rows[0].y_m, 50.0, 1e-4, "m");
    /* The direction of the first two strides: (1.3, 0) + 1.3 (cos, sin)(.12) at .06 rad. */
    double turn = 1.57079633 - 0.06, c = cos(turn), s = sin(turn);
    foot_pose_t end = foot_walk_pose(&bend, foot_walk_duration(&bend));
    ASSERT_NEAR(last_row()->x_m, 100.0 + c * end.x_m - s * end.y_m, 0.1, "m");
    ASSERT_NEAR(last_row()->y_m, 50.0 + s * end.x_m + c * end.y_m, 0.1, "m");
    replay_result_clear(&result);
}
END_TEST

START_TEST(a_start_from_outside_replaces_that_of_the_log)
{
    const char *const path = write_walk(&bend, "start.csv", "start,-3.25,100,50,1.57079633\n");
    replay_request_t request = request_of(&path);
    const record_t start = {
        RECORD_START, 0, 0u, {-7.0, 2.0, (double)NAN, (double)NAN, (double)NAN, (double)NAN}};
    request.has_start = true;
    request.start = start;
    replay_result_run(&result, &request);
    ck_assert(result.facts.knows_place && !result.facts.knows_heading);
    ASSERT_NEAR(result.rows.rows[0].x_m, -7.0, 1e-6, "m");
    ASSERT_NEAR(result.rows.rows[0].y_m, 2.0, 1e-6, "m");
    replay_result_clear(&result);
    request.has_start = false;
    request.no_start = true;
    replay_result_run(&result, &request);
    ck_assert(!result.facts.knows_place);
    ASSERT_NEAR(result.rows.rows[0].x_m, 0.0, 1e-6, "m");
    replay_result_clear(&result);
}
END_TEST

/* Before the start the track is not on the map, and not in the picture. */
START_TEST(what_was_before_the_start_is_not_drawn)
{
    const char *const path = write_walk(&bend, "late.csv", "truth,-3.25,0,0\nstart,1.02,100,50\n");
    replay_request_t request = request_of(&path);
    score_t score;
    replay_result_run(&result, &request);
    ck_assert_int_eq(result.facts.start_us, 1020000);
    memset(&score, 0, sizeof score);
    score.motion.x_m = 1000.0;
    track_t drawn = scoring_drawn(&result.facts, &result.rows, &score);
    ck_assert_int_eq(drawn.rows[0].t_us, 1050000);
    ASSERT_NEAR(drawn.rows[0].x_m, 1100.0, 1.5, "m");
    ck_assert_uint_eq(drawn.count + 43u, result.rows.count);
    track_free(&drawn);
    result.facts.knows_place = false;
    drawn = scoring_drawn(&result.facts, &result.rows, NULL);
    ck_assert_uint_eq(drawn.count, result.rows.count);
    track_free(&drawn);
    replay_result_clear(&result);
}
END_TEST

/* ---- what no estimator may see ---------------------------------------------------------- */

/* Two logs that differ in their truth alone give the same bits. */
START_TEST(truth_does_not_reach_the_tracker)
{
    track_t before;
    const char *const path = write_walk(&bend, "untold.csv", "");
    replay_request_t request = request_of(&path);
    replay_result_run(&result, &request);
    before = result.rows;
    memset(&result.rows, 0, sizeof result.rows);
    replay_result_clear(&result);
    const char *const told = write_walk(&bend, "told.csv",
                                        "truth,-3.25,500,500,3\ntruth,-1,501,500\n"
                                        "truth,20,-77,0\n");
    request.logs = &told;
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.facts.truth.count, 3u);
    ck_assert_uint_eq(result.rows.count, before.count);
    replay_result_same_rows(&result.rows, &before, before.count);
    track_free(&before);
    replay_result_clear(&result);
}
END_TEST

START_TEST(replays_give_the_same_bits)
{
    const char *const path = write_walk(&bend, "walk.csv", "");
    replay_request_t request = request_of(&path);
    replay_result_run(&result, &request);
    track_t first = result.rows;
    memset(&result.rows, 0, sizeof result.rows);
    replay_result_clear(&result);
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.rows.count, first.count);
    replay_result_same_rows(&result.rows, &first, first.count);
    track_free(&first);
    replay_result_clear(&result);
}
END_TEST

/* ---- prefix law ------------------------------------------------------------------------- */

/* Copies the lines of a log up to a time, and damages it on the way, equally for every cut. */
static const char *cut_log(const char *from, const char *name, double until_s)
{
    char line[256];
    const char *path = scratch(name);
    FILE *in = fopen(from, "rb"), *out = fopen(path, "wb");
    for (int number = 0; fgets(line, sizeof line, in) != NULL; number++) {
        double t_s = strtod(line + 4, NULL);
        bool is_lost = (t_s > 4.0 && t_s < 4.3) || (t_s > 9.0 && t_s < 11.0) || number % 97 == 5;
        if (t_s <= until_s && number % 211 == 7) {
            fprintf(out, "imu,%.6f,nan,,0,1,2,3\n", t_s);
        } else if (t_s <= until_s && !is_lost) {
            fputs(line, out);
        }
    }
    fclose(in);
    fclose(out);
    return path;
}

START_TEST(rows_of_a_cut_log_are_those_of_the_whole)
{
    static const double cuts_s[] = {-2.0, 1.0, 4.4, 8.9, 11.2, 17.0, 22.0};
    static const double rates_hz[] = {10.0, 0.0, 33.3};
    const char *whole = write_walk(&bend, "whole.csv", "");
    const char *path = cut_log(whole, "damaged.csv", 1e9);
    for (size_t r = 0u; r < 3u; r++) {
        replay_request_t request = request_of(&path);
        request.rate_hz = rates_hz[r];
        replay_result_run(&result, &request);
        track_t rows = result.rows;
        memset(&result.rows, 0, sizeof result.rows);
        replay_result_clear(&result);
        for (size_t i = 0u; i < sizeof cuts_s / sizeof cuts_s[0]; i++) {
            const char *const cut = cut_log(whole, "cut.csv", cuts_s[i]);
            request.logs = &cut;
            replay_result_run(&result, &request);
            size_t n = 0u;
            while (n < rows.count && 1e-6 * (double)rows.rows[n].t_us <= cuts_s[i] - 0.5) {
                n++;
            }
            replay_result_same_rows(&rows, &result.rows, n);
            replay_result_clear(&result);
        }
        track_free(&rows);
    }
}
END_TEST

/* ---- bad input -------------------------------------------------------------------------- */

START_TEST(nobody_need_take_the_results)
{
    const char *const path = write_walk(&bend, "walk.csv", "");
    replay_request_t request = request_of(&path);
    replay_sink_t sink = {NULL, NULL, NULL, NULL};
    ck_assert(replay_run(&request, &sink, &result.facts, &result.failure));
    ck_assert_uint_eq(result.facts.strides, 20u);
    replay_result_clear(&result);
}
END_TEST

static bool refuse_event(void *context, const event_t *event, failure_t *failure)
{
    (void)context;
    (void)event;
    return failure_input(failure, "enough");
}

START_TEST(who_takes_the_results_can_stop_the_replay)
{
    const char *const path = write_walk(&bend, "walk.csv", "");
    replay_request_t request = request_of(&path);
    replay_sink_t sink = {NULL, NULL, NULL, refuse_event};
    ck_assert(!replay_run(&request, &sink, &result.facts, &result.failure));
    ck_assert_str_eq(result.failure.text, "enough");
    ck_assert_uint_le(result.facts.strides, 1u);
    replay_result_clear(&result);
}
END_TEST

START_TEST(settings_the_library_does_not_take_are_told)
{
    const char *const path = write_walk(&bend, "walk.csv", "");
    replay_request_t request = request_of(&path);
    replay_sink_t sink = {NULL, NULL, NULL, NULL};
    request.settings.fusion.foot.zupt_ekf.sigma_zupt_mps = INSOLE_R(-1.0);
    ck_assert(!replay_run(&request, &sink, &result.facts, &result.failure));
    ck_assert_str_eq(result.failure.text, "insole: the tracker does not take these settings");
    replay_result_clear(&result);
}
END_TEST

START_TEST(the_sensor_settings_are_applied)
{
    const sensor_config_t sensor = {INSOLE_R(2.0), INSOLE_R(0.5), INSOLE_R(-0.5), INSOLE_R(1.0),
                                    INSOLE_R(1.0), INSOLE_R(2.0), INSOLE_R(3.0)};
    insole_imu_t imu = {0u,
                        {INSOLE_R(1.0), INSOLE_R(2.0), INSOLE_R(3.5)},
                        {INSOLE_R(1.0), INSOLE_R(1.0), INSOLE_R(1.0)}};
    settings_correct(&sensor, &imu);
    ck_assert(imu.accel_mps2.x == INSOLE_R(0.0) && imu.accel_mps2.y == INSOLE_R(0.0) &&
              imu.accel_mps2.z == INSOLE_R(0.5));
    ck_assert(imu.gyro_radps.x == INSOLE_R(1.0) && imu.gyro_radps.y == INSOLE_R(3.0) &&
              imu.gyro_radps.z == INSOLE_R(0.0));
}
END_TEST

/* Garbage of every kind between good readings: nothing that comes out is not finite. */
START_TEST(rows_are_finite_whatever_comes_in)
{
    static const char *const words[] = {"nan", "inf", "", "1e38", "-1e300", "0", "1e-40", "99999"};
    const char *path = scratch("garbage.csv");
    FILE *file = fopen(path, "wb");
    srand(17);
    for (int i = 0; i < 4000; i++) {
        fprintf(file, "imu,%.6f", rand() % 50 == 0 ? (rand() % 2001 - 1000) * 1e6 : i * 0.005);
        for (int k = 0; k < 6; k++) {
            if (rand() % 20 == 0) {
                fprintf(file, ",%s", words[rand() % 8]);
            } else {
                fprintf(file, ",%.3f", k == 2 ? 9.81 : (rand() % 100) * 0.001);
            }
        }
        fputs("\n", file);
    }
    fclose(file);
    replay_request_t request = request_of(&path);
    replay_result_run(&result, &request);
    ck_assert_uint_gt(result.rows.count, 100u);
    for (size_t i = 0u; i < result.rows.count; i++) {
        const track_row_t *row = &result.rows.rows[i];
        ck_assert(isfinite(row->x_m) && isfinite(row->y_m) && isfinite(row->z_m));
        ck_assert(isfinite(row->heading_rad) && isfinite(row->var_x_m2) &&
                  isfinite(row->var_y_m2) && isfinite(row->var_z_m2) &&
                  isfinite(row->var_heading_rad2));
        ck_assert(i == 0u || row->t_us > result.rows.rows[i - 1u].t_us);
    }
    replay_result_clear(&result);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("replay");
    suite_add(suite, "walk", a_walk_is_found_again);
    suite_add(suite, "events", strides_and_stances_are_told);
    suite_add(suite, "start", a_start_in_the_log_is_used);
    suite_add(suite, "start from outside", a_start_from_outside_replaces_that_of_the_log);
    suite_add(suite, "late start", what_was_before_the_start_is_not_drawn);
    suite_add(suite, "truth", truth_does_not_reach_the_tracker);
    suite_add(suite, "same bits", replays_give_the_same_bits);
    suite_add(suite, "prefix law", rows_of_a_cut_log_are_those_of_the_whole);
    suite_add(suite, "no sink", nobody_need_take_the_results);
    suite_add(suite, "stop", who_takes_the_results_can_stop_the_replay);
    suite_add(suite, "settings", settings_the_library_does_not_take_are_told);
    suite_add(suite, "sensor settings", the_sensor_settings_are_applied);
    suite_add(suite, "garbage", rows_are_finite_whatever_comes_in);
    return suite;
}
