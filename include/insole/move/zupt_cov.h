/** @file zupt_cov.h  Covariance of the errors of inertial navigation, in its 3x3 blocks.
 *
 *  Source  [TwoOrder] 3.1, eqs. 18-26, with the slips of the paper mended.
 *  Frames  p v a in n (local level, z up), b in the sensor's own.
 *  Errors  dx = [dp dv da db]: position, velocity, attitude with R_true = (I + [da]x) R, and the
 *          accelerometer's bias. With nine states the blocks of b are zero and not computed.
 *
 *      insole_zupt_interval_add(&interval, force_dt_mps, &C, dt_s, true);  on each sample
 *      insole_zupt_cov_propagate(&P, &interval, true);                     for some of them at once
 *      dx = insole_zupt_cov_correct_velocity(&P, W, r, z, true);
 *
 *  What the filter and the smoother share; nothing is checked here. Over a sample the velocity's
 *  error changes, v' = v - U a + G b with U = [f dt]x and G = -C dt, and that of the position grows
 *  by the mean of the velocity's before and after: p' = p + dt (v + v') / 2. Of several samples
 *
 *      Phi = [I I.T -S G.T/2; 0 I -U G; 0 0 I 0; 0 0 0 I]
 *
 *  is their product, but for the way in which the bias reaches the position: as if it had acted
 *  evenly. Nothing that is zero in it is multiplied.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_ZUPT_COV_H
#define INSOLE_MOVE_ZUPT_COV_H

#include "insole/base/mat.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A firmware that never estimates the accelerometer's bias may set 9 when it compiles the library,
 *  and then itself: nothing of the bias remains in state and code, and there is no smoother. */
#ifndef INSOLE_ZUPT_STATES
#define INSOLE_ZUPT_STATES 12
#endif
#if INSOLE_ZUPT_STATES != 9 && INSOLE_ZUPT_STATES != 12
#error "INSOLE_ZUPT_STATES is 9 or 12"
#endif

/** Covariance of dx: p position, v velocity, a attitude, b accelerometer bias. */
typedef struct {
    insole_sym3_t pp, vv, aa;
    insole_mat3_t pv, pa, va;
#if INSOLE_ZUPT_STATES == 12
    insole_sym3_t bb;
    insole_mat3_t pb, vb, ab;
#endif
} insole_zupt_cov_t;

/** An error of the state, or a column of its covariance. */
typedef struct {
    insole_vec3_t p, v, a, b;
} insole_zupt_error_t;

/** Phi of one sample, or of several in a row; of none when all is zero. */
typedef struct {
    insole_real_t time_s;
    insole_vec3_t u_mps; /**< U: integral of the specific force, n */
    insole_vec3_t s_m;   /**< S: integral of that */
#if INSOLE_ZUPT_STATES == 12
    insole_mat3_t G_s; /**< G: minus the integral of the rotation from b to n */
#endif
} insole_zupt_interval_t;

/** One more sample.
 *  @param u  specific force in n times dt_s
 *  @param C  rotation from b to n */
static inline void insole_zupt_interval_add(insole_zupt_interval_t *interval, insole_vec3_t u,
                                            const insole_mat3_t *C, insole_real_t dt_s,
                                            bool has_bias)
{
    insole_vec3_t middle = insole_vec3_add_scaled(interval->u_mps, INSOLE_R(0.5), u);
    interval->s_m = insole_vec3_add_scaled(interval->s_m, dt_s, middle);
    interval->u_mps = insole_vec3_add(interval->u_mps, u);
    interval->time_s += dt_s;
#if INSOLE_ZUPT_STATES == 12
    if (has_bias) {
        interval->G_s = insole_mat3_add_scaled(interval->G_s, -dt_s, *C);
    }
#else
    (void)C, (void)has_bias;
#endif
}

/** Phi P Phi' over an interval. */
void insole_zupt_cov_propagate(insole_zupt_cov_t *P, const insole_zupt_interval_t *interval,
                               bool has_bias);

/** P H' w with H = [0 I 0 0]: what a measurement of the velocity tells of all. */
insole_zupt_error_t insole_zupt_cov_of_velocity(const insole_zupt_cov_t *P, insole_vec3_t w);

/** What is known of the velocity, and all that it told, is known no more: rows of v, and p by a. */
void insole_zupt_cov_forget_motion(insole_zupt_cov_t *P);

/** Errors of the position are counted from here: without the rest of its row nothing that is
 *  learned later speaks of the way before. */
void insole_zupt_cov_forget_place(insole_zupt_cov_t *P);

/** Yaw is known from now on: nothing that is learned later speaks of its error before. */
void insole_zupt_cov_forget_yaw(insole_zupt_cov_t *P);

/* The blocks of the bias, once those of p, v and a are corrected. Not with nine states.
 * @return K z of the bias */
insole_vec3_t insole_zupt_cov_correct_bias(insole_zupt_cov_t *P, const insole_sym3_t *W,
                                           insole_real_t r, insole_vec3_t z);

/** (I - K H) P for a measurement of the velocity.
 *  @param W  inverse of the innovation's covariance, (P_vv + r I)^-1
 *  @param r  variance of the measurement on each axis
 *  @param z  innovation
 *  @return   K z, what it tells of the error; none of the bias without `has_bias` */
static inline insole_zupt_error_t insole_zupt_cov_correct_velocity(insole_zupt_cov_t *P,
                                                                   insole_sym3_t W, insole_real_t r,
                                                                   insole_vec3_t z, bool has_bias)
{
    /* In closed blocks, for R = r I: P_xv+ = r K_x and P_xy+ = P_xy - K_x P_vy. In the row of v no
     * difference is formed. */
    const insole_real_t minus = INSOLE_R(-1.0);
    insole_zupt_error_t dx;
    insole_mat3_t pv = P->pv, K_p = insole_mat3_mul_sym(pv, W); /* [TwoOrder (25)] */
    P->pp = insole_sym3_add_scaled(P->pp, minus, insole_mat3_mul_t_sym(K_p, pv));
    P->pa = insole_mat3_sub(P->pa, insole_mat3_mul(K_p, P->va)); /* [TwoOrder (26)] */
    dx.p = insole_mat3_mul_vec(K_p, z);
    P->pv = insole_mat3_scale(K_p, r);

    insole_mat3_t av = insole_mat3_transpose(P->va), K_a = insole_mat3_mul_sym(av, W);
    P->aa = insole_sym3_add_scaled(P->aa, minus, insole_mat3_mul_t_sym(K_a, av));
    dx.a = insole_mat3_mul_vec(K_a, z);
    P->va = insole_mat3_scale(insole_mat3_transpose(K_a), r);

    insole_sym3_t K_v = insole_mat3_mul_t_sym(insole_sym3_full(P->vv), insole_sym3_full(W));
    dx.v = insole_sym3_mul_vec(K_v, z);
    P->vv = insole_sym3_scale(K_v, r);

    dx.b = insole_vec3_zero();
#if INSOLE_ZUPT_STATES == 12
    if (has_bias) {
        const insole_sym3_t kept = W; /* else W would be in memory all the time */
        dx.b = insole_zupt_cov_correct_bias(P, &kept, r, z);
    }
#else
    (void)has_bias;
#endif
    return dx;
}

/** The column of P that belongs to the height: P h' with h = e_z of p. */
insole_zupt_error_t insole_zupt_cov_of_height(const insole_zupt_cov_t *P);

/** (I - k h) P for a measurement of the height with variance `r`. */
void insole_zupt_cov_correct_height(insole_zupt_cov_t *P, insole_real_t r);

/** P x; not with nine states. */
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
