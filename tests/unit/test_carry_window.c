/* SPDX-License-Identifier: MIT */
#include "insole/sense/carry_window.h"

#include "carry_walk.h"
#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

/* Of the scale of a feature. A hundred values of 10 m/s^2 leave their float mean uncertain by up to
 * 3e-5 m/s^2, and a skewness by three times that over a scatter of some 3 m/s^2. */
static const double ROUNDING = 2e-5;

enum { FIRST_US = 7000000, POINT_US = INSOLE_CARRY_GRID_US };

static const carry_gait_t GAITS[] = {{1.0, 3.0, 1.0, 0.5, 0.3, 2.0},
                                     {1.17, 1.5, 2.5, 4.0, 1.1, 0.5},
                                     {0.92, 6.0, 3.0, 1.0, 2.0, 1.0},
                                     {1.25, 0.4, 0.2, 8.0, 0.0, 0.0}};
enum { GAIT_COUNT = sizeof GAITS / sizeof GAITS[0] };

static insole_carry_window_t window;
static insole_carry_features_t features;
static insole_rng_t rng;

static void begin(void)
{
    insole_rng_seed(&rng, 3u);
    ck_assert_int_eq(insole_carry_window_init(&window, INSOLE_R(0.5)), INSOLE_OK);
}

static insole_vec3_t real_vec3(d3_t v)
{
    return insole_vec3((insole_real_t)v.x, (insole_real_t)v.y, (insole_real_t)v.z);
}

static d3_t double_vec3(insole_vec3_t v)
{
    return d3((double)v.x, (double)v.y, (double)v.z);
}

static void push_at(uint64_t t_us, d3_t force, const insole_vec3_t *up)
{
    ck_assert_int_eq(insole_carry_window_push(&window, t_us, real_vec3(force), NULL, up),
                     INSOLE_OK);
}

static void push_turning(uint64_t t_us, d3_t force, d3_t turn, const insole_vec3_t *up)
{
    insole_vec3_t gyro = real_vec3(turn);
    ck_assert_int_eq(insole_carry_window_push(&window, t_us, real_vec3(force), &gyro, up),
                     INSOLE_OK);
}

/* Noisy motion, the same each time. */
static d3_t noisy(int i)
{
    insole_vec3_t noise = sample_vec3(&rng, INSOLE_R(1.5));
    return d3_add(carry_force(&GAITS[1], i * 0.02), 1.0, double_vec3(noise));
}

static d3_t noisy_turn(int i)
{
    insole_vec3_t noise = sample_vec3(&rng, INSOLE_R(0.3));
    return d3_add(carry_turn(&GAITS[1], i * 0.02), 1.0, double_vec3(noise));
}

/* Relative to what the units of a feature make of the motion: values of some 10 m/s^2. */
static double scale_of(int k)
{
    bool is_variance = k < INSOLE_CARRY_PAPER && k % INSOLE_CARRY_STATISTICS == 0;
    return is_variance ? 100.0 : k < INSOLE_CARRY_PAPER ? 10.0 : 1.0;
}

static void compare(const insole_carry_features_t *found, const double *expected, worst_t *worst)
{
    for (int k = 0; k < INSOLE_CARRY_FEATURES; k++) {
        worst_note(worst, fabs((double)found->value[k] - expected[k]) / scale_of(k), k);
    }
}

/* ---- what the features are -------------------------------------------------------------- */

START_TEST(features_are_those_of_their_definitions)
{
    d3_t force[CARRY_LONGEST], turn[CARRY_LONGEST], up[CARRY_LONGEST];
    double expected[INSOLE_CARRY_FEATURES];
    worst_t worst = {0.0, 0.0};
    int windows = 0;
    begin();
    for (int i = 0; i < CARRY_LONGEST; i++) {
        insole_vec3_t g = insole_vec3_add(sample_vec3(&rng, INSOLE_R(2.0)), insole_vec3(0, 3, 4));
        force[i] = double_vec3(real_vec3(noisy(i)));
        turn[i] = double_vec3(real_vec3(noisy_turn(i)));
        up[i] = d3_scale(double_vec3(g), 1.0 / d3_norm(double_vec3(g)));
        push_turning(FIRST_US + (uint64_t)i * POINT_US, force[i], turn[i], &g);
        if (insole_carry_window_next(&window, &features) == INSOLE_OK) {
            int from = i + 1 - CARRY_POINTS;
            carry_features(&force[from], &turn[from], &up[from], expected);
            ck_assert(features.has_gyro);
            compare(&features, expected, &worst);
            windows++;
        }
    }
    ck_assert_int_eq(windows, CARRY_LONGEST / INSOLE_CARRY_HALF - 1);
    ASSERT_WORST(worst, ROUNDING, "of the scale (feature)");
}
END_TEST

START_TEST(without_an_attitude_gravity_is_the_slow_part)
{
    d3_t force[CARRY_LONGEST], up[CARRY_LONGEST], low = d3(0, 0, 0);
    double expected[INSOLE_CARRY_FEATURES];
    worst_t worst = {0.0, 0.0};
    begin();
    for (int i = 0; i < CARRY_LONGEST; i++) {
        force[i] = double_vec3(real_vec3(noisy(i)));
        double gain = fmax(0.02 / 0.52, 1.0 / (i + 1));
        low = d3_add(low, gain, d3_add(force[i], -1.0, low));
        up[i] = d3_scale(low, 1.0 / d3_norm(low));
        push_at(FIRST_US + (uint64_t)i * POINT_US, force[i], NULL);
        if (insole_carry_window_next(&window, &features) == INSOLE_OK) {
            int from = i + 1 - CARRY_POINTS;
            carry_features(&force[from], NULL, &up[from], expected);
            ck_assert(!features.has_gyro);
            compare(&features, expected, &worst);
        }
    }
    ASSERT_WORST(worst, ROUNDING, "of the scale (feature)");
}
END_TEST

START_TEST(a_steady_force_by_hand)
{
    insole_vec3_t up = insole_vec3(0, 0, 2);
    begin();
    for (int i = 0; i < CARRY_POINTS; i++) {
        push_at((uint64_t)i * POINT_US, d3(3, 0, 4), &up);
    }
    ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_OK);
    static const double LENGTHS[] = {5.0, 3.0, 4.0};
    for (int k = 0; k < INSOLE_CARRY_FEATURES; k++) {
        bool is_length = k < INSOLE_CARRY_PAPER && k % INSOLE_CARRY_STATISTICS != 0;
        double expected = is_length ? LENGTHS[k / INSOLE_CARRY_STATISTICS] : 0.0;
        ASSERT_NEAR(features.value[k], expected, 1e-6, "");
    }
}
END_TEST

/* The force along gravity counts the same upside down. */
START_TEST(half_of_the_values_by_hand)
{
    insole_vec3_t up = insole_vec3(0, 1, 0);
    begin();
    for (int i = 0; i < CARRY_POINTS; i++) {
        push_at((uint64_t)i * POINT_US, d3(0, i < 60 ? 2 : -8, 0), &up);
    }
    ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_OK);
    const insole_real_t *g = &features.value[INSOLE_CARRY_GACC * INSOLE_CARRY_STATISTICS];
    ASSERT_NEAR(g[INSOLE_CARRY_MEAN], 0.6 * 2 + 0.4 * 8, 1e-5, "m/s^2");
    ASSERT_NEAR(g[INSOLE_CARRY_VARIANCE], 0.6 * 0.4 * 36, 1e-4, "m^2/s^4");
    ASSERT_NEAR(g[INSOLE_CARRY_MEDIAN], 2, 0, "m/s^2");
    ASSERT_NEAR(g[INSOLE_CARRY_MAXIMUM], 8, 0, "m/s^2");
    ASSERT_NEAR(g[INSOLE_CARRY_MINIMUM], 2, 0, "m/s^2");
    double cube = 0.6 * 0.4 * (0.6 - 0.4) * 216, square = 0.6 * 0.4 * 36;
    ASSERT_NEAR(features.value[INSOLE_CARRY_SKEWNESS + INSOLE_CARRY_GACC],
                cube / (pow(square, 1.5) + 0.01), 1e-5, "");
}
END_TEST

START_TEST(a_stride_is_like_the_stride_before)
{
    static const carry_gait_t EVEN = {1.0, 3.0, 0.0, 0.0, 0.2, 0.0};
    static const carry_gait_t LIMP = {1.0, 0.3, 0.0, 4.0, 0.2, 0.0};
    const carry_gait_t *gait = _i == 0 ? &EVEN : &LIMP;
    begin();
    for (int i = 0; i < CARRY_POINTS; i++) {
        push_at((uint64_t)i * POINT_US, carry_force(gait, i * 0.02), NULL);
    }
    ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_OK);
    ASSERT_AT_LEAST(features.value[INSOLE_CARRY_STRIDE_LIKENESS], 0.98, "");
    ASSERT_AT_MOST(features.value[INSOLE_CARRY_STRIDE_LIKENESS], 1.0, "");
    if (_i == 0) {
        ASSERT_AT_LEAST(features.value[INSOLE_CARRY_STEP_LIKENESS], 0.98, "");
    } else {
        ASSERT_AT_MOST(features.value[INSOLE_CARRY_STEP_LIKENESS], 0.2, "");
    }
}
END_TEST

/* A phone that turns by so many radians for each metre that it rises. */
START_TEST(a_rocking_forearm_has_its_gain)
{
    static const double ROCKS[] = {0.0, 0.5, 2.0, 6.0};
    carry_gait_t gait = {1.0, 3.0, 0.0, 0.0, 0.2, ROCKS[_i]};
    begin();
    for (int i = 0; i < CARRY_POINTS; i++) {
        d3_t turn = carry_turn(&gait, i * 0.02), force = carry_force(&gait, i * 0.02);
        force.x = 0.0;
        force.z = MOTION_G + gait.bounce * sin(4.0 * 3.14159265358979 * i * 0.02 + 0.4);
        push_turning((uint64_t)i * POINT_US, force, turn, NULL);
    }
    ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_OK);
    /* Means over 0.1 s of a wave of 2 Hz; halves of what the blocks before and after it differ. */
    double x = 0.05 * 4.0 * 3.14159265358979, seen = sin(x) / x / cos(x);
    ASSERT_NEAR(features.value[INSOLE_CARRY_TURN_GAIN], seen * ROCKS[_i], 0.02, "rad/m");
    if (_i > 0) {
        ASSERT_AT_LEAST(features.value[INSOLE_CARRY_TURN_IN_TIME], 0.95, "");
        ASSERT_AT_LEAST(features.value[INSOLE_CARRY_TURN_LINE], 0.97, "");
    }
}
END_TEST

/* From the first sample without one on, windows say that there is no gyroscope. */
START_TEST(a_gyroscope_that_fails_is_told)
{
    begin();
    for (int i = 0; i < 400; i++) {
        uint64_t t_us = FIRST_US + (uint64_t)i * POINT_US;
        if (i == 220) {
            push_at(t_us, noisy(i), NULL);
        } else {
            push_turning(t_us, noisy(i), noisy_turn(i), NULL);
        }
        if (insole_carry_window_next(&window, &features) == INSOLE_OK) {
            bool lacks_one = i == 249 || i == 299;
            ck_assert(features.has_gyro == !lacks_one);
            for (int k = INSOLE_CARRY_ACCEL; k < INSOLE_CARRY_FEATURES; k++) {
                ck_assert((features.value[k] != 0) == !lacks_one);
            }
        }
    }
}
END_TEST

/* ---- what they do not depend on --------------------------------------------------------- */

static void walk_turned(insole_quat_t turn, const carry_gait_t *gait)
{
    begin();
    for (int i = 0; i < CARRY_POINTS; i++) {
        insole_vec3_t force = real_vec3(carry_force(gait, i * 0.02));
        insole_vec3_t gyro = insole_quat_rotate(turn, real_vec3(carry_turn(gait, i * 0.02)));
        ck_assert(insole_carry_window_push(&window, (uint64_t)i * POINT_US,
                                           insole_quat_rotate(turn, force), &gyro,
                                           NULL) == INSOLE_OK);
    }
    ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_OK);
}

START_TEST(turning_the_phone_changes_nothing)
{
    const carry_gait_t *gait = &GAITS[_i];
    double upright[INSOLE_CARRY_FEATURES];
    insole_rng_t turns;
    worst_t worst = {0.0, 0.0};
    walk_turned(insole_quat(1, 0, 0, 0), gait);
    for (int k = 0; k < INSOLE_CARRY_FEATURES; k++) {
        upright[k] = (double)features.value[k];
    }
    insole_rng_seed(&turns, 77u);
    for (int n = 0; n < 1000; n++) {
        walk_turned(sample_quat(&turns), gait);
        compare(&features, upright, &worst);
    }
    ASSERT_WORST(worst, ROUNDING, "of the scale (feature)");
}
END_TEST

/* Slow enough for lines between samples at any of the rates. */
START_TEST(the_rate_of_the_samples_does_not_matter)
{
    static const int PERIODS_US[] = {40000, 20000, 10000, 8333, 5000, 2500};
    static const carry_gait_t GENTLE = {1.25, 1.0, 0.5, 2.0, 0.4, 1.0};
    double at_50_hz[INSOLE_CARRY_FEATURES];
    worst_t worst = {0.0, 0.0};
    for (int r = -1; r < 6; r++) {
        int period_us = r < 0 ? POINT_US : PERIODS_US[r];
        begin();
        for (int t_us = 0; t_us <= 2000000; t_us += period_us) {
            push_turning((uint64_t)t_us, carry_force(&GENTLE, t_us * 1e-6),
                         carry_turn(&GENTLE, t_us * 1e-6), NULL);
        }
        ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_OK);
        ck_assert_uint_eq(features.t_us, 1980000u);
        for (int k = 0; k < INSOLE_CARRY_FEATURES && r < 0; k++) {
            at_50_hz[k] = (double)features.value[k];
        }
        compare(&features, at_50_hz, &worst);
    }
    ASSERT_WORST(worst, 0.02, "of the scale (feature)");
}
END_TEST

/* ---- windows ---------------------------------------------------------------------------- */

START_TEST(a_window_a_second_each_half_new)
{
    begin();
    for (int i = 0; i < 1000; i++) {
        push_at(FIRST_US + (uint64_t)i * POINT_US, noisy(i), NULL);
        bool is_due = i >= 99 && i % 50 == 49;
        ck_assert_int_eq(insole_carry_window_next(&window, &features),
                         is_due ? INSOLE_OK : INSOLE_ERR_STATE);
        if (is_due) {
            ck_assert_uint_eq(features.t_us, FIRST_US + (uint64_t)i * POINT_US);
        }
        ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_ERR_STATE);
    }
}
END_TEST

/* Up to a second late it is still that window; then the next. */
START_TEST(a_window_may_be_taken_late)
{
    insole_carry_features_t at_once;
    insole_carry_window_t late;
    begin();
    for (int i = 0; i < 100; i++) {
        push_at((uint64_t)i * POINT_US, noisy(i), NULL);
    }
    late = window;
    ck_assert_int_eq(insole_carry_window_next(&window, &at_once), INSOLE_OK);
    window = late;
    for (int i = 100; i < 149; i++) {
        push_at((uint64_t)i * POINT_US, noisy(i), NULL);
    }
    late = window;
    ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_OK);
    ck_assert_int_eq(memcmp(features.value, at_once.value, sizeof features.value), 0);
    ck_assert_uint_eq(features.t_us, at_once.t_us);
    window = late;
    push_at(149u * POINT_US, noisy(149), NULL);
    ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_OK);
    ck_assert_uint_eq(features.t_us, 149u * POINT_US);
    ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_ERR_STATE);
}
END_TEST

START_TEST(a_gap_begins_anew)
{
    insole_carry_window_t fresh;
    insole_carry_features_t other;
    uint64_t back_us = FIRST_US + 99u * POINT_US + INSOLE_CARRY_GAP_US + (uint64_t)_i;
    begin();
    for (int i = 0; i < 100; i++) {
        push_at(FIRST_US + (uint64_t)i * POINT_US, noisy(i), NULL);
    }
    insole_carry_window_init(&fresh, INSOLE_R(0.5));
    for (int i = 0; i < 100; i++) {
        d3_t force = noisy(i);
        uint64_t t_us = back_us + (uint64_t)i * POINT_US;
        push_at(t_us, force, NULL);
        insole_carry_window_push(&fresh, t_us, real_vec3(force), NULL, NULL);
        if (_i > 0 && i < 99) {
            ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_ERR_STATE);
        }
    }
    ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_OK);
    ck_assert_int_eq(insole_carry_window_next(&fresh, &other), INSOLE_OK);
    ck_assert((memcmp(features.value, other.value, sizeof other.value) == 0) == (_i > 0));
}
END_TEST

/* ---- refusals --------------------------------------------------------------------------- */

static void fill_a_little(void)
{
    begin();
    for (int i = 0; i < 130; i++) {
        push_at(FIRST_US + (uint64_t)i * POINT_US, noisy(i), NULL);
    }
}

START_TEST(bad_settings_are_refused)
{
    fill_a_little();
    ck_assert_int_eq(insole_carry_window_init(NULL, 1), INSOLE_ERR_NULL);
    static const double BAD[] = {0.0, 0.049, 100.1, -1.0, (double)NAN, (double)INFINITY};
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        ASSERT_UNCHANGED(window, insole_carry_window_init(&window, (insole_real_t)BAD[i]),
                         INSOLE_ERR_VALUE);
    }
}
END_TEST

START_TEST(bad_samples_are_refused)
{
    uint64_t next_us = FIRST_US + 130u * POINT_US;
    insole_vec3_t good = insole_vec3(0, 0, 9), nothing = insole_vec3(0, 0, 0);
    fill_a_little();
    ck_assert_int_eq(insole_carry_window_push(NULL, next_us, good, NULL, NULL), INSOLE_ERR_NULL);
    static const double BAD[] = {1000.5, -1000.5, (double)NAN, (double)INFINITY, -(double)INFINITY};
    for (int i = 0; i < 15; i++) {
        insole_vec3_t bad = good, up = good;
        insole_real_t value = (insole_real_t)BAD[i / 3];
        *(i % 3 == 0 ? &bad.x : i % 3 == 1 ? &bad.y : &bad.z) = value;
        ASSERT_REFUSED(window, window.refused,
                       insole_carry_window_push(&window, next_us, bad, NULL, NULL),
                       INSOLE_ERR_VALUE);
        ASSERT_REFUSED(window, window.refused,
                       insole_carry_window_push(&window, next_us, good, &bad, NULL),
                       INSOLE_ERR_VALUE);
        if (i >= 6) {
            *(i % 3 == 0 ? &up.x : i % 3 == 1 ? &up.y : &up.z) = value;
            ASSERT_REFUSED(window, window.refused,
                           insole_carry_window_push(&window, next_us, good, NULL, &up),
                           INSOLE_ERR_VALUE);
        }
    }
    ASSERT_REFUSED(window, window.refused,
                   insole_carry_window_push(&window, next_us, good, NULL, &nothing),
                   INSOLE_ERR_VALUE);
    for (uint64_t back_us = 1u; back_us < 5000000u; back_us *= 10u) {
        ASSERT_REFUSED(
            window, window.refused,
            insole_carry_window_push(&window, next_us - POINT_US - back_us + 1u, good, NULL, NULL),
            INSOLE_ERR_TIME);
    }
    ck_assert_uint_eq(window.refused, 47u);
    ASSERT_UNCHANGED(window, insole_carry_window_next(&window, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_carry_window_next(NULL, &features), INSOLE_ERR_NULL);
}
END_TEST

/* Whatever is taken gives features that are numbers: free fall, the strongest blows, the last
 * times there are. */
START_TEST(extremes_give_finite_features)
{
    static const double SIZES[] = {0.0, 1e-30, 1e-6, 577.0, 1000.0};
    uint64_t first_us = UINT64_MAX - 100u * POINT_US;
    begin();
    for (int i = 0; i < 100; i++) {
        double size = SIZES[_i] * (i % 7 < 3 ? -1.0 : 1.0);
        push_turning(first_us + (uint64_t)i * POINT_US, d3(size, -size, i % 2 == 0 ? size : 0.0),
                     d3(-size, size, size), NULL);
    }
    ck_assert_int_eq(insole_carry_window_next(&window, &features), INSOLE_OK);
    for (int k = 0; k < INSOLE_CARRY_FEATURES; k++) {
        ck_assert(insole_is_finite(features.value[k]));
    }
}
END_TEST

START_TEST(a_copy_goes_on_alike)
{
    insole_carry_window_t copy;
    insole_carry_features_t other;
    fill_a_little();
    copy = window;
    for (int i = 130; i < 500; i++) {
        d3_t force = noisy(i);
        push_at(FIRST_US + (uint64_t)i * POINT_US, force, NULL);
        insole_carry_window_push(&copy, FIRST_US + (uint64_t)i * POINT_US, real_vec3(force), NULL,
                                 NULL);
        insole_status_t status = insole_carry_window_next(&window, &features);
        ck_assert_int_eq(insole_carry_window_next(&copy, &other), status);
        if (status == INSOLE_OK) {
            ck_assert_int_eq(memcmp(&features, &other, sizeof other), 0);
        }
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("carry_window");
    suite_add(suite, "definitions", features_are_those_of_their_definitions);
    suite_add(suite, "gravity", without_an_attitude_gravity_is_the_slow_part);
    suite_add(suite, "steady", a_steady_force_by_hand);
    suite_add(suite, "by hand", half_of_the_values_by_hand);
    suite_add_loop(suite, "forearm", a_rocking_forearm_has_its_gain, 4);
    suite_add(suite, "no gyroscope", a_gyroscope_that_fails_is_told);
    suite_add_loop(suite, "likeness", a_stride_is_like_the_stride_before, 2);
    suite_add_loop(suite, "turned", turning_the_phone_changes_nothing, GAIT_COUNT);
    suite_add(suite, "rates", the_rate_of_the_samples_does_not_matter);
    suite_add(suite, "cadence", a_window_a_second_each_half_new);
    suite_add(suite, "late", a_window_may_be_taken_late);
    suite_add_loop(suite, "gap", a_gap_begins_anew, 3);
    suite_add(suite, "settings", bad_settings_are_refused);
    suite_add(suite, "samples", bad_samples_are_refused);
    suite_add_loop(suite, "extremes", extremes_give_finite_features, 5);
    suite_add(suite, "copy", a_copy_goes_on_alike);
    return suite;
}
