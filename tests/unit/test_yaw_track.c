/* SPDX-License-Identifier: MIT */
#include "insole/move/yaw_track.h"

#include "motion.h"
#include "near.h"
#include "phone.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define EPS ((double)INSOLE_REAL_EPSILON)

static insole_yaw_track_t yaw;

static void begin(double tipped_rad)
{
    ck_assert_int_eq(insole_yaw_track_init(&yaw, (insole_real_t)tipped_rad), INSOLE_OK);
}

static double off_by(double a, double b)
{
    return fabs(remainder(a - b, 2.0 * PI));
}

static d33_t any_mounting(insole_rng_t *rng)
{
    return d33_of(insole_quat_to_mat3(sample_quat(rng)));
}

/* A turn about the vertical alone is followed exactly, over many rounds, in any mounting. */
START_TEST(a_turn_is_followed_in_any_mounting)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 200; i++) {
        d33_t mounting = any_mounting(&rng);
        double rate = 4.0 * (double)insole_rng_uniform(&rng) - 2.0;
        begin(0.9);
        for (int k = 0; k < 500; k++) {
            d33_t R = d33_mul(turn_z(rate * 0.02 * k), mounting);
            bool tipped = insole_yaw_track_push(&yaw, quat_of(R), (uint64_t)k * 20000u);
            ck_assert_int_eq(tipped, k == 0);
            worst_note(&off, off_by((double)yaw.turned_rad, rate * 0.02 * k), i);
        }
        ck_assert_uint_eq(yaw.laid, 1u);
    }
    ASSERT_WORST(off, 30.0 * EPS, "rad");
}
END_TEST

/* A swing about a level axis, 20 degrees to each side, is no turn, wherever the edges of the phone
 * point: where one of them stands upright its own heading would jump. */
START_TEST(a_swing_is_no_turn)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 200; i++) {
        d33_t mounting = any_mounting(&rng);
        double axis = 6.0 * (double)insole_rng_uniform(&rng);
        begin(0.9);
        for (int k = 0; k < 300; k++) {
            double swing = 0.35 * sin(6.0 * 0.02 * k);
            d33_t R = d33_exp(d3(swing * cos(axis), swing * sin(axis), 0.0));
            (void)insole_yaw_track_push(&yaw, quat_of(d33_mul(R, mounting)), (uint64_t)k * 20000u);
            worst_note(&off, fabs((double)yaw.turned_rad), i);
        }
        ck_assert_uint_eq(yaw.laid, 1u);
    }
    ASSERT_WORST(off, 0.04, "rad"); /* 0.35^2 / 4 */
}
END_TEST

/* Laid on its side within four seconds: another axis is chosen once, and the turn does not jump. */
START_TEST(a_phone_tipped_over_goes_on)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    for (int i = 0; i < 50; i++) {
        d33_t mounting = any_mounting(&rng);
        int tipped = 0;
        double before = 0.0;
        worst_t jump = {0.0, 0.0};
        begin(0.9);
        for (int k = 0; k < 500; k++) {
            double over = 0.5 * PI * fmin(1.0, fmax(0.0, 0.005 * k - 0.5));
            d33_t R = d33_mul(turn_x(over), mounting);
            tipped += insole_yaw_track_push(&yaw, quat_of(R), (uint64_t)k * 20000u);
            worst_note(&jump, off_by((double)yaw.turned_rad, before), k);
            before = (double)yaw.turned_rad;
        }
        ck_assert_int_eq(tipped, 2);
        ck_assert_uint_eq(yaw.laid, 2u);
        ASSERT_NEAR(insole_vec3_dot(yaw.axis, yaw.lay), 0.0, 4.0 * EPS, "");
        ASSERT_NEAR(insole_vec3_norm(yaw.axis), 1.0, 4.0 * EPS, "");
        ASSERT_WORST(jump, 0.03, "rad"); /* of 0.008 rad a sample, where the axis is steep */
    }
}
END_TEST

/* 3.2: nothing tips it; 0.1: a little does. After an hour without samples the lie is the mean of
 * the old and the new one. */
START_TEST(the_limit_is_the_callers)
{
    const double limits[] = {0.1, 0.9, 3.2};
    for (int i = 0; i < 3; i++) {
        int tipped = 0;
        begin(limits[i]);
        for (int k = 0; k < 400; k++) {
            double over = k < 100 ? 0.0 : 0.8 * PI;
            tipped += insole_yaw_track_push(&yaw, quat_of(turn_y(over)), (uint64_t)k * 20000u);
        }
        ck_assert_int_eq(tipped > 1, i < 2);
    }
    begin(3.2);
    (void)insole_yaw_track_push(&yaw, insole_quat_identity(), 0u);
    (void)insole_yaw_track_push(&yaw, quat_of(turn_x(-1.0)), 3600000000u);
    ASSERT_NEAR(insole_abs(insole_atan2(yaw.up.y, yaw.up.z)), 0.5, 4.0 * EPS, "rad");
}
END_TEST

START_TEST(bad_limits_are_refused)
{
    const insole_real_t odd[] = {(insole_real_t)NAN, (insole_real_t)INFINITY, INSOLE_R(0.09),
                                 INSOLE_R(3.3), -1};
    begin(0.9);
    (void)insole_yaw_track_push(&yaw, insole_quat_identity(), 5u);
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++) {
        ASSERT_UNCHANGED(yaw, insole_yaw_track_init(&yaw, odd[i]), INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_yaw_track_init(NULL, 1), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("yaw_track");
    suite_add(suite, "turn", a_turn_is_followed_in_any_mounting);
    suite_add(suite, "swing", a_swing_is_no_turn);
    suite_add(suite, "tipped", a_phone_tipped_over_goes_on);
    suite_add(suite, "limit", the_limit_is_the_callers);
    suite_add(suite, "arguments", bad_limits_are_refused);
    return suite;
}
