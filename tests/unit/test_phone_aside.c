/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_aside.h"

#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

#define PI 3.14159265358979323846

static insole_step_filter_begin_t at;
static insole_phone_sight_t sight;

static void set_up(insole_rng_t *rng, bool has_compass, double mean_rad)
{
    insole_step_filter_begin_t begin = {
        .t_us = 7u,
        .spot = {sample_between(rng, -50, 50), sample_between(rng, -50, 50)},
        .cov_m2 = {INSOLE_R(4.0), INSOLE_R(1.0), INSOLE_R(9.0)},
        .offset_rad = sample_between(rng, -3, 3),
        .var_offset_rad2 = INSOLE_R(0.02)};
    at = begin;
    memset(&sight, 0, sizeof sight);
    sight.is_known = has_compass;
    sight.mean_rad = (insole_real_t)mean_rad;
    sight.sigma_mean_rad = INSOLE_R(0.1);
}

static double apart(double a, double b)
{
    return fabs(remainder(a - b, 2.0 * PI));
}

/* However far the compass errs: whichever of the two offsets it is nearer to. A walker's place
 * after the turn is where the whole way in the right direction leads, from where that way began. */
START_TEST(the_end_is_where_the_right_way_leads)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 8u);
    int kept = 0;
    worst_t off = {0.0, 0.0}, angle = {0.0, 0.0}, wide = {0.0, 0.0};
    for (int i = 0; i < 2000; i++) {
        bool has_compass = i % 3 != 0;
        set_up(&rng, has_compass, (double)sample_between(&rng, -3, 3));
        const insole_step_filter_begin_t was = at;
        double askew = (double)sample_between(&rng, -3, 3), o = (double)was.offset_rad;
        double wx = (double)sample_between(&rng, -9, 9), wy = (double)sample_between(&rng, -9, 9);
        insole_spot_t way = {(insole_real_t)wx, (insole_real_t)wy};
        double mean = (double)sight.mean_rad;
        bool may_be_held = i % 5 != 0;
        bool keeps = !may_be_held || (has_compass && apart(o, mean) < apart(o - askew, mean));
        insole_phone_aside_t aside = {(insole_real_t)askew, way, may_be_held};
        ck_assert_int_eq(insole_phone_aside_turn(&at, &sight, &aside), INSOLE_OK);
        double before = o, after = keeps ? o + askew : o;
        double x = (double)was.spot.x_m - (wx * cos(before) - wy * sin(before));
        double y = (double)was.spot.y_m - (wx * sin(before) + wy * cos(before));
        x += wx * cos(after) - wy * sin(after);
        y += wx * sin(after) + wy * cos(after);
        worst_note(&off, hypot(x - (double)at.spot.x_m, y - (double)at.spot.y_m), i);
        worst_note(&angle, apart((double)at.offset_rad, keeps ? o : o - askew), i);
        double moved = hypot(x - (double)was.spot.x_m, y - (double)was.spot.y_m);
        worst_note(&wide, fabs((double)at.cov_m2.xx - 4.0 - 0.09 * moved * moved), i);
        kept += keeps ? 1 : 0;
        ck_assert(at.t_us == was.t_us && at.var_offset_rad2 == was.var_offset_rad2);
    }
    ck_assert_int_gt(kept, 400);
    ck_assert_int_lt(kept, 1400);
    ASSERT_WORST(off, 2e-5, "m");
    ASSERT_WORST(angle, 1e-5, "rad");
    ASSERT_WORST(wide, 2e-4, "m^2");
}
END_TEST

START_TEST(without_a_compass_the_offset_holds_the_angle)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 9u);
    set_up(&rng, false, 0.0);
    const insole_step_filter_begin_t was = at;
    sight.mean_rad = was.offset_rad; /* of no meaning */
    insole_phone_aside_t aside = {INSOLE_R(1.5), {INSOLE_R(4.0), INSOLE_R(1.0)}, true};
    ck_assert_int_eq(insole_phone_aside_turn(&at, &sight, &aside), INSOLE_OK);
    ck_assert_mem_eq(&at.spot, &was.spot, sizeof at.spot);
    ck_assert_mem_eq(&at.cov_m2, &was.cov_m2, sizeof at.cov_m2);
    ASSERT_NEAR(apart((double)at.offset_rad, (double)was.offset_rad - 1.5), 0.0, 1e-6, "rad");
}
END_TEST

START_TEST(what_is_none_is_refused)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 10u);
    set_up(&rng, true, 0.5);
    const insole_real_t nan = (insole_real_t)NAN, one = INSOLE_R(1.0);
    const insole_phone_aside_t good = {one, {one, one}, true};
    const insole_phone_aside_t bad[] = {
        {nan, {one, one}, true}, {one, {nan, one}, true}, {one, {one, (insole_real_t)INFINITY}, 0}};
    ASSERT_UNCHANGED(at, insole_phone_aside_turn(&at, NULL, &good), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(at, insole_phone_aside_turn(&at, &sight, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_aside_turn(NULL, &sight, &good), INSOLE_ERR_NULL);
    for (int i = 0; i < 3; i++) {
        ASSERT_UNCHANGED(at, insole_phone_aside_turn(&at, &sight, &bad[i]), INSOLE_ERR_VALUE);
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_aside");
    suite_add(suite, "right way", the_end_is_where_the_right_way_leads);
    suite_add(suite, "no compass", without_a_compass_the_offset_holds_the_angle);
    suite_add(suite, "refused", what_is_none_is_refused);
    return suite;
}
