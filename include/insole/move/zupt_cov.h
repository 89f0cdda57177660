/** @file zupt_cov.h  Covariance of the errors of inertial navigation, in its 3x3 blocks.
 *
 *  Source  [TwoOrder] 3.1, eqs. 18-26, with the slips of the paper mended.
 *  Frames  p v a in n (local level, z up), b in the sensor's own.
 *  Errors  dx = [dp dv da db]: position, velocity, attitude with R_true = (I + [da]x) R, and the
 *          accelerometer's bias. With nine states the blocks of b are zero and not computed.
 *
 *      insole_zupt_cov_propagate(&P, force_dt_mps, C, dt_s, true);
 *      dx = insole_zupt_cov_correct_velocity(&P, W, r, z, true);
 *
 *  What the filter and the smoother share; nothing is checked here. Nothing that is zero in
 *  Phi = [I I.dt 0 0; 0 I -U G; 0 0 I 0; 0 0 0 I] is multiplied: U = [f dt]x and G = -C dt.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_ZUPT_COV_H
#define INSOLE_MOVE_ZUPT_COV_H

#include "insole/base/mat.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Covariance of dx: p position, v velocity, a attitude, b accelerometer bias. */
typedef struct {
    insole_sym3_t pp, vv, aa, bb;
    insole_mat3_t pv, pa, va;
    insole_mat3_t pb, vb, ab;
} insole_zupt_cov_t;

/** An error of the state, or a column of its covariance. */
typedef struct {
    insole_vec3_t p, v, a, b;
} insole_zupt_error_t;

/** Phi P Phi' over an interval.
 *  @param u  specific force in n times dt_s
 *  @param C  rotation from b to n */
void insole_zupt_cov_propagate(insole_zupt_cov_t *P, insole_vec3_t u, const insole_mat3_t *C,
                               insole_real_t dt_s, bool has_bias);

/** P H' w with H = [0 I 0 0]: what a measurement of the velocity tells of all. */
insole_zupt_error_t insole_zupt_cov_of_velocity(const insole_zupt_cov_t *P, insole_vec3_t w);

/** (I - K H) P for a measurement of the velocity.
 *  @param W  inverse of the innovation's covariance, (P_vv + r I)^-1
 *  @param r  variance of the measurement on each axis
 *  @param z  innovation
 *  @return   K z, what it tells of the error; none of the bias without `has_bias` */
insole_zupt_error_t insole_zupt_cov_correct_velocity(insole_zupt_cov_t *P, insole_sym3_t W,
                                                     insole_real_t r, insole_vec3_t z,
                                                     bool has_bias);

/** The column of P that belongs to the height: P h' with h = e_z of p. */
insole_zupt_error_t insole_zupt_cov_of_height(const insole_zupt_cov_t *P);

/** (I - k h) P for a measurement of the height with variance `r`. */
void insole_zupt_cov_correct_height(insole_zupt_cov_t *P, insole_real_t r);

/** P x */
insole_zupt_error_t insole_zupt_cov_mul(const insole_zupt_cov_t *P, const insole_zupt_error_t *x);

static inline insole_zupt_error_t insole_zupt_error_scale(insole_zupt_error_t x, insole_real_t s)
{
    insole_zupt_error_t y = {insole_vec3_scale(x.p, s), insole_vec3_scale(x.v, s),
                             insole_vec3_scale(x.a, s), insole_vec3_scale(x.b, s)};
    return y;
}

#ifdef __cplusplus
}
#endif

#endif
