/* SPDX-License-Identifier: MIT */
#include "row_maker.h"

#include <stdlib.h>
#include <string.h>

#include "near.h"
#include "suite.h"

static row_maker_t maker;
static track_row_t row;

static track_row_t fix_at(int64_t t_us, double x)
{
    track_row_t fix;
    memset(&fix, 0, sizeof fix);
    fix.t_us = t_us;
    fix.x_m = x;
    fix.y_m = -x;
    fix.z_m = 0.5 * x;
    fix.var_x_m2 = 2.0 * x;
    fix.state = INSOLE_FIX_TRACK;
    return fix;
}

static void push(int64_t t_us, double x)
{
    track_row_t fix = fix_at(t_us, x);
    row_maker_push(&maker, &fix);
}

static void expect_row(int64_t t_us, double x, insole_fix_state_t state)
{
    ck_assert(row_maker_take(&maker, &row));
    ck_assert_int_eq(row.t_us, t_us);
    ASSERT_NEAR(row.x_m, x, 1e-12, "m");
    ck_assert_int_eq(row.state, state);
}

static void expect_none(void)
{
    ck_assert(!row_maker_take(&maker, &row));
}

START_TEST(rows_are_interpolated_at_the_due_times)
{
    row_maker_init(&maker, 100.0);
    expect_none();
    push(1000000, 1.0);
    expect_row(1000000, 1.0, INSOLE_FIX_TRACK);
    expect_none();
    push(1025000, 3.5);
    expect_row(1010000, 2.0, INSOLE_FIX_TRACK);
    ASSERT_NEAR(row.y_m, -2.0, 1e-12, "m");
    ASSERT_NEAR(row.z_m, 1.0, 1e-12, "m");
    ASSERT_NEAR(row.var_x_m2, 4.0, 1e-12, "m^2");
    expect_row(1020000, 3.0, INSOLE_FIX_TRACK);
    expect_none();
}
END_TEST

START_TEST(due_times_do_not_drift)
{
    int64_t expected = 0;
    row_maker_init(&maker, 3.0);
    for (int64_t t_us = 0; t_us < 20000000; t_us += 5000) {
        push(t_us, 1.0);
        while (row_maker_take(&maker, &row)) {
            ck_assert_int_eq(row.t_us, expected * 1000000 / 3);
            expected++;
        }
    }
    ck_assert_int_eq(expected, 60);
}
END_TEST

START_TEST(a_rate_of_zero_gives_every_fix)
{
    row_maker_init(&maker, 0.0);
    for (int i = 0; i < 5; i++) {
        push(7919 * i, i);
        expect_row(7919 * i, i, INSOLE_FIX_TRACK);
        expect_none();
    }
}
END_TEST

START_TEST(a_gap_holds_the_fix_before_it)
{
    row_maker_init(&maker, 10.0);
    push(0, 1.0);
    expect_row(0, 1.0, INSOLE_FIX_TRACK);
    push(350000, 8.0);
    expect_row(100000, 1.0, INSOLE_FIX_COAST);
    expect_row(200000, 1.0, INSOLE_FIX_COAST);
    expect_row(300000, 1.0, INSOLE_FIX_COAST);
    expect_none();
    push(400000, 9.0);
    expect_row(400000, 9.0, INSOLE_FIX_TRACK);
}
END_TEST

START_TEST(the_longest_interval_that_is_joined)
{
    row_maker_init(&maker, 100.0);
    push(0, 0.0);
    expect_row(0, 0.0, INSOLE_FIX_TRACK);
    push(ROW_JOIN_US, 3.5);
    expect_row(10000, 1.0, INSOLE_FIX_TRACK);
    row_maker_init(&maker, 100.0);
    push(0, 0.0);
    expect_row(0, 0.0, INSOLE_FIX_TRACK);
    push(ROW_JOIN_US + 1, 3.5);
    expect_row(10000, 0.0, INSOLE_FIX_COAST);
}
END_TEST

START_TEST(rows_end_long_into_a_gap)
{
    int rows = 0;
    row_maker_init(&maker, 10.0);
    push(0, 1.0);
    expect_row(0, 1.0, INSOLE_FIX_TRACK);
    push(INT64_C(1000000000000000), 2.0); /* 31 years later */
    while (row_maker_take(&maker, &row)) {
        rows++;
    }
    ck_assert_int_eq(rows, 6001); /* ten minutes, and the new fix */
    ck_assert_int_eq(row.t_us, INT64_C(1000000000000000));
    ASSERT_NEAR(row.x_m, 2.0, 0.0, "m");
}
END_TEST

START_TEST(time_never_goes_back)
{
    row_maker_init(&maker, 0.0);
    push(1000, 1.0);
    expect_row(1000, 1.0, INSOLE_FIX_TRACK);
    push(1000, 2.0);
    push(500, 3.0);
    expect_none();
    push(1001, 4.0);
    expect_row(1001, 4.0, INSOLE_FIX_TRACK);
}
END_TEST

START_TEST(rows_begin_with_the_first_reading)
{
    row_maker_init(&maker, 10.0);
    row_maker_begin(&maker, 50000);
    push(260000, 1.0);
    expect_row(50000, 1.0, INSOLE_FIX_TRACK);
    expect_row(150000, 1.0, INSOLE_FIX_TRACK);
    expect_row(250000, 1.0, INSOLE_FIX_TRACK);
    expect_none();
}
END_TEST

START_TEST(a_wild_first_stamp_does_not_matter)
{
    row_maker_init(&maker, 10.0);
    row_maker_begin(&maker, INT64_C(99999000000));
    push(0, 1.0);
    expect_row(0, 1.0, INSOLE_FIX_TRACK);
    row_maker_init(&maker, 10.0);
    row_maker_begin(&maker, INT64_C(-99999000000));
    push(0, 1.0);
    expect_row(0, 1.0, INSOLE_FIX_TRACK);
    expect_none();
}
END_TEST

START_TEST(headings_turn_the_short_way)
{
    track_row_t a = fix_at(0, 0.0), b = fix_at(20000, 0.0);
    a.heading_rad = 3.0;
    b.heading_rad = -3.0;
    row_maker_init(&maker, 100.0);
    row_maker_push(&maker, &a);
    ck_assert(row_maker_take(&maker, &row));
    row_maker_push(&maker, &b);
    ck_assert(row_maker_take(&maker, &row));
    ASSERT_NEAR(fabs(row.heading_rad), 3.14159265358979, 1e-9, "rad");
}
END_TEST

START_TEST(other_states_stay_what_they_are_in_a_gap)
{
    track_row_t a = fix_at(0, 0.0), b = fix_at(1000000, 0.0);
    a.state = INSOLE_FIX_ALIGN;
    row_maker_init(&maker, 10.0);
    row_maker_push(&maker, &a);
    ck_assert(row_maker_take(&maker, &row));
    row_maker_push(&maker, &b);
    expect_row(100000, 0.0, INSOLE_FIX_ALIGN);
}
END_TEST

/* The prefix law: what is more than half a second older than the end of the fixes never changes,
 * when the fixes younger than 0.465 s still may. */
START_TEST(rows_half_a_second_old_are_final)
{
    srand(5);
    for (int trial = 0; trial < 50; trial++) {
        track_row_t fixes[400], whole[400], cut[400];
        size_t whole_count = 0u, cut_count = 0u, n = 100u + (size_t)(rand() % 300);
        int64_t t_us = 0;
        for (int i = 0; i < 400; i++) {
            fixes[i] = fix_at(t_us, rand() % 100);
            t_us += rand() % 20 == 0 ? rand() % 400000 : 1000 + rand() % 30000;
        }
        row_maker_init(&maker, 10.0);
        for (int i = 0; i < 400; i++) {
            row_maker_push(&maker, &fixes[i]);
            while (whole_count < 400u && row_maker_take(&maker, &whole[whole_count])) {
                whole_count++;
            }
        }
        int64_t end_us = fixes[n - 1u].t_us;
        row_maker_init(&maker, 10.0);
        for (size_t i = 0u; i < n; i++) {
            track_row_t fix = fixes[i];
            fix.x_m += fix.t_us > end_us - 465000 ? 1.0 : 0.0; /* not yet final */
            row_maker_push(&maker, &fix);
            while (cut_count < 400u && row_maker_take(&maker, &cut[cut_count])) {
                cut_count++;
            }
        }
        for (size_t i = 0u; i < whole_count && whole[i].t_us <= end_us - 500000; i++) {
            ck_assert_uint_lt(i, cut_count);
            ck_assert_int_eq(memcmp(&whole[i], &cut[i], sizeof whole[i]), 0);
        }
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("row_maker");
    suite_add(suite, "interpolated", rows_are_interpolated_at_the_due_times);
    suite_add(suite, "no drift", due_times_do_not_drift);
    suite_add(suite, "every fix", a_rate_of_zero_gives_every_fix);
    suite_add(suite, "gap", a_gap_holds_the_fix_before_it);
    suite_add(suite, "join", the_longest_interval_that_is_joined);
    suite_add(suite, "long gap", rows_end_long_into_a_gap);
    suite_add(suite, "order", time_never_goes_back);
    suite_add(suite, "first", rows_begin_with_the_first_reading);
    suite_add(suite, "wild first", a_wild_first_stamp_does_not_matter);
    suite_add(suite, "heading", headings_turn_the_short_way);
    suite_add(suite, "state", other_states_stay_what_they_are_in_a_gap);
    suite_add(suite, "prefix law", rows_half_a_second_old_are_final);
    return suite;
}
