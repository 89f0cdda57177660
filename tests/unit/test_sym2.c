/* SPDX-License-Identifier: MIT */
#include "insole/base/sym2.h"

#include "near.h"
#include "plane.h"
#include "refusal.h"
#include "suite.h"

#define EPS ((double)INSOLE_REAL_EPSILON)

static plane_t outer(point_t v)
{
    plane_t m = {v.x * v.x, v.x * v.y, v.x * v.y, v.y * v.y};
    return m;
}

START_TEST(algebra_is_that_of_full_matrices)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t sum = {0.0, 0.0}, product = {0.0, 0.0}, map = {0.0, 0.0};
    for (int i = 0; i < 2000; i++) {
        insole_sym2_t A = sample_sym2(&rng, 3), B = sample_sym2(&rng, 3);
        insole_spot_t v = sample_spot(&rng, 4), w = sample_spot(&rng, 4);
        insole_real_t s = sample_between(&rng, -2, 2);
        plane_t a = plane_of(A), b = plane_of(B),
                M = {(double)v.x_m, (double)v.y_m, (double)w.x_m, (double)w.y_m};
        worst_note(&sum, plane_apart(plane_add(a, 1.0, b), insole_sym2_add(A, B)), i);
        worst_note(&sum, plane_apart(plane_add(a, (double)s - 1.0, a), insole_sym2_scale(A, s)), i);
        worst_note(&sum,
                   plane_apart(plane_add(a, (double)s, outer(point_of(v))),
                               insole_sym2_add_outer(A, s, v)),
                   i);
        worst_note(&product, point_apart(plane_apply(a, point_of(v)), insole_sym2_mul(A, v)), i);
        worst_note(&product, fabs(plane_form(a, point_of(v)) - (double)insole_sym2_form(A, v)), i);
        worst_note(
            &map,
            plane_apart(plane_mul(M, plane_mul(a, plane_transpose(M))), insole_sym2_map(v, w, A)),
            i);
    }
    ASSERT_WORST(sum, 100.0 * EPS, "");
    ASSERT_WORST(product, 600.0 * EPS, "");
    ASSERT_WORST(map, 1000.0 * EPS, "");
}
END_TEST

START_TEST(an_inverse_undoes)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 2000; i++) {
        insole_sym2_t A = sample_sym2(&rng, 3), W;
        ck_assert(insole_sym2_inverse(A, &W));
        plane_t product = plane_mul(plane_of(A), plane_of(W));
        worst_note(&off, plane_apart(product, insole_sym2_circle(1)), i);
    }
    ASSERT_WORST(off, 1000.0 * EPS, "");
}
END_TEST

static const insole_sym2_t NO_COVARIANCE[] = {
    {0, 0, 1},
    {1, 0, 0},
    {-1, 0, 1},
    {1, 0, -1},
    {1, 2, 1},
    {1, -2, 1},
    {1, 1, 1},
    {(insole_real_t)NAN, 0, 1},
    {1, (insole_real_t)NAN, 1},
    {1, 0, (insole_real_t)NAN},
    {(insole_real_t)INFINITY, 0, 1},
    {1, (insole_real_t)INFINITY, 1},
    {INSOLE_R(1e-44), 0, 1},
};

enum { NO_COVARIANCES = sizeof NO_COVARIANCE / sizeof NO_COVARIANCE[0] };

START_TEST(what_is_no_covariance_has_no_inverse)
{
    insole_sym2_t W = {1, 2, 3};
    insole_sym2_t A = NO_COVARIANCE[_i];
    bool tiny = A.xx > 0 && A.xx < INSOLE_R(1e-40) && sizeof(insole_real_t) == 8u;
    bool endless = !tiny && insole_is_finite(A.xy) && !(A.xx <= INSOLE_REAL_MAX) && A.xx > 0;
    if (!tiny && !endless) {
        ck_assert(!insole_sym2_inverse(A, &W));
        ASSERT_NEAR(W.xx + W.xy + W.yy, 6.0, 0.0, "");
    }
    ck_assert(!insole_sym2_is_between(A, INSOLE_R(1e-6), INSOLE_R(1e8)));
}
END_TEST

START_TEST(bounds_hold_for_all_and_leave_the_rest_alone)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    worst_t held = {0.0, 0.0}, same = {0.0, 0.0}, positive = {0.0, 0.0};
    for (int i = 0; i < 20000; i++) {
        insole_real_t size = insole_exp(sample_between(&rng, -20, 20));
        insole_real_t other = insole_exp(sample_between(&rng, -20, 20));
        insole_real_t r = sample_between(&rng, INSOLE_R(-1.2), INSOLE_R(1.2));
        insole_sym2_t A = {size, r * insole_sqrt(size) * insole_sqrt(other), other};
        insole_sym2_t B = insole_sym2_bound(A, INSOLE_R(1e-6), INSOLE_R(1e8));
        worst_require(&held, insole_sym2_is_between(B, INSOLE_R(1e-6), INSOLE_R(1e8)), i);
        plane_t b = plane_of(B);
        worst_require(&positive, b.a * b.d - b.b * b.c > 0.0, i);
        if (insole_sym2_is_between(A, INSOLE_R(1e-6), INSOLE_R(1e8)) &&
            insole_abs(r) < INSOLE_R(0.999)) {
            worst_require(&same, memcmp(&A, &B, sizeof A) == 0, i);
        }
    }
    ASSERT_ALL_HELD(held);
    ASSERT_ALL_HELD(positive);
    ASSERT_ALL_HELD(same);
}
END_TEST

/* By all directions. */
START_TEST(the_larger_eigenvalue_is_the_variance_of_the_worst_direction)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 50; i++) {
        insole_sym2_t A = sample_sym2(&rng, 3);
        double most = 0.0;
        for (int k = 0; k < 3600; k++) {
            point_t u = {cos(k * 3.14159265358979 / 3600.0), sin(k * 3.14159265358979 / 3600.0)};
            most = fmax(most, plane_form(plane_of(A), u));
        }
        worst_note(&off, fabs((double)insole_sym2_largest(A) / most - 1.0), i);
    }
    ASSERT_WORST(off, 1.0e-6, "of it");
}
END_TEST

/* Ways and places, on which all this stands. */
START_TEST(spots_add_up)
{
    insole_spot_t a = {3, 4}, b = {-1, 2};
    insole_spot_t sum = insole_spot_add(a, b), difference = insole_spot_sub(a, b);
    insole_spot_t scaled = insole_spot_add_scaled(a, INSOLE_R(0.5), b);
    ASSERT_NEAR(insole_spot_norm(a), 5.0, 0.0, "m");
    ASSERT_NEAR(insole_spot_dot(a, b), 5.0, 0.0, "m^2");
    ASSERT_NEAR(sum.x_m, 2.0, 0.0, "m");
    ASSERT_NEAR(sum.y_m, 6.0, 0.0, "m");
    ASSERT_NEAR(difference.x_m, 4.0, 0.0, "m");
    ASSERT_NEAR(difference.y_m, 2.0, 0.0, "m");
    ASSERT_NEAR(scaled.x_m, 2.5, 0.0, "m");
    ASSERT_NEAR(scaled.y_m, 5.0, 0.0, "m");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sym2");
    suite_add(suite, "algebra", algebra_is_that_of_full_matrices);
    suite_add(suite, "inverse", an_inverse_undoes);
    suite_add_loop(suite, "none", what_is_no_covariance_has_no_inverse, NO_COVARIANCES);
    suite_add(suite, "bounds", bounds_hold_for_all_and_leave_the_rest_alone);
    suite_add(suite, "largest", the_larger_eigenvalue_is_the_variance_of_the_worst_direction);
    suite_add(suite, "spots", spots_add_up);
    return suite;
}
