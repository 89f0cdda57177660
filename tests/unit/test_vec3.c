/* SPDX-License-Identifier: MIT */
#include "insole/base/vec3.h"

#include "near.h"
#include "sample.h"
#include "suite.h"

static const double EPS = (double)INSOLE_REAL_EPSILON;
enum { TRIES = 1000 };

static insole_rng_t seeded(void)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    return rng;
}

static void assert_vec3(insole_vec3_t v, double x, double y, double z, double tolerance)
{
    ASSERT_NEAR(v.x, x, tolerance, "in x");
    ASSERT_NEAR(v.y, y, tolerance, "in y");
    ASSERT_NEAR(v.z, z, tolerance, "in z");
}

/* Whole numbers have exact answers that can be worked out by hand. */
START_TEST(small_whole_vectors)
{
    insole_vec3_t a = insole_vec3(INSOLE_R(1.0), INSOLE_R(2.0), INSOLE_R(3.0));
    insole_vec3_t b = insole_vec3(INSOLE_R(-4.0), INSOLE_R(5.0), INSOLE_R(6.0));
    assert_vec3(a, 1.0, 2.0, 3.0, 0.0);
    assert_vec3(insole_vec3_zero(), 0.0, 0.0, 0.0, 0.0);
    assert_vec3(insole_vec3_add(a, b), -3.0, 7.0, 9.0, 0.0);
    assert_vec3(insole_vec3_sub(a, b), 5.0, -3.0, -3.0, 0.0);
    assert_vec3(insole_vec3_neg(b), 4.0, -5.0, -6.0, 0.0);
    assert_vec3(insole_vec3_scale(b, INSOLE_R(-2.0)), 8.0, -10.0, -12.0, 0.0);
    assert_vec3(insole_vec3_add_scaled(a, INSOLE_R(10.0), b), -39.0, 52.0, 63.0, 0.0);
    assert_vec3(insole_vec3_cross(a, b), -3.0, -18.0, 13.0, 0.0);
    ASSERT_NEAR(insole_vec3_dot(a, b), 24.0, 0.0, "");
    ASSERT_NEAR(insole_vec3_norm2(b), 77.0, 0.0, "");
}
END_TEST

START_TEST(the_axes_are_right_handed)
{
    const insole_real_t o = INSOLE_R(0.0), i = INSOLE_R(1.0);
    insole_vec3_t x = insole_vec3(i, o, o), y = insole_vec3(o, i, o), z = insole_vec3(o, o, i);
    assert_vec3(insole_vec3_cross(x, y), 0.0, 0.0, 1.0, 0.0);
    assert_vec3(insole_vec3_cross(y, z), 1.0, 0.0, 0.0, 0.0);
    assert_vec3(insole_vec3_cross(z, x), 0.0, 1.0, 0.0, 0.0);
    assert_vec3(insole_vec3_cross(x, x), 0.0, 0.0, 0.0, 0.0);
}
END_TEST

START_TEST(norms)
{
    insole_vec3_t v = insole_vec3(INSOLE_R(2.0), INSOLE_R(-3.0), INSOLE_R(6.0));
    ASSERT_NEAR(insole_vec3_norm(v), 7.0, 0.0, "");
    ASSERT_NEAR(insole_vec3_max_abs(v), 6.0, 0.0, "");
    ASSERT_NEAR(insole_vec3_level(insole_vec3(INSOLE_R(-3.0), INSOLE_R(4.0), v.z)), 5.0, 0.0, "");
    ASSERT_NEAR(insole_vec3_max_abs(insole_vec3_neg(v)), 6.0, 0.0, "");
    ASSERT_NEAR(insole_vec3_max_abs(insole_vec3(v.z, v.x, v.y)), 6.0, 0.0, "");
    ASSERT_NEAR(insole_vec3_max_abs(insole_vec3(v.x, insole_abs(v.z), v.y)), 6.0, 0.0, "");
    ASSERT_NEAR(insole_vec3_norm(insole_vec3_zero()), 0.0, 0.0, "");
}
END_TEST

/* Lagrange: |a x b|^2 + (a b)^2 = |a|^2 |b|^2; a x b is square to both. */
START_TEST(products_obey_their_identities)
{
    insole_rng_t rng = seeded();
    for (int i = 0; i < TRIES; i++) {
        insole_vec3_t a = sample_vec3(&rng, INSOLE_R(20.0)), b = sample_vec3(&rng, INSOLE_R(5.0));
        insole_vec3_t c = insole_vec3_cross(a, b);
        double size2 = (double)insole_vec3_norm2(a) * (double)insole_vec3_norm2(b);
        double dot = (double)insole_vec3_dot(a, b), size = sqrt(size2);
        ASSERT_NEAR((double)insole_vec3_norm2(c) + dot * dot, size2, 8.0 * EPS * size2, "");
        ASSERT_NEAR(insole_vec3_dot(a, c), 0.0, 8.0 * EPS * size * (double)insole_vec3_norm(a), "");
        ASSERT_NEAR(insole_vec3_dot(b, c), 0.0, 8.0 * EPS * size * (double)insole_vec3_norm(b), "");
        ASSERT_NEAR(insole_square(insole_vec3_norm(a)), insole_vec3_norm2(a), 4.0 * EPS * 1200.0,
                    "");
    }
}
END_TEST

START_TEST(sums_agree_with_double)
{
    insole_rng_t rng = seeded();
    for (int i = 0; i < TRIES; i++) {
        insole_vec3_t a = sample_vec3(&rng, INSOLE_R(9.0)), b = sample_vec3(&rng, INSOLE_R(9.0));
        insole_real_t s = sample_between(&rng, INSOLE_R(-2.0), INSOLE_R(2.0));
        double k = (double)s;
        assert_vec3(insole_vec3_add_scaled(a, s, b), (double)a.x + k * (double)b.x,
                    (double)a.y + k * (double)b.y, (double)a.z + k * (double)b.z, 30.0 * EPS);
        insole_vec3_t back = insole_vec3_sub(insole_vec3_add(a, b), b);
        assert_vec3(back, (double)a.x, (double)a.y, (double)a.z, 30.0 * EPS);
    }
}
END_TEST

START_TEST(one_bad_component_makes_a_vector_not_finite)
{
    const insole_real_t bad[] = {(insole_real_t)NAN, (insole_real_t)INFINITY,
                                 -(insole_real_t)INFINITY};
    insole_vec3_t good = insole_vec3(INSOLE_REAL_MAX, -INSOLE_REAL_MAX, INSOLE_R(0.0));
    ck_assert(insole_vec3_is_finite(good));
    ck_assert(insole_vec3_is_within(good, insole_vec3_max_abs(good)));
    ck_assert(!insole_vec3_is_within(good, INSOLE_R(0.999) * insole_vec3_max_abs(good)));
    for (int i = 0; i < 3; i++) {
        insole_vec3_t x = good, y = good, z = good;
        x.x = bad[i];
        y.y = bad[i];
        z.z = bad[i];
        ck_assert(!insole_vec3_is_finite(x));
        ck_assert(!insole_vec3_is_finite(y));
        ck_assert(!insole_vec3_is_finite(z));
        ck_assert(!insole_vec3_is_within(x, INSOLE_REAL_MAX));
        ck_assert(!insole_vec3_is_within(y, INSOLE_REAL_MAX));
        ck_assert(!insole_vec3_is_within(z, INSOLE_REAL_MAX));
    }
}
END_TEST

START_TEST(helpers_of_the_real_type)
{
    const insole_real_t nan = (insole_real_t)NAN, one = INSOLE_R(1.0), two = INSOLE_R(2.0);
    ASSERT_NEAR(insole_max(one, two), 2.0, 0.0, "");
    ASSERT_NEAR(insole_max(two, one), 2.0, 0.0, "");
    ASSERT_NEAR(insole_min(one, two), 1.0, 0.0, "");
    ASSERT_NEAR(insole_min(two, one), 1.0, 0.0, "");
    ASSERT_NEAR(insole_max(nan, one), 1.0, 0.0, "");
    ASSERT_NEAR(insole_min(nan, one), 1.0, 0.0, "");
    ASSERT_NEAR(insole_abs(-two), 2.0, 0.0, "");
    ASSERT_NEAR(insole_abs(two), 2.0, 0.0, "");
    ck_assert(!signbit(insole_abs(-INSOLE_R(0.0))));
    ASSERT_NEAR(insole_square(-two), 4.0, 0.0, "");
    ASSERT_NEAR(insole_sqrt(INSOLE_R(6.25)), 2.5, 0.0, "");
    ASSERT_NEAR(INSOLE_PI, 3.14159265358979323846, 2.0 * EPS, "");
    ck_assert(insole_is_finite(INSOLE_REAL_MAX) && insole_is_finite(-INSOLE_REAL_MAX));
    ck_assert(!insole_is_finite(nan) && !insole_is_finite((insole_real_t)INFINITY));
    ck_assert(isnan(insole_abs(nan)));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("vec3");
    suite_add(suite, "whole vectors", small_whole_vectors);
    suite_add(suite, "right-handed", the_axes_are_right_handed);
    suite_add(suite, "norms", norms);
    suite_add(suite, "identities", products_obey_their_identities);
    suite_add(suite, "sums", sums_agree_with_double);
    suite_add(suite, "not finite", one_bad_component_makes_a_vector_not_finite);
    suite_add(suite, "real", helpers_of_the_real_type);
    return suite;
}
