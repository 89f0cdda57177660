/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_compass.h"

#include "insole/base/rng.h"
#include "near.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"

#define PI 3.14159265358979323846

static insole_phone_compass_t compass;
static insole_phone_compass_config_t config;

static insole_status_t judge(void)
{
    insole_phone_compass_t tried;
    return insole_phone_compass_init(&tried, &config);
}

static void set_up(void)
{
    ck_assert_int_eq(insole_phone_compass_init(&compass, &config), INSOLE_OK);
}

static void set_up_defaults(void)
{
    config = insole_phone_compass_defaults;
    set_up();
}

static bool push(double t_s, double strength_ut, double azimuth_rad)
{
    return insole_phone_compass_push(&compass, (uint64_t)llround(1e6 * t_s),
                                     (insole_real_t)strength_ut, (insole_real_t)azimuth_rad);
}

/* Difference between an angle and what it should be. */
static double off(insole_real_t rad, double expected)
{
    return remainder((double)rad - expected, 2.0 * PI);
}

START_TEST(every_setting_has_its_range)
{
    config = insole_phone_compass_defaults;
    ck_assert_int_eq(judge(), INSOLE_OK);
    INSOLE_PHONE_COMPASS_KEYS(SETTING_HAS_ENDS)
}
END_TEST

/* offset = where north is on the map less where it is seen in n */
START_TEST(offset_is_north_less_azimuth)
{
    const double north[] = {0.0, 1.5708, -3.1, 3.1, 0.5};
    const double azimuth[] = {0.0, -3.1, 3.0, -2.0, 6.0};
    config = insole_phone_compass_defaults;
    config.north_rad = (insole_real_t)north[_i];
    set_up();
    for (int i = 0; i <= 20; i++) {
        bool is_full = push(1.0 + 0.1 * i, 45.0, azimuth[_i]);
        ck_assert_int_eq(is_full, i == 20);
    }
    ASSERT_NEAR(off(compass.block_rad, north[_i] - azimuth[_i]), 0.0, 1e-5, "rad");
    ASSERT_NEAR(off(compass.mean_rad, north[_i] - azimuth[_i]), 0.0, 1e-5, "rad");
}
END_TEST

/* About +-pi the mean of the numbers would point the other way. */
START_TEST(means_are_those_of_a_circle)
{
    double c = 0.0, s = 0.0;
    set_up_defaults();
    double north = (double)config.north_rad;
    for (int i = 0; i < 20; i++) {
        double offset = PI + (i % 2 == 0 ? 0.3 : -0.25) + 0.01 * i;
        c += cos(offset);
        s += sin(offset);
        (void)push(0.1 * i, 50.0, north - offset);
    }
    ck_assert(push(2.0, 50.0, 0.0));
    ASSERT_NEAR(off(compass.block_rad, atan2(s, c)), 0.0, 1e-5, "rad");
}
END_TEST

/* A block ends with the first reading that is `block_s` after its first, and without it. */
START_TEST(blocks_end_when_their_time_is_over)
{
    const double block_s[] = {0.1, 0.5, 2.0, 10.0};
    int full = 0, in_block = 0;
    double c = 0.0, s = 0.0, begin_s = 0.0;
    worst_t worst = {0.0, 0.0};
    config = insole_phone_compass_defaults;
    config.block_s = (insole_real_t)block_s[_i];
    config.north_rad = INSOLE_R(0.0);
    set_up();
    for (int i = 0; i < 3000; i++) {
        double t_s = 3.0 + 0.0205 * i, azimuth = 2.0 * sin(0.01 * i);
        bool ends = in_block > 0 && t_s - begin_s >= block_s[_i] - 1e-9;
        worst_require(&worst, push(t_s, 45.0, azimuth) == ends, i);
        if (ends) {
            worst_note(&worst, fmax(0.0, fabs(off(compass.block_rad, atan2(s, c))) - 2e-5), i);
            c = s = 0.0;
            in_block = 0;
            full++;
        }
        begin_s = in_block == 0 ? t_s : begin_s;
        c += cos(-azimuth);
        s += sin(-azimuth);
        in_block++;
    }
    ASSERT_ALL_HELD(worst);
    ck_assert_int_ge(full, 5);
}
END_TEST

START_TEST(fields_too_weak_or_too_strong_are_passed_over)
{
    const double strength[] = {0.0,   14.9, 90.2, 1.0e6, (double)NAN, (double)INFINITY,
                               -45.0, 14.0, 200.0};
    set_up_defaults();
    (void)push(1.0, 45.0, 0.3);
    insole_phone_compass_t before = compass;
    for (size_t i = 0; i < sizeof strength / sizeof strength[0]; i++) {
        ck_assert(!push(10.0 + (double)i, strength[i], 2.5));
        before.passed++;
        ck_assert_mem_eq(&compass, &before, sizeof compass);
    }
    ck_assert(push(30.0, 15.0, 0.3));
    ck_assert(push(40.0, 90.0, 0.3));
    ck_assert_uint_eq(compass.used, 3u);
    ASSERT_NEAR(off(compass.mean_rad, (double)config.north_rad - 0.3), 0.0, 1e-5, "rad");
}
END_TEST

START_TEST(azimuths_that_are_none_are_passed_over)
{
    const double azimuth[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 7.1, -1.0e30};
    set_up_defaults();
    (void)push(1.0, 45.0, 0.3);
    insole_phone_compass_t before = compass;
    ck_assert(!push(9.0, 45.0, azimuth[_i]));
    before.passed++;
    ck_assert_mem_eq(&compass, &before, sizeof compass);
}
END_TEST

START_TEST(switched_off_it_knows_nothing)
{
    config = insole_phone_compass_defaults;
    config.use = 0;
    set_up();
    for (int i = 0; i < 100; i++) {
        ck_assert(!push(0.1 * i, 45.0, 0.3));
    }
    ck_assert(!insole_phone_compass_sight(&compass).is_known);
    ck_assert_uint_eq(compass.passed, 100u);
}
END_TEST

START_TEST(sight_tells_means_and_their_sigmas)
{
    config = insole_phone_compass_defaults;
    config.sigma_block_rad = INSOLE_R(0.6);
    config.sigma_mean_rad = INSOLE_R(0.2);
    set_up();
    ck_assert(!insole_phone_compass_sight(&compass).is_known);
    for (int i = 0; i < 60; i++) {
        (void)push(0.1 * i, 45.0, i < 40 ? 0.1 : 0.5);
    }
    insole_phone_sight_t sight = insole_phone_compass_sight(&compass);
    double north = (double)config.north_rad;
    ck_assert(sight.is_known);
    ASSERT_NEAR(off(sight.block_rad, north - 0.1), 0.0, 1e-5, "rad"); /* 2 s .. 4 s */
    ASSERT_NEAR(
        off(sight.mean_rad, north - atan2(2.0 * sin(0.1) + sin(0.5), 2.0 * cos(0.1) + cos(0.5))),
        0.0, 1e-5, "rad");
    ck_assert(sight.sigma_block_rad == INSOLE_R(0.6) && sight.sigma_mean_rad == INSOLE_R(0.2));
}
END_TEST

/* Nothing of before goes into what comes after, the block in work neither. */
START_TEST(forgotten_it_begins_anew)
{
    set_up_defaults();
    for (int i = 0; i < 50; i++) {
        (void)push(0.1 * i, 45.0, 2.0);
    }
    insole_phone_compass_forget(&compass);
    ck_assert(!insole_phone_compass_sight(&compass).is_known);
    ck_assert(!push(30.0, 45.0, -1.0));
    ck_assert(!push(31.9, 45.0, -1.0));
    ck_assert(push(32.1, 45.0, -1.0));
    insole_phone_sight_t sight = insole_phone_compass_sight(&compass);
    ASSERT_NEAR(off(sight.block_rad, (double)config.north_rad + 1.0), 0.0, 1e-5, "rad");
    ASSERT_NEAR(off(sight.mean_rad, (double)config.north_rad + 1.0), 0.0, 1e-5, "rad");
}
END_TEST

START_TEST(readings_that_stand_still_fill_one_block)
{
    set_up_defaults();
    for (int i = 0; i < 1000; i++) {
        ck_assert(!push(5.0, 45.0, 0.3));
    }
    ck_assert_uint_eq(compass.used, 1000u);
}
END_TEST

/* One stamp that leads astray must not silence the compass for the rest of the day. */
START_TEST(a_stamp_far_ahead_does_not_end_it)
{
    int full = 0;
    set_up_defaults();
    (void)push(1.0, 45.0, 0.3);
    (void)insole_phone_compass_push(&compass, UINT64_MAX, INSOLE_R(45.0), INSOLE_R(0.3));
    for (int i = 0; i < 100; i++) {
        full += push(1.1 + 0.1 * i, 45.0, 0.3) ? 1 : 0;
    }
    ck_assert_int_ge(full, 3);
    ASSERT_NEAR(off(compass.block_rad, (double)config.north_rad - 0.3), 0.0, 1e-5, "rad");
}
END_TEST

/* Four days at 100 Hz: a new direction still counts, and nothing is rounded away before. */
START_TEST(long_runs_neither_stall_nor_drift)
{
    const uint32_t count = 2000000u;
    set_up_defaults();
    for (uint32_t i = 0; i < count; i++) {
        (void)insole_phone_compass_push(&compass, 10000u * (uint64_t)i, INSOLE_R(45.0),
                                        i % 2u == 0u ? INSOLE_R(0.5) : INSOLE_R(0.7));
    }
    ASSERT_NEAR(off(compass.mean_rad, (double)config.north_rad - 0.6), 0.0, 1e-3, "rad");
    for (uint32_t i = 0; i < count; i++) {
        (void)insole_phone_compass_push(&compass, 10000u * (uint64_t)(count + i), INSOLE_R(45.0),
                                        INSOLE_R(2.0));
    }
    ASSERT_NEAR(off(compass.mean_rad, (double)config.north_rad - 2.0), 0.0, 0.02, "rad");
}
END_TEST

START_TEST(whatever_comes_in_what_goes_out_is_finite)
{
    insole_rng_t rng;
    worst_t sane = {0.0, 0.0};
    insole_rng_seed(&rng, 3u);
    set_up_defaults();
    for (int i = 0; i < 20000; i++) {
        union {
            uint32_t bits;
            float value;
        } strength = {insole_rng_bits(&rng)}, azimuth = {insole_rng_bits(&rng)};
        bool good = insole_rng_bits(&rng) % 3u == 0u;
        uint64_t t_us = (uint64_t)insole_rng_bits(&rng) << insole_rng_bits(&rng) % 32u;
        (void)insole_phone_compass_push(&compass, t_us,
                                        good ? INSOLE_R(50.0) : (insole_real_t)strength.value,
                                        (insole_real_t)azimuth.value);
        insole_phone_sight_t sight = insole_phone_compass_sight(&compass);
        worst_require(&sane,
                      fabs((double)sight.block_rad) <= 3.15 && fabs((double)sight.mean_rad) <= 3.15,
                      i);
    }
    ASSERT_ALL_HELD(sane);
    ck_assert_uint_gt(compass.used, 100u);
}
END_TEST

START_TEST(null_and_bad_settings_are_refused)
{
    set_up_defaults();
    ck_assert_int_eq(insole_phone_compass_init(NULL, &config), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(compass, insole_phone_compass_init(&compass, NULL), INSOLE_ERR_NULL);
    config.block_s = (insole_real_t)NAN;
    ASSERT_UNCHANGED(compass, insole_phone_compass_init(&compass, &config), INSOLE_ERR_VALUE);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_compass");
    suite_add(suite, "settings", every_setting_has_its_range);
    suite_add_loop(suite, "offset", offset_is_north_less_azimuth, 5);
    suite_add(suite, "circular means", means_are_those_of_a_circle);
    suite_add_loop(suite, "blocks", blocks_end_when_their_time_is_over, 4);
    suite_add(suite, "strength", fields_too_weak_or_too_strong_are_passed_over);
    suite_add_loop(suite, "bad azimuths", azimuths_that_are_none_are_passed_over, 5);
    suite_add(suite, "off", switched_off_it_knows_nothing);
    suite_add(suite, "sight", sight_tells_means_and_their_sigmas);
    suite_add(suite, "forget", forgotten_it_begins_anew);
    suite_add(suite, "time stands", readings_that_stand_still_fill_one_block);
    suite_add(suite, "stamp far ahead", a_stamp_far_ahead_does_not_end_it);
    suite_add(suite, "long run", long_runs_neither_stall_nor_drift);
    suite_add(suite, "garbage", whatever_comes_in_what_goes_out_is_finite);
    suite_add(suite, "NULL", null_and_bad_settings_are_refused);
    return suite;
}
