/* SPDX-License-Identifier: MIT */
#include "sim/hold.h"

#include "near.h"
#include "phones.h"
#include "suite.h"

static sim_hold_t hold_of(const char *text, uint64_t seed)
{
    char whole[600];
    sim_hold_t hold;
    snprintf(whole, sizeof whole, "start,0,0,0\n%s", text);
    sim_scenario_t scenario = scenario_of(whole);
    sim_hold_init(&hold, &scenario.settings.phone, 0.9, seed);
    sim_scenario_free(&scenario);
    return hold;
}

static void assert_vec(sim_vec3_t v, double x, double y, double z, double tolerance)
{
    ASSERT_NEAR(v.x, x, tolerance, "1");
    ASSERT_NEAR(v.y, y, tolerance, "1");
    ASSERT_NEAR(v.z, z, tolerance, "1");
}

static const sim_vec3_t right = {1.0, 0.0, 0.0}, top = {0.0, 1.0, 0.0}, screen = {0.0, 0.0, 1.0};

/* Where the phone's axes lead on a trunk: ahead, left, up. */
START_TEST(each_way_turns_the_phone_as_people_do)
{
    sim_hold_t h = hold_of("phone.hold_rad = 0\nphone.tilt_rad = 0.6\n", 1);
    const sim_mat3_t *hand = &h.rest[SIM_POSE_HAND], *ear = &h.rest[SIM_POSE_EAR];
    assert_vec(sim_mat3_mul_vec(*hand, right), 0.0, -1.0, 0.0, 1e-12);
    assert_vec(sim_mat3_mul_vec(*hand, top), cos(0.6), 0.0, sin(0.6), 1e-12);
    assert_vec(sim_mat3_mul_vec(*hand, screen), -sin(0.6), 0.0, cos(0.6), 1e-12);
    assert_vec(sim_mat3_mul_vec(*ear, screen), 0.0, 1.0, 0.0, 1e-12); /* right ear: to the left */
    ASSERT_AT_LEAST(sim_mat3_mul_vec(*ear, top).z, 0.8, "1");
    ASSERT_AT_MOST(sim_mat3_mul_vec(*ear, top).x, -0.3, "1");
    assert_vec(sim_mat3_mul_vec(h.rest[SIM_POSE_SWING], top), 0.0, 0.0, -1.0, 1e-12);
    assert_vec(sim_mat3_mul_vec(h.rest[SIM_POSE_SWING], screen), 0.0, 1.0, 0.0, 1e-12);
    assert_vec(sim_mat3_mul_vec(h.rest[SIM_POSE_POCKET], top), 0.0, 0.0, 1.0, 1e-12);
    assert_vec(sim_mat3_mul_vec(h.rest[SIM_POSE_POCKET], screen), -1.0, 0.0, 0.0, 1e-12);
    h = hold_of("phone.hold_rad = 0\nphone.side = left\n", 1);
    assert_vec(sim_mat3_mul_vec(h.rest[SIM_POSE_EAR], screen), 0.0, -1.0, 0.0, 1e-12);
    assert_vec(sim_mat3_mul_vec(h.rest[SIM_POSE_SWING], screen), 0.0, -1.0, 0.0, 1e-12);
}
END_TEST

START_TEST(a_told_mounting_comes_before_everything)
{
    sim_hold_t plain = hold_of("phone.hold_rad = 0\n", 1);
    sim_hold_t turned = hold_of("phone.hold_rad = 0\nphone.yaw_rad = 1.5707963267948966\n", 1);
    for (int pose = 0; pose < SIM_POSES; pose++) { /* x leads where y led */
        sim_vec3_t y = sim_mat3_mul_vec(plain.rest[pose], top);
        sim_vec3_t x = sim_mat3_mul_vec(turned.rest[pose], right);
        assert_vec(x, y.x, y.y, y.z, 1e-12);
    }
}
END_TEST

START_TEST(random_mountings_lead_anywhere)
{
    double up = 0.0, up2 = 0.0;
    int n = 2000;
    sim_hold_t plain = hold_of("phone.hold_rad = 0\n", 1);
    for (int seed = 1; seed <= n; seed++) {
        sim_hold_t all = hold_of("phone.mounting = random\n", (uint64_t)seed);
        double z = sim_mat3_mul_vec(all.rest[SIM_POSE_HAND], top).z;
        up += z / n;
        up2 += z * z / n;
        if (seed <= 20) {
            sim_hold_t pocket =
                hold_of("phone.mounting = pocket\nphone.hold_rad = 0\n", (uint64_t)seed);
            ck_assert_mem_eq(&pocket.rest[SIM_POSE_EAR], &plain.rest[SIM_POSE_EAR],
                             sizeof(sim_mat3_t));
            ck_assert_mem_ne(&pocket.rest[SIM_POSE_POCKET], &plain.rest[SIM_POSE_POCKET],
                             sizeof(sim_mat3_t));
        }
    }
    ASSERT_NEAR(up, 0.0, 0.04, "1"); /* evenly on the sphere */
    ASSERT_NEAR(up2, 1.0 / 3.0, 0.03, "1");
}
END_TEST

START_TEST(the_hold_is_wrong_as_told)
{
    double squares = 0.0;
    int n = 1000;
    for (int seed = 1; seed <= n; seed++) {
        sim_hold_t h = hold_of("phone.hold_rad = 0.1\nphone.tilt_rad = 0\n", (uint64_t)seed);
        double yaw = atan2(-h.rest[SIM_POSE_HAND].r0.x, -h.rest[SIM_POSE_HAND].r1.x);
        squares += yaw * yaw / n;
    }
    ASSERT_NEAR(sqrt(squares), 0.1, 0.01, "rad");
}
END_TEST

/* --- in a walk --- */

#define EVEN STRAIGHT EQUAL SAME CALM

/* What the phone's turn about the left axis is at t: positive lowers what is ahead. */
static double turned_at(const sim_walk_t *walk, int32_t pose, double t)
{
    const sim_phone_t *phone = phone_of(walk);
    sim_trunk_motion_t trunk = sim_torso_at(&phone->torso, t);
    return sim_hold_at(&phone->hold, pose, &phone->torso, &trunk, t).turn_rad.y;
}

static sim_vec3_t place_at(const sim_walk_t *walk, int32_t pose, double t)
{
    const sim_phone_t *phone = phone_of(walk);
    sim_trunk_motion_t trunk = sim_torso_at(&phone->torso, t);
    return sim_hold_at(&phone->hold, pose, &phone->torso, &trunk, t).at_m;
}

/* Size of the oscillation of the turn at a number of times per stride, in the middle of the walk.
 */
static double oscillation(const sim_walk_t *walk, int32_t pose, int times)
{
    const sim_list_t *steps = &sim_walk_steps(walk)->steps;
    const sim_step_t *from = sim_list_at(steps, 20), *to = sim_list_at(steps, 40);
    double c = 0.0, s = 0.0, length = to->strike_s - from->strike_s;
    int n = 4000;
    for (int i = 0; i < n; i++) {
        double phase = 2.0 * SIM_PI * 10.0 * times * i / n; /* ten strides */
        double turn = turned_at(walk, pose, from->strike_s + length * i / n);
        c += 2.0 * turn * cos(phase) / n;
        s += 2.0 * turn * sin(phase) / n;
    }
    return hypot(c, s);
}

START_TEST(arms_and_thighs_swing_once_a_stride_hands_twice)
{
    sim_walk_t *walk = walk_of(EVEN, 1);
    double arm = oscillation(walk, SIM_POSE_SWING, 1);
    double thigh = oscillation(walk, SIM_POSE_POCKET, 1);
    ASSERT_AT_LEAST(arm, 15.0 * SIM_PI / 180.0, "rad");
    ASSERT_AT_MOST(arm, 30.0 * SIM_PI / 180.0, "rad");
    ASSERT_AT_MOST(oscillation(walk, SIM_POSE_SWING, 2), 0.1 * arm, "rad");
    ASSERT_AT_LEAST(thigh, 15.0 * SIM_PI / 180.0, "rad");
    ASSERT_AT_MOST(thigh, 40.0 * SIM_PI / 180.0, "rad");
    ASSERT_AT_LEAST(oscillation(walk, SIM_POSE_POCKET, 2), 0.1 * thigh, "rad"); /* asymmetric */
    ASSERT_AT_LEAST(oscillation(walk, SIM_POSE_HAND, 2), 0.015, "rad");
    ASSERT_AT_MOST(oscillation(walk, SIM_POSE_HAND, 1), 0.005, "rad");
    ASSERT_AT_MOST(oscillation(walk, SIM_POSE_EAR, 2), 0.03, "rad");
    sim_walk_close(walk);
}
END_TEST

START_TEST(faster_walkers_swing_more)
{
    sim_walk_t *slow = walk_of(PHONE "start,0,0,0\nwalk,50,0,0.8\n" EQUAL SAME CALM, 1);
    sim_walk_t *fast = walk_of(PHONE "start,0,0,0\nwalk,50,0,1.7\n" EQUAL SAME CALM, 1);
    ASSERT_AT_LEAST(oscillation(fast, SIM_POSE_SWING, 1),
                    1.3 * oscillation(slow, SIM_POSE_SWING, 1), "rad");
    sim_walk_close(slow);
    sim_walk_close(fast);
}
END_TEST

/* An arm goes with the other leg, a thigh with its own. */
START_TEST(limbs_of_the_two_sides_are_half_a_stride_apart)
{
    sim_walk_t *right_side = walk_of(EVEN, 1);
    sim_walk_t *left_side = walk_of(EVEN "phone.side = left\n", 1);
    for (size_t i = 20; i < 30; i++) {
        const sim_step_t *step = sim_list_at(&sim_walk_steps(right_side)->steps, i);
        double t = step->strike_s, own = step->side == SIM_SIDE_RIGHT ? 1.0 : -1.0;
        double thigh = -turned_at(right_side, SIM_POSE_POCKET, t); /* ahead is positive */
        ASSERT_AT_LEAST(thigh * own, 0.2, "rad");
        ASSERT_AT_LEAST(turned_at(left_side, SIM_POSE_POCKET, t) * own, 0.2, "rad");
        double arm = -turned_at(right_side, SIM_POSE_SWING, t + 0.08) - 0.1;
        ASSERT_AT_MOST(arm * own, -0.2, "rad");
        double across = place_at(right_side, SIM_POSE_SWING, t).y;
        ASSERT_NEAR(across, -place_at(left_side, SIM_POSE_SWING, t).y, 1e-3, "m");
    }
    sim_walk_close(right_side);
    sim_walk_close(left_side);
}
END_TEST

START_TEST(each_way_has_its_place_on_the_body)
{
    static const double height[] = {1.18, 1.60, 0.72, 0.72};
    sim_walk_t *walk = walk_of(PHONE "start,0,0,0\npause,5\n" SAME CALM, 1);
    for (int32_t pose = 0; pose < SIM_POSES; pose++) {
        sim_vec3_t at = place_at(walk, pose, 2.0);
        ASSERT_NEAR(at.z, height[pose], 0.01, "m");
        ASSERT_AT_MOST(at.y, -0.04, "m"); /* on the right */
        ASSERT_AT_LEAST(at.x, 0.0, "m");
    }
    sim_walk_close(walk);
}
END_TEST

START_TEST(a_rocking_forearm_goes_with_the_bounce)
{
    sim_walk_t *walk =
        walk_of(EVEN "phone.rock_lag_s = 0\nphone.rock = 1\nperson.nod_rad = 0\n", 1);
    const sim_phone_t *phone = phone_of(walk);
    for (double t = 20.0; t < 21.0; t += 0.05) {
        sim_trunk_motion_t trunk = sim_torso_at(&phone->torso, t);
        double z = place_at(walk, SIM_POSE_HAND, t).z;
        ASSERT_NEAR(z - 1.18, trunk.rise_m, 1e-9, "m"); /* twice what the trunk does */
        ASSERT_NEAR(turned_at(walk, SIM_POSE_HAND, t), -trunk.rise_m / 0.35, 1e-9, "rad");
    }
    sim_walk_close(walk);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/hold");
    suite_add(suite, "turns", each_way_turns_the_phone_as_people_do);
    suite_add(suite, "mounting", a_told_mounting_comes_before_everything);
    suite_add(suite, "random mounting", random_mountings_lead_anywhere);
    suite_add(suite, "error", the_hold_is_wrong_as_told);
    suite_add(suite, "rhythm", arms_and_thighs_swing_once_a_stride_hands_twice);
    suite_add(suite, "speed", faster_walkers_swing_more);
    suite_add(suite, "sides", limbs_of_the_two_sides_are_half_a_stride_apart);
    suite_add(suite, "places", each_way_has_its_place_on_the_body);
    suite_add(suite, "forearm", a_rocking_forearm_goes_with_the_bounce);
    return suite;
}
