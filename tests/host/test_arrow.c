/* SPDX-License-Identifier: MIT */
#include "arrow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "near.h"
#include "suite.h"

/* The same equations as one dense matrix, inverted by elimination with pivots: the oracle. */
enum { GROUPS = 4, ALL = ARROW_COMMON + ARROW_OWN * GROUPS };

typedef struct {
    double A[ALL][ALL], b[ALL], P[ALL][ALL], x[ALL];
} dense_t;

static double number(void)
{
    return 2.0 * rand() / (double)RAND_MAX - 1.0;
}

static void dense_add(dense_t *dense, const double row[ALL], double value, double weight)
{
    for (int i = 0; i < ALL; i++) {
        for (int j = 0; j < ALL; j++) {
            dense->A[i][j] += weight * row[i] * row[j];
        }
        dense->b[i] += weight * row[i] * value;
    }
}

static int pivot_of(const double work[ALL][2 * ALL], int k)
{
    int best = k;
    for (int i = k; i < ALL; i++) {
        best = fabs(work[i][k]) > fabs(work[best][k]) ? i : best;
    }
    return best;
}

static void dense_solve(dense_t *dense)
{
    static double work[ALL][2 * ALL];
    memset(work, 0, sizeof work);
    for (int i = 0; i < ALL; i++) {
        memcpy(work[i], dense->A[i], sizeof dense->A[i]);
        work[i][ALL + i] = 1.0;
    }
    for (int k = 0; k < ALL; k++) {
        int pivot = pivot_of((const double(*)[2 * ALL]) work, k);
        for (int j = 0; j < 2 * ALL; j++) {
            double swap = work[k][j];
            work[k][j] = work[pivot][j];
            work[pivot][j] = swap;
        }
        for (int i = 0; i < ALL; i++) {
            double factor = i == k ? 0.0 : work[i][k] / work[k][k];
            for (int j = 0; j < 2 * ALL; j++) {
                work[i][j] -= factor * work[k][j];
            }
        }
    }
    for (int i = 0; i < ALL; i++) {
        dense->x[i] = 0.0;
        for (int j = 0; j < ALL; j++) {
            dense->P[i][j] = work[i][ALL + j] / work[i][i];
            dense->x[i] += dense->P[i][j] * dense->b[j];
        }
    }
}

static void add_both(arrow_t *arrow, dense_t *dense, size_t group)
{
    double common[ARROW_COMMON], row[ALL] = {0.0}, value = 5.0 * number(),
                                 weight = 0.1 + fabs(number());
    for (int i = 0; i < ARROW_COMMON; i++) {
        common[i] = row[i] = number();
    }
    for (int k = 0; k < ARROW_OWN; k++) {
        row[ARROW_COMMON + (int)group * ARROW_OWN + k] = common[k];
    }
    arrow_add(arrow, group, common, common, value, weight);
    dense_add(dense, row, value, weight);
}

static void make_both(arrow_t *arrow, dense_t *dense)
{
    memset(dense, 0, sizeof *dense);
    arrow_begin(arrow, GROUPS);
    for (int k = 0; k < ARROW_COMMON; k++) {
        double row[ALL] = {0.0};
        row[k] = 1.0;
        arrow_prior(arrow, k, 1.0 + k, 2.0 + k);
        dense_add(dense, row, 1.0 + k, 1.0 / ((2.0 + k) * (2.0 + k)));
    }
    for (int i = 0; i < ARROW_OWN * GROUPS; i++) {
        double row[ALL] = {0.0};
        row[ARROW_COMMON + i] = 1.0;
        arrow_group_prior(arrow, (size_t)(i / ARROW_OWN), i % ARROW_OWN, 0.5);
        dense_add(dense, row, 0.0, 4.0);
    }
    for (int i = 0; i < 60; i++) {
        add_both(arrow, dense, (size_t)(i % (GROUPS - 1))); /* of the last nothing is known */
    }
}

START_TEST(solution_and_variances_are_those_of_the_dense_equations)
{
    static dense_t dense;
    arrow_t arrow;
    srand(51);
    for (int trial = 0; trial < 20; trial++) {
        make_both(&arrow, &dense);
        dense_solve(&dense);
        ck_assert(arrow_solve(&arrow));
        for (int i = 0; i < ARROW_COMMON; i++) {
            ASSERT_NEAR(arrow.x[i], dense.x[i], 1e-9, "");
            for (int j = 0; j < ARROW_COMMON; j++) {
                ASSERT_NEAR(arrow.P[i][j], dense.P[i][j], 1e-9, "");
            }
        }
        for (int i = 0; i < ARROW_OWN * GROUPS; i++) {
            const arrow_group_t *group = &arrow.groups[i / ARROW_OWN];
            int k = i % ARROW_OWN, at = ARROW_COMMON + i;
            ASSERT_NEAR(group->x[k], dense.x[at], 1e-9, "");
            ASSERT_NEAR(group->variance[k], dense.P[at][at], 1e-9, "");
            ASSERT_NEAR(group->sum_variance[k],
                        dense.P[k][k] + dense.P[at][at] + 2.0 * dense.P[k][at], 1e-9, "");
        }
        arrow_free(&arrow);
    }
}
END_TEST

START_TEST(a_group_nothing_is_known_of_keeps_its_prior)
{
    static dense_t dense;
    arrow_t arrow;
    srand(52);
    make_both(&arrow, &dense);
    ck_assert(arrow_solve(&arrow));
    ASSERT_NEAR(arrow.groups[GROUPS - 1].x[0], 0.0, 1e-12, "");
    ASSERT_NEAR(arrow.groups[GROUPS - 1].variance[1], 0.25, 1e-12, "");
    arrow_free(&arrow);
}
END_TEST

/* Groups that each have an error of their own: the variance between them is what it scatters by. */
START_TEST(groups_that_contradict_each_other_widen_the_variance)
{
    enum { MANY = 400, READINGS = 10 };
    arrow_t arrow;
    srand(53);
    arrow_begin(&arrow, MANY);
    for (int k = 0; k < ARROW_COMMON; k++) {
        arrow_prior(&arrow, k, 0.0, k == 2 ? 1e3 : 1e-3);
    }
    for (size_t g = 0; g < MANY; g++) {
        double own_error = sqrt(3.0) * number(), zero[ARROW_OWN] = {0.0, 0.0};
        arrow_group_prior(&arrow, g, 0, 1.0);
        arrow_group_prior(&arrow, g, 1, 1.0);
        for (int i = 0; i < READINGS; i++) {
            const double common[ARROW_COMMON] = {0.0, 0.0, 1.0, 0.0, 0.0};
            arrow_add(&arrow, g, common, zero, 7.0 + own_error, 100.0);
        }
    }
    ck_assert(arrow_solve(&arrow));
    ASSERT_NEAR(arrow.x[2], 7.0, 4.0 / sqrt(MANY), "");
    ASSERT_NEAR(sqrt(arrow.P[2][2]), 0.1 / sqrt(MANY * READINGS), 1e-6, "");
    ASSERT_NEAR(sqrt(arrow.variance[2]), 1.0 / sqrt(MANY), 0.15 / sqrt(MANY), "");
    arrow_free(&arrow);
}
END_TEST

START_TEST(numbers_that_are_none_have_no_solution)
{
    arrow_t arrow;
    const double row[ARROW_COMMON] = {1.0, (double)NAN, 0.0, 0.0, 0.0}, own[ARROW_OWN] = {1.0, 0.0};
    arrow_begin(&arrow, 1u);
    for (int k = 0; k < ARROW_COMMON; k++) {
        arrow_prior(&arrow, k, 0.0, 1.0);
    }
    arrow_group_prior(&arrow, 0u, 0, 1.0);
    arrow_group_prior(&arrow, 0u, 1, 1.0);
    arrow_add(&arrow, 0u, row, own, 1.0, 1.0);
    ck_assert(!arrow_solve(&arrow));
    arrow_free(&arrow);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("host/arrow");
    suite_add(suite, "solution", solution_and_variances_are_those_of_the_dense_equations);
    suite_add(suite, "solution", a_group_nothing_is_known_of_keeps_its_prior);
    suite_add(suite, "variance", groups_that_contradict_each_other_widen_the_variance);
    suite_add(suite, "errors", numbers_that_are_none_have_no_solution);
    return suite;
}
