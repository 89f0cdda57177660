/** @file walker.h  A walker's filter, begun; its six states in double and dense, to hold the
 * factors against.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_WALKER_H
#define INSOLE_TESTS_WALKER_H

#include "dense.h"
#include "insole/fuse/walker_ekf.h"
#include "near.h"

enum { SIX = INSOLE_WALKER_STATES };

/** A filter that has started. */
static inline insole_walker_ekf_t walker_begun(const insole_walker_ekf_config_t *config,
                                               const insole_walker_start_t *start)
{
    insole_walker_ekf_t walker;
    memset(&walker, 0, sizeof walker);
    ck_assert_int_eq(insole_walker_ekf_init(&walker, config), INSOLE_OK);
    ck_assert_int_eq(insole_walker_ekf_start(&walker, start), INSOLE_OK);
    return walker;
}

/** U D U', by its definition; zeros beyond the six states. */
static inline dense_t walker_dense(const insole_walker_cov_t *P)
{
    dense_t U = dense_diagonal(1.0), D = dense_diagonal(0.0);
    int next = 0;
    for (int j = 0; j < SIX; j++) {
        D.at[j][j] = (double)P->D[j];
        for (int i = 0; i < j; i++) {
            U.at[i][j] = (double)P->U[next++];
        }
    }
    return dense_congruent(&U, &D);
}

static inline column_t walker_wide(const insole_walker_column_t *v)
{
    column_t x;
    for (int i = 0; i < DENSE; i++) {
        x.at[i] = i < SIX ? (double)v->at[i] : 0.0;
    }
    return x;
}

/** S + w v v' */
static inline dense_t walker_outer(dense_t S, double w, const column_t *v)
{
    for (int i = 0; i < DENSE; i++) {
        for (int j = 0; j < DENSE; j++) {
            S.at[i][j] += w * v->at[i] * v->at[j];
        }
    }
    return S;
}

/** P after z = h' x + noise, by the book: (I - K h') P (I - K h')' + r K K'. */
static inline column_t walker_book(dense_t *P, const column_t *h, double r)
{
    column_t K = dense_apply(P, h);
    double S = r;
    for (int i = 0; i < SIX; i++) {
        S += h->at[i] * K.at[i];
    }
    dense_t A = dense_diagonal(1.0);
    for (int i = 0; i < DENSE; i++) {
        K.at[i] /= S;
        for (int j = 0; j < DENSE; j++) {
            A.at[i][j] -= K.at[i] * h->at[j];
        }
    }
    *P = walker_outer(dense_congruent(&A, P), r, &K);
    return K;
}

/** Largest difference of the six states' covariances, in units of their 1-sigmas. */
static inline double walker_off(const dense_t *a, const insole_walker_cov_t *P)
{
    dense_t b = walker_dense(P);
    double worst = 0.0;
    for (int i = 0; i < SIX; i++) {
        for (int j = 0; j < SIX; j++) {
            double unit = sqrt(a->at[i][i] * a->at[j][j]) + 1e-30;
            double off = fabs(a->at[i][j] - b.at[i][j]) / unit;
            worst = off <= worst ? worst : off;
        }
    }
    return worst;
}

/** Every number of D and U finite, nothing of D below zero. */
static inline int walker_is_sane(const insole_walker_cov_t *P)
{
    int sane = 1;
    for (int i = 0; i < INSOLE_WALKER_PAIRS; i++) {
        sane &= insole_is_finite(P->U[i]);
    }
    for (int i = 0; i < SIX; i++) {
        sane &= insole_is_finite(P->D[i]) && P->D[i] >= INSOLE_R(0.0);
    }
    return sane;
}

#endif
