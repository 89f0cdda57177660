/* SPDX-License-Identifier: MIT */
#include "sim/grid.h"

#include "buildings.h"
#include "near.h"
#include "suite.h"

static sim_list_t grid_of(const char *text, double spacing_m, double clearance_m)
{
    sim_plan_t plan = plan_of(text);
    sim_list_t points;
    ck_assert(sim_grid(&plan, spacing_m, clearance_m, &points));
    sim_plan_free(&plan);
    return points;
}

START_TEST(points_lie_row_by_row_from_half_a_spacing)
{
    sim_list_t points = grid_of("outline,10,-4,19,-4,19,2,10,2\n", 3.0, 0.5);
    static const double x[] = {11.5, 14.5, 17.5}, y[] = {-2.5, 0.5};
    ck_assert_uint_eq(points.count, 6u);
    for (size_t i = 0; i < 6; i++) {
        const sim_point_t *p = sim_list_at(&points, i);
        ASSERT_NEAR(p->x_m, x[i % 3], 1e-12, "m");
        ASSERT_NEAR(p->y_m, y[i / 3], 1e-12, "m");
    }
    sim_list_free(&points);
}
END_TEST

START_TEST(what_is_outside_or_near_a_wall_is_left_out)
{
    const char *rooms = "outline,0,0,12,0,12,6,6,6,6,12,0,12\nhole,4,4,5,4,5,5,4,5\n"
                        "wall,3,7.8,0,7.8,3\n";
    sim_plan_t plan = plan_of(rooms);
    sim_list_t points = grid_of(rooms, 3.0, 0.45), closer = grid_of(rooms, 3.0, 0.1);
    /* Of 4 x 4 points 4 are outside and one is in the hole; one is 0.3 m from the wall. */
    ck_assert_uint_eq(points.count, 10u);
    ck_assert_uint_eq(closer.count, 11u);
    for (size_t i = 0; i < points.count; i++) {
        const sim_point_t *p = sim_list_at(&points, i);
        ck_assert(sim_plan_is_inside(&plan, *p));
        ASSERT_AT_LEAST(sim_plan_clearance(&plan, *p, *p), 0.45, "m");
    }
    sim_list_free(&points);
    sim_list_free(&closer);
    sim_plan_free(&plan);
}
END_TEST

START_TEST(without_walls_there_are_no_points)
{
    sim_plan_t plan = sim_plan_empty();
    sim_list_t points;
    ck_assert(sim_grid(&plan, 3.0, 0.45, &points));
    ck_assert_uint_eq(points.count, 0u);
    sim_list_free(&points);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/grid");
    suite_add(suite, "places", points_lie_row_by_row_from_half_a_spacing);
    suite_add(suite, "places", what_is_outside_or_near_a_wall_is_left_out);
    suite_add(suite, "places", without_walls_there_are_no_points);
    return suite;
}
