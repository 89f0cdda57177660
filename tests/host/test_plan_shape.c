/* SPDX-License-Identifier: MIT */
#include "plan_shape.h"

#include <math.h>

#include "files.h"
#include "insole/base/rng.h"
#include "near.h"
#include "suite.h"

static plan_file_t plan;
static failure_t failure;
static insole_rng_t rng;

static void read_text(const char *text)
{
    bool is_good = plan_file_take(&plan, file_of(text), "plan", &failure);
    ck_assert_msg(is_good, "%s", failure.text);
}

static plan_point_t at(double x_m, double y_m)
{
    plan_point_t point = {x_m, y_m};
    return point;
}

static plan_point_t anywhere(double size_m)
{
    double x = (double)insole_rng_uniform(&rng), y = (double)insole_rng_uniform(&rng);
    return at(size_m * x, size_m * y);
}

static double distance(plan_point_t a, plan_point_t b)
{
    return hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

static plan_point_t between(plan_point_t a, plan_point_t b, double share)
{
    return at(a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m));
}

START_TEST(distances_are_those_of_the_nearest_of_many_points)
{
    worst_t off = {0.0, 0.0};
    insole_rng_seed(&rng, 1u);
    for (int i = 0; i < 200; i++) {
        plan_point_t p = anywhere(10.0), a = anywhere(10.0), b = anywhere(10.0);
        double least = HUGE_VAL;
        for (int k = 0; k <= 1000; k++) {
            least = fmin(least, distance(p, between(a, b, k / 1000.0)));
        }
        worst_note(&off, fabs(plan_piece_distance(p, a, b) - least), i);
    }
    ASSERT_WORST(off, 0.008, "m"); /* half of the largest step */
    ASSERT_NEAR(plan_piece_distance(at(3.0, 4.0), at(0.0, 0.0), at(0.0, 0.0)), 5.0, 1e-12, "m");
}
END_TEST

/* Solves a + s (b - a) = c + t (d - c). */
static bool solve(plan_point_t a, plan_point_t b, plan_point_t c, plan_point_t d, double *s,
                  double *t)
{
    double ux = b.x_m - a.x_m, uy = b.y_m - a.y_m, vx = d.x_m - c.x_m, vy = d.y_m - c.y_m;
    double determinant = vx * uy - ux * vy;
    *s = (vx * (c.y_m - a.y_m) - vy * (c.x_m - a.x_m)) / determinant;
    *t = (ux * (c.y_m - a.y_m) - uy * (c.x_m - a.x_m)) / determinant;
    return *s > 0.0 && *s < 1.0 && *t > 0.0 && *t < 1.0;
}

START_TEST(pieces_cross_where_their_equations_say)
{
    worst_t right = {0.0, 0.0}, off = {0.0, 0.0};
    int crossings = 0;
    insole_rng_seed(&rng, 2u);
    for (int i = 0; i < 5000; i++) {
        plan_point_t a = anywhere(5.0), b = anywhere(5.0), c = anywhere(5.0), d = anywhere(5.0);
        plan_point_t where = {0.0, 0.0};
        double s, t;
        bool expected = solve(a, b, c, d, &s, &t);
        worst_require(&right, plan_pieces_cross(a, b, c, d, &where) == expected, i);
        if (expected) {
            worst_note(&off, distance(where, between(a, b, s)), i);
            crossings++;
        }
    }
    ASSERT_ALL_HELD(right);
    ASSERT_WORST(off, 1e-9, "m");
    ck_assert_int_gt(crossings, 500);
}
END_TEST

START_TEST(pieces_that_touch_do_not_cross)
{
    plan_point_t where;
    ck_assert(!plan_pieces_cross(at(0, 0), at(2, 0), at(1, 0), at(1, 3), &where));
    ck_assert(!plan_pieces_cross(at(0, 0), at(2, 0), at(2, 0), at(2, 3), &where));
    ck_assert(!plan_pieces_cross(at(0, 0), at(2, 0), at(1, 0), at(3, 0), &where));
    ck_assert(!plan_pieces_cross(at(0, 0), at(2, 0), at(0, 1), at(2, 1), &where));
    ck_assert(plan_pieces_cross(at(0, 0), at(2, 0), at(1, -1), at(1, 3), &where));
    ASSERT_NEAR(where.x_m, 1.0, 1e-12, "m");
    ASSERT_NEAR(where.y_m, 0.0, 1e-12, "m");
}
END_TEST

/* Turns of the ring around p, from the angles under which its pieces are seen. */
static double turns(const plan_line_t *ring, plan_point_t p)
{
    double sum = 0.0;
    for (size_t i = 0u; i < ring->count; i++) {
        plan_point_t a = ring->points[i], b = plan_line_end(ring, i);
        double ax = a.x_m - p.x_m, ay = a.y_m - p.y_m, bx = b.x_m - p.x_m, by = b.y_m - p.y_m;
        sum += atan2(ax * by - ay * bx, ax * bx + ay * by);
    }
    return sum / 6.283185307179586;
}

static const char *const rings[] = {
    "outline,1,1,9,1,9,9,1,9\n",
    "outline,1,9,9,9,9,1,1,1\n",                 /* clockwise */
    "outline,1,1,9,1,9,4,4,4,4,7,9,7,9,9,1,9\n", /* with a bay */
    "outline,1,1,9,9,9,1,1,9\n",                 /* a bow tie */
    "outline,1,1,9,1,9,9,1,9,1,1,7,2,7,7,2,7\n", /* twice around its middle */
};

START_TEST(a_ring_holds_what_it_runs_around)
{
    worst_t right = {0.0, 0.0};
    int inside = 0;
    read_text(rings[_i]);
    insole_rng_seed(&rng, 3u);
    for (int i = 0; i < 3000; i++) {
        plan_point_t p = anywhere(10.0);
        bool expected = fabs(turns(&plan.lines[0], p)) > 0.5;
        worst_require(&right, plan_ring_holds(&plan.lines[0], p) == expected, i);
        inside += expected;
    }
    ASSERT_ALL_HELD(right);
    ck_assert_int_gt(inside, 500);
    ck_assert_int_lt(inside, 2500);
    plan_file_free(&plan);
}
END_TEST

START_TEST(areas_are_those_of_squares_and_triangles)
{
    read_text("outline,1,1,9,1,9,9,1,9\noutline,1,9,9,9,9,1\nhole,1,1,9,1,9,4,4,4,4,7,9,7,9,9,1,9\n"
              "hole,0,0,1,1,3,3\n");
    ASSERT_NEAR(plan_ring_area(&plan.lines[0]), 64.0, 1e-9, "m^2");
    ASSERT_NEAR(plan_ring_area(&plan.lines[1]), 32.0, 1e-9, "m^2");
    ASSERT_NEAR(plan_ring_area(&plan.lines[2]), 49.0, 1e-9, "m^2");
    ASSERT_NEAR(plan_ring_area(&plan.lines[3]), 0.0, 1e-9, "m^2");
    plan_file_free(&plan);
}
END_TEST

START_TEST(a_ring_is_near_on_its_closing_side_and_a_wall_is_not)
{
    read_text("outline,0,0,8,0,8,8,0,8\nwall,1,0,0,8,0,8,8,0,8\n");
    ASSERT_NEAR(plan_line_distance(&plan.lines[0], at(1.0, 4.0)), 1.0, 1e-12, "m");
    ASSERT_NEAR(plan_line_distance(&plan.lines[1], at(1.0, 4.0)), 4.0, 1e-12, "m");
    plan_file_free(&plan);
}
END_TEST

START_TEST(outside_is_what_no_outline_of_the_floor_holds)
{
    read_text("outline,0,0,4,0,4,4,0,4\nhole,1,1,2,1,2,2\noutline,6,0,9,0,9,4,6,4\n"
              "wall,1,20,20,30,30\nfloor,2,3,b\noutline,0,0,90,0,90,90\nfloor,3,6,c\n");
    ASSERT_NEAR(plan_distance_outside(&plan, 0u, at(1.6, 1.4)), 0.0, 1e-12, "m");
    ASSERT_NEAR(plan_distance_outside(&plan, 0u, at(7.0, 1.0)), 0.0, 1e-12, "m");
    ASSERT_NEAR(plan_distance_outside(&plan, 0u, at(5.5, 1.0)), 0.5, 1e-12, "m");
    ASSERT_NEAR(plan_distance_outside(&plan, 0u, at(12.0, 8.0)), 5.0, 1e-12, "m");
    ASSERT_NEAR(plan_distance_outside(&plan, 1u, at(12.0, 8.0)), 0.0, 1e-12, "m");
    ck_assert(isinf(plan_distance_outside(&plan, 2u, at(1.0, 1.0))));
    plan_file_free(&plan);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("plan_shape");
    suite_add(suite, "distance", distances_are_those_of_the_nearest_of_many_points);
    suite_add(suite, "crossing", pieces_cross_where_their_equations_say);
    suite_add(suite, "touching", pieces_that_touch_do_not_cross);
    suite_add_loop(suite, "inside", a_ring_holds_what_it_runs_around,
                   (int)(sizeof rings / sizeof rings[0]));
    suite_add(suite, "area", areas_are_those_of_squares_and_triangles);
    suite_add(suite, "closing side", a_ring_is_near_on_its_closing_side_and_a_wall_is_not);
    suite_add(suite, "outside", outside_is_what_no_outline_of_the_floor_holds);
    return suite;
}
