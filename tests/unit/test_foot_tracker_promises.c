/* SPDX-License-Identifier: MIT */
#include "insole/base/snapshot.h"
#include "insole/track/foot_tracker.h"
#include "shoe.h"
#include "suite.h"

enum { KIND = 7 };

static insole_fix_t reference[SHOE_SAMPLES_MAX];
static insole_foot_tracker_t other, before;
static uint8_t saved[sizeof(insole_foot_tracker_t) + INSOLE_SNAPSHOT_HEADER_BYTES];

static void record_short(double turn_rad)
{
    walk_t walk = WALK;
    walk.turn_rad = turn_rad;
    record(&walk, 100.0, 0.0);
}

/* Keeps the fixes of a run over the whole recording. */
static uint32_t run_reference(void)
{
    run_all(&shoe, &insole_foot_tracker_defaults);
    memcpy(reference, fixes, sizeof reference);
    return fix_count;
}

START_TEST(finish_gives_one_fix_per_sample_and_only_once)
{
    insole_fix_t fix;
    record_short(0.0);
    run_all(&shoe, &insole_foot_tracker_defaults);
    ck_assert_uint_eq(fix_count, sample_count);
    for (uint32_t i = 0u; i < fix_count; i++) {
        ck_assert(fixes[i].t_us == samples[i].t_us);
    }
    before = shoe;
    ck_assert_int_eq(insole_foot_tracker_finish(&shoe), INSOLE_OK);
    ck_assert_int_eq(insole_foot_tracker_next(&shoe, &fix), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&shoe, &before, sizeof shoe);
}
END_TEST

START_TEST(nothing_in_nothing_out)
{
    insole_fix_t fix;
    set_up(&shoe, &insole_foot_tracker_defaults);
    ck_assert_int_eq(insole_foot_tracker_next(&shoe, &fix), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_foot_tracker_finish(&shoe), INSOLE_OK);
    ck_assert_int_eq(insole_foot_tracker_next(&shoe, &fix), INSOLE_ERR_STATE);
}
END_TEST

/* What comes later changes nothing that has been told; half a second is all that waits. */
START_TEST(fixes_of_a_prefix_are_a_prefix_of_the_fixes)
{
    const double share[] = {0.1, 0.25, 0.333, 0.5, 0.777, 0.95};
    record_short(0.1);
    (void)run_reference();
    uint32_t cut = (uint32_t)(share[_i] * sample_count);
    set_up(&shoe, &insole_foot_tracker_defaults);
    run(&shoe, 0u, cut);
    ck_assert_uint_le(fix_count, cut);
    ck_assert_uint_ge(fix_count + 50u, cut);
    expect_same_fixes(fixes, reference, 0u, fix_count);
    finish(&shoe);
    ck_assert_uint_eq(fix_count, cut);
}
END_TEST

START_TEST(saved_and_restored_it_goes_on_bit_for_bit)
{
    const uint32_t cuts[] = {0u, 90u, 299u, 357u, 700u, 1011u, 1500u};
    size_t used;
    record_short(0.1);
    uint32_t expected = run_reference(), cut = cuts[_i];
    set_up(&shoe, &insole_foot_tracker_defaults);
    run(&shoe, 0u, cut);
    ck_assert_int_eq(insole_snapshot_save(KIND, &shoe, sizeof shoe, saved, sizeof saved, &used),
                     INSOLE_OK);
    memset(&shoe, 0xa5, sizeof shoe);
    memset(&other, 0x5a, sizeof other);
    ck_assert_int_eq(insole_snapshot_load(KIND, &other, sizeof other, saved, used), INSOLE_OK);
    run(&other, cut, sample_count);
    finish(&other);
    ck_assert_uint_eq(fix_count, expected);
    expect_same_fixes(fixes, reference, 0u, expected);
}
END_TEST

/* Another shoe, fed in turns with other samples, is none of this one's business. */
START_TEST(instances_are_independent)
{
    insole_fix_t elsewhere;
    record_short(0.1);
    uint32_t expected = run_reference();
    set_up(&shoe, &insole_foot_tracker_defaults);
    set_up(&other, &insole_foot_tracker_defaults);
    for (uint32_t i = 0u; i < sample_count; i++) {
        insole_imu_t turned = samples[i];
        turned.gyro_radps = insole_vec3_neg(turned.gyro_radps);
        run(&shoe, i, i + 1u);
        (void)insole_foot_tracker_imu(&other, &turned);
        while (insole_foot_tracker_next(&other, &elsewhere) == INSOLE_OK) {
        }
    }
    finish(&shoe);
    ck_assert_uint_eq(fix_count, expected);
    expect_same_fixes(fixes, reference, 0u, expected);
}
END_TEST

static insole_real_t garbage(insole_rng_t *rng)
{
    const double values[] = {(double)NAN, HUGE_VAL, -HUGE_VAL, 3.0e38, -3.0e38, 1.0e4, -160.0, 0.0};
    return (insole_real_t)values[insole_rng_bits(rng) % 8u];
}

static insole_imu_t spoiled(const insole_imu_t *good, insole_rng_t *rng)
{
    insole_imu_t bad = *good;
    insole_real_t *fields[] = {&bad.accel_mps2.x, &bad.accel_mps2.y, &bad.accel_mps2.z,
                               &bad.gyro_radps.x, &bad.gyro_radps.y, &bad.gyro_radps.z};
    const int64_t shifts_us[] = {0, 1, 5000, -5000, -100000000, 1000000000, INT64_MAX};
    for (uint32_t i = insole_rng_bits(rng) % 4u; i > 0u; i--) {
        *fields[insole_rng_bits(rng) % 6u] = garbage(rng);
    }
    bad.t_us += (uint64_t)shifts_us[insole_rng_bits(rng) % 7u];
    return bad;
}

START_TEST(garbage_never_makes_a_fix_that_is_no_number)
{
    insole_rng_t rng;
    insole_fix_t fix;
    uint64_t last_us = 0u;
    insole_rng_seed(&rng, 100u + (uint32_t)_i);
    record_short(0.0);
    set_up(&shoe, &insole_foot_tracker_defaults);
    for (uint32_t i = 0u; i < 3u * sample_count; i++) {
        insole_imu_t imu = samples[i / 3u];
        if (i % 3u != 0u) {
            imu = spoiled(&imu, &rng);
        }
        insole_status_t status = insole_foot_tracker_imu(&shoe, &imu);
        ck_assert(status == INSOLE_OK);
        while (insole_foot_tracker_next(&shoe, &fix) == INSOLE_OK) {
            fix_count++;
            if (!is_sane_fix(&fix) || fix.t_us <= last_us) {
                ck_abort_msg("fix %u of sample %u", fix_count, i);
            }
            last_us = fix.t_us;
        }
    }
    ck_assert_uint_gt(fix_count, 0u);
    ck_assert_uint_gt(shoe.screen.counts.not_finite, 0u);
    ck_assert_uint_gt(shoe.screen.counts.backward, 0u);
}
END_TEST

/* The state stays as it is, but for the counter of refusals. */
static void check_refused(uint32_t counted)
{
    before.counts.refused += counted;
    ck_assert_mem_eq(&shoe, &before, sizeof shoe);
}

START_TEST(full_line_refuses_samples_until_fixes_are_taken)
{
    uint32_t i = 0u;
    record_short(0.0);
    set_up(&shoe, &insole_foot_tracker_defaults);
    while (insole_foot_tracker_imu(&shoe, &samples[i]) == INSOLE_OK) {
        i++;
    }
    ck_assert_uint_ge(i, INSOLE_STANCE_RING);
    before = shoe;
    ck_assert_int_eq(insole_foot_tracker_imu(&shoe, &samples[i]), INSOLE_ERR_ROOM);
    check_refused(1u);
    take_fixes(&shoe);
    ck_assert_uint_gt(fix_count, 0u);
    run(&shoe, i, sample_count);
    finish(&shoe);
    ck_assert_uint_eq(fix_count, sample_count);
}
END_TEST

START_TEST(after_the_finish_no_sample_is_taken)
{
    insole_imu_t late;
    record_short(0.0);
    run_all(&shoe, &insole_foot_tracker_defaults);
    late = samples[sample_count - 1u];
    late.t_us += 10000u;
    before = shoe;
    ck_assert_int_eq(insole_foot_tracker_imu(&shoe, &late), INSOLE_ERR_STATE);
    check_refused(1u);
}
END_TEST

START_TEST(bad_starts_and_settings_are_refused)
{
    insole_start_t bad;
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    record_short(0.0);
    set_up(&shoe, &insole_foot_tracker_defaults);
    run(&shoe, 0u, 800u);
    before = shoe;
    memset(&bad, 0, sizeof bad);
    bad.x_m = (insole_real_t)NAN;
    ck_assert_int_eq(insole_foot_tracker_start(&shoe, &bad), INSOLE_ERR_VALUE);
    check_refused(1u);
    bad.x_m = INSOLE_R(2.0e6);
    ck_assert_int_eq(insole_foot_tracker_start(&shoe, &bad), INSOLE_ERR_VALUE);
    check_refused(1u);
    ck_assert_int_eq(insole_foot_tracker_start(&shoe, NULL), INSOLE_ERR_NULL);
    check_refused(1u);
    config.stride.settle_s = (insole_real_t)NAN;
    ck_assert_int_eq(insole_foot_tracker_init(&shoe, &config), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_tracker_init(&shoe, NULL), INSOLE_ERR_NULL);
    check_refused(0u);
}
END_TEST

START_TEST(null_is_refused)
{
    insole_fix_t fix;
    insole_stride_t stride;
    insole_start_t start;
    memset(&start, 0, sizeof start);
    record_short(0.0);
    set_up(&shoe, &insole_foot_tracker_defaults);
    run(&shoe, 0u, 300u);
    before = shoe;
    ck_assert_int_eq(insole_foot_tracker_imu(&shoe, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_tracker_next(&shoe, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_tracker_next(&shoe, &fix), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_foot_tracker_stride(&shoe, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_tracker_stride(&shoe, &stride), INSOLE_ERR_STATE);
    check_refused(0u);
    ck_assert_int_eq(insole_foot_tracker_init(NULL, &insole_foot_tracker_defaults),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_tracker_start(NULL, &start), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_tracker_imu(NULL, samples), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_tracker_next(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_tracker_finish(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_tracker_stride(NULL, &stride), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_tracker_promises");
    suite_add(suite, "finish", finish_gives_one_fix_per_sample_and_only_once);
    suite_add(suite, "nothing", nothing_in_nothing_out);
    suite_add_loop(suite, "prefix law", fixes_of_a_prefix_are_a_prefix_of_the_fixes, 6);
    suite_add_loop(suite, "save and restore", saved_and_restored_it_goes_on_bit_for_bit, 7);
    suite_add(suite, "two instances", instances_are_independent);
    suite_add_loop(suite, "garbage", garbage_never_makes_a_fix_that_is_no_number, 20);
    suite_add(suite, "full line", full_line_refuses_samples_until_fixes_are_taken);
    suite_add(suite, "after the finish", after_the_finish_no_sample_is_taken);
    suite_add(suite, "bad starts and settings", bad_starts_and_settings_are_refused);
    suite_add(suite, "NULL", null_is_refused);
    return suite;
}
