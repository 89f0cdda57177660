/* SPDX-License-Identifier: MIT */
#include "insole/sense/rhythm.h"

#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

static const double PI = 3.14159265358979323846;

static insole_rhythm_t rhythm;
static insole_rng_t rng;

static double wave(double t_s, double period_s)
{
    return 3.0 * sin(2 * PI * t_s / period_s) + 1.5 * cos(4 * PI * t_s / period_s);
}

static void begin(void)
{
    insole_rng_seed(&rng, 5u);
    ck_assert_int_eq(insole_rhythm_init(&rhythm), INSOLE_OK);
}

static void push(double t_s, double value)
{
    uint64_t t_us = 5000000u + (uint64_t)(t_s * 1e6 + 0.5);
    ck_assert_int_eq(insole_rhythm_push(&rhythm, t_us, (insole_real_t)value), INSOLE_OK);
}

static void feel(double period_s, double rate_hz, double lasts_s)
{
    begin();
    for (int i = 0; i < (int)(lasts_s * rate_hz); i++) {
        push(i / rate_hz, wave(i / rate_hz, period_s));
    }
}

static double likeness_us(uint64_t lag_us)
{
    insole_real_t likeness;
    ck_assert_int_eq(insole_rhythm_likeness(&rhythm, lag_us, &likeness), INSOLE_OK);
    return (double)likeness;
}

static double likeness(double lag_s)
{
    return likeness_us((uint64_t)(lag_s * 1e6));
}

/* The definition, on a wave whose values are known at every moment. */
static double oracle(double end_s, double lag_s, double period_s)
{
    double product = 0.0, power = 0.0;
    for (int i = 0; i < INSOLE_RHYTHM_WINDOW; i++) {
        double a = wave(end_s - i / 16.0, period_s), b = wave(end_s - i / 16.0 - lag_s, period_s);
        product += a * b;
        power += a * a + b * b;
    }
    return 2.0 * product / power;
}

static const double RATES_HZ[] = {20.0, 50.0, 100.0, 400.0};

START_TEST(likeness_is_that_of_its_definition)
{
    double rate_hz = RATES_HZ[_i], worst_line = _i == 0 ? 0.1 : 0.02; /* lines between samples */
    feel(0.77, rate_hz, 10.0);
    double grid_s = floor((10.0 - 1.0 / rate_hz) * 16.0) / 16.0;
    worst_t worst = {0.0, 0.0};
    for (int lag = 2; lag < 32; lag++) {
        double expected =
            fmax(oracle(grid_s, lag / 16.0, 0.77), oracle(grid_s, (lag + 1) / 16.0, 0.77));
        worst_note(&worst, fabs(likeness_us(62500u * (uint64_t)lag) - expected), lag);
    }
    ASSERT_WORST(worst, worst_line, "");
}
END_TEST

START_TEST(what_repeats_is_like_itself)
{
    for (double period_s = 0.4; period_s < 1.9; period_s += 0.1) {
        feel(period_s, RATES_HZ[_i], 8.0);
        ASSERT_AT_LEAST(likeness(period_s), 0.88, "");
        ASSERT_AT_MOST(likeness(period_s), 1.0, "");
    }
}
END_TEST

START_TEST(half_a_period_later_it_is_its_opposite)
{
    begin();
    for (int i = 0; i < 400; i++) {
        push(i / 50.0, sin(2 * PI * i / 50.0)); /* 1 Hz: eight grid points are half a period */
    }
    ASSERT_AT_MOST(likeness(0.5), -0.9, "");
    ASSERT_NEAR(likeness(1.0), 1.0, 0.01, "");
}
END_TEST

START_TEST(noise_is_not_like_itself)
{
    double sum = 0.0;
    begin();
    for (int i = 0; i < 20000; i++) {
        push(i / 16.0, (double)insole_rng_normal(&rng));
        if (i % 50 == 49) {
            sum += likeness(0.55);
        }
    }
    ASSERT_NEAR(sum / 400.0, 0.1, 0.03, ""); /* the better of two of mean 0 and 1-sigma 0.177 */
}
END_TEST

START_TEST(silence_says_nothing)
{
    begin();
    ASSERT_NEAR(likeness(0.5), 0.0, 0.0, "");
    for (int i = 0; i < 100; i++) {
        push(i / 50.0, 0.0);
    }
    ASSERT_NEAR(likeness(0.5), 0.0, 0.0, "");
}
END_TEST

START_TEST(long_gap_forgets_and_a_short_one_does_not)
{
    feel(0.5, 50.0, 8.0);
    push(8.4, wave(8.4, 0.5));
    ASSERT_AT_LEAST(likeness(0.5), 0.5, "");
    push(9.5, 0.0);
    ASSERT_NEAR(likeness(0.5), 0.0, 0.0, "");
}
END_TEST

START_TEST(copy_goes_on_like_the_original)
{
    feel(0.6, 50.0, 5.0);
    insole_rhythm_t copy = rhythm;
    for (int i = 250; i < 300; i++) {
        push(i / 50.0, wave(i / 50.0, 0.6));
    }
    double expected = likeness(0.6);
    rhythm = copy;
    for (int i = 250; i < 300; i++) {
        push(i / 50.0, wave(i / 50.0, 0.6));
    }
    ASSERT_NEAR(likeness(0.6), expected, 0.0, "");
}
END_TEST

START_TEST(scale_does_not_matter)
{
    static const double SCALES[] = {1e6 / 5.0, 1e-12};
    feel(0.4, 50.0, 10.0);
    double expected = likeness(0.4);
    for (int k = 0; k < 2; k++) {
        begin();
        for (int i = 0; i < 500; i++) {
            push(i / 50.0, SCALES[k] * wave(i / 50.0, 0.4));
        }
        ASSERT_NEAR(likeness(0.4), expected, 1e-5, "");
    }
}
END_TEST

static void refuse(uint64_t t_us, double value, insole_status_t expected)
{
    ASSERT_REFUSED(rhythm, rhythm.refused, insole_rhythm_push(&rhythm, t_us, (insole_real_t)value),
                   expected);
}

START_TEST(bad_arguments_are_refused)
{
    insole_real_t answer = INSOLE_R(7.0);
    feel(0.5, 50.0, 4.0);
    refuse(rhythm.t_us + 20000u, (double)NAN, INSOLE_ERR_VALUE);
    refuse(rhythm.t_us + 20000u, (double)INFINITY, INSOLE_ERR_VALUE);
    refuse(rhythm.t_us + 20000u, -1.001e6, INSOLE_ERR_VALUE);
    refuse(rhythm.t_us, 0.0, INSOLE_ERR_TIME);
    refuse(rhythm.t_us - 1u, 0.0, INSOLE_ERR_TIME);
    ck_assert_int_eq(insole_rhythm_likeness(&rhythm, INSOLE_RHYTHM_FIRST_US - 1u, &answer),
                     INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_rhythm_likeness(&rhythm, INSOLE_RHYTHM_LAST_US + 1u, &answer),
                     INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_rhythm_likeness(&rhythm, UINT64_MAX, &answer), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_rhythm_likeness(&rhythm, 500000u, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rhythm_likeness(NULL, 500000u, &answer), INSOLE_ERR_NULL);
    ASSERT_NEAR(answer, 7.0, 0.0, "");
    ck_assert_int_eq(insole_rhythm_likeness(&rhythm, INSOLE_RHYTHM_FIRST_US, &answer), INSOLE_OK);
    ck_assert_int_eq(insole_rhythm_likeness(&rhythm, INSOLE_RHYTHM_LAST_US, &answer), INSOLE_OK);
    ck_assert_int_eq(insole_rhythm_push(NULL, 1u, answer), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rhythm_init(NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("rhythm");
    suite_add_loop(suite, "definition", likeness_is_that_of_its_definition, 4);
    suite_add_loop(suite, "periods", what_repeats_is_like_itself, 4);
    suite_add(suite, "opposite", half_a_period_later_it_is_its_opposite);
    suite_add(suite, "noise", noise_is_not_like_itself);
    suite_add(suite, "silence", silence_says_nothing);
    suite_add(suite, "gaps", long_gap_forgets_and_a_short_one_does_not);
    suite_add(suite, "copy", copy_goes_on_like_the_original);
    suite_add(suite, "scale", scale_does_not_matter);
    suite_add(suite, "bad arguments", bad_arguments_are_refused);
    return suite;
}
