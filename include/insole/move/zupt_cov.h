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

/* A row of p' = p + v dt and v' = v - U a, given that of v. @return the row of p' and v, not v' */
static inline insole_vec3_t insole_zupt_move_row(insole_vec3_t *pv, insole_vec3_t *pa,
                                                 insole_vec3_t vv, insole_vec3_t va,
                                                 insole_vec3_t u, insole_real_t dt)
{
    insole_vec3_t moved = insole_vec3_add_scaled(*pv, dt, vv);
    *pa = insole_vec3_add_scaled(*pa, dt, va);
    *pv = insole_vec3_add(moved, insole_vec3_cross(*pa, u));
    return moved;
}

/* The rows of p; a symmetric entry takes one half from the old and one from the new column. */
static inline void insole_zupt_move_rows(insole_zupt_cov_t *P, insole_vec3_t u, insole_real_t dt)
{
    insole_sym3_t *pp = &P->pp, vv = P->vv;
    insole_mat3_t *pv = &P->pv, *pa = &P->pa, *va = &P->va;
    insole_real_t yx = pv->r1.x, zx = pv->r2.x, zy = pv->r2.y;
    insole_real_t xx = pv->r0.x, yy = pv->r1.y, zz = pv->r2.z;
    insole_vec3_t x =
        insole_zupt_move_row(&pv->r0, &pa->r0, insole_vec3(vv.xx, vv.xy, vv.xz), va->r0, u, dt);
    pp->xx += dt * (x.x + xx);
    pp->xy += dt * (x.y + yx);
    pp->xz += dt * (x.z + zx);
    insole_vec3_t y =
        insole_zupt_move_row(&pv->r1, &pa->r1, insole_vec3(vv.xy, vv.yy, vv.yz), va->r1, u, dt);
    pp->yy += dt * (y.y + yy);
    pp->yz += dt * (y.z + zy);
    insole_vec3_t z =
        insole_zupt_move_row(&pv->r2, &pa->r2, insole_vec3(vv.xz, vv.yz, vv.zz), va->r2, u, dt);
    pp->zz += dt * (z.z + zz);
}

/* The rows of v' = v - U a: a row r of P_va gives r x u to that of P_vv, one half the old and one
 * the new row; in an entry off the diagonal the two have u in common. */
static inline void insole_zupt_turn_rows(insole_zupt_cov_t *P, insole_vec3_t u)
{
    insole_sym3_t *vv = &P->vv;
    insole_mat3_t was = P->va;
    insole_mat3_t va = insole_mat3_sub(was, insole_mat3_skew_mul(u, insole_sym3_full(P->aa)));
    vv->xx += insole_vec3_cross(insole_vec3_add(va.r0, was.r0), u).x;
    vv->xy += u.x * va.r0.z - u.y * was.r1.z + u.z * (was.r1.y - va.r0.x);
    vv->xz += u.z * was.r2.y - u.x * va.r0.y + u.y * (va.r0.x - was.r2.z);
    vv->yy += insole_vec3_cross(insole_vec3_add(va.r1, was.r1), u).y;
    vv->yz += u.y * va.r1.x - u.z * was.r2.x + u.x * (was.r2.z - va.r1.y);
    vv->zz += insole_vec3_cross(insole_vec3_add(va.r2, was.r2), u).z;
    P->va = va;
}

/* What the bias adds afterwards: v' = v - U a + G b. Not with nine states. */
void insole_zupt_cov_propagate_bias(insole_zupt_cov_t *P, insole_vec3_t u, const insole_mat3_t *C,
                                    insole_real_t dt_s);

/** Phi P Phi' over an interval.
 *  @param u  specific force in n times dt_s
 *  @param C  rotation from b to n */
static inline void insole_zupt_cov_propagate(insole_zupt_cov_t *P, insole_vec3_t u,
                                             const insole_mat3_t *C, insole_real_t dt_s,
                                             bool has_bias)
{
    insole_zupt_move_rows(P, u, dt_s); /* [TwoOrder (20)-(21)], [TwoOrder (24)] */
    insole_zupt_turn_rows(P, u);
#if INSOLE_ZUPT_STATES == 12
    if (has_bias) {
        insole_zupt_cov_propagate_bias(P, u, C, dt_s);
    }
#else
    (void)C, (void)has_bias;
#endif
}

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
