/* SPDX-License-Identifier: MIT
 * What each call promises. Motions, covariances and walks have suites of their own. */
#include "insole/move/zupt_ekf.h"

#include <stddef.h>
#include <string.h>

#include "foot_filter.h"
#include "insole/base/snapshot.h"
#include "near.h"
#include "suite.h"

static const double EPS = (double)INSOLE_REAL_EPSILON;
static const insole_real_t NOT_A_NUMBER = (insole_real_t)NAN;
static const insole_real_t INFINITE = (insole_real_t)HUGE_VAL;
static const double PI = 3.141592653589793;

/* ---- settings --------------------------------------------------------------------------- */

typedef struct {
    size_t offset;
    double low, high, normal;
} key_t_;

#define KEY_ROW(kind, name, value, low, high, unit, text)                                          \
    {offsetof(insole_zupt_ekf_config_t, name), low, high, value},
static const key_t_ KEYS[] = {INSOLE_ZUPT_EKF_KEYS(KEY_ROW)};
enum { KEY_COUNT = sizeof KEYS / sizeof KEYS[0] };

static insole_status_t init_with(const key_t_ *key, insole_real_t value, insole_zupt_ekf_t *ekf)
{
    insole_zupt_ekf_config_t config = insole_zupt_ekf_defaults;
    memcpy((char *)&config + key->offset, &value, sizeof value);
    return insole_zupt_ekf_init(ekf, &config);
}

START_TEST(takes_settings_in_their_range)
{
    const key_t_ *key = &KEYS[_i];
    insole_real_t low = (insole_real_t)key->low, high = (insole_real_t)key->high;
    insole_zupt_ekf_t ekf, before;
    ck_assert_int_eq(init_with(key, low, &ekf), INSOLE_OK);
    ck_assert_int_eq(init_with(key, high, &ekf), INSOLE_OK);
    before = ekf;
    const insole_real_t bad[4] = {low - INSOLE_R(0.01), high * INSOLE_R(1.001), NOT_A_NUMBER,
                                  -INFINITE};
    for (int i = 0; i < 4; i++) {
        ck_assert_int_eq(init_with(key, bad[i], &ekf), INSOLE_ERR_VALUE);
        ck_assert(memcmp(&ekf, &before, sizeof ekf) == 0);
    }
    insole_real_t normal;
    memcpy(&normal, (const char *)&insole_zupt_ekf_defaults + key->offset, sizeof normal);
    ck_assert(normal == (insole_real_t)key->normal);
}
END_TEST

START_TEST(begins_at_the_origin)
{
    insole_zupt_ekf_t ekf = filter_new();
    ck_assert(!ekf.aligned && ekf.refused == 0u);
    ck_assert(ekf.p_m.x == 0 && ekf.p_m.y == 0 && ekf.p_m.z == 0);
    ASSERT_NEAR(ekf.P.bb.yy, 0.0025, 1.0e-9, "(m/s^2)^2");
    ck_assert_int_eq(insole_zupt_ekf_init(NULL, &insole_zupt_ekf_defaults), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_ekf_init(&ekf, NULL), INSOLE_ERR_NULL);
}
END_TEST

/* ---- alignment -------------------------------------------------------------------------- */

static double heading_of_x(const insole_zupt_ekf_t *ekf)
{
    return atan2((double)insole_quat_to_mat3(ekf->q).r1.x,
                 (double)insole_quat_to_mat3(ekf->q).r0.x);
}

/* However the sensor is mounted: what it feels points up, and its x axis where it was told. */
START_TEST(aligns_in_any_mounting)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t tilt = {0.0, 0.0}, yaw = {0.0, 0.0};
    for (int i = 0; i < 500; i++) {
        insole_zupt_ekf_t ekf = filter_new();
        insole_vec3_t felt = insole_quat_rotate_back(sample_quat(&rng), FILTER_UP);
        felt = i == 0 ? insole_vec3_neg(FILTER_UP) : felt; /* upside down */
        felt = i == 1 ? insole_vec3(0, FILTER_UP.z, 0) : felt;
        insole_real_t told = sample_between(&rng, -INSOLE_PI, INSOLE_PI);
        ck_assert_int_eq(insole_zupt_ekf_align(&ekf, felt, INSOLE_R(0.02), told, 7u), INSOLE_OK);
        insole_vec3_t up = insole_mat3_mul_vec(insole_quat_to_mat3(ekf.q), felt);
        worst_note(&tilt, d3_norm(d3_add(d3_of(up), -1.0, d3_of(FILTER_UP))) / 9.81, i);
        double level =
            hypot((double)insole_quat_to_mat3(ekf.q).r0.x, (double)insole_quat_to_mat3(ekf.q).r1.x);
        worst_note(&yaw, level * fabs(remainder(heading_of_x(&ekf) - (double)told, 2.0 * PI)), i);
        ck_assert(ekf.aligned && ekf.t_us == 7u && insole_vec3_norm2(ekf.v_mps) == 0);
    }
    ASSERT_WORST(tilt, 10.0 * EPS, "rad");
    ASSERT_WORST(yaw, 10.0 * EPS, "rad");
}
END_TEST

START_TEST(knows_what_alignment_tells)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    insole_zupt_ekf_t ekf = filter_swinging(&rng);
    insole_zupt_ekf_t before = ekf;
    ck_assert_int_eq(insole_zupt_ekf_align(&ekf, FILTER_UP, INSOLE_R(0.03), INSOLE_R(1.0), 9u),
                     INSOLE_OK);
    ck_assert(memcmp(&ekf.p_m, &before.p_m, sizeof ekf.p_m) == 0);
    ck_assert(memcmp(&ekf.P.pp, &before.P.pp, sizeof ekf.P.pp) == 0);
    ck_assert(memcmp(&ekf.P.bb, &before.P.bb, sizeof ekf.P.bb) == 0);
    dense_t P = dense_of(&ekf.P);
    double expected_aa[3] = {9.0e-4, 9.0e-4, (double)before.P.aa.zz};
    for (int i = 0; i < DENSE; i++) {
        for (int j = 0; j < DENSE; j++) {
            bool kept = (i < DENSE_V && j < DENSE_V) || (i >= DENSE_B && j >= DENSE_B);
            bool is_aa = i == j && i >= DENSE_A && i < DENSE_B;
            double expected = is_aa ? expected_aa[i - DENSE_A] : 0.0;
            ck_assert(kept || fabs(P.at[i][j] - expected) < 1.0e-9);
        }
    }
    ck_assert_int_eq(ekf.trace.step, INSOLE_ZUPT_STEP_ALIGN);
}
END_TEST

/* ---- refusals --------------------------------------------------------------------------- */

static insole_status_t align_with(insole_zupt_ekf_t *ekf, double g, insole_real_t tilt,
                                  insole_real_t yaw)
{
    insole_vec3_t felt = insole_vec3_scale(FILTER_UP, (insole_real_t)g);
    return insole_zupt_ekf_align(ekf, felt, tilt, yaw, 5000000u);
}

static insole_status_t predict_with(insole_zupt_ekf_t *ekf, double accel, double gyro, int64_t us)
{
    insole_imu_t imu = {ekf->t_us + (uint64_t)us, FILTER_UP, {0, 0, 0}};
    imu.accel_mps2.y = (insole_real_t)accel;
    imu.gyro_radps.z = (insole_real_t)gyro;
    return insole_zupt_ekf_predict(ekf, &imu, 0u);
}

static insole_status_t coast_with(insole_zupt_ekf_t *ekf, double speed, double sigma, int64_t us)
{
    insole_vec3_t velocity = {0, (insole_real_t)speed, 0};
    return insole_zupt_ekf_coast(ekf, velocity, (insole_real_t)sigma, ekf->t_us + (uint64_t)us);
}

static insole_status_t height_with(insole_zupt_ekf_t *ekf, double height, double sigma)
{
    return insole_zupt_ekf_correct_height(ekf, (insole_real_t)height, (insole_real_t)sigma);
}

typedef struct {
    insole_status_t expected;
    char call; /* a: align, g and tilt; p: predict, accel and gyro; c: coast, speed and sigma;
                  h: height and sigma */
    double first, second;
    int64_t after_us;
} bad_call_t;

static const bad_call_t BAD_CALLS[] = {
    {INSOLE_ERR_VALUE, 'a', 0.0, 0.1, 0},
    {INSOLE_ERR_VALUE, 'a', 0.49, 0.1, 0},
    {INSOLE_ERR_VALUE, 'a', 2.01, 0.1, 0},
    {INSOLE_ERR_VALUE, 'a', (double)NAN, 0.1, 0},
    {INSOLE_ERR_VALUE, 'a', HUGE_VAL, 0.1, 0},
    {INSOLE_ERR_VALUE, 'a', 1.0, -0.1, 0},
    {INSOLE_ERR_VALUE, 'a', 1.0, 3.2, 0},
    {INSOLE_ERR_VALUE, 'a', 1.0, (double)NAN, 0},
    {INSOLE_ERR_VALUE, 'p', (double)NAN, 0.0, FILTER_STEP_US},
    {INSOLE_ERR_VALUE, 'p', 0.0, (double)NAN, FILTER_STEP_US},
    {INSOLE_ERR_VALUE, 'p', HUGE_VAL, 0.0, FILTER_STEP_US},
    {INSOLE_ERR_VALUE, 'p', 1.51e4, 0.0, FILTER_STEP_US},
    {INSOLE_ERR_VALUE, 'p', 0.0, -1.51e3, FILTER_STEP_US},
    {INSOLE_ERR_VALUE, 'p', 0.0, 0.0, 1000001},
    {INSOLE_ERR_TIME, 'p', 0.0, 0.0, 0},
    {INSOLE_ERR_TIME, 'p', 0.0, 0.0, -1},
    {INSOLE_ERR_VALUE, 'c', (double)NAN, 0.7, FILTER_STEP_US},
    {INSOLE_ERR_VALUE, 'c', 1001.0, 0.7, FILTER_STEP_US},
    {INSOLE_ERR_VALUE, 'c', 1.0, (double)NAN, FILTER_STEP_US},
    {INSOLE_ERR_VALUE, 'c', 1.0, -0.1, FILTER_STEP_US},
    {INSOLE_ERR_VALUE, 'c', 1.0, 1001.0, FILTER_STEP_US},
    {INSOLE_ERR_TIME, 'c', 1.0, 0.7, 0},
    {INSOLE_ERR_TIME, 'c', 1.0, 0.7, -1000},
    {INSOLE_ERR_VALUE, 'h', (double)NAN, 0.1, 0},
    {INSOLE_ERR_VALUE, 'h', -1.01e6, 0.1, 0},
    {INSOLE_ERR_VALUE, 'h', 0.0, 0.0, 0},
    {INSOLE_ERR_VALUE, 'h', 0.0, 1.01e4, 0},
    {INSOLE_ERR_VALUE, 'h', 0.0, (double)NAN, 0},
};
enum { BAD_CALL_COUNT = sizeof BAD_CALLS / sizeof BAD_CALLS[0] };

static insole_status_t make_bad_call(insole_zupt_ekf_t *ekf, const bad_call_t *bad)
{
    switch (bad->call) {
    case 'a':
        return align_with(ekf, bad->first, (insole_real_t)bad->second, INSOLE_R(0.1));
    case 'p':
        return predict_with(ekf, bad->first, bad->second, bad->after_us);
    case 'c':
        return coast_with(ekf, bad->first, bad->second, bad->after_us);
    default:
        return height_with(ekf, bad->first, bad->second);
    }
}

START_TEST(refuses_and_stays_as_it_was)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    insole_zupt_ekf_t ekf = filter_swinging(&rng), before;
    memcpy(&before, &ekf, sizeof ekf);
    ck_assert_int_eq(make_bad_call(&ekf, &BAD_CALLS[_i]), BAD_CALLS[_i].expected);
    before.refused++;
    ck_assert(memcmp(&ekf, &before, sizeof ekf) == 0);
}
END_TEST

START_TEST(refuses_a_yaw_that_is_none)
{
    insole_zupt_ekf_t ekf = filter_new();
    ck_assert_int_eq(align_with(&ekf, 1.0, INSOLE_R(0.1), NOT_A_NUMBER), INSOLE_ERR_VALUE);
    ck_assert_int_eq(align_with(&ekf, 1.0, INSOLE_R(0.1), INFINITE), INSOLE_ERR_VALUE);
    ck_assert(!ekf.aligned && ekf.refused == 2u);
}
END_TEST

START_TEST(accepts_the_ends_of_its_ranges)
{
    insole_zupt_ekf_t ekf = filter_aligned();
    ck_assert_int_eq(align_with(&ekf, 0.51, INSOLE_R(0.0), INSOLE_R(50.0)), INSOLE_OK);
    ck_assert_int_eq(align_with(&ekf, 1.99, INSOLE_R(3.14), INSOLE_R(-50.0)), INSOLE_OK);
    ck_assert_int_eq(predict_with(&ekf, 1.49e4, -1.49e3, 1000000), INSOLE_OK);
    ck_assert_int_eq(height_with(&ekf, 1.0e6, 1.1e-4), INSOLE_OK);
    ck_assert_int_eq(height_with(&ekf, -1.0e6, 1.0e4), INSOLE_OK);
    ck_assert_int_eq(coast_with(&ekf, -1.0e3, 0.0, 1), INSOLE_OK);
    ck_assert_int_eq(coast_with(&ekf, 1.0e3, 1.0e3, 86400000000), INSOLE_OK);
    ck_assert_uint_eq(ekf.refused, 0u);
}
END_TEST

START_TEST(refuses_what_comes_before_alignment)
{
    insole_zupt_ekf_t ekf = filter_new();
    insole_zupt_ekf_t before = ekf;
    ck_assert_int_eq(predict_with(&ekf, 0.0, 0.0, FILTER_STEP_US), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_zupt_ekf_correct(&ekf, ekf.dt_s, NULL), INSOLE_ERR_STATE);
    ck_assert_int_eq(height_with(&ekf, 0.0, 0.1), INSOLE_ERR_STATE);
    ck_assert_int_eq(coast_with(&ekf, 1.0, 0.7, FILTER_STEP_US), INSOLE_ERR_STATE);
    before.refused = 4u;
    ck_assert(memcmp(&ekf, &before, sizeof ekf) == 0);
    ekf = before = filter_aligned(); /* no interval yet that the variance could be of */
    ck_assert_int_eq(insole_zupt_ekf_correct(&ekf, ekf.dt_s, NULL), INSOLE_ERR_STATE);
    before.refused++;
    ck_assert(memcmp(&ekf, &before, sizeof ekf) == 0);
}
END_TEST

START_TEST(refuses_null)
{
    insole_imu_t imu = {1u, FILTER_UP, {0, 0, 0}};
    insole_zupt_ekf_t ekf = filter_aligned();
    ck_assert_int_eq(insole_zupt_ekf_align(NULL, FILTER_UP, 0, 0, 1u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_ekf_predict(NULL, &imu, 0u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_ekf_predict(&ekf, NULL, 0u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_ekf_correct(NULL, INSOLE_R(0.005), NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_ekf_correct_height(NULL, 0, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_ekf_coast(NULL, FILTER_UP, 1, 1u), INSOLE_ERR_NULL);
}
END_TEST

/* ---- coasting --------------------------------------------------------------------------- */

START_TEST(coasts_with_what_it_is_told)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 6u);
    insole_zupt_ekf_t ekf = filter_swinging(&rng);
    insole_zupt_ekf_t before = ekf;
    ck_assert_int_eq(coast_with(&ekf, 1.2, 0.7, 3000000), INSOLE_OK);
    ASSERT_NEAR(ekf.p_m.x, before.p_m.x, 0.0, "m");
    ASSERT_NEAR(ekf.p_m.y, (double)before.p_m.y + 3.6, 1.0e-5, "m");
    ASSERT_NEAR(ekf.v_mps.y, 1.2, 1.0e-6, "m/s");
    ck_assert(memcmp(&ekf.q, &before.q, sizeof ekf.q) == 0);
    ck_assert(memcmp(&ekf.P.aa, &before.P.aa, sizeof ekf.P.aa) == 0);
    ASSERT_NEAR(ekf.P.pp.xx, (double)before.P.pp.xx + 0.49 * 9.0, 1.0e-5, "m^2");
    ASSERT_NEAR(ekf.P.pp.xy, before.P.pp.xy, 1.0e-7, "m^2");
    ASSERT_NEAR(ekf.P.vv.zz, 0.49, 1.0e-6, "(m/s)^2");
    ck_assert(ekf.P.va.r0.x == 0 && ekf.P.vb.r1.y == 0 && ekf.P.ab.r2.z == 0);
    ck_assert_int_eq(ekf.trace.step, INSOLE_ZUPT_STEP_COAST);
    ck_assert_uint_eq(ekf.t_us, before.t_us + 3000000u);
}
END_TEST

/* The velocity of a walk is wrong for a while, not anew in every sample. */
START_TEST(coasts_alike_in_one_step_and_in_many)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 7u);
    insole_zupt_ekf_t one = filter_swinging(&rng);
    insole_zupt_ekf_t many = one;
    ck_assert_int_eq(coast_with(&one, 1.0, 0.7, 1000000), INSOLE_OK);
    for (int i = 0; i < 200; i++) {
        ck_assert_int_eq(coast_with(&many, 1.0, 0.7, FILTER_STEP_US), INSOLE_OK);
    }
    dense_t a = dense_of(&one.P), b = dense_of(&many.P);
    ASSERT_AT_MOST(dense_off(&a, &b, &a), 400.0 * EPS, "(of the 1-sigmas)");
    ASSERT_NEAR(many.p_m.y, one.p_m.y, 400.0 * EPS, "m");
    ASSERT_AT_LEAST(dense_least_eigenvalue(b, DENSE), 0.0, "(positive)");
    ck_assert_int_eq(coast_with(&many, 1.0, 0.2, FILTER_STEP_US), INSOLE_OK);
    ASSERT_NEAR(many.P.vv.xx, 0.49, 1.0e-6, "(m/s)^2: still that of the first call");
    ck_assert_int_eq(filter_feel(&many, FILTER_UP, insole_vec3_zero()), INSOLE_OK);
    ck_assert_int_eq(coast_with(&many, 1.0, 0.2, FILTER_STEP_US), INSOLE_OK);
    ASSERT_NEAR(many.P.vv.xx, 0.04, 1.0e-6, "(m/s)^2: a new coast");
}
END_TEST

/* ---- state ------------------------------------------------------------------------------ */

START_TEST(goes_on_from_a_snapshot_bit_for_bit)
{
    enum { KIND = 3, CUT = 777, END = 1500 };
    static unsigned char flash[INSOLE_SNAPSHOT_HEADER_BYTES + sizeof(insole_zupt_ekf_t)];
    gait_t gait = gait_usual();
    insole_zupt_ekf_t ekf = filter_aligned(), other;
    size_t used;
    filter_walk(&ekf, &gait, 0, CUT);
    ck_assert_uint_ne(ekf.noise.samples, 0u); /* in the middle of a block */
    ck_assert_int_eq(insole_snapshot_save(KIND, &ekf, sizeof ekf, flash, sizeof flash, &used),
                     INSOLE_OK);
    filter_walk(&ekf, &gait, CUT, END);
    memset(&other, 0x5a, sizeof other);
    ck_assert_int_eq(insole_snapshot_load(KIND, &other, sizeof other, flash, used), INSOLE_OK);
    filter_walk(&other, &gait, CUT, END);
    ck_assert(memcmp(&ekf, &other, sizeof ekf) == 0);
}
END_TEST

/* A day of the largest values that are taken. */
START_TEST(stays_finite_whatever_comes)
{
    insole_zupt_ekf_t ekf = filter_aligned();
    insole_imu_t imu = {0u, {0, INSOLE_R(1.0e4), 0}, {INSOLE_R(1.0e3), INSOLE_R(1.0e3), 0}};
    for (int s = 0; s < 86400; s++) {
        imu.t_us = ekf.t_us + 1000000u;
        (void)insole_zupt_ekf_predict(&ekf, &imu, 7u);
    }
    ck_assert_uint_eq(ekf.refused, 0u);
    dense_t P = dense_of(&ekf.P);
    for (int i = 0; i < DENSE * DENSE; i++) {
        ck_assert(fabs(P.at[i / DENSE][i % DENSE]) < HUGE_VAL);
    }
    ck_assert(insole_vec3_is_finite(ekf.p_m) && insole_vec3_is_finite(ekf.v_mps));
    ASSERT_NEAR(d3_norm(d33_of(insole_quat_to_mat3(ekf.q)).r0), 1.0, 10.0 * EPS, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zupt_ekf");
    suite_add_loop(suite, "ranges of the settings", takes_settings_in_their_range, KEY_COUNT);
    suite_add(suite, "first state", begins_at_the_origin);
    suite_add(suite, "any mounting", aligns_in_any_mounting);
    suite_add(suite, "what alignment tells", knows_what_alignment_tells);
    suite_add_loop(suite, "refusals", refuses_and_stays_as_it_was, BAD_CALL_COUNT);
    suite_add(suite, "yaw", refuses_a_yaw_that_is_none);
    suite_add(suite, "ends of the ranges", accepts_the_ends_of_its_ranges);
    suite_add(suite, "before alignment", refuses_what_comes_before_alignment);
    suite_add(suite, "NULL", refuses_null);
    suite_add(suite, "coasting", coasts_with_what_it_is_told);
    suite_add(suite, "coasting in steps", coasts_alike_in_one_step_and_in_many);
    suite_add(suite, "snapshot", goes_on_from_a_snapshot_bit_for_bit);
    suite_add(suite, "extremes", stays_finite_whatever_comes);
    return suite;
}
