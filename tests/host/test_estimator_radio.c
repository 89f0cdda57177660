/* SPDX-License-Identifier: MIT
 * Radio alone places the walker: the method `wifi` of a shoe. */
#include "estimator.h"

#include "foot_site.h"
#include "near.h"
#include "suite.h"

/* Signal strengths alone are as good as the library's solution. */
static void expect_fix_of_library(const replay_request_t *request, const track_row_t *row,
                                  double t_s)
{
    insole_rss_t readings[APS];
    insole_anchor_fix_t fix;
    for (uint32_t i = 0u; i < APS; i++) {
        double rss_dbm = 0.1 * round(10.0 * (-43.4 - 20.0 * log10(distance_m((int)i, t_s))));
        insole_rss_t reading = {i, (insole_real_t)rss_dbm, 0u};
        readings[i] = reading;
    }
    ck_assert_int_eq(insole_rss_fix_solve(&request->settings.fusion.rss_fix,
                                          &request->settings.propagation, site.building.aps, APS,
                                          readings, APS, &fix),
                     INSOLE_OK);
    ASSERT_NEAR(row->x_m, (double)fix.x_m, 1e-3, "m");
    ASSERT_NEAR(row->y_m, (double)fix.y_m, 1e-3, "m");
}

START_TEST(radio_alone_gives_a_row_for_each_scan)
{
    write_logs(1e9, "");
    replay_request_t request = request_of(METHOD_WIFI);
    open_site(&request, false, true);
    request.logs = &paths[1];
    request.log_count = 1u;
    request.no_rss = _i == 0;
    request.no_range = _i == 1;
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.rows.count, 28u);
    for (size_t i = 0u; i < result.rows.count; i++) {
        ck_assert_int_eq(result.rows.rows[i].t_us, 400000 + 930000 * (int64_t)i);
        ck_assert_int_eq(result.rows.rows[i].state, INSOLE_FIX_TRACK);
    }
    if (_i == 1) {
        expect_fix_of_library(&request, &result.rows.rows[20], 0.4 + 0.93 * 20);
    } else {
        ASSERT_AT_MOST(mean_error_m(&result.rows, 0.0), 1.0, "m");
    }
    ck_assert(result.facts.knows_place);
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

START_TEST(with_an_imu_rows_of_radio_are_due_as_ever)
{
    write_logs(1e9, start_line);
    replay_request_t request = request_of(METHOD_WIFI);
    open_site(&request, false, true);
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.rows.count, 261u);
    for (size_t i = 0u; i < result.rows.count; i++) {
        const track_row_t *row = &result.rows.rows[i];
        ck_assert_int_eq(row->t_us, 100000 * (int64_t)i);
        ck_assert_int_eq(row->state == INSOLE_FIX_SEARCH, row->t_us <= 400000);
    }
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

/* A fix grows old. */
START_TEST(radio_that_falls_silent_is_told)
{
    write_logs(1e9, "");
    paths[1] = scratch_file("short.csv", "rss,0.998,A,-50\nrss,0.998,B,-60\n");
    replay_request_t request = request_of(METHOD_WIFI);
    open_site(&request, false, true);
    replay_result_run(&result, &request);
    for (size_t i = 0u; i < result.rows.count; i++) {
        const track_row_t *row = &result.rows.rows[i];
        insole_fix_state_t expected = row->t_us < 1000000                    ? INSOLE_FIX_SEARCH
                                      : row->t_us <= 998000 + RADIO_FRESH_US ? INSOLE_FIX_TRACK
                                                                             : INSOLE_FIX_COAST;
        ck_assert_int_eq(row->state, expected);
    }
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("estimator_radio");
    suite_add_loop(suite, "wifi", radio_alone_gives_a_row_for_each_scan, 3);
    suite_add(suite, "wifi with IMU", with_an_imu_rows_of_radio_are_due_as_ever);
    suite_add(suite, "silence", radio_that_falls_silent_is_told);
    return suite;
}
