/* SPDX-License-Identifier: MIT */
#include "insole/move/stride.h"

#include <string.h>

#include "insole/base/fastmath.h"
#include "near.h"
#include "sample.h"
#include "suite.h"

/* One foot that walks by hand; a sample each 10 ms. */
static insole_stride_counter_t counter, before;
static insole_stride_t stride;
static insole_stride_input_t foot;
static uint32_t ended;                         /* strides that were told */
static double sum_m[3], sum_turn, sum_learned; /* over them; of length / root */

static void begin(const insole_stride_config_t *config)
{
    ck_assert_int_eq(insole_stride_init(&counter, config), INSOLE_OK);
    memset(&foot, 0, sizeof foot);
    memset(&stride, 0, sizeof stride);
    foot.t_us = 1000000u;
    ended = 0u;
    sum_m[0] = sum_m[1] = sum_m[2] = sum_turn = sum_learned = 0.0;
}

static bool push(bool still, double force_mps2)
{
    foot.t_us += 10000u;
    foot.still = still;
    foot.vertical_force_mps2 = (insole_real_t)force_mps2;
    insole_status_t status = insole_stride_push(&counter, &foot, &stride);
    if (status == INSOLE_ERR_STATE) {
        return false;
    }
    ck_assert_int_eq(status, INSOLE_OK);
    ended++;
    sum_m[0] += (double)stride.displacement_m.x;
    sum_m[1] += (double)stride.displacement_m.y;
    sum_m[2] += (double)stride.displacement_m.z;
    sum_turn += (double)stride.turn_rad;
    double range = (double)stride.accel_max_mps2 - (double)stride.accel_min_mps2;
    sum_learned += (double)stride.length_m / pow(range, 0.25);
    return true;
}

static void stand(int samples)
{
    for (int i = 0; i < samples; i++) {
        (void)push(true, 9.81);
    }
}

/* Forty samples in motion; the force goes up by half of `range` and down by as much. */
static void swing(double x, double y, double z, double turn, double range)
{
    for (int i = 0; i < 40; i++) {
        foot.position_m = insole_vec3_add(
            foot.position_m,
            insole_vec3((insole_real_t)(x / 40), (insole_real_t)(y / 40), (insole_real_t)(z / 40)));
        foot.yaw_rad = insole_wrap_pi(foot.yaw_rad + (insole_real_t)(turn / 40));
        (void)push(false, 9.81 + (i == 10 ? 0.5 * range : i == 25 ? -0.5 * range : 0.0));
    }
}

START_TEST(every_stride_of_a_gait_is_counted_once)
{
    begin(&insole_stride_defaults);
    stand(100);
    for (uint32_t i = 0; i < 50; i++) {
        swing(1.4, 0.1, 0.0, 0.0, 16.0);
        ck_assert_uint_eq(ended, i);
        stand(30);
        ck_assert_uint_eq(ended, i + 1);
    }
    ck_assert_uint_eq(counter.count, 50u);
}
END_TEST

START_TEST(stride_by_hand)
{
    insole_stride_config_t config = insole_stride_defaults;
    config.k_stride = INSOLE_R(0.6);
    begin(&config);
    stand(20); /* until 1.20 s */
    swing(0.9, 1.2, 0.17, 0.5, 16.0);
    stand(12); /* from 1.61 s */
    ck_assert_uint_eq(ended, 1u);
    ck_assert_uint_eq(stride.begin_us, 1200000u);
    ck_assert_uint_eq(stride.end_us, 1610000u);
    ASSERT_NEAR(stride.length_m, 1.5, 1e-5, "m");
    ASSERT_NEAR(stride.displacement_m.z, 0.17, 1e-6, "m");
    ASSERT_NEAR(stride.heading_rad, 0.92729522, 1e-5, "rad");
    ASSERT_NEAR(stride.turn_rad, 0.5, 1e-5, "rad");
    ASSERT_NEAR(stride.accel_max_mps2, 17.81, 1e-5, "m/s2");
    ASSERT_NEAR(stride.accel_min_mps2, 1.81, 1e-5, "m/s2");
    ASSERT_NEAR(stride.model_length_m, 1.2, 1e-5, "m"); /* 0.6 * 16^(1/4) */
}
END_TEST

START_TEST(displacements_chain)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    begin(&insole_stride_defaults);
    stand(20);
    for (int i = 0; i < 300; i++) {
        insole_vec3_t d = sample_vec3(&rng, INSOLE_R(1.0)),
                      creep = sample_vec3(&rng, INSOLE_R(0.01));
        swing((double)d.x, (double)d.y, (double)d.z, (double)d.z, 9.0);
        for (int k = 1 + (int)(insole_rng_bits(&rng) % 20u); k > 0; k--) {
            foot.position_m =
                insole_vec3_add(foot.position_m, creep); /* the filter's corrections */
            stand(1);
        }
    }
    swing(0.5, 0.5, 0.0, 0.0, 9.0);
    stand(20);
    ck_assert_uint_gt(ended, 250u);
    double off[3] = {(double)foot.position_m.x - sum_m[0], (double)foot.position_m.y - sum_m[1],
                     (double)foot.position_m.z - sum_m[2]};
    ASSERT_NEAR(hypot(hypot(off[0], off[1]), off[2]), 0.0, 1e-3, "m");
    ASSERT_NEAR(insole_wrap_pi((insole_real_t)(sum_turn - (double)foot.yaw_rad)), 0.0, 1e-3, "rad");
}
END_TEST

START_TEST(turn_is_taken_the_short_way)
{
    begin(&insole_stride_defaults);
    foot.yaw_rad = INSOLE_R(3.0);
    stand(20);
    swing(1.0, 0.0, 0.0, 0.4, 16.0);
    stand(20);
    ASSERT_NEAR(stride.turn_rad, 0.4, 1e-5, "rad");
}
END_TEST

/* The first stride gives K, later ones their share: the mean at first, then a tenth. */
START_TEST(k_is_learned)
{
    begin(&insole_stride_defaults);
    stand(20);
    swing(1.2, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    ASSERT_NEAR(stride.model_length_m, 0.55 * 2.0, 1e-5, "m"); /* nothing learned yet */
    ASSERT_NEAR(counter.k, 0.6, 1e-5, "");
    swing(1.6, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    ASSERT_NEAR(stride.model_length_m, 0.6 * 2.0, 1e-5, "m");
    ASSERT_NEAR(counter.k, 0.7, 1e-5, "");
    for (int i = 2; i < 10; i++) {
        swing(1.0 + 0.1 * i, 0.0, 0.0, 0.0, 7.0 + i);
        stand(20);
    }
    ASSERT_NEAR(counter.k, sum_learned / 10.0, 1e-4, "");
    double k = (double)counter.k;
    swing(1.0, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    ASSERT_NEAR(counter.k, k + 0.1 * (0.5 - k), 1e-5, "");
    ck_assert_uint_eq(counter.learned, 11u);
}
END_TEST

START_TEST(k_that_was_told_stays)
{
    insole_stride_config_t config = insole_stride_defaults;
    config.k_stride = INSOLE_R(0.48);
    begin(&config);
    stand(20);
    for (int i = 0; i < 5; i++) {
        swing(1.0 + 0.2 * i, 0.0, 0.0, 0.0, 16.0 * (i + 1));
        stand(20);
        ASSERT_NEAR(stride.model_length_m, 0.48 * pow(16.0 * (i + 1), 0.25), 1e-5, "m");
    }
    ck_assert(counter.k == config.k_stride);
    ck_assert_uint_eq(counter.learned, 0u);
}
END_TEST

START_TEST(force_without_range_says_nothing)
{
    begin(&insole_stride_defaults);
    stand(20);
    swing(1.2, 0.0, 0.0, 0.0, 0.0);
    stand(20);
    ck_assert_uint_eq(ended, 1u);
    ASSERT_NEAR(stride.length_m, 1.2, 1e-5, "m");
    ASSERT_NEAR(stride.model_length_m, 0.0, 0.0, "m");
    ASSERT_NEAR(stride.accel_max_mps2 - stride.accel_min_mps2, 0.0, 0.0, "m/s2");
    ASSERT_NEAR(counter.k, 0.55, 1e-6, "");
}
END_TEST

START_TEST(standing_for_ever_is_no_stride)
{
    begin(&insole_stride_defaults);
    stand(20);
    swing(1.2, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    stand(360000); /* an hour */
    ck_assert_uint_eq(ended, 1u);
    swing(1.3, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    ck_assert_uint_eq(ended, 2u);
    ASSERT_NEAR(stride.length_m, 1.3, 1e-5, "m");
    ck_assert_uint_eq(stride.end_us - stride.begin_us, 410000u);
}
END_TEST

/* Stances that break into pieces, shuffling on the spot: the way is that of the whole. */
START_TEST(pieces_of_a_stance_are_one)
{
    begin(&insole_stride_defaults);
    stand(20);
    for (int i = 0; i < 10; i++) {
        swing(1.4, 0.0, 0.0, 0.0, 16.0);
        stand(3);
        swing(0.02, 0.0, 0.0, 0.0, 4.0);
        stand(12);
        swing(-0.02, 0.1, 0.0, 0.0, 4.0);
        stand(4);
    }
    ck_assert_uint_eq(ended, 10u);
    swing(1.4, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    ASSERT_NEAR(sum_m[0], 11 * 1.4, 1e-4, "m");
    ASSERT_NEAR(sum_m[1], 1.0, 1e-4, "m");
}
END_TEST

/* A stance shorter than settle_s ends the stride when it is over. */
START_TEST(short_stance_ends_a_stride_when_it_is_over)
{
    begin(&insole_stride_defaults);
    stand(20);
    swing(2.0, 0.0, 0.0, 0.0, 60.0);
    stand(5);
    ck_assert_uint_eq(ended, 0u);
    swing(2.2, 0.0, 0.0, 0.0, 60.0);
    ck_assert_uint_eq(ended, 1u);
    ASSERT_NEAR(stride.length_m, 2.0, 1e-5, "m");
    stand(20);
    ck_assert_uint_eq(ended, 2u);
    ASSERT_NEAR(stride.length_m, 2.2, 1e-5, "m");
}
END_TEST

START_TEST(restart_drops_the_stride_in_progress)
{
    begin(&insole_stride_defaults);
    stand(20);
    swing(1.2, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    swing(0.7, 0.0, 0.0, 0.0, 16.0);
    insole_stride_restart(&counter);
    foot.position_m.x += INSOLE_R(50.0);
    swing(0.7, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    ck_assert_uint_eq(ended, 1u);
    swing(1.1, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    ck_assert_uint_eq(ended, 2u);
    ASSERT_NEAR(stride.length_m, 1.1, 1e-4, "m");
    insole_stride_restart(NULL);
}
END_TEST

START_TEST(log_that_begins_in_motion_has_its_first_stride_later)
{
    begin(&insole_stride_defaults);
    swing(1.2, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    ck_assert_uint_eq(ended, 0u);
    swing(1.3, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    ck_assert_uint_eq(ended, 1u);
    ASSERT_NEAR(stride.length_m, 1.3, 1e-5, "m");
}
END_TEST

static void refuse(const insole_stride_input_t *in, insole_status_t expected)
{
    insole_stride_t kept = stride;
    before = counter;
    before.refused++;
    ck_assert_int_eq(insole_stride_push(&counter, in, &stride), expected);
    ck_assert_mem_eq(&counter, &before, sizeof counter);
    ck_assert_mem_eq(&stride, &kept, sizeof stride);
}

START_TEST(bad_samples_are_refused_and_counted)
{
    insole_stride_input_t bad;
    insole_real_t *fields[] = {&bad.position_m.x, &bad.position_m.y, &bad.position_m.z,
                               &bad.yaw_rad, &bad.vertical_force_mps2};
    begin(&insole_stride_defaults);
    stand(20);
    swing(1.2, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    for (int i = 0; i < 10; i++) {
        bad = foot;
        bad.t_us += 10000u;
        *fields[i / 2] = (insole_real_t)(i % 2 ? NAN : INFINITY);
        refuse(&bad, INSOLE_ERR_VALUE);
    }
    refuse(&foot, INSOLE_ERR_TIME);
    bad = foot;
    bad.t_us -= 1u;
    refuse(&bad, INSOLE_ERR_TIME);
    ck_assert_uint_eq(counter.refused, 12u);
    swing(1.3, 0.0, 0.0, 0.0, 16.0);
    stand(20);
    ASSERT_NEAR(stride.length_m, 1.3, 1e-5, "m");
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    insole_stride_config_t bad = insole_stride_defaults;
    begin(&insole_stride_defaults);
    stand(20);
    before = counter;
    bad.settle_s = INSOLE_R(-0.1);
    ck_assert_int_eq(insole_stride_init(&counter, &bad), INSOLE_ERR_VALUE);
    bad.settle_s = (insole_real_t)NAN;
    ck_assert_int_eq(insole_stride_init(&counter, &bad), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_stride_init(&counter, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_stride_push(&counter, NULL, &stride), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_stride_push(&counter, &foot, NULL), INSOLE_ERR_NULL);
    ck_assert_mem_eq(&counter, &before, sizeof counter);
    ck_assert_int_eq(insole_stride_push(NULL, &foot, &stride), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_stride_init(NULL, &insole_stride_defaults), INSOLE_ERR_NULL);
}
END_TEST

/* Most samples told in short: strides as if all had been pushed. */
START_TEST(samples_told_in_short_count_alike)
{
    insole_stride_counter_t brief;
    insole_stride_t told;
    insole_rng_t rng;
    insole_rng_seed(&rng, 8u);
    memset(&told, 0, sizeof told);
    begin(&insole_stride_defaults);
    brief = counter;
    uint32_t strides = 0u, short_ones = 0u, all = 0u;
    bool still = true;
    for (int left = 0; all < 20000u; all++, left--) {
        if (left == 0) {
            left = 1 + (int)(insole_rng_bits(&rng) % 60u);
            still = !still;
        }
        insole_vec3_t step = sample_vec3(&rng, still ? INSOLE_R(0.001) : INSOLE_R(0.2));
        foot.position_m = insole_vec3_add(foot.position_m, step);
        foot.yaw_rad = sample_between(&rng, INSOLE_R(-3.0), INSOLE_R(3.0));
        bool stride_ended = push(still, 9.81 + (double)step.x);
        if (insole_stride_go_on(&brief, foot.t_us, foot.vertical_force_mps2, still)) {
            ck_assert(!stride_ended);
            short_ones++;
        } else {
            insole_status_t expected = stride_ended ? INSOLE_OK : INSOLE_ERR_STATE;
            ck_assert_int_eq(insole_stride_push(&brief, &foot, &told), expected);
            if (stride_ended) {
                ck_assert_mem_eq(&told, &stride, sizeof told);
                strides++;
            }
        }
    }
    ck_assert_uint_gt(strides, 200u);
    ck_assert_uint_gt(short_ones, all / 2u);
}
END_TEST

START_TEST(what_is_not_told_in_short_leaves_no_trace)
{
    begin(&insole_stride_defaults);
    before = counter;
    ck_assert(!insole_stride_go_on(&counter, 1u, INSOLE_R(9.0), true));
    ck_assert_mem_eq(&counter, &before, sizeof counter);
    stand(3); /* not settled */
    before = counter;
    ck_assert(!insole_stride_go_on(&counter, foot.t_us + 1u, INSOLE_R(9.0), true));
    ck_assert(!insole_stride_go_on(&counter, foot.t_us + 1u, INSOLE_R(9.0), false));
    ck_assert_mem_eq(&counter, &before, sizeof counter);
    stand(30);
    ck_assert(insole_stride_go_on(&counter, foot.t_us + 1u, INSOLE_R(9.0), true));
    before = counter;
    ck_assert(!insole_stride_go_on(&counter, foot.t_us + 2u, INSOLE_R(9.0), false));
    ck_assert_mem_eq(&counter, &before, sizeof counter);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("stride");
    suite_add(suite, "count", every_stride_of_a_gait_is_counted_once);
    suite_add(suite, "by hand", stride_by_hand);
    suite_add(suite, "chain", displacements_chain);
    suite_add(suite, "turn", turn_is_taken_the_short_way);
    suite_add(suite, "K learned", k_is_learned);
    suite_add(suite, "K told", k_that_was_told_stays);
    suite_add(suite, "no range", force_without_range_says_nothing);
    suite_add(suite, "standing", standing_for_ever_is_no_stride);
    suite_add(suite, "pieces of a stance", pieces_of_a_stance_are_one);
    suite_add(suite, "short stance", short_stance_ends_a_stride_when_it_is_over);
    suite_add(suite, "restart", restart_drops_the_stride_in_progress);
    suite_add(suite, "begins in motion", log_that_begins_in_motion_has_its_first_stride_later);
    suite_add(suite, "bad samples", bad_samples_are_refused_and_counted);
    suite_add(suite, "bad arguments", bad_arguments_are_refused);
    suite_add(suite, "in short", samples_told_in_short_count_alike);
    suite_add(suite, "not in short", what_is_not_told_in_short_leaves_no_trace);
    return suite;
}
