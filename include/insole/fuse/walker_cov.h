/** @file walker_cov.h  Covariance of a walker's six states, in factors that cannot lose its sign.
 *
 *  Source  Our own states; factors U D U' as Bierman and as Agee and Turner change them.
 *  Order   bias x y, position x y, and two that say how a way in n becomes one in m.
 *
 *      insole_walker_cov_t P = {{0}, {0}};
 *      insole_walker_cov_add_pair(&P, INSOLE_WALKER_X, cov_m2);
 *      on each step:
 *          insole_walker_cov_walk(&P, by_first, by_second);
 *          insole_walker_cov_add_pair(&P, INSOLE_WALKER_X, Q);
 *      on each number z = h' x + noise:
 *          K = insole_walker_cov_correct(&P, h, variance_of_noise);
 *
 *  P = U D U', U upper with ones on its diagonal, D diagonal. D only ever grows by sums and shrinks
 *  by quotients of what is not negative: P is positive, after rounding too, and float does what a
 *  covariance written out would need double for. In this order neither a walk nor a fading bias
 *  takes U out of its triangle: both touch a few numbers.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_WALKER_COV_H
#define INSOLE_FUSE_WALKER_COV_H

#include "insole/base/sym2.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Places of the states; each starts a pair. */
enum { INSOLE_WALKER_BIAS = 0, INSOLE_WALKER_X = 2, INSOLE_WALKER_TURN = 4 };
enum { INSOLE_WALKER_STATES = 6, INSOLE_WALKER_PAIRS = 15 };

typedef struct {
    insole_real_t D[INSOLE_WALKER_STATES];
    insole_real_t U[INSOLE_WALKER_PAIRS]; /**< above the diagonal, column by column */
} insole_walker_cov_t;

typedef struct {
    insole_real_t at[INSOLE_WALKER_STATES];
} insole_walker_column_t;

/** Zero but for the pair that starts at `place`. */
insole_walker_column_t insole_walker_column(int place, insole_spot_t pair);

/** P + weight v v'. @param weight >= 0 */
void insole_walker_cov_add(insole_walker_cov_t *P, insole_real_t weight, insole_walker_column_t v);

/** The position moves by `by_first` times the first of the last two states plus `by_second` times
 *  the second. */
void insole_walker_cov_walk(insole_walker_cov_t *P, insole_spot_t by_first,
                            insole_spot_t by_second);

/** The bias is multiplied by `left`. @param left 0 .. 1 */
void insole_walker_cov_fade(insole_walker_cov_t *P, insole_real_t left);

/** The last two states become T times themselves, T being the matrix with these rows.
 *  @param row_first, row_second  of a T that has an inverse */
void insole_walker_cov_turn(insole_walker_cov_t *P, insole_spot_t row_first,
                            insole_spot_t row_second);

/** The pair of states that starts at `place` gets a noise of covariance Q.
 *  @param Q  a covariance; what rounding leaves below zero counts as zero */
void insole_walker_cov_add_pair(insole_walker_cov_t *P, int place, insole_sym2_t Q);

/** Covariance of the two numbers hx' x and hy' x. */
insole_sym2_t insole_walker_cov_seen(const insole_walker_cov_t *P, const insole_walker_column_t *hx,
                                     const insole_walker_column_t *hy);

/** Covariance of the pair of states that starts at `place`. */
insole_sym2_t insole_walker_cov_pair(const insole_walker_cov_t *P, int place);

/** P after z = h' x + noise was seen.
 *  @param variance  of the noise; > 0
 *  @return the gain K, by which x becomes x + K (z - h' x) */
insole_walker_column_t insole_walker_cov_correct(insole_walker_cov_t *P,
                                                 const insole_walker_column_t *h,
                                                 insole_real_t variance);

#ifdef __cplusplus
}
#endif

#endif
