/* SPDX-License-Identifier: MIT */
#include "insole/move/zupt_cov.h"

insole_zupt_error_t insole_zupt_cov_of_velocity(const insole_zupt_cov_t *P, insole_vec3_t w)
{
    insole_zupt_error_t x = {insole_mat3_mul_vec(P->pv, w), insole_sym3_mul_vec(P->vv, w),
                             insole_mat3_mul_vec_t(P->va, w), insole_mat3_mul_vec_t(P->vb, w)};
    return x;
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
