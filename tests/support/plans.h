/** @file plans.h  Floor plans for the tests: memory, random drawings, and geometry by brute force
 *  in double precision.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_PLANS_H
#define INSOLE_TESTS_PLANS_H

#include <math.h>
#include <string.h>

#include "insole/base/rng.h"
#include "insole/place/floor_plan_build.h"

enum { PLAN_LINES_MAX = 256, PLAN_POINTS_MAX = 2048, PLAN_ENTRIES_MAX = 32768 };

/** A drawing and the plan that was built of it. */
typedef struct {
    insole_floor_plan_line_t lines[PLAN_LINES_MAX];
    uint32_t line_count;
    insole_real_t xy_m[2 * PLAN_POINTS_MAX];
    uint32_t point_count;
    insole_wall_t walls[PLAN_POINTS_MAX];
    insole_floor_plan_cell_t cells[3 * PLAN_POINTS_MAX];
    uint16_t entries[PLAN_ENTRIES_MAX];
    insole_floor_plan_t plan;
} drawing_t;

static inline void draw_begin(drawing_t *d)
{
    d->line_count = 0;
    d->point_count = 0;
}

/** A line of `count` points x, y; its points are copied. */
static inline void draw_line(drawing_t *d, insole_line_kind_t kind, double loss_db,
                             const double *xy_m, uint32_t count)
{
    insole_real_t *xy = &d->xy_m[2 * d->point_count];
    insole_floor_plan_line_t line = {kind, xy, count, (insole_real_t)loss_db};
    for (uint32_t i = 0; i < 2 * count; i++) {
        xy[i] = (insole_real_t)xy_m[i];
    }
    d->point_count += count;
    d->lines[d->line_count++] = line;
}

static inline void draw_box(drawing_t *d, insole_line_kind_t kind, double loss_db, double x0,
                            double y0, double x1, double y1)
{
    double xy[] = {x0, y0, x1, y0, x1, y1, x0, y1};
    draw_line(d, kind, loss_db, xy, 4);
}

static inline void draw_wall(drawing_t *d, double loss_db, double x0, double y0, double x1,
                             double y1)
{
    double xy[] = {x0, y0, x1, y1};
    draw_line(d, INSOLE_LINE_WALL, loss_db, xy, 2);
}

static inline double draw_uniform(insole_rng_t *rng, double low, double high)
{
    return low + (high - low) * (double)insole_rng_uniform(rng);
}

/** A ring that sees all of itself from its centre, either way round. */
static inline void draw_star(drawing_t *d, insole_rng_t *rng, insole_line_kind_t kind, double x,
                             double y, double radius_m, uint32_t count)
{
    double xy[2 * 64], turn = insole_rng_bits(rng) & 1u ? 1.0 : -1.0;
    for (uint32_t i = 0; i < count; i++) {
        double a = turn * 6.283185307 * (i + draw_uniform(rng, 0.0, 0.9)) / count;
        double r = radius_m * draw_uniform(rng, 0.4, 1.0);
        xy[2 * i] = x + r * cos(a);
        xy[2 * i + 1] = y + r * sin(a);
    }
    draw_line(d, kind, draw_uniform(rng, 1.0, 9.0), xy, count);
}

/** Turns the drawing by an angle about zero, then shifts it. */
static inline void draw_move(drawing_t *d, double angle_rad, double x_m, double y_m)
{
    double c = cos(angle_rad), s = sin(angle_rad);
    for (uint32_t i = 0; i < d->point_count; i++) {
        double x = (double)d->xy_m[2 * i], y = (double)d->xy_m[2 * i + 1];
        d->xy_m[2 * i] = (insole_real_t)(c * x - s * y + x_m);
        d->xy_m[2 * i + 1] = (insole_real_t)(s * x + c * y + y_m);
    }
}

static inline insole_status_t draw_build(drawing_t *d)
{
    insole_floor_plan_memory_t memory = {d->walls,   PLAN_POINTS_MAX, d->cells, 3 * PLAN_POINTS_MAX,
                                         d->entries, PLAN_ENTRIES_MAX};
    return insole_floor_plan_build(&d->plan, d->lines, d->line_count, &memory);
}

/** Some outlines and holes that overlap, and loose walls, in about 40 m x 30 m. */
static inline void draw_random(drawing_t *d, insole_rng_t *rng, uint32_t walls)
{
    draw_begin(d);
    for (int i = 0; i < 2; i++) {
        draw_star(d, rng, INSOLE_LINE_OUTLINE, draw_uniform(rng, 10.0, 30.0),
                  draw_uniform(rng, 10.0, 20.0), 18.0, 24);
    }
    for (int i = 0; i < 5; i++) {
        draw_star(d, rng, INSOLE_LINE_HOLE, draw_uniform(rng, 0.0, 40.0),
                  draw_uniform(rng, 0.0, 30.0), 5.0, 7);
    }
    for (uint32_t i = 0; i < walls; i++) {
        double x = draw_uniform(rng, 0.0, 40.0), y = draw_uniform(rng, 0.0, 30.0);
        double r = 8.0 * pow(draw_uniform(rng, 0.1, 1.0), 2.0);
        double a = draw_uniform(rng, -3.14, 3.14);
        if (i % 3u == 0u) {
            a = 1.57079632679 * floor(a); /* many walls are parallel to an axis */
        }
        draw_wall(d, draw_uniform(rng, 1.0, 9.0), x, y, x + r * cos(a), y + r * sin(a));
    }
}

/* ---- geometry in double precision ---- */

typedef struct {
    double x0, y0, x1, y1;
} segment_t;

/** Edges of a line, as it was drawn. */
static inline uint32_t line_edges(const insole_floor_plan_line_t *line)
{
    return line->kind == INSOLE_LINE_WALL ? line->points - 1u : line->points;
}

static inline segment_t line_edge(const insole_floor_plan_line_t *line, uint32_t i)
{
    const insole_real_t *a = &line->xy_m[2 * i], *b = &line->xy_m[2 * ((i + 1u) % line->points)];
    segment_t s = {(double)a[0], (double)a[1], (double)b[0], (double)b[1]};
    return s;
}

static inline double side_by_double(segment_t s, double x, double y)
{
    return (s.x1 - s.x0) * (y - s.y0) - (s.y1 - s.y0) * (x - s.x0);
}

static inline double distance_by_double(segment_t s, double x, double y)
{
    double dx = s.x1 - s.x0, dy = s.y1 - s.y0, l2 = dx * dx + dy * dy;
    double t = l2 > 0.0 ? ((x - s.x0) * dx + (y - s.y0) * dy) / l2 : 0.0;
    t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    return hypot(x - s.x0 - t * dx, y - s.y0 - t * dy);
}

static inline bool segments_meet(segment_t a, segment_t b)
{
    double a0 = side_by_double(b, a.x0, a.y0), a1 = side_by_double(b, a.x1, a.y1);
    double b0 = side_by_double(a, b.x0, b.y0), b1 = side_by_double(a, b.x1, b.y1);
    return a0 * a1 < 0.0 && b0 * b1 < 0.0;
}

/** Least distance of two segments. */
static inline double segment_distance(segment_t a, segment_t b)
{
    if (segments_meet(a, b)) {
        return 0.0;
    }
    return fmin(fmin(distance_by_double(a, b.x0, b.y0), distance_by_double(a, b.x1, b.y1)),
                fmin(distance_by_double(b, a.x0, a.y0), distance_by_double(b, a.x1, a.y1)));
}

/** Least distance of a segment from all walls of a drawing. */
static inline double drawing_distance(const drawing_t *d, segment_t s)
{
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < d->line_count; i++) {
        for (uint32_t k = 0; k < line_edges(&d->lines[i]); k++) {
            least = fmin(least, segment_distance(s, line_edge(&d->lines[i], k)));
        }
    }
    return least;
}

/** Is a point inside one ring? By the parity of a ray. */
static inline bool ring_holds(const insole_floor_plan_line_t *ring, double x, double y)
{
    bool inside = false;
    for (uint32_t k = 0; k < ring->points; k++) {
        segment_t e = line_edge(ring, k);
        if ((e.y0 > y) != (e.y1 > y) && x < e.x0 + (y - e.y0) / (e.y1 - e.y0) * (e.x1 - e.x0)) {
            inside = !inside;
        }
    }
    return inside;
}

/** Is a point in an outline and in no hole? */
static inline bool drawing_inside(const drawing_t *d, double x, double y)
{
    bool inside = false;
    for (uint32_t i = 0; i < d->line_count; i++) {
        if (d->lines[i].kind != INSOLE_LINE_WALL && ring_holds(&d->lines[i], x, y)) {
            if (d->lines[i].kind == INSOLE_LINE_HOLE) {
                return false;
            }
            inside = true;
        }
    }
    return inside;
}

#endif
