/* SPDX-License-Identifier: MIT */
#include "insole/sense/gyro_clip.h"

#include <string.h>

#include "near.h"
#include "sample.h"
#include "suite.h"

static const double PI = 3.14159265358979323846;
static const int RATES_HZ[] = {100, 200, 250, 400};
enum { RATES = 4 };

/* A swing: half a sine of 0.25 s every second, cut off at `limit`, on one axis. */
static double swing(double t_s, double peak, double limit)
{
    double phase = fmod(t_s, 1.0) / 0.25;
    return phase < 1.0 ? fmin(peak * sin(PI * phase), limit) : 0.0;
}

static insole_vec3_t on_axis(int axis, double rate)
{
    insole_real_t w = (insole_real_t)rate, o = INSOLE_R(0.0);
    return axis == 0   ? insole_vec3(w, o, o)
           : axis == 1 ? insole_vec3(o, w, o)
                       : insole_vec3(o, o, w);
}

typedef struct {
    int rate_hz, axis;
    double peak, limit, seconds;
} gait_t;

/* Walks; counts samples marked on the gait's axis, and those marked on another. */
static void walk(insole_gyro_clip_t *clip, const gait_t *gait, int *marked, int *astray)
{
    double dt = 1.0 / gait->rate_hz;
    for (int i = 0; i < (int)(gait->seconds / dt); i++) {
        uint8_t axes = 0u;
        double sign = (int)(i * dt) % 2 == 0 ? 1.0 : -1.0;
        double rate = sign * swing(i * dt, gait->peak, gait->limit);
        ck_assert_int_eq(insole_gyro_clip_push(clip, on_axis(gait->axis, rate),
                                               (insole_real_t)(i == 0 ? 0.0 : 1e6 * dt), &axes),
                         INSOLE_OK);
        *marked += (axes >> gait->axis & 1) != 0;
        *astray += (axes & ~(1u << gait->axis)) != 0u;
    }
}

/* The top is taken where a peak comes within 3 % of it. */
static void assert_range(const insole_gyro_clip_t *clip, double limit)
{
    ASSERT_AT_LEAST(clip->range_radps, 0.97 * limit, "rad/s");
    ASSERT_AT_MOST(clip->range_radps, limit * (1.0 + 1e-6), "rad/s");
}

START_TEST(round_peaks_are_not_clipped)
{
    static const double PEAKS[] = {5.0, 7.5, 9.0, 12.0, 25.0};
    gait_t gait = {RATES_HZ[_i % RATES], _i % 3, PEAKS[_i / RATES], 1000.0, 20.0};
    insole_gyro_clip_t clip;
    int marked = 0, astray = 0;
    insole_gyro_clip_init(&clip, INSOLE_R(0.0), INSOLE_R(0.9));
    walk(&clip, &gait, &marked, &astray);
    ck_assert_int_eq(marked + astray, 0);
    ASSERT_NEAR(clip.range_radps, 0.0, 0.0, "rad/s");
}
END_TEST

START_TEST(cut_off_peaks_tell_the_range)
{
    gait_t gait = {RATES_HZ[_i % RATES], _i % 3, 14.0, 8.7, 20.0};
    insole_gyro_clip_t clip;
    int marked = 0, astray = 0;
    insole_gyro_clip_init(&clip, INSOLE_R(0.0), INSOLE_R(0.9));
    walk(&clip, &gait, &marked, &astray);
    assert_range(&clip, 8.7);
    /* above 0.9 of 8.7 of 14 rad/s: asin(.559) to pi - asin(.559) of half a sine, but the first */
    double share = 1.0 - 2.0 * asin(0.9 * 8.7 / 14.0) / PI;
    ASSERT_NEAR(marked, 19.0 * 0.25 * share * gait.rate_hz, 0.06 * marked + 20.0, "samples");
    ck_assert_int_eq(astray, 0);
}
END_TEST

/* A flat peak that a later rate goes far beyond was none of the sensor's making. */
START_TEST(a_faster_rate_disproves_the_range)
{
    gait_t flat = {200, 1, 14.0, 7.4, 5.0}, fast = {200, 1, 12.0, 1000.0, 5.0};
    insole_gyro_clip_t clip;
    int marked = 0, astray = 0;
    insole_gyro_clip_init(&clip, INSOLE_R(0.0), INSOLE_R(0.9));
    walk(&clip, &flat, &marked, &astray);
    assert_range(&clip, 7.4);
    walk(&clip, &fast, &marked, &astray);
    ASSERT_NEAR(clip.range_radps, 0.0, 0.0, "rad/s");
    marked = 0;
    walk(&clip, &flat, &marked, &astray);
    ck_assert_int_eq(marked, 0);
}
END_TEST

START_TEST(of_several_tops_the_largest_counts)
{
    gait_t low = {200, 0, 14.0, 8.6, 5.0}, high = {200, 2, 14.0, 9.6, 5.0};
    insole_gyro_clip_t clip;
    int marked = 0, astray = 0;
    insole_gyro_clip_init(&clip, INSOLE_R(0.0), INSOLE_R(0.9));
    walk(&clip, &low, &marked, &astray);
    walk(&clip, &high, &marked, &astray);
    assert_range(&clip, 9.6);
    walk(&clip, &low, &marked, &astray);
    assert_range(&clip, 9.6);
}
END_TEST

START_TEST(a_told_range_is_believed)
{
    insole_gyro_clip_t clip;
    uint8_t axes = 0u;
    insole_gyro_clip_init(&clip, INSOLE_R(10.0), INSOLE_R(0.9));
    insole_vec3_t rate = insole_vec3(INSOLE_R(8.9), INSOLE_R(-9.1), INSOLE_R(30.0));
    insole_gyro_clip_push(&clip, rate, INSOLE_R(5000.0), &axes);
    ck_assert_uint_eq(axes, 2u | 4u);
    ASSERT_NEAR(clip.range_radps, 10.0, 0.0, "rad/s");
}
END_TEST

/* A gap in mid-peak: the flat top on its two sides is not joined into one. */
START_TEST(a_gap_ends_what_was_watched)
{
    insole_gyro_clip_t clip;
    uint8_t axes = 0u;
    insole_gyro_clip_init(&clip, INSOLE_R(0.0), INSOLE_R(0.9));
    for (int i = 0; i < 9; i++) {
        insole_real_t dt_us = i % 3 == 0 ? INSOLE_R(0.0) : INSOLE_R(5000.0);
        insole_gyro_clip_push(&clip, on_axis(1, 8.0), dt_us, &axes);
    }
    insole_gyro_clip_push(&clip, on_axis(1, 0.0), INSOLE_R(5000.0), &axes);
    ASSERT_NEAR(clip.range_radps, 0.0, 0.0, "rad/s");
}
END_TEST

START_TEST(refusals_change_nothing)
{
    insole_gyro_clip_t clip, before;
    uint8_t axes = 9u;
    insole_real_t nan = (insole_real_t)NAN;
    ck_assert_int_eq(insole_gyro_clip_init(NULL, INSOLE_R(0.0), INSOLE_R(0.9)), INSOLE_ERR_NULL);
    memset(&clip, 0, sizeof clip);
    insole_gyro_clip_init(&clip, INSOLE_R(0.0), INSOLE_R(0.9));
    memcpy(&before, &clip, sizeof clip);
    insole_vec3_t fine = on_axis(0, 1.0), bad = insole_vec3(INSOLE_R(0.0), nan, INSOLE_R(0.0));
    insole_real_t dt = INSOLE_R(5000.0);
    ck_assert_int_eq(insole_gyro_clip_push(NULL, fine, dt, &axes), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_gyro_clip_push(&clip, fine, dt, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_gyro_clip_push(&clip, bad, dt, &axes), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_gyro_clip_push(&clip, fine, nan, &axes), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_gyro_clip_push(&clip, fine, -dt, &axes), INSOLE_ERR_VALUE);
    ck_assert_mem_eq(&before, &clip, sizeof clip);
    ck_assert_uint_eq(axes, 9u);
    static const insole_real_t BAD[][2] = {{INSOLE_R(-1.0), INSOLE_R(0.9)},
                                           {INSOLE_R(101.0), INSOLE_R(0.9)},
                                           {INSOLE_R(0.0), INSOLE_R(0.4)},
                                           {INSOLE_R(0.0), INSOLE_R(1.1)}};
    for (int i = 0; i < 4; i++) {
        ck_assert_int_eq(insole_gyro_clip_init(&clip, BAD[i][0], BAD[i][1]), INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_gyro_clip_init(&clip, nan, INSOLE_R(0.9)), INSOLE_ERR_VALUE);
    ck_assert_mem_eq(&before, &clip, sizeof clip);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("gyro_clip");
    suite_add_loop(suite, "round peaks", round_peaks_are_not_clipped, 5 * RATES);
    suite_add_loop(suite, "cut-off peaks", cut_off_peaks_tell_the_range, 3 * RATES);
    suite_add(suite, "disproof", a_faster_rate_disproves_the_range);
    suite_add(suite, "several tops", of_several_tops_the_largest_counts);
    suite_add(suite, "told range", a_told_range_is_believed);
    suite_add(suite, "gaps", a_gap_ends_what_was_watched);
    suite_add(suite, "refusals", refusals_change_nothing);
    return suite;
}
