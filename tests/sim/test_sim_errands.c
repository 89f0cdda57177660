/* SPDX-License-Identifier: MIT */
#include "sim/errands.h"

#include "buildings.h"
#include "near.h"
#include "sim/grid.h"
#include "suite.h"

#define ROOMS                                                                                      \
    "outline,0,0,30,0,30,12,0,12\nwall,3,10,0,10,8\nwall,3,20,4,20,12\n"                           \
    "hole,14,5,15,5,15,6,14,6\n"

static sim_list_t planned(const char *text, uint64_t seed)
{
    sim_scenario_t scenario = scenario_in(text, ROOMS, "");
    sim_list_t orders;
    sim_error_t error;
    bool done = sim_errands_plan(&scenario, seed, &orders, &error);
    ck_assert_msg(done, "line %d: %s", error.line, error.text);
    sim_scenario_free(&scenario);
    return orders;
}

static const sim_order_t *order_at(const sim_list_t *orders, size_t number)
{
    return sim_list_at(orders, number);
}

/* The places where the walker stops. */
static size_t stops_of(const sim_list_t *orders, sim_point_t *stops, size_t room)
{
    size_t count = 0;
    for (size_t i = 1; i < orders->count; i++) {
        if (order_at(orders, i)->kind == SIM_ORDER_PAUSE && count < room) {
            stops[count].x_m = order_at(orders, i - 1)->x_m;
            stops[count++].y_m = order_at(orders, i - 1)->y_m;
        }
    }
    return count;
}

START_TEST(orders_without_errands_stay_as_they_are)
{
    const char *text = "start,1,1,0\nwalk,9,1,1\npause,2\nturn,1\nwalk,9,9,1.1\n";
    sim_scenario_t scenario = scenario_of(text);
    sim_list_t orders = planned(text, 1);
    ck_assert_uint_eq(orders.count, scenario.orders.count);
    ck_assert_mem_eq(orders.items, scenario.orders.items, orders.count * sizeof(sim_order_t));
    sim_list_free(&orders);
    sim_scenario_free(&scenario);
}
END_TEST

START_TEST(errands_become_walks_with_stops)
{
    for (uint64_t seed = 1; seed <= 20; seed++) {
        sim_list_t orders = planned("start,1,1,0\nerrands,6\nturn,0\nerrands.pause_s = 3\n"
                                    "errands.shortest_m = 8\n",
                                    seed);
        sim_point_t stops[10], last = {1.0, 1.0};
        ck_assert_uint_eq(stops_of(&orders, stops, 10), 6u);
        for (int i = 0; i < 6; i++) {
            ASSERT_AT_LEAST(hypot(stops[i].x_m - last.x_m, stops[i].y_m - last.y_m), 8.0, "m");
            last = stops[i];
        }
        for (size_t i = 1; i < orders.count; i++) {
            const sim_order_t *order = order_at(&orders, i);
            ck_assert(order->kind != SIM_ORDER_ERRANDS);
            ck_assert(order->kind != SIM_ORDER_PAUSE ||
                      (order->seconds >= 0.0 && order->seconds <= 6.0));
            ck_assert(order->kind != SIM_ORDER_WALK ||
                      (order->speed_mps > 0.8 && order->speed_mps <= 1.8));
        }
        ck_assert_int_eq(order_at(&orders, orders.count - 1)->kind, SIM_ORDER_TURN);
        sim_list_free(&orders);
    }
}
END_TEST

START_TEST(named_goals_are_all_there_is)
{
    int times[3] = {0, 0, 0};
    for (uint64_t seed = 1; seed <= 30; seed++) {
        sim_list_t orders = planned("goal,2,2,desk\ngoal,25,2,door\ngoal,15,10\nstart,1,9,0\n"
                                    "errands,5\nerrands.shortest_m = 2\n",
                                    seed);
        sim_point_t stops[10];
        size_t count = stops_of(&orders, stops, 10);
        ck_assert_uint_eq(count, 5u);
        for (size_t i = 0; i < count; i++) {
            int which = stops[i].x_m == 2.0 ? 0 : stops[i].x_m == 25.0 ? 1 : 2;
            ck_assert(which < 2 || (stops[i].x_m == 15.0 && stops[i].y_m == 10.0));
            times[which]++;
        }
        sim_list_free(&orders);
    }
    for (int i = 0; i < 3; i++) {
        ck_assert_int_ge(times[i], 30);
    }
}
END_TEST

START_TEST(each_seed_is_another_walk_and_the_same_again)
{
    const char *text = "start,1,1,0\nerrands,4\n";
    sim_list_t a = planned(text, 5), b = planned(text, 5), c = planned(text, 6);
    ck_assert_uint_eq(a.count, b.count);
    ck_assert_mem_eq(a.items, b.items, a.count * sizeof(sim_order_t));
    sim_point_t of_a[4], of_c[4];
    stops_of(&a, of_a, 4);
    stops_of(&c, of_c, 4);
    ck_assert(of_a[0].x_m != of_c[0].x_m);
    sim_list_free(&a);
    sim_list_free(&b);
    sim_list_free(&c);
}
END_TEST

/* --- surveys --- */

/* Two rooms, of which one cannot be entered. */
#define SEALED "outline,0,0,24,0,24,12,0,12\nwall,3,12,0,12,12\n"

START_TEST(a_survey_stops_at_every_point_that_can_be_reached)
{
    sim_scenario_t scenario = scenario_in("start,1,1,0\nsurvey,3\n", SEALED, "");
    sim_list_t orders, grid;
    sim_error_t error;
    sim_point_t stops[64];
    ck_assert(sim_errands_plan(&scenario, 1, &orders, &error));
    ck_assert(sim_grid(&scenario.plan, 3.0, 0.45, &grid));
    size_t count = stops_of(&orders, stops, 64);
    ck_assert_uint_eq(grid.count, 32u);
    ck_assert_uint_eq(count, 16u); /* of the western room */
    for (size_t i = 0; i < grid.count; i++) {
        const sim_point_t *p = sim_list_at(&grid, i);
        int times = 0;
        for (size_t k = 0; k < count; k++) {
            times += hypot(stops[k].x_m - p->x_m, stops[k].y_m - p->y_m) < 1e-9 ? 1 : 0;
        }
        ck_assert_int_eq(times, p->x_m < 12.0 ? 1 : 0);
    }
    sim_list_free(&grid);
    sim_list_free(&orders);
    sim_scenario_free(&scenario);
}
END_TEST

/* A greedy tour of 16 points 3 m apart is not much longer than the shortest. */
START_TEST(a_survey_goes_to_the_nearest_point_first)
{
    sim_scenario_t scenario = scenario_in("start,1,1,0\nsurvey,3\n", SEALED, "");
    sim_list_t orders;
    sim_error_t error;
    sim_point_t here = {1.0, 1.0};
    double length_m = 0.0;
    ck_assert(sim_errands_plan(&scenario, 1, &orders, &error));
    for (size_t i = 1; i < orders.count; i++) {
        const sim_order_t *order = order_at(&orders, i);
        if (order->kind == SIM_ORDER_WALK) {
            length_m += hypot(order->x_m - here.x_m, order->y_m - here.y_m);
            here.x_m = order->x_m;
            here.y_m = order->y_m;
        }
    }
    ASSERT_AT_LEAST(length_m, 45.0, "m");
    ASSERT_AT_MOST(length_m, 60.0, "m");
    sim_list_free(&orders);
    sim_scenario_free(&scenario);
}
END_TEST

START_TEST(a_survey_looks_in_all_directions)
{
    sim_scenario_t scenario = scenario_in("start,1,1,0\nsurvey,6\nsurvey.directions = 4\n"
                                          "survey.pause_s = 7\n",
                                          SEALED, "");
    sim_list_t orders;
    sim_error_t error;
    size_t pauses = 0, turns = 0;
    ck_assert(sim_errands_plan(&scenario, 1, &orders, &error));
    for (size_t i = 1; i < orders.count; i++) {
        const sim_order_t *order = order_at(&orders, i);
        const sim_order_t *last = order_at(&orders, i - 2);
        pauses += order->kind == SIM_ORDER_PAUSE ? 1u : 0u;
        ck_assert(order->kind != SIM_ORDER_PAUSE || order->seconds == 7.0);
        if (order->kind == SIM_ORDER_TURN) {
            turns++;
            ck_assert_int_eq(order_at(&orders, i - 1)->kind, SIM_ORDER_PAUSE);
            if (last->kind == SIM_ORDER_TURN) {
                double turned =
                    remainder(order->heading_rad - last->heading_rad, 2.0 * 3.14159265358979);
                ASSERT_NEAR(turned, 0.5 * 3.14159265358979, 1e-9, "rad");
            }
        }
    }
    ck_assert_uint_eq(pauses, 16u); /* 4 points of the western room */
    ck_assert_uint_eq(turns, 12u);
    sim_list_free(&orders);
    sim_scenario_free(&scenario);
}
END_TEST

static const struct {
    const char *text, *plan;
    int line;
    const char *says;
} refusals[] = {
    {"start,1,1,0\nerrands,3\n", "", 2, "errands without a plan, expected plan,FILE"},
    {"start,1,1,0\nsurvey,3\n", "", 2, "a survey without a plan, expected plan,FILE"},
    {"start,1,1,0\n\nsurvey,50\n", ROOMS, 3, "no reference point is inside the plan"},
    {"start,1,1,0\nwalk,19,1,1\n", ROOMS, 2, "the way to 19,1 crosses a wall of the plan"},
    {"start,1,1,0\nwalk,9,10,1\nwalk,10,8,1\n", ROOMS, 3, "the way to 10,8 crosses a wall"},
    {"start,14.5,5.5,0\n", ROOMS, 1, "14.5,5.5 is not inside the plan"},
    {"start,-1,1,0\nwalk,-5,1,1\n", ROOMS, 1, "-1,1 is not inside the plan"},
    {"start,1,1,0\ngoal,9.8,1,desk\nerrands,1\n", ROOMS, 2,
     "the goal 9.8,1 is outside or nearer than 0.45 m to a wall"},
    {"start,1,1,0\ngoal,40,1,desk\nerrands,1\n", ROOMS, 2, "the goal 40,1 is outside"},
    {"start,1,1,0\nerrands,1\nerrands.shortest_m = 50\n", ROOMS, 2,
     "no goal can be reached, expected one at least 50 m away"},
    {"start,1,1,0\ngoal,1,1\nerrands,1\nerrands.shortest_m = 0\n", ROOMS, 3,
     "no goal can be reached"},
};

START_TEST(what_cannot_be_done_is_refused)
{
    sim_scenario_t scenario = scenario_in(refusals[_i].text, refusals[_i].plan, "");
    sim_list_t orders;
    sim_error_t error;
    ck_assert(!sim_errands_plan(&scenario, 1, &orders, &error));
    ck_assert_msg(strstr(error.text, refusals[_i].says) != NULL, "says: %s", error.text);
    ck_assert_int_eq(error.line, refusals[_i].line);
    ck_assert_ptr_null(orders.items);
    sim_scenario_free(&scenario);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/errands");
    suite_add(suite, "orders", orders_without_errands_stay_as_they_are);
    suite_add(suite, "walks", errands_become_walks_with_stops);
    suite_add(suite, "goals", named_goals_are_all_there_is);
    suite_add(suite, "seeds", each_seed_is_another_walk_and_the_same_again);
    suite_add(suite, "surveys", a_survey_stops_at_every_point_that_can_be_reached);
    suite_add(suite, "surveys", a_survey_goes_to_the_nearest_point_first);
    suite_add(suite, "surveys", a_survey_looks_in_all_directions);
    suite_add_loop(suite, "refusals", what_cannot_be_done_is_refused,
                   (int)(sizeof refusals / sizeof refusals[0]));
    return suite;
}
