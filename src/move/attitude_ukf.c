/* SPDX-License-Identifier: MIT */
#include "insole/move/attitude_ukf.h"

#include "insole/base/unscented.h"

#define ZERO INSOLE_R(0.0)
#define TWO  INSOLE_R(2.0)

enum { N = 3 };

/* Points lie no farther out: half a turn would see what the middle sees, and tell nothing. */
static const insole_real_t FARTHEST_RAD = INSOLE_R(2.0);

/* Three pairs of points, a and -a, and what they see of the known direction. */
typedef struct {
    insole_vec3_t a[N];
    insole_vec3_t shared[N]; /* what both see, less the direction itself */
    insole_vec3_t apart[N];  /* what a sees less that; -a sees the opposite */
} pairs_t;

/* The columns of the root; a P without one becomes that of the root that was found. */
static void draw(insole_sym3_t *P, insole_real_t spread, pairs_t *pairs)
{
    const insole_real_t A[N * N] = {P->xx, ZERO, ZERO, P->xy, P->yy, ZERO, P->xz, P->yz, P->zz};
    insole_real_t L[N * N];
    bool has_root = insole_cholesky(N, A, L);
    insole_sym3_t found = insole_sym3_zero();
    for (uint32_t i = 0u; i < N; i++) {
        insole_vec3_t column = insole_vec3(L[i], L[N + i], L[2 * N + i]);
        insole_vec3_t a = insole_vec3_scale(column, spread); /* [PhoneUKF (14)] */
        insole_real_t far = insole_vec3_norm(a);
        pairs->a[i] = far > FARTHEST_RAD ? insole_vec3_scale(a, FARTHEST_RAD / far) : a;
        found = insole_sym3_add_outer(found, INSOLE_R(1.0), column);
    }
    if (!has_root) {
        *P = found;
    }
}

/* [PhoneUKF (11)]: exp(-a) e = e + 2 v x (v x e) - 2 w (v x e) */
static void look(pairs_t *pairs, insole_vec3_t e)
{
    for (uint32_t i = 0u; i < N; i++) {
        insole_quat_t q = insole_quat_from_rotvec(pairs->a[i]);
        insole_vec3_t v = insole_vec3(q.x, q.y, q.z), side = insole_vec3_cross(v, e);
        pairs->shared[i] = insole_vec3_scale(insole_vec3_cross(v, side), TWO);
        pairs->apart[i] = insole_vec3_scale(side, -TWO * q.w);
    }
}

/* What is expected to be seen, less the known direction, and the covariances of it. */
typedef struct {
    insole_vec3_t mean;
    insole_sym3_t P_zz;
    insole_mat3_t P_az;
} moments_t;

static moments_t moments_of(const pairs_t *pairs, const insole_unscented_t *ut)
{
    insole_real_t pair = TWO * ut->weight;
    moments_t m = {insole_vec3_zero(), insole_sym3_zero(), insole_mat3_zero()};
    for (uint32_t i = 0u; i < N; i++) {
        m.mean = insole_vec3_add_scaled(m.mean, pair, pairs->shared[i]); /* [PhoneUKF (16)] */
    }
    m.P_zz = insole_sym3_add_outer(m.P_zz, ut->cov0, m.mean);
    for (uint32_t i = 0u; i < N; i++) {
        insole_vec3_t off = insole_vec3_sub(pairs->shared[i], m.mean);
        m.P_zz = insole_sym3_add_outer(m.P_zz, pair, off);
        m.P_zz = insole_sym3_add_outer(m.P_zz, pair, pairs->apart[i]);
        m.P_az = insole_mat3_add_outer(m.P_az, pair, pairs->a[i], pairs->apart[i]);
    }
    return m;
}

static bool is_finite(const insole_sym3_t *P)
{
    return insole_is_finite(P->xx + P->yy + P->zz) && insole_is_finite(P->xy + P->xz + P->yz);
}

/* P - K P_zz K', written so that an error of K, squared, only adds to P: however sharp the
 * sighting, P stays positive. */
static void remove_what_is_told(insole_sym3_t *P, insole_mat3_t K, const moments_t *m)
{
    insole_mat3_t cross = insole_mat3_mul_t(K, m->P_az);
    insole_sym3_t told = insole_mat3_mul_t_sym(insole_mat3_mul_sym(K, m->P_zz), K);
    *P = insole_sym3_add(insole_sym3_add_twice(*P, INSOLE_R(-1.0), cross), told);
}

insole_status_t insole_attitude_ukf(insole_sym3_t *P, const insole_sighting_t *sighting,
                                    insole_correction_t *correction)
{
    if (!P || !sighting || !correction) {
        return INSOLE_ERR_NULL;
    }
    insole_unscented_t ut = insole_unscented(N, INSOLE_R(1.0), TWO, ZERO);
    insole_sym3_t P_aa = *P, W; /* W = P_zz^-1 */
    pairs_t pairs;
    draw(&P_aa, ut.spread, &pairs);
    look(&pairs, sighting->known);
    moments_t m = moments_of(&pairs, &ut);
    m.P_zz = insole_sym3_add_diagonal(m.P_zz, sighting->variance);
    if (!is_finite(P) || !insole_sym3_inverse(m.P_zz, &W)) {
        return INSOLE_ERR_STATE;
    }
    insole_vec3_t z = insole_vec3_sub(sighting->seen, insole_vec3_add(sighting->known, m.mean));
    insole_mat3_t K = insole_mat3_mul_sym(m.P_az, W);   /* [PhoneUKF (17)] */
    insole_vec3_t turn_rad = insole_mat3_mul_vec(K, z); /* [PhoneUKF (18)] */
    remove_what_is_told(&P_aa, K, &m);
    insole_real_t nis = insole_vec3_dot(z, insole_sym3_mul_vec(W, z));
    if (!is_finite(&P_aa) || !insole_is_finite(nis) || !insole_vec3_is_finite(turn_rad)) {
        return INSOLE_ERR_STATE;
    }
    *P = P_aa;
    correction->turn = insole_quat_from_rotvec(turn_rad);
    correction->nis = nis;
    return INSOLE_OK;
}
