/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_config.h"

#include <string.h>

#include "near.h"
#include "setting.h"
#include "suite.h"

static insole_phone_tracker_config_t config;

static insole_status_t judge(void)
{
    insole_phone_tracker_config_t before = config;
    insole_status_t status = insole_phone_config_check(&config);
    ck_assert_mem_eq(&config, &before, sizeof config);
    return status;
}

static void expect(insole_status_t expected, const char *name)
{
    setting_expect(judge, expected, name, 0.0);
}

START_TEST(defaults_are_in_range)
{
    config = insole_phone_tracker_defaults;
    expect(INSOLE_OK, "defaults");
}
END_TEST

#define ASSERT_SAME(part, stem)                                                                    \
    ck_assert_mem_eq(&config.part, &insole_##stem##_defaults, sizeof config.part)

/* Each list is written into the right member: none is mistaken for another. */
START_TEST(defaults_are_those_of_the_parts)
{
    config = insole_phone_tracker_defaults;
    ASSERT_SAME(screen, screen);
    ASSERT_SAME(still_bias, still_bias);
    ASSERT_SAME(attitude, attitude);
    ASSERT_SAME(walk, phone_walk);
    ASSERT_SAME(walk.step, step);
    ASSERT_SAME(walk.step_length, step_length);
    ASSERT_SAME(compass, phone_compass);
    ASSERT_SAME(auto_start, auto_start);
    ASSERT_SAME(place, phone_place);
}
END_TEST

START_TEST(every_own_key_has_its_range)
{
    config = insole_phone_tracker_defaults;
    insole_phone_tracker_config_t *part = &config;
    INSOLE_PHONE_TRACKER_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_screen_has_its_range)
{
    config = insole_phone_tracker_defaults;
    insole_screen_config_t *part = &config.screen;
    INSOLE_SCREEN_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_rest_bias_has_its_range)
{
    config = insole_phone_tracker_defaults;
    insole_still_bias_config_t *part = &config.still_bias;
    INSOLE_STILL_BIAS_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_attitude_has_its_range)
{
    config = insole_phone_tracker_defaults;
    insole_attitude_config_t *part = &config.attitude;
    INSOLE_ATTITUDE_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_steps_has_its_range)
{
    config = insole_phone_tracker_defaults;
    insole_step_config_t *part = &config.walk.step;
    INSOLE_STEP_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_walk_has_its_range)
{
    config = insole_phone_tracker_defaults;
    insole_phone_walk_config_t *part = &config.walk;
    INSOLE_PHONE_WALK_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_lengths_has_its_range)
{
    config = insole_phone_tracker_defaults;
    insole_step_length_config_t *part = &config.walk.step_length;
    INSOLE_STEP_LENGTH_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_compass_has_its_range)
{
    config = insole_phone_tracker_defaults;
    insole_phone_compass_config_t *part = &config.compass;
    INSOLE_PHONE_COMPASS_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_automatic_start_has_its_range)
{
    config = insole_phone_tracker_defaults;
    insole_auto_start_config_t *part = &config.auto_start;
    INSOLE_AUTO_START_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_place_has_its_range)
{
    config = insole_phone_tracker_defaults;
    insole_phone_place_config_t *part = &config.place;
    INSOLE_PHONE_PLACE_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

/* The suites of the parts know their own checks: none of them takes what this one refuses. */
START_TEST(parts_take_what_is_taken_here)
{
    insole_screen_t screen;
    insole_attitude_t attitude;
    insole_step_counter_t steps;
    insole_phone_compass_t compass;
    insole_auto_start_t start;
    config = insole_phone_tracker_defaults;
    config.screen.max_rate_hz = INSOLE_R(40.0);
    config.attitude.level_s = INSOLE_R(10.0);
    config.walk.step.first_steps = 8;
    config.compass.block_s = INSOLE_R(60.0);
    config.auto_start.fixes = 8;
    expect(INSOLE_OK, "ends of ranges");
    ck_assert_int_eq(insole_screen_init(&screen, &config.screen), INSOLE_OK);
    ck_assert_int_eq(insole_attitude_init(&attitude, &config.attitude), INSOLE_OK);
    ck_assert_int_eq(insole_step_init(&steps, &config.walk.step), INSOLE_OK);
    ck_assert_int_eq(insole_phone_compass_init(&compass, &config.compass), INSOLE_OK);
    ck_assert_int_eq(insole_auto_start_init(&start, &config.auto_start, NULL), INSOLE_OK);
}
END_TEST

#define EXPECT_REFUSED(member, value)                                                              \
    do {                                                                                           \
        config = insole_phone_tracker_defaults;                                                    \
        config.member = (value);                                                                   \
        expect(INSOLE_ERR_VALUE, #member);                                                         \
    } while (0)

/* Values that would break the arithmetic: written out, not taken from the lists. */
START_TEST(what_cannot_work_is_refused)
{
    EXPECT_REFUSED(walk.sigma_length_share, INSOLE_R(-0.01));
    EXPECT_REFUSED(walk.sigma_ahead_rad, INSOLE_R(-0.01));
    EXPECT_REFUSED(walk.shown_steps, 0);
    EXPECT_REFUSED(radio_late_s, INSOLE_R(-0.1));
    EXPECT_REFUSED(sigma_fix_m, INSOLE_R(1.0e20)); /* whose square is none */
    EXPECT_REFUSED(trust_sigmas, INSOLE_R(-1.0));
    EXPECT_REFUSED(trust_least_m, INSOLE_R(0.0));
    EXPECT_REFUSED(gap_s, INSOLE_R(0.0));
    EXPECT_REFUSED(lost_sigma_m, INSOLE_R(0.0));
    EXPECT_REFUSED(compass.block_s, INSOLE_R(0.0));
    EXPECT_REFUSED(compass.sigma_block_rad, INSOLE_R(0.0));
    EXPECT_REFUSED(place.sigma_walk_mps, INSOLE_R(-1.0));
    EXPECT_REFUSED(walk.step.first_steps, 9); /* more than can be held back */
    EXPECT_REFUSED(auto_start.fixes, 9);
}
END_TEST

START_TEST(nothing_is_refused)
{
    ck_assert_int_eq(insole_phone_config_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_attitude_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_length_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_compass_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_auto_start_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_place_check(NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_config");
    suite_add(suite, "defaults are in range", defaults_are_in_range);
    suite_add(suite, "defaults are those of the parts", defaults_are_those_of_the_parts);
    suite_add(suite, "own keys", every_own_key_has_its_range);
    suite_add(suite, "keys of the screen", every_key_of_the_screen_has_its_range);
    suite_add(suite, "keys of the rest bias", every_key_of_the_rest_bias_has_its_range);
    suite_add(suite, "keys of the attitude", every_key_of_the_attitude_has_its_range);
    suite_add(suite, "keys of the steps", every_key_of_the_steps_has_its_range);
    suite_add(suite, "keys of the walk", every_key_of_the_walk_has_its_range);
    suite_add(suite, "keys of the lengths", every_key_of_the_lengths_has_its_range);
    suite_add(suite, "keys of the compass", every_key_of_the_compass_has_its_range);
    suite_add(suite, "keys of the automatic start", every_key_of_the_automatic_start_has_its_range);
    suite_add(suite, "keys of the place", every_key_of_the_place_has_its_range);
    suite_add(suite, "parts take it", parts_take_what_is_taken_here);
    suite_add(suite, "what cannot work", what_cannot_work_is_refused);
    suite_add(suite, "NULL", nothing_is_refused);
    return suite;
}
