/* SPDX-License-Identifier: MIT */
#include "sim/trunk.h"

#include "near.h"
#include "sim/algebra.h"
#include "suite.h"
#include "walks.h"

START_TEST(it_stands_where_the_walker_stands)
{
    sim_walk_t *walk = walk_of("start,2,3,0.7,1\npause,4\n", 1);
    for (double t = 0.0; t < 9.0; t += 1.0) {
        sim_place_t at = sim_trunk_at(sim_walk_steps(walk), t);
        ASSERT_NEAR(hypot(at.x_m - 2.0, at.y_m - 3.0), 0.0, 1e-9, "m");
        ASSERT_NEAR(at.heading_rad, 0.7, 1e-9, "rad");
        ASSERT_NEAR(at.z_m, 1.0, 1e-9, "m");
    }
    sim_walk_close(walk);
}
END_TEST

START_TEST(it_goes_evenly_along_the_path_and_looks_ahead)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,30,0,1.3\n" EQUAL, 1);
    double duration = sim_walk_duration(walk);
    worst_t aside = {0.0, 0.0}, turned = {0.0, 0.0}, speed = {0.0, 0.0};
    for (double t = 0.0; t < duration; t += 0.05) {
        sim_place_t at = sim_trunk_at(sim_walk_steps(walk), t);
        sim_place_t next = sim_trunk_at(sim_walk_steps(walk), t + 0.05);
        worst_note(&aside, fabs(at.y_m), t);
        worst_note(&turned, fabs(at.heading_rad), t);
        if (at.x_m > 5.0 && at.x_m < 25.0) {
            worst_note(&speed, fabs((next.x_m - at.x_m) / 0.05 - 1.3), t);
        }
    }
    ASSERT_WORST(aside, 1e-9, "m");
    ASSERT_WORST(turned, 1e-9, "rad");
    ASSERT_WORST(speed, 0.05, "m/s");
    ASSERT_NEAR(sim_trunk_at(sim_walk_steps(walk), duration).x_m, 30.0, 1e-6, "m");
    sim_walk_close(walk);
}
END_TEST

START_TEST(it_never_jumps_and_stays_near_the_foot)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,6,0,1.2\nwalk,6,4,0.8\npause,3\nwalk,3,4,1.5\n"
                               "turn,1\nwalk,3,20,3\nturn,-3\n",
                               3);
    sim_body_t body = sim_walk_body(walk);
    worst_t jump = {0.0, 0.0}, turn = {0.0, 0.0}, off = {0.0, 0.0};
    sim_place_t last = sim_trunk_at(sim_walk_steps(walk), 0.0);
    for (double t = 0.0; t < sim_walk_duration(walk); t += 0.01) {
        sim_place_t at = sim_trunk_at(sim_walk_steps(walk), t);
        sim_vec3_t foot = body.pose(body.state, t).position_m;
        worst_note(&jump, hypot(at.x_m - last.x_m, at.y_m - last.y_m), t);
        worst_note(&turn, fabs(sim_wrap_pi(at.heading_rad - last.heading_rad)), t);
        worst_note(&off, hypot(at.x_m - foot.x, at.y_m - foot.y), t);
        last = at;
    }
    ASSERT_WORST(jump, 0.05, "m in 10 ms");
    ASSERT_WORST(turn, 0.05, "rad in 10 ms");
    ASSERT_WORST(off, 0.9, "m");
    sim_walk_close(walk);
}
END_TEST

START_TEST(it_waits_while_the_walker_waits)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,6,0,1.2\npause,10\nwalk,12,0,1.2\n", 1);
    int still = 0;
    for (double t = 0.0; t < sim_walk_duration(walk); t += 0.1) {
        sim_place_t at = sim_trunk_at(sim_walk_steps(walk), t);
        still += fabs(at.x_m - 6.0) < 0.02 ? 1 : 0;
    }
    ASSERT_AT_LEAST(0.1 * still, 9.8, "s");
    ASSERT_AT_MOST(0.1 * still, 12.5, "s");
    sim_walk_close(walk);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/trunk");
    suite_add(suite, "standing", it_stands_where_the_walker_stands);
    suite_add(suite, "walking", it_goes_evenly_along_the_path_and_looks_ahead);
    suite_add(suite, "no jumps", it_never_jumps_and_stays_near_the_foot);
    suite_add(suite, "pause", it_waits_while_the_walker_waits);
    return suite;
}
