/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_news.h"

#include "insole/move/heading.h"
#include "near.h"
#include "phone.h"
#include "plane.h"
#include "refusal.h"
#include "suite.h"

#define EPS ((double)INSOLE_REAL_EPSILON)
#define BAD ((insole_real_t)NAN), ((insole_real_t)INFINITY), (-(insole_real_t)INFINITY)

static const insole_pace_t PACE = {INSOLE_R(0.7), 1, INSOLE_R(0.01), INSOLE_R(0.02)};

START_TEST(paces_are_checked)
{
    const insole_real_t bad[] = {BAD, -INSOLE_R(0.001), INSOLE_R(10.01)};
    insole_pace_t pace = PACE;
    ck_assert_int_eq(insole_pace_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_pace_check(&pace), INSOLE_OK);
    for (int i = 0; i < 5; i++) {
        pace = PACE;
        pace.length_m = bad[i];
        ck_assert_int_eq(insole_pace_check(&pace), INSOLE_ERR_VALUE);
        pace = PACE;
        pace.var_length_m2 = i == 4 ? INSOLE_R(101.0) : bad[i];
        ck_assert_int_eq(insole_pace_check(&pace), INSOLE_ERR_VALUE);
        pace = PACE;
        pace.heading_rad = i < 3 ? bad[i] : INSOLE_R(2000.0);
        ck_assert_int_eq(insole_pace_check(&pace), INSOLE_ERR_VALUE);
        pace = PACE;
        pace.var_heading_rad2 = bad[i % 4];
        ck_assert_int_eq(insole_pace_check(&pace), INSOLE_ERR_VALUE);
    }
    insole_pace_t widest = {10, -1000, 100, INSOLE_R(1e20)}, narrowest = {0, 1000, 0, 0};
    ck_assert_int_eq(insole_pace_check(&widest), INSOLE_OK);
    ck_assert_int_eq(insole_pace_check(&narrowest), INSOLE_OK);
}
END_TEST

START_TEST(fixes_are_checked)
{
    const insole_spot_fix_t good = {7u, {3, -4}, {4, 1, 2}, {1, 2}};
    const insole_real_t bad[] = {BAD, INSOLE_R(1.1e5)};
    insole_spot_fix_t fix = good;
    ck_assert_int_eq(insole_spot_fix_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_spot_fix_check(&fix), INSOLE_OK);
    insole_real_t *coordinates[] = {&fix.spot.x_m, &fix.spot.y_m, &fix.since.x_m, &fix.since.y_m};
    for (int i = 0; i < 16; i++) {
        fix = good;
        *coordinates[i / 4] = bad[i % 4];
        ck_assert_int_eq(insole_spot_fix_check(&fix), INSOLE_ERR_VALUE);
    }
    const insole_sym2_t none[] = {{INSOLE_R(1e-7), 0, 1},
                                  {1, 0, INSOLE_R(1e-7)},
                                  {INSOLE_R(2e12), 0, 1},
                                  {1, 0, INSOLE_R(2e12)},
                                  {1, 1, 1},
                                  {-1, 0, -1},
                                  {bad[0], 0, 1},
                                  {1, bad[0], 1},
                                  {1, bad[1], 1}};
    for (int i = 0; i < 9; i++) {
        fix = good;
        fix.cov_m2 = none[i];
        ck_assert_int_eq(insole_spot_fix_check(&fix), INSOLE_ERR_VALUE);
        ck_assert(!insole_spot_is_start(fix.spot, none[i], 0));
    }
}
END_TEST

START_TEST(starts_are_checked)
{
    const insole_sym2_t circle = insole_sym2_circle(1);
    const insole_real_t bad[] = {BAD, INSOLE_R(1001.0), INSOLE_R(1.1e5)};
    ck_assert(insole_spot_is_start(insole_spot(3, -4), circle, -1000));
    for (int i = 0; i < 4; i++) {
        ck_assert(!insole_spot_is_start(insole_spot(3, -4), circle, bad[i]));
        insole_real_t far = bad[i == 3 ? 4 : i];
        ck_assert(!insole_spot_is_start(insole_spot(far, 0), circle, 0));
        ck_assert(!insole_spot_is_start(insole_spot(0, far), circle, 0));
        ck_assert(!insole_spot_is_in_reach(insole_spot(10 * far, 0)));
        ck_assert(!insole_spot_is_in_reach(insole_spot(0, 10 * far)));
    }
    ck_assert(insole_spot_is_in_reach(insole_spot(INSOLE_R(1e6), -INSOLE_R(1e6))));
    insole_sym2_t P = insole_spot_cov(insole_sym2_circle(0));
    ASSERT_NEAR(P.xx, INSOLE_SPOT_LEAST_M2, 0.0, "m^2");
    P = insole_spot_cov(insole_sym2_circle(INSOLE_R(1e13)));
    ASSERT_NEAR(P.yy / INSOLE_SPOT_MOST_M2, 1.0, 4.0 * EPS, "");
}
END_TEST

START_TEST(a_way_is_length_and_direction)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 1000; i++) {
        insole_pace_t pace = PACE;
        pace.heading_rad = sample_between(&rng, -4, 4);
        pace.length_m = sample_between(&rng, 0, 2);
        insole_real_t offset = sample_between(&rng, -4, 4);
        double angle = (double)pace.heading_rad + (double)offset, d = (double)pace.length_m;
        point_t expected = {d * cos(angle), d * sin(angle)};
        worst_note(&off, point_apart(expected, insole_pace_way(&pace, offset)), i);
    }
    ASSERT_WORST(off, 16.0 * EPS, "m");
}
END_TEST

/* The papers' Jacobian of the way by quaternion and length, by differences in double. */
START_TEST(a_step_becomes_a_pace_with_the_variance_of_its_attitude)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t heading = {0.0, 0.0}, variance = {0.0, 0.0};
    for (int i = 0; i < 300; i++) {
        double yaw = (double)sample_between(&rng, -3, 3);
        double pitch = (double)sample_between(&rng, -1, 1);
        d33_t R = d33_mul(turn_z(yaw), turn_x(pitch));
        insole_mat3_t M = sample_mat3(&rng, INSOLE_R(0.1));
        insole_step_t step = {7u, INSOLE_R(0.7), quat_of(R), insole_mat3_mul_t_sym(M, M), 0};
        insole_pace_t pace;
        ck_assert_int_eq(insole_pace_of_step(&step, INSOLE_R(0.04), &pace), INSOLE_OK);
        worst_note(&heading,
                   fabs(remainder((double)pace.heading_rad - yaw - 0.5 * 3.14159265358979,
                                  6.283185307179586)),
                   i);
        /* a small rotation a in n turns the level part of y, the phone's top */
        d3_t top = d3(R.r0.y, R.r1.y, R.r2.y);
        double J[3];
        for (int k = 0; k < 3; k++) {
            double h = 1.0e-6;
            d3_t a = d3(k == 0 ? h : 0.0, k == 1 ? h : 0.0, k == 2 ? h : 0.0);
            d3_t up = d33_apply(d33_exp(a), top), down = d33_apply(d33_exp(d3_scale(a, -1.0)), top);
            J[k] =
                remainder(atan2(up.y, up.x) - atan2(down.y, down.x), 6.283185307179586) / (2.0 * h);
        }
        d33_t P = d33_of(insole_sym3_full(step.attitude_cov_rad2));
        d3_t j = d3(J[0], J[1], J[2]);
        double expected = d3_dot(j, d33_apply(P, j));
        worst_note(&variance, fabs((double)pace.var_heading_rad2 - expected), i);
        ASSERT_NEAR(pace.length_m, INSOLE_R(0.7), 0.0, "m");
        ASSERT_NEAR(pace.var_length_m2, INSOLE_R(0.04), 0.0, "m^2");
    }
    ASSERT_WORST(heading, 16.0 * EPS + 1.0e-12, "rad");
    ASSERT_WORST(variance, 64.0 * EPS * 0.1 + 1.0e-9, "rad^2");
}
END_TEST

START_TEST(what_is_no_step_is_no_pace)
{
    const insole_step_t good = {7u, INSOLE_R(0.7), {1, 0, 0, 0}, {1, 0, 0, 1, 0, 1}, 0};
    const insole_real_t bad[] = {BAD, -1};
    insole_step_t step = good;
    insole_pace_t pace = PACE;
    ASSERT_UNCHANGED(pace, insole_pace_of_step(NULL, 0, &pace), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_pace_of_step(&step, 0, NULL), INSOLE_ERR_NULL);
    for (int i = 0; i < 4; i++) {
        step = good;
        ASSERT_UNCHANGED(pace, insole_pace_of_step(&step, bad[i], &pace), INSOLE_ERR_VALUE);
        step.length_m = bad[i];
        ASSERT_UNCHANGED(pace, insole_pace_of_step(&step, 0, &pace), INSOLE_ERR_VALUE);
        step = good;
        step.attitude_cov_rad2.zz = bad[i];
        ASSERT_UNCHANGED(pace, insole_pace_of_step(&step, 0, &pace), INSOLE_ERR_VALUE);
        step = good;
        step.attitude.w = i == 3 ? 0 : bad[i];
        ASSERT_UNCHANGED(pace, insole_pace_of_step(&step, 0, &pace), INSOLE_ERR_VALUE);
    }
    step = good;
    ck_assert_int_eq(insole_pace_of_step(&step, 0, &pace), INSOLE_OK);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("step_news");
    suite_add(suite, "paces", paces_are_checked);
    suite_add(suite, "fixes", fixes_are_checked);
    suite_add(suite, "starts", starts_are_checked);
    suite_add(suite, "way", a_way_is_length_and_direction);
    suite_add(suite, "step", a_step_becomes_a_pace_with_the_variance_of_its_attitude);
    suite_add(suite, "refused", what_is_no_step_is_no_pace);
    return suite;
}
