/** @file arrow.h  Least squares over some common unknowns and two more for each of many groups.
 *
 *  The normal equations have the shape of an arrow: groups meet the common unknowns only. Each
 *  group is eliminated by itself, so that the work grows with the number of groups, not its cube.
 *
 *      arrow_t arrow = arrow_begin(5, groups);
 *      arrow_prior(&arrow, k, value, sigma), arrow_group_prior(&arrow, g, k, sigma)
 *      for each row:  arrow_add(&arrow, group, common, own, value, weight);
 *      arrow_solve(&arrow);                    x, own, and their variances
 *      arrow_free(&arrow);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_ARROW_H
#define INSOLE_HOST_ARROW_H

#include <stdbool.h>
#include <stddef.h>

enum { ARROW_COMMON = 5, ARROW_OWN = 2 };

/** The equations and unknowns of one group; the first two common unknowns are what they deviate
 * from. */
typedef struct {
    double A[ARROW_COMMON][ARROW_COMMON]; /**< information about the common unknowns */
    double common_pull[ARROW_COMMON];
    double B[ARROW_OWN][ARROW_OWN];    /**< about its own */
    double C[ARROW_COMMON][ARROW_OWN]; /**< about both */
    double pull[ARROW_OWN];
    double x[ARROW_OWN];            /**< solution */
    double variance[ARROW_OWN];     /**< of it */
    double sum_variance[ARROW_OWN]; /**< of it and the common unknown of the same number together */
} arrow_group_t;

typedef struct {
    double A[ARROW_COMMON][ARROW_COMMON];
    double pull[ARROW_COMMON];
    double x[ARROW_COMMON];               /**< solution */
    double P[ARROW_COMMON][ARROW_COMMON]; /**< covariance of it */
    double variance[ARROW_COMMON]; /**< as the groups contradict each other: of any kind of error
                                        that is a group's own */
    arrow_group_t *groups;
    size_t count;
} arrow_t;

void arrow_begin(arrow_t *arrow, size_t groups);

/** A common unknown is known to be `value`, 1-sigma. */
void arrow_prior(arrow_t *arrow, int k, double value, double sigma);

/** An unknown of a group is known to be near 0, 1-sigma. */
void arrow_group_prior(arrow_t *arrow, size_t group, int k, double sigma);

/** Adds `value = common' x + own' x_group` with this weight, 1 / variance. */
void arrow_add(arrow_t *arrow, size_t group, const double common[ARROW_COMMON],
               const double own[ARROW_OWN], double value, double weight);

/** Every unknown must have a prior.
 *  @return false when the equations have no solution in finite numbers */
bool arrow_solve(arrow_t *arrow);

void arrow_free(arrow_t *arrow);

#endif
