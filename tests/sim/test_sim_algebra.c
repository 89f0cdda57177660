/* SPDX-License-Identifier: MIT */
#include "sim/algebra.h"

#include "near.h"
#include "suite.h"

static const double exact = 1e-12;

static void assert_vec(sim_vec3_t v, double x, double y, double z, double tolerance)
{
    ASSERT_NEAR(v.x, x, tolerance, "");
    ASSERT_NEAR(v.y, y, tolerance, "");
    ASSERT_NEAR(v.z, z, tolerance, "");
}

START_TEST(vectors_by_hand)
{
    sim_vec3_t a = sim_vec3(1.0, 2.0, 3.0), b = sim_vec3(-4.0, 5.0, 6.0);
    assert_vec(sim_vec3_add(a, b), -3.0, 7.0, 9.0, exact);
    assert_vec(sim_vec3_sub(a, b), 5.0, -3.0, -3.0, exact);
    assert_vec(sim_vec3_scale(a, -2.0), -2.0, -4.0, -6.0, exact);
    assert_vec(sim_vec3_add_scaled(a, 0.5, b), -1.0, 4.5, 6.0, exact);
    ASSERT_NEAR(sim_vec3_dot(a, b), 24.0, exact, "");
    ASSERT_NEAR(sim_vec3_norm(sim_vec3(2.0, -3.0, 6.0)), 7.0, exact, "");
}
END_TEST

START_TEST(matrices_by_hand)
{
    sim_mat3_t a = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, {7.0, 8.0, 10.0}};
    sim_mat3_t b = {{0.0, 1.0, 0.0}, {2.0, 0.0, -1.0}, {1.0, 1.0, 1.0}};
    sim_mat3_t c = sim_mat3_mul(a, b);
    assert_vec(sim_mat3_mul_vec(a, sim_vec3(1.0, -1.0, 2.0)), 5.0, 11.0, 19.0, exact);
    assert_vec(sim_mat3_mul_vec_t(a, sim_vec3(1.0, -1.0, 2.0)), 11.0, 13.0, 17.0, exact);
    assert_vec(c.r0, 7.0, 4.0, 1.0, exact);
    assert_vec(c.r1, 16.0, 10.0, 1.0, exact);
    assert_vec(c.r2, 26.0, 17.0, 2.0, exact);
}
END_TEST

START_TEST(euler_angles_turn_the_way_they_say)
{
    double h = 0.5 * SIM_PI;
    sim_vec3_t x = sim_vec3(1.0, 0.0, 0.0), y = sim_vec3(0.0, 1.0, 0.0);
    assert_vec(sim_mat3_mul_vec(sim_mat3_from_euler(0.0, 0.0, h), x), 0.0, 1.0, 0.0, exact);
    assert_vec(sim_mat3_mul_vec(sim_mat3_from_euler(0.0, h, 0.0), x), 0.0, 0.0, -1.0, exact);
    assert_vec(sim_mat3_mul_vec(sim_mat3_from_euler(h, 0.0, 0.0), y), 0.0, 0.0, 1.0, exact);
}
END_TEST

START_TEST(euler_angles_are_applied_roll_first)
{
    sim_mat3_t whole = sim_mat3_from_euler(0.3, -0.8, 2.5);
    sim_mat3_t parts = sim_mat3_mul(
        sim_mat3_from_euler(0.0, 0.0, 2.5),
        sim_mat3_mul(sim_mat3_from_euler(0.0, -0.8, 0.0), sim_mat3_from_euler(0.3, 0.0, 0.0)));
    assert_vec(whole.r0, parts.r0.x, parts.r0.y, parts.r0.z, exact);
    assert_vec(whole.r1, parts.r1.x, parts.r1.y, parts.r1.z, exact);
    assert_vec(whole.r2, parts.r2.x, parts.r2.y, parts.r2.z, exact);
}
END_TEST

START_TEST(a_rotation_keeps_lengths_and_is_undone_by_its_transpose)
{
    sim_mat3_t R = sim_mat3_from_euler(-1.1, 0.7, 4.0);
    sim_vec3_t v = sim_vec3(0.3, -2.0, 1.7);
    sim_vec3_t turned = sim_mat3_mul_vec(R, v);
    ASSERT_NEAR(sim_vec3_norm(turned), sim_vec3_norm(v), exact, "");
    assert_vec(sim_mat3_mul_vec_t(R, turned), v.x, v.y, v.z, exact);
}
END_TEST

static sim_vec3_t curve(double t)
{
    return sim_vec3(1.0 + t * (2.0 + t * (-3.0 + t * (4.0 + t * 5.0))), sin(3.0 * t), exp(-t));
}

START_TEST(derivatives_are_exact_to_the_order_they_promise)
{
    double t = 0.4, h = 1e-3;
    sim_vec3_t f[5];
    for (int i = 0; i < 5; i++) {
        f[i] = curve(t + (i - 2) * h);
    }
    double p1 = 2.0 + t * (-6.0 + t * (12.0 + t * 20.0)), p2 = -6.0 + t * (24.0 + t * 60.0);
    /* rounding: 1e-16 / h and / h^2; truncation h^4 / 30 f(5), h^4 / 90 f(6) of sin(3t) */
    assert_vec(sim_vec3_derivative(f, h), p1, 3.0 * cos(3.0 * t), -exp(-t), 2e-11);
    assert_vec(sim_vec3_second_derivative(f, h), p2, -9.0 * sin(3.0 * t), exp(-t), 1e-8);
}
END_TEST

/* A turn by a vector is what three simple turns are by hand; and it is found again. */
START_TEST(turns_are_about_their_vector)
{
    sim_mat3_t m = sim_mat3_from_turn(sim_vec3(0.0, 0.0, 0.5 * SIM_PI));
    sim_vec3_t y = sim_mat3_mul_vec(m, sim_vec3(1.0, 0.0, 0.0));
    ASSERT_NEAR(y.x, 0.0, exact, "1");
    ASSERT_NEAR(y.y, 1.0, exact, "1");
    m = sim_mat3_from_turn(sim_vec3(0.3, 0.0, 0.0));
    sim_mat3_t roll = sim_mat3_from_euler(0.3, 0.0, 0.0);
    ASSERT_NEAR(m.r1.z, roll.r1.z, exact, "1");
    ASSERT_NEAR(m.r2.z, roll.r2.z, exact, "1");
    sim_vec3_t axis = sim_vec3(0.6, -0.48, 0.64);
    for (double angle = 0.0; angle < 3.1; angle += angle < 1e-3 ? 1e-5 : 0.1) {
        sim_vec3_t turn = sim_vec3_scale(axis, angle);
        m = sim_mat3_from_turn(turn);
        sim_vec3_t found = sim_mat3_turn(m), kept = sim_mat3_mul_vec(m, axis);
        ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(found, turn)), 0.0, 1e-9, "rad");
        ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(kept, axis)), 0.0, 1e-12, "1");
    }
}
END_TEST

static const sim_vec3_t halves[] = {{1.0, 0.0, 0.0},  {0.0, 1.0, 0.0},   {0.0, 0.0, 1.0},
                                    {0.6, -0.8, 0.0}, {0.0, 0.28, 0.96}, {-0.48, 0.6, 0.64}};

START_TEST(half_turns_are_found_too)
{
    sim_mat3_t m = sim_mat3_from_turn(sim_vec3_scale(halves[_i], SIM_PI));
    sim_mat3_t again = sim_mat3_from_turn(sim_mat3_turn(m)); /* the axis may be the other end */
    ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(m.r0, again.r0)), 0.0, 1e-9, "1");
    ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(m.r1, again.r1)), 0.0, 1e-9, "1");
    ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(m.r2, again.r2)), 0.0, 1e-9, "1");
}
END_TEST

static const double wraps[][2] = {{0.0, 0.0},
                                  {SIM_PI, SIM_PI},
                                  {-SIM_PI, SIM_PI},
                                  {3.0 * SIM_PI, SIM_PI},
                                  {4.0, 4.0 - 2.0 * SIM_PI},
                                  {-4.0, 2.0 * SIM_PI - 4.0},
                                  {100.0, 100.0 - 32.0 * SIM_PI}};

START_TEST(angles_wrap)
{
    ASSERT_NEAR(sim_wrap_pi(wraps[_i][0]), wraps[_i][1], exact, "rad");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/algebra");
    suite_add(suite, "vectors", vectors_by_hand);
    suite_add(suite, "matrices", matrices_by_hand);
    suite_add(suite, "euler directions", euler_angles_turn_the_way_they_say);
    suite_add(suite, "euler order", euler_angles_are_applied_roll_first);
    suite_add(suite, "rotation", a_rotation_keeps_lengths_and_is_undone_by_its_transpose);
    suite_add(suite, "turns", turns_are_about_their_vector);
    suite_add_loop(suite, "half turns", half_turns_are_found_too,
                   (int)(sizeof halves / sizeof halves[0]));
    suite_add(suite, "derivatives", derivatives_are_exact_to_the_order_they_promise);
    suite_add_loop(suite, "wrap", angles_wrap, (int)(sizeof wraps / sizeof wraps[0]));
    return suite;
}
