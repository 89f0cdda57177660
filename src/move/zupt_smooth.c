/* SPDX-License-Identifier: MIT */
#include "insole/move/zupt_smooth.h"

#include <string.h>

#if INSOLE_ZUPT_STATES == 12

#define ZERO INSOLE_R(0.0)

/* What the samples after a node tell about its error, and how surely. */
typedef struct {
    insole_zupt_error_t lambda;
    insole_zupt_cov_t Lambda;
} adjoint_t;

/* Three rows of a symmetric matrix of the errors. */
typedef struct {
    insole_mat3_t p, v, a, b;
} rows_t;

static insole_status_t refuse(insole_zupt_smooth_t *smooth, insole_status_t why)
{
    smooth->refused++;
    return why;
}

insole_status_t insole_zupt_smooth_init(insole_zupt_smooth_t *smooth, insole_zupt_node_t *nodes,
                                        uint32_t count)
{
    if (!smooth || !nodes) {
        return INSOLE_ERR_NULL;
    }
    if (count < 2u || (count & (count - 1u)) != 0u) {
        return INSOLE_ERR_VALUE;
    }
    memset(smooth, 0, sizeof *smooth);
    smooth->nodes = nodes;
    smooth->ring = insole_ring(count);
    return INSOLE_OK;
}

/* The interval is known to the filter and by the stamps: equal unless a sample was left out. */
static bool follows(const insole_zupt_smooth_t *smooth, const insole_zupt_ekf_t *ekf)
{
    uint64_t step_us = ekf->t_us - smooth->newest_us;
    insole_real_t dt = (insole_real_t)(uint32_t)step_us * INSOLE_R(1.0e-6);
    return ekf->trace.step == INSOLE_ZUPT_STEP_PREDICT && step_us <= UINT32_MAX && dt == ekf->dt_s;
}

insole_status_t insole_zupt_smooth_push(insole_zupt_smooth_t *smooth, const insole_zupt_ekf_t *ekf)
{
    if (!smooth || !ekf) {
        return INSOLE_ERR_NULL;
    }
    if (!ekf->aligned) {
        return refuse(smooth, INSOLE_ERR_STATE);
    }
    bool is_first = smooth->ring.end == 0u;
    if (!is_first && ekf->t_us <= smooth->newest_us) {
        return refuse(smooth, INSOLE_ERR_TIME);
    }
    if (insole_ring_is_full(&smooth->ring)) {
        return INSOLE_ERR_ROOM;
    }
    insole_zupt_node_t *node = &smooth->nodes[insole_ring_push(&smooth->ring)];
    node->t_us = ekf->t_us;
    node->is_linked = !is_first && follows(smooth, ekf);
    node->dt_s = ekf->dt_s;
    node->u_mps = insole_vec3_scale(ekf->force_mps2, ekf->dt_s);
    node->p_m = ekf->p_m;
    node->v_mps = ekf->v_mps;
    node->q = ekf->q;
    node->P = ekf->P;
    insole_zupt_cov_propagate(&node->P, &ekf->pending, ekf->config.sigma_accel_bias_mps2 > ZERO);
    node->trace = ekf->trace;
    smooth->newest_us = ekf->t_us;
    return INSOLE_OK;
}

/* ---- rows ------------------------------------------------------------------------------- */

static rows_t position_rows(const insole_zupt_cov_t *P)
{
    rows_t r = {insole_sym3_full(P->pp), P->pv, P->pa, P->pb};
    return r;
}

static rows_t velocity_rows(const insole_zupt_cov_t *P, insole_real_t s)
{
    rows_t r = {insole_mat3_scale(insole_mat3_transpose(P->pv), s),
                insole_mat3_scale(insole_sym3_full(P->vv), s), insole_mat3_scale(P->va, s),
                insole_mat3_scale(P->vb, s)};
    return r;
}

static insole_mat3_t third_row(insole_vec3_t row)
{
    return insole_mat3_rows(insole_vec3_zero(), insole_vec3_zero(), row);
}

static rows_t height_row(const insole_zupt_cov_t *P, insole_real_t s)
{
    insole_zupt_error_t z = insole_zupt_error_scale(insole_zupt_cov_of_height(P), s);
    rows_t r = {third_row(z.p), third_row(z.v), third_row(z.a), third_row(z.b)};
    return r;
}

static insole_mat3_t sum(insole_mat3_t a, insole_mat3_t b, insole_mat3_t c, insole_mat3_t d)
{
    return insole_mat3_add(insole_mat3_add(a, b), insole_mat3_add(c, d));
}

/* R S */
static rows_t rows_mul(const rows_t *R, const insole_zupt_cov_t *S)
{
    rows_t y = {sum(insole_mat3_mul_sym(R->p, S->pp), insole_mat3_mul_t(R->v, S->pv),
                    insole_mat3_mul_t(R->a, S->pa), insole_mat3_mul_t(R->b, S->pb)),
                sum(insole_mat3_mul(R->p, S->pv), insole_mat3_mul_sym(R->v, S->vv),
                    insole_mat3_mul_t(R->a, S->va), insole_mat3_mul_t(R->b, S->vb)),
                sum(insole_mat3_mul(R->p, S->pa), insole_mat3_mul(R->v, S->va),
                    insole_mat3_mul_sym(R->a, S->aa), insole_mat3_mul_t(R->b, S->ab)),
                sum(insole_mat3_mul(R->p, S->pb), insole_mat3_mul(R->v, S->vb),
                    insole_mat3_mul(R->a, S->ab), insole_mat3_mul_sym(R->b, S->bb))};
    return y;
}

/* Q R' */
static insole_mat3_t rows_mul_t(const rows_t *Q, const rows_t *R)
{
    return sum(insole_mat3_mul_t(Q->p, R->p), insole_mat3_mul_t(Q->v, R->v),
               insole_mat3_mul_t(Q->a, R->a), insole_mat3_mul_t(Q->b, R->b));
}

/* ---- backwards -------------------------------------------------------------------------- */

static void look_back(insole_zupt_node_t *node, const adjoint_t *adjoint)
{
    insole_zupt_error_t less = insole_zupt_cov_mul(&node->P, &adjoint->lambda);
    rows_t P_p = position_rows(&node->P);
    rows_t P_p_Lambda = rows_mul(&P_p, &adjoint->Lambda);
    insole_sym3_t gained = insole_mat3_symmetric(rows_mul_t(&P_p_Lambda, &P_p));
    insole_quat_t turn = insole_quat_from_rotvec(insole_vec3_neg(less.a));
    insole_zupt_smoothed_t *after = &node->after;
    after->t_us = node->t_us;
    after->p_m = insole_vec3_sub(node->p_m, less.p);
    after->v_mps = insole_vec3_sub(node->v_mps, less.v);
    after->q = insole_quat_chain(turn, node->q);
    after->P_pp_m2 = insole_sym3_add_scaled(node->P.pp, INSOLE_R(-1.0), gained);
}

/* Where place or yaw is known, by an origin or a start, its error is none, and nothing that comes
 * later tells of the error that it had before. */
static void forget_known(const insole_zupt_node_t *node, adjoint_t *adjoint)
{
    insole_zupt_error_t *x = &adjoint->lambda;
    insole_zupt_cov_t *L = &adjoint->Lambda;
    const insole_zupt_cov_t *P = &node->P;
    if (P->pp.xx == ZERO && P->pp.yy == ZERO && P->pp.zz == ZERO) {
        x->p = insole_vec3_zero();
        insole_zupt_cov_forget_place(L);
    }
    if (P->aa.zz == ZERO) {
        x->a.z = ZERO;
        insole_zupt_cov_forget_yaw(L);
    }
}

/* 1 / r; 0 where nothing was measured. */
static insole_real_t weight_of(insole_real_t variance)
{
    return variance > ZERO ? INSOLE_R(1.0) / variance : ZERO;
}

/* (I - K H)' Lambda (I - K H) + H' S^-1 H for what was measured of v and of the height, with
 * K = P H' W, S^-1 = W - W H P H' W and W the diagonal of the weights. */
static void pass_information(const insole_zupt_cov_t *P, insole_real_t w_v, insole_real_t w_z,
                             insole_zupt_cov_t *L)
{
    const insole_real_t minus = INSOLE_R(-1.0);
    rows_t K_v = velocity_rows(P, w_v), K_z = height_row(P, w_z); /* each transposed */
    rows_t M_v = rows_mul(&K_v, L), M_z = rows_mul(&K_z, L);      /* K' Lambda */
    insole_mat3_t vv = insole_mat3_add_scaled(rows_mul_t(&M_v, &K_v), -w_v, K_v.v);
    insole_mat3_t zv = insole_mat3_add_scaled(rows_mul_t(&M_z, &K_v), -w_v, K_z.v);
    insole_mat3_t zz = insole_mat3_add_scaled(rows_mul_t(&M_z, &K_z), -w_z, third_row(K_z.p.r2));
    L->pp = insole_sym3_add_twice(L->pp, minus, M_z.p);
    L->pp.zz += zz.r2.z + w_z;
    L->vv = insole_sym3_add_twice(L->vv, minus, M_v.v);
    L->vv = insole_sym3_add(L->vv, insole_mat3_symmetric(vv));
    L->vv = insole_sym3_add_diagonal(L->vv, w_v);
    L->pv = insole_mat3_sub(L->pv, insole_mat3_add(insole_mat3_transpose(M_v.p), M_z.v));
    L->pv = insole_mat3_add(L->pv, zv);
    L->pa = insole_mat3_sub(L->pa, M_z.a);
    L->pb = insole_mat3_sub(L->pb, M_z.b);
    L->va = insole_mat3_sub(L->va, M_v.a);
    L->vb = insole_mat3_sub(L->vb, M_v.b);
}

/* What the corrections of a node could not explain, even afterwards, tells of the state before. */
static void pass_corrections(const insole_zupt_node_t *node, adjoint_t *adjoint)
{
    const insole_zupt_trace_t *trace = &node->trace;
    insole_real_t w_v = weight_of(trace->velocity_var_m2ps2);
    insole_real_t w_z = weight_of(trace->height_var_m2);
    if (w_v > ZERO || w_z > ZERO) {
        insole_vec3_t rest = insole_vec3_sub(trace->velocity_mps, node->after.v_mps);
        insole_zupt_error_t *x = &adjoint->lambda;
        x->v = insole_vec3_add_scaled(x->v, -w_v, rest);
        x->p.z -= w_z * (trace->height_m - node->after.p_m.z);
        pass_information(&node->P, w_v, w_z, &adjoint->Lambda);
    }
}

/* p = p + v dt is taken back. Each line still needs the old values of the lines below it. */
static void move_back(adjoint_t *adjoint, insole_real_t dt)
{
    insole_zupt_error_t *x = &adjoint->lambda;
    insole_zupt_cov_t *L = &adjoint->Lambda;
    x->v = insole_vec3_add_scaled(x->v, dt, x->p);
    L->va = insole_mat3_add_scaled(L->va, dt, L->pa);
    L->vb = insole_mat3_add_scaled(L->vb, dt, L->pb);
    L->vv = insole_sym3_add_scaled(insole_sym3_add_twice(L->vv, dt, L->pv), dt * dt, L->pp);
    L->pv = insole_mat3_add_scaled(L->pv, dt, insole_sym3_full(L->pp));
}

/* v = v - [u]x a + G b is taken back. */
static void turn_back(const insole_zupt_node_t *node, adjoint_t *adjoint)
{
    const insole_real_t half = INSOLE_R(0.5), one = INSOLE_R(1.0);
    insole_vec3_t u = node->u_mps;
    insole_mat3_t G = insole_mat3_scale(insole_quat_to_mat3(node->trace.q), -node->dt_s);
    insole_zupt_error_t *x = &adjoint->lambda;
    x->a = insole_vec3_add(x->a, insole_vec3_cross(u, x->v));
    x->b = insole_vec3_add(x->b, insole_mat3_mul_vec_t(G, x->v));
    insole_zupt_cov_t *L = &adjoint->Lambda;
    insole_mat3_t va = insole_mat3_sub(L->va, insole_mat3_mul_skew(insole_sym3_full(L->vv), u));
    insole_mat3_t vb = insole_mat3_add(L->vb, insole_mat3_mul(insole_sym3_full(L->vv), G));
    insole_mat3_t va_middle = insole_mat3_scale(insole_mat3_add(L->va, va), half);
    insole_mat3_t vb_middle = insole_mat3_scale(insole_mat3_add(L->vb, vb), half);
    insole_mat3_t G_t = insole_mat3_transpose(G);
    L->ab = insole_mat3_add(L->ab, insole_mat3_mul(insole_mat3_transpose(L->va), G));
    L->ab = insole_mat3_add(L->ab, insole_mat3_skew_mul(u, vb));
    L->aa = insole_sym3_add_twice(L->aa, one, insole_mat3_skew_mul(u, va_middle));
    L->bb = insole_sym3_add_twice(L->bb, one, insole_mat3_mul(G_t, vb_middle));
    L->pa = insole_mat3_sub(L->pa, insole_mat3_mul_skew(L->pv, u));
    L->pb = insole_mat3_add(L->pb, insole_mat3_mul(L->pv, G));
    L->va = va;
    L->vb = vb;
}

/* Phi' lambda and Phi' Lambda Phi. */
static void pass_interval(const insole_zupt_node_t *node, adjoint_t *adjoint)
{
    insole_real_t half_s = INSOLE_R(0.5) * node->dt_s;
    move_back(adjoint, half_s);
    turn_back(node, adjoint);
    move_back(adjoint, half_s);
}

/* From what is known after a node to what is known after the one before it. */
static void pass_node(insole_zupt_node_t *node, adjoint_t *adjoint)
{
    static const adjoint_t nothing_known;
    look_back(node, adjoint);
    if (!node->is_linked) {
        *adjoint = nothing_known;
        return;
    }
    forget_known(node, adjoint);
    pass_corrections(node, adjoint);
    pass_interval(node, adjoint);
}

insole_status_t insole_zupt_smooth_run(insole_zupt_smooth_t *smooth, uint32_t keep)
{
    static const adjoint_t nothing_known;
    if (!smooth) {
        return INSOLE_ERR_NULL;
    }
    adjoint_t adjoint = nothing_known;
    for (uint32_t number = smooth->ring.end; number != smooth->ring.begin; number--) {
        uint32_t slot = insole_ring_slot(&smooth->ring, number - 1u);
        pass_node(&smooth->nodes[slot], &adjoint);
    }
    uint32_t count = insole_ring_count(&smooth->ring);
    smooth->ready = smooth->ring.end - (keep < count ? keep : count);
    return INSOLE_OK;
}

insole_status_t insole_zupt_smooth_take(insole_zupt_smooth_t *smooth,
                                        insole_zupt_smoothed_t *smoothed)
{
    if (!smooth || !smoothed) {
        return INSOLE_ERR_NULL;
    }
    if (smooth->ring.begin == smooth->ready) {
        return INSOLE_ERR_STATE;
    }
    *smoothed = smooth->nodes[insole_ring_slot(&smooth->ring, smooth->ring.begin)].after;
    insole_ring_pop(&smooth->ring);
    return INSOLE_OK;
}

#endif
