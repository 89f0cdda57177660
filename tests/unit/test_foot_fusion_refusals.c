/* SPDX-License-Identifier: MIT */
#include "fusion_walk.h"
#include "insole/track/foot_fusion.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"

/* What is no setting, no memory, no call, and no reading. */

static insole_foot_fusion_config_t config;

/* ---- refusals ---- */

static insole_fusion_memory_t memory;

static insole_status_t judge(void)
{
    return insole_foot_fusion_init(&fusion, &config, &memory, &radio.building, 1u);
}

static void begin_refusals(void)
{
    walk_round(1u);
    fusion_case_t c = told_everything();
    c.config.lag_s = 2;
    set_up(&c);
    run(&c, &fusion, 0u, 900u);
    memory = memory_of(&c);
    config = c.config;
}

START_TEST(settings_keep_to_their_ranges)
{
    begin_refusals();
    INSOLE_FOOT_FUSION_KEYS(SETTING_HAS_ENDS)
}
END_TEST

#define SPOILED(setting, status)                                                                   \
    do {                                                                                           \
        insole_foot_fusion_config_t kept_ = config;                                                \
        setting;                                                                                   \
        ASSERT_UNCHANGED(fusion, judge(), status);                                                 \
        config = kept_;                                                                            \
    } while (0)

START_TEST(bad_settings_change_nothing)
{
    begin_refusals();
    SPOILED(config.lag_s = -1, INSOLE_ERR_VALUE);
    SPOILED(config.search_sigma_m = (insole_real_t)NAN, INSOLE_ERR_VALUE);
    SPOILED(config.foot.align_s = -1, INSOLE_ERR_VALUE);
    SPOILED(config.foot.zupt_ekf.sigma_zupt_mps = -1, INSOLE_ERR_VALUE);
    SPOILED(config.particles.sigma_length_m = -1, INSOLE_ERR_VALUE);
    SPOILED(config.particles.field.cover = 0, INSOLE_ERR_VALUE);
    SPOILED(config.two_order.sigma_length_m = -1;
            config.method = INSOLE_FUSION_TWO_ORDER, INSOLE_ERR_VALUE);
    SPOILED(config.rss_fix.sigma_db = -1, INSOLE_ERR_VALUE);
    SPOILED(config.range_fix.sigma_m = 0, INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(bad_memory_changes_nothing)
{
    begin_refusals();
    insole_fusion_memory_t good = memory;
    memory.particles = NULL;
    ASSERT_UNCHANGED(fusion, judge(), INSOLE_ERR_NULL);
    memory = good;
    memory.count = 0;
    ASSERT_UNCHANGED(fusion, judge(), INSOLE_ERR_VALUE);
    memory = good;
    memory.past = NULL; /* and there is a lag */
    ASSERT_UNCHANGED(fusion, judge(), INSOLE_ERR_NULL);
    config.lag_s = 0; /* without one it is not wanted */
    ck_assert_int_eq(judge(), INSOLE_OK);
    memory = good;
    config.start_fixes = 2;
    ck_assert_int_eq(judge(), INSOLE_OK);
    memory.starter.hear = NULL;
    ASSERT_UNCHANGED(fusion, judge(), INSOLE_ERR_NULL);
    memory = good;
    memory.starter.state = NULL;
    ASSERT_UNCHANGED(fusion, judge(), INSOLE_ERR_NULL);
    config.method = INSOLE_FUSION_TWO_ORDER; /* it takes the first, whatever is set */
    ck_assert_int_eq(judge(), INSOLE_OK);
    config.method = INSOLE_FUSION_BEST;
    config.start_fixes = 1;
    ck_assert_int_eq(judge(), INSOLE_OK);
    memory.steps = NULL;
    ck_assert_int_eq(judge(), INSOLE_OK);
    config.particles.walls = INSOLE_WALLS_SOFT;
    ASSERT_UNCHANGED(fusion, judge(), INSOLE_ERR_NULL);
    memory = good;
    ck_assert_int_eq(judge(), INSOLE_OK);
}
END_TEST

START_TEST(bad_calls_change_nothing_but_their_counter)
{
    insole_fix_t fix;
    begin_refusals();
    insole_scan_t hollow = {1, NULL, 3}, scan = {1, heard[0].readings, FUSION_APS};
    insole_start_t wrong = start_at(1.0, 0.0, 0.0, 0.3);
    wrong.x_m = (insole_real_t)NAN;
    uint32_t *refused = &fusion.counts.refused, *foot = &fusion.foot.counts.refused;
    ASSERT_REFUSED(fusion, *refused, insole_foot_fusion_scan(&fusion, NULL), INSOLE_ERR_NULL);
    ASSERT_REFUSED(fusion, *refused, insole_foot_fusion_scan(&fusion, &hollow), INSOLE_ERR_NULL);
    ASSERT_REFUSED(fusion, *refused, insole_foot_fusion_ranges(&fusion, NULL, 2), INSOLE_ERR_NULL);
    ASSERT_REFUSED(fusion, *foot, insole_foot_fusion_start(&fusion, &wrong), INSOLE_ERR_VALUE);
    ASSERT_REFUSED(fusion, *foot, insole_foot_fusion_start(&fusion, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(fusion, insole_foot_fusion_imu(&fusion, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(fusion, insole_foot_fusion_next(&fusion, NULL), INSOLE_ERR_NULL);
    fusion.radio.ranges = NULL;
    ASSERT_REFUSED(fusion, *refused, insole_foot_fusion_ranges(&fusion, heard[0].ranges, 2),
                   INSOLE_ERR_STATE);
    fusion.radio.ranges = &fusion_ranges;
    fusion.building = NULL;
    ASSERT_REFUSED(fusion, *refused, insole_foot_fusion_scan(&fusion, &scan), INSOLE_ERR_STATE);
    ASSERT_REFUSED(fusion, *refused, insole_foot_fusion_ranges(&fusion, heard[0].ranges, 2),
                   INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_foot_fusion_init(NULL, &config, &memory, NULL, 1u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_fusion_init(&fusion, NULL, &memory, NULL, 1u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_fusion_init(&fusion, &config, NULL, NULL, 1u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_fusion_start(NULL, &wrong), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_fusion_imu(NULL, &samples[0]), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_fusion_scan(NULL, &scan), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_fusion_ranges(NULL, heard[0].ranges, 2), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_fusion_next(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_fusion_finish(NULL), INSOLE_ERR_NULL);
    ck_assert(!insole_foot_fusion_work(NULL, 1));
}
END_TEST

/* Samples that nobody fetches: refused when there is no room, and none of them lost before. */
START_TEST(a_full_ring_refuses_the_sample)
{
    walk_round(1u);
    fusion_case_t c = told_everything();
    set_up(&c);
    uint32_t taken = 0;
    while (insole_foot_fusion_imu(&fusion, &samples[taken]) == INSOLE_OK) {
        ck_assert_uint_lt(++taken, sample_count);
    }
    uint32_t *foot = &fusion.foot.counts.refused;
    ASSERT_REFUSED(fusion, *foot, insole_foot_fusion_imu(&fusion, &samples[taken]),
                   INSOLE_ERR_ROOM);
    take_fixes(&fusion);
    ck_assert_uint_gt(fix_count, 0);
    run(&c, &fusion, taken, sample_count);
    finish(&c, &fusion);
    ck_assert_uint_eq(fix_count, sample_count);
}
END_TEST

/* ---- whatever comes ---- */

static insole_real_t wild(double low, double high)
{
    static const double odd[] = {0.0, 1e30, -1e30, (double)NAN, HUGE_VAL, -HUGE_VAL};
    uint32_t pick = insole_rng_bits(&rng) % 40u;
    return (insole_real_t)(pick < 6u ? odd[pick] : draw_uniform(&rng, low, high));
}

static uint64_t wild_stamp(uint64_t now_us)
{
    uint32_t pick = insole_rng_bits(&rng) % 20u;
    return pick == 0u ? UINT64_MAX : pick == 1u ? 0u : now_us + pick * 50000u;
}

static void come_what_may(uint64_t now_us)
{
    heard_t *h = &heard[0];
    insole_start_t start = {
        wild_stamp(now_us), wild(80.0, 120.0), wild(30.0, 60.0), insole_rng_bits(&rng) % 2u == 0,
        wild(-4.0, 4.0),    wild(0.0, 5.0),    wild(0.0, 4.0)};
    for (uint32_t i = 0; i < FUSION_APS; i++) {
        insole_rss_t reading = {insole_rng_bits(&rng) % 15u, wild(-100.0, -20.0), 0};
        insole_range_t range = {wild_stamp(now_us), insole_rng_bits(&rng) % 15u, wild(0.0, 40.0),
                                wild(-1.0, 3.0)};
        h->readings[i] = reading;
        h->ranges[i] = range;
    }
    insole_scan_t scan = {wild_stamp(now_us), h->readings, insole_rng_bits(&rng) % FUSION_APS};
    (void)insole_foot_fusion_scan(&fusion, &scan);
    (void)insole_foot_fusion_ranges(&fusion, h->ranges, insole_rng_bits(&rng) % FUSION_APS);
    if (insole_rng_bits(&rng) % 20u == 0u) {
        (void)insole_foot_fusion_start(&fusion, &start);
    }
}

static insole_imu_t spoiled(const insole_imu_t *good)
{
    insole_imu_t bad = *good;
    if (insole_rng_bits(&rng) % 50u == 0u) {
        bad.accel_mps2.x = wild(-200.0, 200.0);
        bad.gyro_radps.z = wild(-50.0, 50.0);
    }
    return bad;
}

/* Radio, starts and samples gone wild, the work done in any portion: the fixes stay sane. */
START_TEST(garbage_never_makes_a_fix_that_is_no_number)
{
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.has_start = false;
    c.particles = 60;
    c.config.method = _i % 3;
    c.config.lag_s = _i < 3 ? 0 : 2;
    set_up(&c);
    insole_rng_seed(&rng, 200u + (uint32_t)_i);
    uint64_t last_us = 0;
    for (uint32_t i = 0; i < sample_count; i++) {
        insole_imu_t imu = spoiled(&samples[i]);
        (void)insole_foot_fusion_imu(&fusion, &imu);
        if (i % 20u == 0u) {
            come_what_may(imu.t_us);
        }
        while (insole_foot_lag_next(&waiting, &fusion, &fixes[0]) == INSOLE_OK) {
            ck_assert(is_sane_fix(&fixes[0]));
            ck_assert(c.config.method == INSOLE_FUSION_WIFI || fixes[0].t_us > last_us);
            last_us = fixes[0].t_us;
        }
        (void)insole_foot_fusion_work(&fusion, insole_rng_bits(&rng) % 400u);
    }
    ck_assert(last_us > 0);
}
END_TEST
Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_fusion_refusals");
    suite_add(suite, "settings", settings_keep_to_their_ranges);
    suite_add(suite, "bad settings", bad_settings_change_nothing);
    suite_add(suite, "bad memory", bad_memory_changes_nothing);
    suite_add(suite, "bad calls", bad_calls_change_nothing_but_their_counter);
    suite_add(suite, "full ring", a_full_ring_refuses_the_sample);
    suite_add_loop(suite, "garbage", garbage_never_makes_a_fix_that_is_no_number, 6);
    return suite;
}
