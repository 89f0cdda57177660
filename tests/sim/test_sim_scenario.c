/* SPDX-License-Identifier: MIT */
#include "sim/scenario.h"

#include "insole/base/rng.h"
#include "near.h"
#include "scenarios.h"
#include "suite.h"

static const sim_order_t *order_at(const sim_scenario_t *scenario, size_t number)
{
    return sim_list_at(&scenario->orders, number);
}

START_TEST(orders_are_read_as_written)
{
    sim_scenario_t s = scenario_of("start,1,-2,0.5,3\nwalk,4,5e0,1.25\nstairs,6,7,8.5,0.5\n"
                                   "pause,2.5\nturn,-1.5\n");
    ck_assert_uint_eq(s.orders.count, 5u);
    const sim_order_t *start = order_at(&s, 0), *walk = order_at(&s, 1), *stairs = order_at(&s, 2);
    ck_assert(start->kind == SIM_ORDER_START && start->x_m == 1.0 && start->y_m == -2.0);
    ck_assert(start->heading_rad == 0.5 && start->z_m == 3.0 && start->line == 1);
    ck_assert(walk->kind == SIM_ORDER_WALK && walk->x_m == 4.0 && walk->y_m == 5.0);
    ck_assert(walk->speed_mps == 1.25 && walk->line == 2);
    ck_assert(stairs->kind == SIM_ORDER_STAIRS && stairs->x_m == 6.0 && stairs->y_m == 7.0);
    ck_assert(stairs->z_m == 8.5 && stairs->speed_mps == 0.5);
    ck_assert(order_at(&s, 3)->kind == SIM_ORDER_PAUSE && order_at(&s, 3)->seconds == 2.5);
    ck_assert(order_at(&s, 4)->kind == SIM_ORDER_TURN && order_at(&s, 4)->heading_rad == -1.5);
    sim_scenario_free(&s);
}
END_TEST

START_TEST(changes_of_the_pose_are_read_as_written)
{
    sim_scenario_t s = scenario_of("start,0,0,0\npose, 5, ear\n\npose,9.5,swing # at the side\n");
    ck_assert_uint_eq(s.changes.count, 2u);
    const sim_pose_change_t *first = sim_list_at(&s.changes, 0),
                            *second = sim_list_at(&s.changes, 1);
    ck_assert(first->t_s == 5.0 && first->pose == SIM_POSE_EAR && first->line == 2);
    ck_assert(second->t_s == 9.5 && second->pose == SIM_POSE_SWING && second->line == 4);
    ck_assert_int_eq(s.settings.phone.pose, SIM_POSE_HAND);
    sim_scenario_free(&s);
}
END_TEST

START_TEST(lines_of_points_are_read_as_written)
{
    sim_scenario_t s = scenario_of("points, 1,2, 3,-4\nstart,0,0,0\n");
    const sim_line_t *line = sim_list_at(&s.lines, 0);
    ck_assert_uint_eq(s.lines.count, 1u);
    ck_assert(line->from.x_m == 1.0 && line->from.y_m == 2.0);
    ck_assert(line->to.x_m == 3.0 && line->to.y_m == -4.0);
    sim_scenario_free(&s);
}
END_TEST

START_TEST(comments_blanks_and_line_ends_do_not_matter)
{
    sim_scenario_t s = scenario_of("# a walk\r\n\r\n   start , 0 ,\t0, 0   # here\r\n"
                                   "\t imu.rate_hz=100#Hz\n  gait.foot = left \nwalk,9,0,1.1");
    ck_assert_uint_eq(s.orders.count, 2u);
    ck_assert_int_eq(order_at(&s, 0)->line, 3);
    ck_assert_int_eq(order_at(&s, 1)->line, 6);
    ASSERT_NEAR(s.settings.imu.rate_hz, 100.0, 0.0, "Hz");
    ck_assert_int_eq(s.settings.gait.foot, SIM_FOOT_LEFT);
    sim_scenario_free(&s);
}
END_TEST

START_TEST(building_goals_and_errands_are_read_as_written)
{
    sim_scenario_t s = scenario_of("plan, a plan.csv\ngoal,1,2,the desk\nstart,0,0,0\ngoal,-3,4\n"
                                   "errands,12\naps,b.csv # here\n");
    ck_assert_str_eq(s.plan_file, "a plan.csv");
    ck_assert_str_eq(s.aps_file, "b.csv");
    ck_assert_uint_eq(s.goals.count, 2u);
    const sim_goal_t *first = sim_list_at(&s.goals, 0), *second = sim_list_at(&s.goals, 1);
    ck_assert(first->at.x_m == 1.0 && first->at.y_m == 2.0 && first->line == 2);
    ck_assert(second->at.x_m == -3.0 && second->at.y_m == 4.0 && second->line == 4);
    ck_assert_uint_eq(s.orders.count, 2u);
    ck_assert(order_at(&s, 1)->kind == SIM_ORDER_ERRANDS && order_at(&s, 1)->goals == 12.0);
    ck_assert_uint_eq(s.plan.walls.count + s.aps.count, 0u);
    sim_scenario_free(&s);
}
END_TEST

START_TEST(without_settings_all_are_defaults)
{
    sim_scenario_t s = scenario_of("start,0,0,0\n");
    ck_assert_mem_eq(&s.settings, &sim_settings_defaults, sizeof s.settings);
    sim_scenario_free(&s);
}
END_TEST

static const struct {
    const char *text;
    int line;
    const char *says;
} refusals[] = {
    {"", 1, "no start, expected start,x,y,heading[,z]"},
    {"# nothing\n\n", 3, "no start"},
    {"imu.rate_hz = 100\n", 2, "no start"},
    {"walk,1,2,1\n", 1, "'walk' is out of place, expected one start before all other orders"},
    {"start,0,0,0\nstart,0,0,0\n", 2, "'start' is out of place"},
    {"start,0,0,0\nfly,1,2,1\n", 2, "'fly' is no order, expected start, walk, stairs"},
    {"start,0,0,0\nWalk,1,2,1\n", 2, "'Walk' is no order"},
    {"start,0,0,0\n,1,2\n", 2, "'' is no order"},
    {"start,0,0\n", 1, "too few fields, expected start,x,y,heading[,z]"},
    {"start,0,0,0,0,0\n", 1, "too many fields, expected start,x,y,heading[,z]"},
    {"start,0,0,0\nwalk,1,2\n", 2, "too few fields, expected walk,x,y,speed"},
    {"start,0,0,0\n\nwalk,1,2,1,3\n", 3, "too many fields, expected walk,x,y,speed"},
    {"start,0,0,0\nwalk,1,2,1,\n", 2, "too many fields"},
    {"start,0,0,0\nwalk,1,,1\n", 2, "y is '', expected a number from -100000 to 100000"},
    {"start,0,0,0\nwalk,1,2m,1\n", 2, "y is '2m', expected a number"},
    {"start,0,0,0\nwalk,1,nan,1\n", 2, "y is 'nan', expected a number"},
    {"start,0,0,0\nwalk,inf,2,1\n", 2, "x is 'inf', expected a number"},
    {"start,0,0,0\nwalk,1,2,0.2\n", 2, "speed is '0.2', expected a number from 0.3 to 4"},
    {"start,0,0,0\nwalk,1,2,4.1\n", 2, "speed is '4.1'"},
    {"start,0,0,0\nwalk,1,2,-1\n", 2, "speed is '-1'"},
    {"start,0,0,0\nstairs,1,2,1,2\n", 2, "speed is '2', expected a number from 0.2 to 1.2"},
    {"start,0,0,0\npause,-1\n", 2, "seconds is '-1', expected a number from 0 to 36000"},
    {"start,0,0,0\npause\n", 2, "too few fields, expected pause,seconds"},
    {"start,0,0,90\n", 1, "heading is '90', expected a number from -6.3 to 6.3"},
    {"start,0,0,0\nturn\n", 2, "too few fields, expected turn,heading"},
    {"start,0,0,0\nerrands\n", 2, "too few fields, expected errands,goals"},
    {"start,0,0,0\nerrands,0\n", 2, "goals is '0', expected a number from 1 to 1000"},
    {"start,0,0,0\nerrands,2.5\n", 2, "goals is 2.5, expected a whole number"},
    {"start,0,0,0\nsurvey\n", 2, "too few fields, expected survey,spacing"},
    {"start,0,0,0\nsurvey,0.5\n", 2, "spacing is '0.5', expected a number from 1 to 50"},
    {"errands,3\n", 1, "'errands' is out of place"},
    {"goal,1\n", 1, "too few fields, expected goal,x,y[,name]"},
    {"goal,1,a\n", 1, "y is 'a', expected a number"},
    {"points,1,2,3\n", 1, "too few fields, expected points,x,y,x,y"},
    {"points,1,2,3,4,5\n", 1, "too many fields, expected points,x,y,x,y"},
    {"points,1,2,a,4\n", 1, "x is 'a', expected a number"},
    {"pose,5\n", 1, "expected pose,seconds,hand|ear|swing|pocket"},
    {"pose,5,ear,2\n", 1, "expected pose,seconds,hand|ear|swing|pocket"},
    {"pose,soon,ear\n", 1, "seconds is 'soon', expected a number"},
    {"pose,-1,ear\n", 1, "seconds is '-1', expected a number"},
    {"pose,5,nose\n", 1, "phone.pose is 'nose', expected one of hand|ear|swing|pocket"},
    {"plan\n", 1, "expected plan,FILE with the name of a file beside the scenario"},
    {"plan,\n", 1, "expected plan,FILE"},
    {"plan,../a.csv\n", 1, "expected plan,FILE"},
    {"plan,a.csv,b.csv\n", 1, "expected plan,FILE"},
    {"plan,a.csv\nplan,b.csv\n", 2, "a second plan, expected one"},
    {"aps,a/b\n", 1, "expected aps,FILE"},
    {"aps,a\naps,a\n", 2, "a second aps, expected one"},
    {"start,0,0,0\nimu.rate_hz = 5\n", 2, "imu.rate_hz is '5', expected a number from 50"},
    {"start,0,0,0\nrate = 5\n", 2, "no setting is called 'rate'"},
    {"start,0,0,0\n= 5\n", 2, "no setting is called ''"},
};

START_TEST(malformed_lines_are_refused_by_number)
{
    sim_scenario_t scenario;
    sim_error_t error;
    const char *text = refusals[_i].text;
    ck_assert(!scenario_read_bytes(text, strlen(text), &scenario, &error));
    ck_assert_msg(strstr(error.text, refusals[_i].says) != NULL, "says: %s", error.text);
    ck_assert_int_eq(error.line, refusals[_i].line);
    ck_assert_ptr_null(scenario.orders.items);
}
END_TEST

START_TEST(long_lines_are_refused)
{
    char text[9000];
    sim_scenario_t scenario;
    sim_error_t error;
    memset(text, ' ', sizeof text);
    memcpy(text, "start,0,0,0\n", 12);
    ck_assert(!scenario_read_bytes(text, sizeof text, &scenario, &error));
    ck_assert_msg(strstr(error.text, "too long, expected at most 4094") != NULL, "%s", error.text);
    ck_assert_int_eq(error.line, 2);
    /* the longest that is taken */
    text[12 + 4094] = '\n';
    ck_assert(scenario_read_bytes(text, 12 + 4095, &scenario, &error));
    sim_scenario_free(&scenario);
}
END_TEST

/* Damaged scenarios are taken or refused, but nothing worse; a refusal names a line there is. */
START_TEST(damaged_scenarios_do_no_harm)
{
    static const char good[] =
        "start,0,0,0\nwalk,10,0,1.2\nimu.model = ideal\nstairs,13,0,1.7,0.5\n"
        "pause,1\nturn,1.57 # left\nwalk,13,9,2.5\n";
    insole_rng_t rng;
    insole_rng_seed(&rng, 5);
    int refused = 0;
    for (int round = 0; round < 3000; round++) {
        char text[sizeof good];
        size_t size = sizeof good - 1;
        memcpy(text, good, size);
        for (uint32_t k = 0; k < 1 + insole_rng_bits(&rng) % 4u; k++) {
            text[insole_rng_bits(&rng) % size] = (char)(insole_rng_bits(&rng) % 128u);
        }
        sim_scenario_t scenario;
        sim_error_t error;
        if (scenario_read_bytes(text, size, &scenario, &error)) {
            ck_assert_uint_ge(scenario.orders.count, 1u);
            sim_scenario_free(&scenario);
        } else {
            refused++;
            ck_assert_int_ge(error.line, 1);
            ck_assert_int_le(error.line, 12);
        }
    }
    ck_assert_int_gt(refused, 1000);
    ck_assert_int_lt(refused, 3000);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/scenario");
    suite_add(suite, "orders", orders_are_read_as_written);
    suite_add(suite, "building", building_goals_and_errands_are_read_as_written);
    suite_add(suite, "poses", changes_of_the_pose_are_read_as_written);
    suite_add(suite, "lines", lines_of_points_are_read_as_written);
    suite_add(suite, "white space", comments_blanks_and_line_ends_do_not_matter);
    suite_add(suite, "defaults", without_settings_all_are_defaults);
    suite_add_loop(suite, "refusals", malformed_lines_are_refused_by_number,
                   (int)(sizeof refusals / sizeof refusals[0]));
    suite_add(suite, "long lines", long_lines_are_refused);
    suite_add(suite, "damage", damaged_scenarios_do_no_harm);
    return suite;
}
