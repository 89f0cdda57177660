/* SPDX-License-Identifier: MIT */
#include "insole/fuse/soft_walls.h"

#include "near.h"
#include "plans.h"
#include "suite.h"

static drawing_t drawing;
static insole_soft_walls_t soft;

static void begin(void)
{
    insole_soft_walls_begin(&soft, 1, INSOLE_R(0.2), INSOLE_R(0.02));
}

static void look(double x, double y)
{
    insole_soft_walls_look(&soft, &drawing.plan, (insole_real_t)x, (insole_real_t)y);
}

static double weigh(double x, double y)
{
    return (double)insole_soft_walls_weigh(&soft, &drawing.plan, (insole_real_t)x,
                                           (insole_real_t)y);
}

/* A hall of 20 m x 10 m with a block of 6 m x 4 m in it, and a screen that is no edge. */
static void draw_hall(void)
{
    draw_begin(&drawing);
    draw_box(&drawing, INSOLE_LINE_OUTLINE, 4.0, 0.0, 0.0, 20.0, 10.0);
    draw_box(&drawing, INSOLE_LINE_HOLE, 4.0, 7.0, 3.0, 13.0, 7.0);
    draw_wall(&drawing, 2.0, 8.0, 5.0, 12.0, 5.0);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
}

static const struct {
    double x, y;
    bool closed;
    const char *what;
} places[] = {{1, 1, false, "the hall"},
              {6.99, 5, false, "before the block"},
              {7.5, 5, false, "half a metre in"},
              {7.98, 5, false, "nearly a metre in"},
              {8.02, 5, true, "just over a metre in"},
              {10, 5, true, "on the screen in its middle"},
              {10, 6.5, false, "near its other side"},
              {-0.5, 5, false, "half a metre out of the hall"},
              {-1.5, 5, true, "outside"},
              {1000, -2000, true, "far outside"}};

START_TEST(only_what_lies_deep_is_closed)
{
    draw_hall();
    begin();
    look(1.0, 1.0);
    look(places[_i].x, places[_i].y);
    ck_assert_msg(soft.closed == (places[_i].closed ? 1u : 0u), "%s", places[_i].what);
    ASSERT_NEAR(weigh(places[_i].x, places[_i].y), places[_i].closed ? log(0.2) : 0.0, 1e-6, "");
    ASSERT_NEAR(weigh(1.0, 1.0), 0.0, 0.0, "");
}
END_TEST

/* Of a hundred: two who are free are enough, one is not. */
START_TEST(when_nearly_all_would_die_the_plan_is_wrong)
{
    draw_hall();
    for (uint32_t free = 0; free < 5; free++) {
        begin();
        for (uint32_t i = 0; i < 100; i++) {
            look(i < free ? 1.0 : 10.0, 5.0);
        }
        ck_assert(insole_soft_walls_count(&soft) == (free >= 2u));
        ASSERT_NEAR(weigh(10.0, 5.0), free >= 2u ? log(0.2) : 0.0, 1e-6, "");
        ASSERT_NEAR(weigh(1.0, 5.0), 0.0, 0.0, "");
    }
}
END_TEST

START_TEST(nobody_closed_or_nobody_there)
{
    draw_hall();
    begin();
    ck_assert(!insole_soft_walls_count(&soft));
    look(1.0, 1.0);
    ck_assert(!insole_soft_walls_count(&soft));
    insole_soft_walls_look(&soft, NULL, 10, 5);
    ck_assert_uint_eq(soft.closed, 0u);
}
END_TEST

/* As by brute force in double over random plans. */
START_TEST(random_plans_by_brute_force)
{
    insole_rng_t rng;
    worst_t agrees = {0, 0};
    uint32_t closed = 0, all = 0;
    insole_rng_seed(&rng, 70u + (uint64_t)_i);
    draw_random(&drawing, &rng, 20);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    for (int k = 0; k < 2000; k++) {
        double x = draw_uniform(&rng, -3.0, 43.0), y = draw_uniform(&rng, -3.0, 33.0);
        segment_t here = {x, y, x, y};
        double edge = HUGE_VAL;
        for (uint32_t i = 0; i < drawing.line_count; i++) {
            const insole_floor_plan_line_t *line = &drawing.lines[i];
            for (uint32_t e = 0; line->kind != INSOLE_LINE_WALL && e < line_edges(line); e++) {
                edge = fmin(edge, segment_distance(here, line_edge(line, e)));
            }
        }
        if (edge < 0.01 || fabs(edge - 1.0) < 0.001) {
            continue;
        }
        bool expected = !drawing_inside(&drawing, x, y) && edge > 1.0;
        begin();
        look(1e5, 1e5); /* one more, who is closed in any case */
        look(x, y);
        worst_require(&agrees, soft.closed == 1u + expected, k);
        closed += expected;
        all++;
    }
    ASSERT_ALL_HELD(agrees);
    ck_assert(closed > all / 20u && closed < all * 19u / 20u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("soft_walls");
    suite_add_loop(suite, "deep", only_what_lies_deep_is_closed, sizeof places / sizeof places[0]);
    suite_add(suite, "nearly all", when_nearly_all_would_die_the_plan_is_wrong);
    suite_add(suite, "nobody", nobody_closed_or_nobody_there);
    suite_add_loop(suite, "brute force", random_plans_by_brute_force, 5);
    return suite;
}
