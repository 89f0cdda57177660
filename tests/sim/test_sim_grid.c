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

START_TEST(lines_come_before_the_grid)
{
    const char *room = "outline,0,0,30,0,30,20,0,20\n";
    sim_scenario_t scenario =
        scenario_in("points,2,4,14,4\npoints,5,2,5,12.5\nstart,2,2,0\n", room, "");
    sim_scenario_t grid = scenario_in("start,2,2,0\n", room, "");
    sim_list_t points;
    ck_assert(sim_reference_points(&scenario, 3.0, &points));
    /* 2, 5, 8, 11, 14; then 10.5 m in four pieces, since 2.6 m is nearer to 3 m than 3.5 m is */
    ck_assert_uint_eq(points.count, 10u);
    for (size_t i = 0; i < 10; i++) {
        const sim_point_t *p = sim_list_at(&points, i);
        ASSERT_NEAR(p->x_m, i < 5 ? 2.0 + 3.0 * (double)i : 5.0, 1e-12, "m");
        ASSERT_NEAR(p->y_m, i < 5 ? 4.0 : 2.0 + 2.625 * (double)(i - 5), 1e-12, "m");
    }
    sim_list_free(&points);
    ck_assert(sim_reference_points(&grid, 3.0, &points));
    ck_assert_uint_eq(points.count, 70u);
    sim_list_free(&points);
    sim_scenario_free(&scenario);
    sim_scenario_free(&grid);
}
END_TEST

START_TEST(points_of_lines_keep_clear_of_walls_too)
{
    sim_scenario_t scenario = scenario_in("points,1,5,19,5\nstart,2,2,0\n",
                                          "outline,0,0,15,0,15,10,0,10\nwall,3,7.2,0,7.2,10\n", "");
    sim_list_t points;
    ck_assert(sim_reference_points(&scenario, 3.0, &points));
    ck_assert_uint_eq(points.count, 4u); /* of 1, 4, 7, 10, 13, 16, 19 */
    sim_list_free(&points);
    sim_scenario_free(&scenario);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/grid");
    suite_add(suite, "places", points_lie_row_by_row_from_half_a_spacing);
    suite_add(suite, "places", what_is_outside_or_near_a_wall_is_left_out);
    suite_add(suite, "places", without_walls_there_are_no_points);
    suite_add(suite, "lines", lines_come_before_the_grid);
    suite_add(suite, "lines", points_of_lines_keep_clear_of_walls_too);
    return suite;
}
