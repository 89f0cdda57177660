/* SPDX-License-Identifier: MIT */
#include "insole/move/zupt_cov.h"

/* Phi = [I I.dt 0 0; 0 I -U G; 0 0 I 0; 0 0 0 I], U = [u]x, G = -C dt. */
typedef struct {
    insole_vec3_t u;
    insole_mat3_t G;
    insole_real_t dt;
    bool has_bias; /* known when this is compiled: nothing of b is computed without it */
} phi_t;

/* What the velocity gains, -U a + G b, with something whose covariances with a and b are given. */
static inline insole_vec3_t gain(const phi_t *phi, insole_vec3_t a, insole_vec3_t b)
{
    insole_vec3_t turned = insole_vec3_cross(a, phi->u);
    return phi->has_bias ? insole_vec3_add(turned, insole_mat3_mul_vec(phi->G, b)) : turned;
}

/* A row of p' = p + v dt, given that of v. @return the row of p' and v, before v gains */
static inline insole_vec3_t move_row(const phi_t *phi, insole_vec3_t *pv, insole_vec3_t *pa,
                                     insole_vec3_t *pb, insole_vec3_t vv, insole_vec3_t va,
                                     insole_vec3_t vb)
{
    insole_vec3_t moved = insole_vec3_add_scaled(*pv, phi->dt, vv);
    *pa = insole_vec3_add_scaled(*pa, phi->dt, va);
    if (phi->has_bias) {
        *pb = insole_vec3_add_scaled(*pb, phi->dt, vb);
    }
    *pv = insole_vec3_add(moved, gain(phi, *pa, *pb));
    return moved;
}

/* The rows of p; a symmetric entry takes one half from the old and one from the new column. */
static inline void move_rows(const phi_t *phi, insole_zupt_cov_t *P)
{
    insole_sym3_t *pp = &P->pp, vv = P->vv;
    insole_real_t yx = P->pv.r1.x, zx = P->pv.r2.x, zy = P->pv.r2.y, dt = phi->dt;
    insole_real_t xx = P->pv.r0.x, yy = P->pv.r1.y, zz = P->pv.r2.z;
    insole_vec3_t x = move_row(phi, &P->pv.r0, &P->pa.r0, &P->pb.r0,
                               insole_vec3(vv.xx, vv.xy, vv.xz), P->va.r0, P->vb.r0);
    pp->xx += dt * (x.x + xx);
    pp->xy += dt * (x.y + yx);
    pp->xz += dt * (x.z + zx);
    insole_vec3_t y = move_row(phi, &P->pv.r1, &P->pa.r1, &P->pb.r1,
                               insole_vec3(vv.xy, vv.yy, vv.yz), P->va.r1, P->vb.r1);
    pp->yy += dt * (y.y + yy);
    pp->yz += dt * (y.z + zy);
    insole_vec3_t z = move_row(phi, &P->pv.r2, &P->pa.r2, &P->pb.r2,
                               insole_vec3(vv.xz, vv.yz, vv.zz), P->va.r2, P->vb.r2);
    pp->zz += dt * (z.z + zz);
}

/* The rows of v' = v - U a + G b. */
static inline void gain_rows(const phi_t *phi, insole_zupt_cov_t *P)
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
    vv->xx += gain(phi, insole_vec3_add(va.r0, a->r0), insole_vec3_add(vb.r0, b->r0)).x;
    vv->xy += gain(phi, va.r0, vb.r0).y + gain(phi, a->r1, b->r1).x;
    vv->xz += gain(phi, va.r0, vb.r0).z + gain(phi, a->r2, b->r2).x;
    vv->yy += gain(phi, insole_vec3_add(va.r1, a->r1), insole_vec3_add(vb.r1, b->r1)).y;
    vv->yz += gain(phi, va.r1, vb.r1).z + gain(phi, a->r2, b->r2).y;
    vv->zz += gain(phi, insole_vec3_add(va.r2, a->r2), insole_vec3_add(vb.r2, b->r2)).z;
    P->va = va;
    if (phi->has_bias) {
        P->vb = vb;
    }
}

INSOLE_FLAT void insole_zupt_cov_propagate(insole_zupt_cov_t *P, insole_vec3_t u,
                                           const insole_mat3_t *C, insole_real_t dt_s,
                                           bool has_bias)
{
    if (has_bias) { /* [TwoOrder (20)-(21)], [TwoOrder (24)] */
        phi_t phi = {u, insole_mat3_scale(*C, -dt_s), dt_s, true};
        move_rows(&phi, P);
        gain_rows(&phi, P);
    } else {
        phi_t phi = {u, insole_mat3_zero(), dt_s, false};
        move_rows(&phi, P);
        gain_rows(&phi, P);
    }
}

insole_zupt_error_t insole_zupt_cov_of_velocity(const insole_zupt_cov_t *P, insole_vec3_t w)
{
    insole_zupt_error_t x = {insole_mat3_mul_vec(P->pv, w), insole_sym3_mul_vec(P->vv, w),
                             insole_mat3_mul_vec_t(P->va, w), insole_mat3_mul_vec_t(P->vb, w)};
    return x;
}

/* In closed blocks, for R = r I: P_xv+ = r K_x and P_xy+ = P_xy - K_x P_vy. In the row of v no
 * difference is formed. */
INSOLE_FLAT insole_zupt_error_t insole_zupt_cov_correct_velocity(insole_zupt_cov_t *P,
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

insole_zupt_error_t insole_zupt_cov_of_height(const insole_zupt_cov_t *P)
{
    insole_zupt_error_t x = {insole_vec3(P->pp.xz, P->pp.yz, P->pp.zz), P->pv.r2, P->pa.r2,
                             P->pb.r2};
    return x;
}

static void subtract_outer(insole_zupt_cov_t *P, const insole_zupt_error_t *k, insole_real_t per_s)
{
    P->pp = insole_sym3_add_outer(P->pp, -per_s, k->p);
    P->vv = insole_sym3_add_outer(P->vv, -per_s, k->v);
    P->aa = insole_sym3_add_outer(P->aa, -per_s, k->a);
    P->bb = insole_sym3_add_outer(P->bb, -per_s, k->b);
    P->pv = insole_mat3_add_outer(P->pv, -per_s, k->p, k->v);
    P->pa = insole_mat3_add_outer(P->pa, -per_s, k->p, k->a);
    P->pb = insole_mat3_add_outer(P->pb, -per_s, k->p, k->b);
    P->va = insole_mat3_add_outer(P->va, -per_s, k->v, k->a);
    P->vb = insole_mat3_add_outer(P->vb, -per_s, k->v, k->b);
    P->ab = insole_mat3_add_outer(P->ab, -per_s, k->a, k->b);
}

/* The row of the height becomes r times the gain, again without a difference. */
void insole_zupt_cov_correct_height(insole_zupt_cov_t *P, insole_real_t r)
{
    insole_zupt_error_t column = insole_zupt_cov_of_height(P);
    insole_real_t per_s = INSOLE_R(1.0) / (P->pp.zz + r);
    subtract_outer(P, &column, per_s);
    insole_zupt_error_t row = insole_zupt_error_scale(column, r * per_s);
    P->pp.xz = row.p.x;
    P->pp.yz = row.p.y;
    P->pp.zz = row.p.z;
    P->pv.r2 = row.v;
    P->pa.r2 = row.a;
    P->pb.r2 = row.b;
}

insole_zupt_error_t insole_zupt_cov_mul(const insole_zupt_cov_t *P, const insole_zupt_error_t *x)
{
    insole_zupt_error_t y = insole_zupt_cov_of_velocity(P, x->v);
    y.p = insole_vec3_add(y.p, insole_sym3_mul_vec(P->pp, x->p));
    y.p = insole_vec3_add(y.p, insole_mat3_mul_vec(P->pa, x->a));
    y.p = insole_vec3_add(y.p, insole_mat3_mul_vec(P->pb, x->b));
    y.v = insole_vec3_add(y.v, insole_mat3_mul_vec_t(P->pv, x->p));
    y.v = insole_vec3_add(y.v, insole_mat3_mul_vec(P->va, x->a));
    y.v = insole_vec3_add(y.v, insole_mat3_mul_vec(P->vb, x->b));
    y.a = insole_vec3_add(y.a, insole_mat3_mul_vec_t(P->pa, x->p));
    y.a = insole_vec3_add(y.a, insole_sym3_mul_vec(P->aa, x->a));
    y.a = insole_vec3_add(y.a, insole_mat3_mul_vec(P->ab, x->b));
    y.b = insole_vec3_add(y.b, insole_mat3_mul_vec_t(P->pb, x->p));
    y.b = insole_vec3_add(y.b, insole_mat3_mul_vec_t(P->ab, x->a));
    y.b = insole_vec3_add(y.b, insole_sym3_mul_vec(P->bb, x->b));
    return y;
}
