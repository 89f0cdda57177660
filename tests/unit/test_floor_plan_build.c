/* SPDX-License-Identifier: MIT */
#include "insole/place/floor_plan_build.h"

#include "near.h"
#include "plans.h"
#include "suite.h"

static drawing_t drawing;
static insole_rng_t rng;

static void draw_rooms(int side)
{
    draw_begin(&drawing);
    draw_box(&drawing, INSOLE_LINE_OUTLINE, 5.0, 0.0, 0.0, 4.0 * side, 4.0 * side);
    for (int i = 1; i < side; i++) {
        for (int k = 0; k < side; k++) {
            draw_wall(&drawing, 5.0, 4.0 * i, 4.0 * k, 4.0 * i, 4.0 * k + 3.0);
            draw_wall(&drawing, 5.0, 4.0 * k, 4.0 * i, 4.0 * k + 3.0, 4.0 * i);
        }
    }
}

static uint32_t cell_count(const insole_floor_plan_t *plan)
{
    return (uint32_t)plan->columns * plan->rows;
}

static uint32_t entry_count(const insole_floor_plan_t *plan)
{
    return plan->cells[cell_count(plan)].begin;
}

START_TEST(walls_come_by_kind)
{
    const double hole[] = {6, 6, 6, 8, 8, 8}; /* clockwise */
    const double inner[] = {1, 1, 2, 1, 2, 1, 2, 2};
    draw_begin(&drawing);
    draw_line(&drawing, INSOLE_LINE_WALL, 2.0, inner, 4);
    draw_line(&drawing, INSOLE_LINE_HOLE, 3.0, hole, 3);
    draw_box(&drawing, INSOLE_LINE_OUTLINE, 4.0, -2.5, 0.5, 10, 10);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    const insole_floor_plan_t *plan = &drawing.plan;
    ck_assert_uint_eq(plan->outline_walls, 4u);
    ck_assert_uint_eq(plan->ring_walls, 7u);
    ck_assert_uint_eq(plan->wall_count, 9u); /* a repeated point adds no wall */
    for (uint32_t i = 0; i < plan->wall_count; i++) {
        ASSERT_NEAR(plan->walls[i].loss_db, i < 4u ? 4.0 : i < 7u ? 3.0 : 2.0, 0.0, "dB");
    }
    ASSERT_NEAR(plan->origin_x_m, -3.0, 0.0, "m");
    ASSERT_NEAR(plan->origin_y_m, -1.0, 0.0, "m");
    ASSERT_NEAR(plan->walls[0].x0_m, 0.5, 0.0, "m");
    ASSERT_NEAR(plan->walls[0].y0_m, 1.5, 0.0, "m");
}
END_TEST

/* Whichever way a ring is drawn, its area lies left of its walls. */
START_TEST(rings_run_counter_clockwise)
{
    insole_rng_seed(&rng, 1u + (uint32_t)_i);
    draw_begin(&drawing);
    draw_star(&drawing, &rng, _i & 1 ? INSOLE_LINE_OUTLINE : INSOLE_LINE_HOLE, 3000.0, -2000.0, 9.0,
              12);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    const insole_floor_plan_t *plan = &drawing.plan;
    ck_assert_uint_eq(plan->wall_count, 12u);
    for (uint32_t i = 0; i < plan->wall_count; i++) {
        ck_assert(insole_wall_side(&plan->walls[i], 3000 - plan->origin_x_m,
                                   -2000 - plan->origin_y_m) > 0);
        const insole_wall_t *next = &plan->walls[(i + 1u) % plan->wall_count];
        ck_assert(plan->walls[i].x1_m == next->x0_m && plan->walls[i].y1_m == next->y0_m);
    }
}
END_TEST

/* By sampling each wall: every point of it lies in a cell that knows the wall. */
static void check_grid(const insole_floor_plan_t *plan)
{
    for (uint32_t w = 0; w < plan->wall_count; w++) {
        const insole_wall_t *wall = &plan->walls[w];
        for (int i = 0; i <= 200; i++) {
            double t = i / 200.0;
            double x = (1.0 - t) * (double)wall->x0_m + t * (double)wall->x1_m;
            double y = (1.0 - t) * (double)wall->y0_m + t * (double)wall->y1_m;
            int column = (int)floor(x / (double)plan->cell_m);
            int row = (int)floor(y / (double)plan->cell_m);
            ck_assert(column >= 0 && column < plan->columns && row >= 0 && row < plan->rows);
            const insole_floor_plan_cell_t *cell = &plan->cells[row * plan->columns + column];
            bool found = false;
            for (uint32_t k = cell[0].begin; k < cell[1].begin; k++) {
                found = found || plan->entries[k] == w;
            }
            ck_assert_msg(found, "wall %u at (%g, %g)", w, x, y);
        }
    }
}

/* No cell holds a wall twice, nor one that is far from it. */
static void check_cells(const insole_floor_plan_t *plan)
{
    double half = 0.5 * (double)plan->cell_m;
    for (uint32_t c = 0; c < cell_count(plan); c++) {
        double x = (c % plan->columns + 0.5) * (double)plan->cell_m;
        double y = (c / plan->columns + 0.5) * (double)plan->cell_m;
        for (uint32_t k = plan->cells[c].begin; k < plan->cells[c + 1].begin; k++) {
            const insole_wall_t *w = &plan->walls[plan->entries[k]];
            segment_t s = {(double)w->x0_m, (double)w->y0_m, (double)w->x1_m, (double)w->y1_m};
            ck_assert(k == plan->cells[c].begin || plan->entries[k] > plan->entries[k - 1]);
            ck_assert(distance_by_double(s, x, y) < 1.4143 * (half + 0.005) + 1e-3);
        }
    }
}

START_TEST(grid_holds_each_wall_where_it_is)
{
    insole_rng_seed(&rng, 10u + (uint32_t)_i);
    draw_random(&drawing, &rng, 12u * (uint32_t)_i);
    draw_move(&drawing, 0.3 * _i, 700.0 * _i, -300.0 * _i);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    check_grid(&drawing.plan);
    check_cells(&drawing.plan);
}
END_TEST

/* The same density of walls gives the same cells, however many there are. */
START_TEST(cells_follow_the_density)
{
    double cell_m[2], per_cell[2];
    for (int i = 0; i < 2; i++) {
        draw_rooms(i == 0 ? 5 : 11);
        ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
        cell_m[i] = (double)drawing.plan.cell_m;
        per_cell[i] = (double)entry_count(&drawing.plan) / cell_count(&drawing.plan);
    }
    ASSERT_NEAR(cell_m[1] / cell_m[0], 1.0, 0.15, "");
    ASSERT_NEAR(per_cell[1] / per_cell[0], 1.0, 0.25, "");
    ASSERT_AT_MOST(per_cell[1], 2.0, "walls a cell");
}
END_TEST

static insole_status_t build_in(uint32_t walls, uint32_t cells, uint32_t entries,
                                insole_floor_plan_t *plan)
{
    insole_floor_plan_memory_t memory = {drawing.walls, walls,           drawing.cells,
                                         cells,         drawing.entries, entries};
    return insole_floor_plan_build(plan, drawing.lines, drawing.line_count, &memory);
}

/* A small memory makes a coarse grid with the same answers, down to a single cell. */
START_TEST(small_memory_makes_a_coarser_grid)
{
    static const uint32_t rooms[][2] = {{9000, 30000}, {200, 30000}, {9000, 300}, {20, 200},
                                        {3, 30000},    {2, 130},     {9000, 124}};
    const uint32_t *room = rooms[_i];
    insole_floor_plan_t plan;
    draw_rooms(6);
    insole_status_t status = build_in(124, room[0], room[1], &plan);
    ck_assert_int_eq(status, INSOLE_OK);
    ck_assert_uint_eq(plan.wall_count, 64u);
    ck_assert_uint_lt(cell_count(&plan), room[0]);
    ck_assert_uint_le(entry_count(&plan), room[1]);
    insole_rng_seed(&rng, 20u);
    for (int i = 0; i < 3000; i++) {
        double x = draw_uniform(&rng, -1.0, 25.0), y = draw_uniform(&rng, -1.0, 25.0);
        segment_t s = {x, y, x + draw_uniform(&rng, -3.0, 3.0), y + draw_uniform(&rng, -3.0, 3.0)};
        double distance = drawing_distance(&drawing, s);
        if (distance < 0.9e-3 || distance > 2e-3) {
            ck_assert(insole_floor_plan_crosses(&plan, (insole_real_t)s.x0, (insole_real_t)s.y0,
                                                (insole_real_t)s.x1,
                                                (insole_real_t)s.y1) == (distance < 1e-3));
            ck_assert(insole_floor_plan_inside(&plan, (insole_real_t)x, (insole_real_t)y) ==
                      drawing_inside(&drawing, x, y));
        }
    }
}
END_TEST

/* Room for more entries than 16 bits can number does not tempt the builder to number them. */
START_TEST(entries_stay_within_sixteen_bits)
{
    enum { WALLS = 1500, ROOM = 200000 };
    static insole_floor_plan_line_t lines[WALLS];
    static insole_real_t xy[WALLS][4];
    static insole_wall_t walls[WALLS];
    static insole_floor_plan_cell_t cells[ROOM];
    static uint16_t entries[ROOM];
    const insole_floor_plan_memory_t memory = {walls, WALLS, cells, ROOM, entries, ROOM};
    insole_floor_plan_t plan;
    for (int i = 0; i < WALLS; i++) {
        xy[i][1] = xy[i][3] = (insole_real_t)i / 15;
        xy[i][2] = 100;
        insole_floor_plan_line_t line = {INSOLE_LINE_WALL, xy[i], 2, 1};
        lines[i] = line;
    }
    ck_assert_int_eq(insole_floor_plan_build(&plan, lines, WALLS, &memory), INSOLE_OK);
    uint32_t sum = 0;
    for (uint32_t c = 0; c < cell_count(&plan); c++) {
        ck_assert_uint_le(plan.cells[c].begin, plan.cells[c + 1].begin);
        sum += (uint32_t)(plan.cells[c + 1].begin - plan.cells[c].begin);
    }
    ck_assert_uint_eq(sum, entry_count(&plan));
    ck_assert_uint_gt(sum, 30000u);
    check_grid(&plan);
}
END_TEST

/* An edge drawn right through the reference point of a cell makes the builder take other points. */
START_TEST(no_edge_runs_through_a_reference_point)
{
    insole_real_t x_m = 5, y_m = 5;
    for (int round = 0; round < 2; round++) {
        const double wedge[] = {(double)x_m - 2.0, (double)y_m, (double)x_m + 2.5,
                                (double)y_m,       (double)x_m, (double)y_m + 3.0};
        draw_begin(&drawing);
        draw_box(&drawing, INSOLE_LINE_OUTLINE, 5.0, 0.0, 0.0, 12.0, 12.0);
        draw_line(&drawing, INSOLE_LINE_HOLE, 5.0, wedge, 3);
        ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
        x_m = (1 + drawing.plan.spot_x) * drawing.plan.cell_m + drawing.plan.origin_x_m;
        y_m = (1 + drawing.plan.spot_y) * drawing.plan.cell_m + drawing.plan.origin_y_m;
    }
    insole_rng_seed(&rng, 30u);
    for (int i = 0; i < 3000; i++) {
        double x = draw_uniform(&rng, -1.0, 13.0), y = draw_uniform(&rng, -1.0, 13.0);
        segment_t here = {x, y, x, y};
        if (drawing_distance(&drawing, here) > 1e-4) {
            ck_assert(insole_floor_plan_inside(&drawing.plan, (insole_real_t)x, (insole_real_t)y) ==
                      drawing_inside(&drawing, x, y));
        }
    }
    segment_t edge = line_edge(&drawing.lines[1], 0);
    for (uint32_t c = 0; c < cell_count(&drawing.plan); c++) {
        double x =
            ((double)drawing.plan.spot_x + c % drawing.plan.columns) * (double)drawing.plan.cell_m +
            (double)drawing.plan.origin_x_m;
        double y =
            ((double)drawing.plan.spot_y + c / drawing.plan.columns) * (double)drawing.plan.cell_m +
            (double)drawing.plan.origin_y_m;
        ck_assert(distance_by_double(edge, x, y) > 1e-3);
    }
}
END_TEST

/* The same walls in a frame of their own, wherever the map has its zero. */
START_TEST(far_plan_is_as_sharp)
{
    static insole_wall_t near_walls[PLAN_POINTS_MAX];
    draw_rooms(6);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    memcpy(near_walls, drawing.walls, sizeof near_walls);
    draw_move(&drawing, 0.0, -10000.0, 8192.0);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    ck_assert_mem_eq(near_walls, drawing.walls, drawing.plan.wall_count * sizeof near_walls[0]);
}
END_TEST

/* A plan is numbers and tables: elsewhere, as in flash, the same tables give the same answers. */
START_TEST(tables_can_be_moved)
{
    static insole_wall_t walls[PLAN_POINTS_MAX];
    static insole_floor_plan_cell_t cells[3 * PLAN_POINTS_MAX];
    static uint16_t entries[PLAN_ENTRIES_MAX];
    insole_rng_seed(&rng, 40u);
    draw_random(&drawing, &rng, 40u);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    insole_floor_plan_t plan = drawing.plan;
    memcpy(walls, plan.walls, plan.wall_count * sizeof walls[0]);
    memcpy(cells, plan.cells, (cell_count(&plan) + 1u) * sizeof cells[0]);
    memcpy(entries, plan.entries, entry_count(&plan) * sizeof entries[0]);
    plan.walls = walls;
    plan.cells = cells;
    plan.entries = entries;
    for (int i = 0; i < 3000; i++) {
        insole_real_t q[4];
        for (int k = 0; k < 4; k++) {
            q[k] = (insole_real_t)draw_uniform(&rng, -2.0, 42.0);
        }
        bool crosses = insole_floor_plan_crosses(&plan, q[0], q[1], q[2], q[3]);
        ck_assert(crosses == insole_floor_plan_crosses(&drawing.plan, q[0], q[1], q[2], q[3]));
        bool inside = insole_floor_plan_inside(&plan, q[0], q[1]);
        ck_assert(inside == insole_floor_plan_inside(&drawing.plan, q[0], q[1]));
    }
}
END_TEST

/* Lines of any shape and size are built or refused, and what is built can be asked anything. */
START_TEST(whatever_is_drawn)
{
    int built = 0;
    insole_rng_seed(&rng, 50u);
    for (int i = 0; i < 1500; i++) {
        double wide = pow(10.0, draw_uniform(&rng, -4.0, 5.0));
        draw_begin(&drawing);
        for (uint32_t k = insole_rng_bits(&rng) % 6u + 1u; k > 0; k--) {
            double xy[2 * 20];
            uint32_t points = 2u + insole_rng_bits(&rng) % 18u;
            for (uint32_t n = 0; n < 2u * points; n++) {
                bool again = n >= 2u && (insole_rng_bits(&rng) & 3u) == 0u;
                xy[n] = again ? xy[n - 2u] : draw_uniform(&rng, -wide, wide);
            }
            draw_line(&drawing, (insole_line_kind_t)(insole_rng_bits(&rng) % 3u), 1.0, xy, points);
        }
        if (draw_build(&drawing) != INSOLE_OK) {
            continue;
        }
        built++;
        for (int k = 0; k < 50; k++) {
            segment_t s = {
                draw_uniform(&rng, -2.0, 2.0) * wide, draw_uniform(&rng, -2.0, 2.0) * wide,
                draw_uniform(&rng, -2.0, 2.0) * wide, draw_uniform(&rng, -2.0, 2.0) * wide};
            insole_walls_between_t between;
            insole_status_t status = insole_floor_plan_walls_between(
                &drawing.plan, (insole_real_t)s.x0, (insole_real_t)s.y0, (insole_real_t)s.x1,
                (insole_real_t)s.y1, &between);
            ck_assert_int_eq(status, INSOLE_OK);
            ck_assert_uint_le(between.count, drawing.plan.wall_count);
            bool crosses =
                insole_floor_plan_crosses(&drawing.plan, (insole_real_t)s.x0, (insole_real_t)s.y0,
                                          (insole_real_t)s.x1, (insole_real_t)s.y1);
            double distance = drawing_distance(&drawing, s);
            ck_assert(crosses || distance > 0.9e-3 - 1e-6 * wide);
            ck_assert(!crosses || distance < 2e-3 + 1e-6 * wide);
        }
    }
    ck_assert_int_gt(built, 1000);
}
END_TEST

START_TEST(refuses_bad_drawings)
{
    static const insole_real_t good_xy[] = {0, 0, 9, 0, 9, 9, 0, 9};
    static const insole_real_t bad_xy[][6] = {{0, 0, (double)NAN, 0, 1, 1},
                                              {0, (double)INFINITY, 1, 0, 1, 1},
                                              {0, 0, 1, 0, 1, INSOLE_R(1.1e5)}};
    static const insole_real_t one_spot[] = {4, 4, 4, 4, 4, 4};
    const struct {
        insole_floor_plan_line_t line;
        insole_status_t status;
    } cases[] = {
        {{INSOLE_LINE_OUTLINE, NULL, 4, 1}, INSOLE_ERR_NULL},
        {{INSOLE_LINE_OUTLINE, good_xy, 2, 1}, INSOLE_ERR_VALUE},
        {{INSOLE_LINE_HOLE, good_xy, 2, 1}, INSOLE_ERR_VALUE},
        {{INSOLE_LINE_WALL, good_xy, 1, 1}, INSOLE_ERR_VALUE},
        {{INSOLE_LINE_WALL, good_xy, 0, 1}, INSOLE_ERR_VALUE},
        {{(insole_line_kind_t)3, good_xy, 4, 1}, INSOLE_ERR_VALUE},
        {{INSOLE_LINE_WALL, good_xy, 4, -1}, INSOLE_ERR_VALUE},
        {{INSOLE_LINE_WALL, good_xy, 4, (double)NAN}, INSOLE_ERR_VALUE},
        {{INSOLE_LINE_WALL, good_xy, 4, (double)INFINITY}, INSOLE_ERR_VALUE},
        {{INSOLE_LINE_WALL, bad_xy[0], 3, 1}, INSOLE_ERR_VALUE},
        {{INSOLE_LINE_WALL, bad_xy[1], 3, 1}, INSOLE_ERR_VALUE},
        {{INSOLE_LINE_WALL, bad_xy[2], 3, 1}, INSOLE_ERR_VALUE},
        {{INSOLE_LINE_WALL, one_spot, 3, 1}, INSOLE_ERR_STATE},
        {{INSOLE_LINE_OUTLINE, good_xy, 4, 1}, INSOLE_OK},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        insole_floor_plan_t plan, before;
        memset(&plan, 0xa5, sizeof plan);
        before = plan;
        insole_floor_plan_memory_t memory = {drawing.walls,   9, drawing.cells, 9,
                                             drawing.entries, 99};
        ck_assert_int_eq(insole_floor_plan_build(&plan, &cases[i].line, 1, &memory),
                         cases[i].status);
        ck_assert((memcmp(&plan, &before, sizeof plan) == 0) == (cases[i].status != INSOLE_OK));
    }
}
END_TEST

START_TEST(refuses_bad_memory)
{
    insole_floor_plan_t plan, before;
    memset(&plan, 0xa5, sizeof plan);
    before = plan;
    draw_rooms(6);
    const insole_floor_plan_memory_t good = {drawing.walls,   64,  drawing.cells, 200,
                                             drawing.entries, 1000};
    insole_floor_plan_memory_t bad[3] = {good, good, good};
    bad[0].walls = NULL;
    bad[1].cells = NULL;
    bad[2].entries = NULL;
    const insole_floor_plan_line_t *lines = drawing.lines;
    uint32_t count = drawing.line_count;
    ck_assert_int_eq(insole_floor_plan_build(NULL, lines, count, &good), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_floor_plan_build(&plan, NULL, count, &good), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_floor_plan_build(&plan, lines, count, NULL), INSOLE_ERR_NULL);
    for (int i = 0; i < 3; i++) {
        ck_assert_int_eq(insole_floor_plan_build(&plan, lines, count, &bad[i]), INSOLE_ERR_NULL);
    }
    ck_assert_int_eq(insole_floor_plan_build(&plan, lines, 0, &good), INSOLE_ERR_STATE);
    ck_assert_int_eq(build_in(63, 200, 1000, &plan), INSOLE_ERR_ROOM);
    ck_assert_int_eq(build_in(64, 0, 1000, &plan), INSOLE_ERR_ROOM);
    ck_assert_int_eq(build_in(64, 1, 1000, &plan), INSOLE_ERR_ROOM);
    ck_assert_int_eq(build_in(64, 200, 63, &plan), INSOLE_ERR_ROOM);
    ck_assert_mem_eq(&plan, &before, sizeof plan);
    ck_assert_int_eq(build_in(64, 2, 64, &plan), INSOLE_OK);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("floor_plan_build");
    suite_add(suite, "walls come by kind", walls_come_by_kind);
    suite_add_loop(suite, "rings run counter-clockwise", rings_run_counter_clockwise, 8);
    suite_add_loop(suite, "grid holds each wall where it is", grid_holds_each_wall_where_it_is, 8);
    suite_add(suite, "cells follow the density", cells_follow_the_density);
    suite_add_loop(suite, "small memory, coarser grid", small_memory_makes_a_coarser_grid, 7);
    suite_add(suite, "entries stay within 16 bits", entries_stay_within_sixteen_bits);
    suite_add(suite, "no edge through a reference point", no_edge_runs_through_a_reference_point);
    suite_add(suite, "far plan is as sharp", far_plan_is_as_sharp);
    suite_add(suite, "tables can be moved", tables_can_be_moved);
    suite_add(suite, "whatever is drawn", whatever_is_drawn);
    suite_add(suite, "refuses bad drawings", refuses_bad_drawings);
    suite_add(suite, "refuses bad memory", refuses_bad_memory);
    return suite;
}
