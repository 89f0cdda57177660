/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_config.h"

#include <string.h>

#include "near.h"
#include "setting.h"
#include "suite.h"

static insole_foot_tracker_config_t config;

static insole_status_t judge(void)
{
    insole_foot_tracker_config_t before = config;
    insole_status_t status = insole_foot_config_check(&config);
    ck_assert_mem_eq(&config, &before, sizeof config);
    return status;
}

static void expect(insole_status_t expected, const char *name)
{
    setting_expect(judge, expected, name, 0.0);
}

START_TEST(defaults_are_in_range)
{
    config = insole_foot_tracker_defaults;
    expect(INSOLE_OK, "defaults");
    ck_assert_int_eq(config.method, INSOLE_FOOT_INS);
}
END_TEST

#define ASSERT_SAME(part)                                                                          \
    ck_assert_mem_eq(&config.part, &insole_##part##_defaults, sizeof config.part)

START_TEST(defaults_are_those_of_the_parts)
{
    config = insole_foot_tracker_defaults;
    ASSERT_SAME(screen);
    ASSERT_SAME(still_bias);
    ASSERT_SAME(zero_velocity);
    ASSERT_SAME(zupt_ekf);
    ASSERT_SAME(stride);
}
END_TEST

START_TEST(every_own_key_has_its_range)
{
    config = insole_foot_tracker_defaults;
    insole_foot_tracker_config_t *part = &config;
    INSOLE_FOOT_TRACKER_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_screen_has_its_range)
{
    config = insole_foot_tracker_defaults;
    insole_screen_config_t *part = &config.screen;
    INSOLE_SCREEN_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_rest_bias_has_its_range)
{
    config = insole_foot_tracker_defaults;
    insole_still_bias_config_t *part = &config.still_bias;
    INSOLE_STILL_BIAS_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_detector_has_its_range)
{
    config = insole_foot_tracker_defaults;
    insole_zero_velocity_config_t *part = &config.zero_velocity;
    INSOLE_ZERO_VELOCITY_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_filter_has_its_range)
{
    config = insole_foot_tracker_defaults;
    insole_zupt_ekf_config_t *part = &config.zupt_ekf;
    INSOLE_ZUPT_EKF_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

START_TEST(every_key_of_the_strides_has_its_range)
{
    config = insole_foot_tracker_defaults;
    insole_stride_config_t *part = &config.stride;
    INSOLE_STRIDE_KEYS(SETTING_OF_PART_HAS_ENDS)
}
END_TEST

/* Values that would break the arithmetic: written out, not taken from the lists. */
START_TEST(what_cannot_work_is_refused)
{
    config = insole_foot_tracker_defaults;
    config.align_s = INSOLE_R(-0.01);
    expect(INSOLE_ERR_VALUE, "align_s");
    config = insole_foot_tracker_defaults;
    config.lost_sigma_m = INSOLE_R(0.0);
    expect(INSOLE_ERR_VALUE, "lost_sigma_m");
    config = insole_foot_tracker_defaults;
    config.zupt_ekf.sigma_zupt_mps = INSOLE_R(0.0);
    expect(INSOLE_ERR_VALUE, "sigma_zupt_mps");
    config = insole_foot_tracker_defaults;
    config.zero_velocity.reach_s = INSOLE_R(0.6);
    expect(INSOLE_ERR_VALUE, "reach_s, longer than the delay line");
    config = insole_foot_tracker_defaults;
    config.method = 2;
    expect(INSOLE_ERR_VALUE, "method");
}
END_TEST

START_TEST(nothing_is_refused)
{
    ck_assert_int_eq(insole_foot_config_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_screen_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_still_bias_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zero_velocity_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_ekf_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_stride_check(NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_config");
    suite_add(suite, "defaults are in range", defaults_are_in_range);
    suite_add(suite, "defaults are those of the parts", defaults_are_those_of_the_parts);
    suite_add(suite, "own keys", every_own_key_has_its_range);
    suite_add(suite, "keys of the screen", every_key_of_the_screen_has_its_range);
    suite_add(suite, "keys of the rest bias", every_key_of_the_rest_bias_has_its_range);
    suite_add(suite, "keys of the detector", every_key_of_the_detector_has_its_range);
    suite_add(suite, "keys of the filter", every_key_of_the_filter_has_its_range);
    suite_add(suite, "keys of the strides", every_key_of_the_strides_has_its_range);
    suite_add(suite, "what cannot work", what_cannot_work_is_refused);
    suite_add(suite, "NULL", nothing_is_refused);
    return suite;
}
