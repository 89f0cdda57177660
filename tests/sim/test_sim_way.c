/* SPDX-License-Identifier: MIT */
#include "sim/way.h"

#include "buildings.h"
#include "insole/base/rng.h"
#include "near.h"
#include "suite.h"

/* Two rooms, a door of 1.2 m, and a cell without one. */
#define ROOMS                                                                                      \
    "outline,0,0,10,0,10,6,0,6\nwall,3,5,0,5,4\nwall,3,5,5.2,5,6\nwall,3,8,0,8,2,10,2\n"           \
    "hole,2,2,2.5,2,2.5,2.5,2,2.5\n"

static const double clearance = 0.4;

static double length_of(const sim_list_t *points)
{
    double length = 0.0;
    for (size_t i = 1; i < points->count; i++) {
        const sim_point_t *a = sim_list_at(points, i - 1), *b = sim_list_at(points, i);
        length += hypot(b->x_m - a->x_m, b->y_m - a->y_m);
    }
    return length;
}

START_TEST(one_can_stand_inside_and_off_the_walls)
{
    static const struct {
        double x, y;
        bool can;
    } places[] = {{1.0, 1.0, true},  {0.3, 1.0, false}, {-1.0, 1.0, false}, {2.25, 2.25, false},
                  {4.7, 2.0, false}, {4.5, 2.0, true},  {9.0, 1.0, true},   {5.0, 4.6, true}};
    sim_plan_t plan = plan_of(ROOMS);
    sim_way_map_t map;
    ck_assert(sim_way_map(&map, &plan, clearance));
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        sim_point_t p = {places[i].x, places[i].y};
        ck_assert_msg(sim_way_can_stand(&map, p) == places[i].can, "%g,%g", p.x_m, p.y_m);
    }
    sim_way_map_free(&map);
    sim_plan_free(&plan);
}
END_TEST

START_TEST(a_free_way_is_straight)
{
    sim_plan_t plan = plan_of(ROOMS);
    sim_way_map_t map;
    sim_list_t points;
    sim_point_t from = {0.7, 5.3}, to = {4.4, 3.1};
    ck_assert(sim_way_map(&map, &plan, clearance));
    ck_assert(sim_way_find(&map, from, to, &points));
    ck_assert_uint_eq(points.count, 2u);
    ASSERT_NEAR(length_of(&points), hypot(3.7, 2.2), 1e-12, "m");
    sim_list_free(&points);
    sim_way_map_free(&map);
    sim_plan_free(&plan);
}
END_TEST

START_TEST(the_way_to_the_next_room_leads_through_the_door)
{
    sim_plan_t plan = plan_of(ROOMS);
    sim_way_map_t map;
    sim_list_t points;
    sim_point_t from = {4.0, 1.0}, to = {6.0, 1.0};
    ck_assert(sim_way_map(&map, &plan, clearance));
    ck_assert(sim_way_find(&map, from, to, &points));
    ASSERT_AT_LEAST(length_of(&points), 2.0 * hypot(1.0, 3.0), "m"); /* round the jamb */
    ASSERT_AT_MOST(length_of(&points), 1.25 * 2.0 * hypot(1.0, 3.4), "m");
    ck_assert_uint_le(points.count, 6u); /* four corners make the half turn */
    sim_list_free(&points);
    sim_way_map_free(&map);
    sim_plan_free(&plan);
}
END_TEST

START_TEST(where_no_way_leads_none_is_found)
{
    sim_plan_t plan = plan_of(ROOMS);
    sim_way_map_t map;
    sim_list_t points;
    sim_point_t room = {1.0, 1.0}, cell = {9.0, 1.0}, outside = {-5.0, 1.0};
    ck_assert(sim_way_map(&map, &plan, clearance));
    ck_assert(!sim_way_find(&map, room, cell, &points));
    ck_assert_ptr_null(points.items);
    ck_assert(!sim_way_find(&map, outside, room, &points));
    sim_way_map_free(&map);
    ck_assert(sim_way_map(&map, &plan, 0.7)); /* too wide for the door */
    sim_point_t other = {6.5, 4.0};
    ck_assert(!sim_way_find(&map, room, other, &points));
    sim_way_map_free(&map);
    sim_plan_free(&plan);
}
END_TEST

/* Between random places of random boxes: clear of walls all along, and never absurdly long. */
START_TEST(ways_keep_clear_of_the_walls)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 11);
    int found = 0;
    for (int round = 0; round < 40; round++) {
        char text[1000] = "outline,0,0,20,0,20,20,0,20\n";
        for (int i = 0; i < 12; i++) {
            double x = 18.0 * (double)insole_rng_uniform(&rng);
            double y = 18.0 * (double)insole_rng_uniform(&rng);
            snprintf(text + strlen(text), sizeof text - strlen(text),
                     "wall,3,%.3f,%.3f,%.3f,%.3f\n", x, y, x + (i % 2 ? 2.0 : 5.0),
                     y + (i % 2 ? 5.0 : -2.0));
        }
        sim_plan_t plan = plan_of(text);
        sim_way_map_t map;
        sim_list_t points;
        ck_assert(sim_way_map(&map, &plan, clearance));
        sim_point_t from = {0.5 + 19.0 * (double)insole_rng_uniform(&rng), 0.5};
        sim_point_t to = {19.5, 0.5 + 19.0 * (double)insole_rng_uniform(&rng)};
        if (sim_way_find(&map, from, to, &points)) {
            const sim_point_t *last = sim_list_at(&points, points.count - 1);
            ck_assert(last->x_m == to.x_m && last->y_m == to.y_m);
            for (size_t i = 1; i < points.count; i++) {
                const sim_point_t *a = sim_list_at(&points, i - 1), *b = sim_list_at(&points, i);
                ck_assert_int_eq(walls_met(&plan, *a, *b), 0);
                if (sim_way_can_stand(&map, from) && sim_way_can_stand(&map, to)) {
                    ASSERT_AT_LEAST(sim_plan_clearance(&plan, *a, *b), 0.8 * clearance, "m");
                }
            }
            ASSERT_AT_MOST(length_of(&points), 60.0, "m");
            sim_list_free(&points);
            found++;
        }
        sim_way_map_free(&map);
        sim_plan_free(&plan);
    }
    ck_assert_int_ge(found, 25);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/way");
    suite_add(suite, "standing", one_can_stand_inside_and_off_the_walls);
    suite_add(suite, "straight", a_free_way_is_straight);
    suite_add(suite, "door", the_way_to_the_next_room_leads_through_the_door);
    suite_add(suite, "no way", where_no_way_leads_none_is_found);
    suite_add(suite, "clear", ways_keep_clear_of_the_walls);
    return suite;
}
