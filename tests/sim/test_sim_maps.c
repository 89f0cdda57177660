/* SPDX-License-Identifier: MIT */
/* The buildings of maps/: their walks stay between the walls, and they are as maps/README.md tells.
 */
#include "buildings.h"
#include "near.h"
#include "sim/grid.h"
#include "sim/scans.h"
#include "sim/trunk.h"
#include "sim/walk.h"
#include "suite.h"

static const struct {
    const char *name;
    double width_m, height_m;
    size_t aps;
    double distance_m, seconds, heard; /* median of the access points in a scan */
} maps[] = {
    {"demo", 24.6, 12.4, 7, 63.0, 68.0, 6.5},
    {"office", 43.5, 11.2, 8, 92.0, 90.0, 7.0},
    {"student_centre", 60.0, 40.0, 16, 203.0, 194.0, 10.0},
    {"exhibition_hall", 156.0, 27.0, 24, 287.0, 248.0, 14.0},
};

static const char *const errands[] = {"office/errands", "student_centre/errands",
                                      "exhibition_hall/errands"};

/* With a phone. */
static const char *const phones[] = {"office/handheld",
                                     "office/carried",
                                     "student_centre/handheld",
                                     "student_centre/carried",
                                     "exhibition_hall/handheld",
                                     "exhibition_hall/wifi_shift_1.scenario",
                                     "exhibition_hall/wifi_shift_2.scenario",
                                     "exhibition_hall/wifi_shift_3.scenario"};

static sim_walk_t *walk_in(const sim_scenario_t *scenario, uint64_t seed)
{
    sim_error_t error;
    sim_walk_t *walk = sim_walk_open(scenario, seed, &error);
    ck_assert_msg(walk != NULL, "seed %u, line %d: %s", (unsigned)seed, error.line, error.text);
    return walk;
}

static sim_point_t sensor_at(const sim_walk_t *walk, double t_s)
{
    sim_body_t body = sim_walk_body(walk);
    sim_vec3_t at = body.pose(body.state, t_s).position_m;
    sim_point_t p = {at.x, at.y};
    return p;
}

/* Walls that the sensor's way meets, in pieces of 0.1 s. */
static int walls_on_the_way(const sim_scenario_t *scenario, const sim_walk_t *walk)
{
    int met = 0;
    sim_point_t last = sensor_at(walk, 0.0);
    for (double t = 0.1; t < sim_walk_duration(walk); t += 0.1) {
        sim_point_t now = sensor_at(walk, t);
        if (hypot(now.x_m - last.x_m, now.y_m - last.y_m) > 1e-3) {
            met += walls_met(&scenario->plan, last, now);
            last = now;
        }
    }
    return met;
}

START_TEST(the_walk_of_each_map_meets_no_wall)
{
    char name[100];
    snprintf(name, sizeof name, "%s/scenario", maps[_i].name);
    sim_scenario_t scenario = scenario_of_map(name);
    for (uint64_t seed = 1; seed <= 3; seed++) {
        sim_walk_t *walk = walk_in(&scenario, seed);
        ck_assert_int_eq(walls_on_the_way(&scenario, walk), 0);
        sim_walk_close(walk);
    }
    sim_scenario_free(&scenario);
}
END_TEST

/* Across the walls it would be seen. */
START_TEST(a_walk_through_walls_would_be_seen)
{
    sim_scenario_t scenario = scenario_of_map("office/scenario");
    sim_scenario_t through = scenario_of("start,15,2,0\nwalk,41,2,1.2\n");
    sim_walk_t *walk = walk_in(&through, 1);
    ck_assert_int_eq(walls_on_the_way(&scenario, walk), 3);
    sim_walk_close(walk);
    sim_scenario_free(&through);
    sim_scenario_free(&scenario);
}
END_TEST

START_TEST(fifty_walks_of_errands_meet_no_wall)
{
    sim_scenario_t scenario = scenario_of_map(errands[_i]);
    double shortest = HUGE_VAL, longest = 0.0;
    for (uint64_t seed = 1; seed <= 17; seed++) {
        sim_walk_t *walk = walk_in(&scenario, seed);
        int met = walls_on_the_way(&scenario, walk);
        ck_assert_msg(met == 0, "%s, seed %u: %d walls", errands[_i], (unsigned)seed, met);
        shortest = fmin(shortest, sim_walk_distance(walk));
        longest = fmax(longest, sim_walk_distance(walk));
        sim_walk_close(walk);
    }
    ASSERT_AT_LEAST(shortest, 90.0, "m");
    ASSERT_AT_LEAST(longest, 1.2 * shortest, "m");
    sim_scenario_free(&scenario);
}
END_TEST

START_TEST(walks_with_a_phone_meet_no_wall)
{
    sim_scenario_t scenario = scenario_of_map(phones[_i]);
    for (uint64_t seed = 1; seed <= 3; seed++) {
        sim_walk_t *walk = walk_in(&scenario, seed);
        ck_assert_ptr_nonnull(sim_walk_phone(walk));
        int met = 0;
        sim_place_t last = sim_trunk_at(sim_walk_steps(walk), 0.0);
        for (double t = 0.1; t < sim_walk_duration(walk); t += 0.1) {
            sim_place_t now = sim_trunk_at(sim_walk_steps(walk), t);
            sim_point_t p = {last.x_m, last.y_m}, q = {now.x_m, now.y_m};
            met += hypot(q.x_m - p.x_m, q.y_m - p.y_m) > 1e-3 ? walls_met(&scenario.plan, p, q) : 0;
            last = now;
        }
        ck_assert_msg(met == 0, "%s, seed %u: %d walls", phones[_i], (unsigned)seed, met);
        ASSERT_AT_LEAST(sim_walk_distance(walk), 90.0, "m");
        sim_walk_close(walk);
    }
    sim_scenario_free(&scenario);
}
END_TEST

START_TEST(the_exhibition_has_183_reference_points)
{
    sim_scenario_t scenario = scenario_of_map("exhibition_hall/wifi_shift_survey");
    sim_list_t points;
    ck_assert(sim_reference_points(&scenario, 3.0, &points));
    ck_assert_uint_eq(points.count, 183u);
    for (size_t i = 1; i < points.count; i++) {
        const sim_point_t *a = sim_list_at(&points, i - 1), *b = sim_list_at(&points, i);
        ck_assert(a->y_m != b->y_m || fabs(b->x_m - a->x_m - 3.0) < 1e-9);
    }
    sim_list_free(&points);
    sim_scenario_free(&scenario);
}
END_TEST

START_TEST(size_access_points_and_length_are_as_told)
{
    char name[100];
    snprintf(name, sizeof name, "%s/scenario", maps[_i].name);
    sim_scenario_t scenario = scenario_of_map(name);
    sim_point_t low, high;
    ck_assert(sim_plan_box(&scenario.plan, &low, &high));
    ASSERT_NEAR(high.x_m - low.x_m, maps[_i].width_m, 1e-9, "m");
    ASSERT_NEAR(high.y_m - low.y_m, maps[_i].height_m, 1e-9, "m");
    ck_assert_uint_eq(scenario.aps.count, maps[_i].aps);
    sim_walk_t *walk = walk_in(&scenario, 1);
    ASSERT_NEAR(sim_walk_distance(walk), maps[_i].distance_m, 1.0, "m");
    ASSERT_NEAR(sim_walk_duration(walk), maps[_i].seconds, 0.05 * maps[_i].seconds, "s");
    sim_point_t begin = sensor_at(walk, 0.0), end = sensor_at(walk, sim_walk_duration(walk));
    ASSERT_NEAR(hypot(end.x_m - begin.x_m, end.y_m - begin.y_m), 0.0, 1e-3, "m");
    sim_walk_close(walk);
    sim_scenario_free(&scenario);
}
END_TEST

START_TEST(access_points_are_inside_and_tell_everything)
{
    char name[100];
    snprintf(name, sizeof name, "%s/scenario", maps[_i].name);
    sim_scenario_t scenario = scenario_of_map(name);
    for (size_t i = 0; i < scenario.aps.count; i++) {
        const sim_ap_t *ap = sim_list_at(&scenario.aps, i);
        sim_point_t at = {ap->x_m, ap->y_m};
        ck_assert_msg(sim_plan_is_inside(&scenario.plan, at), "%s", ap->id);
        ck_assert_msg(sim_plan_clearance(&scenario.plan, at, at) > 0.1, "%s is in a wall", ap->id);
        ck_assert_msg(isfinite(ap->z_m + ap->p0_dbm + ap->exponent + ap->near_dbm), "%s", ap->id);
    }
    sim_scenario_free(&scenario);
}
END_TEST

START_TEST(scans_hear_enough_to_find_the_way)
{
    char name[100];
    snprintf(name, sizeof name, "%s/scenario", maps[_i].name);
    sim_scenario_t scenario = scenario_of_map(name);
    sim_walk_t *walk = walk_in(&scenario, 1);
    sim_list_t heard;
    sim_error_t error;
    ck_assert(sim_scans_make(walk, &scenario, 1, &heard, &error));
    double scans = sim_walk_duration(walk) / scenario.settings.radio.period_s;
    ASSERT_NEAR((double)heard.count / scans, maps[_i].heard, 2.0, "access points in a scan");
    double strongest = -200.0, weakest = 0.0;
    for (size_t i = 0; i < heard.count; i++) {
        const sim_heard_t *h = sim_list_at(&heard, i);
        strongest = fmax(strongest, h->dbm);
        weakest = fmin(weakest, h->dbm);
    }
    ASSERT_NEAR(strongest, -42.0, 10.0, "dBm");
    ASSERT_NEAR(weakest, -95.0, 6.0, "dBm");
    sim_list_free(&heard);
    sim_walk_close(walk);
    sim_scenario_free(&scenario);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/maps");
    int count = (int)(sizeof maps / sizeof maps[0]);
    suite_add_loop(suite, "walls", the_walk_of_each_map_meets_no_wall, count);
    suite_add(suite, "through", a_walk_through_walls_would_be_seen);
    suite_add_loop(suite, "errands", fifty_walks_of_errands_meet_no_wall, 3);
    suite_add_loop(suite, "phones", walks_with_a_phone_meet_no_wall,
                   (int)(sizeof phones / sizeof phones[0]));
    suite_add(suite, "points", the_exhibition_has_183_reference_points);
    suite_add_loop(suite, "figures", size_access_points_and_length_are_as_told, count);
    suite_add_loop(suite, "access points", access_points_are_inside_and_tell_everything, count);
    suite_add_loop(suite, "scans", scans_hear_enough_to_find_the_way, count);
    return suite;
}
