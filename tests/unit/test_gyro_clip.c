/* SPDX-License-Identifier: MIT */
#include "insole/sense/gyro_clip.h"

#include "near.h"
#include "refusal.h"
#include "suite.h"

#define PI 3.14159265358979323846

static const double RATES_HZ[] = {60.0, 75.0, 100.0, 128.0, 200.0, 250.0, 400.0};
enum { RATES = sizeof RATES_HZ / sizeof RATES_HZ[0] };

static insole_gyro_clip_t fresh(double range, double share)
{
    insole_gyro_clip_t clip;
    ck_assert_int_eq(insole_gyro_clip_init(&clip, (insole_real_t)range, (insole_real_t)share),
                     INSOLE_OK);
    return clip;
}

static uint8_t push(insole_gyro_clip_t *clip, double x, double y, double z, double dt_s)
{
    uint8_t axes = 0xffu;
    insole_vec3_t gyro = insole_vec3((insole_real_t)x, (insole_real_t)y, (insole_real_t)z);
    ck_assert_int_eq(insole_gyro_clip_push(clip, gyro, (insole_real_t)(dt_s * 1.0e6), &axes),
                     INSOLE_OK);
    return axes;
}

static uint8_t push_y(insole_gyro_clip_t *clip, double y, double dt_s)
{
    return push(clip, 0.0, y, 0.0, dt_s);
}

/* One half wave of a sine about y with a pause on both sides; its value is cut off at `range`. */
static uint32_t half_wave(insole_gyro_clip_t *clip, double top, double width_s, double range,
                          double rate_hz, double phase)
{
    uint32_t marked = 0u;
    for (double t = (phase - 3.0) / rate_hz; t < width_s + 3.0 / rate_hz; t += 1.0 / rate_hz) {
        double y = t > 0.0 && t < width_s ? top * sin(PI * t / width_s) : 0.0;
        marked += push_y(clip, fmax(fmin(y, range), -range), 1.0 / rate_hz) != 0u ? 1u : 0u;
    }
    return marked;
}

START_TEST(round_peaks_are_not_taken_for_clipped)
{
    worst_t range = {0.0, 0.0};
    for (double width_s = 0.15; width_s < 0.7; width_s += 0.013) {
        for (double top = 7.5; top < 35.0; top *= 1.3) {
            insole_gyro_clip_t clip = fresh(0.0, 0.88);
            for (double phase = 0.0; phase < 1.0; phase += 0.2) {
                half_wave(&clip, top, width_s, 1.0e3, RATES_HZ[_i], phase);
            }
            worst_note(&range, (double)clip.range_radps, width_s);
        }
    }
    ASSERT_WORST(range, 0.0, "rad/s");
}
END_TEST

/* Three peaks as a foot makes them, up to three times as high as the sensor can tell. */
START_TEST(flat_tops_tell_the_range)
{
    worst_t off = {0.0, 0.0};
    for (double excess = 1.3; excess < 3.0; excess *= 1.2) {
        for (double width_s = 0.2; width_s < 0.55; width_s += 0.05) {
            insole_gyro_clip_t clip = fresh(0.0, 0.88);
            for (double phase = 0.0; phase < 0.9; phase += 0.3) {
                half_wave(&clip, excess * 8.7, width_s, 8.7, RATES_HZ[_i], phase);
            }
            worst_note(&off, fabs((double)clip.range_radps - 8.7), excess);
        }
    }
    ASSERT_WORST(off, 0.03 * 8.7, "rad/s");
}
END_TEST

/* Once the range is known, what is marked is what was cut off and the bend before it. */
START_TEST(marks_lie_where_the_signal_is_cut_off)
{
    insole_gyro_clip_t clip = fresh(0.0, 0.88);
    ck_assert_uint_eq(half_wave(&clip, 16.0, 0.3, 8.0, 200.0, 0.5), 0u);
    double from_s = 0.3 / PI * asin(0.88 * 8.0 / 16.0);
    uint32_t expected = (uint32_t)lround((0.3 - 2.0 * from_s) * 200.0);
    uint32_t marked = half_wave(&clip, 16.0, 0.3, 8.0, 200.0, 0.5);
    ASSERT_NEAR(marked, expected, 1, "samples");
}
END_TEST

START_TEST(each_axis_and_each_sign)
{
    const double sign = (_i & 1) != 0 ? -1.0 : 1.0;
    const int axis = _i / 2;
    insole_gyro_clip_t clip = fresh(0.0, 0.88);
    for (int wave = 0; wave < 2; wave++) {
        for (int i = 0; i < 40; i++) {
            double v = sign * fmin(20.0 * sin(PI * (i + 0.5) / 40.0), 9.0);
            uint8_t axes =
                push(&clip, axis == 0 ? v : 0.1, axis == 1 ? v : 0.1, axis == 2 ? v : 0.1, 0.005);
            bool high = wave > 0 && fabs(v) >= 0.88 * 9.0;
            ck_assert_uint_eq(axes, high ? 1u << axis : 0u);
        }
    }
    ASSERT_NEAR(clip.range_radps, 9.0, 0.27, "rad/s");
}
END_TEST

START_TEST(a_told_range_holds_whatever_comes)
{
    insole_gyro_clip_t clip = fresh(16.0, 0.75);
    half_wave(&clip, 20.0, 0.3, 9.0, 200.0, 0.0);
    half_wave(&clip, 40.0, 0.3, 30.0, 200.0, 0.0);
    ASSERT_NEAR(clip.range_radps, 16.0, 0.0, "rad/s");
    ck_assert_uint_eq(push(&clip, 11.999, -12.0, 12.0, 0.005), 6u);
}
END_TEST

START_TEST(the_largest_top_counts_until_a_rate_lasts_far_beyond_it)
{
    insole_gyro_clip_t clip = fresh(0.0, 0.88);
    half_wave(&clip, 16.0, 0.3, 8.0, 200.0, 0.0);
    half_wave(&clip, 18.0, 0.3, 9.0, 200.0, 0.0);
    half_wave(&clip, 15.0, 0.3, 7.5, 200.0, 0.0);
    ASSERT_NEAR(clip.range_radps, 9.0, 0.27, "rad/s");
    push_y(&clip, 60.0, 0.005); /* a spike of one sample says nothing */
    push_y(&clip, 0.0, 0.005);
    ASSERT_NEAR(clip.range_radps, 9.0, 0.27, "rad/s");
    half_wave(&clip, 25.0, 0.3, 1.0e3, 200.0, 0.0);
    ASSERT_NEAR(clip.range_radps, 0.0, 0.0, "rad/s");
    half_wave(&clip, 16.0, 0.3, 8.0, 200.0, 0.0);
    ASSERT_NEAR(clip.range_radps, 0.0, 0.0, "rad/s");
    half_wave(&clip, 70.0, 0.3, 34.9, 200.0, 0.0);
    ASSERT_NEAR(clip.range_radps, 34.9, 1.05, "rad/s");
}
END_TEST

/* Twice 15 ms at the top are 30 ms only when nothing lies between. */
START_TEST(time_that_is_not_known_ends_a_peak)
{
    for (int gap = 0; gap < 2; gap++) {
        insole_gyro_clip_t clip = fresh(0.0, 0.88);
        push_y(&clip, 2.0, 0.005);
        for (int i = 0; i < 6; i++) {
            push_y(&clip, 9.0, gap == 1 && i == 3 ? 0.0 : 0.005);
        }
        push_y(&clip, 2.0, 0.005);
        ASSERT_NEAR(clip.range_radps, gap == 1 ? 0.0 : 9.0, 0.0, "rad/s");
    }
}
END_TEST

START_TEST(bad_settings_are_refused)
{
    insole_gyro_clip_t clip;
    memset(&clip, 0x5a, sizeof clip);
    ck_assert_int_eq(insole_gyro_clip_init(NULL, 0, 1), INSOLE_ERR_NULL);
    static const insole_real_t BAD[][2] = {
        {-1, 1},          {101, 1}, {(double)NAN, 1},     {(double)INFINITY, 1},
        {5, (double)NAN}, {5, 0},   {5, (double)INFINITY}};
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        ASSERT_UNCHANGED(clip, insole_gyro_clip_init(&clip, BAD[i][0], BAD[i][1]),
                         INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_gyro_clip_init(&clip, 100, INSOLE_R(0.5)), INSOLE_OK);
    ck_assert_int_eq(insole_gyro_clip_init(&clip, 0, 1), INSOLE_OK);
}
END_TEST

START_TEST(bad_samples_are_refused)
{
    insole_gyro_clip_t clip = fresh(0.0, 0.88);
    half_wave(&clip, 16.0, 0.3, 8.0, 200.0, 0.0);
    uint8_t axes = 0x77u;
    insole_vec3_t one = insole_vec3(1, 1, 1);
    ck_assert_int_eq(insole_gyro_clip_push(NULL, one, 5000, &axes), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(clip, insole_gyro_clip_push(&clip, one, 5000, NULL), INSOLE_ERR_NULL);
    const insole_vec3_t bad[] = {insole_vec3((double)NAN, 1, 1),
                                 insole_vec3(1, (double)INFINITY, 1),
                                 insole_vec3(1, 1, -(double)INFINITY)};
    for (int i = 0; i < 3; i++) {
        ASSERT_UNCHANGED(clip, insole_gyro_clip_push(&clip, bad[i], 5000, &axes), INSOLE_ERR_VALUE);
    }
    ASSERT_UNCHANGED(clip, insole_gyro_clip_push(&clip, one, -1, &axes), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(clip, insole_gyro_clip_push(&clip, one, (double)NAN, &axes), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(clip, insole_gyro_clip_push(&clip, one, (double)INFINITY, &axes),
                     INSOLE_ERR_VALUE);
    ck_assert_uint_eq(axes, 0x77u);
}
END_TEST

/* Whoever only remembers the quiet ones sees the same. */
START_TEST(quiet_rates_need_only_be_remembered)
{
    insole_gyro_clip_t pushed = fresh(0.0, 0.88), watched = pushed;
    int quiet = 0;
    for (int i = 0; i < 2000; i++) {
        double y = fmin(14.0 * sin(0.05 * i) * sin(0.003 * i), 9.0);
        insole_vec3_t gyro = insole_vec3(1, (insole_real_t)y, -2);
        uint8_t axes = push(&pushed, 1.0, y, -2.0, 0.005);
        if (insole_gyro_clip_is_quiet(&watched, &gyro)) {
            insole_gyro_clip_remember(&watched, &gyro);
            ck_assert_uint_eq(axes, 0u);
            quiet++;
        } else {
            ck_assert_uint_eq(push(&watched, 1.0, y, -2.0, 0.005), axes);
        }
        ck_assert_int_eq(memcmp(&pushed, &watched, sizeof pushed), 0);
    }
    ck_assert_int_gt(quiet, 300);
    ck_assert_int_lt(quiet, 1700);
}
END_TEST

START_TEST(a_copy_goes_on_alike)
{
    insole_gyro_clip_t clip = fresh(0.0, 0.88);
    half_wave(&clip, 16.0, 0.3, 8.0, 200.0, 0.0);
    for (int i = 0; i < 30; i++) {
        push_y(&clip, 8.0 * i / 30.0, 0.005);
    }
    insole_gyro_clip_t copy = clip;
    for (int i = 0; i < 60; i++) {
        double y = 8.0 * cos(0.1 * i);
        ck_assert_uint_eq(push_y(&clip, y, 0.005), push_y(&copy, y, 0.005));
    }
    ck_assert_int_eq(memcmp(&clip, &copy, sizeof clip), 0);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("gyro_clip");
    suite_add_loop(suite, "round peaks", round_peaks_are_not_taken_for_clipped, RATES);
    suite_add_loop(suite, "flat tops", flat_tops_tell_the_range, RATES);
    suite_add(suite, "marks", marks_lie_where_the_signal_is_cut_off);
    suite_add_loop(suite, "axes", each_axis_and_each_sign, 6);
    suite_add(suite, "told range", a_told_range_holds_whatever_comes);
    suite_add(suite, "several tops", the_largest_top_counts_until_a_rate_lasts_far_beyond_it);
    suite_add(suite, "gap", time_that_is_not_known_ends_a_peak);
    suite_add(suite, "settings", bad_settings_are_refused);
    suite_add(suite, "samples", bad_samples_are_refused);
    suite_add(suite, "quiet", quiet_rates_need_only_be_remembered);
    suite_add(suite, "copy", a_copy_goes_on_alike);
    return suite;
}
