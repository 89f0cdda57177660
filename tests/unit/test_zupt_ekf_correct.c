/* SPDX-License-Identifier: MIT
 * Corrections by a still foot and by a known height. */
#include "insole/move/zupt_ekf.h"

#include <string.h>

#include "foot_filter.h"
#include "near.h"
#include "suite.h"

static const double EPS = (double)INSOLE_REAL_EPSILON;
static const double PI = 3.141592653589793;
enum { TRIES = 50 };

static insole_status_t predict_with(insole_zupt_ekf_t *ekf, double accel, double gyro, int64_t us)
{
    insole_imu_t imu = {ekf->t_us + (uint64_t)us, FILTER_UP, {0, 0, 0}};
    imu.accel_mps2.y = (insole_real_t)accel;
    imu.gyro_radps.z = (insole_real_t)gyro;
    return insole_zupt_ekf_predict(ekf, &imu, 0u);
}

static insole_status_t height_with(insole_zupt_ekf_t *ekf, double height, double sigma)
{
    return insole_zupt_ekf_correct_height(ekf, (insole_real_t)height, (insole_real_t)sigma);
}

/* ---- corrections ------------------------------------------------------------------------ */

/* (31) as it is printed: (2 I + Omega) (2 I - Omega)^-1. */
static d33_t cayley(d3_t a)
{
    dense_t plus = dense_diagonal(2.0), minus = dense_diagonal(2.0);
    const double skew[3][3] = {{0.0, -a.z, a.y}, {a.z, 0.0, -a.x}, {-a.y, a.x, 0.0}};
    for (int i = 0; i < 9; i++) {
        plus.at[i / 3][i % 3] += skew[i / 3][i % 3];
        minus.at[i / 3][i % 3] -= skew[i / 3][i % 3];
    }
    minus = dense_inverse(minus);
    plus = dense_mul(&plus, &minus);
    d33_t R = {d3(plus.at[0][0], plus.at[0][1], plus.at[0][2]),
               d3(plus.at[1][0], plus.at[1][1], plus.at[1][2]),
               d3(plus.at[2][0], plus.at[2][1], plus.at[2][2])};
    return R;
}

static double rotation_off(d33_t a, d33_t b)
{
    return d3_norm(d3_add(a.r0, -1.0, b.r0)) + d3_norm(d3_add(a.r1, -1.0, b.r1)) +
           d3_norm(d3_add(a.r2, -1.0, b.r2));
}

/* Each part of the state moved by its part of K z, attitude by (31). */
static double state_off(const insole_zupt_ekf_t *before, const insole_zupt_ekf_t *after,
                        const column_t *dx)
{
    d3_t p = d3_add(d3_of(before->p_m), 1.0, d3(dx->at[0], dx->at[1], dx->at[2]));
    d3_t v = d3_add(d3_of(before->v_mps), 1.0, d3(dx->at[3], dx->at[4], dx->at[5]));
    d3_t b = d3_add(d3_of(before->accel_bias_mps2), 1.0, d3(dx->at[9], dx->at[10], dx->at[11]));
    d33_t C = d33_mul(cayley(d3(dx->at[6], dx->at[7], dx->at[8])),
                      d33_of(insole_quat_to_mat3(before->q)));
    return d3_norm(d3_add(p, -1.0, d3_of(after->p_m))) +
           d3_norm(d3_add(v, -1.0, d3_of(after->v_mps))) +
           d3_norm(d3_add(b, -1.0, d3_of(after->accel_bias_mps2))) +
           rotation_off(C, d33_of(insole_quat_to_mat3(after->q)));
}

/* Of a correction over 5 ms. */
static double stance_variance(void)
{
    double sigma = (double)insole_zupt_ekf_defaults.sigma_zupt_mps;
    return sigma * sigma;
}

START_TEST(corrects_the_state_like_the_full_matrices)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    worst_t state = {0.0, 0.0}, covariance = {0.0, 0.0}, chi2 = {0.0, 0.0};
    const double r = stance_variance();
    for (int i = 0; i < TRIES; i++) {
        insole_zupt_ekf_t ekf = filter_swinging(&rng);
        insole_zupt_ekf_t before = ekf;
        insole_real_t nis;
        dense_t K, P = dense_of(&ekf.P), expected = dense_joseph(&P, DENSE_V, 3, r, &K);
        ck_assert_int_eq(insole_zupt_ekf_correct(&ekf, ekf.dt_s, &nis), INSOLE_OK);
        d3_t w = d33_apply(d33_of(insole_quat_to_mat3(before.q)), d3_of(before.last_gyro_radps));
        d3_t z = d3_add(d3(0.09 * w.y, -0.09 * w.x, 0.0), -1.0, d3_of(before.v_mps));
        column_t innovation = {{z.x, z.y, z.z}}, at_v = {{0.0, 0.0, 0.0, z.x, z.y, z.z}};
        column_t dx = dense_apply(&K, &innovation);
        dense_t got = dense_of(&ekf.P), S = dense_diagonal(r);
        S = dense_add(S, 1.0, &P);
        double expected_nis = dense_mahalanobis(&S, &at_v, DENSE_V, 3);
        worst_note(&state, state_off(&before, &ekf, &dx), i);
        worst_note(&covariance, dense_off(&got, &expected, &P), i);
        worst_note(&chi2, fabs((double)nis / expected_nis - 1.0), i);
        ck_assert(ekf.trace.velocity_var_m2ps2 > 0 && ekf.trace.height_var_m2 == 0);
    }
    ASSERT_WORST(state, 40.0 * EPS, "m, m/s, rad and m/s^2 together");
    ASSERT_WORST(covariance, 10.0 * EPS, "(of the 1-sigmas)");
    ASSERT_WORST(chi2, 1000.0 * EPS, "(relative)");
}
END_TEST

START_TEST(corrects_the_height_like_the_full_matrices)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    worst_t state = {0.0, 0.0}, covariance = {0.0, 0.0};
    for (int i = 0; i < TRIES; i++) {
        insole_zupt_ekf_t ekf = filter_swinging(&rng);
        insole_zupt_ekf_t before = ekf;
        double told = 0.3;
        dense_t K, P = dense_of(&ekf.P), expected = dense_joseph(&P, DENSE_P + 2, 1, 1.0e-4, &K);
        ck_assert_int_eq(height_with(&ekf, told, 0.01), INSOLE_OK);
        column_t innovation = {{told - (double)before.p_m.z}};
        column_t dx = dense_apply(&K, &innovation);
        dense_t got = dense_of(&ekf.P);
        worst_note(&state, state_off(&before, &ekf, &dx), i);
        worst_note(&covariance, dense_off(&got, &expected, &P), i);
        ASSERT_NEAR(ekf.trace.height_m, told, EPS, "m");
        ASSERT_NEAR(ekf.trace.height_var_m2, 1.0e-4, EPS, "m^2");
    }
    ASSERT_WORST(state, 40.0 * EPS, "m, m/s, rad and m/s^2 together");
    ASSERT_WORST(covariance, 10.0 * EPS, "(of the 1-sigmas)");
}
END_TEST

/* sigma_zupt_mps is meant for 5 ms: a second of stance tells the same at every rate. */
START_TEST(weighs_a_correction_by_its_interval)
{
    for (int64_t us = 1250; us <= 20000; us *= 2) {
        insole_zupt_ekf_t ekf = filter_aligned();
        ck_assert_int_eq(predict_with(&ekf, 0.0, 0.0, us), INSOLE_OK);
        ck_assert_int_eq(insole_zupt_ekf_correct(&ekf, ekf.dt_s, NULL), INSOLE_OK);
        ASSERT_NEAR((double)ekf.trace.velocity_var_m2ps2 * (double)us /
                        (stance_variance() * 5000.0),
                    1.0, 10.0 * EPS, "");
    }
}
END_TEST

/* One correction that speaks for four intervals is as sure as four. */
START_TEST(weighs_a_correction_by_what_it_speaks_for)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 6u);
    for (int i = 0; i < TRIES; i++) {
        insole_zupt_ekf_t ekf = filter_swinging(&rng);
        const double r = stance_variance() / 4.0;
        dense_t K, P = dense_of(&ekf.P), expected = dense_joseph(&P, DENSE_V, 3, r, &K);
        insole_real_t still_s = INSOLE_R(4.0) * ekf.dt_s;
        ck_assert_int_eq(insole_zupt_ekf_correct(&ekf, still_s, NULL), INSOLE_OK);
        dense_t got = dense_of(&ekf.P);
        ASSERT_AT_MOST(dense_off(&got, &expected, &P), 10.0 * EPS, "(of the 1-sigmas)");
    }
}
END_TEST

START_TEST(refuses_a_stance_of_no_time)
{
    const insole_real_t bad[] = {INSOLE_R(0.0), INSOLE_R(-0.005), INSOLE_R(1.01),
                                 (insole_real_t)NAN, (insole_real_t)INFINITY};
    insole_rng_t rng;
    insole_rng_seed(&rng, 7u);
    insole_zupt_ekf_t ekf = filter_swinging(&rng);
    ck_assert_int_eq(filter_feel(&ekf, FILTER_UP, insole_vec3_zero()), INSOLE_OK);
    for (size_t i = 0u; i < sizeof bad / sizeof bad[0]; i++) {
        insole_zupt_ekf_t before = ekf;
        ck_assert_int_eq(insole_zupt_ekf_correct(&ekf, bad[i], NULL), INSOLE_ERR_VALUE);
        before.refused++;
        ck_assert(memcmp(&ekf, &before, sizeof ekf) == 0);
    }
    ck_assert_int_eq(insole_zupt_ekf_correct(&ekf, INSOLE_R(1.0), NULL), INSOLE_OK);
}
END_TEST

/* A sensor on the axle of a wheel of the roll height never stands still, and is never wrong. */
START_TEST(rolls_with_the_foot)
{
    insole_zupt_ekf_t ekf = filter_aligned(), stiff = filter_aligned();
    stiff.config.roll_height_m = 0;
    const double h = 0.09, dt = 1.0e-6 * FILTER_STEP_US;
    double angle = 0.0;
    for (int k = 1; k <= 200; k++) { /* pitch forward: from 0 to 1 rad in a second */
        double before = sin(0.5 * PI * (k - 1) * dt), now = sin(0.5 * PI * k * dt);
        double rate = (now * now - before * before) / dt, half = before * before + 0.5 * rate * dt;
        double accel = 0.0;
        angle = now * now;
        accel = h * 0.5 * PI * PI * cos(PI * (k - 0.5) * dt);
        insole_vec3_t force = real_of(d33_apply(turn_y(-half), d3(accel, 0.0, 9.81)));
        insole_vec3_t gyro = insole_vec3(0, (insole_real_t)rate, 0);
        ck_assert_int_eq(filter_feel(&ekf, force, gyro), INSOLE_OK);
        ck_assert_int_eq(insole_zupt_ekf_correct(&ekf, ekf.dt_s, NULL), INSOLE_OK);
        ck_assert_int_eq(filter_feel(&stiff, force, gyro), INSOLE_OK);
        ck_assert_int_eq(insole_zupt_ekf_correct(&stiff, stiff.dt_s, NULL), INSOLE_OK);
        ASSERT_NEAR(ekf.trace.velocity_mps.x, h * rate, 1.0e-4, "m/s");
    }
    ASSERT_NEAR(ekf.p_m.x, h * angle, 0.002, "m");
    ASSERT_NEAR(
        atan2((double)insole_quat_to_mat3(ekf.q).r1.x, (double)insole_quat_to_mat3(ekf.q).r0.x),
        0.0, 1.0e-3, "rad");
    ASSERT_AT_MOST(stiff.p_m.x, 0.7 * h, "m: held back by a foot that does not roll");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zupt_ekf corrections");
    suite_add(suite, "velocity", corrects_the_state_like_the_full_matrices);
    suite_add(suite, "height", corrects_the_height_like_the_full_matrices);
    suite_add(suite, "variance and interval", weighs_a_correction_by_its_interval);
    suite_add(suite, "variance and stance", weighs_a_correction_by_what_it_speaks_for);
    suite_add(suite, "a stance of no time", refuses_a_stance_of_no_time);
    suite_add(suite, "a foot that rolls", rolls_with_the_foot);
    return suite;
}
