/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_config.h"

#include "near.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"

static insole_foot_fusion_config_t config;

static insole_status_t judge(void)
{
    return insole_fusion_config_check(&config);
}

static void begin(void)
{
    config = insole_foot_fusion_defaults;
}

#define ASSERT_SAME(part, defaults) ck_assert_mem_eq(&config.part, &defaults, sizeof config.part)

START_TEST(defaults_are_those_of_the_parts)
{
    begin();
    ck_assert_int_eq(judge(), INSOLE_OK);
    ck_assert_int_eq(config.method, INSOLE_FUSION_BEST);
    ASSERT_SAME(foot, insole_foot_tracker_defaults);
    ASSERT_SAME(particles, insole_particle_filter_defaults);
    ASSERT_SAME(two_order, insole_particle_filter_two_order);
    ASSERT_SAME(rss_fix, insole_rss_fix_defaults);
    ASSERT_SAME(range_fix, insole_range_fix_defaults);
}
END_TEST

START_TEST(every_own_key_has_its_range)
{
    begin();
    INSOLE_FOOT_FUSION_KEYS(SETTING_HAS_ENDS)
}
END_TEST

#define ASSERT_SPOILED(setting)                                                                    \
    do {                                                                                           \
        begin();                                                                                   \
        setting;                                                                                   \
        ASSERT_UNCHANGED(config, judge(), INSOLE_ERR_VALUE);                                       \
    } while (0)

START_TEST(a_bad_part_spoils_the_whole)
{
    ASSERT_SPOILED(config.foot.align_s = -1);
    ASSERT_SPOILED(config.foot.zupt_ekf.sigma_zupt_mps = -1);
    ASSERT_SPOILED(config.particles.sigma_length_m = -1);
    ASSERT_SPOILED(config.particles.field.cover = 0);
    ASSERT_SPOILED(config.two_order.sigma_length_m = -1);
    ASSERT_SPOILED(config.rss_fix.sigma_db = -1);
    ASSERT_SPOILED(config.range_fix.sigma_m = 0);
    ck_assert_int_eq(insole_fusion_config_check(NULL), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(memory_must_be_there)
{
    static insole_particle_t particles[3];
    static insole_spot_t past[6];
    static insole_fusion_start_t start;
    static insole_fusion_ranges_t ranges;
    insole_foot_fusion_config_t at_once = insole_foot_fusion_defaults, late = at_once;
    late.lag_s = 2;
    insole_fusion_memory_t memory = {particles, 3, past, 2, NULL, {NULL, NULL}, NULL};
    ck_assert_int_eq(insole_fusion_memory_check(NULL, &at_once), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_memory_check(&memory, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_memory_check(&memory, &late), INSOLE_OK);
    insole_cloud_t cloud = insole_fusion_cloud(&memory);
    ck_assert(cloud.particles == particles && cloud.count == 3);
    ck_assert(cloud.past == past && cloud.past_strides == 2);
    memory.past = NULL; /* whatever its strides */
    ck_assert_uint_eq(insole_fusion_cloud(&memory).past_strides, 0);
    ck_assert_int_eq(insole_fusion_memory_check(&memory, &late), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_memory_check(&memory, &at_once), INSOLE_OK);
    at_once.start_fixes = 3;
    ck_assert_int_eq(insole_fusion_memory_check(&memory, &at_once), INSOLE_ERR_NULL);
    memory.starter = (insole_fusion_starter_t){insole_fusion_start_hear, &start};
    ck_assert_int_eq(insole_fusion_memory_check(&memory, &at_once), INSOLE_OK);
    memory.ranges = &ranges; /* not set up: nothing is behind its calls */
    ck_assert_int_eq(insole_fusion_memory_check(&memory, &at_once), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_ranges_init(&ranges), INSOLE_OK);
    ck_assert_int_eq(insole_fusion_memory_check(&memory, &at_once), INSOLE_OK);
    memory.count = 0;
    ck_assert_int_eq(insole_fusion_memory_check(&memory, &at_once), INSOLE_ERR_VALUE);
    memory.particles = NULL;
    ck_assert_int_eq(insole_fusion_memory_check(&memory, &at_once), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("fusion_config");
    suite_add(suite, "defaults", defaults_are_those_of_the_parts);
    suite_add(suite, "ranges", every_own_key_has_its_range);
    suite_add(suite, "parts", a_bad_part_spoils_the_whole);
    suite_add(suite, "memory", memory_must_be_there);
    return suite;
}
