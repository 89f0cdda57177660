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

/* Phi = [I I.dt 0 0; 0 I -U G; 0 0 I 0; 0 0 0 I], U = [u]x, G = -C dt. */
typedef struct {
    insole_vec3_t u;
    insole_mat3_t G;
    insole_real_t dt;
    bool has_bias; /* known when this is compiled: nothing of b is computed without it */
} insole_zupt_phi_t;

/* What the velocity gains, -U a + G b, with something whose covariances with a and b are given. */
static inline insole_vec3_t insole_zupt_phi_gain(const insole_zupt_phi_t *phi, insole_vec3_t a,
                                                 insole_vec3_t b)
{
    insole_vec3_t turned = insole_vec3_cross(a, phi->u);
    return phi->has_bias ? insole_vec3_add(turned, insole_mat3_mul_vec(phi->G, b)) : turned;
}

/* A row of p' = p + v dt, given that of v. @return the row of p' and v, before v gains */
static inline insole_vec3_t insole_zupt_phi_move_row(const insole_zupt_phi_t *phi,
                                                     insole_vec3_t *pv, insole_vec3_t *pa,
                                                     insole_vec3_t *pb, insole_vec3_t vv,
                                                     insole_vec3_t va, insole_vec3_t vb)
{
    insole_vec3_t moved = insole_vec3_add_scaled(*pv, phi->dt, vv);
    *pa = insole_vec3_add_scaled(*pa, phi->dt, va);
    if (phi->has_bias) {
        *pb = insole_vec3_add_scaled(*pb, phi->dt, vb);
    }
    *pv = insole_vec3_add(moved, insole_zupt_phi_gain(phi, *pa, *pb));
    return moved;
}

/* The rows of p; a symmetric entry takes one half from the old and one from the new column. */
static inline void insole_zupt_phi_move_rows(const insole_zupt_phi_t *phi, insole_zupt_cov_t *P)
{
    insole_sym3_t *pp = &P->pp, vv = P->vv;
    insole_real_t yx = P->pv.r1.x, zx = P->pv.r2.x, zy = P->pv.r2.y, dt = phi->dt;
    insole_real_t xx = P->pv.r0.x, yy = P->pv.r1.y, zz = P->pv.r2.z;
    insole_vec3_t x = insole_zupt_phi_move_row(
        phi, &P->pv.r0, &P->pa.r0, &P->pb.r0, insole_vec3(vv.xx, vv.xy, vv.xz), P->va.r0, P->vb.r0);
    pp->xx += dt * (x.x + xx);
    pp->xy += dt * (x.y + yx);
    pp->xz += dt * (x.z + zx);
    insole_vec3_t y = insole_zupt_phi_move_row(
        phi, &P->pv.r1, &P->pa.r1, &P->pb.r1, insole_vec3(vv.xy, vv.yy, vv.yz), P->va.r1, P->vb.r1);
    pp->yy += dt * (y.y + yy);
    pp->yz += dt * (y.z + zy);
    insole_vec3_t z = insole_zupt_phi_move_row(
        phi, &P->pv.r2, &P->pa.r2, &P->pb.r2, insole_vec3(vv.xz, vv.yz, vv.zz), P->va.r2, P->vb.r2);
    pp->zz += dt * (z.z + zz);
}

/* The rows of v' = v - U a + G b. */
static inline void insole_zupt_phi_gain_rows(const insole_zupt_phi_t *phi, insole_zupt_cov_t *P)
{
    insole_sym3_t *vv = &P->vv;
    const insole_mat3_t *a = &P->va, *b = &P->vb;
    insole_mat3_t U_aa = insole_mat3_skew_mul(phi->u, insole_sym3_full(P->aa));
    insole_mat3_t va = insole_mat3_sub(P->va, U_aa), vb = P->vb;
    if (phi->has_bias) {
        va = insole_mat3_add(va, insole_mat3_mul_t(phi->G, P->ab));
        vb = insole_mat3_sub(vb, insole_mat3_skew_mul(phi->u, P->ab));
        vb = insole_mat3_add(vb, insole_mat3_mul_sym(phi->G, P->bb));
    }
    vv->xx +=
        insole_zupt_phi_gain(phi, insole_vec3_add(va.r0, a->r0), insole_vec3_add(vb.r0, b->r0)).x;
    vv->xy += insole_zupt_phi_gain(phi, va.r0, vb.r0).y + insole_zupt_phi_gain(phi, a->r1, b->r1).x;
    vv->xz += insole_zupt_phi_gain(phi, va.r0, vb.r0).z + insole_zupt_phi_gain(phi, a->r2, b->r2).x;
    vv->yy +=
        insole_zupt_phi_gain(phi, insole_vec3_add(va.r1, a->r1), insole_vec3_add(vb.r1, b->r1)).y;
    vv->yz += insole_zupt_phi_gain(phi, va.r1, vb.r1).z + insole_zupt_phi_gain(phi, a->r2, b->r2).y;
    vv->zz +=
        insole_zupt_phi_gain(phi, insole_vec3_add(va.r2, a->r2), insole_vec3_add(vb.r2, b->r2)).z;
    P->va = va;
    if (phi->has_bias) {
        P->vb = vb;
    }
}

/** Phi P Phi' over an interval.
 *  @param u  specific force in n times dt_s
 *  @param C  rotation from b to n */
static inline void insole_zupt_cov_propagate(insole_zupt_cov_t *P, insole_vec3_t u,
                                             const insole_mat3_t *C, insole_real_t dt_s,
                                             bool has_bias)
{
    if (has_bias) { /* [TwoOrder (20)-(21)], [TwoOrder (24)] */
        insole_zupt_phi_t phi = {u, insole_mat3_scale(*C, -dt_s), dt_s, true};
        insole_zupt_phi_move_rows(&phi, P);
        insole_zupt_phi_gain_rows(&phi, P);
    } else {
        insole_zupt_phi_t phi = {u, insole_mat3_zero(), dt_s, false};
        insole_zupt_phi_move_rows(&phi, P);
        insole_zupt_phi_gain_rows(&phi, P);
    }
}

/** P H' w with H = [0 I 0 0]: what a measurement of the velocity tells of all. */
insole_zupt_error_t insole_zupt_cov_of_velocity(const insole_zupt_cov_t *P, insole_vec3_t w);

/** (I - K H) P for a measurement of the velocity.
 *  @param W  inverse of the innovation's covariance, (P_vv + r I)^-1
 *  @param r  variance of the measurement on each axis
 *  @param z  innovation
 *  @return   K z, what it tells of the error; none of the bias without `has_bias` */
/* In closed blocks, for R = r I: P_xv+ = r K_x and P_xy+ = P_xy - K_x P_vy. In the row of v no
 * difference is formed. */
static inline insole_zupt_error_t insole_zupt_cov_correct_velocity(insole_zupt_cov_t *P,
                                                                   insole_sym3_t W, insole_real_t r,
                                                                   insole_vec3_t z, bool has_bias)
{
    const insole_real_t minus = INSOLE_R(-1.0);
    insole_zupt_error_t dx;
    insole_mat3_t pv = P->pv, K_p = insole_mat3_mul_sym(pv, W); /* [TwoOrder (25)] */
    P->pp = insole_sym3_add_scaled(P->pp, minus, insole_mat3_mul_t_sym(K_p, pv));
    P->pa = insole_mat3_sub(P->pa, insole_mat3_mul(K_p, P->va)); /* [TwoOrder (26)] */
    if (has_bias) {
        P->pb = insole_mat3_sub(P->pb, insole_mat3_mul(K_p, P->vb));
    }
    dx.p = insole_mat3_mul_vec(K_p, z);
    P->pv = insole_mat3_scale(K_p, r);

    insole_mat3_t av = insole_mat3_transpose(P->va), K_a = insole_mat3_mul_sym(av, W);
    P->aa = insole_sym3_add_scaled(P->aa, minus, insole_mat3_mul_t_sym(K_a, av));
    if (has_bias) {
        P->ab = insole_mat3_sub(P->ab, insole_mat3_mul(K_a, P->vb));
    }
    dx.a = insole_mat3_mul_vec(K_a, z);
    P->va = insole_mat3_scale(insole_mat3_transpose(K_a), r);

    dx.b = insole_vec3_zero();
    if (has_bias) {
        insole_mat3_t bv = insole_mat3_transpose(P->vb), K_b = insole_mat3_mul_sym(bv, W);
        P->bb = insole_sym3_add_scaled(P->bb, minus, insole_mat3_mul_t_sym(K_b, bv));
        dx.b = insole_mat3_mul_vec(K_b, z);
        P->vb = insole_mat3_scale(insole_mat3_transpose(K_b), r);
    }
    insole_sym3_t K_v = insole_mat3_mul_t_sym(insole_sym3_full(P->vv), insole_sym3_full(W));
    dx.v = insole_sym3_mul_vec(K_v, z);
    P->vv = insole_sym3_scale(K_v, r);
    return dx;
}

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
