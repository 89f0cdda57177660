/* SPDX-License-Identifier: MIT */
#include "sim/route.h"

#include "near.h"
#include "scenarios.h"
#include "sim/algebra.h"
#include "suite.h"

typedef struct {
    sim_scenario_t scenario;
    sim_route_t route;
} plan_t;

static plan_t plan_of(const char *text)
{
    plan_t plan = {.scenario = scenario_of(text)};
    sim_error_t error;
    bool done =
        sim_route_plan(&plan.scenario.orders, &plan.scenario.settings.walk, &plan.route, &error);
    ck_assert_msg(done, "line %d: %s", error.line, error.text);
    return plan;
}

static void free_plan(plan_t *plan)
{
    sim_route_free(&plan->route);
    sim_scenario_free(&plan->scenario);
}

static const sim_section_t *section_at(const plan_t *plan, size_t number)
{
    const sim_section_t *section = sim_list_at(&plan->route.sections, number);
    ck_assert_ptr_nonnull(section);
    return section;
}

static void assert_kinds(const plan_t *plan, const char *kinds)
{
    static const char letters[] = "STWC"; /* stand, turn, walk, climb */
    char found[32] = "";
    for (size_t i = 0; i < plan->route.sections.count && i < sizeof found - 1; i++) {
        found[i] = letters[section_at(plan, i)->kind];
        found[i + 1] = '\0';
    }
    ck_assert_str_eq(found, kinds);
}

START_TEST(a_straight_walk_is_one_line)
{
    plan_t plan = plan_of("start,1,2,0,5\nwalk,4,6,1.2\n");
    assert_kinds(&plan, "TW");
    const sim_section_t *walk = section_at(&plan, 1);
    ASSERT_NEAR(walk->length_m, 5.0, 1e-12, "m");
    ASSERT_NEAR(plan.route.length_m, 5.0, 1e-12, "m");
    ASSERT_NEAR(walk->end_speed_mps, 0.0, 0.0, "m/s");
    sim_place_t middle = sim_route_at(&plan.route, walk, 2.5);
    ASSERT_NEAR(middle.x_m, 2.5, 1e-12, "m");
    ASSERT_NEAR(middle.y_m, 4.0, 1e-12, "m");
    ASSERT_NEAR(middle.z_m, 5.0, 1e-12, "m");
    ASSERT_NEAR(middle.heading_rad, atan2(4.0, 3.0), 1e-12, "rad");
    free_plan(&plan);
}
END_TEST

/* Corners of all kinds, left and right, with short and long legs. */
static const char *const ways[] = {
    "start,0,0,0\nwalk,10,0,1.2\nwalk,10,8,1.2\nwalk,3,8,1.4\n",
    "start,0,0,0\nwalk,5,0,1\nwalk,5,-1,1\nwalk,5.4,-1,1\nwalk,9,3,1\n",
    "start,0,0,1.5707963\nwalk,0,2,1\nwalk,1,4,1\nwalk,0,6,1\nwalk,0,9,2.5\n",
    "start,5,5,3.1\nwalk,0,5,1.2\nwalk,-4,5.001,1.2\nwalk,-9,1,1.2\nwalk.turn_radius_m = 3\n"};

START_TEST(the_path_is_continuous_and_as_long_as_it_says)
{
    plan_t plan = plan_of(ways[_i]);
    const sim_section_t *walk = section_at(&plan, plan.route.sections.count - 1);
    double step = walk->length_m / 4000.0, sum = 0.0;
    sim_place_t last = sim_route_at(&plan.route, walk, 0.0);
    double most_turn = 0.0;
    for (int i = 1; i <= 4000; i++) {
        sim_place_t at = sim_route_at(&plan.route, walk, i * step);
        sum += hypot(at.x_m - last.x_m, at.y_m - last.y_m);
        most_turn = fmax(most_turn, fabs(at.heading_rad - last.heading_rad));
        double way = atan2(at.y_m - last.y_m, at.x_m - last.x_m);
        ASSERT_NEAR(sim_wrap_pi(way - last.heading_rad), 0.0, 0.05, "rad");
        last = at;
    }
    ASSERT_NEAR(sum, walk->length_m, 1e-4 * sum, "m");
    ASSERT_AT_MOST(most_turn, 0.1, "rad");
    free_plan(&plan);
}
END_TEST

START_TEST(the_path_ends_at_the_last_waypoint)
{
    plan_t plan = plan_of(ways[_i]);
    const sim_section_t *walk = section_at(&plan, plan.route.sections.count - 1);
    const sim_order_t *last = sim_list_at(&plan.scenario.orders, plan.scenario.orders.count - 1);
    ASSERT_NEAR(walk->to.x_m, last->x_m, 1e-9, "m");
    ASSERT_NEAR(walk->to.y_m, last->y_m, 1e-9, "m");
    free_plan(&plan);
}
END_TEST

START_TEST(a_corner_is_an_arc_of_the_radius_asked_for)
{
    plan_t plan = plan_of("start,0,0,0\nwalk,10,0,1.2\nwalk,10,10,1.2\n");
    assert_kinds(&plan, "W");
    const sim_section_t *walk = section_at(&plan, 0);
    ck_assert_uint_eq(walk->pieces, 3u);
    const sim_piece_t *arc = sim_list_at(&plan.route.pieces, 1);
    ASSERT_NEAR(arc->curvature, 1.0 / 0.6, 1e-9, "1/m");
    ASSERT_NEAR(arc->length_m, 0.6 * 0.5 * SIM_PI, 1e-9, "m");
    ASSERT_NEAR(arc->speed_mps, sqrt(1.8 * 0.6), 1e-9, "m/s");
    /* nearest to the corner: r (sqrt 2 - 1) */
    sim_place_t at = sim_route_at(&plan.route, walk, arc->begin_m + 0.5 * arc->length_m);
    ASSERT_NEAR(hypot(at.x_m - 10.0, at.y_m), 0.6 * (sqrt(2.0) - 1.0), 1e-9, "m");
    free_plan(&plan);
}
END_TEST

START_TEST(the_walker_slows_down_in_time)
{
    plan_t plan = plan_of("start,0,0,0\nwalk,10,0,2\nwalk,10,10,1.2\n");
    const sim_section_t *walk = section_at(&plan, 0);
    double arc = 10.0 - 0.6, slow = sqrt(1.8 * 0.6);
    ASSERT_NEAR(sim_route_speed(&plan.route, walk, 0.0, 1.0), 2.0, 1e-12, "m/s");
    ASSERT_NEAR(sim_route_speed(&plan.route, walk, arc - 1.0, 1.0), sqrt(slow * slow + 2.0), 1e-9,
                "m/s");
    ASSERT_NEAR(sim_route_speed(&plan.route, walk, arc + 0.1, 1.0), slow, 1e-9, "m/s");
    double end = walk->length_m;
    ASSERT_NEAR(sim_route_speed(&plan.route, walk, end - 0.18, 1.0), 0.6, 1e-9, "m/s");
    ASSERT_NEAR(sim_route_speed(&plan.route, walk, end, 1.0), 0.0, 1e-9, "m/s");
    free_plan(&plan);
}
END_TEST

START_TEST(sharp_bends_are_turned_on_the_spot)
{
    plan_t plan = plan_of("start,0,0,0\nwalk,5,0,1\nwalk,0,0.5,1\nturn,0\npause,2\nturn,0.01\n");
    assert_kinds(&plan, "WTWTS");
    ASSERT_NEAR(section_at(&plan, 0)->to.x_m, 5.0, 1e-12, "m");
    const sim_section_t *turn = section_at(&plan, 1);
    ASSERT_NEAR(turn->to.heading_rad, SIM_PI - atan2(0.5, 5.0), 1e-9, "rad");
    ASSERT_NEAR(section_at(&plan, 4)->seconds, 2.0, 0.0, "s");
    free_plan(&plan);
}
END_TEST

START_TEST(turns_go_the_short_way)
{
    plan_t plan = plan_of("start,0,0,3\nturn,-3\nturn,1\nturn,-2\n");
    assert_kinds(&plan, "TTT");
    double turns[3];
    for (size_t i = 0; i < 3; i++) {
        turns[i] = section_at(&plan, i)->to.heading_rad - section_at(&plan, i)->from.heading_rad;
    }
    ASSERT_NEAR(turns[0], 2.0 * SIM_PI - 6.0, 1e-9, "rad");
    ASSERT_NEAR(turns[1], 4.0 - 2.0 * SIM_PI, 1e-9, "rad");
    ASSERT_NEAR(turns[2], -3.0, 1e-9, "rad");
    free_plan(&plan);
}
END_TEST

START_TEST(stairs_in_line_are_taken_without_a_stop)
{
    plan_t plan = plan_of("start,0,0,0\nwalk,5,0,1.2\nstairs,8,0,1.7,0.6\nwalk,10,0,1.2\n"
                          "stairs,10,3,0,0.5\n");
    assert_kinds(&plan, "WCWTC");
    ASSERT_NEAR(section_at(&plan, 0)->end_speed_mps, 0.6, 1e-12, "m/s");
    ASSERT_NEAR(section_at(&plan, 1)->end_speed_mps, 0.6, 1e-12, "m/s");
    ASSERT_NEAR(section_at(&plan, 2)->end_speed_mps, 0.0, 1e-12, "m/s");
    ASSERT_NEAR(section_at(&plan, 1)->to.z_m, 1.7, 1e-12, "m");
    ASSERT_NEAR(section_at(&plan, 2)->from.z_m, 1.7, 1e-12, "m");
    ASSERT_NEAR(section_at(&plan, 4)->to.z_m, 0.0, 1e-12, "m");
    ASSERT_NEAR(plan.route.length_m, 13.0, 1e-9, "m");
    free_plan(&plan);
}
END_TEST

static const struct {
    const char *text;
    int line;
    const char *says;
} refusals[] = {
    {"start,0,0,0\nwalk,0,0,1\n", 2, "0.00 m from where the walker is, expected at least 0.3 m"},
    {"start,0,0,0\nwalk,5,0,1\n\nwalk,5,0.2,1\n", 4, "0.20 m from where"},
    {"start,0,0,0\nstairs,1,0,1.7,1\n", 2, "10 stairs of 0.10 m depth, expected a depth from 0.2"},
    {"start,0,0,0\nstairs,3,0,0,1\n", 2, "1 stairs of 3.00 m depth"},
    {"start,0,0,0,1.7\nwalk,3,0,1\nstairs,3,0,0,1\n", 3, "10 stairs of 0.00 m depth"},
};

START_TEST(orders_that_cannot_be_walked_are_refused)
{
    sim_scenario_t scenario = scenario_of(refusals[_i].text);
    sim_route_t route;
    sim_error_t error;
    ck_assert(!sim_route_plan(&scenario.orders, &scenario.settings.walk, &route, &error));
    ck_assert_msg(strstr(error.text, refusals[_i].says) != NULL, "says: %s", error.text);
    ck_assert_int_eq(error.line, refusals[_i].line);
    ck_assert_ptr_null(route.sections.items);
    ck_assert_ptr_null(route.pieces.items);
    sim_scenario_free(&scenario);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/route");
    int count = (int)(sizeof ways / sizeof ways[0]);
    suite_add(suite, "straight", a_straight_walk_is_one_line);
    suite_add_loop(suite, "continuous", the_path_is_continuous_and_as_long_as_it_says, count);
    suite_add_loop(suite, "end", the_path_ends_at_the_last_waypoint, count);
    suite_add(suite, "corner", a_corner_is_an_arc_of_the_radius_asked_for);
    suite_add(suite, "speed", the_walker_slows_down_in_time);
    suite_add(suite, "sharp bends", sharp_bends_are_turned_on_the_spot);
    suite_add(suite, "short way", turns_go_the_short_way);
    suite_add(suite, "stairs", stairs_in_line_are_taken_without_a_stop);
    suite_add_loop(suite, "refusals", orders_that_cannot_be_walked_are_refused,
                   (int)(sizeof refusals / sizeof refusals[0]));
    return suite;
}
