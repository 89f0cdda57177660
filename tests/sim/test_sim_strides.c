/* SPDX-License-Identifier: MIT */
#include "sim/strides.h"

#include "near.h"
#include "suite.h"
#include "walks.h"

/* Smallest and largest pitch from one stance to the next, and where they are in the swing. */
typedef struct {
    double low, high, low_at, high_at;
} extremes_t;

static extremes_t extremes_of(const sim_walk_t *walk, const sim_stride_t *stride)
{
    extremes_t e = {0.0, 0.0, 0.0, 0.0};
    double swing = stride->strike_s - stride->lift_s;
    for (double u = -0.6; u < 1.5; u += 1e-3) {
        double pitch = sim_gait_pitch(sim_walk_gait(walk), stride->lift_s + u * swing);
        if (pitch < e.low) {
            e.low = pitch;
            e.low_at = u;
        }
        if (pitch > e.high) {
            e.high = pitch;
            e.high_at = u;
        }
    }
    return e;
}

static double length_of(const sim_stride_t *stride)
{
    return hypot(stride->to.x_m - stride->from.x_m, stride->to.y_m - stride->from.y_m);
}

static const sim_stride_t *middle_of(const sim_walk_t *walk)
{
    return stride_of(walk, stride_count(walk) / 2);
}

START_TEST(a_walking_stride_pitches_as_far_as_told)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,42,0,1.125\n" EQUAL, 1);
    const sim_stride_t *stride = middle_of(walk);
    ASSERT_NEAR(length_of(stride), 1.4, 0.02, "m");
    extremes_t e = extremes_of(walk, stride);
    ASSERT_NEAR(e.low, -1.12, 0.03, "rad");
    ASSERT_NEAR(e.high, 0.45, 0.02, "rad");
    ASSERT_NEAR(e.low_at, 0.28, 0.03, "1");
    ASSERT_NEAR(e.high_at, 0.95, 0.03, "1");
    sim_walk_close(walk);
}
END_TEST

START_TEST(shorter_strides_pitch_less)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,42,0,0.5\n" EQUAL, 1);
    const sim_stride_t *stride = middle_of(walk);
    double scale = pow(length_of(stride) / 1.4, 0.9);
    ASSERT_AT_MOST(scale, 0.75, "1");
    ASSERT_NEAR(extremes_of(walk, stride).low, -1.12 * scale, 1e-4, "rad");
    ASSERT_NEAR(extremes_of(walk, stride).high, 0.45 * scale, 1e-4, "rad");
    sim_walk_close(walk);
}
END_TEST

START_TEST(a_runner_folds_the_leg)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,60,0,3\n" EQUAL, 1);
    const sim_stride_t *stride = middle_of(walk);
    extremes_t e = extremes_of(walk, stride);
    ASSERT_NEAR(e.low, -1.15 * (0.95 + 0.40), 0.01, "rad"); /* 1.15: the largest scale */
    ASSERT_NEAR(e.high, 1.15 * 0.40, 0.01, "rad");
    ASSERT_NEAR(e.low_at, 0.365, 0.05, "1");
    sim_walk_close(walk);
}
END_TEST

START_TEST(on_stairs_the_foot_comes_down_flat)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nstairs,6,0,3.4,0.5\n" EQUAL, 1);
    const sim_stride_t *stride = middle_of(walk);
    ASSERT_AT_MOST(extremes_of(walk, stride).high, 0.1, "rad");
    ASSERT_NEAR(stride->to.z_m - stride->from.z_m, 0.34, 1e-9, "m");
    double middle = 0.5 * (stride->lift_s + stride->strike_s);
    double z = sim_gait_pose(sim_walk_gait(walk), middle).position_m.z;
    ASSERT_AT_LEAST(z, 0.5 * (stride->from.z_m + stride->to.z_m) + 0.05, "m");
    sim_walk_close(walk);
}
END_TEST

START_TEST(a_foot_rolls_over_in_stance_and_stands_flat_in_a_pause)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,20,0,1.2\npause,5\nwalk,30,0,1.2\n" EQUAL, 1);
    const sim_gait_t *gait = sim_walk_gait(walk);
    const sim_stride_t *stride = stride_of(walk, 6), *next = stride_of(walk, 7);
    const sim_transition_t *roll = &stride->pitch[SIM_ROLL];
    ASSERT_NEAR(-roll->change_rad, 0.085, 1e-9, "rad");
    ASSERT_NEAR(next->pitch_before_rad, -0.6 * 0.085, 1e-9, "rad");
    size_t number = 0;
    while (stride_of(walk, number + 1)->lift_s - stride_of(walk, number)->strike_s < 4.0) {
        number++;
    }
    double standing = stride_of(walk, number)->strike_s + 2.5;
    ASSERT_NEAR(sim_gait_pitch(gait, standing), 0.0, 1e-12, "rad");
    ASSERT_NEAR(sim_gait_pitch(gait, 1e4), 0.0, 1e-12, "rad");
    sim_walk_close(walk);
}
END_TEST

static const char *const walks[] = {
    "start,0,0,0\nwalk,20,0,1.2\nwalk,20,5,0.5\npause,1\nwalk,0,5,1.8\n",
    "start,0,0,0\nwalk,50,0,3.9\nwalk,0,1,3\n",
    "start,0,0,0\nturn,3\nstairs,-5,0,3.4,0.4\npause,0.2\nturn,0\nstairs,0,0,0,1.2\n",
    "start,0,0,0\nwalk,20,0,2.5\ngait.run_stance_share = 0.2\nwalk.time_spread = 0.2\n"};
enum { WALKS = sizeof walks / sizeof walks[0] };

START_TEST(strides_follow_each_other)
{
    sim_walk_t *walk = walk_of(walks[_i], 5);
    const sim_place_t *at = &sim_walk_gait(walk)->home;
    double free_s = 0.0;
    for (size_t i = 0; i < stride_count(walk); i++) {
        const sim_stride_t *stride = stride_of(walk, i);
        ck_assert_mem_eq(&stride->from, at, sizeof *at);
        ASSERT_AT_LEAST(stride->lift_s, free_s, "s");
        ASSERT_AT_LEAST(stride->strike_s, stride->lift_s + 0.1, "s");
        at = &stride->to;
        free_s = stride->strike_s;
    }
    sim_walk_close(walk);
}
END_TEST

START_TEST(no_heel_rises_before_the_foot_is_down)
{
    sim_walk_t *walk = walk_of(walks[_i], 5);
    for (size_t i = 0; i < stride_count(walk); i++) {
        const sim_stride_t *stride = stride_of(walk, i);
        double down_s = i == 0 ? 0.0 : stride_of(walk, i - 1)->strike_s;
        double next_s = i + 1 < stride_count(walk) ? stride_of(walk, i + 1)->lift_s : 1e9;
        for (int part = 0; part < SIM_TRANSITIONS; part++) {
            const sim_transition_t *t = &stride->pitch[part];
            ASSERT_AT_LEAST(t->begin_s, down_s - 1e-9, "s");
            ASSERT_AT_MOST(t->begin_s + t->length_s, next_s + 1e-9, "s");
            ASSERT_AT_LEAST(t->length_s, 0.01, "s");
        }
    }
    sim_walk_close(walk);
}
END_TEST

START_TEST(the_pitch_comes_back_to_where_the_stance_leaves_it)
{
    sim_walk_t *walk = walk_of(walks[_i], 5);
    for (size_t i = 0; i + 1 < stride_count(walk); i++) {
        const sim_stride_t *stride = stride_of(walk, i);
        double pitch = stride->pitch_before_rad;
        for (int part = 0; part < SIM_TRANSITIONS; part++) {
            pitch += stride->pitch[part].change_rad;
        }
        ASSERT_NEAR(pitch, stride_of(walk, i + 1)->pitch_before_rad, 1e-12, "rad");
    }
    sim_walk_close(walk);
}
END_TEST

START_TEST(strides_vary_by_as_much_as_asked)
{
    sim_walk_t *walk =
        walk_of("start,0,0,0\nwalk,1500,0,1.2\nwalk.length_spread = 0\ngait.spread = 0.1\n", 8);
    double sum = 0.0, sum2 = 0.0;
    size_t n = stride_count(walk) - 10;
    for (size_t i = 5; i < n + 5; i++) {
        double up = stride_of(walk, i)->clearance_m;
        sum += up;
        sum2 += up * up;
    }
    double mean = sum / (double)n, sigma = sqrt(sum2 / (double)n - mean * mean);
    ASSERT_NEAR(mean, 0.04, 0.0008, "m");
    ASSERT_NEAR(sigma / mean, 0.1, 0.012, "1");
    sim_walk_close(walk);
}
END_TEST

START_TEST(equal_strides_are_equal)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,40,0,1.2\n" EQUAL QUIET, 1);
    const sim_gait_t *gait = sim_walk_gait(walk);
    const sim_stride_t *a = stride_of(walk, 10), *b = stride_of(walk, 11);
    for (double t = 0.0; t < 1.2; t += 0.01) {
        sim_vec3_t p = sim_gait_pose(gait, a->lift_s + t).position_m;
        sim_vec3_t q = sim_gait_pose(gait, b->lift_s + t).position_m;
        ASSERT_NEAR(q.x - p.x, b->from.x_m - a->from.x_m, 1e-6, "m");
        ASSERT_NEAR(q.z, p.z, 1e-6, "m");
    }
    sim_walk_close(walk);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/strides");
    suite_add(suite, "walk", a_walking_stride_pitches_as_far_as_told);
    suite_add(suite, "short", shorter_strides_pitch_less);
    suite_add(suite, "run", a_runner_folds_the_leg);
    suite_add(suite, "stairs", on_stairs_the_foot_comes_down_flat);
    suite_add(suite, "stance", a_foot_rolls_over_in_stance_and_stands_flat_in_a_pause);
    suite_add_loop(suite, "order", strides_follow_each_other, WALKS);
    suite_add_loop(suite, "heel", no_heel_rises_before_the_foot_is_down, WALKS);
    suite_add_loop(suite, "pitch", the_pitch_comes_back_to_where_the_stance_leaves_it, WALKS);
    suite_add(suite, "variation", strides_vary_by_as_much_as_asked);
    suite_add(suite, "equal", equal_strides_are_equal);
    return suite;
}
