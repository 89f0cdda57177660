/* SPDX-License-Identifier: MIT */
#include "sim/smooth.h"

#include "near.h"
#include "suite.h"

static const double shapes[][2] = {{0.5, 0.5}, {0.65, 0.25}, {0.2, 0.75}, {0.9, 0.1}, {0.1, 0.1}};
enum { SHAPES = sizeof shapes / sizeof shapes[0] };

static double ease(double u)
{
    return sim_ease(u, 0.6, 0.3);
}

START_TEST(ease_goes_from_nothing_to_one)
{
    double rise = shapes[_i][0], fall = shapes[_i][1], last = 0.0;
    ck_assert(sim_ease(-0.5, rise, fall) == 0.0 && sim_ease(0.0, rise, fall) == 0.0);
    ck_assert(sim_ease(1.0, rise, fall) == 1.0 && sim_ease(7.0, rise, fall) == 1.0);
    for (int i = 1; i <= 1000; i++) {
        double now = sim_ease(i / 1000.0, rise, fall);
        ck_assert_msg(now > last, "not rising at %g", i / 1000.0);
        last = now;
    }
}
END_TEST

START_TEST(ease_has_the_peak_rate_it_promises)
{
    double rise = shapes[_i][0], fall = shapes[_i][1], peak = 0.0;
    for (int i = 0; i < 10000; i++) {
        double u = i / 10000.0;
        peak = fmax(peak, (sim_ease(u + 1e-4, rise, fall) - sim_ease(u, rise, fall)) / 1e-4);
    }
    ASSERT_NEAR(peak, 1.0 / (1.0 - 0.5 * (rise + fall)), 1e-4, "");
}
END_TEST

/* Where the pieces of ease(u; 0.6, 0.3) meet. */
static const double joints[] = {0.0, 0.6, 0.7, 1.0};

START_TEST(ease_is_twice_continuously_differentiable)
{
    double u = joints[_i], h = 1e-4;
    double left1 = (ease(u) - ease(u - h)) / h, right1 = (ease(u + h) - ease(u)) / h;
    double left2 = (ease(u) - 2.0 * ease(u - h) + ease(u - 2.0 * h)) / (h * h);
    double right2 = (ease(u + 2.0 * h) - 2.0 * ease(u + h) + ease(u)) / (h * h);
    ASSERT_NEAR(left1, right1, 2e-3, "");
    ASSERT_NEAR(left2, right2, 2e-2, "");
}
END_TEST

START_TEST(ease_with_equal_ends_is_symmetric)
{
    for (int i = 0; i <= 100; i++) {
        double u = i / 100.0;
        ASSERT_NEAR(sim_ease(u, 0.4, 0.4) + sim_ease(1.0 - u, 0.4, 0.4), 1.0, 1e-12, "");
    }
}
END_TEST

START_TEST(a_hump_stands_between_its_feet)
{
    ck_assert(sim_hump(-1.0) == 0.0 && sim_hump(0.0) == 0.0);
    ck_assert(sim_hump(1.0) == 0.0 && sim_hump(2.0) == 0.0);
    ASSERT_NEAR(sim_hump(0.5), 1.0, 1e-12, "");
    /* t^3 at the feet: rate and acceleration vanish with the distance */
    ASSERT_NEAR(sim_hump(1e-4), 64e-12, 1e-13, "");
    ASSERT_NEAR(sim_hump(1.0 - 1e-4), 64e-12, 1e-13, "");
}
END_TEST

static const struct {
    sim_state1_t from, to;
    double length;
} joins[] = {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 1.0},
             {{-2.0, 3.0, -5.0}, {4.0, -1.0, 7.0}, 0.45},
             {{1.0, 0.0, 9.0}, {1.0, 2.0, 0.0}, 3.0},
             {{100.0, -0.5, 20.0}, {101.4, 0.7, -25.0}, 0.38}};

START_TEST(a_quintic_takes_over_both_states)
{
    double T = joins[_i].length, h = 1e-4;
    sim_quintic_t q = sim_quintic(joins[_i].from, joins[_i].to, T);
    for (int end = 0; end < 2; end++) {
        const sim_state1_t *state = end == 0 ? &joins[_i].from : &joins[_i].to;
        double t = end == 0 ? 0.0 : T;
        double before = sim_quintic_at(&q, t - h), after = sim_quintic_at(&q, t + h);
        double p = sim_quintic_at(&q, t);
        ASSERT_NEAR(p, state->p, 1e-10, "");
        ASSERT_NEAR((after - before) / (2.0 * h), state->v, 2e-4, "");
        ASSERT_NEAR((after - 2.0 * p + before) / (h * h), state->a, 2e-3, "");
    }
}
END_TEST

START_TEST(a_quintic_repeats_the_motion_it_was_taken_from)
{
    /* p = t^5 - 2 t^3 + t is its own join */
    double T = 1.3;
    sim_state1_t from = {0.0, 1.0, 0.0};
    sim_state1_t to = {pow(T, 5.0) - 2.0 * pow(T, 3.0) + T, 5.0 * pow(T, 4.0) - 6.0 * T * T + 1.0,
                       20.0 * pow(T, 3.0) - 12.0 * T};
    sim_quintic_t q = sim_quintic(from, to, T);
    for (double t = 0.0; t <= T; t += 0.1) {
        ASSERT_NEAR(sim_quintic_at(&q, t), pow(t, 5.0) - 2.0 * pow(t, 3.0) + t, 1e-12, "");
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/smooth");
    suite_add_loop(suite, "ease ends", ease_goes_from_nothing_to_one, SHAPES);
    suite_add_loop(suite, "ease peak", ease_has_the_peak_rate_it_promises, SHAPES);
    suite_add_loop(suite, "ease joints", ease_is_twice_continuously_differentiable, 4);
    suite_add(suite, "ease symmetry", ease_with_equal_ends_is_symmetric);
    suite_add(suite, "hump", a_hump_stands_between_its_feet);
    suite_add_loop(suite, "quintic ends", a_quintic_takes_over_both_states, 4);
    suite_add(suite, "quintic course", a_quintic_repeats_the_motion_it_was_taken_from);
    return suite;
}
