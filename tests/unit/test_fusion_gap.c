/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_gap.h"

#include <string.h>

#include "near.h"
#include "refusal.h"
#include "suite.h"

static insole_fusion_gap_t gap;
static insole_foot_tracker_t foot;
static insole_fix_t fix;

static void begin(void)
{
    static const insole_fusion_gap_t no_gap;
    static const insole_foot_tracker_t no_foot;
    static const insole_fix_t no_fix;
    gap = no_gap;
    foot = no_foot;
    fix = no_fix;
}

/* What the first order says of itself at one sample; true while the gap is open. */
static bool follow(uint64_t t_us, double var_m2, double var_rad2, bool coasting, double turn_rad2)
{
    fix.t_us = t_us;
    fix.var_x_m2 = (insole_real_t)var_m2;
    fix.var_y_m2 = (insole_real_t)(0.5 * var_m2);
    foot.anchor.var_rad2 = (insole_real_t)var_rad2;
    foot.gap_turn_rad2 = (insole_real_t)turn_rad2;
    foot.coasting = coasting;
    return insole_fusion_gap_follow(&gap, &foot, &fix);
}

static void check_lost(double m2, double rad2)
{
    insole_fusion_unknown_t lost = insole_fusion_gap_lost(&gap);
    ASSERT_NEAR(lost.m2, m2, 1e-5, "m2");
    ASSERT_NEAR(lost.rad2, rad2, 1e-5, "rad2");
}

/* A walker whose readings come, sure of less and less: nothing is open, nothing lost. */
START_TEST(without_a_gap_nothing_is_lost)
{
    begin();
    for (uint64_t t = 1; t < 100; t++) {
        ck_assert(!follow(t, 0.1 * (double)t, 0.01 * (double)t, false, t % 7 == 0 ? 0.3 : 0.0));
        check_lost(0.0, 0.0);
        ck_assert(!gap.is_crossed);
    }
}
END_TEST

START_TEST(a_gap_is_open_until_it_is_closed)
{
    begin();
    ck_assert(!follow(1, 1.0, 0.1, false, 0.0));
    ck_assert(follow(2, 5.0, 0.1, true, 2.0)); /* the first sample after it */
    ck_assert(!gap.is_crossed);
    check_lost(4.0, 2.0);
    ck_assert(follow(3, 6.0, 0.1, true, 2.0));
    ck_assert(follow(4, 6.5, 0.1, false, 2.0)); /* aligned, but what it turned is not booked yet */
    ck_assert(!gap.is_crossed);
    check_lost(5.5, 2.0);
    ck_assert(follow(5, 6.5, 2.1, false, 0.0));
    ck_assert(gap.is_crossed);
    check_lost(5.5, 2.0);
    ck_assert(follow(6, 7.0, 2.1, false, 0.0));
    ck_assert(gap.is_crossed && gap.crossed_us == 5);
    insole_fusion_gap_close(&gap);
    ck_assert(!gap.is_open && !gap.is_crossed);
    check_lost(0.0, 0.0);
    ck_assert(!follow(7, 7.5, 2.1, false, 0.0));
    check_lost(0.0, 0.0);
}
END_TEST

/* A second gap before the first is closed: both are lost, and it is to be crossed anew. */
START_TEST(gaps_add_up)
{
    begin();
    (void)follow(1, 1.0, 0.0, false, 0.0);
    (void)follow(2, 3.0, 0.0, true, 1.0);
    (void)follow(3, 3.0, 1.0, false, 0.0);
    ck_assert(gap.is_crossed);
    ck_assert(follow(9, 8.0, 1.0, true, 0.5));
    ck_assert(!gap.is_crossed);
    check_lost(7.0, 1.5);
    ck_assert(follow(10, 8.0, 1.5, false, 0.0));
    ck_assert(gap.is_crossed && gap.crossed_us == 10);
    check_lost(7.0, 1.5);
}
END_TEST

/* Closed while the readings are still missing, by a start that is told then: what is lost counts
 * from there. */
START_TEST(closed_early_it_opens_again)
{
    begin();
    (void)follow(1, 1.0, 0.0, false, 0.0);
    (void)follow(2, 30.0, 0.0, true, 1.0);
    insole_fusion_gap_close(&gap);
    check_lost(0.0, 0.0);
    ck_assert(follow(3, 31.0, 0.0, true, 1.25));
    check_lost(1.0, 0.25);
    ck_assert(follow(4, 31.0, 1.25, false, 0.0));
    ck_assert(gap.is_crossed);
}
END_TEST

/* Told a start meanwhile the first order knows more than before: nothing is taken from the cloud.
 */
START_TEST(nothing_is_lost_that_is_negative)
{
    begin();
    (void)follow(1, 10.0, 2.0, false, 0.0);
    (void)follow(2, 0.1, 0.1, true, 0.0);
    check_lost(0.0, 0.0);
}
END_TEST

START_TEST(what_is_lost_widens_the_cloud)
{
    begin();
    (void)follow(1, 1.0, 0.0, false, 0.0);
    insole_fix_t wide = {0};
    wide.var_x_m2 = 2;
    wide.cov_xy_m2 = INSOLE_R(0.5);
    wide.var_y_m2 = 3;
    wide.var_heading_rad2 = INSOLE_R(0.25);
    insole_fix_t same = wide;
    insole_fusion_gap_widen(&gap, &wide);
    ck_assert_mem_eq(&wide, &same, sizeof wide);
    (void)follow(2, 5.0, 0.0, true, 2.0);
    insole_fusion_gap_widen(&gap, &wide);
    ASSERT_NEAR(wide.var_x_m2, 6.0, 1e-5, "m2");
    ASSERT_NEAR(wide.var_y_m2, 7.0, 1e-5, "m2");
    ASSERT_NEAR(wide.cov_xy_m2, 0.5, 0.0, "m2");
    ASSERT_NEAR(wide.var_heading_rad2, 2.25, 1e-5, "rad2");
    (void)follow(3, 5.0, 0.0, true, 100.0);
    insole_fusion_gap_widen(&gap, &wide);
    ASSERT_NEAR(wide.var_heading_rad2, 9.8696044, 1e-4, "rad2"); /* any */
}
END_TEST

START_TEST(bad_calls_change_nothing)
{
    begin();
    (void)follow(1, 1.0, 0.0, false, 0.0);
    (void)follow(2, 5.0, 0.0, true, 2.0);
    ASSERT_UNCHANGED(gap, insole_fusion_gap_follow(&gap, NULL, &fix), false);
    ASSERT_UNCHANGED(gap, insole_fusion_gap_follow(&gap, &foot, NULL), false);
    ck_assert(!insole_fusion_gap_follow(NULL, &foot, &fix));
    insole_fix_t same = fix;
    insole_fusion_gap_widen(NULL, &fix);
    insole_fusion_gap_widen(&gap, NULL);
    insole_fusion_gap_close(NULL);
    ck_assert_mem_eq(&fix, &same, sizeof fix);
    insole_fusion_unknown_t none = insole_fusion_gap_lost(NULL);
    ASSERT_NEAR(none.m2 + none.rad2, 0.0, 0.0, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("fusion_gap");
    suite_add(suite, "no gap", without_a_gap_nothing_is_lost);
    suite_add(suite, "open", a_gap_is_open_until_it_is_closed);
    suite_add(suite, "two", gaps_add_up);
    suite_add(suite, "closed early", closed_early_it_opens_again);
    suite_add(suite, "negative", nothing_is_lost_that_is_negative);
    suite_add(suite, "widen", what_is_lost_widens_the_cloud);
    suite_add(suite, "bad calls", bad_calls_change_nothing);
    return suite;
}
