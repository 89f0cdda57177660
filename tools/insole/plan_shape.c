/* SPDX-License-Identifier: MIT */
#include "plan_shape.h"

#include <math.h>

double plan_turn(plan_point_t p, plan_point_t q, plan_point_t r)
{
    return (q.x_m - p.x_m) * (r.y_m - p.y_m) - (q.y_m - p.y_m) * (r.x_m - p.x_m);
}

double plan_piece_distance(plan_point_t p, plan_point_t a, plan_point_t b)
{
    double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, length2 = dx * dx + dy * dy;
    double along = (p.x_m - a.x_m) * dx + (p.y_m - a.y_m) * dy;
    double share = length2 > 0.0 ? fmax(0.0, fmin(1.0, along / length2)) : 0.0;
    return hypot(p.x_m - a.x_m - share * dx, p.y_m - a.y_m - share * dy);
}

bool plan_pieces_cross(plan_point_t a, plan_point_t b, plan_point_t c, plan_point_t d,
                       plan_point_t *where)
{
    double side_a = plan_turn(c, d, a), side_b = plan_turn(c, d, b);
    if (side_a * side_b >= 0.0 || plan_turn(a, b, c) * plan_turn(a, b, d) >= 0.0) {
        return false;
    }
    double share = side_a / (side_a - side_b);
    where->x_m = a.x_m + share * (b.x_m - a.x_m);
    where->y_m = a.y_m + share * (b.y_m - a.y_m);
    return true;
}

double plan_line_distance(const plan_line_t *line, plan_point_t p)
{
    double least_m = HUGE_VAL;
    for (size_t i = 0u; i < plan_line_pieces(line); i++) {
        least_m = fmin(least_m, plan_piece_distance(p, line->points[i], plan_line_end(line, i)));
    }
    return least_m;
}

bool plan_ring_holds(const plan_line_t *ring, plan_point_t p)
{
    int winding = 0;
    for (size_t i = 0u; i < ring->count; i++) {
        plan_point_t a = ring->points[i], b = plan_line_end(ring, i);
        if ((a.y_m > p.y_m) != (b.y_m > p.y_m)) {
            double side = plan_turn(a, b, p);
            winding += b.y_m > p.y_m ? (side > 0.0) : -(side < 0.0);
        }
    }
    return winding != 0;
}

double plan_ring_area(const plan_line_t *ring)
{
    double twice_m2 = 0.0;
    for (size_t i = 0u; i < ring->count; i++) {
        twice_m2 += plan_turn(ring->points[0], ring->points[i], plan_line_end(ring, i));
    }
    return 0.5 * fabs(twice_m2);
}

double plan_distance_outside(const plan_file_t *plan, size_t floor, plan_point_t p)
{
    double least_m = HUGE_VAL;
    for (size_t i = 0u; i < plan->count; i++) {
        const plan_line_t *line = &plan->lines[i];
        if (line->kind != INSOLE_LINE_OUTLINE || line->floor != floor) {
            continue;
        }
        if (plan_ring_holds(line, p)) {
            return 0.0;
        }
        least_m = fmin(least_m, plan_line_distance(line, p));
    }
    return least_m;
}
