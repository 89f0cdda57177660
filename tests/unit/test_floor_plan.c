/* SPDX-License-Identifier: MIT */
#include "insole/place/floor_plan.h"

#include "near.h"
#include "plans.h"
#include "suite.h"

static drawing_t drawing;
static insole_rng_t rng;

/* A room of 10 m x 10 m at (0, 0) with a hole in its upper right and a wall x = 4 with a door. */
static void draw_room(void)
{
    draw_begin(&drawing);
    draw_box(&drawing, INSOLE_LINE_OUTLINE, 10.0, 0.0, 0.0, 10.0, 10.0);
    draw_box(&drawing, INSOLE_LINE_HOLE, 7.0, 7.0, 7.0, 9.0, 9.0);
    draw_wall(&drawing, 3.0, 4.0, 0.0, 4.0, 5.0);
    draw_wall(&drawing, 3.0, 4.0, 6.0, 4.0, 10.0);
    double slant[] = {5.0, 2.0, 6.0, 3.0, 7.0, 2.0};
    draw_line(&drawing, INSOLE_LINE_WALL, 4.0, slant, 3);
}

typedef struct {
    double x, y;
} spot_t;

/* How the room is laid on the map. */
typedef struct {
    double angle_rad, x_m, y_m;
    double sharp_m; /* coordinates are good to this */
} frame_t;

static const frame_t frames[] = {
    {0.0, 0.0, 0.0, 1e-6},
    {0.645771823, 0.0, 0.0, 1e-5},
    {0.0, 500.0, -500.0, 1e-4},
    {0.645771823, 500.0, 500.0, 1e-4},
    {0.645771823, -500.0, 0.0, 1e-4},
    {0.0, 10000.0, -10000.0, 2e-3},
    {0.645771823, 10000.0, 10000.0, 2e-3},
};
enum { FRAMES = sizeof frames / sizeof frames[0] };

static spot_t moved(const frame_t *f, double x, double y)
{
    spot_t p = {cos(f->angle_rad) * x - sin(f->angle_rad) * y + f->x_m,
                sin(f->angle_rad) * x + cos(f->angle_rad) * y + f->y_m};
    return p;
}

static bool crosses(const insole_floor_plan_t *plan, spot_t a, spot_t b)
{
    return insole_floor_plan_crosses(plan, (insole_real_t)a.x, (insole_real_t)a.y,
                                     (insole_real_t)b.x, (insole_real_t)b.y);
}

static const struct {
    const char *what;
    double x0, y0, x1, y1;
    bool crosses;
    double margin_m; /* how far it is from being otherwise */
} ways[] = {
    {"free", 1, 1, 3, 3, false, 0.9},
    {"through a wall", 3, 2, 5, 2.5, true, 0.4},
    {"the same back", 5, 2.5, 3, 2, true, 0.4},
    {"through the door", 3, 5.5, 5, 5.5, false, 0.4},
    {"aslant through the door", 3.6, 5.2, 4.4, 5.8, false, 0.1},
    {"a hand's breadth beside the door", 3, 4.98, 5, 4.98, true, 0.01},
    {"touches the end of a wall", 3, 5, 5, 5, true, 1e-3},
    {"just not", 3, 5.01, 5, 5.01, false, 8e-3},
    {"touches the tip of two walls", 5, 3, 7, 3, true, 1e-3},
    {"above the tip", 5, 3.01, 7, 3.01, false, 8e-3},
    {"touches the corner of the hole", 6, 8, 8, 6, true, 1e-3},
    {"passes the corner", 6, 7.98, 7.98, 6, false, 8e-3},
    {"through the corner of the room", 9, -1, 11, 1, true, 1e-3},
    {"ends at a wall", 3, 2, 4, 2, true, 1e-3},
    {"begins at a wall", 4, 2, 3, 2, true, 1e-3},
    {"ends short of a wall", 3, 2, 3.99, 2, false, 8e-3},
    {"along a wall", 4, 1, 4, 3, true, 1e-3},
    {"along a wall and beyond", 4, 4, 4, 5.5, true, 0.4},
    {"along the line of two walls, in the door", 4, 5.1, 4, 5.9, false, 0.08},
    {"along a slanting wall", 5.2, 2.2, 5.8, 2.8, true, 1e-3},
    {"on the line of a slanting wall", 4.2, 1.2, 4.9, 1.9, false, 0.1},
    {"beside a slanting wall", 5.0, 2.1, 5.8, 2.9, false, 0.05},
    {"stands free", 2, 2, 2, 2, false, 0.9},
    {"stands on a wall", 4, 2, 4, 2, true, 1e-3},
    {"stands on a tip", 6, 3, 6, 3, true, 1e-3},
    {"stands on the line of a wall, in the door", 4, 5.5, 4, 5.5, false, 0.4},
    {"within the hole", 7.5, 7.5, 8.5, 8.5, false, 0.4},
    {"into the hole", 6, 8, 8, 8, true, 0.9},
    {"across the hole", 6, 8, 9.5, 8, true, 0.4},
    {"out of the room", 1, 1, 1, -3, true, 0.9},
    {"outside", -3, -2, 12, -2, false, 1.9},
    {"outside, far", -3000, 60, 9000, 70, false, 49.0},
    {"outside, past a corner", -1, 2, 2, -1.5, true, 0.1},
    {"from far to far", -3000, 5.5, 3000, 5.5, true, 4.0},
    {"along the edge of the room from far", -300, 10, 300, 10, true, 1e-3},
    {"beyond the edge of the room", -300, 10.01, 300, 10.01, false, 8e-3},
    {"length of the room", 1, 5.5, 9, 5.5, false, 0.4},
};
enum { WAYS = sizeof ways / sizeof ways[0] };

START_TEST(each_way_in_each_frame)
{
    const frame_t *f = &frames[_i];
    draw_room();
    draw_move(&drawing, f->angle_rad, f->x_m, f->y_m);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (int i = 0; i < WAYS; i++) {
        spot_t a = moved(f, ways[i].x0, ways[i].y0), b = moved(f, ways[i].x1, ways[i].y1);
        if (ways[i].margin_m > f->sharp_m) {
            ck_assert_msg(crosses(&drawing.plan, a, b) == ways[i].crosses, "%s", ways[i].what);
        }
    }
}
END_TEST

static const struct {
    const char *what;
    double x, y;
    bool inside;
} spots[] = {
    {"in the room", 1, 1, true},
    {"beyond the inner wall", 6, 6, true},
    {"in the hole", 8, 8, false},
    {"beside the hole", 6.9, 8, true},
    {"above the hole", 8, 9.1, true},
    {"outside left", -0.1, 5, false},
    {"outside right", 10.1, 5, false},
    {"outside below", 5, -0.1, false},
    {"in the grid's margin", 5, 10.5, false},
    {"far outside", -4000, 70000, false},
    {"corner of the room", 0.01, 0.01, true},
    {"level with corners", 9.5, 9.0, true},
    {"level with corners, left", 0.5, 7.0, true},
    {"level with corners, outside", -0.5, 9.0, false},
};
enum { SPOTS = sizeof spots / sizeof spots[0] };

START_TEST(each_spot_in_each_frame)
{
    const frame_t *f = &frames[_i];
    draw_room();
    draw_move(&drawing, f->angle_rad, f->x_m, f->y_m);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (int i = 0; i < SPOTS; i++) {
        spot_t p = moved(f, spots[i].x, spots[i].y);
        ck_assert_msg(insole_floor_plan_inside(&drawing.plan, (insole_real_t)p.x,
                                               (insole_real_t)p.y) == spots[i].inside,
                      "%s", spots[i].what);
    }
}
END_TEST

static const struct {
    const char *what;
    double x0, y0, x1, y1;
    uint32_t count;
    double loss_db;
} rays[] = {
    {"free", 1, 1, 3, 3, 0, 0},
    {"one wall", 1, 2, 4.9, 2.2, 1, 3},
    {"through the door", 1, 5.5, 9, 5.5, 0, 0},
    {"one wall and a hole", 1, 8, 9.5, 8, 3, 17},
    {"into the hole", 6, 8, 8, 8, 1, 7},
    {"right through", -5, 2.5, 15, 2.5, 5, 31},
    {"backwards", 15, 2.5, -5, 2.5, 5, 31},
    {"from far", -3000, 2.5, 3000, 2.5, 5, 31},
    {"from an access point on a wall", 4, 2, 2, 2, 0, 0},
    {"from an access point on a wall, other way", 4, 2, 4.9, 2.2, 0, 0},
    {"to an access point on a wall", 1, 2, 4, 2, 0, 0},
    {"along a wall", 4, 0.5, 4, 4.5, 0, 0},
    {"through a corner of the hole, into it", 6, 6.5, 8, 7.5, 1, 7},
    {"no way at all", 1, 1, 1, 1, 0, 0},
    {"outside", -3, -2, 12, -2, 0, 0},
};
enum { RAYS = sizeof rays / sizeof rays[0] };

START_TEST(each_ray_in_each_frame)
{
    const frame_t *f = &frames[_i];
    draw_room();
    draw_move(&drawing, f->angle_rad, f->x_m, f->y_m);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (int i = 0; i < RAYS && f->sharp_m < 1e-3; i++) {
        spot_t a = moved(f, rays[i].x0, rays[i].y0), b = moved(f, rays[i].x1, rays[i].y1);
        insole_walls_between_t between;
        ck_assert_int_eq(insole_floor_plan_walls_between(&drawing.plan, (insole_real_t)a.x,
                                                         (insole_real_t)a.y, (insole_real_t)b.x,
                                                         (insole_real_t)b.y, &between),
                         INSOLE_OK);
        ck_assert_msg(between.count == rays[i].count, "%s: %u walls", rays[i].what, between.count);
        ASSERT_NEAR(between.loss_db, rays[i].loss_db, 1e-5, "dB");
    }
}
END_TEST

START_TEST(clearance_by_hand)
{
    static const double cases[][4] = {
        {2, 5.5, 5, 2.0}, {2, 5.5, 1, 1.0},   {3.5, 2, 1, 0.5},      {4, 2, 1, 0},
        {8, 8, 3, 1.0},   {6, 3.5, 2, 0.5},   {-3, -4, 9, 5.0},      {-3, -4, 2, 2},
        {4, 5.5, 9, 0.5}, {1e5, 1e5, 10, 10}, {6, 2.5, 3, 0.353553}, {9.75, 0.5, 2, 0.25}};
    draw_room();
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        insole_real_t distance;
        ck_assert_int_eq(insole_floor_plan_clearance(&drawing.plan, (insole_real_t)cases[i][0],
                                                     (insole_real_t)cases[i][1],
                                                     (insole_real_t)cases[i][2], &distance),
                         INSOLE_OK);
        ASSERT_NEAR(distance, cases[i][3], 1e-5, "m");
    }
}
END_TEST

/* Ways of all lengths; every other one begins or ends on a wall, or just beside it. */
static segment_t random_way(void)
{
    double r = 40.0 * pow(draw_uniform(&rng, 0.0, 1.0), 3.0), a = draw_uniform(&rng, -3.15, 3.15);
    segment_t s = {draw_uniform(&rng, -5.0, 45.0), draw_uniform(&rng, -5.0, 35.0), 0.0, 0.0};
    if (insole_rng_bits(&rng) & 1u) {
        const insole_floor_plan_line_t *line =
            &drawing.lines[insole_rng_bits(&rng) % drawing.line_count];
        segment_t e = line_edge(line, insole_rng_bits(&rng) % line_edges(line));
        double t = floor(draw_uniform(&rng, 0.0, 4.0)) / 3.0;
        double off = 2e-3 * floor(draw_uniform(&rng, -2.0, 3.0));
        double l = hypot(e.x1 - e.x0, e.y1 - e.y0);
        s.x0 = e.x0 + t * (e.x1 - e.x0) - off * (e.y1 - e.y0) / l;
        s.y0 = e.y0 + t * (e.y1 - e.y0) + off * (e.x1 - e.x0) / l;
        if (insole_rng_bits(&rng) & 1u) {
            a = atan2(e.y1 - e.y0, e.x1 - e.x0); /* along the wall */
        }
    }
    s.x1 = s.x0 + r * cos(a);
    s.y1 = s.y0 + r * sin(a);
    segment_t rounded = {(double)(insole_real_t)s.x0, (double)(insole_real_t)s.y0,
                         (double)(insole_real_t)s.x1, (double)(insole_real_t)s.y1};
    return rounded;
}

static bool crosses_segment(segment_t s)
{
    return insole_floor_plan_crosses(&drawing.plan, (insole_real_t)s.x0, (insole_real_t)s.y0,
                                     (insole_real_t)s.x1, (insole_real_t)s.y1);
}

enum { PLANS = 12, WAYS_PER_PLAN = 2000 };

/* +1: must meet a wall, and does. -1: must not, and does not. 0: either may be. */
static int check_crosses(segment_t s)
{
    double distance = drawing_distance(&drawing, s);
    if (distance > 0.98e-3 && distance < 2e-3) {
        return 0;
    }
    ck_assert_msg(crosses_segment(s) == (distance < 1e-3), "%.9g %.9g %.9g %.9g is %.3g m off",
                  s.x0, s.y0, s.x1, s.y1, distance);
    return distance < 1e-3 ? 1 : -1;
}

START_TEST(crosses_as_by_brute_force)
{
    int told[3] = {0, 0, 0};
    insole_rng_seed(&rng, 100u + (uint32_t)_i);
    draw_random(&drawing, &rng, 5u + 15u * (uint32_t)_i);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (int i = 0; i < WAYS_PER_PLAN; i++) {
        told[1 + check_crosses(random_way())]++;
    }
    ck_assert_int_gt(told[0], WAYS_PER_PLAN / 10);
    ck_assert_int_gt(told[2], WAYS_PER_PLAN / 4);
}
END_TEST

/* Counts by double precision; false where a point lies too close to a wall's line, or a wall's end
 * to the ray, to tell. */
static bool count_walls(segment_t ray, uint32_t *count, double *loss_db)
{
    double length = hypot(ray.x1 - ray.x0, ray.y1 - ray.y0);
    *count = 0;
    *loss_db = 0.0;
    for (uint32_t i = 0; i < drawing.line_count; i++) {
        for (uint32_t k = 0; k < line_edges(&drawing.lines[i]); k++) {
            segment_t e = line_edge(&drawing.lines[i], k);
            double l = hypot(e.x1 - e.x0, e.y1 - e.y0);
            if (segment_distance(ray, e) < 0.01 &&
                (fabs(side_by_double(e, ray.x0, ray.y0)) < 2e-3 * l ||
                 fabs(side_by_double(e, ray.x1, ray.y1)) < 2e-3 * l ||
                 fabs(side_by_double(ray, e.x0, e.y0)) < 1e-4 * length ||
                 fabs(side_by_double(ray, e.x1, e.y1)) < 1e-4 * length)) {
                return false;
            }
            if (segments_meet(ray, e)) {
                ++*count;
                *loss_db += (double)drawing.lines[i].loss_db;
            }
        }
    }
    return true;
}

/* Who asks for no more than a limit is told as much as there is up to it. */
static void check_walls_until(segment_t s, const insole_walls_between_t *all)
{
    insole_walls_between_t until;
    insole_real_t enough_db = (insole_real_t)draw_uniform(&rng, 0.0, 1.2) * all->loss_db;
    ck_assert_int_eq(insole_floor_plan_walls_until(&drawing.plan, (insole_real_t)s.x0,
                                                   (insole_real_t)s.y0, (insole_real_t)s.x1,
                                                   (insole_real_t)s.y1, enough_db, &until),
                     INSOLE_OK);
    if (until.loss_db < enough_db) {
        ck_assert_uint_eq(until.count, all->count);
        ASSERT_NEAR(until.loss_db, all->loss_db, 0.0, "dB");
    }
    ck_assert(until.count <= all->count && until.loss_db <= all->loss_db);
}

/* The number of walls, or -1 where none can tell. */
static int check_walls_between(segment_t s)
{
    uint32_t count;
    double loss_db;
    insole_walls_between_t between;
    if (!count_walls(s, &count, &loss_db)) {
        return -1;
    }
    ck_assert_int_eq(insole_floor_plan_walls_between(&drawing.plan, (insole_real_t)s.x0,
                                                     (insole_real_t)s.y0, (insole_real_t)s.x1,
                                                     (insole_real_t)s.y1, &between),
                     INSOLE_OK);
    ck_assert_msg(between.count == count, "%.9g %.9g %.9g %.9g: %u walls, expected %u", s.x0, s.y0,
                  s.x1, s.y1, between.count, count);
    ASSERT_NEAR(between.loss_db, loss_db, 1e-4, "dB");
    check_walls_until(s, &between);
    return (int)count;
}

START_TEST(walls_between_as_by_brute_force)
{
    int most = 0, told = 0;
    insole_rng_seed(&rng, 200u + (uint32_t)_i);
    draw_random(&drawing, &rng, 5u + 15u * (uint32_t)_i);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (int i = 0; i < WAYS_PER_PLAN; i++) {
        int count = check_walls_between(random_way());
        told += count >= 0;
        most = count > most ? count : most;
    }
    ck_assert_int_gt(told, WAYS_PER_PLAN / 3);
    ck_assert_int_gt(most, 6);
}
END_TEST

START_TEST(inside_as_by_brute_force)
{
    int in = 0, told = 0;
    insole_rng_seed(&rng, 300u + (uint32_t)_i);
    draw_random(&drawing, &rng, 10u);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (int i = 0; i < 4 * WAYS_PER_PLAN; i++) {
        double x = draw_uniform(&rng, -8.0, 48.0), y = draw_uniform(&rng, -8.0, 38.0);
        segment_t here = {x, y, x, y};
        if (drawing_distance(&drawing, here) > 1e-4) {
            bool expected = drawing_inside(&drawing, x, y);
            ck_assert_msg(insole_floor_plan_inside(&drawing.plan, (insole_real_t)x,
                                                   (insole_real_t)y) == expected,
                          "(%.9g, %.9g)", x, y);
            in += expected;
            told++;
        }
    }
    ck_assert_int_gt(in, told / 10);
    ck_assert_int_lt(in, told * 9 / 10);
}
END_TEST

START_TEST(clearance_as_by_brute_force)
{
    insole_rng_seed(&rng, 400u + (uint32_t)_i);
    draw_random(&drawing, &rng, 5u + 10u * (uint32_t)_i);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (int i = 0; i < WAYS_PER_PLAN; i++) {
        double limit = 6.0 * pow(draw_uniform(&rng, 0.05, 1.0), 2.0);
        segment_t here = random_way();
        here.x1 = here.x0;
        here.y1 = here.y0;
        insole_real_t distance;
        ck_assert_int_eq(insole_floor_plan_clearance(&drawing.plan, (insole_real_t)here.x0,
                                                     (insole_real_t)here.y0, (insole_real_t)limit,
                                                     &distance),
                         INSOLE_OK);
        ASSERT_NEAR(distance, fmin(limit, drawing_distance(&drawing, here)), 2e-5, "m");
    }
}
END_TEST

/* A stride from cell to cell in a large plan of rooms; each wall is parallel to an axis and many
 * ways run from corner to corner of cells, where a search through a grid is most easily wrong. */
START_TEST(neat_numbers_as_by_brute_force)
{
    draw_begin(&drawing);
    draw_box(&drawing, INSOLE_LINE_OUTLINE, 5.0, 0.0, 0.0, 24.0, 24.0);
    for (int i = 1; i < 6; i++) {
        for (int k = 0; k < 6; k++) {
            draw_wall(&drawing, 5.0, 4.0 * i, 4.0 * k, 4.0 * i, 4.0 * k + 3.0);
            draw_wall(&drawing, 5.0, 4.0 * k, 4.0 * i, 4.0 * k + 3.0, 4.0 * i);
        }
    }
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    insole_rng_seed(&rng, 500u);
    for (int i = 0; i < 20000; i++) {
        segment_t s = {floor(draw_uniform(&rng, -4.0, 100.0)) / 4.0,
                       floor(draw_uniform(&rng, -4.0, 100.0)) / 4.0, 0.0, 0.0};
        s.x1 = s.x0 + floor(draw_uniform(&rng, -8.0, 9.0)) / 4.0;
        s.y1 = s.y0 + floor(draw_uniform(&rng, -8.0, 9.0)) / 4.0;
        ck_assert_msg(crosses_segment(s) == (drawing_distance(&drawing, s) < 1e-9),
                      "%.9g %.9g %.9g %.9g", s.x0, s.y0, s.x1, s.y1);
        if (drawing_distance(&drawing, s) > 1e-9) {
            ck_assert(
                insole_floor_plan_inside(&drawing.plan, (insole_real_t)s.x0, (insole_real_t)s.y0) ==
                drawing_inside(&drawing, s.x0, s.y0));
        }
    }
}
END_TEST

/* Walls that lie exactly on borders of cells, and rays that pass them there. */
START_TEST(walls_on_borders_of_cells)
{
    insole_real_t cell_m = 0;
    for (int round = 0; round < 2; round++) {
        draw_begin(&drawing);
        draw_box(&drawing, INSOLE_LINE_OUTLINE, 5.0, 0.0, 0.0, 40.0, 30.0);
        double step = round == 0 ? 2.0 : (double)cell_m;
        for (int i = 0; i < 24; i++) {
            double at = step * (2 + i % 4) - 1.0; /* the origin lies 1 m before the drawing */
            double from = 1.0 + 4.0 * (i / 4);
            draw_wall(&drawing, 5.0, at, from, at, from + 3.5);
            draw_wall(&drawing, 5.0, from, at, from + 4.0, at);
        }
        ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
        ck_assert(round == 0 || drawing.plan.cell_m == cell_m);
        cell_m = drawing.plan.cell_m;
    }
    insole_rng_seed(&rng, 700u);
    for (int i = 0; i < WAYS_PER_PLAN; i++) {
        check_crosses(random_way());
        check_walls_between(random_way());
    }
}
END_TEST

/* Answers do not depend on where north is and where zero lies. */
START_TEST(turned_and_shifted_answers_alike)
{
    static drawing_t plain;
    static const frame_t f = {0.645771823, 500.0, -500.0, 1e-4};
    insole_rng_seed(&rng, 600u);
    draw_random(&drawing, &rng, 60u);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    plain = drawing;
    plain.plan.walls = plain.walls;
    plain.plan.cells = plain.cells;
    plain.plan.entries = plain.entries;
    int told = 0;
    segment_t kept[WAYS_PER_PLAN];
    for (int i = 0; i < WAYS_PER_PLAN; i++) {
        kept[i] = random_way();
    }
    draw_move(&drawing, f.angle_rad, f.x_m, f.y_m);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (int i = 0; i < WAYS_PER_PLAN; i++) {
        spot_t a = moved(&f, kept[i].x0, kept[i].y0), b = moved(&f, kept[i].x1, kept[i].y1);
        segment_t s = {a.x, a.y, b.x, b.y};
        double distance = drawing_distance(&drawing, s);
        if (distance < 0.8e-3 || distance > 2.2e-3) {
            told++;
            ck_assert(crosses(&drawing.plan, a, b) ==
                      insole_floor_plan_crosses(
                          &plain.plan, (insole_real_t)kept[i].x0, (insole_real_t)kept[i].y0,
                          (insole_real_t)kept[i].x1, (insole_real_t)kept[i].y1));
        }
    }
    ck_assert_int_gt(told, WAYS_PER_PLAN * 9 / 10);
}
END_TEST

/* ---- what must hold between answers, in a plan too large for brute force ---- */

/* Rooms of 4 m x 4 m with doors of 1 m, and a yard in the middle. */
static void draw_offices(int side)
{
    draw_begin(&drawing);
    draw_box(&drawing, INSOLE_LINE_OUTLINE, 6.0, 0.0, 0.0, 4.0 * side, 4.0 * side);
    draw_box(&drawing, INSOLE_LINE_HOLE, 6.0, 13.0, 13.0, 19.0, 18.0);
    for (int i = 1; i < side; i++) {
        for (int k = 0; k < side; k++) {
            double door = 1.0 + (i * 7 + k * 3) % 3;
            double across[] = {4.0 * i, 4.0 * k, 4.0 * i, 4.0 * k + door};
            double rest[] = {4.0 * i, 4.0 * k + door + 1.0, 4.0 * i, 4.0 * k + 4.0};
            draw_line(&drawing, INSOLE_LINE_WALL, 3.0, across, 2);
            draw_line(&drawing, INSOLE_LINE_WALL, 3.0, rest, 2);
            draw_wall(&drawing, 3.0, 4.0 * k, 4.0 * i, 4.0 * k + 3.0, 4.0 * i);
        }
    }
    draw_move(&drawing, 0.3, -700.0, 90.0);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
}

static spot_t office_spot(void)
{
    static const frame_t f = {0.3, -700.0, 90.0, 1e-4};
    spot_t p = moved(&f, draw_uniform(&rng, -1.0, 33.0), draw_uniform(&rng, -1.0, 33.0));
    p.x = (double)(insole_real_t)p.x;
    p.y = (double)(insole_real_t)p.y;
    return p;
}

static insole_walls_between_t walls_between(spot_t a, spot_t b)
{
    insole_walls_between_t between;
    ck_assert_int_eq(insole_floor_plan_walls_between(&drawing.plan, (insole_real_t)a.x,
                                                     (insole_real_t)a.y, (insole_real_t)b.x,
                                                     (insole_real_t)b.y, &between),
                     INSOLE_OK);
    return between;
}

static bool inside(spot_t p)
{
    return insole_floor_plan_inside(&drawing.plan, (insole_real_t)p.x, (insole_real_t)p.y);
}

static double clearance(spot_t p, double limit_m)
{
    insole_real_t distance_m;
    ck_assert_int_eq(insole_floor_plan_clearance(&drawing.plan, (insole_real_t)p.x,
                                                 (insole_real_t)p.y, (insole_real_t)limit_m,
                                                 &distance_m),
                     INSOLE_OK);
    return (double)distance_m;
}

START_TEST(both_ways_alike)
{
    insole_rng_seed(&rng, 800u);
    draw_offices(8);
    for (int i = 0; i < 20000; i++) {
        spot_t a = office_spot(), b = office_spot();
        ck_assert(crosses(&drawing.plan, a, b) == crosses(&drawing.plan, b, a));
        insole_walls_between_t there = walls_between(a, b), back = walls_between(b, a);
        ck_assert_uint_eq(there.count, back.count);
        ASSERT_NEAR(there.loss_db, back.loss_db, 1e-4, "dB");
    }
}
END_TEST

/* A way meets a wall when one of its halves does; walls add up over the halves. */
START_TEST(halves_make_the_whole)
{
    int met = 0;
    insole_rng_seed(&rng, 810u);
    draw_offices(8);
    for (int i = 0; i < 20000; i++) {
        spot_t a = office_spot(), b = office_spot();
        double t = i & 1 ? 0.02 : 1.0;
        b.x = (double)(insole_real_t)(a.x + t * (b.x - a.x));
        b.y = (double)(insole_real_t)(a.y + t * (b.y - a.y));
        spot_t half = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
        if (clearance(half, 0.02) < 0.01 || clearance(a, 0.02) < 0.01 ||
            clearance(b, 0.02) < 0.01) {
            continue;
        }
        bool whole = crosses(&drawing.plan, a, b);
        ck_assert(whole == (crosses(&drawing.plan, a, half) || crosses(&drawing.plan, half, b)));
        ck_assert_uint_le(walls_between(a, b).count, 200u);
        ck_assert(whole || walls_between(a, b).count == 0u);
        met += whole;
    }
    ck_assert_int_gt(met, 5000);
    ck_assert_int_lt(met, 15000);
}
END_TEST

/* Nobody leaves the walkable area without meeting a wall; within the clearance there is none. */
START_TEST(answers_agree_with_each_other)
{
    insole_rng_seed(&rng, 820u);
    draw_offices(8);
    for (int i = 0; i < 20000; i++) {
        spot_t a = office_spot(), b = office_spot();
        double free_m = clearance(a, 2.0), angle = draw_uniform(&rng, -3.2, 3.2);
        ck_assert(inside(a) == inside(b) || crosses(&drawing.plan, a, b));
        spot_t near = {a.x + 0.99 * free_m * cos(angle), a.y + 0.99 * free_m * sin(angle)};
        spot_t beyond = {a.x + 0.5 * cos(angle), a.y + 0.5 * sin(angle)};
        ck_assert(free_m < 0.2 || !crosses(&drawing.plan, a, near));
        ck_assert(free_m < 0.2 || inside(a) == inside(near));
        ASSERT_AT_MOST(fabs(clearance(beyond, 2.0) - free_m), 0.5 + 1e-4, "m");
    }
}
END_TEST

/* Walkers that take no step through a wall stay in the building, and get about in it. */
START_TEST(walkers_stay_in)
{
    enum { WALKERS = 100, STEPS = 600 };
    int refused = 0, far = 0;
    insole_rng_seed(&rng, 830u);
    draw_offices(8);
    for (int i = 0; i < WALKERS; i++) {
        spot_t p = office_spot();
        while (!inside(p) || clearance(p, 0.1) < 0.01) {
            p = office_spot();
        }
        spot_t start = p;
        double heading = draw_uniform(&rng, -3.2, 3.2);
        for (int k = 0; k < STEPS; k++) {
            heading += draw_uniform(&rng, -0.5, 0.5);
            spot_t next = {(double)(insole_real_t)(p.x + 0.7 * cos(heading)),
                           (double)(insole_real_t)(p.y + 0.7 * sin(heading))};
            if (crosses(&drawing.plan, p, next)) {
                heading += 1.0;
                refused++;
            } else {
                p = next;
            }
            ck_assert(inside(p));
        }
        far += hypot(p.x - start.x, p.y - start.y) > 4.0;
    }
    ck_assert_int_gt(refused, WALKERS * STEPS / 50);
    ck_assert_int_gt(far, WALKERS / 3);
}
END_TEST

/* One corridor, 2 m x 4 m in two cells, as a generated file would hold it. */
static const insole_wall_t flash_walls[] = {
    {1, 1, 3, 1, 6}, {3, 1, 3, 5, 6}, {3, 5, 1, 5, 6}, {1, 5, 1, 1, 6}, {1, 3.25, 2, 3.25, 2}};
static const insole_floor_plan_cell_t flash_cells[] = {{0, 1, 0}, {3, 1, 0}, {7, 0, 0}};
static const uint16_t flash_entries[] = {0, 1, 3, 1, 2, 3, 4};
static const insole_floor_plan_t flash_plan = {
    99, -1, 3, INSOLE_R(1.0) / 3, INSOLE_R(0.5), INSOLE_R(0.55), 1, 2,
    4,  4,  5, flash_walls,       flash_cells,   flash_entries};

START_TEST(a_plan_in_flash)
{
    ck_assert(insole_floor_plan_inside(&flash_plan, 101, 1));
    ck_assert(!insole_floor_plan_inside(&flash_plan, INSOLE_R(99.5), 1));
    ck_assert(insole_floor_plan_crosses(&flash_plan, INSOLE_R(100.5), 1, INSOLE_R(100.5), 3));
    ck_assert(!insole_floor_plan_crosses(&flash_plan, INSOLE_R(101.5), 1, INSOLE_R(101.5), 3));
    insole_walls_between_t between;
    ck_assert_int_eq(insole_floor_plan_walls_between(&flash_plan, INSOLE_R(100.5), 1,
                                                     INSOLE_R(100.5), 9, &between),
                     INSOLE_OK);
    ck_assert_uint_eq(between.count, 2u);
    ASSERT_NEAR(between.loss_db, 8.0, 0.0, "dB");
}
END_TEST

START_TEST(bad_input)
{
    static const insole_real_t bad[] = {(double)NAN,   (double)INFINITY, -(double)INFINITY,
                                        INSOLE_R(1e7), -INSOLE_R(2e6),   INSOLE_REAL_MAX};
    insole_walls_between_t between = {7u, 3}, between_before = between;
    insole_real_t distance = 5;
    draw_room();
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    const insole_floor_plan_t *plan = &drawing.plan;
    ck_assert(insole_floor_plan_crosses(NULL, 1, 1, 2, 2));
    ck_assert(!insole_floor_plan_inside(NULL, 1, 1));
    ck_assert_int_eq(insole_floor_plan_walls_between(NULL, 1, 1, 2, 2, &between), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_floor_plan_walls_between(plan, 1, 1, 2, 2, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_floor_plan_walls_until(NULL, 1, 1, 2, 2, 9, &between), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_floor_plan_walls_until(plan, 1, 1, 2, 2, 9, NULL), INSOLE_ERR_NULL);
    ck_assert(!insole_floor_plan_is_closed(NULL, 1, 1, 1));
    ck_assert(insole_floor_plan_is_closed(plan, (insole_real_t)NAN, 1, 1));
    ck_assert(insole_floor_plan_is_closed(plan, 1, INSOLE_R(1e30), 1));
    ck_assert_int_eq(insole_floor_plan_clearance(NULL, 1, 1, 2, &distance), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_floor_plan_clearance(plan, 1, 1, 2, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_floor_plan_clearance(plan, 1, 1, 0, &distance), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_floor_plan_clearance(plan, 1, 1, -1, &distance), INSOLE_ERR_VALUE);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        for (int k = 0; k < 4; k++) {
            insole_real_t x[4] = {1, 1, 2, 2};
            x[k] = bad[i];
            ck_assert(insole_floor_plan_crosses(plan, x[0], x[1], x[2], x[3]));
            ck_assert_int_eq(
                insole_floor_plan_walls_between(plan, x[0], x[1], x[2], x[3], &between),
                INSOLE_ERR_VALUE);
            ck_assert_int_eq(
                insole_floor_plan_walls_until(plan, x[0], x[1], x[2], x[3], 9, &between),
                INSOLE_ERR_VALUE);
            if (k < 3) {
                ck_assert_int_eq(insole_floor_plan_clearance(plan, x[0], x[1], x[2], &distance),
                                 INSOLE_ERR_VALUE);
            }
        }
        ck_assert(!insole_floor_plan_inside(plan, bad[i], 1));
        ck_assert(!insole_floor_plan_inside(plan, 1, bad[i]));
    }
    ck_assert_mem_eq(&between, &between_before, sizeof between);
    ASSERT_NEAR(distance, 5.0, 0.0, "m");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("floor_plan");
    suite_add_loop(suite, "ways by hand, in each frame", each_way_in_each_frame, FRAMES);
    suite_add_loop(suite, "spots by hand, in each frame", each_spot_in_each_frame, FRAMES);
    suite_add_loop(suite, "rays by hand, in each frame", each_ray_in_each_frame, FRAMES);
    suite_add(suite, "clearance by hand", clearance_by_hand);
    suite_add_loop(suite, "crosses as by brute force", crosses_as_by_brute_force, PLANS);
    suite_add_loop(suite, "walls between as by brute force", walls_between_as_by_brute_force,
                   PLANS);
    suite_add_loop(suite, "inside as by brute force", inside_as_by_brute_force, PLANS);
    suite_add_loop(suite, "clearance as by brute force", clearance_as_by_brute_force, PLANS);
    suite_add(suite, "neat numbers as by brute force", neat_numbers_as_by_brute_force);
    suite_add(suite, "walls on borders of cells", walls_on_borders_of_cells);
    suite_add(suite, "turned and shifted answers alike", turned_and_shifted_answers_alike);
    suite_add(suite, "both ways alike", both_ways_alike);
    suite_add(suite, "halves make the whole", halves_make_the_whole);
    suite_add(suite, "answers agree with each other", answers_agree_with_each_other);
    suite_add(suite, "walkers stay in", walkers_stay_in);
    suite_add(suite, "a plan in flash", a_plan_in_flash);
    suite_add(suite, "bad input", bad_input);
    return suite;
}
