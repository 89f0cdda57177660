/* SPDX-License-Identifier: MIT */
#include "radio_group.h"

#include <check.h>
#include <math.h>
#include <string.h>

#include "near.h"
#include "suite.h"

static radio_group_t group;

static record_t record(record_kind_t kind, int64_t t_us, uint32_t id, double value, double second)
{
    record_t made = {kind, t_us, id, {value, second, 0.0, 0.0, 0.0, 0.0}};
    return made;
}

static void add(record_kind_t kind, int64_t t_us, uint32_t id, double value, double second)
{
    record_t made = record(kind, t_us, id, value, second);
    ck_assert(!radio_group_ends(&group, &made));
    radio_group_add(&group, &made);
}

static void clear(void)
{
    radio_group_free(&group);
    ck_assert(radio_group_is_empty(&group));
}

START_TEST(records_of_a_moment_belong_together)
{
    const record_t imu = record(RECORD_IMU, 1000001, 0u, 0.0, 0.0);
    ck_assert(radio_group_is_empty(&group) && !radio_group_ends(&group, &imu));
    add(RECORD_RSS, 1000000, 3u, -50.5, (double)NAN);
    add(RECORD_RANGE, 1000000, 4u, 7.25, 0.5);
    add(RECORD_RSS, 1000000, 5u, -60.0, (double)NAN);
    add(RECORD_RANGE, 1000000, 6u, 8.0, (double)NAN);
    ck_assert_uint_eq(group.rss_count, 2u);
    ck_assert_uint_eq(group.range_count, 2u);
    ck_assert_uint_eq(group.rss[1].id, 5u);
    ASSERT_NEAR((double)group.rss[0].rss_dbm, -50.5, 0.0, "dBm");
    ASSERT_NEAR((double)group.range[0].range_m, 7.25, 0.0, "m");
    ASSERT_NEAR((double)group.range[0].sigma_m, 0.5, 0.0, "m");
    ck_assert_msg(group.range[1].sigma_m <= INSOLE_R(0.0), "a sigma that is not told is not told");
    clear();
}
END_TEST

/* Whatever comes next ends a group, be it of an earlier time. */
START_TEST(another_time_ends_it)
{
    add(RECORD_RSS, 1000000, 3u, -50.0, 0.0);
    for (int kind = 0; kind < RECORD_KINDS; kind++) {
        const record_t same = record((record_kind_t)kind, 1000000, 0u, 0.0, 0.0);
        const record_t later = record((record_kind_t)kind, 1000001, 0u, 0.0, 0.0);
        const record_t earlier = record((record_kind_t)kind, 999999, 0u, 0.0, 0.0);
        ck_assert(!radio_group_ends(&group, &same));
        ck_assert(radio_group_ends(&group, &later));
        ck_assert(radio_group_ends(&group, &earlier));
    }
    radio_group_clear(&group);
    ck_assert(radio_group_is_empty(&group));
    add(RECORD_RSS, 500, 1u, -40.0, 2.0);
    ck_assert_uint_eq(group.age_us, 2000000u);
    clear();
}
END_TEST

/* The youngest reading tells when the scan was heard, whichever comes first. */
START_TEST(ages_are_relative_to_the_youngest)
{
    static const double orders[2][3] = {{1.5, 0.25, 3.0}, {0.25, 3.0, 1.5}};
    for (int k = 0; k < 2; k++) {
        for (uint32_t i = 0u; i < 3u; i++) {
            add(RECORD_RSS, 0, i, -50.0, orders[k][i]);
        }
        ck_assert_uint_eq(group.age_us, 250000u);
        for (uint32_t i = 0u; i < 3u; i++) {
            ASSERT_NEAR(1e-6 * group.rss[i].age_us, orders[k][i] - 0.25, 1e-6, "s");
        }
        radio_group_clear(&group);
    }
    add(RECORD_RSS, 0, 0u, -50.0, 1e300);
    ck_assert_uint_eq(group.age_us, UINT32_MAX);
    add(RECORD_RSS, 0, 1u, -50.0, (double)NAN);
    ck_assert_uint_eq(group.age_us, 0u);
    ck_assert_uint_eq(group.rss[0].age_us, UINT32_MAX);
    clear();
}
END_TEST

START_TEST(what_does_not_fit_is_not_a_number)
{
    const double too_large = 2.0 * (double)INSOLE_REAL_MAX;
    add(RECORD_RSS, 0, 0u, too_large, 0.0);
    add(RECORD_RANGE, 0, 0u, (double)INFINITY, too_large);
    ck_assert(isnan((double)group.rss[0].rss_dbm));
    ck_assert(isnan((double)group.range[0].range_m));
    ck_assert(isnan((double)group.range[0].sigma_m));
    clear();
}
END_TEST

START_TEST(a_scan_may_be_large)
{
    for (uint32_t i = 0u; i < 3000u; i++) {
        add(RECORD_RSS, 7, i, -(double)(i % 100u), 0.0);
    }
    ck_assert_uint_eq(group.rss_count, 3000u);
    ck_assert_uint_eq(group.rss[2999].id, 2999u);
    clear();
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("radio_group");
    suite_add(suite, "together", records_of_a_moment_belong_together);
    suite_add(suite, "end", another_time_ends_it);
    suite_add(suite, "age", ages_are_relative_to_the_youngest);
    suite_add(suite, "not a number", what_does_not_fit_is_not_a_number);
    suite_add(suite, "large", a_scan_may_be_large);
    return suite;
}
