/* SPDX-License-Identifier: MIT */
#include "sim/torso.h"

#include "near.h"
#include "phones.h"
#include "sim/trunk.h"
#include "suite.h"

#define DO_NOTHING                                                                                 \
    "person.bounce = 0\nperson.sway_m = 0\nperson.lean_rad = 0\nperson.nod_rad = 0\n"              \
    "person.twist_rad = 0\nperson.strike_mps2 = 0\n"

static const sim_torso_t *torso_of(const sim_walk_t *walk)
{
    return &phone_of(walk)->torso;
}

/* Second derivative of the place, by differences of 1 ms. */
static sim_vec3_t acceleration(const sim_torso_t *torso, double t)
{
    sim_vec3_t p[5];
    for (int i = 0; i < 5; i++) {
        p[i] = sim_torso_at(torso, t + 1e-3 * (i - 2)).position_m;
    }
    return sim_vec3_second_derivative(p, 1e-3);
}

START_TEST(its_way_is_that_of_the_trunk_without_corners_in_time)
{
    sim_walk_t *walk = walk_of(CORNERS DO_NOTHING, 2);
    worst_t off = {0.0, 0.0}, turned = {0.0, 0.0}, hurry = {0.0, 0.0};
    for (double t = 0.0; t < sim_walk_duration(walk); t += 0.02) {
        sim_trunk_motion_t now = sim_torso_at(torso_of(walk), t);
        sim_place_t trunk = sim_trunk_at(sim_walk_steps(walk), t);
        worst_note(&off, hypot(now.position_m.x - trunk.x_m, now.position_m.y - trunk.y_m), t);
        worst_note(&turned, fabs(sim_wrap_pi(now.heading_rad - trunk.heading_rad)), t);
        worst_note(&hurry, sim_vec3_norm(acceleration(torso_of(walk), t)), t);
        ASSERT_NEAR(now.position_m.z, trunk.z_m, 1e-9, "m");
    }
    ASSERT_WORST(off, 0.08, "m");
    ASSERT_WORST(turned, 0.15, "rad");
    ASSERT_WORST(hurry, 4.0, "m/s^2");
    sim_walk_close(walk);
}
END_TEST

START_TEST(a_standing_trunk_does_not_move)
{
    sim_walk_t *walk = walk_of(PHONE "start,2,3,0.7,1\npause,4\nwalk,6,3,1\npause,6\n", 1);
    const sim_list_t *steps = &sim_walk_steps(walk)->steps;
    const sim_step_t *first = sim_list_at(steps, 2), *last = sim_list_at(steps, steps->count - 1);
    for (double t = 0.0; t < first->strike_s - first->pace_s - 0.5; t += 0.1) {
        sim_trunk_motion_t now = sim_torso_at(torso_of(walk), t);
        ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(now.position_m, sim_vec3(2.0, 3.0, 1.0))), 0.0,
                    1e-12, "m");
        ASSERT_NEAR(now.heading_rad, 0.7, 1e-12, "rad");
        ASSERT_NEAR(sim_vec3_norm(now.turn_rad), 0.0, 0.0, "rad");
    }
    for (double t = last->strike_s + 2.0; t < sim_walk_duration(walk); t += 0.1) {
        sim_trunk_motion_t now = sim_torso_at(torso_of(walk), t);
        ASSERT_NEAR(hypot(now.position_m.x - 6.0, now.position_m.y - 3.0), 0.0, 1e-9, "m");
        ASSERT_NEAR(now.position_m.z, 1.0, 1e-9, "m");
        ASSERT_NEAR(now.size, 0.0, 0.0, "1");
    }
    sim_walk_close(walk);
}
END_TEST

/* Highest less lowest between two strikes in the middle of a walk. */
static double bounce_of(const char *text, double *step_m)
{
    sim_walk_t *walk = walk_of(text, 1);
    const sim_list_t *steps = &sim_walk_steps(walk)->steps;
    size_t middle = steps->count / 2;
    const sim_step_t *a = sim_list_at(steps, middle), *b = sim_list_at(steps, middle + 1);
    double high = -10.0, low = 10.0;
    for (double t = a->strike_s; t <= b->strike_s; t += 1e-3) {
        double z = sim_torso_at(torso_of(walk), t).position_m.z;
        high = fmax(high, z);
        low = fmin(low, z);
    }
    *step_m = fabs(b->place.x_m - a->place.x_m);
    sim_walk_close(walk);
    return high - low;
}

static const double speeds[] = {0.8, 1.0, 1.3, 1.6, 1.8};

/* Stiff legs that change at once would rise and fall by l - sqrt(l^2 - L^2/4); the softer the
 * change of feet, the less is left of it. */
START_TEST(bounce_is_that_of_an_inverted_pendulum)
{
    char text[600];
    double step_m;
    for (int handover = 1; handover <= 4; handover += 3) {
        snprintf(text, sizeof text,
                 PHONE "start,0,0,0\nwalk,40,0,%g\nperson.bounce = 1\nperson.strike_mps2 = 0\n"
                       "gait.width_m = 0\nperson.handover = 0.%d\n" EQUAL SAME,
                 speeds[_i], handover);
        double bounce = bounce_of(text, &step_m);
        double stiff = 0.9 - sqrt(0.81 - 0.25 * step_m * step_m);
        ASSERT_AT_MOST(bounce, stiff, "m");
        ASSERT_AT_LEAST(bounce, (handover == 1 ? 0.9 : 0.5) * stiff, "m");
    }
}
END_TEST

START_TEST(longer_legs_and_softer_knees_bounce_less)
{
    double step_m;
    double usual = bounce_of(STRAIGHT EQUAL SAME "person.strike_mps2 = 0\n", &step_m);
    double stiff =
        bounce_of(STRAIGHT EQUAL SAME "person.strike_mps2 = 0\nperson.bounce = 0.9\n", &step_m);
    double tall =
        bounce_of(STRAIGHT EQUAL SAME "person.strike_mps2 = 0\nperson.leg_m = 1.1\n", &step_m);
    ASSERT_NEAR(stiff / usual, 1.5, 0.01, "1");
    ASSERT_NEAR(tall / usual, 0.9 / 1.1, 0.03, "1");
    ASSERT_AT_LEAST(usual, 0.02, "m"); /* people: 2 to 6 cm */
    ASSERT_AT_MOST(usual, 0.06, "m");
}
END_TEST

START_TEST(it_is_low_at_strikes_and_high_between_and_fast_when_low)
{
    sim_walk_t *walk = walk_of(STRAIGHT EQUAL SAME "person.strike_mps2 = 0\n", 1);
    const sim_torso_t *torso = torso_of(walk);
    for (size_t i = 20; i < 40; i++) {
        const sim_step_t *step = sim_list_at(&sim_walk_steps(walk)->steps, i);
        double strike = step->strike_s, between = strike + 0.5 * step->pace_s;
        double low = sim_torso_at(torso, strike).position_m.z;
        double high = sim_torso_at(torso, between).position_m.z;
        ASSERT_AT_LEAST(high - low, 0.02, "m");
        double fast = sim_torso_at(torso, strike + 0.01).position_m.x -
                      sim_torso_at(torso, strike - 0.01).position_m.x;
        double slow = sim_torso_at(torso, between + 0.01).position_m.x -
                      sim_torso_at(torso, between - 0.01).position_m.x;
        ASSERT_AT_LEAST((fast - slow) / 0.02, 0.03, "m/s");
        ASSERT_AT_MOST((fast - slow) / 0.02, 0.4, "m/s");
    }
    sim_walk_close(walk);
}
END_TEST

START_TEST(it_sways_over_the_foot_that_carries)
{
    sim_walk_t *walk = walk_of(STRAIGHT EQUAL SAME, 1);
    for (size_t i = 20; i < 40; i++) {
        const sim_step_t *step = sim_list_at(&sim_walk_steps(walk)->steps, i);
        double t = step->strike_s + 0.5 * step->pace_s;
        sim_trunk_motion_t now = sim_torso_at(torso_of(walk), t);
        ASSERT_AT_LEAST(now.position_m.y * step->side, 0.01, "m");
        ASSERT_AT_MOST(now.position_m.y * step->side, 0.03, "m");
        ASSERT_AT_MOST(now.turn_rad.x * step->side, -0.01, "rad"); /* leans there */
        int swings = step->side == SIM_SIDE_LEFT ? SIM_RIGHT : SIM_LEFT;
        ASSERT_AT_LEAST(now.lift[swings], 0.8, "1");
        ASSERT_NEAR(now.lift[1 - swings], 0.0, 1e-6, "1");
        /* at the strike that leg is ahead */
        double ahead = sim_torso_at(torso_of(walk), step->strike_s).thigh_rad * step->side;
        ASSERT_NEAR(ahead, asin(0.5 * 0.75 / 0.9), 0.06, "rad");
    }
    sim_walk_close(walk);
}
END_TEST

START_TEST(strikes_ring_and_die_away)
{
    sim_walk_t *walk = walk_of(STRAIGHT EQUAL SAME, 1);
    const sim_step_t *step = sim_list_at(&sim_walk_steps(walk)->steps, 30);
    int foot = step->side == SIM_SIDE_LEFT ? SIM_LEFT : SIM_RIGHT;
    double peak = 0.0;
    for (double t = step->strike_s; t < step->strike_s + 0.3; t += 1e-3) {
        double ring[3];
        for (int i = 0; i < 3; i++) {
            ring[i] = sim_torso_at(torso_of(walk), t + 1e-3 * (i - 1)).jolt_s2[foot];
        }
        peak = fmax(peak, fabs(ring[0] - 2.0 * ring[1] + ring[2]) * 1e6);
    }
    ASSERT_NEAR(peak, 0.4, 0.05, "1"); /* of 1 m/s^2 the decay leaves this */
    double size = sim_torso_at(torso_of(walk), step->strike_s + 0.04).jolt_s2[foot];
    double left = sim_torso_at(torso_of(walk), step->strike_s + 0.45).jolt_s2[foot];
    ASSERT_AT_MOST(fabs(left / size), 0.01, "1");
    sim_walk_close(walk);
}
END_TEST

static const char *const smooth[] = {
    CORNERS, STRAIGHT,
    PHONE "start,0,0,0\nwalk,3,0,1\nwalk,20,0,3.5\nwalk,30,0,1.1\nstairs,34,0,2,0.6\n"
          "walk,40,0,1.3\nwalk,34,0,1.2\nturn,-3\n"};

/* No jump in place, speed and acceleration: in half a millisecond nothing changes much. */
START_TEST(it_moves_smoothly)
{
    sim_walk_t *walk = walk_of(smooth[_i], 3);
    worst_t jump = {0.0, 0.0}, size = {0.0, 0.0};
    sim_vec3_t last = acceleration(torso_of(walk), 0.0);
    for (double t = 0.0; t < sim_walk_duration(walk); t += 5e-4) {
        sim_vec3_t a = acceleration(torso_of(walk), t);
        worst_note(&jump, sim_vec3_norm(sim_vec3_sub(a, last)), t);
        worst_note(&size, sim_vec3_norm(a), t);
        last = a;
    }
    ASSERT_WORST(jump, 0.5, "m/s^2 in 0.5 ms");
    ASSERT_WORST(size, 25.0, "m/s^2");
    sim_walk_close(walk);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/torso");
    suite_add(suite, "way", its_way_is_that_of_the_trunk_without_corners_in_time);
    suite_add(suite, "standing", a_standing_trunk_does_not_move);
    suite_add_loop(suite, "pendulum", bounce_is_that_of_an_inverted_pendulum, 5);
    suite_add(suite, "people", longer_legs_and_softer_knees_bounce_less);
    suite_add(suite, "surge", it_is_low_at_strikes_and_high_between_and_fast_when_low);
    suite_add(suite, "sway", it_sways_over_the_foot_that_carries);
    suite_add(suite, "ringing", strikes_ring_and_die_away);
    suite_add_loop(suite, "smooth", it_moves_smoothly, 3);
    return suite;
}
