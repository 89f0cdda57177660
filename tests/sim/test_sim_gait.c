/* SPDX-License-Identifier: MIT */
#include "sim/gait.h"

#include "near.h"
#include "sim/motion.h"
#include "suite.h"
#include "walks.h"

#define MIXED                                                                                      \
    "start,0,0,0\nwalk,8,0,1.2\nwalk,8,6,0.7\npause,1\nturn,3\nwalk,-20,6,3\nstairs,-23,6,1.7,0."  \
    "5\n"

static sim_pose_t foot_pose(const void *state, double t_s)
{
    return sim_gait_pose(state, t_s);
}

/* Change of the second derivatives across t. */
static double jump_at(const sim_gait_t *gait, double t_s, double h)
{
    sim_body_t body = {foot_pose, gait};
    sim_motion_t before = sim_motion_at(&body, t_s - 3.0 * h, h, 9.81);
    sim_motion_t after = sim_motion_at(&body, t_s + 3.0 * h, h, 9.81);
    return sim_vec3_norm(sim_vec3_sub(after.force_mps2, before.force_mps2));
}

START_TEST(the_foot_lifts_and_strikes_without_a_jerk_of_acceleration)
{
    sim_walk_t *walk = walk_of(MIXED, 4);
    for (size_t i = 0; i < stride_count(walk); i++) {
        const sim_stride_t *stride = stride_of(walk, i);
        ASSERT_AT_MOST(jump_at(sim_walk_gait(walk), stride->lift_s, 2e-5), 0.5, "m/s^2");
        ASSERT_AT_MOST(jump_at(sim_walk_gait(walk), stride->strike_s, 2e-5), 0.5, "m/s^2");
    }
    sim_walk_close(walk);
}
END_TEST

START_TEST(acceleration_is_continuous_everywhere)
{
    sim_walk_t *walk = walk_of(MIXED, 4);
    sim_body_t body = {foot_pose, sim_walk_gait(walk)};
    sim_vec3_t last = sim_motion_at(&body, 2.0, 2e-4, 9.81).force_mps2;
    for (double t = 2.0; t < 20.0; t += 1e-3) {
        sim_vec3_t f = sim_motion_at(&body, t, 2e-4, 9.81).force_mps2;
        ASSERT_AT_MOST(sim_vec3_norm(sim_vec3_sub(f, last)), 25.0, "m/s^2"); /* 25,000 m/s^3 */
        last = f;
    }
    sim_walk_close(walk);
}
END_TEST

static const char *const levels[] = {
    "start,0,0,0\nwalk,15,0,1.2\n" QUIET, "start,0,0,0\nwalk,15,0,0.5\n" QUIET,
    "start,0,0,0\nwalk,15,0,1.8\n" QUIET, "start,0,0,0\nwalk,40,0,3\n" QUIET,
    "start,0,0,0\nturn,3\nwalk,-9,0.3,1\npause,1\nturn,0\n" QUIET};
enum { LEVELS = sizeof levels / sizeof levels[0] };

START_TEST(the_sole_never_goes_through_the_ground)
{
    sim_walk_t *walk = walk_of(levels[_i], 2);
    const sim_gait_t *gait = sim_walk_gait(walk);
    double highest = 0.0;
    for (double t = 0.0; t < sim_walk_duration(walk); t += 2e-3) {
        double z = sim_gait_pose(gait, t).position_m.z;
        double gap = z - sim_sole_height(&gait->sole, sim_gait_pitch(gait, t));
        ASSERT_AT_LEAST(gap, -1e-3, "m"); /* a sole gives that much */
        highest = fmax(highest, gap);
    }
    ASSERT_AT_LEAST(highest, 0.015, "m");
    ASSERT_AT_MOST(highest, 0.15, "m");
    sim_walk_close(walk);
}
END_TEST

START_TEST(a_foot_on_the_ground_does_not_slip)
{
    sim_walk_t *walk = walk_of(levels[_i], 2);
    const sim_gait_t *gait = sim_walk_gait(walk);
    for (size_t i = 0; i + 1 < stride_count(walk); i++) {
        const sim_stride_t *stride = stride_of(walk, i), *next = stride_of(walk, i + 1);
        for (double t = stride->strike_s; t < next->lift_s; t += 0.02) {
            sim_vec3_t p = sim_gait_pose(gait, t).position_m;
            sim_vec3_t rolled = sim_gait_rolled(gait, &stride->to, sim_gait_pitch(gait, t));
            ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(p, rolled)), 0.0, 1e-12, "m");
        }
    }
    sim_walk_close(walk);
}
END_TEST

START_TEST(a_flat_foot_without_roll_and_tremble_is_perfectly_still)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,15,0,1.2\ngait.flat_roll_rad = 0\n" QUIET, 2);
    const sim_gait_t *gait = sim_walk_gait(walk);
    int flat = 0, all = 0;
    for (double t = 0.0; t < sim_walk_duration(walk) - 0.01; t += 1e-2, all++) {
        if (!sim_gait_is_flat(gait, t) || !sim_gait_is_flat(gait, t + 1e-2)) {
            continue;
        }
        sim_pose_t a = sim_gait_pose(gait, t), b = sim_gait_pose(gait, t + 1e-2);
        flat++;
        ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(a.position_m, b.position_m)), 0.0, 1e-12, "m");
        ASSERT_NEAR(a.attitude.r2.x, 0.0, 1e-12, "rad");
        ASSERT_NEAR(a.attitude.r0.x, b.attitude.r0.x, 1e-12, "rad");
    }
    ASSERT_AT_LEAST((double)flat / all, 0.2, "1");
    sim_walk_close(walk);
}
END_TEST

START_TEST(in_stance_the_foot_moves_by_no_more_than_it_was_told)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,30,0,1.2\n", 2);
    const sim_gait_t *gait = sim_walk_gait(walk);
    double worst = 0.0;
    for (size_t i = 1; i + 2 < stride_count(walk); i++) {
        const sim_stride_t *stride = stride_of(walk, i), *next = stride_of(walk, i + 1);
        for (double t = stride->strike_s; t < next->lift_s; t += 5e-3) {
            if (sim_gait_is_flat(gait, t)) {
                sim_vec3_t p = sim_gait_pose(gait, t).position_m;
                sim_vec3_t place = sim_vec3(stride->to.x_m, stride->to.y_m, stride->to.z_m);
                worst = fmax(worst, sim_vec3_norm(sim_vec3_sub(p, place)));
            }
        }
    }
    /* rolling over 0.05 rad lifts the origin by up to 0.15 m x 0.05; the rest of settling and
     * ringing is below a millimetre */
    ASSERT_AT_MOST(worst, 0.008, "m");
    ASSERT_AT_LEAST(worst, 0.0005, "m");
    sim_walk_close(walk);
}
END_TEST

START_TEST(the_pose_does_not_depend_on_the_order_of_questions)
{
    sim_walk_t *walk = walk_of(MIXED, 4);
    const sim_gait_t *gait = sim_walk_gait(walk);
    sim_pose_t early = sim_gait_pose(gait, 4.321);
    sim_pose_t late = sim_gait_pose(gait, 15.0);
    sim_pose_t again = sim_gait_pose(gait, 4.321);
    ck_assert_mem_eq(&early, &again, sizeof early);
    ck_assert(late.position_m.x != early.position_m.x);
    sim_walk_close(walk);
}
END_TEST

START_TEST(before_and_after_the_walk_the_foot_stands)
{
    sim_walk_t *walk = walk_of("start,3,4,0\nwalk,13,4,1.2\n" QUIET, 4);
    const sim_gait_t *gait = sim_walk_gait(walk);
    sim_pose_t before = sim_gait_pose(gait, -100.0), after = sim_gait_pose(gait, 1000.0);
    ASSERT_NEAR(before.position_m.x, 3.0, 1e-12, "m");
    ASSERT_NEAR(before.position_m.y, 4.0 - 0.06, 1e-12, "m");
    ASSERT_NEAR(after.position_m.x, 13.0, 1e-12, "m");
    ASSERT_NEAR(after.position_m.y, 4.0 - 0.06, 1e-12, "m");
    ASSERT_NEAR(after.position_m.z, 0.0, 1e-12, "m");
    ASSERT_NEAR(atan2(after.attitude.r1.x, after.attitude.r0.x), -0.10, 1e-9, "rad");
    ck_assert(sim_gait_is_flat(gait, -1.0) && sim_gait_is_flat(gait, 1000.0));
    sim_walk_close(walk);
}
END_TEST

START_TEST(the_other_foot_can_carry_the_sensor)
{
    sim_walk_t *walk = walk_of("start,3,4,0\nwalk,13,4,1.2\ngait.foot = left\n" QUIET, 4);
    sim_pose_t before = sim_gait_pose(sim_walk_gait(walk), 0.0);
    ASSERT_NEAR(before.position_m.y, 4.0 + 0.06, 1e-12, "m");
    ASSERT_NEAR(atan2(before.attitude.r1.x, before.attitude.r0.x), 0.10, 1e-9, "rad");
    sim_walk_close(walk);
}
END_TEST

/* Largest difference of the acceleration that a setting makes. */
static double felt(const char *setting)
{
    char text[400];
    snprintf(text, sizeof text, "start,0,0,0\nwalk,15,0,1.2\n" QUIET "%s", setting);
    sim_walk_t *walk = walk_of(text, 6), *quiet = walk_of("start,0,0,0\nwalk,15,0,1.2\n" QUIET, 6);
    sim_body_t a = {foot_pose, sim_walk_gait(walk)}, b = {foot_pose, sim_walk_gait(quiet)};
    double most = 0.0;
    for (double t = 5.0; t < 10.0; t += 1e-3) {
        sim_vec3_t f = sim_motion_at(&a, t, 5e-4, 9.81).force_mps2;
        sim_vec3_t g = sim_motion_at(&b, t, 5e-4, 9.81).force_mps2;
        most = fmax(most, sim_vec3_norm(sim_vec3_sub(f, g)));
    }
    sim_walk_close(walk);
    sim_walk_close(quiet);
    return most;
}

START_TEST(ringing_and_settling_are_as_strong_as_told)
{
    double shock = felt("gait.shock_mps2 = 50\n");
    ASSERT_NEAR(shock, 0.75 * 50.0, 0.35 * 50.0, "m/s^2"); /* it dies away from its first wave on */
    ASSERT_NEAR(felt("gait.shock_mps2 = 100\n"), 2.0 * shock, 0.01 * shock, "m/s^2");
    double settle = felt("gait.settle_mps = 0.5\n");
    ASSERT_NEAR(felt("gait.settle_mps = 1\n"), 2.0 * settle, 0.05 * settle, "m/s^2");
    ASSERT_NEAR(settle, 0.5 / 0.022, 0.3 * 0.5 / 0.022, "m/s^2");
}
END_TEST

/* Root mean square of the turn rate that trembling makes between two times. */
static double tremble_rate(const sim_walk_t *walk, double from_s, double to_s)
{
    sim_body_t body = {foot_pose, sim_walk_gait(walk)};
    double sum = 0.0;
    int n = 0;
    for (double t = from_s; t < to_s; t += 1e-3, n++) {
        sim_vec3_t w = sim_motion_at(&body, t, 5e-4, 9.81).rate_radps;
        sum += sim_vec3_dot(w, w) / 3.0;
    }
    return sqrt(sum / n);
}

START_TEST(a_standing_foot_trembles_less)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,6,0,1.2\nwalk.lead_in_s = 20\n", 6);
    const sim_stride_t *stride = stride_of(walk, 0), *next = stride_of(walk, 1);
    double still = tremble_rate(walk, 1.0, 15.0);
    double middle = 0.5 * (stride->strike_s + next->lift_s);
    double walking = tremble_rate(walk, middle - 0.05, middle + 0.05);
    ASSERT_AT_LEAST(still, 5e-5 * 2.0 * SIM_PI * 2.0, "rad/s"); /* 2 to 9 Hz */
    ASSERT_AT_MOST(still, 5e-5 * 2.0 * SIM_PI * 9.0, "rad/s");
    ASSERT_AT_LEAST(walking, 10.0 * still, "rad/s");
    sim_walk_close(walk);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/gait");
    suite_add(suite, "lift and strike", the_foot_lifts_and_strikes_without_a_jerk_of_acceleration);
    suite_add(suite, "continuous", acceleration_is_continuous_everywhere);
    suite_add_loop(suite, "ground", the_sole_never_goes_through_the_ground, LEVELS);
    suite_add_loop(suite, "no slip", a_foot_on_the_ground_does_not_slip, LEVELS);
    suite_add(suite, "still", a_flat_foot_without_roll_and_tremble_is_perfectly_still);
    suite_add(suite, "stance", in_stance_the_foot_moves_by_no_more_than_it_was_told);
    suite_add(suite, "any order", the_pose_does_not_depend_on_the_order_of_questions);
    suite_add(suite, "standing", before_and_after_the_walk_the_foot_stands);
    suite_add(suite, "other foot", the_other_foot_can_carry_the_sensor);
    suite_add(suite, "shock", ringing_and_settling_are_as_strong_as_told);
    suite_add(suite, "trembling", a_standing_foot_trembles_less);
    return suite;
}
