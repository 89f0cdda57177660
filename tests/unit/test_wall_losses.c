/* SPDX-License-Identifier: MIT */
#include "insole/place/wall_losses.h"

#include <string.h>

#include "near.h"
#include "plans.h"
#include "suite.h"

enum {
    SIDE = INSOLE_WALL_LOSSES_SIDE,
    NODES = INSOLE_WALL_LOSSES_NODES,
    SLOTS = INSOLE_WALL_LOSSES_SLOTS
};

static drawing_t drawing;
static insole_rng_t rng;
static insole_wall_losses_t losses;

static insole_spot_t spot(double x, double y)
{
    insole_spot_t at = {(insole_real_t)x, (insole_real_t)y};
    return at;
}

static void begin(uint64_t seed)
{
    insole_rng_seed(&rng, seed);
    ck_assert_int_eq(insole_wall_losses_init(&losses), INSOLE_OK);
}

static void build_random(void)
{
    draw_random(&drawing, &rng, 60);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
}

static insole_status_t move_to(double spacing_m, double x, double y)
{
    return insole_wall_losses_move(&losses, (insole_real_t)spacing_m, (insole_real_t)x,
                                   (insole_real_t)y);
}

/* An access point somewhere in the drawing, the same for the same id. */
static insole_spot_t ap_of(uint32_t id)
{
    insole_rng_t own;
    insole_rng_seed(&own, 1000u + id);
    return spot(draw_uniform(&own, 0.0, 40.0), draw_uniform(&own, 0.0, 30.0));
}

static const struct {
    double spacing_m, x, y;
} centres[] = {{1.0, 0.0, 0.0},       {1.0, 0.49, -0.49}, {0.7, 12.3, 45.6},  {0.7, -12.3, -0.1},
               {2.83, 500.0, -500.0}, {0.01, 3.0, 4.0},   {100.0, 1e5, -1e5}, {1e5, 1.0, -1.0}};

/* Nodes lie on whole multiples of the spacing, row by row, around the centre. */
START_TEST(nodes_are_a_lattice_of_the_map)
{
    begin(1u);
    double h = centres[_i].spacing_m, x = centres[_i].x, y = centres[_i].y;
    double sharp = 1e-6 * (fabs(x) + fabs(y) + 10.0 * h);
    ck_assert_int_eq(move_to(h, x, y), INSOLE_OK);
    insole_spot_t first = insole_wall_losses_spot(&losses, 0);
    ASSERT_NEAR(remainder((double)first.x_m, h), 0.0, sharp, "m");
    ASSERT_NEAR(remainder((double)first.y_m, h), 0.0, sharp, "m");
    ASSERT_NEAR((double)first.x_m + 0.5 * (SIDE - 1) * h, x, 0.5 * h + sharp, "m");
    ASSERT_NEAR((double)first.y_m + 0.5 * (SIDE - 1) * h, y, 0.5 * h + sharp, "m");
    for (uint32_t n = 0; n < NODES; n++) {
        insole_spot_t node = insole_wall_losses_spot(&losses, n);
        ASSERT_NEAR(node.x_m, (double)first.x_m + h * (n % SIDE), sharp, "m");
        ASSERT_NEAR(node.y_m, (double)first.y_m + h * (n / SIDE), sharp, "m");
    }
}
END_TEST

static void reserve(const uint32_t *ids, uint32_t count, uint8_t *slots)
{
    ck_assert_int_eq(insole_wall_losses_reserve(&losses, ids, count, slots), INSOLE_OK);
    for (uint32_t k = 0; k < count; k++) {
        ck_assert_uint_lt(slots[k], SLOTS);
        ck_assert_uint_eq(losses.slot[slots[k]].id, ids[k]);
    }
}

/* The plan asked itself, each time anew. */
static double direct(insole_spot_t from, insole_spot_t to)
{
    insole_walls_between_t walls;
    ck_assert_int_eq(
        insole_floor_plan_walls_between(&drawing.plan, from.x_m, from.y_m, to.x_m, to.y_m, &walls),
        INSOLE_OK);
    return (double)walls.loss_db;
}

/* Some nodes and access points are left out, so that they are counted on a later visit. */
static void compare_with_plan(const uint32_t *ids, uint32_t count, double limit_db, worst_t *worst)
{
    uint8_t slots[SLOTS];
    reserve(ids, count, slots);
    for (uint32_t n = 0; n < NODES; n++) {
        for (uint32_t k = 0; k < count; k++) {
            if (insole_rng_bits(&rng) % 4u != 0u) {
                insole_spot_t ap = ap_of(ids[k]), node = insole_wall_losses_spot(&losses, n);
                double loss =
                    (double)insole_wall_losses_at(&losses, &drawing.plan, n, slots[k], ap);
                worst_note(worst, fabs(loss - fmin(direct(node, ap), limit_db)), n);
            }
        }
    }
}

/* With limits, and what half a step is. */
static const struct {
    double limit_db, half_step_db;
} limits[] = {{0.0, 0.0625},   {1.0, 0.0625}, {12.0, 0.0625}, {20.3, 0.0625},
              {31.75, 0.0625}, {31.8, 0.125}, {63.6, 0.25},   {127.0, 0.25}};

/* A walker wanders, turns back, jumps; access points come and go; the spacing changes. */
START_TEST(kept_losses_are_those_of_the_plan)
{
    worst_t off = {0.0, 0.0};
    begin(10u + (uint64_t)_i);
    build_random();
    insole_wall_losses_limit(&losses, (insole_real_t)limits[_i].limit_db);
    ASSERT_NEAR(losses.step_db, 2.0 * limits[_i].half_step_db, 0.0, "dB");
    double x = 20.0, y = 15.0, spacing_m = 1.0;
    for (int stride = 0; stride < 60; stride++) {
        uint32_t ids[SLOTS], count = 1u + insole_rng_bits(&rng) % SLOTS;
        for (uint32_t k = 0; k < count; k++) {
            ids[k] = (5u * k + insole_rng_bits(&rng) % 5u) % 80u; /* no id comes twice */
        }
        x += draw_uniform(&rng, -1.5, 1.5);
        y += draw_uniform(&rng, -1.5, 1.5);
        if (stride % 10 == 9) {
            x = draw_uniform(&rng, 0.0, 40.0);
            spacing_m = draw_uniform(&rng, 0.5, 3.0);
        }
        ck_assert_int_eq(move_to(spacing_m, x, y), INSOLE_OK);
        compare_with_plan(ids, count, limits[_i].limit_db, &off);
    }
    ASSERT_WORST(off, limits[_i].half_step_db + 1e-5, "dB");
}
END_TEST

/* Counts all nodes for one access point behind a wall, then none again without the plan: what then
 * still has a loss was kept. */
static uint32_t kept_after_move(double x0, double y0, double spacing_m, double x1, double y1)
{
    uint32_t id = 3u, kept = 0;
    uint8_t slot;
    insole_spot_t ap = spot(1000.0, 1.0);
    insole_wall_losses_init(&losses);
    reserve(&id, 1u, &slot);
    move_to(1.0, x0, y0);
    for (uint32_t n = 0; n < NODES; n++) {
        ASSERT_NEAR(insole_wall_losses_at(&losses, &drawing.plan, n, slot, ap), 6.0, 0.0, "dB");
    }
    move_to(spacing_m, x1, y1);
    reserve(&id, 1u, &slot);
    for (uint32_t n = 0; n < NODES; n++) {
        kept += insole_wall_losses_at(&losses, NULL, n, slot, ap) > 0 ? 1u : 0u;
    }
    return kept;
}

START_TEST(a_node_is_counted_once_while_it_stays)
{
    draw_begin(&drawing);
    draw_wall(&drawing, 6.0, 900.0, -500.0, 900.0, 500.0);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    ck_assert_uint_eq(kept_after_move(10.5, 10.5, 1.0, 10.5, 10.5), 36u);
    ck_assert_uint_eq(kept_after_move(10.5, 10.5, 1.0, 10.9, 10.1), 36u);
    ck_assert_uint_eq(kept_after_move(10.5, 10.5, 1.0, 12.5, 10.5), 24u);
    ck_assert_uint_eq(kept_after_move(10.5, 10.5, 1.0, 8.5, 9.5), 20u);
    ck_assert_uint_eq(kept_after_move(10.5, 10.5, 1.0, 10.5, 15.5), 6u);
    ck_assert_uint_eq(kept_after_move(10.5, 10.5, 1.0, 10.5, 16.5), 0u);
    ck_assert_uint_eq(kept_after_move(10.5, 10.5, 1.0, 4.5, 10.5), 0u);
    ck_assert_uint_eq(kept_after_move(-0.5, -0.5, 1.0, 0.5, -1.5), 25u);
    ck_assert_uint_eq(kept_after_move(10.5, 10.5, 1.4, 10.5, 10.5), 0u);
}
END_TEST

/* All are forgotten with another limit, none with the same. */
START_TEST(a_limit_holds_for_all_that_is_kept)
{
    uint32_t id = 3u;
    uint8_t slot;
    begin(7u);
    draw_begin(&drawing);
    draw_wall(&drawing, 6.0, 900.0, -500.0, 900.0, 500.0);
    draw_wall(&drawing, 6.5, 901.0, -500.0, 901.0, 500.0);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    reserve(&id, 1u, &slot);
    insole_spot_t ap = spot(1000.0, 1.0);
    static const double told[][2] = {{12.5, 12.5}, {12.0, 12.0}, {7.0, 7.0}, {1000.0, 12.5}};
    for (size_t i = 0; i < sizeof told / sizeof told[0]; i++) {
        insole_real_t limit_db = (insole_real_t)told[i][0];
        ck_assert_int_eq(insole_wall_losses_limit(&losses, limit_db), INSOLE_OK);
        ASSERT_NEAR(insole_wall_losses_at(&losses, &drawing.plan, 5, slot, ap), told[i][1], 0.0,
                    "dB");
        ck_assert_int_eq(insole_wall_losses_limit(&losses, limit_db), INSOLE_OK);
        ASSERT_NEAR(insole_wall_losses_at(&losses, NULL, 5, slot, ap), told[i][1], 0.0, "dB");
        insole_spot_t node = insole_wall_losses_spot(&losses, 5);
        ASSERT_NEAR(insole_wall_losses_between(&drawing.plan, node, ap, limit_db),
                    fmin(12.5, told[i][0]), 0.0, "dB");
    }
}
END_TEST

START_TEST(access_points_keep_their_slots)
{
    uint32_t ids[SLOTS];
    uint8_t slots[SLOTS], again[SLOTS];
    begin(2u);
    for (uint32_t k = 0; k < SLOTS; k++) {
        ids[k] = 7u * k;
    }
    reserve(ids, SLOTS, slots);
    bool taken[SLOTS] = {false};
    for (uint32_t k = 0; k < SLOTS; k++) {
        ck_assert(!taken[slots[k]]);
        taken[slots[k]] = true;
    }
    for (uint32_t k = 0; k < SLOTS; k++) { /* in another order, and fewer */
        uint32_t other = ids[(5u * k + 3u) % SLOTS];
        reserve(&other, 1u, again);
        ck_assert_uint_eq(again[0], slots[(5u * k + 3u) % SLOTS]);
    }
}
END_TEST

/* Of sixteen kept, four are heard again with twelve others: the four keep their losses. */
START_TEST(only_slots_of_others_are_given_up)
{
    uint32_t ids[SLOTS];
    uint8_t slots[SLOTS], before[SLOTS];
    begin(3u);
    draw_begin(&drawing);
    draw_wall(&drawing, 6.0, 900.0, -500.0, 900.0, 500.0);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (uint32_t k = 0; k < SLOTS; k++) {
        ids[k] = 100u + k;
    }
    reserve(ids, SLOTS, before);
    for (uint32_t k = 0; k < SLOTS; k++) {
        insole_wall_losses_at(&losses, &drawing.plan, 0, before[k], spot(1000.0, 1.0));
    }
    for (uint32_t k = 0; k < SLOTS; k++) {
        ids[k] = k % 4u == 1u ? 100u + k : 200u + k;
    }
    reserve(ids, SLOTS, slots);
    for (uint32_t k = 0; k < SLOTS; k++) {
        double loss = (double)insole_wall_losses_at(&losses, NULL, 0, slots[k], spot(1000.0, 1.0));
        ASSERT_NEAR(loss, k % 4u == 1u ? 6.0 : 0.0, 0.0, "dB");
        ck_assert(k % 4u != 1u || slots[k] == before[k]);
    }
}
END_TEST

START_TEST(the_same_access_point_twice_has_one_slot)
{
    uint32_t ids[] = {4u, 9u, 4u};
    uint8_t slots[3];
    begin(4u);
    reserve(ids, 3u, slots);
    ck_assert_uint_eq(slots[0], slots[2]);
    ck_assert_uint_ne(slots[0], slots[1]);
}
END_TEST

START_TEST(no_plan_no_loss)
{
    begin(5u);
    ck_assert_int_eq(move_to(1.0, 3.0, 3.0), INSOLE_OK);
    for (uint32_t n = 0; n < NODES; n++) {
        ASSERT_NEAR(insole_wall_losses_at(&losses, NULL, n, 0, spot(9.0, 9.0)), 0.0, 0.0, "dB");
    }
    ASSERT_NEAR(insole_wall_losses_between(NULL, spot(0.0, 0.0), spot(9.0, 9.0), 20), 0.0, 0.0,
                "dB");
    build_random();
    ASSERT_NEAR(
        insole_wall_losses_between(&drawing.plan, spot(0.0, 0.0), spot((double)NAN, 9.0), 20), 0.0,
        0.0, "dB");
}
END_TEST

START_TEST(refusals_change_nothing)
{
    static const double bad[][3] = {
        {0.0, 1.0, 1.0},         {-1.0, 1.0, 1.0},    {0.0099, 1.0, 1.0}, {1.1e5, 1.0, 1.0},
        {(double)NAN, 1.0, 1.0}, {1.0, 1.1e5, 1.0},   {1.0, 1.0, -1.1e5}, {1.0, (double)NAN, 1.0},
        {1.0, 1.0, HUGE_VAL},    {HUGE_VAL, 1.0, 1.0}};
    uint32_t ids[SLOTS + 1] = {0};
    uint8_t slots[SLOTS + 1];
    begin(6u);
    reserve(ids, 3u, slots);
    insole_wall_losses_t before = losses;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        ck_assert_int_eq(move_to(bad[i][0], bad[i][1], bad[i][2]), INSOLE_ERR_VALUE);
    }
    static const double limits_refused[] = {-0.1, (double)NAN, -HUGE_VAL};
    for (size_t i = 0; i < sizeof limits_refused / sizeof limits_refused[0]; i++) {
        ck_assert_int_eq(insole_wall_losses_limit(&losses, (insole_real_t)limits_refused[i]),
                         INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_wall_losses_reserve(&losses, ids, SLOTS + 1, slots), INSOLE_ERR_ROOM);
    ck_assert_int_eq(insole_wall_losses_reserve(&losses, NULL, 1u, slots), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_wall_losses_reserve(&losses, ids, 1u, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_wall_losses_reserve(&losses, NULL, 0u, NULL), INSOLE_OK);
    ASSERT_NEAR(insole_wall_losses_at(&losses, NULL, NODES, 0, spot(1.0, 1.0)), 0.0, 0.0, "dB");
    ASSERT_NEAR(insole_wall_losses_at(&losses, NULL, 0, SLOTS, spot(1.0, 1.0)), 0.0, 0.0, "dB");
    ck_assert_mem_eq(&losses, &before, sizeof losses);
}
END_TEST

START_TEST(nothing_happens_to_null)
{
    uint32_t id = 1u;
    uint8_t slot = 77u;
    ck_assert_int_eq(insole_wall_losses_init(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_wall_losses_limit(NULL, 20), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_wall_losses_move(NULL, 1, 0, 0), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_wall_losses_reserve(NULL, &id, 1u, &slot), INSOLE_ERR_NULL);
    ck_assert_uint_eq(slot, 77u);
    ASSERT_NEAR(insole_wall_losses_at(NULL, NULL, 0, 0, spot(1.0, 1.0)), 0.0, 0.0, "dB");
    ASSERT_NEAR(insole_wall_losses_spot(NULL, 5u).x_m, 0.0, 0.0, "m");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("wall_losses");
    suite_add_loop(suite, "lattice of the map", nodes_are_a_lattice_of_the_map,
                   sizeof centres / sizeof centres[0]);
    suite_add_loop(suite, "kept losses are true", kept_losses_are_those_of_the_plan,
                   sizeof limits / sizeof limits[0]);
    suite_add(suite, "limit", a_limit_holds_for_all_that_is_kept);
    suite_add(suite, "counted once", a_node_is_counted_once_while_it_stays);
    suite_add(suite, "slots are kept", access_points_keep_their_slots);
    suite_add(suite, "slots are given up", only_slots_of_others_are_given_up);
    suite_add(suite, "the same twice", the_same_access_point_twice_has_one_slot);
    suite_add(suite, "no plan", no_plan_no_loss);
    suite_add(suite, "refusals", refusals_change_nothing);
    suite_add(suite, "null", nothing_happens_to_null);
    return suite;
}
