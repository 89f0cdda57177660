/* SPDX-License-Identifier: MIT */
#include "estimator.h"

#include "foot_site.h"
#include "near.h"
#include "suite.h"

/* ---- second order ----------------------------------------------------------------------- */

START_TEST(nothing_known_of_a_building_is_the_first_order)
{
    write_logs(1e9, start_line);
    replay_request_t request = request_of(METHOD_INS);
    replay_result_run(&result, &request);
    track_t ins = replay_result_take_rows(&result);
    request = request_of(METHOD_BEST);
    replay_result_run(&result, &request);
    ck_assert(!result.facts.fusion.is_fused);
    ck_assert_uint_eq(result.facts.fusion.ids, APS + 1u);
    ck_assert_uint_eq(result.rows.count, ins.count);
    replay_result_same_rows(&ins, &result.rows, ins.count);
    track_free(&ins);
    replay_result_clear(&result);
}
END_TEST

START_TEST(building_and_radio_are_used)
{
    write_logs(1e9, start_line);
    replay_request_t request = request_of(METHOD_BEST);
    open_site(&request, true, true);
    replay_result_run(&result, &request);
    const replay_fusion_t *fusion = &result.facts.fusion;
    ck_assert(fusion->is_fused && fusion->walls == 8u && fusion->aps == APS);
    ck_assert_uint_eq(fusion->unknown_ids, 1u);
    ck_assert_uint_eq(fusion->radio.scans, 28u);
    ck_assert_uint_eq(fusion->radio.ranges, 28u * APS);
    ck_assert_uint_eq(fusion->waits.scans, 28u);
    ck_assert_uint_gt(fusion->radio.worked_in, 10u);
    ck_assert_uint_gt(fusion->cloud.count, 0u);
    ck_assert(fusion->has_offset && fabs(fusion->offset_db) < 5.0);
    ck_assert(result.facts.knows_place && !fusion->starts_outside);
    ck_assert_uint_eq(result.events[EVENT_STRIDE], 20u);
    ck_assert_uint_eq(result.events[EVENT_START], 1u);
    ck_assert_uint_gt(result.events[EVENT_SCAN], 10u);
    ck_assert_uint_gt(result.events[EVENT_RANGES], 10u);
    ck_assert_uint_eq(result.events[EVENT_RESAMPLING], fusion->particles.resampled);
    ck_assert_uint_eq(result.events[EVENT_REDRAW], fusion->particles.redrawn);
    ck_assert_uint_eq(result.events[EVENT_RECOVERY], fusion->particles.recovered);
    ASSERT_AT_MOST(mean_error_m(&result.rows, 0.0), 0.5, "m");
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

START_TEST(radio_that_is_not_wanted_is_not_used)
{
    write_logs(1e9, start_line);
    replay_request_t request = request_of(METHOD_BEST);
    open_site(&request, false, true);
    request.no_rss = true;
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.facts.fusion.waits.scans, 0u);
    ck_assert_uint_gt(result.facts.fusion.waits.ranges, 0u);
    ck_assert_uint_eq(result.events[EVENT_SCAN], 0u);
    replay_result_clear(&result);
    request.no_rss = false;
    request.no_range = true;
    replay_result_run(&result, &request);
    ck_assert_uint_gt(result.facts.fusion.waits.scans, 0u);
    ck_assert_uint_eq(result.facts.fusion.waits.ranges, 0u);
    ck_assert_uint_eq(result.events[EVENT_RANGES], 0u);
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

START_TEST(radio_finds_a_start_that_nobody_tells)
{
    write_logs(1e9, "");
    replay_request_t request = request_of(METHOD_BEST);
    open_site(&request, true, true);
    request.no_range = true; /* signal strengths take longer */
    replay_result_run(&result, &request);
    ck_assert(result.facts.knows_place);
    ck_assert_int_gt(result.facts.start_us, 0);
    ck_assert_uint_gt(result.facts.states[INSOLE_FIX_SEARCH], 0u);
    replay_result_clear(&result);
    request.no_range = false;
    replay_result_run(&result, &request);
    ck_assert_uint_gt(result.facts.states[INSOLE_FIX_TRACK], 0u);
    ASSERT_AT_MOST(mean_error_m(&result.rows, 15.0), 1.0, "m");
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

START_TEST(equal_seeds_give_equal_bits)
{
    write_logs(1e9, start_line);
    replay_request_t request = request_of(_i == 0 ? METHOD_BEST : METHOD_TWO_ORDER);
    open_site(&request, true, true);
    replay_result_run(&result, &request);
    track_t first = replay_result_take_rows(&result);
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.rows.count, first.count);
    replay_result_same_rows(&result.rows, &first, first.count);
    replay_result_clear(&result);
    request.seed = 2u;
    replay_result_run(&result, &request);
    const track_row_t *a = &first.rows[first.count - 1u];
    const track_row_t *b = &result.rows.rows[result.rows.count - 1u];
    ck_assert(a->x_m != b->x_m && a->y_m != b->y_m);
    track_free(&first);
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

START_TEST(a_lag_gives_the_same_rows_later)
{
    write_logs(1e9, start_line);
    replay_request_t request = request_of(METHOD_BEST);
    open_site(&request, true, true);
    replay_result_run(&result, &request);
    size_t count = result.rows.count;
    unsigned long strides = result.events[EVENT_STRIDE];
    replay_result_clear(&result);
    request.settings.fusion.lag_s = INSOLE_R(3.0);
    replay_result_run(&result, &request);
    ck_assert_uint_eq(result.rows.count, count);
    ck_assert_uint_eq(result.events[EVENT_STRIDE], strides);
    ASSERT_AT_MOST(mean_error_m(&result.rows, 0.0), 0.5, "m");
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

/* ---- prefix law ------------------------------------------------------------------------- */

static const struct {
    method_t method;
    const char *head;
    bool has_plan, has_aps;
    double rate_hz;
} laws[] = {
    {METHOD_BEST, start_line, true, true, 10.0}, {METHOD_BEST, "", true, true, 0.0},
    {METHOD_BEST, start_line, true, false, 0.0}, {METHOD_TWO_ORDER, start_line, true, true, 10.0},
    {METHOD_WIFI, "", false, true, 10.0},        {METHOD_WIFI, "", false, true, 0.0}};

START_TEST(rows_of_a_cut_session_are_those_of_the_whole)
{
    static const double cuts_s[] = {0.7, 2.9, 5.05, 9.1, 13.0, 17.14, 22.3};
    replay_request_t request = request_of(laws[_i].method);
    open_site(&request, laws[_i].has_plan, laws[_i].has_aps);
    request.rate_hz = laws[_i].rate_hz;
    write_logs(1e9, laws[_i].head);
    replay_result_run(&result, &request);
    track_t rows = replay_result_take_rows(&result);
    for (size_t i = 0u; i < sizeof cuts_s / sizeof cuts_s[0]; i++) {
        write_logs(cuts_s[i], laws[_i].head);
        replay_result_run(&result, &request);
        size_t n = 0u;
        while (n < rows.count && 1e-6 * (double)rows.rows[n].t_us <= cuts_s[i] - 0.5) {
            n++;
        }
        replay_result_same_rows(&rows, &result.rows, n);
        replay_result_clear(&result);
    }
    track_free(&rows);
    site_free(&site);
}
END_TEST

/* ---- trouble ---------------------------------------------------------------------------- */

static const char *const troubles[] = {"rss,5,A,nan\nrss,5,B,\nrange,5,A,nan\nrange,5,B,\n",
                                       "rss,999999,A,-50\n",
                                       "rss,1000000,A,-50\nrange,1000000,A,5\n",
                                       "rss,-1000000,A,-50\nrange,-1000000,A,5\n",
                                       "rss,3,A,1e300,1e9\nrange,3,A,-5,1e30\nrange,3,B,1e30\n",
                                       "rss,0.4,A,-50\nrss,0.39,A,-50\nrss,0.4,B,-50\n"};

/* Whatever radio says, the track of the foot goes on. */
START_TEST(radio_trouble_does_not_stop_the_track)
{
    static const method_t methods[] = {METHOD_BEST, METHOD_TWO_ORDER, METHOD_WIFI};
    const char *trouble = troubles[_i];
    for (size_t k = 0u; k < 3u; k++) {
        write_logs(1e9, start_line);
        const char *all[3] = {paths[0], paths[1], scratch_file("trouble.csv", trouble)};
        replay_request_t request = request_of(methods[k]);
        open_site(&request, true, true);
        request.logs = all;
        request.log_count = 3u;
        replay_result_run(&result, &request);
        ck_assert_uint_gt(result.rows.count, 200u);
        ck_assert_uint_gt(result.facts.fusion.radio.worked_in, 2u);
        for (size_t i = 0u; i < result.rows.count; i++) {
            const track_row_t *row = &result.rows.rows[i];
            ck_assert(isfinite(row->x_m) && isfinite(row->y_m) && isfinite(row->var_x_m2));
            ck_assert_msg(hypot(row->x_m, row->y_m) < 100.0, "(%g, %g) m", row->x_m, row->y_m);
        }
        replay_result_clear(&result);
        site_free(&site);
    }
}
END_TEST

START_TEST(a_start_outside_the_plan_is_noticed)
{
    write_logs(1e9, "start,0,66,0,0.06\n");
    replay_request_t request = request_of(METHOD_BEST);
    open_site(&request, true, true);
    replay_result_run(&result, &request);
    ck_assert(result.facts.fusion.starts_outside);
    ASSERT_NEAR(result.facts.fusion.start_distance_m, 50.0, 0.01, "m");
    ck_assert_uint_gt(result.facts.fusion.outside, 0u);
    replay_result_clear(&result);
    write_logs(1e9, "start,0,66000,0,0.06\n");
    replay_result_run(&result, &request);
    ASSERT_NEAR(result.facts.fusion.start_distance_m, REPLAY_FAR_M, 0.0, "m");
    replay_result_clear(&result);
    site_free(&site);
}
END_TEST

START_TEST(settings_the_library_does_not_take_are_told)
{
    write_logs(1e9, "");
    replay_request_t request = request_of(METHOD_TWO_ORDER);
    replay_sink_t sink = {NULL, NULL, NULL, NULL};
    if (_i == 0) {
        request.settings.propagation.exponent = INSOLE_R(-1.0);
    } else if (_i == 1) {
        request.settings.fusion.two_order.walls = 9;
    } else {
        request.particles = 0u;
    }
    ck_assert(!replay_run(&request, &sink, &result.facts, &result.failure));
    ck_assert_str_eq(result.failure.text, "insole: the tracker does not take these settings");
    replay_result_clear(&result);
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("estimator");
    suite_add(suite, "no building", nothing_known_of_a_building_is_the_first_order);
    suite_add(suite, "building", building_and_radio_are_used);
    suite_add(suite, "use", radio_that_is_not_wanted_is_not_used);
    suite_add(suite, "no start", radio_finds_a_start_that_nobody_tells);
    suite_add_loop(suite, "same bits", equal_seeds_give_equal_bits, 2);
    suite_add(suite, "lag", a_lag_gives_the_same_rows_later);
    suite_add_loop(suite, "prefix law", rows_of_a_cut_session_are_those_of_the_whole, ROWS(laws));
    suite_add_loop(suite, "trouble", radio_trouble_does_not_stop_the_track, ROWS(troubles));
    suite_add(suite, "start outside", a_start_outside_the_plan_is_noticed);
    suite_add_loop(suite, "settings", settings_the_library_does_not_take_are_told, 3);
    return suite;
}
