/* SPDX-License-Identifier: MIT
 * Does the covariance move as the mechanisation does? */
#include <string.h>

#include "foot_filter.h"
#include "near.h"
#include "suite.h"

static const double EPS = (double)INSOLE_REAL_EPSILON;
enum { TRIES = 50, BLOCK = 8, NINE = 9 };

/* ---- a filter in the middle of a swing -------------------------------------------------- */

/* Samples that are means, and strong ones. */
static insole_zupt_ekf_t any_filter(insole_rng_t *rng)
{
    insole_zupt_ekf_t ekf = filter_swinging(rng);
    ekf.config.point_share = INSOLE_R(0.0);
    memset(&ekf.noise, 0, sizeof ekf.noise);
    ekf.last_accel_mps2 = sample_vec3(rng, INSOLE_R(12.0));
    ekf.last_gyro_radps = sample_vec3(rng, INSOLE_R(5.0));
    return ekf;
}

static insole_imu_t any_reading(insole_rng_t *rng, const insole_zupt_ekf_t *ekf, uint32_t step_us)
{
    insole_imu_t imu;
    imu.t_us = ekf->t_us + step_us;
    imu.accel_mps2 = insole_vec3_add(ekf->last_accel_mps2, sample_vec3(rng, INSOLE_R(5.0)));
    imu.gyro_radps = insole_vec3_add(ekf->last_gyro_radps, sample_vec3(rng, INSOLE_R(1.0)));
    return imu;
}

/* ---- finite differences ----------------------------------------------------------------- */

static const double PERTURBATION[4] = {0.25, 0.25, 0.01, 0.25};

/* The true state as the filter would have it: x plus an error of `size` in state `which`. A bias
 * that is wrong now was wrong in the sample before. */
static insole_zupt_ekf_t perturbed(const insole_zupt_ekf_t *ekf, int which, double size)
{
    insole_zupt_ekf_t other = *ekf;
    column_t x = {{0.0}};
    x.at[which] = size;
    other.p_m = insole_vec3_add(ekf->p_m, column_part(&x, DENSE_P));
    other.v_mps = insole_vec3_add(ekf->v_mps, column_part(&x, DENSE_V));
    insole_quat_t turn = insole_quat_from_rotvec(column_part(&x, DENSE_A));
    other.q = insole_quat_normalize(insole_quat_mul(turn, ekf->q));
    other.accel_bias_mps2 = insole_vec3_add(ekf->accel_bias_mps2, column_part(&x, DENSE_B));
    other.last_accel_mps2 = insole_vec3_sub(ekf->last_accel_mps2, column_part(&x, DENSE_B));
    return other;
}

static column_t difference(const insole_zupt_ekf_t *from, const insole_zupt_ekf_t *to)
{
    column_t x;
    column_put(&x, DENSE_P, insole_vec3_sub(to->p_m, from->p_m));
    column_put(&x, DENSE_V, insole_vec3_sub(to->v_mps, from->v_mps));
    column_put(&x, DENSE_A,
               real_of(turn_between(d33_of(insole_quat_to_mat3(from->q)),
                                    d33_of(insole_quat_to_mat3(to->q)))));
    column_put(&x, DENSE_B, insole_vec3_sub(to->accel_bias_mps2, from->accel_bias_mps2));
    return x;
}

static dense_t phi_by_differences(const insole_zupt_ekf_t *ekf, const insole_imu_t *imu)
{
    dense_t phi;
    for (int j = 0; j < DENSE; j++) {
        double size = PERTURBATION[j / 3];
        insole_zupt_ekf_t plus = perturbed(ekf, j, size), minus = perturbed(ekf, j, -size);
        (void)insole_zupt_ekf_predict(&plus, imu, 0u);
        (void)insole_zupt_ekf_predict(&minus, imu, 0u);
        column_t x = difference(&minus, &plus);
        for (int i = 0; i < DENSE; i++) {
            phi.at[i][j] = x.at[i] / (2.0 * size);
        }
    }
    return phi;
}

/* What Phi leaves out: the turn within the interval in the effect of the bias. */
static double left_out(int i, int j, double dt)
{
    const double rate = 10.0;
    double of_velocity = i < DENSE_A && j >= DENSE_B ? 0.6 * dt * dt * rate : 0.0;
    return i < DENSE_V ? 0.5 * dt * of_velocity : of_velocity;
}

START_TEST(phi_is_the_derivative_of_the_mechanisation)
{
    static const uint32_t step_us[3] = {100000u, 20000u, 5000u};
    const double dt = 1.0e-6 * step_us[_i];
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t off = {0.0, 0.0};
    for (int n = 0; n < TRIES; n++) {
        insole_zupt_ekf_t ekf = any_filter(&rng);
        insole_imu_t imu = any_reading(&rng, &ekf, step_us[_i]);
        dense_t numeric = phi_by_differences(&ekf, &imu);
        ck_assert_int_eq(insole_zupt_ekf_predict(&ekf, &imu, 0u), INSOLE_OK);
        insole_vec3_t u = insole_vec3_scale(ekf.force_mps2, ekf.dt_s);
        dense_t phi = dense_phi(u, insole_quat_to_mat3(ekf.q), ekf.dt_s);
        for (int i = 0; i < DENSE * DENSE; i++) {
            int row = i / DENSE, column = i % DENSE;
            double rounding = 4.0 * EPS / PERTURBATION[column / 3];
            bool is_turn = column >= DENSE_A && column < DENSE_B; /* sin(0.01) / 0.01 */
            double curved = is_turn ? 1.7e-5 * d3_norm(d3_of(u)) : 0.0;
            double apart = fabs(numeric.at[row][column] - phi.at[row][column]);
            worst_note(&off, apart - left_out(row, column, dt) - rounding - curved, i);
        }
    }
    ASSERT_WORST(off, 0.0, "(beyond what Phi leaves out)");
}
END_TEST

/* ---- the covariance step ---------------------------------------------------------------- */

START_TEST(moves_the_covariance_by_phi)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t exact = {0.0, 0.0}, numeric = {0.0, 0.0};
    for (int n = 0; n < TRIES; n++) {
        insole_zupt_ekf_t ekf = any_filter(&rng);
        insole_imu_t imu = any_reading(&rng, &ekf, 5000u);
        dense_t before = dense_of(&ekf.P), differences = phi_by_differences(&ekf, &imu);
        ck_assert_int_eq(insole_zupt_ekf_predict(&ekf, &imu, 0u), INSOLE_OK);
        ck_assert_int_eq(insole_zupt_ekf_settle(&ekf), INSOLE_OK);
        dense_t got = dense_of(&ekf.P); /* the noise still waits */
        dense_t phi = dense_phi(insole_vec3_scale(ekf.force_mps2, ekf.dt_s),
                                insole_quat_to_mat3(ekf.q), ekf.dt_s);
        dense_t by_phi = dense_congruent(&phi, &before);
        dense_t by_differences = dense_congruent(&differences, &before);
        worst_note(&exact, dense_off(&got, &by_phi, &by_phi), n);
        worst_note(&numeric, dense_off(&got, &by_differences, &by_phi), n);
    }
    ASSERT_WORST(exact, 10.0 * EPS, "(of the 1-sigmas)");
    ASSERT_WORST(numeric, 1.0e-3 + 1000.0 * EPS, "(of the 1-sigmas)");
}
END_TEST

/* Up to seven samples of 5 ms at once are as good as one after the other: to rounding for nine
 * states. With the bias Phi leaves out how the sensor turns under it meanwhile, a twelfth of 17
 * rad/s (35 ms)^3: 0.06 mm per m/s^2. */
START_TEST(moves_the_covariance_by_several_samples)
{
    const bool has_bias = _i == 1;
    const double left_out_m = has_bias ? 6.1e-5 : 0.0;
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    worst_t off = {0.0, 0.0};
    for (int n = 0; n < TRIES; n++) {
        insole_zupt_ekf_t ekf = any_filter(&rng);
        if (!has_bias) {
            ekf.config.sigma_accel_bias_mps2 = INSOLE_R(0.0);
            ekf.P.bb = insole_sym3_zero();
            ekf.P.pb = ekf.P.vb = ekf.P.ab = insole_mat3_zero();
        }
        dense_t expected = dense_of(&ekf.P);
        for (int k = 0; k < 1 + n % (BLOCK - 1); k++) {
            insole_imu_t imu = any_reading(&rng, &ekf, 5000u);
            ck_assert_int_eq(insole_zupt_ekf_predict(&ekf, &imu, 0u), INSOLE_OK);
            dense_t phi = dense_phi(insole_vec3_scale(ekf.force_mps2, ekf.dt_s),
                                    insole_quat_to_mat3(ekf.q), ekf.dt_s);
            expected = dense_congruent(&phi, &expected);
        }
        ck_assert_int_eq(insole_zupt_ekf_settle(&ekf), INSOLE_OK);
        dense_t got = dense_of(&ekf.P);
        double bias = sqrt(expected.at[DENSE_B][DENSE_B] + expected.at[DENSE_B + 1][DENSE_B + 1] +
                           expected.at[DENSE_B + 2][DENSE_B + 2]);
        double place = sqrt(fmin(expected.at[0][0], fmin(expected.at[1][1], expected.at[2][2])));
        double allowed = 20.0 * EPS + 2.0 * left_out_m * bias / place;
        worst_note(&off, dense_off(&got, &expected, &expected) / allowed, n);
    }
    ASSERT_WORST(off, 1.0, "(of what it may be)");
}
END_TEST

static insole_status_t reader(int which, insole_zupt_ekf_t *ekf)
{
    switch (which) {
    case 0:
        return insole_zupt_ekf_align(ekf, FILTER_UP, INSOLE_R(0.02), INSOLE_R(0.3), ekf->t_us);
    case 1:
        return insole_zupt_ekf_correct_height(ekf, INSOLE_R(0.1), INSOLE_R(0.01));
    case 2:
        return insole_zupt_ekf_coast(ekf, FILTER_UP, INSOLE_R(0.5), ekf->t_us + 100000u);
    default:
        return insole_zupt_ekf_correct(ekf, ekf->dt_s, NULL);
    }
}

/* What reads the covariance brings it up to now first. */
START_TEST(settles_before_all_that_needs_it)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    insole_zupt_ekf_t late = any_filter(&rng);
    for (int k = 0; k < 3; k++) {
        insole_imu_t imu = any_reading(&rng, &late, 5000u);
        ck_assert_int_eq(insole_zupt_ekf_predict(&late, &imu, 0u), INSOLE_OK);
    }
    insole_zupt_ekf_t settled = late;
    ck_assert_int_eq(insole_zupt_ekf_settle(&settled), INSOLE_OK);
    ck_assert(memcmp(&settled.P, &late.P, sizeof late.P) != 0);
    ck_assert_int_eq(reader(_i, &late), INSOLE_OK);
    ck_assert_int_eq(reader(_i, &settled), INSOLE_OK);
    ck_assert(memcmp(&late, &settled, sizeof late) == 0);
    settled = late;
    ck_assert_int_eq(insole_zupt_ekf_settle(&late), INSOLE_OK); /* nothing is left to do */
    ck_assert(memcmp(&late, &settled, sizeof late) == 0);
    ck_assert_int_eq(insole_zupt_ekf_settle(NULL), INSOLE_ERR_NULL);
}
END_TEST

/* ---- noise ------------------------------------------------------------------------------ */

static double clip_part(const insole_zupt_ekf_t *ekf, uint32_t clipped, int i, int j)
{
    d33_t C = d33_of(insole_quat_to_mat3(ekf->q));
    const double rows[3][3] = {
        {C.r0.x, C.r0.y, C.r0.z}, {C.r1.x, C.r1.y, C.r1.z}, {C.r2.x, C.r2.y, C.r2.z}};
    double sum = 0.0;
    for (int m = 0; m < 3; m++) {
        sum += (clipped >> m & 1u) != 0u ? rows[i][m] * rows[j][m] : 0.0;
    }
    return sum;
}

/* Turn rates that must be told apart: after a block of samples the covariance has grown by Q, the
 * sum of what each sample brought, not before; only what clipping brings is there at once. */
START_TEST(adds_noise_in_blocks)
{
    const uint32_t clipped = (uint32_t)_i;
    const insole_zupt_ekf_config_t *c = &insole_zupt_ekf_defaults;
    const double dt = 0.005, a = (double)c->accel_noise_mps_rts;
    const double g = (double)c->gyro_noise_rad_rts, turning = (double)c->gyro_turn_noise_rts;
    const double clip = (double)c->clip_noise_rad_rts, walk = (double)c->accel_bias_walk_mps2_rts;
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    insole_zupt_ekf_t ekf = any_filter(&rng);
    memset(&ekf.P, 0, sizeof ekf.P);
    memset(&ekf.pending, 0, sizeof ekf.pending);
    dense_t Q = dense_diagonal(0.0), expected = dense_diagonal(0.0);
    for (int n = 0; n < BLOCK; n++) {
        ck_assert(clipped != 0u || ekf.P.vv.xx == INSOLE_R(0.0));
        ck_assert_uint_eq(ekf.noise.samples, (uint32_t)n);
        insole_imu_t imu = {ekf.t_us + 5000u, ekf.last_accel_mps2,
                            sample_vec3(&rng, INSOLE_R(9.0))};
        ck_assert_int_eq(insole_zupt_ekf_predict(&ekf, &imu, clipped), INSOLE_OK);
        insole_vec3_t u = insole_vec3_scale(ekf.force_mps2, ekf.dt_s);
        dense_t phi = dense_phi(u, insole_quat_to_mat3(ekf.q), ekf.dt_s);
        double w = d3_norm(d3_of(imu.gyro_radps));
        expected = dense_congruent(&phi, &expected);
        for (int i = 0; i < 3; i++) {
            Q.at[DENSE_V + i][DENSE_V + i] += a * a * dt;
            Q.at[DENSE_A + i][DENSE_A + i] += dt * (g * g + turning * turning * w * w);
            Q.at[DENSE_B + i][DENSE_B + i] += walk * walk * dt;
            for (int j = 0; j < 3; j++) {
                expected.at[DENSE_A + i][DENSE_A + j] +=
                    dt * clip * clip * clip_part(&ekf, clipped, i, j);
            }
        }
    }
    ck_assert_uint_eq(ekf.noise.samples, 0u);
    expected = dense_add(expected, 1.0, &Q);
    dense_t P = dense_of(&ekf.P);
    ASSERT_AT_MOST(dense_off(&P, &expected, &expected), 20.0 * EPS, "(of the 1-sigmas)");
}
END_TEST

/* ---- a walk ----------------------------------------------------------------------------- */

enum { RATE_HZ = 200, STRIDE = RATE_HZ, REST = 2 * RATE_HZ };

/* One stride of readings: a walk that turns evenly repeats them in b. */
static insole_imu_t stride_samples[STRIDE];
static bool stride_still[STRIDE];

static void fill_stride(void)
{
    gait_t gait = gait_usual();
    for (int k = 0; k < STRIDE; k++) {
        double begin = gait.rest_s + (double)k / RATE_HZ, end = begin + 1.0 / RATE_HZ;
        d3_t force, rate;
        gait_reading(&gait, begin, end, &force, &rate);
        stride_samples[k].accel_mps2 = real_of(force);
        stride_samples[k].gyro_radps = real_of(rate);
        stride_still[k] = gait_is_still(&gait, begin, end);
    }
}

static insole_zupt_ekf_config_t quiet_config(void)
{
    insole_zupt_ekf_config_t config = insole_zupt_ekf_defaults;
    config.point_share = INSOLE_R(0.0);
    return config;
}

static insole_zupt_ekf_t standing_filter(double sigma_bias)
{
    insole_zupt_ekf_t ekf;
    insole_zupt_ekf_config_t config = quiet_config();
    config.sigma_accel_bias_mps2 = (insole_real_t)sigma_bias;
    gait_t gait = gait_usual();
    moment_t m = gait_moment(&gait, 0.0);
    motion_put(&ekf, &config, &m, 1000000u);
    return ekf;
}

/* One sample of the walk, its corrections, and the level floor at the end of each stance. */
static void walk(insole_zupt_ekf_t *ekf, uint32_t k)
{
    uint32_t in_stride = k < REST ? STRIDE - 1u : k % STRIDE;
    insole_imu_t imu = stride_samples[in_stride];
    imu.t_us = ekf->t_us + 1000000u / RATE_HZ;
    (void)insole_zupt_ekf_predict(ekf, &imu, in_stride == 60u ? 2u : 0u);
    if (stride_still[in_stride]) {
        (void)insole_zupt_ekf_correct(ekf, ekf->dt_s, NULL);
    } else if (in_stride == 0u) {
        (void)insole_zupt_ekf_correct_height(ekf, INSOLE_R(0.0), INSOLE_R(0.01));
    }
}

/* The same without bias states and with a bias that is known to be zero and to stay so. */
START_TEST(nine_states_are_twelve_with_a_known_bias)
{
    fill_stride();
    insole_zupt_ekf_t nine = standing_filter(0.0), twelve = standing_filter(0.05);
    worst_t off = {0.0, 0.0};
    twelve.P.bb = insole_sym3_zero();
    twelve.config.accel_bias_walk_mps2_rts = INSOLE_R(0.0);
    for (uint32_t k = 0u; k < 20u * RATE_HZ; k++) {
        walk(&nine, k);
        walk(&twelve, k);
        worst_require(&off, nine.p_m.x == twelve.p_m.x && nine.p_m.y == twelve.p_m.y, k);
        worst_require(&off, nine.p_m.z == twelve.p_m.z && nine.q.w == twelve.q.w, k);
    }
    ASSERT_ALL_HELD(off);
    ck_assert_uint_eq(nine.refused + twelve.refused, 0u);
    dense_t a = dense_of(&nine.P), b = dense_of(&twelve.P);
    for (int i = 0; i < DENSE * DENSE; i++) {
        worst_require(&off, a.at[i / DENSE][i % DENSE] == b.at[i / DENSE][i % DENSE], i);
    }
    ASSERT_ALL_HELD(off);
    ck_assert(a.at[DENSE_A][DENSE_V] != 0.0 && a.at[DENSE_B][DENSE_B] == 0.0);
}
END_TEST

/* An hour and a half of walking. */
START_TEST(stays_positive_over_a_million_samples)
{
    const int n = _i == 0 ? NINE : DENSE;
    fill_stride();
    insole_zupt_ekf_t ekf = standing_filter(n == NINE ? 0.0 : 0.05);
    worst_t below = {0.0, 0.0}, variance = {0.0, 0.0};
    for (uint32_t k = 1u; k <= 1000000u; k++) {
        walk(&ekf, k);
        if (k % 9973u == 0u || (k < 2000u && k % 40u == 0u)) {
            dense_t P = dense_of(&ekf.P), c = dense_correlation(&P, n);
            for (int i = 0; i < n; i++) {
                worst_require(&variance, P.at[i][i] >= 0.0, k);
            }
            worst_note(&below, -dense_least_eigenvalue(c, n), k);
        }
    }
    ck_assert_uint_eq(ekf.refused, 0u);
    ASSERT_ALL_HELD(variance);
    ASSERT_WORST(below, 2.0 * EPS, "(below zero, of a correlation)");
    ck_assert(insole_vec3_is_finite(ekf.p_m) && insole_vec3_is_finite(ekf.v_mps));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zupt_ekf phi");
    suite_add_loop(suite, "Phi by differences", phi_is_the_derivative_of_the_mechanisation, 3);
    suite_add(suite, "Phi P Phi'", moves_the_covariance_by_phi);
    suite_add_loop(suite, "several samples at once", moves_the_covariance_by_several_samples, 2);
    suite_add_loop(suite, "settling", settles_before_all_that_needs_it, 4);
    suite_add_loop(suite, "noise in blocks", adds_noise_in_blocks, 8);
    suite_add(suite, "nine of twelve states", nine_states_are_twelve_with_a_known_bias);
    suite_add_loop(suite, "a million samples", stays_positive_over_a_million_samples, 2);
    return suite;
}
