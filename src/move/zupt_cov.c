/* SPDX-License-Identifier: MIT */
#include "insole/move/zupt_cov.h"

/* Phi P Phi' for p, v, a [TwoOrder (20)-(21)]: Phi = [I I.dt 0; 0 I -S.dt; 0 0 I], u = f dt.
 * Each line still needs the old values of the lines below it. */
static void propagate_nine(insole_zupt_cov_t *P, insole_vec3_t u, insole_real_t dt)
{
    insole_mat3_t va = insole_mat3_sub(P->va, insole_mat3_skew_mul(u, insole_sym3_full(P->aa)));
    insole_mat3_t va_middle = insole_mat3_scale(insole_mat3_add(P->va, va), INSOLE_R(0.5));
    P->pp = insole_sym3_add_scaled(insole_sym3_add_twice(P->pp, dt, P->pv), dt * dt, P->vv);
    P->pa = insole_mat3_add_scaled(P->pa, dt, P->va);
    P->pv = insole_mat3_add_scaled(P->pv, dt, insole_sym3_full(P->vv));
    P->pv = insole_mat3_add(P->pv, insole_mat3_mul_skew(P->pa, u));
    P->vv = insole_sym3_add_twice(P->vv, INSOLE_R(1.0), insole_mat3_mul_skew(va_middle, u));
    P->va = va; /* [TwoOrder (24)] */
}

/* What the bias adds: dv' = ... + G db with G = -C dt. Runs after propagate_nine, whose result
 * holds everything but the terms with b. */
static void propagate_bias(insole_zupt_cov_t *P, insole_mat3_t G, insole_vec3_t u, insole_real_t dt)
{
    insole_mat3_t G_ba = insole_mat3_mul_t(G, P->ab);
    insole_mat3_t vb = insole_mat3_sub(insole_mat3_add(P->vb, insole_mat3_mul_sym(G, P->bb)),
                                       insole_mat3_skew_mul(u, P->ab));
    insole_mat3_t vb_middle = insole_mat3_scale(insole_mat3_add(P->vb, vb), INSOLE_R(0.5));
    P->pb = insole_mat3_add_scaled(P->pb, dt, P->vb);
    P->pv = insole_mat3_add(P->pv, insole_mat3_mul_t(P->pb, G));
    insole_mat3_t half = insole_mat3_scale(insole_mat3_mul_skew(G_ba, u), INSOLE_R(0.5));
    insole_mat3_t vv = insole_mat3_add(insole_mat3_mul_t(vb_middle, G), half);
    P->vv = insole_sym3_add_twice(P->vv, INSOLE_R(1.0), vv);
    P->va = insole_mat3_add(P->va, G_ba);
    P->vb = vb;
}

void insole_zupt_cov_propagate(insole_zupt_cov_t *P, insole_vec3_t u, const insole_mat3_t *C,
                               insole_real_t dt_s, bool has_bias)
{
    propagate_nine(P, u, dt_s);
    if (has_bias) {
        propagate_bias(P, insole_mat3_scale(*C, -dt_s), u, dt_s);
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
void insole_zupt_cov_correct_velocity(insole_zupt_cov_t *P, insole_sym3_t W, insole_real_t r,
                                      bool has_bias)
{
    insole_mat3_t av = insole_mat3_transpose(P->va);
    insole_mat3_t K_p = insole_mat3_mul_sym(P->pv, W); /* [TwoOrder (25)] */
    insole_mat3_t K_a = insole_mat3_mul_sym(av, W);
    insole_sym3_t pp = insole_mat3_mul_t_sym(K_p, P->pv);
    insole_sym3_t aa = insole_mat3_mul_t_sym(K_a, av);
    P->pp = insole_sym3_add_scaled(P->pp, INSOLE_R(-1.0), pp); /* [TwoOrder (26)] */
    P->aa = insole_sym3_add_scaled(P->aa, INSOLE_R(-1.0), aa);
    P->pa = insole_mat3_sub(P->pa, insole_mat3_mul(K_p, P->va));
    if (has_bias) {
        insole_mat3_t bv = insole_mat3_transpose(P->vb);
        insole_mat3_t K_b = insole_mat3_mul_sym(bv, W);
        insole_sym3_t bb = insole_mat3_mul_t_sym(K_b, bv);
        P->bb = insole_sym3_add_scaled(P->bb, INSOLE_R(-1.0), bb);
        P->pb = insole_mat3_sub(P->pb, insole_mat3_mul(K_p, P->vb));
        P->ab = insole_mat3_sub(P->ab, insole_mat3_mul(K_a, P->vb));
        P->vb = insole_mat3_scale(insole_mat3_transpose(K_b), r);
    }
    P->pv = insole_mat3_scale(K_p, r);
    insole_sym3_t K_v = insole_mat3_mul_t_sym(insole_sym3_full(P->vv), insole_sym3_full(W));
    P->vv = insole_sym3_add_scaled(insole_sym3_zero(), r, K_v);
    P->va = insole_mat3_scale(insole_mat3_transpose(K_a), r);
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
