/* SPDX-License-Identifier: MIT */
#include "sim/errands.h"

#include <math.h>
#include <stdlib.h>

#include "sim/algebra.h"
#include "sim/grid.h"
#include "sim/seeds.h"
#include "sim/way.h"

static const double shortest_leg_m = 0.3;
static const double slowest_mps = 0.3, fastest_mps = 1.8;
enum { MOST_TRIES = 500 };

typedef struct {
    const sim_scenario_t *scenario;
    const sim_errands_settings_t *settings;
    sim_way_map_t map; /* without squares until an errand needs it */
    insole_rng_t rng;
    sim_list_t *orders;
    sim_point_t here;
    double heading_rad; /* of the last walk */
    sim_error_t *error;
} planner_t;

static double uniform(insole_rng_t *rng)
{
    return (double)insole_rng_uniform(rng);
}

static bool add_order(planner_t *p, const sim_order_t *order)
{
    return sim_list_add(p->orders, order) || sim_fail(p->error, "out of memory");
}

/* --- drawing --- */

static sim_point_t draw_point(planner_t *p)
{
    const sim_list_t *goals = &p->scenario->goals;
    double u = uniform(&p->rng), v = uniform(&p->rng);
    if (goals->count > 0) {
        return ((const sim_goal_t *)sim_list_at(goals, (size_t)(u * (double)goals->count)))->at;
    }
    sim_point_t point = {p->map.low.x_m + u * (double)p->map.columns * p->map.square_m,
                         p->map.low.y_m + v * (double)p->map.rows * p->map.square_m};
    return point;
}

/* Can the way be walked leg by leg? */
static bool has_long_legs(const sim_list_t *points)
{
    for (size_t i = 1; i < points->count; i++) {
        const sim_point_t *a = sim_list_at(points, i - 1), *b = sim_list_at(points, i);
        if (hypot(b->x_m - a->x_m, b->y_m - a->y_m) < shortest_leg_m) {
            return false;
        }
    }
    return true;
}

static bool draw_way(planner_t *p, sim_list_t *points)
{
    for (int tries = 0; tries < MOST_TRIES; tries++) {
        sim_point_t goal = draw_point(p);
        double far = hypot(goal.x_m - p->here.x_m, goal.y_m - p->here.y_m);
        if (far < fmax(shortest_leg_m, p->settings->shortest_m) ||
            !sim_way_can_stand(&p->map, goal) || !sim_way_find(&p->map, p->here, goal, points)) {
            continue;
        }
        if (has_long_legs(points)) {
            return true;
        }
        sim_list_free(points);
    }
    return sim_fail(p->error,
                    "no goal can be reached, expected one at least %g m away by a way "
                    "that keeps %g m from the walls",
                    p->settings->shortest_m, p->settings->clearance_m);
}

/* --- orders --- */

static double draw_speed(planner_t *p)
{
    double spread = p->settings->speed_spread * (double)insole_rng_normal(&p->rng);
    return fmax(slowest_mps, fmin(fastest_mps, p->settings->speed_mps * (1.0 + spread)));
}

static bool add_walks(planner_t *p, const sim_list_t *points, int line)
{
    double speed_mps = draw_speed(p);
    for (size_t i = 1; i < points->count; i++) {
        const sim_point_t *to = sim_list_at(points, i);
        sim_order_t walk = {.kind = SIM_ORDER_WALK,
                            .line = line,
                            .x_m = to->x_m,
                            .y_m = to->y_m,
                            .speed_mps = speed_mps};
        if (!add_order(p, &walk)) {
            return false;
        }
        p->heading_rad = atan2(to->y_m - p->here.y_m, to->x_m - p->here.x_m);
        p->here = *to;
    }
    return true;
}

static bool add_pause(planner_t *p, double seconds, int line)
{
    sim_order_t pause = {.kind = SIM_ORDER_PAUSE, .line = line, .seconds = seconds};
    return add_order(p, &pause);
}

static bool add_way(planner_t *p, const sim_list_t *points, int line)
{
    return add_walks(p, points, line) &&
           add_pause(p, 2.0 * p->settings->pause_s * uniform(&p->rng), line);
}

static bool add_errand(planner_t *p, int line)
{
    sim_list_t points;
    if (!draw_way(p, &points)) {
        return false;
    }
    bool good = add_way(p, &points, line);
    sim_list_free(&points);
    return good;
}

/* A goal where nobody can stand would never be drawn; its author should know. */
static bool check_goals(const planner_t *p)
{
    for (size_t i = 0; i < p->scenario->goals.count; i++) {
        const sim_goal_t *goal = sim_list_at(&p->scenario->goals, i);
        if (!sim_way_can_stand(&p->map, goal->at)) {
            sim_fail(p->error, "the goal %g,%g is outside or nearer than %g m to a wall",
                     goal->at.x_m, goal->at.y_m, p->settings->clearance_m);
            return sim_fail_on_line(p->error, goal->line);
        }
    }
    return true;
}

static bool open_map(planner_t *p, const char *what)
{
    if (p->map.is_free != NULL) {
        return true;
    }
    if (p->scenario->plan.walls.count == 0) {
        return sim_fail(p->error, "%s without a plan, expected plan,FILE", what);
    }
    if (!sim_way_map(&p->map, &p->scenario->plan, p->settings->clearance_m)) {
        return sim_fail(p->error, "out of memory");
    }
    return true;
}

static bool add_errands(planner_t *p, const sim_order_t *order)
{
    if (!open_map(p, "errands")) {
        return sim_fail_on_line(p->error, order->line);
    }
    if (!check_goals(p)) {
        return false;
    }
    for (int i = 0; i < (int)order->goals; i++) {
        if (!add_errand(p, order->line)) {
            return sim_fail_on_line(p->error, order->line);
        }
    }
    return true;
}

/* --- surveys --- */

/* Looks in all directions, one after the other. */
static bool add_stop(planner_t *p, int line)
{
    const sim_survey_settings_t *survey = &p->scenario->settings.survey;
    int directions = (int)survey->directions;
    bool good = add_pause(p, survey->pause_s, line);
    for (int i = 1; good && i < directions; i++) {
        sim_order_t turn = {.kind = SIM_ORDER_TURN, .line = line};
        turn.heading_rad = sim_wrap_pi(p->heading_rad + 2.0 * SIM_PI * i / directions);
        good = add_order(p, &turn) && add_pause(p, survey->pause_s, line);
    }
    return good;
}

/* The nearest point that is not done and not too near to walk to; NULL: there is none. */
static const sim_point_t *nearest_point(const planner_t *p, const sim_list_t *points,
                                        const bool *is_done, size_t *number)
{
    const sim_point_t *nearest = NULL;
    double least = HUGE_VAL;
    for (size_t i = 0; i < points->count; i++) {
        const sim_point_t *at = sim_list_at(points, i);
        double far = hypot(at->x_m - p->here.x_m, at->y_m - p->here.y_m);
        if (!is_done[i] && far >= shortest_leg_m && far < least) {
            least = far;
            nearest = at;
            *number = i;
        }
    }
    return nearest;
}

/* Goes to the point, if that can be done in steps. */
static bool visit(planner_t *p, const sim_point_t *point, int line)
{
    sim_list_t way;
    if (!sim_way_find(&p->map, p->here, *point, &way)) {
        return true;
    }
    bool good = !has_long_legs(&way) || (add_walks(p, &way, line) && add_stop(p, line));
    sim_list_free(&way);
    return good;
}

static bool visit_all(planner_t *p, const sim_list_t *points, int line)
{
    bool *is_done = calloc(points->count + 1, sizeof *is_done), good = is_done != NULL;
    const sim_point_t *next;
    size_t number = 0;
    while (good && (next = nearest_point(p, points, is_done, &number)) != NULL) {
        is_done[number] = true;
        good = visit(p, next, line);
    }
    free(is_done);
    return good || sim_fail(p->error, "out of memory");
}

static bool add_survey(planner_t *p, const sim_order_t *order)
{
    sim_list_t points;
    if (!open_map(p, "a survey")) {
        return sim_fail_on_line(p->error, order->line);
    }
    if (!sim_reference_points(p->scenario, order->spacing_m, &points)) {
        return sim_fail(p->error, "out of memory");
    }
    bool good = points.count > 0;
    if (good) {
        good = visit_all(p, &points, order->line);
    } else {
        sim_fail(p->error, "no reference point is inside the plan, expected a smaller spacing");
        sim_fail_on_line(p->error, order->line);
    }
    sim_list_free(&points);
    return good;
}

/* An order that its author wrote: it may not lead through walls. */
static bool take_order(planner_t *p, const sim_order_t *order)
{
    sim_point_t to = {order->x_m, order->y_m};
    bool goes = order->kind == SIM_ORDER_WALK;
    if (goes && !(sim_plan_clearance(&p->scenario->plan, p->here, to) > 0.0)) {
        sim_fail(p->error, "the way to %g,%g crosses a wall of the plan, expected a free way",
                 to.x_m, to.y_m);
        return sim_fail_on_line(p->error, order->line);
    }
    bool moves = goes || order->kind == SIM_ORDER_START || order->kind == SIM_ORDER_STAIRS;
    if (moves && !sim_plan_is_inside(&p->scenario->plan, to)) {
        sim_fail(p->error, "%g,%g is not inside the plan", to.x_m, to.y_m);
        return sim_fail_on_line(p->error, order->line);
    }
    p->here = moves ? to : p->here;
    return add_order(p, order);
}

static bool take_orders(planner_t *p)
{
    for (size_t i = 0; i < p->scenario->orders.count; i++) {
        const sim_order_t *order = sim_list_at(&p->scenario->orders, i);
        bool good = order->kind == SIM_ORDER_ERRANDS  ? add_errands(p, order)
                    : order->kind == SIM_ORDER_SURVEY ? add_survey(p, order)
                                                      : take_order(p, order);
        if (!good) {
            return false;
        }
    }
    return true;
}

bool sim_errands_plan(const sim_scenario_t *scenario, uint64_t seed, sim_list_t *orders,
                      sim_error_t *error)
{
    planner_t planner = {.scenario = scenario,
                         .settings = &scenario->settings.errands,
                         .orders = orders,
                         .error = error};
    sim_seed(&planner.rng, seed, SIM_SEED_ERRANDS);
    *orders = sim_list(sizeof(sim_order_t));
    bool good = take_orders(&planner);
    sim_way_map_free(&planner.map);
    if (!good) {
        sim_list_free(orders);
    }
    return good;
}
