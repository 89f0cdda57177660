/* SPDX-License-Identifier: MIT */
#include "insole/base/unscented.h"

#include <string.h>

#include "near.h"
#include "sample.h"
#include "suite.h"

#define EPS ((double)INSOLE_REAL_EPSILON)

enum { MOST = INSOLE_UNSCENTED_MOST, POINTS = 2 * MOST + 1 };

typedef struct {
    insole_real_t at[MOST * MOST];
} square_t;

static square_t random_square(insole_rng_t *rng, uint32_t n)
{
    square_t M = {{0}};
    for (uint32_t i = 0u; i < n * n; i++) {
        M.at[i] = sample_between(rng, -1, 1);
    }
    return M;
}

/* M M' + s I */
static square_t positive(const square_t *M, uint32_t n, insole_real_t s)
{
    square_t A = {{0}};
    for (uint32_t r = 0u; r < n; r++) {
        for (uint32_t c = 0u; c < n; c++) {
            double sum = r == c ? (double)s : 0.0;
            for (uint32_t k = 0u; k < n; k++) {
                sum += (double)M->at[r * n + k] * (double)M->at[c * n + k];
            }
            A.at[r * n + c] = (insole_real_t)sum;
        }
    }
    return A;
}

static double off_by(const square_t *A, const square_t *B, uint32_t n)
{
    double off = 0.0;
    for (uint32_t i = 0u; i < n * n; i++) {
        off = fmax(off, fabs((double)A->at[i] - (double)B->at[i]));
    }
    return off;
}

START_TEST(a_root_times_itself_is_the_matrix)
{
    const uint32_t n = (uint32_t)_i + 1u;
    insole_rng_t rng;
    insole_rng_seed(&rng, n);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 300; i++) {
        square_t M = random_square(&rng, n), A = positive(&M, n, INSOLE_R(0.1)), L;
        memset(&L, 0x5a, sizeof L);
        ck_assert(insole_cholesky(n, A.at, L.at));
        for (uint32_t r = 0u; r < n; r++) {
            ck_assert(L.at[r * n + r] > 0);
            for (uint32_t c = r + 1u; c < n; c++) {
                ck_assert(L.at[r * n + c] == 0);
            }
        }
        square_t back = positive(&L, n, 0);
        worst_note(&off, off_by(&A, &back, n), i);
    }
    ASSERT_WORST(off, 20.0 * EPS, "");
}
END_TEST

/* By hand: rank one, and rank two of three with the gap in the middle. */
START_TEST(singular_matrices_have_roots)
{
    static const insole_real_t ONE[9] = {4, 2, -6, 2, 1, -3, -6, -3, 9};
    static const insole_real_t GAP[9] = {4, 0, 2, 0, 0, 0, 2, 0, 5};
    insole_real_t L[9];
    ck_assert(!insole_cholesky(3u, ONE, L));
    static const insole_real_t ONE_ROOT[9] = {2, 0, 0, 1, 0, 0, -3, 0, 0};
    static const insole_real_t GAP_ROOT[9] = {2, 0, 0, 0, 0, 0, 1, 0, 2};
    ck_assert_int_eq(memcmp(L, ONE_ROOT, sizeof L), 0);
    ck_assert(!insole_cholesky(3u, GAP, L));
    ck_assert_int_eq(memcmp(L, GAP_ROOT, sizeof L), 0);
}
END_TEST

/* What is not positive at all still gets an answer, a finite one. */
START_TEST(no_matrix_is_without_an_answer)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    int refused = 0;
    for (int i = 0; i < 2000; i++) {
        uint32_t n = (uint32_t)(i % MOST) + 1u;
        square_t M = random_square(&rng, n), L;
        refused += insole_cholesky(n, M.at, L.at) ? 0 : 1;
        for (uint32_t k = 0u; k < n * n; k++) {
            ck_assert(insole_is_finite(L.at[k]));
        }
    }
    ck_assert_int_gt(refused, 1500);
    static const insole_real_t BAD[4] = {1, 2, 2, 1};
    static const insole_real_t ROOT[4] = {1, 0, 2, 0};
    insole_real_t L[4];
    ck_assert(!insole_cholesky(2u, BAD, L));
    ck_assert_int_eq(memcmp(L, ROOT, sizeof L), 0);
}
END_TEST

typedef struct {
    insole_unscented_t ut;
    insole_real_t mean[MOST], points[POINTS * MOST];
    square_t P;
} cloud_t;

static cloud_t cloud(insole_rng_t *rng, uint32_t n, insole_real_t alpha, insole_real_t kappa)
{
    cloud_t c;
    square_t M = random_square(rng, n), root;
    c.ut = insole_unscented(n, alpha, 2, kappa);
    c.P = positive(&M, n, INSOLE_R(0.1));
    for (uint32_t k = 0u; k < n; k++) {
        c.mean[k] = sample_between(rng, -3, 3);
    }
    ck_assert(insole_cholesky(n, c.P.at, root.at));
    insole_unscented_points(&c.ut, c.mean, root.at, c.points);
    return c;
}

/* The points' own mean and covariance are those they were drawn from, whatever the weights. */
START_TEST(points_have_the_moments_they_were_drawn_from)
{
    static const struct {
        insole_real_t alpha, kappa;
    } ROWS[] = {{1, 0}, {INSOLE_R(0.5), 0}, {1, 2}, {INSOLE_R(0.7), 1}};
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    for (uint32_t n = 1u; n <= MOST; n++) {
        cloud_t c = cloud(&rng, n, ROWS[_i].alpha, ROWS[_i].kappa);
        ASSERT_NEAR(c.ut.mean0 + 2 * (insole_real_t)n * c.ut.weight, 1.0, 100.0 * EPS, "");
        insole_real_t mean[MOST];
        square_t P = {{0}};
        insole_unscented_mean(&c.ut, n, c.points, mean);
        insole_unscented_cov(&c.ut, n, c.points, c.mean, n, c.points, c.mean, P.at);
        for (uint32_t k = 0u; k < n; k++) {
            ASSERT_NEAR(mean[k], c.mean[k], 300.0 * EPS, "");
        }
        ASSERT_AT_MOST(off_by(&P, &c.P, n), 300.0 * EPS, "");
    }
}
END_TEST

/* Through a matrix B the transform is exact: B m, B P B' and P B'. */
START_TEST(a_linear_function_is_exact)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    worst_t off = {0.0, 0.0};
    enum { M = 4 };
    for (uint32_t n = 1u; n <= MOST; n++) {
        cloud_t c = cloud(&rng, n, 1, 0);
        insole_real_t B[M * MOST], values[POINTS * M], value[M], P_value[M * M], cross[MOST * M];
        for (uint32_t i = 0u; i < M * n; i++) {
            B[i] = sample_between(&rng, -1, 1);
        }
        for (uint32_t i = 0u; i <= 2u * n; i++) {
            for (uint32_t r = 0u; r < M; r++) {
                double sum = 0.0;
                for (uint32_t k = 0u; k < n; k++) {
                    sum += (double)B[r * n + k] * (double)c.points[i * n + k];
                }
                values[i * M + r] = (insole_real_t)sum;
            }
        }
        insole_unscented_mean(&c.ut, M, values, value);
        insole_unscented_cov(&c.ut, M, values, value, M, values, value, P_value);
        insole_unscented_cov(&c.ut, n, c.points, c.mean, M, values, value, cross);
        for (uint32_t r = 0u; r < M; r++) {
            double m = 0.0, PB[MOST];
            for (uint32_t k = 0u; k < n; k++) {
                m += (double)B[r * n + k] * (double)c.mean[k];
                PB[k] = 0.0;
                for (uint32_t j = 0u; j < n; j++) {
                    PB[k] += (double)c.P.at[k * n + j] * (double)B[r * n + j];
                }
                worst_note(&off, fabs(PB[k] - (double)cross[k * M + r]), n);
            }
            worst_note(&off, fabs(m - (double)value[r]), n);
            for (uint32_t s = 0u; s < M; s++) {
                double v = 0.0;
                for (uint32_t k = 0u; k < n; k++) {
                    v += (double)B[s * n + k] * PB[k];
                }
                worst_note(&off, fabs(v - (double)P_value[s * M + r]), n);
            }
        }
    }
    ASSERT_WORST(off, 500.0 * EPS, "");
}
END_TEST

/* A range and a bearing become a place: mean and covariance against a million draws. */
START_TEST(a_curved_function_is_near_monte_carlo)
{
    const double r0 = 10.0, b0 = 0.6, sr = 0.5, sb = 0.25;
    insole_unscented_t ut = insole_unscented(2u, 1, 2, 0);
    const insole_real_t mean[2] = {(insole_real_t)r0, (insole_real_t)b0};
    const insole_real_t P[4] = {(insole_real_t)(sr * sr), 0, 0, (insole_real_t)(sb * sb)};
    insole_real_t root[4], points[10], values[10], place[2], cov[4];
    ck_assert(insole_cholesky(2u, P, root));
    insole_unscented_points(&ut, mean, root, points);
    for (int i = 0; i < 5; i++) {
        double r = (double)points[2 * i], b = (double)points[2 * i + 1];
        values[2 * i] = (insole_real_t)(r * cos(b));
        values[2 * i + 1] = (insole_real_t)(r * sin(b));
    }
    insole_unscented_mean(&ut, 2u, values, place);
    insole_unscented_cov(&ut, 2u, values, place, 2u, values, place, cov);
    enum { DRAWS = 1000000 };
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    insole_rng_t rng;
    insole_rng_seed(&rng, 6u);
    for (int i = 0; i < DRAWS; i++) {
        double r = r0 + sr * (double)insole_rng_normal(&rng);
        double b = b0 + sb * (double)insole_rng_normal(&rng);
        double px = r * cos(b) - r0 * cos(b0), py = r * sin(b) - r0 * sin(b0);
        x += px / DRAWS;
        y += py / DRAWS;
        xx += px * px / DRAWS;
        xy += px * py / DRAWS;
        yy += py * py / DRAWS;
    }
    /* a linear function would be off by 0.26 m in x */
    ASSERT_NEAR(place[0], r0 * cos(b0) + x, 0.02, "m");
    ASSERT_NEAR(place[1], r0 * sin(b0) + y, 0.02, "m");
    ASSERT_NEAR(cov[0], xx - x * x, 0.06 * (xx + yy), "m^2");
    ASSERT_NEAR(cov[1], xy - x * y, 0.06 * (xx + yy), "m^2");
    ASSERT_NEAR(cov[3], yy - y * y, 0.06 * (xx + yy), "m^2");
}
END_TEST

/* (15) by hand: L = 4, alpha = 1/2, beta = 2, kappa = 0 gives lambda = -3. */
START_TEST(weights_are_those_of_the_paper)
{
    insole_unscented_t ut = insole_unscented(4u, INSOLE_R(0.5), 2, 0);
    ASSERT_NEAR(ut.spread, 1.0, 2.0 * EPS, "");
    ASSERT_NEAR(ut.mean0, -3.0, 4.0 * EPS, "");
    ASSERT_NEAR(ut.cov0, -3.0 + 1.0 - 0.25 + 2.0, 8.0 * EPS, "");
    ASSERT_NEAR(ut.weight, 0.5, EPS, "");
    ut = insole_unscented(9u, 1, 2, 0);
    ASSERT_NEAR(ut.mean0, 0.0, 0.0, "");
    ASSERT_NEAR(ut.cov0, 2.0, 0.0, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("unscented");
    suite_add_loop(suite, "root", a_root_times_itself_is_the_matrix, MOST);
    suite_add(suite, "singular", singular_matrices_have_roots);
    suite_add(suite, "indefinite", no_matrix_is_without_an_answer);
    suite_add_loop(suite, "points", points_have_the_moments_they_were_drawn_from, 4);
    suite_add(suite, "linear", a_linear_function_is_exact);
    suite_add(suite, "curved", a_curved_function_is_near_monte_carlo);
    suite_add(suite, "weights", weights_are_those_of_the_paper);
    return suite;
}
