/* SPDX-License-Identifier: MIT */
#include "insole/base/mat.h"

#include <string.h>

#include "near.h"
#include "sample.h"
#include "suite.h"

static const double EPS = (double)INSOLE_REAL_EPSILON;
enum { TRIES = 200 };

/* Plain 3x3 arrays and triple loops in double: what every block operation is held against. */
typedef struct {
    double at[3][3];
} plain_t;

static plain_t plain(insole_mat3_t a)
{
    plain_t p = {{{(double)a.r0.x, (double)a.r0.y, (double)a.r0.z},
                  {(double)a.r1.x, (double)a.r1.y, (double)a.r1.z},
                  {(double)a.r2.x, (double)a.r2.y, (double)a.r2.z}}};
    return p;
}

static plain_t plain_sym(insole_sym3_t a)
{
    plain_t p = {{{(double)a.xx, (double)a.xy, (double)a.xz},
                  {(double)a.xy, (double)a.yy, (double)a.yz},
                  {(double)a.xz, (double)a.yz, (double)a.zz}}};
    return p;
}

static plain_t plain_skew(insole_vec3_t v)
{
    double x = (double)v.x, y = (double)v.y, z = (double)v.z;
    plain_t p = {{{0.0, -z, y}, {z, 0.0, -x}, {-y, x, 0.0}}};
    return p;
}

/* v in the first column, zeros beside it. */
static plain_t plain_column(insole_vec3_t v)
{
    plain_t p = {{{(double)v.x, 0.0, 0.0}, {(double)v.y, 0.0, 0.0}, {(double)v.z, 0.0, 0.0}}};
    return p;
}

static plain_t plain_transpose(plain_t a)
{
    plain_t t;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            t.at[j][i] = a.at[i][j];
        }
    }
    return t;
}

static plain_t plain_product(plain_t a, plain_t b)
{
    plain_t c;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            c.at[i][j] = 0.0;
            for (int k = 0; k < 3; k++) {
                c.at[i][j] += a.at[i][k] * b.at[k][j];
            }
        }
    }
    return c;
}

/* a + s b */
static plain_t plain_sum(plain_t a, double s, plain_t b)
{
    for (int i = 0; i < 9; i++) {
        a.at[i / 3][i % 3] += s * b.at[i / 3][i % 3];
    }
    return a;
}

static plain_t plain_identity(void)
{
    plain_t p = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    return p;
}

static double distance(plain_t a, plain_t b)
{
    worst_t worst = {0.0, 0.0};
    for (int i = 0; i < 9; i++) {
        worst_note(&worst, fabs(a.at[i / 3][i % 3] - b.at[i / 3][i % 3]), i);
    }
    return worst.off;
}

/* Entries below 3: a sum of a few products is off by at most some ten roundings of 27. */
static const double TOLERANCE_IN_EPS = 60.0;

static void assert_same(plain_t value, plain_t expected, const char *what)
{
    double off = distance(value, expected);
    ck_assert_msg(off <= TOLERANCE_IN_EPS * EPS, "%s is off by %.3g", what, off);
}

typedef struct {
    insole_rng_t rng;
    insole_mat3_t A, B;
    insole_sym3_t S, T;
    insole_vec3_t v;
    insole_real_t s;
} sample_t;

static sample_t first_sample(void)
{
    sample_t x;
    memset(&x, 0, sizeof x);
    insole_rng_seed(&x.rng, 1u);
    return x;
}

static void draw(sample_t *x)
{
    x->A = sample_mat3(&x->rng, INSOLE_R(3.0));
    x->B = sample_mat3(&x->rng, INSOLE_R(3.0));
    x->S = sample_sym3(&x->rng, INSOLE_R(3.0));
    x->T = sample_sym3(&x->rng, INSOLE_R(3.0));
    x->v = sample_vec3(&x->rng, INSOLE_R(3.0));
    x->s = sample_between(&x->rng, INSOLE_R(-3.0), INSOLE_R(3.0));
}

START_TEST(sums_and_transposes)
{
    sample_t x = first_sample();
    for (int i = 0; i < TRIES; i++) {
        draw(&x);
        plain_t A = plain(x.A), B = plain(x.B), zero = plain(insole_mat3_zero());
        double s = (double)x.s;
        assert_same(zero, plain_sum(A, -1.0, A), "zero");
        assert_same(plain(insole_mat3_transpose(x.A)), plain_transpose(A), "A'");
        assert_same(plain(insole_mat3_add(x.A, x.B)), plain_sum(A, 1.0, B), "A + B");
        assert_same(plain(insole_mat3_sub(x.A, x.B)), plain_sum(A, -1.0, B), "A - B");
        assert_same(plain(insole_mat3_scale(x.A, x.s)), plain_sum(zero, s, A), "s A");
        assert_same(plain(insole_mat3_add_scaled(x.A, x.s, x.B)), plain_sum(A, s, B), "A + s B");
    }
}
END_TEST

START_TEST(products_with_vectors)
{
    sample_t x = first_sample();
    for (int i = 0; i < TRIES; i++) {
        draw(&x);
        plain_t A = plain(x.A), v = plain_column(x.v);
        assert_same(plain_column(insole_mat3_mul_vec(x.A, x.v)), plain_product(A, v), "A v");
        assert_same(plain_column(insole_mat3_mul_vec_t(x.A, x.v)),
                    plain_product(plain_transpose(A), v), "A' v");
        assert_same(plain_column(insole_sym3_mul_vec(x.S, x.v)), plain_product(plain_sym(x.S), v),
                    "S v");
    }
}
END_TEST

START_TEST(products_of_blocks)
{
    sample_t x = first_sample();
    for (int i = 0; i < TRIES; i++) {
        draw(&x);
        plain_t A = plain(x.A), B = plain(x.B);
        assert_same(plain(insole_mat3_mul(x.A, x.B)), plain_product(A, B), "A B");
        assert_same(plain(insole_mat3_mul_t(x.A, x.B)), plain_product(A, plain_transpose(B)),
                    "A B'");
        assert_same(plain(insole_mat3_mul_sym(x.A, x.S)), plain_product(A, plain_sym(x.S)), "A S");
    }
}
END_TEST

START_TEST(products_with_skew_matrices)
{
    sample_t x = first_sample();
    for (int i = 0; i < TRIES; i++) {
        draw(&x);
        plain_t A = plain(x.A), V = plain_skew(x.v);
        assert_same(plain(insole_mat3_mul_skew(x.A, x.v)), plain_product(A, V), "A [v]x");
        assert_same(plain(insole_mat3_skew_mul(x.v, x.A)), plain_product(V, A), "[v]x A");
    }
}
END_TEST

START_TEST(symmetric_sums)
{
    sample_t x = first_sample();
    for (int i = 0; i < TRIES; i++) {
        draw(&x);
        plain_t A = plain(x.A), S = plain_sym(x.S), T = plain_sym(x.T), v = plain_column(x.v);
        double s = (double)x.s;
        plain_t twice = plain_sum(A, 1.0, plain_transpose(A));
        plain_t outer = plain_product(v, plain_transpose(v));
        assert_same(plain_sym(insole_sym3_add(x.S, x.T)), plain_sum(S, 1.0, T), "S + T");
        assert_same(plain_sym(insole_sym3_add_scaled(x.S, x.s, x.T)), plain_sum(S, s, T),
                    "S + s T");
        assert_same(plain_sym(insole_sym3_add_diagonal(x.S, x.s)),
                    plain_sum(S, s, plain_identity()), "S + s I");
        assert_same(plain_sym(insole_sym3_add_outer(x.S, x.s, x.v)), plain_sum(S, s, outer),
                    "S + s v v'");
        assert_same(plain_sym(insole_sym3_add_twice(x.S, x.s, x.A)), plain_sum(S, s, twice),
                    "S + s (A + A')");
    }
}
END_TEST

START_TEST(sums_with_outer_products)
{
    sample_t x = first_sample();
    for (int i = 0; i < TRIES; i++) {
        draw(&x);
        plain_t outer = plain_product(plain_column(x.v), plain_transpose(plain_column(x.A.r1)));
        assert_same(plain(insole_mat3_add_outer(x.B, x.s, x.v, x.A.r1)),
                    plain_sum(plain(x.B), (double)x.s, outer), "A + s v w'");
    }
}
END_TEST

START_TEST(symmetric_and_full_forms)
{
    sample_t x = first_sample();
    for (int i = 0; i < TRIES; i++) {
        draw(&x);
        plain_t A = plain(x.A), S = plain_sym(x.S);
        plain_t zero = plain_sum(A, -1.0, A);
        plain_t half = plain_sum(plain_sum(zero, 0.5, A), 0.5, plain_transpose(A));
        assert_same(plain(insole_sym3_full(x.S)), S, "S as a full block");
        assert_same(plain_sym(insole_mat3_symmetric(insole_sym3_full(x.S))), S, "and back");
        assert_same(plain_sym(insole_mat3_symmetric(x.A)), half, "symmetric part");
        insole_mat3_t AS = insole_mat3_mul_sym(x.A, x.S);
        plain_t expected = plain_product(plain_product(A, S), plain_transpose(A));
        double off = distance(plain_sym(insole_mat3_mul_t_sym(AS, x.A)), expected);
        ASSERT_AT_MOST(off, 6.0 * TOLERANCE_IN_EPS * EPS, "in A S A'");
    }
    insole_sym3_t d = insole_sym3_diagonal(INSOLE_R(1.0), INSOLE_R(2.0), INSOLE_R(3.0));
    plain_t expected = {{{1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 3.0}}};
    assert_same(plain_sym(d), expected, "diagonal");
    assert_same(plain_sym(insole_sym3_zero()), plain(insole_mat3_zero()), "zero");
}
END_TEST

/* M M' + I is positive definite, with a smallest eigenvalue of at least 1. */
START_TEST(inverse_of_a_definite_block)
{
    sample_t x = first_sample();
    for (int i = 0; i < TRIES; i++) {
        draw(&x);
        insole_sym3_t P = insole_sym3_add_diagonal(insole_mat3_mul_t_sym(x.A, x.A), INSOLE_R(1.0)),
                      inverse;
        ck_assert(insole_sym3_inverse(P, &inverse));
        plain_t product = plain_product(plain_sym(P), plain_sym(inverse));
        double condition = (double)(P.xx + P.yy + P.zz); /* trace / 1 */
        ASSERT_AT_MOST(distance(product, plain_identity()), 10.0 * condition * EPS, "");
    }
}
END_TEST

/* Covariances of a micrometre or of a planet: the scale goes through, the shape stays. */
START_TEST(inverse_at_any_scale)
{
    static const float SCALES[] = {1e-30f, 1e-20f, 1e-12f, 1e-6f, 1e6f, 1e12f, 1e20f, 1e30f};
    const insole_real_t scale = (insole_real_t)SCALES[_i], one = INSOLE_R(1.0);
    insole_sym3_t P = {2 * scale, scale, 0, 2 * scale, scale, 2 * scale}, inverse;
    ck_assert(insole_sym3_inverse(P, &inverse));
    insole_sym3_t shape = {inverse.xx * scale, inverse.xy * scale, inverse.xz * scale,
                           inverse.yy * scale, inverse.yz * scale, inverse.zz * scale};
    plain_t expected = {{{0.75, -0.5, 0.25}, {-0.5, 1.0, -0.5}, {0.25, -0.5, 0.75}}};
    assert_same(plain_sym(shape), expected, "scaled inverse");
    insole_sym3_t uneven = insole_sym3_diagonal(scale, one, one / scale);
    ck_assert(insole_sym3_inverse(uneven, &inverse));
    ASSERT_NEAR(inverse.xx * scale, 1.0, 4.0 * EPS, "");
    ASSERT_NEAR(inverse.zz / scale, 1.0, 4.0 * EPS, "");
}
END_TEST

START_TEST(inverse_worked_out_by_hand)
{
    insole_sym3_t P = {INSOLE_R(2.0), INSOLE_R(1.0), INSOLE_R(0.0),
                       INSOLE_R(2.0), INSOLE_R(1.0), INSOLE_R(2.0)};
    insole_sym3_t inverse;
    ck_assert(insole_sym3_inverse(P, &inverse));
    plain_t expected = {{{0.75, -0.5, 0.25}, {-0.5, 1.0, -0.5}, {0.25, -0.5, 0.75}}};
    assert_same(plain_sym(inverse), expected, "inverse");
}
END_TEST

START_TEST(blocks_that_are_not_definite_are_refused)
{
    const insole_real_t o = INSOLE_R(0.0), i = INSOLE_R(1.0), two = INSOLE_R(2.0);
    const insole_real_t nan = (insole_real_t)NAN, inf = (insole_real_t)INFINITY;
    const insole_real_t tiny = INSOLE_R(0.1) / INSOLE_REAL_MAX; /* 1 / tiny is infinite */
    const insole_sym3_t bad[] = {
        {o, o, o, o, o, o},    {i, o, o, i, o, o},     {i, o, o, o, o, i},    {o, o, o, i, o, i},
        {-i, o, o, -i, o, i},  {i, o, o, -i, o, -i},   {-i, o, o, -i, o, -i}, {i, two, o, i, o, i},
        {i, o, two, i, o, i},  {i, o, o, i, two, i},   {i, i, i, i, i, i},    {nan, o, o, i, o, i},
        {i, o, o, nan, o, i},  {i, o, o, i, o, nan},   {i, nan, o, i, o, i},  {i, o, nan, i, o, i},
        {i, o, o, i, nan, i},  {inf, inf, o, i, o, i}, {i, inf, o, i, o, i},  {i, o, o, i, o, tiny},
        {tiny, o, o, i, o, i},
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        insole_sym3_t inverse = {i, i, i, i, i, i}, before = inverse;
        ck_assert_msg(!insole_sym3_inverse(bad[k], &inverse), "block %zu", k);
        ck_assert_int_eq(memcmp(&inverse, &before, sizeof inverse), 0);
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("mat");
    suite_add(suite, "sums", sums_and_transposes);
    suite_add(suite, "vectors", products_with_vectors);
    suite_add(suite, "blocks", products_of_blocks);
    suite_add(suite, "skew", products_with_skew_matrices);
    suite_add(suite, "symmetric sums", symmetric_sums);
    suite_add(suite, "sums with outer products", sums_with_outer_products);
    suite_add(suite, "symmetric forms", symmetric_and_full_forms);
    suite_add(suite, "inverse", inverse_of_a_definite_block);
    suite_add_loop(suite, "inverse at any scale", inverse_at_any_scale, 8);
    suite_add(suite, "inverse by hand", inverse_worked_out_by_hand);
    suite_add(suite, "not definite", blocks_that_are_not_definite_are_refused);
    return suite;
}
