/* SPDX-License-Identifier: MIT */
#include "insole/move/zupt_cov.h"

/* ---- over an interval ------------------------------------------------------------------- */

/* The rows of p' = p + T v - S a: rows of P_pv and of P_pa x s give to that of P_pp, one half the
 * old and one the new ones. */
INSOLE_APART INSOLE_FLAT static void move_rows(insole_zupt_cov_t *P, insole_vec3_t s,
                                               insole_real_t T)
{
    insole_sym3_t *pp = &P->pp;
    insole_mat3_t pv = P->pv, pa = P->pa;
    insole_mat3_t s_aa = insole_mat3_skew_mul(s, insole_sym3_full(P->aa));
    insole_mat3_t s_av = insole_mat3_skew_mul(s, insole_mat3_transpose(P->va));
    P->pa = insole_mat3_sub(insole_mat3_add_scaled(pa, T, P->va), s_aa);
    P->pv = insole_mat3_sub(insole_mat3_add_scaled(pv, T, insole_sym3_full(P->vv)), s_av);
    insole_mat3_t old = insole_mat3_mul_skew(pa, s), new = insole_mat3_mul_skew(P->pa, s);
    pp->xx += T * (P->pv.r0.x + pv.r0.x) + (new.r0.x + old.r0.x);
    pp->xy += T * (P->pv.r0.y + pv.r1.x) + (new.r0.y + old.r1.x);
    pp->xz += T * (P->pv.r0.z + pv.r2.x) + (new.r0.z + old.r2.x);
    pp->yy += T * (P->pv.r1.y + pv.r1.y) + (new.r1.y + old.r1.y);
    pp->yz += T * (P->pv.r1.z + pv.r2.y) + (new.r1.z + old.r2.y);
    pp->zz += T * (P->pv.r2.z + pv.r2.z) + (new.r2.z + old.r2.z);
}

/* The rows of v' = v - U a, and P_pv: a row r of P_va gives r x u to that of P_vv, one half the old
 * and one the new row; in an entry off the diagonal the two have u in common. */
INSOLE_APART INSOLE_FLAT static void turn_rows(insole_zupt_cov_t *P, insole_vec3_t u)
{
    insole_sym3_t *vv = &P->vv;
    insole_mat3_t was = P->va;
    P->pv = insole_mat3_add(P->pv, insole_mat3_mul_skew(P->pa, u));
    insole_mat3_t va = insole_mat3_sub(was, insole_mat3_skew_mul(u, insole_sym3_full(P->aa)));
    vv->xx += insole_vec3_cross(insole_vec3_add(va.r0, was.r0), u).x;
    vv->xy += u.x * va.r0.z - u.y * was.r1.z + u.z * (was.r1.y - va.r0.x);
    vv->xz += u.z * was.r2.y - u.x * va.r0.y + u.y * (va.r0.x - was.r2.z);
    vv->yy += insole_vec3_cross(insole_vec3_add(va.r1, was.r1), u).y;
    vv->yz += u.y * va.r1.x - u.z * was.r2.x + u.x * (was.r2.z - va.r1.y);
    vv->zz += insole_vec3_cross(insole_vec3_add(va.r2, was.r2), u).z;
    P->va = va;
}

#if INSOLE_ZUPT_STATES == 12

/* p = p + T v - S a and v = v - U a are done but for their covariance with b; it follows what b
 * adds, G b.T/2 and G b. Of the rows after that, with Z = G P_bb G':
 *     P_vv + P_vb G' + G P_bv - Z,   P_pp + T/2 (P_pb G' + G P_bp) - (T/2)^2 Z. */
INSOLE_APART INSOLE_FLAT static void gain_rows(insole_zupt_cov_t *P,
                                               const insole_zupt_interval_t *interval)
{
    const insole_real_t T = interval->time_s, half_s = INSOLE_R(0.5) * T;
    const insole_mat3_t *G = &interval->G_s;
    insole_mat3_t Gb = insole_mat3_mul_sym(*G, P->bb), Ga = insole_mat3_mul_t(*G, P->ab);
    insole_mat3_t pb = insole_mat3_sub(insole_mat3_add_scaled(P->pb, T, P->vb),
                                       insole_mat3_skew_mul(interval->s_m, P->ab));
    insole_mat3_t vb = insole_mat3_sub(P->vb, insole_mat3_skew_mul(interval->u_mps, P->ab));
    P->pa = insole_mat3_add_scaled(P->pa, half_s, Ga);
    P->va = insole_mat3_add(P->va, Ga);
    P->pb = insole_mat3_add_scaled(pb, half_s, Gb);
    P->vb = insole_mat3_add(vb, Gb);
    insole_sym3_t Z = insole_mat3_mul_t_sym(Gb, *G);
    insole_mat3_t pbG = insole_mat3_mul_t(P->pb, *G), vbG = insole_mat3_mul_t(P->vb, *G);
    P->pp = insole_sym3_add_scaled(insole_sym3_add_twice(P->pp, half_s, pbG), -half_s * half_s, Z);
    P->vv =
        insole_sym3_add_scaled(insole_sym3_add_twice(P->vv, INSOLE_R(1.0), vbG), INSOLE_R(-1.0), Z);
    insole_mat3_t before = insole_mat3_transpose(insole_mat3_sub(vbG, insole_sym3_full(Z)));
    P->pv = insole_mat3_add_scaled(insole_mat3_add(P->pv, pbG), half_s, before);
}

#endif

void insole_zupt_cov_propagate(insole_zupt_cov_t *P, const insole_zupt_interval_t *interval,
                               bool has_bias)
{
    /* [TwoOrder (20)-(21)], [TwoOrder (24)] */
    move_rows(P, interval->s_m, interval->time_s);
    turn_rows(P, interval->u_mps);
#if INSOLE_ZUPT_STATES == 12
    if (has_bias) {
        gain_rows(P, interval);
    }
#else
    (void)has_bias;
#endif
}

/* ---- parts ------------------------------------------------------------------------------ */

insole_zupt_error_t insole_zupt_cov_of_velocity(const insole_zupt_cov_t *P, insole_vec3_t w)
{
    insole_zupt_error_t x = {insole_mat3_mul_vec(P->pv, w), insole_sym3_mul_vec(P->vv, w),
                             insole_mat3_mul_vec_t(P->va, w), insole_vec3_zero()};
#if INSOLE_ZUPT_STATES == 12
    x.b = insole_mat3_mul_vec_t(P->vb, w);
#endif
    return x;
}

INSOLE_COLD void insole_zupt_cov_forget_motion(insole_zupt_cov_t *P)
{
    P->vv = insole_sym3_zero();
    P->pv = P->pa = P->va = insole_mat3_zero();
#if INSOLE_ZUPT_STATES == 12
    P->pb = P->vb = P->ab = insole_mat3_zero();
#endif
}

INSOLE_COLD void insole_zupt_cov_forget_place(insole_zupt_cov_t *P)
{
    P->pp = insole_sym3_zero();
    P->pv = P->pa = insole_mat3_zero();
#if INSOLE_ZUPT_STATES == 12
    P->pb = insole_mat3_zero();
#endif
}

INSOLE_COLD void insole_zupt_cov_forget_yaw(insole_zupt_cov_t *P)
{
    P->aa.xz = P->aa.yz = P->aa.zz = INSOLE_R(0.0);
    P->va.r0.z = P->va.r1.z = P->va.r2.z = INSOLE_R(0.0);
    P->pa.r0.z = P->pa.r1.z = P->pa.r2.z = INSOLE_R(0.0);
#if INSOLE_ZUPT_STATES == 12
    P->ab.r2 = insole_vec3_zero();
#endif
}

INSOLE_COLD insole_zupt_error_t insole_zupt_cov_of_height(const insole_zupt_cov_t *P)
{
    insole_zupt_error_t x = {insole_vec3(P->pp.xz, P->pp.yz, P->pp.zz), P->pv.r2, P->pa.r2,
                             insole_vec3_zero()};
#if INSOLE_ZUPT_STATES == 12
    x.b = P->pb.r2;
#endif
    return x;
}

INSOLE_COLD static void add_square(insole_sym3_t *block, insole_real_t s, const insole_vec3_t *k)
{
    *block = insole_sym3_add_outer(*block, s, *k);
}

INSOLE_COLD static void add_outer(insole_mat3_t *block, insole_real_t s, const insole_vec3_t *row,
                                  const insole_vec3_t *column)
{
    *block = insole_mat3_add_outer(*block, s, *row, *column);
}

INSOLE_COLD static void subtract_outer(insole_zupt_cov_t *P, const insole_zupt_error_t *k,
                                       insole_real_t per_s)
{
    add_square(&P->pp, -per_s, &k->p);
    add_square(&P->vv, -per_s, &k->v);
    add_square(&P->aa, -per_s, &k->a);
    add_outer(&P->pv, -per_s, &k->p, &k->v);
    add_outer(&P->pa, -per_s, &k->p, &k->a);
    add_outer(&P->va, -per_s, &k->v, &k->a);
#if INSOLE_ZUPT_STATES == 12
    add_square(&P->bb, -per_s, &k->b);
    add_outer(&P->pb, -per_s, &k->p, &k->b);
    add_outer(&P->vb, -per_s, &k->v, &k->b);
    add_outer(&P->ab, -per_s, &k->a, &k->b);
#endif
}

/* The row of the height becomes r times the gain, again without a difference. */
INSOLE_COLD void insole_zupt_cov_correct_height(insole_zupt_cov_t *P, insole_real_t r)
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
#if INSOLE_ZUPT_STATES == 12
    P->pb.r2 = row.b;
#endif
}

#if INSOLE_ZUPT_STATES == 12

/* K_x = P_xv+ / r */
INSOLE_FLAT insole_vec3_t insole_zupt_cov_correct_bias(insole_zupt_cov_t *P, const insole_sym3_t *W,
                                                       insole_real_t r, insole_vec3_t z)
{
    insole_mat3_t vb = insole_mat3_scale(P->vb, INSOLE_R(1.0) / r);
    P->pb = insole_mat3_sub(P->pb, insole_mat3_mul(P->pv, vb));
    P->ab = insole_mat3_sub(P->ab, insole_mat3_mul(insole_mat3_transpose(P->va), vb));

    insole_mat3_t bv = insole_mat3_transpose(P->vb), K_b = insole_mat3_mul_sym(bv, *W);
    P->bb = insole_sym3_add_scaled(P->bb, INSOLE_R(-1.0), insole_mat3_mul_t_sym(K_b, bv));
    P->vb = insole_mat3_scale(insole_mat3_transpose(K_b), r);
    return insole_mat3_mul_vec(K_b, z);
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

#endif
