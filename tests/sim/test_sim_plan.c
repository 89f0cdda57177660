/* SPDX-License-Identifier: MIT */
#include "sim/plan.h"

#include "buildings.h"
#include "insole/base/rng.h"
#include "near.h"
#include "suite.h"

#define HOUSE                                                                                      \
    "# a house\nloss,12\noutline,0,0,10,0,10,6,0,6\nhole,4,2,5,2,5,3,4,3\n"                        \
    "wall,3,7,0,7,2.5\nwall,4.5,7,3.5,7,6\n"

static sim_point_t draw(insole_rng_t *rng, double low, double high)
{
    sim_point_t p = {low + (high - low) * (double)insole_rng_uniform(rng),
                     low + (high - low) * (double)insole_rng_uniform(rng)};
    return p;
}

START_TEST(rings_and_walls_are_read_as_written)
{
    sim_plan_t plan = plan_of(HOUSE);
    ck_assert_uint_eq(plan.rings.count, 2u);
    ck_assert_uint_eq(plan.walls.count, 10u);
    ck_assert_uint_eq(plan.lines, 4u);
    const sim_wall_t *closing = sim_plan_wall(&plan, 3), *last = sim_plan_wall(&plan, 9);
    ck_assert(closing->a.y_m == 6.0 && closing->b.x_m == 0.0 && closing->b.y_m == 0.0);
    ck_assert(closing->loss_db == 12.0 && last->loss_db == 4.5);
    ck_assert(last->a.y_m == 3.5 && last->b.y_m == 6.0 && last->line == 3u);
    sim_plan_free(&plan);
}
END_TEST

START_TEST(a_ring_may_repeat_its_first_point)
{
    sim_plan_t plan = plan_of("outline,0,0,4,0,0,4,0,0\n");
    ck_assert_uint_eq(plan.walls.count, 3u);
    ck_assert(isnan(sim_plan_wall(&plan, 0)->loss_db));
    sim_plan_free(&plan);
}
END_TEST

START_TEST(the_first_floor_is_kept)
{
    sim_plan_t plan =
        plan_of("floor,0,0,ground\noutline,0,0,4,0,0,4\nfloor,1,3.2,up\noutline,0,0,9,0,9,9\n"
                "wall,3,0,0,1,1\n");
    ck_assert_uint_eq(plan.walls.count, 3u);
    sim_plan_free(&plan);
    plan = plan_of("outline,0,0,4,0,0,4\nfloor,1,3.2\nwall,3,0,0,1,1\n");
    ck_assert_uint_eq(plan.walls.count, 3u);
    sim_plan_free(&plan);
}
END_TEST

/* Winding number by the sum of angles, unlike the simulator's count of crossings. */
static bool winds_round(const sim_plan_t *plan, const sim_ring_t *ring, sim_point_t p)
{
    double sum = 0.0;
    for (size_t i = 0; i < ring->count; i++) {
        const sim_wall_t *w = sim_plan_wall(plan, ring->first + i);
        double ax = w->a.x_m - p.x_m, ay = w->a.y_m - p.y_m;
        double bx = w->b.x_m - p.x_m, by = w->b.y_m - p.y_m;
        sum += atan2(ax * by - ay * bx, ax * bx + ay * by);
    }
    return fabs(sum) > 3.0;
}

START_TEST(inside_is_in_the_outline_and_in_no_hole)
{
    sim_plan_t plan = plan_of("outline,0,0,9,1,7,5,9,9,1,8,3,4\nhole,4,3,6,3,6,6,5,4.5,4,6\n");
    insole_rng_t rng;
    insole_rng_seed(&rng, 1);
    int inside = 0;
    worst_t differs = {0.0, 0.0};
    for (int i = 0; i < 4000; i++) {
        sim_point_t p = draw(&rng, -1.0, 10.0);
        bool expected = winds_round(&plan, sim_list_at(&plan.rings, 0), p) &&
                        !winds_round(&plan, sim_list_at(&plan.rings, 1), p);
        worst_require(&differs, sim_plan_is_inside(&plan, p) == expected, i);
        inside += expected ? 1 : 0;
    }
    ASSERT_ALL_HELD(differs);
    ck_assert_int_gt(inside, 1000);
    sim_plan_free(&plan);
}
END_TEST

START_TEST(without_an_outline_one_can_be_everywhere_but_in_holes)
{
    sim_plan_t none = sim_plan_empty(), hole = plan_of("hole,1,1,2,1,2,2,1,2\n");
    sim_point_t in = {1.5, 1.5}, far = {-50.0, 8.0}, low, high;
    ck_assert(sim_plan_is_inside(&none, in) && sim_plan_is_inside(&hole, far));
    ck_assert(!sim_plan_is_inside(&hole, in));
    ck_assert(sim_plan_clearance(&none, in, far) == HUGE_VAL);
    ck_assert(!sim_plan_box(&none, &low, &high));
    ck_assert(sim_plan_box(&hole, &low, &high));
    ck_assert(low.x_m == 1.0 && low.y_m == 1.0 && high.x_m == 2.0 && high.y_m == 2.0);
    sim_plan_free(&hole);
}
END_TEST

START_TEST(crossings_are_those_of_an_independent_solution)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2);
    worst_t differs = {0.0, 0.0};
    int crossed = 0;
    for (int i = 0; i < 20000; i++) {
        sim_wall_t wall = {draw(&rng, 0.0, 5.0), draw(&rng, 0.0, 5.0), 0, 0.0};
        sim_point_t p = draw(&rng, 0.0, 5.0), q = draw(&rng, 0.0, 5.0);
        bool expected = ways_meet(wall.a, wall.b, p, q);
        worst_require(&differs, sim_wall_is_crossed(&wall, p, q) == expected, i);
        worst_require(&differs, sim_wall_is_crossed(&wall, q, p) == expected, i);
        crossed += expected ? 1 : 0;
    }
    ASSERT_ALL_HELD(differs);
    ck_assert_int_gt(crossed, 3000);
}
END_TEST

START_TEST(a_way_through_a_corner_of_a_wall_crosses_it_once)
{
    sim_plan_t plan = plan_of("wall,3,0,-1,0,0,0,1\nwall,3,5,-1,6,0,5,1\n");
    sim_point_t from = {-1.0, 0.0}, between = {3.0, 0.0}, beyond = {9.0, 0.0};
    int once = 0, touched = 0;
    for (size_t i = 0; i < 4; i++) {
        once += i < 2 && sim_wall_is_crossed(sim_plan_wall(&plan, i), from, between) ? 1 : 0;
        touched += i > 1 && sim_wall_is_crossed(sim_plan_wall(&plan, i), between, beyond) ? 1 : 0;
    }
    ck_assert_int_eq(once, 1);
    ck_assert_int_eq(touched, 1);
    sim_plan_free(&plan);
}
END_TEST

/* Least distance of many points of both lines. */
static double sampled_distance(const sim_wall_t *wall, sim_point_t p, sim_point_t q)
{
    double least = HUGE_VAL;
    for (int i = 0; i <= 60; i++) {
        for (int k = 0; k <= 60; k++) {
            double s = i / 60.0, t = k / 60.0;
            least = fmin(least, hypot(wall->a.x_m + s * (wall->b.x_m - wall->a.x_m) -
                                          (p.x_m + t * (q.x_m - p.x_m)),
                                      wall->a.y_m + s * (wall->b.y_m - wall->a.y_m) -
                                          (p.y_m + t * (q.y_m - p.y_m))));
        }
    }
    return least;
}

START_TEST(distances_are_those_of_the_nearest_points)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3);
    worst_t above = {0.0, 0.0}, below = {0.0, 0.0};
    for (int i = 0; i < 300; i++) {
        sim_wall_t wall = {draw(&rng, 0.0, 5.0), draw(&rng, 0.0, 5.0), 0, 0.0};
        sim_point_t p = draw(&rng, 0.0, 5.0), q = i % 3 == 0 ? p : draw(&rng, 0.0, 5.0);
        double distance = sim_wall_distance(&wall, p, q), sampled = sampled_distance(&wall, p, q);
        worst_note(&above, distance - sampled, i);
        worst_note(&below, sampled - distance, i);
    }
    ASSERT_WORST(above, 1e-12, "m");
    ASSERT_WORST(below, 0.12, "m"); /* the raster of the samples */
}
END_TEST

static const struct {
    const char *text;
    int line;
    const char *says;
} refusals[] = {
    {"", 1, "the plan is empty, expected an outline or a wall"},
    {"# nothing\nloss,5\n", 3, "the plan is empty"},
    {"door,1,2\n", 1, "'door' is no part of a plan, expected floor, outline, hole, wall, loss"},
    {"outline,0,0,1,0\n", 1, "a ring of too few points, expected at least 3"},
    {"outline,0,0,1,0,0,0\n", 1, "a ring of no area"},
    {"outline,0,0,1,0,2,0\n", 1, "a ring of no area"},
    {"outline\n", 1, "no points, expected x,y"},
    {"wall,3,0,0,1,1\nhole,0,0,1,0,1\n", 2, "a point has no y"},
    {"outline,0,0,1,0,1,x\n", 1, "y is 'x', expected a number"},
    {"outline,0,0,1,0,nan,1\n", 1, "x is 'nan', expected a number"},
    {"outline,0,0,1,0,1,0,1,1\n", 1, "the point 1,0 comes twice in a row"},
    {"\nwall,3,0,0\n", 2, "a wall of one point, expected wall,loss_db,x,y,x,y"},
    {"wall,3\n", 1, "no points"},
    {"wall\n", 1, "loss is '', expected a number from 0 to 200"},
    {"wall,-1,0,0,1,1\n", 1, "loss is '-1', expected a number from 0 to 200"},
    {"loss\n", 1, "loss is ''"},
    {"loss,5,6\n", 1, "too many fields, expected loss,dB"},
    {"floor,1\n", 1, "too few fields, expected floor,number,z,name"},
    {"floor,x,1,a\n", 1, "number is 'x'"},
    {"floor,0,0,a\nwall,3,0,0,1,1\nfloor,1,3,b\nwall,3,0\n", 4, "a point has no y"},
    {"floor,0,0,a\nfloor,1,3,b\nwall,3,0,0,1,1\n", 4, "the plan is empty"},
};

START_TEST(bad_plans_are_refused_by_line)
{
    sim_plan_t plan;
    sim_error_t error;
    FILE *stream = stream_of(refusals[_i].text);
    ck_assert(!sim_plan_read(stream, &plan, &error));
    fclose(stream);
    ck_assert_msg(strstr(error.text, refusals[_i].says) != NULL, "says: %s", error.text);
    ck_assert_int_eq(error.line, refusals[_i].line);
    ck_assert_ptr_null(plan.walls.items);
    ck_assert_ptr_null(plan.rings.items);
}
END_TEST

START_TEST(damaged_plans_do_no_harm)
{
    static const char good[] = HOUSE;
    insole_rng_t rng;
    insole_rng_seed(&rng, 5);
    int refused = 0;
    for (int round = 0; round < 1000; round++) {
        char text[sizeof good];
        memcpy(text, good, sizeof good);
        text[insole_rng_bits(&rng) % (sizeof good - 1)] = (char)(1u + insole_rng_bits(&rng) % 127u);
        sim_plan_t plan;
        sim_error_t error;
        FILE *stream = stream_of(text);
        if (sim_plan_read(stream, &plan, &error)) {
            ck_assert_uint_ge(plan.walls.count, 1u);
            sim_plan_free(&plan);
        } else {
            refused++;
            ck_assert_int_ge(error.line, 1);
        }
        fclose(stream);
    }
    ck_assert_int_gt(refused, 200);
    ck_assert_int_lt(refused, 1000);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/plan");
    suite_add(suite, "form", rings_and_walls_are_read_as_written);
    suite_add(suite, "closed ring", a_ring_may_repeat_its_first_point);
    suite_add(suite, "floors", the_first_floor_is_kept);
    suite_add(suite, "inside", inside_is_in_the_outline_and_in_no_hole);
    suite_add(suite, "no outline", without_an_outline_one_can_be_everywhere_but_in_holes);
    suite_add(suite, "crossings", crossings_are_those_of_an_independent_solution);
    suite_add(suite, "corners", a_way_through_a_corner_of_a_wall_crosses_it_once);
    suite_add(suite, "distances", distances_are_those_of_the_nearest_points);
    suite_add_loop(suite, "refusals", bad_plans_are_refused_by_line,
                   (int)(sizeof refusals / sizeof refusals[0]));
    suite_add(suite, "damage", damaged_plans_do_no_harm);
    return suite;
}
