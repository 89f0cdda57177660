/** @file unscented.h  Unscented transform: mean and covariance through a curved function.
 *
 *  Source  [PhoneUKF] 5.2.2, eqs. (14)-(17), for up to nine dimensions.
 *  Arrays  row by row: points[i * n + k], A[r * n + c].
 *
 *      insole_unscented_t ut = insole_unscented(n, 1, 2, 0);
 *      insole_cholesky(n, P, root);
 *      insole_unscented_points(&ut, mean, root, points);
 *      for each of the 2 n + 1 points: values[i * m ...] = f(points + i * n)
 *      insole_unscented_mean(&ut, m, values, value);
 *      insole_unscented_cov(&ut, m, values, value, m, values, value, P_value);
 *      insole_unscented_cov(&ut, n, points, mean, m, values, value, P_cross);
 *
 *  The paper's alpha is small. In single precision it must not be: the weights grow as
 *  1 / alpha^2 and cancel. With alpha 1, beta 2, kappa 0 no weight is negative, and no covariance
 *  can lose its sign.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_UNSCENTED_H
#define INSOLE_BASE_UNSCENTED_H

#include "insole/base/real.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_UNSCENTED_MOST = 9 /**< dimensions */ };

typedef struct {
    uint32_t n;                /**< dimensions */
    insole_real_t spread;      /**< of the points, in columns of the root */
    insole_real_t mean0, cov0; /**< weight of the middle in means and in covariances */
    insole_real_t weight;      /**< of each other point in both */
} insole_unscented_t;

/** Weights. @param n 1 to 9  @param alpha > 0; alpha^2 (n + kappa) > 0 */
static inline insole_unscented_t insole_unscented(uint32_t n, insole_real_t alpha,
                                                  insole_real_t beta, insole_real_t kappa)
{
    insole_real_t size = (insole_real_t)n, one = INSOLE_R(1.0);
    insole_real_t reach = alpha * alpha * (size + kappa); /* L + lambda [PhoneUKF (15)] */
    insole_real_t mean0 = (reach - size) / reach;
    insole_unscented_t ut = {n, insole_sqrt(reach), mean0, mean0 + one - alpha * alpha + beta,
                             INSOLE_R(0.5) / reach};
    return ut;
}

/** Lower root of a symmetric matrix: A = root root'. A pivot that is not positive, within
 *  rounding, counts as zero and so does its column: the answer then is the root of the nearest
 *  matrix that elimination finds, and of A itself when A is only singular.
 *  @param A     n x n, the lower triangle is read
 *  @param root  n x n, zeros above the diagonal
 *  @return false when a pivot counted as zero */
bool insole_cholesky(uint32_t n, const insole_real_t *A, insole_real_t *root);

/** Sigma points: the mean, then mean + columns, then mean - columns.
 *  @param points  2 n + 1 rows of n */
void insole_unscented_points(const insole_unscented_t *ut, const insole_real_t *mean,
                             const insole_real_t *root, insole_real_t *points);

/** Weighted mean of 2 n + 1 rows of m values. */
void insole_unscented_mean(const insole_unscented_t *ut, uint32_t m, const insole_real_t *values,
                           insole_real_t *mean);

/** Weighted covariance of rows of `ma` values about `mean_a` with rows of `mb` about `mean_b`.
 *  @param cov  ma x mb */
void insole_unscented_cov(const insole_unscented_t *ut, uint32_t ma, const insole_real_t *a,
                          const insole_real_t *mean_a, uint32_t mb, const insole_real_t *b,
                          const insole_real_t *mean_b, insole_real_t *cov);

#ifdef __cplusplus
}
#endif

#endif
