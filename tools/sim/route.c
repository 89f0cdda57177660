/* SPDX-License-Identifier: MIT */
#include "sim/route.h"

#include "sim/algebra.h"
#include "sim/scenario.h"

static const double shortest_leg_m = 0.3;
static const double sharpest_corner_rad = 2.0; /* beyond it the walker stops and turns */
static const double aligned_rad = 0.3;         /* onto and off stairs without a stop */
static const double facing_rad = 0.02;         /* not worth a turn */
static const double slowest_mps = 0.3;
static const double tread_low_m = 0.2, tread_high_m = 0.8;

typedef struct {
    const sim_list_t *orders;
    const sim_walk_settings_t *walk;
    sim_route_t *route;
    sim_place_t here;
    bool moving; /* the last section ended without a stop */
    sim_error_t *error;
} planner_t;

/* A straight line from a place to an order's waypoint. */
typedef struct {
    double length_m, heading_rad;
} leg_t;

static const sim_order_t *order_at(const planner_t *p, size_t number)
{
    return sim_list_at(p->orders, number);
}

static leg_t leg_between(double x_m, double y_m, const sim_order_t *to)
{
    double dx = to->x_m - x_m, dy = to->y_m - y_m;
    leg_t leg = {hypot(dx, dy), atan2(dy, dx)};
    return leg;
}

/* The leg that ends at the order `number`, whose beginning is the order before or the start. */
static leg_t leg_of(const planner_t *p, size_t number, size_t first)
{
    if (number == first) {
        return leg_between(p->here.x_m, p->here.y_m, order_at(p, number));
    }
    const sim_order_t *before = order_at(p, number - 1);
    return leg_between(before->x_m, before->y_m, order_at(p, number));
}

static bool has_waypoint(const sim_order_t *order)
{
    return order != NULL && (order->kind == SIM_ORDER_WALK || order->kind == SIM_ORDER_STAIRS);
}

static bool add_section(planner_t *p, const sim_section_t *section)
{
    p->here = section->to;
    p->moving = section->end_speed_mps > 0.0;
    p->route->length_m += section->length_m;
    return sim_list_add(&p->route->sections, section) || sim_fail(p->error, "out of memory");
}

static bool add_stand(planner_t *p, double seconds)
{
    sim_section_t stand = {
        .kind = SIM_SECTION_STAND, .from = p->here, .to = p->here, .seconds = seconds};
    return add_section(p, &stand);
}

static bool add_turn(planner_t *p, double heading_rad)
{
    double turn = sim_wrap_pi(heading_rad - p->here.heading_rad);
    if (fabs(turn) <= facing_rad) {
        return true;
    }
    sim_section_t section = {.kind = SIM_SECTION_TURN, .from = p->here, .to = p->here};
    section.to.heading_rad += turn;
    return add_section(p, &section);
}

/* Looks along a leg before setting off; who comes walking is already aligned with it. */
static bool face(planner_t *p, double heading_rad)
{
    if (p->moving || add_turn(p, heading_rad)) {
        p->here.heading_rad = heading_rad;
        return true;
    }
    return false;
}

/* Speed at the end of a section that goes along `heading` to the order `number - 1`. */
static double end_speed(const planner_t *p, size_t number, double heading_rad)
{
    const sim_order_t *before = order_at(p, number - 1), *next = order_at(p, number);
    if (!has_waypoint(next)) {
        return 0.0;
    }
    leg_t leg = leg_between(before->x_m, before->y_m, next);
    if (fabs(sim_wrap_pi(leg.heading_rad - heading_rad)) > aligned_rad) {
        return 0.0;
    }
    return next->kind == SIM_ORDER_STAIRS ? next->speed_mps : before->speed_mps;
}

static bool add_piece(planner_t *p, sim_section_t *section, double length_m, double curvature,
                      double speed_mps)
{
    sim_piece_t piece = {section->length_m, length_m, section->to, curvature, speed_mps};
    if (length_m <= 0.0) {
        return true;
    }
    section->pieces++;
    section->length_m += length_m;
    if (!sim_list_add(&p->route->pieces, &piece)) {
        return sim_fail(p->error, "out of memory");
    }
    section->to = sim_route_at(p->route, section, section->length_m);
    return true;
}

/* How far before a corner its arc begins. */
static double tangent_length(const planner_t *p, const leg_t *leg, const leg_t *next,
                             double corner_rad)
{
    double wanted = p->walk->turn_radius_m * tan(0.5 * fabs(corner_rad));
    return fmin(wanted, 0.45 * fmin(leg->length_m, next->length_m));
}

static double arc_speed(const planner_t *p, double radius_m, const sim_order_t *order,
                        const sim_order_t *next)
{
    double allowed = sqrt(p->walk->corner_mps2 * radius_m);
    return fmax(slowest_mps, fmin(allowed, fmin(order->speed_mps, next->speed_mps)));
}

/* Line and arc for the leg `number`, where a leg follows it; returns where the next line begins. */
static bool add_leg_and_corner(planner_t *p, sim_section_t *section, size_t number, leg_t leg,
                               leg_t next, double *cut_m)
{
    const sim_order_t *order = order_at(p, number);
    double corner = sim_wrap_pi(next.heading_rad - leg.heading_rad);
    double tangent = tangent_length(p, &leg, &next, corner);
    double line = leg.length_m - *cut_m - tangent;
    *cut_m = tangent;
    if (!add_piece(p, section, line, 0.0, order->speed_mps)) {
        return false;
    }
    if (tangent <= 0.0) {
        return true;
    }
    double radius = tangent / tan(0.5 * fabs(corner));
    return add_piece(p, section, radius * fabs(corner), copysign(1.0 / radius, corner),
                     arc_speed(p, radius, order, order_at(p, number + 1)));
}

static bool check_leg(planner_t *p, size_t number, leg_t leg)
{
    if (leg.length_m >= shortest_leg_m) {
        return true;
    }
    sim_fail(p->error, "the waypoint is %.2f m from where the walker is, expected at least %g m",
             leg.length_m, shortest_leg_m);
    return sim_fail_on_line(p->error, order_at(p, number)->line);
}

/* Does the walk go on round the corner after the order `number`? */
static bool goes_on(const planner_t *p, size_t number, leg_t leg)
{
    const sim_order_t *next = order_at(p, number + 1);
    if (next == NULL || next->kind != SIM_ORDER_WALK) {
        return false;
    }
    leg_t next_leg = leg_of(p, number + 1, 0);
    return fabs(sim_wrap_pi(next_leg.heading_rad - leg.heading_rad)) <= sharpest_corner_rad;
}

static sim_section_t new_section(const planner_t *p, sim_section_kind_t kind)
{
    sim_section_t section = {
        .kind = kind, .from = p->here, .to = p->here, .first_piece = p->route->pieces.count};
    return section;
}

/* One section for all legs that are walked without a stop; moves `number` behind them. */
static bool add_walk(planner_t *p, size_t *number)
{
    size_t first = *number;
    leg_t leg = leg_of(p, first, first);
    if (!check_leg(p, first, leg) || !face(p, leg.heading_rad)) {
        return false;
    }
    sim_section_t section = new_section(p, SIM_SECTION_WALK);
    double cut_m = 0.0;
    for (; goes_on(p, *number, leg); (*number)++) {
        leg_t next = leg_of(p, *number + 1, first);
        if (!check_leg(p, *number + 1, next) ||
            !add_leg_and_corner(p, &section, *number, leg, next, &cut_m)) {
            return false;
        }
        leg = next;
    }
    const sim_order_t *last = order_at(p, *number);
    (*number)++;
    section.end_speed_mps = end_speed(p, *number, leg.heading_rad);
    return add_piece(p, &section, leg.length_m - cut_m, 0.0, last->speed_mps) &&
           add_section(p, &section);
}

static bool add_stairs(planner_t *p, size_t *number)
{
    const sim_order_t *order = order_at(p, *number);
    leg_t leg = leg_of(p, *number, *number);
    double count = fmax(1.0, round(fabs(order->z_m - p->here.z_m) / p->walk->riser_m));
    double tread = leg.length_m / count;
    if (!(tread >= tread_low_m && tread <= tread_high_m)) {
        sim_fail(p->error, "%g stairs of %.2f m depth, expected a depth from %g to %g m", count,
                 tread, tread_low_m, tread_high_m);
        return sim_fail_on_line(p->error, order->line);
    }
    if (!face(p, leg.heading_rad)) {
        return false;
    }
    sim_section_t section = new_section(p, SIM_SECTION_STAIRS);
    (*number)++;
    section.end_speed_mps = end_speed(p, *number, leg.heading_rad);
    if (!add_piece(p, &section, leg.length_m, 0.0, order->speed_mps)) {
        return false;
    }
    section.to.z_m = order->z_m;
    return add_section(p, &section);
}

static bool add_order(planner_t *p, size_t *number)
{
    const sim_order_t *order = order_at(p, *number);
    switch (order->kind) {
    case SIM_ORDER_WALK:
        return add_walk(p, number);
    case SIM_ORDER_STAIRS:
        return add_stairs(p, number);
    case SIM_ORDER_PAUSE:
        (*number)++;
        return add_stand(p, order->seconds);
    case SIM_ORDER_TURN:
        (*number)++;
        return add_turn(p, order->heading_rad);
    case SIM_ORDER_START:
    case SIM_ORDER_ERRANDS:
    case SIM_ORDER_SURVEY:
        break;
    }
    return sim_fail(p->error, "an order is out of place");
}

bool sim_route_plan(const sim_list_t *orders, const sim_walk_settings_t *walk, sim_route_t *route,
                    sim_error_t *error)
{
    const sim_order_t *start = sim_list_at(orders, 0);
    route->sections = sim_list(sizeof(sim_section_t));
    route->pieces = sim_list(sizeof(sim_piece_t));
    route->length_m = 0.0;
    if (start == NULL) {
        return sim_fail(error, "there is no start");
    }
    sim_place_t here = {start->x_m, start->y_m, start->z_m, start->heading_rad};
    planner_t planner = {orders, walk, route, here, false, error};
    for (size_t number = 1; number < orders->count;) {
        if (!add_order(&planner, &number)) {
            sim_route_free(route);
            return false;
        }
    }
    return true;
}

static sim_place_t along_piece(const sim_piece_t *piece, double s_m)
{
    sim_place_t at = piece->from;
    double turn = piece->curvature * s_m;
    double chord = fabs(turn) < 1e-9 ? s_m : 2.0 * sin(0.5 * turn) / piece->curvature;
    at.x_m += chord * cos(at.heading_rad + 0.5 * turn);
    at.y_m += chord * sin(at.heading_rad + 0.5 * turn);
    at.heading_rad += turn;
    return at;
}

sim_place_t sim_route_at(const sim_route_t *route, const sim_section_t *section, double s_m)
{
    size_t last = section->first_piece + section->pieces - 1;
    size_t number = section->first_piece;
    const sim_piece_t *piece = sim_list_at(&route->pieces, number);
    while (number < last && s_m > piece->begin_m + piece->length_m) {
        piece = sim_list_at(&route->pieces, ++number);
    }
    sim_place_t at = along_piece(piece, s_m - piece->begin_m);
    double rise = section->to.z_m - section->from.z_m;
    at.z_m = section->from.z_m + rise * s_m / section->length_m;
    return at;
}

double sim_route_speed(const sim_route_t *route, const sim_section_t *section, double s_m,
                       double accel_mps2)
{
    double end = section->end_speed_mps;
    double speed = sqrt(end * end + 2.0 * accel_mps2 * fmax(0.0, section->length_m - s_m));
    for (size_t i = 0; i < section->pieces; i++) {
        const sim_piece_t *piece = sim_list_at(&route->pieces, section->first_piece + i);
        double ahead = fmax(0.0, piece->begin_m - s_m);
        if (s_m < piece->begin_m + piece->length_m) {
            double v = piece->speed_mps;
            speed = fmin(speed, sqrt(v * v + 2.0 * accel_mps2 * ahead));
        }
    }
    return speed;
}

void sim_route_free(sim_route_t *route)
{
    sim_list_free(&route->sections);
    sim_list_free(&route->pieces);
}
