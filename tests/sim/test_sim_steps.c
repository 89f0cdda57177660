/* SPDX-License-Identifier: MIT */
#include "sim/steps.h"

#include "near.h"
#include "scenarios.h"
#include "sim/algebra.h"
#include "suite.h"

typedef struct {
    sim_scenario_t scenario;
    sim_route_t route;
    sim_steps_t steps;
} plan_t;

static plan_t plan_of(const char *text, uint64_t seed)
{
    plan_t plan = {.scenario = scenario_of(text)};
    const sim_order_t *start = sim_list_at(&plan.scenario.orders, 0);
    sim_place_t place = {start->x_m, start->y_m, start->z_m, start->heading_rad};
    sim_error_t error;
    ck_assert(
        sim_route_plan(&plan.scenario.orders, &plan.scenario.settings.walk, &plan.route, &error));
    ck_assert(
        sim_steps_plan(&plan.route, &place, &plan.scenario.settings, seed, &plan.steps, &error));
    return plan;
}

static void free_plan(plan_t *plan)
{
    sim_steps_free(&plan->steps);
    sim_route_free(&plan->route);
    sim_scenario_free(&plan->scenario);
}

static size_t count_of(const plan_t *plan)
{
    return plan->steps.steps.count;
}

static const sim_step_t *step_at(const plan_t *plan, size_t number)
{
    const sim_step_t *step = sim_list_at(&plan->steps.steps, number);
    ck_assert_ptr_nonnull(step);
    return step;
}

#define EXACT                                                                                      \
    "walk.length_spread = 0\nwalk.time_spread = 0\nwalk.place_spread_m = 0\nwalk.toe_spread_rad "  \
    "= 0\n"

static const char *const walks[] = {
    "start,0,0,0\nwalk,30,0,1.2\n",
    "start,0,0,0\nwalk,10,0,1.2\nwalk,10,8,1.4\npause,2\nwalk,0,8,0.6\nturn,0\n",
    "start,0,0,2\nwalk,40,0,3\nwalk,0,0.5,1.8\n",
    "start,0,0,0\nwalk,4,0,1\nstairs,7,0,1.7,0.5\nwalk,9,0,1\nstairs,9,2.5,0.34,0.4\npause,1\n"};
enum { WALKS = sizeof walks / sizeof walks[0] };

START_TEST(feet_take_turns_and_time_goes_on)
{
    plan_t plan = plan_of(walks[_i], 3);
    for (size_t i = 1; i < count_of(&plan); i++) {
        const sim_step_t *step = step_at(&plan, i), *before = step_at(&plan, i - 1);
        ck_assert_int_eq(step->side, -before->side);
        ck_assert(i < 3 || step->strike_s > before->strike_s);
    }
    double end = plan.steps.end_s - step_at(&plan, count_of(&plan) - 1)->strike_s;
    ASSERT_AT_LEAST(end, plan.scenario.settings.walk.lead_out_s - 1e-9, "s");
    free_plan(&plan);
}
END_TEST

START_TEST(a_foot_stands_before_it_swings_again)
{
    plan_t plan = plan_of(walks[_i], 3);
    for (size_t i = 2; i < count_of(&plan); i++) {
        const sim_step_t *step = step_at(&plan, i), *same = step_at(&plan, i - 2);
        ASSERT_AT_LEAST(step->swing_s, 0.1, "s");
        ASSERT_AT_LEAST(step->strike_s - step->swing_s - same->strike_s, 0.12 - 1e-9, "s");
    }
    ASSERT_AT_LEAST(step_at(&plan, 2)->strike_s - step_at(&plan, 2)->swing_s,
                    plan.scenario.settings.walk.lead_in_s, "s");
    free_plan(&plan);
}
END_TEST

/* The middle of the feet when both stand. */
static sim_place_t middle_of(const sim_step_t *a, const sim_step_t *b)
{
    sim_place_t place = {0.5 * (a->place.x_m + b->place.x_m), 0.5 * (a->place.y_m + b->place.y_m),
                         0.5 * (a->place.z_m + b->place.z_m),
                         0.5 * (a->place.heading_rad + b->place.heading_rad)};
    return place;
}

START_TEST(the_feet_stand_side_by_side_at_the_end)
{
    plan_t plan = plan_of(walks[_i], 3);
    const sim_section_t *last = sim_list_at(&plan.route.sections, plan.route.sections.count - 1);
    const sim_step_t *a = step_at(&plan, count_of(&plan) - 2);
    const sim_step_t *b = step_at(&plan, count_of(&plan) - 1);
    sim_place_t middle = middle_of(a, b);
    ASSERT_NEAR(middle.x_m, last->to.x_m, 1e-9, "m");
    ASSERT_NEAR(middle.y_m, last->to.y_m, 1e-9, "m");
    ASSERT_NEAR(middle.z_m, last->to.z_m, 1e-9, "m");
    ASSERT_NEAR(sim_wrap_pi(middle.heading_rad - last->to.heading_rad), 0.0, 1e-9, "rad");
    double dx = a->place.x_m - b->place.x_m, dy = a->place.y_m - b->place.y_m;
    ASSERT_NEAR(hypot(dx, dy), plan.scenario.settings.gait.width_m, 1e-9, "m");
    free_plan(&plan);
}
END_TEST

static const struct {
    double speed, step_m; /* by step_length_m sqrt(v), or v / run_rate_hz */
} speeds[] = {{0.5, 0.4667}, {0.8, 0.5903}, {1.2, 0.7230}, {1.8, 0.8855},
              {2.0, 0.7692}, {2.7, 1.0385}, {3.5, 1.3462}};

START_TEST(speed_and_step_length_are_as_asked)
{
    char text[200];
    snprintf(text, sizeof text, "start,0,0,0\nwalk,60,0,%g\n" EXACT, speeds[_i].speed);
    plan_t plan = plan_of(text, 1);
    size_t first = count_of(&plan) / 3, last = 2 * count_of(&plan) / 3;
    if ((last - first) % 2 == 1) {
        last--;
    }
    const sim_step_t *a = step_at(&plan, first), *b = step_at(&plan, last);
    double way = b->place.x_m - a->place.x_m;
    ASSERT_NEAR(way / (b->strike_s - a->strike_s), speeds[_i].speed, 1e-6, "m/s");
    /* whole steps to the end: a little longer or shorter than by the formula */
    ASSERT_NEAR(way / (double)(last - first), speeds[_i].step_m, 0.02 * speeds[_i].step_m, "m");
    ck_assert_int_eq(a->kind, speeds[_i].speed > 1.9 ? SIM_GAIT_RUN : SIM_GAIT_WALK);
    free_plan(&plan);
}
END_TEST

START_TEST(the_walker_speeds_up_and_slows_down_step_by_step)
{
    plan_t plan = plan_of("start,0,0,0\nwalk,30,0,3\n" EXACT, 1);
    double last = 0.0, most = 0.0;
    for (size_t i = 3; i + 1 < count_of(&plan); i++) {
        const sim_step_t *step = step_at(&plan, i), *before = step_at(&plan, i - 1);
        double speed = (step->place.x_m - before->place.x_m) / step->pace_s;
        double left = 30.0 - before->place.x_m + 0.15; /* steps were stretched to fit */
        ASSERT_AT_MOST(speed * speed, 2.0 * 1.2 * left, "m^2/s^2");
        ASSERT_NEAR(speed, last > 0.0 ? last : speed, 1.3, "m/s");
        most = fmax(most, speed);
        last = speed;
    }
    ASSERT_NEAR(most, 3.0, 1e-6, "m/s");
    ck_assert_int_eq(step_at(&plan, 2)->kind, SIM_GAIT_WALK);
    ck_assert_int_eq(step_at(&plan, count_of(&plan) - 2)->kind, SIM_GAIT_WALK);
    free_plan(&plan);
}
END_TEST

START_TEST(feet_walk_on_two_lines_with_the_toes_out)
{
    plan_t plan = plan_of("start,0,0,0\nwalk,20,0,1.2\n" EXACT, 1);
    for (size_t i = 0; i < count_of(&plan); i++) {
        const sim_step_t *step = step_at(&plan, i);
        ASSERT_NEAR(step->place.y_m, 0.06 * step->side, 1e-9, "m");
        ASSERT_NEAR(step->place.heading_rad, 0.10 * step->side, 1e-9, "rad");
    }
    free_plan(&plan);
}
END_TEST

START_TEST(steps_vary_by_as_much_as_asked)
{
    plan_t plan = plan_of("start,0,0,0\nwalk,2000,0,1.2\n", 9);
    double side2 = 0.0, yaw2 = 0.0, pace1 = 0.0, pace2 = 0.0;
    int n = 0;
    for (size_t i = 20; i + 20 < count_of(&plan); i++, n++) {
        const sim_step_t *step = step_at(&plan, i);
        double side = step->place.y_m - 0.06 * step->side;
        double yaw = step->place.heading_rad - 0.10 * step->side;
        side2 += side * side;
        yaw2 += yaw * yaw;
        pace1 += step->pace_s;
        pace2 += step->pace_s * step->pace_s;
    }
    double pace = pace1 / n, spread = sqrt(pace2 / n - pace * pace) / pace;
    ASSERT_NEAR(sqrt(side2 / n), 0.01, 0.001, "m");
    ASSERT_NEAR(sqrt(yaw2 / n), 0.03, 0.003, "rad");
    ASSERT_NEAR(spread, 0.02 * sqrt(2.0), 0.003, "1"); /* of the length and of the time */
    free_plan(&plan);
}
END_TEST

START_TEST(a_turn_on_the_spot_is_made_of_small_turns)
{
    plan_t plan = plan_of("start,3,4,0\nturn,3\n", 1);
    ck_assert_uint_eq(count_of(&plan), 2u + 6u); /* three turns of 1 rad, two feet */
    for (size_t i = 2; i < count_of(&plan); i++) {
        const sim_step_t *step = step_at(&plan, i), *same = step_at(&plan, i - 2);
        ASSERT_AT_MOST(fabs(step->place.heading_rad - same->place.heading_rad), 1.0 + 1e-9, "rad");
        ASSERT_NEAR(hypot(step->place.x_m - 3.0, step->place.y_m - 4.0), 0.06, 1e-9, "m");
        ck_assert_int_eq(step->kind, SIM_GAIT_SHUFFLE);
    }
    free_plan(&plan);
}
END_TEST

START_TEST(every_stair_gets_one_foot)
{
    plan_t plan = plan_of("start,0,0,0,10\nwalk,4,0,1\nstairs,7,0,8.3,0.5\nwalk,9,0,1\n", 1);
    int stairs = 0;
    for (size_t i = 3; i < count_of(&plan); i++) {
        const sim_step_t *step = step_at(&plan, i), *before = step_at(&plan, i - 1);
        double down = before->place.z_m - step->place.z_m;
        if (step->kind == SIM_GAIT_STAIRS) {
            stairs++;
            ASSERT_NEAR(down, 0.17, 1e-9, "m");
            ASSERT_NEAR(step->pace_s, 0.3 / 0.5, 0.1, "s");
        } else {
            ASSERT_NEAR(down, 0.0, 1e-9, "m");
        }
    }
    ck_assert_int_eq(stairs, 10);
    free_plan(&plan);
}
END_TEST

START_TEST(a_pause_is_a_long_stance)
{
    plan_t plan = plan_of("start,0,0,0\nwalk,4,0,1\npause,7.5\nwalk,8,0,1\n", 1);
    double longest = 0.0;
    for (size_t i = 3; i < count_of(&plan); i++) {
        const sim_step_t *step = step_at(&plan, i), *before = step_at(&plan, i - 1);
        longest = fmax(longest, step->strike_s - step->swing_s - before->strike_s);
    }
    ASSERT_AT_LEAST(longest, 7.5, "s");
    ASSERT_AT_MOST(longest, 8.0, "s"); /* with the shift of weight before the first step */
    free_plan(&plan);
}
END_TEST

START_TEST(the_faster_the_shorter_is_the_stance)
{
    double last = 1.0;
    for (double speed = 0.5; speed < 4.0; speed += 0.5) {
        char text[200];
        snprintf(text, sizeof text, "start,0,0,0\nwalk,50,0,%g\n" EXACT, speed);
        plan_t plan = plan_of(text, 1);
        const sim_step_t *step = step_at(&plan, count_of(&plan) / 2);
        double share = 1.0 - step->swing_s / (2.0 * step->pace_s);
        ASSERT_AT_MOST(share, last - 0.01, "1");
        last = share;
        free_plan(&plan);
    }
}
END_TEST

START_TEST(seeds_make_the_difference)
{
    plan_t one = plan_of(walks[1], 1), again = plan_of(walks[1], 1), two = plan_of(walks[1], 2);
    size_t bytes = count_of(&one) * sizeof(sim_step_t);
    ck_assert_uint_eq(count_of(&one), count_of(&again));
    for (size_t i = 0; i < count_of(&one); i++) {
        ck_assert(step_at(&one, i)->strike_s == step_at(&again, i)->strike_s);
        ck_assert(step_at(&one, i)->place.x_m == step_at(&again, i)->place.x_m);
    }
    ck_assert(count_of(&one) != count_of(&two) ||
              memcmp(one.steps.steps.items, two.steps.steps.items, bytes) != 0);
    free_plan(&one);
    free_plan(&again);
    free_plan(&two);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/steps");
    suite_add_loop(suite, "order", feet_take_turns_and_time_goes_on, WALKS);
    suite_add_loop(suite, "stance", a_foot_stands_before_it_swings_again, WALKS);
    suite_add_loop(suite, "end", the_feet_stand_side_by_side_at_the_end, WALKS);
    suite_add_loop(suite, "speed", speed_and_step_length_are_as_asked,
                   (int)(sizeof speeds / sizeof speeds[0]));
    suite_add(suite, "acceleration", the_walker_speeds_up_and_slows_down_step_by_step);
    suite_add(suite, "two lines", feet_walk_on_two_lines_with_the_toes_out);
    suite_add(suite, "variation", steps_vary_by_as_much_as_asked);
    suite_add(suite, "turn", a_turn_on_the_spot_is_made_of_small_turns);
    suite_add(suite, "stairs", every_stair_gets_one_foot);
    suite_add(suite, "pause", a_pause_is_a_long_stance);
    suite_add(suite, "stance share", the_faster_the_shorter_is_the_stance);
    suite_add(suite, "seeds", seeds_make_the_difference);
    return suite;
}
