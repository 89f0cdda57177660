/* SPDX-License-Identifier: MIT */
#include "phone_estimator.h"

#include "files.h"
#include "near.h"
#include "phone_logs.h"
#include "replay_result.h"
#include "suite.h"

static replay_result_t result;
static site_t site;
static const char *paths[2];

static void write_logs(double until_s, const char *head)
{
    FILE *file;
    paths[0] = scratch("motion.csv");
    paths[1] = scratch("radio.csv");
    file = fopen(paths[0], "wb");
    fputs("imu,0,0,0,9.81,0,0,0\n", file); /* a log of nothing else is none */
    phone_logs_write_motion(file, 0.02, until_s);
    fclose(file);
    file = fopen(paths[1], "wb");
    fputs(head, file);
    phone_logs_write_radio(file, until_s);
    fclose(file);
}

static replay_request_t request_of(method_t method)
{
    replay_request_t request;
    memset(&request, 0, sizeof request);
    request.logs = paths;
    request.log_count = 2u;
    request.rate_hz = 10.0;
    request.tracker = TRACKER_PHONE;
    request.method = method;
    request.particles = 200u;
    request.seed = 1u;
    settings_init(&request.settings);
    request.settings.phone.gait.faces = 0; /* a hand by formula is as stiff as a head */
    request.settings.phone.tracker.walk.step_length.model = INSOLE_STEP_LENGTH_CONSTANT;
    request.settings.phone.tracker.walk.step_length.constant_m = INSOLE_R(0.7);
    return request;
}

static void open_site(replay_request_t *request)
{
    const char *path = scratch("radiomap.csv");
    FILE *file = fopen(path, "wb");
    phone_logs_write_map(file);
    fclose(file);
    ck_assert_msg(
        site_open(&site, NULL, NULL, path, &request->settings.propagation, &result.failure), "%s",
        result.failure.text);
    request->site = &site;
}

static double worst_error_m(const track_t *rows, double from_s)
{
    double most = 0.0;
    for (size_t i = 0u; i < rows->count; i++) {
        double t_s = 1e-6 * (double)rows->rows[i].t_us;
        phone_pose_t pose = phone_pose(t_s);
        if (t_s >= from_s) {
            most = fmax(most, hypot(rows->rows[i].x_m - pose.x_m, rows->rows[i].y_m - pose.y_m));
        }
    }
    return most;
}

static const char start_line[] = "start,0,4,4,0,0.2,0.05\n";

/* ---- walks --------------------------------------------------------------------------------- */

static const method_t walkers[] = {
    METHOD_PHONE_BEST, METHOD_PHONE_PDR, METHOD_PDR_GYRO, METHOD_EKF, METHOD_UKF, METHOD_KF_CONST,
    METHOD_EKF_CONST,  METHOD_UKF_CONST, METHOD_ML_SHIFT, METHOD_WPF, METHOD_ZEE};

START_TEST(a_told_start_leads_every_method_to_the_end)
{
    write_logs(PHONE_LOGS_END_S, start_line);
    replay_request_t request = request_of(walkers[_i]);
    open_site(&request);
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.rows.count, 431u); /* 43 s at 10 Hz */
    ASSERT_AT_MOST(worst_error_m(&result.rows, 10.0), 4.5, "m");
    ASSERT_AT_LEAST(result.facts.strides, 72.0, "steps");
    ASSERT_AT_MOST(result.facts.strides, 76.0, "steps");
    ck_assert_uint_eq(result.events[EVENT_STEP], result.facts.strides);
    ASSERT_NEAR(result.steps_m, 0.7 * (double)result.facts.strides, 0.01, "m");
    ASSERT_NEAR(result.facts.walked_m, result.steps_m, 0.01, "m");
    ck_assert_int_eq(result.facts.last.state, INSOLE_FIX_TRACK);
    ck_assert_uint_gt(result.facts.phone.magnetic, 400u);
    bool hears = !method_is_steps_alone(walkers[_i]);
    ck_assert_uint_eq(result.events[EVENT_SCAN], hears ? 43u : 0u);
    ck_assert_uint_eq(result.facts.fusion.radio.worked_in, hears ? 43u : 0u);
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

START_TEST(radio_finds_a_start_that_nobody_tells)
{
    write_logs(PHONE_LOGS_END_S, "");
    replay_request_t request = request_of(_i == 0 ? METHOD_PHONE_BEST : METHOD_EKF);
    open_site(&request);
    replay_result_run(&result, &request);
    ck_assert_int_eq(result.rows.rows[0].state, INSOLE_FIX_SEARCH);
    ck_assert_int_eq(result.facts.last.state, INSOLE_FIX_TRACK);
    ck_assert_uint_ge(result.facts.phone.starts, 1u);
    ck_assert_uint_eq(result.events[EVENT_START], result.facts.phone.starts);
    ck_assert(result.facts.knows_place);
    ASSERT_AT_MOST(worst_error_m(&result.rows, 35.0), 5.0, "m");
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

/* Nothing is known of the building: steps alone, from (0, 0). */
START_TEST(without_fingerprints_the_steps_are_left)
{
    write_logs(PHONE_LOGS_END_S, "");
    replay_request_t request = request_of(METHOD_PHONE_BEST);
    replay_result_run(&result, &request);
    const track_row_t *last = &result.facts.last;
    ASSERT_NEAR(hypot(last->x_m, last->y_m), 1.4 * hypot(21.0, 16.0), 2.0, "m");
    ck_assert_uint_eq(result.facts.phone.points, 0u);
    ck_assert_uint_eq(result.events[EVENT_SCAN], 0u);
    replay_result_clear(&result);
}
END_TEST

START_TEST(radio_alone_gives_a_row_for_each_scan)
{
    write_logs(PHONE_LOGS_END_S, "");
    replay_request_t request = request_of(_i == 0 ? METHOD_WIFI_KDE : METHOD_WIFI_ML);
    open_site(&request);
    request.logs = &paths[1];
    request.log_count = 1u;
    request.rate_hz = 0.0;
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.rows.count, 43u);
    for (size_t i = 0u; i < result.rows.count; i++) {
        ck_assert_int_eq(result.rows.rows[i].t_us, 510000 + 1000000 * (int64_t)i);
        ck_assert_int_eq(result.rows.rows[i].state, INSOLE_FIX_TRACK);
    }
    ASSERT_AT_MOST(worst_error_m(&result.rows, 0.0), 6.0, "m");
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

/* ---- the same bits ------------------------------------------------------------------------- */

/* Rows of a log that ends sooner are those of the whole one, but for the last half second. */
START_TEST(rows_of_a_cut_session_are_those_of_the_whole)
{
    static const double cuts_s[] = {1.7, 4.33, 11.0, 24.21, 39.9};
    static const method_t methods[] = {METHOD_PHONE_BEST, METHOD_EKF, METHOD_WIFI_KDE};
    const char *head = _i % 2 == 0 ? start_line : "";
    replay_request_t request = request_of(methods[_i / 5]);
    open_site(&request);
    write_logs(PHONE_LOGS_END_S, head);
    replay_result_run(&result, &request);
    track_t whole = replay_result_take_rows(&result);
    write_logs(cuts_s[_i % 5], head);
    replay_result_run(&result, &request);
    size_t count = 0u;
    while (count < whole.count &&
           1e-6 * (double)whole.rows[count].t_us <= cuts_s[_i % 5] - 0.5 + 1e-9) {
        count++;
    }
    ck_assert_uint_ge(count, 10u);
    replay_result_same_rows(&whole, &result.rows, count);
    track_free(&whole);
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

START_TEST(replays_give_the_same_bits)
{
    write_logs(20.0, "");
    replay_request_t request = request_of(METHOD_PHONE_BEST);
    open_site(&request);
    replay_result_run(&result, &request);
    track_t first = replay_result_take_rows(&result);
    replay_result_run(&result, &request);
    ck_assert_uint_eq(first.count, result.rows.count);
    replay_result_same_rows(&first, &result.rows, first.count);
    track_free(&first);
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

START_TEST(truth_does_not_reach_the_tracker)
{
    write_logs(20.0, start_line);
    replay_request_t request = request_of(METHOD_PHONE_BEST);
    open_site(&request);
    replay_result_run(&result, &request);
    track_t first = replay_result_take_rows(&result);
    write_logs(20.0, "start,0,4,4,0,0.2,0.05\ntruth,0,90,90\ntruth,19,-90,90\n");
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.facts.truth.count, 2u);
    replay_result_same_rows(&first, &result.rows, first.count);
    track_free(&first);
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

/* ---- trouble ------------------------------------------------------------------------------- */

static const char *const troubles[] = {"rss,5,ap01,nan\nrss,5,ap02,\n",
                                       "rss,5,ap01,-50,900\nrss,5,ap02,-50,0\n",
                                       "rss,9000000,ap01,-50\nrss,9000000,ap02,-50\n",
                                       "imu,5.001,nan,nan,nan,nan,nan,nan\n",
                                       "mag,5.001,nan,0,0\nmag,5.002,0,0,0\n",
                                       "imu,5.001,1e30,1e30,1e30,1e30,1e30,1e30\n"};

START_TEST(trouble_does_not_stop_the_track)
{
    char head[256];
    snprintf(head, sizeof head, "%s%s", start_line, troubles[_i]);
    write_logs(PHONE_LOGS_END_S, head);
    replay_request_t request = request_of(METHOD_PHONE_BEST);
    open_site(&request);
    replay_result_run(&result, &request);
    for (size_t i = 0u; i < result.rows.count; i++) {
        const track_row_t *row = &result.rows.rows[i];
        ck_assert(isfinite(row->x_m) && isfinite(row->y_m) && isfinite(row->heading_rad));
        ck_assert(row->var_x_m2 >= 0.0 && row->var_y_m2 >= 0.0);
    }
    ASSERT_AT_MOST(hypot(result.facts.last.x_m - 33.4, result.facts.last.y_m - 26.4), 4.0, "m");
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

START_TEST(settings_the_library_does_not_take_are_told)
{
    write_logs(5.0, start_line);
    replay_request_t request = request_of(METHOD_PHONE_BEST);
    request.settings.phone.tracker.gap_s = (insole_real_t)NAN;
    const replay_sink_t sink = {&result, NULL, replay_result_keep_row, replay_result_keep_event};
    ck_assert(!replay_run(&request, &sink, &result.facts, &result.failure));
    ck_assert_uint_gt(strlen(result.failure.text), 0u);
    replay_result_clear(&result);
}
END_TEST

/* ---- plans --------------------------------------------------------------------------------- */

/* zee alone looks for itself all over a plan, and takes its first fix for a start. */
START_TEST(zee_needs_no_start)
{
    const char *plan = scratch("plan.csv");
    FILE *file = fopen(plan, "wb");
    fputs("outline,0,0,60,0,60,60,0,60\n", file);
    fclose(file);
    write_logs(PHONE_LOGS_END_S, "");
    replay_request_t request = request_of(METHOD_ZEE);
    ck_assert(site_open(&site, plan, NULL, NULL, &request.settings.propagation, &result.failure));
    request.site = &site;
    request.particles = 2000u;
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.facts.phone.starts, 1u);
    ck_assert_uint_eq(result.events[EVENT_SCAN], 0u);
    ASSERT_AT_LEAST(result.facts.last.var_x_m2, 25.0, "m^2");
    ASSERT_AT_MOST(fabs(result.facts.last.x_m - 30.0), 25.0, "m");
    replay_result_clear(&result);
    site_free(&site);
    open_site(&request);
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.facts.phone.starts, 1u);
    ASSERT_AT_MOST(worst_error_m(&result.rows, 2.0), 20.0, "m");
    ASSERT_AT_MOST(fabs(result.rows.rows[20].x_m - 4.0), 6.0, "m");
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

/* Fixes on the way are counted, and those on the map of another building. */
START_TEST(a_plan_of_elsewhere_is_noticed)
{
    static const struct {
        const char *plan;
        bool is_elsewhere;
    } CASES[] = {{"outline,0,0,60,0,60,60,0,60\n", false},
                 {"outline,100,0,160,0,160,60,100,60\n", true}};
    write_logs(PHONE_LOGS_END_S, start_line);
    for (size_t i = 0u; i < 2u; i++) {
        replay_request_t request = request_of(METHOD_PHONE_BEST);
        const char *plan = scratch_file("plan.csv", CASES[i].plan);
        ck_assert(
            site_open(&site, plan, NULL, NULL, &request.settings.propagation, &result.failure));
        request.site = &site;
        replay_result_run(&result, &request);
        ck_assert_uint_eq(result.facts.fusion.walls, 4u);
        ck_assert_uint_eq(result.facts.phone.particles, 200u);
        ck_assert_uint_eq(result.facts.fusion.outside,
                          CASES[i].is_elsewhere ? result.facts.fixes : 0u);
        replay_result_clear(&result);
        site_free(&site);
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_estimator");
    suite_add_loop(suite, "told start", a_told_start_leads_every_method_to_the_end, 11);
    suite_add_loop(suite, "found start", radio_finds_a_start_that_nobody_tells, 2);
    suite_add(suite, "steps alone", without_fingerprints_the_steps_are_left);
    suite_add_loop(suite, "radio alone", radio_alone_gives_a_row_for_each_scan, 2);
    suite_add_loop(suite, "prefix law", rows_of_a_cut_session_are_those_of_the_whole, 15);
    suite_add(suite, "same bits", replays_give_the_same_bits);
    suite_add(suite, "truth", truth_does_not_reach_the_tracker);
    suite_add_loop(suite, "trouble", trouble_does_not_stop_the_track, 6);
    suite_add(suite, "settings", settings_the_library_does_not_take_are_told);
    suite_add(suite, "zee", zee_needs_no_start);
    suite_add(suite, "plan of elsewhere", a_plan_of_elsewhere_is_noticed);
    return suite;
}
