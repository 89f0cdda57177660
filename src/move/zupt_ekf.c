/* SPDX-License-Identifier: MIT */
#include "insole/move/zupt_ekf.h"

#define ZERO INSOLE_R(0.0)

/* Long enough that a block of yaw noise is not lost to rounding beside a day's yaw variance, short
 * enough that noise of a swing still turns into velocity within the swing. */
enum { NOISE_BLOCK = 8 };

/* Longer intervals are no sampling but a gap. */
static const uint32_t LONGEST_STEP_US = 1000000u;

/* The interval that sigma_zupt_mps speaks of. */
static const insole_real_t ZUPT_INTERVAL_S = INSOLE_R(0.005);

const insole_zupt_ekf_config_t insole_zupt_ekf_defaults = {
    INSOLE_ZUPT_EKF_KEYS(INSOLE_CONFIG_DEFAULT)};

static insole_status_t refuse(insole_zupt_ekf_t *ekf, insole_status_t why)
{
    ekf->refused++;
    return why;
}

static bool has_bias(const insole_zupt_ekf_t *ekf)
{
    return ekf->config.sigma_accel_bias_mps2 > ZERO;
}

insole_status_t insole_zupt_ekf_init(insole_zupt_ekf_t *ekf, const insole_zupt_ekf_config_t *config)
{
    if (!ekf || !config) {
        return INSOLE_ERR_NULL;
    }
    if (!(true INSOLE_ZUPT_EKF_KEYS(INSOLE_CONFIG_IN_RANGE))) {
        return INSOLE_ERR_VALUE;
    }
    static const insole_zupt_ekf_t blank;
    *ekf = blank;
    ekf->config = *config;
    ekf->gravity_mps2 = config->gravity_mps2;
    ekf->q = insole_quat_identity();
    ekf->C = insole_quat_to_mat3(ekf->q);
    ekf->P.bb = insole_sym3_add_diagonal(ekf->P.bb, insole_square(config->sigma_accel_bias_mps2));
    return INSOLE_OK;
}

static void forget_motion(insole_zupt_cov_t *P)
{
    P->vv = insole_sym3_zero();
    P->pv = P->pa = P->va = insole_mat3_zero();
    P->pb = P->vb = P->ab = insole_mat3_zero();
}

insole_status_t insole_zupt_ekf_align(insole_zupt_ekf_t *ekf, insole_vec3_t mean_accel_mps2,
                                      insole_real_t sigma_tilt_rad, insole_real_t yaw_rad,
                                      uint64_t t_us)
{
    if (!ekf) {
        return INSOLE_ERR_NULL;
    }
    insole_real_t length = insole_vec3_norm(mean_accel_mps2);
    bool plausible =
        length > INSOLE_R(0.5) * ekf->gravity_mps2 && length < INSOLE_R(2.0) * ekf->gravity_mps2;
    if (!plausible || !insole_is_finite(yaw_rad) || !insole_is_finite(sigma_tilt_rad) ||
        sigma_tilt_rad < ZERO) {
        return refuse(ekf, INSOLE_ERR_VALUE);
    }
    insole_quat_t level = insole_quat_from_gravity(mean_accel_mps2); /* [TwoOrder] table 1 */
    insole_quat_t turn = insole_quat_from_yaw(yaw_rad - insole_quat_yaw(level));
    ekf->q = insole_quat_normalize(insole_quat_mul(turn, level));
    ekf->C = insole_quat_to_mat3(ekf->q);
    ekf->v_mps = insole_vec3_zero();
    ekf->last_accel_mps2 = mean_accel_mps2;
    ekf->last_gyro_radps = insole_vec3_zero();
    insole_real_t tilt_var = insole_square(sigma_tilt_rad);
    forget_motion(&ekf->P);
    ekf->P.aa = insole_sym3_diagonal(tilt_var, tilt_var, ekf->P.aa.zz);
    ekf->aligned = true;
    ekf->coasting = false;
    ekf->t_us = t_us;
    return INSOLE_OK;
}

/* What the sensor felt over the interval. A sample lies between the mean of its interval and the
 * value at its end, where the mean would be half way to the sample before. */
static insole_vec3_t over_interval(const insole_zupt_ekf_t *ekf, insole_vec3_t now,
                                   insole_vec3_t before)
{
    insole_vec3_t back = insole_vec3_sub(before, now);
    return insole_vec3_add_scaled(now, INSOLE_R(0.5) * ekf->config.point_share, back);
}

/* With the coning term of two samples: d = w dt + (w_prev x w) dt^2 / 12. */
static insole_vec3_t turn(insole_zupt_ekf_t *ekf, insole_vec3_t gyro, insole_real_t dt)
{
    insole_vec3_t coning = insole_vec3_cross(ekf->last_gyro_radps, gyro);
    insole_vec3_t d = insole_vec3_add_scaled(insole_vec3_scale(gyro, dt),
                                             dt * dt * INSOLE_R(0.08333333333), coning);
    insole_quat_t dq = insole_quat_from_rotvec(d);               /* [TwoOrder (12)-(13)] */
    ekf->q = insole_quat_normalize(insole_quat_mul(ekf->q, dq)); /* [TwoOrder (14)] */
    ekf->C = insole_quat_to_mat3(ekf->q);
    return d;
}

/* Mean specific force of the interval, seen from the attitude at its end: half the rotation is
 * taken back, and the sculling term of two samples added. */
static insole_vec3_t mean_force(const insole_zupt_ekf_t *ekf, insole_vec3_t accel,
                                insole_vec3_t gyro, insole_vec3_t d, insole_real_t dt)
{
    insole_vec3_t sculling = insole_vec3_add(insole_vec3_cross(ekf->last_gyro_radps, accel),
                                             insole_vec3_cross(ekf->last_accel_mps2, gyro));
    insole_vec3_t back = insole_vec3_cross(accel, d);
    insole_vec3_t s = insole_vec3_add_scaled(accel, INSOLE_R(0.5), back);
    return insole_vec3_add_scaled(s, dt * INSOLE_R(0.08333333333), sculling);
}

/* Velocity and position, [TwoOrder (16)-(17)]. */
static void move(insole_zupt_ekf_t *ekf, insole_real_t dt)
{
    insole_vec3_t a = ekf->force_mps2;
    a.z -= ekf->gravity_mps2;
    ekf->p_m = insole_vec3_add_scaled(insole_vec3_add_scaled(ekf->p_m, dt, ekf->v_mps),
                                      INSOLE_R(0.5) * dt * dt, a);
    ekf->v_mps = insole_vec3_add_scaled(ekf->v_mps, dt, a);
}

/* P = Phi P Phi' for p, v, a [TwoOrder (20)-(21)]: Phi = [I I.dt 0; 0 I -S.dt; 0 0 I], u = f dt.
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

/* Q of table 1, put aside until a block is full. */
static void gather_noise(insole_zupt_ekf_t *ekf, insole_vec3_t gyro, uint32_t clipped)
{
    const insole_zupt_ekf_config_t *c = &ekf->config;
    insole_zupt_noise_t *noise = &ekf->noise;
    insole_real_t dt = ekf->dt_s;
    insole_real_t turning = insole_square(c->gyro_turn_noise_rts) * insole_vec3_norm2(gyro);
    insole_real_t attitude = (insole_square(c->gyro_noise_rad_rts) + turning) * dt;
    noise->velocity_m2ps2 += insole_square(c->accel_noise_mps_rts) * dt;
    noise->attitude_rad2 = insole_sym3_add_diagonal(noise->attitude_rad2, attitude);
    noise->bias_m2ps4 += insole_square(c->accel_bias_walk_mps2_rts) * dt;
    if (clipped != 0u) {
        insole_mat3_t axes = insole_mat3_transpose(ekf->C);
        const insole_vec3_t *axis[3] = {&axes.r0, &axes.r1, &axes.r2};
        for (uint32_t m = 0u; m < 3u; m++) {
            insole_real_t on = (clipped >> m & 1u) != 0u ? INSOLE_R(1.0) : ZERO;
            noise->attitude_rad2 = insole_sym3_add_outer(
                noise->attitude_rad2, on * insole_square(c->clip_noise_rad_rts) * dt, *axis[m]);
        }
    }
    noise->samples++;
}

static void add_noise(insole_zupt_ekf_t *ekf)
{
    static const insole_zupt_noise_t none;
    insole_zupt_noise_t *noise = &ekf->noise;
    ekf->P.vv = insole_sym3_add_diagonal(ekf->P.vv, noise->velocity_m2ps2);
    ekf->P.aa = insole_sym3_add(ekf->P.aa, noise->attitude_rad2);
    if (has_bias(ekf)) {
        ekf->P.bb = insole_sym3_add_diagonal(ekf->P.bb, noise->bias_m2ps4);
    }
    *noise = none;
}

insole_status_t insole_zupt_ekf_predict(insole_zupt_ekf_t *ekf, const insole_imu_t *imu,
                                        uint32_t clipped)
{
    if (!ekf || !imu) {
        return INSOLE_ERR_NULL;
    }
    if (!ekf->aligned) {
        return refuse(ekf, INSOLE_ERR_STATE);
    }
    if (imu->t_us <= ekf->t_us) {
        return refuse(ekf, INSOLE_ERR_TIME);
    }
    if (imu->t_us - ekf->t_us > LONGEST_STEP_US || !insole_vec3_is_finite(imu->accel_mps2) ||
        !insole_vec3_is_finite(imu->gyro_radps)) {
        return refuse(ekf, INSOLE_ERR_VALUE);
    }
    insole_real_t dt = (insole_real_t)(uint32_t)(imu->t_us - ekf->t_us) * INSOLE_R(1.0e-6);
    insole_vec3_t accel = insole_vec3_sub(imu->accel_mps2, ekf->accel_bias_mps2);
    insole_vec3_t gyro = over_interval(ekf, imu->gyro_radps, ekf->last_gyro_radps);
    insole_vec3_t d = turn(ekf, gyro, dt);
    insole_vec3_t felt = over_interval(ekf, accel, ekf->last_accel_mps2);
    insole_vec3_t force = mean_force(ekf, felt, gyro, d, dt);
    ekf->force_mps2 = insole_mat3_mul_vec(ekf->C, force);
    move(ekf, dt);
    insole_vec3_t u = insole_vec3_scale(ekf->force_mps2, dt);
    propagate_nine(&ekf->P, u, dt);
    if (has_bias(ekf)) {
        propagate_bias(&ekf->P, insole_mat3_scale(ekf->C, -dt), u, dt);
    }
    ekf->coasting = false;
    ekf->dt_s = dt;
    ekf->t_us = imu->t_us;
    ekf->last_accel_mps2 = accel;
    ekf->last_gyro_radps = imu->gyro_radps;
    gather_noise(ekf, imu->gyro_radps, clipped);
    if (ekf->noise.samples >= NOISE_BLOCK) {
        add_noise(ekf);
    }
    return INSOLE_OK;
}

/* What the filter adds to its state after a correction. */
typedef struct {
    insole_vec3_t p, v, a, b;
} error_t;

/* (28)-(31): the nominal state takes the error, whose estimate is zero again. */
static void inject(insole_zupt_ekf_t *ekf, const error_t *dx)
{
    ekf->p_m = insole_vec3_add(ekf->p_m, dx->p); /* [TwoOrder (29)] */
    ekf->v_mps = insole_vec3_add(ekf->v_mps, dx->v);
    ekf->accel_bias_mps2 = insole_vec3_add(ekf->accel_bias_mps2, dx->b);
    /* (2I + Omega)(2I - Omega)^-1 is the rotation of the quaternion (1, a/2) made unit. */
    insole_vec3_t half = insole_vec3_scale(dx->a, INSOLE_R(0.5));
    insole_quat_t cayley = insole_quat(INSOLE_R(1.0), half.x, half.y, half.z);
    ekf->q = insole_quat_normalize(insole_quat_mul(cayley, ekf->q)); /* [TwoOrder (30)-(31)] */
    ekf->C = insole_quat_to_mat3(ekf->q);
}

/* Velocity of a sensor at roll_height_m over the line on which the foot rolls. */
static insole_vec3_t rolling_velocity(const insole_zupt_ekf_t *ekf)
{
    insole_vec3_t w = insole_mat3_mul_vec(ekf->C, ekf->last_gyro_radps);
    insole_real_t h = ekf->config.roll_height_m;
    return insole_vec3(w.y * h, -w.x * h, ZERO); /* w x (0, 0, h) */
}

/* P+ = (I - K H) P (26) in closed blocks, for R = r I: P_vv+ = r (I - r S^-1), P_xv+ = r K_x,
 * P_xy+ = P_xy - K_x P_vy. No difference of nearly equal numbers is formed. */
static void close_blocks(insole_zupt_cov_t *P, insole_sym3_t W, insole_real_t r, bool bias)
{
    insole_mat3_t av = insole_mat3_transpose(P->va);
    insole_mat3_t K_p = insole_mat3_mul_sym(P->pv, W); /* [TwoOrder (25)] */
    insole_mat3_t K_a = insole_mat3_mul_sym(av, W);
    insole_sym3_t pp = insole_mat3_mul_t_sym(K_p, P->pv);
    insole_sym3_t aa = insole_mat3_mul_t_sym(K_a, av);
    P->pp = insole_sym3_add_scaled(P->pp, INSOLE_R(-1.0), pp); /* [TwoOrder (26)] */
    P->aa = insole_sym3_add_scaled(P->aa, INSOLE_R(-1.0), aa);
    P->pa = insole_mat3_sub(P->pa, insole_mat3_mul(K_p, P->va));
    if (bias) {
        insole_mat3_t bv = insole_mat3_transpose(P->vb);
        insole_mat3_t K_b = insole_mat3_mul_sym(bv, W);
        insole_sym3_t bb = insole_mat3_mul_t_sym(K_b, bv);
        P->bb = insole_sym3_add_scaled(P->bb, INSOLE_R(-1.0), bb);
        P->pb = insole_mat3_sub(P->pb, insole_mat3_mul(K_p, P->vb));
        P->ab = insole_mat3_sub(P->ab, insole_mat3_mul(K_a, P->vb));
        P->vb = insole_mat3_scale(insole_mat3_transpose(K_b), r);
    }
    P->pv = insole_mat3_scale(K_p, r);
    P->va = insole_mat3_scale(insole_mat3_transpose(K_a), r);
    insole_sym3_t none = insole_sym3_zero();
    P->vv = insole_sym3_add_diagonal(insole_sym3_add_scaled(none, -r * r, W), r);
}

insole_status_t insole_zupt_ekf_correct(insole_zupt_ekf_t *ekf, insole_real_t *nis)
{
    if (!ekf) {
        return INSOLE_ERR_NULL;
    }
    if (!ekf->aligned || !(ekf->dt_s > ZERO)) {
        return refuse(ekf, INSOLE_ERR_STATE);
    }
    insole_real_t r = insole_square(ekf->config.sigma_zupt_mps) * ZUPT_INTERVAL_S / ekf->dt_s;
    insole_sym3_t S = insole_sym3_add_diagonal(ekf->P.vv, r); /* H P H' + R, [TwoOrder (23)] */
    insole_sym3_t W;                                          /* S^-1 */
    if (!insole_sym3_inverse(S, &W)) {
        return refuse(ekf, INSOLE_ERR_STATE);
    }
    /* z = -H x [TwoOrder (27)]: what the rolling foot does less what the state says. */
    insole_vec3_t z = insole_vec3_sub(rolling_velocity(ekf), ekf->v_mps);
    insole_vec3_t w = insole_sym3_mul_vec(W, z); /* S^-1 z */
    error_t dx = {insole_mat3_mul_vec(ekf->P.pv, w), insole_sym3_mul_vec(ekf->P.vv, w),
                  insole_mat3_mul_vec_t(ekf->P.va, w), insole_vec3_zero()};
    if (has_bias(ekf)) {
        dx.b = insole_mat3_mul_vec_t(ekf->P.vb, w);
    }
    close_blocks(&ekf->P, W, r, has_bias(ekf));
    inject(ekf, &dx);
    if (nis) {
        *nis = insole_vec3_dot(z, w);
    }
    return INSOLE_OK;
}

/* P - k k' / s for one column k of P: blocks of the two parts. */
static insole_sym3_t less_outer(insole_sym3_t A, insole_vec3_t k, insole_real_t per_s)
{
    return insole_sym3_add_outer(A, -per_s, k);
}

static insole_mat3_t less_outer_of(insole_mat3_t A, insole_vec3_t k, insole_vec3_t l,
                                   insole_real_t per_s)
{
    return insole_mat3_rows(insole_vec3_add_scaled(A.r0, -k.x * per_s, l),
                            insole_vec3_add_scaled(A.r1, -k.y * per_s, l),
                            insole_vec3_add_scaled(A.r2, -k.z * per_s, l));
}

static void subtract_column(insole_zupt_cov_t *P, const error_t *k, insole_real_t per_s)
{
    P->pp = less_outer(P->pp, k->p, per_s);
    P->vv = less_outer(P->vv, k->v, per_s);
    P->aa = less_outer(P->aa, k->a, per_s);
    P->bb = less_outer(P->bb, k->b, per_s);
    P->pv = less_outer_of(P->pv, k->p, k->v, per_s);
    P->pa = less_outer_of(P->pa, k->p, k->a, per_s);
    P->pb = less_outer_of(P->pb, k->p, k->b, per_s);
    P->va = less_outer_of(P->va, k->v, k->a, per_s);
    P->vb = less_outer_of(P->vb, k->v, k->b, per_s);
    P->ab = less_outer_of(P->ab, k->a, k->b, per_s);
}

insole_status_t insole_zupt_ekf_correct_height(insole_zupt_ekf_t *ekf, insole_real_t height_m,
                                               insole_real_t sigma_m)
{
    if (!ekf) {
        return INSOLE_ERR_NULL;
    }
    if (!ekf->aligned) {
        return refuse(ekf, INSOLE_ERR_STATE);
    }
    if (!insole_is_finite(height_m) || !(sigma_m > ZERO) || !insole_is_finite(sigma_m)) {
        return refuse(ekf, INSOLE_ERR_VALUE);
    }
    insole_zupt_cov_t *P = &ekf->P;
    error_t column = {insole_vec3(P->pp.xz, P->pp.yz, P->pp.zz), P->pv.r2, P->pa.r2, P->pb.r2};
    insole_real_t per_s = INSOLE_R(1.0) / (P->pp.zz + insole_square(sigma_m));
    insole_real_t gain = (height_m - ekf->p_m.z) * per_s;
    error_t dx = {insole_vec3_scale(column.p, gain), insole_vec3_scale(column.v, gain),
                  insole_vec3_scale(column.a, gain), insole_vec3_scale(column.b, gain)};
    subtract_column(P, &column, per_s);
    inject(ekf, &dx);
    return INSOLE_OK;
}

insole_status_t insole_zupt_ekf_coast(insole_zupt_ekf_t *ekf, insole_vec3_t velocity_mps,
                                      insole_real_t sigma_mps, uint64_t t_us)
{
    if (!ekf) {
        return INSOLE_ERR_NULL;
    }
    if (!ekf->aligned) {
        return refuse(ekf, INSOLE_ERR_STATE);
    }
    if (t_us <= ekf->t_us) {
        return refuse(ekf, INSOLE_ERR_TIME);
    }
    if (!insole_vec3_is_finite(velocity_mps) || !insole_is_finite(sigma_mps) || sigma_mps < ZERO) {
        return refuse(ekf, INSOLE_ERR_VALUE);
    }
    insole_real_t dt = (insole_real_t)(t_us - ekf->t_us) * INSOLE_R(1.0e-6);
    ekf->p_m = insole_vec3_add_scaled(ekf->p_m, dt, velocity_mps);
    ekf->v_mps = velocity_mps;
    insole_zupt_cov_t *P = &ekf->P;
    if (!ekf->coasting) {
        forget_motion(P);
        P->vv = insole_sym3_add_diagonal(P->vv, insole_square(sigma_mps));
    }
    P->pp = insole_sym3_add_scaled(insole_sym3_add_twice(P->pp, dt, P->pv), dt * dt, P->vv);
    P->pv = insole_mat3_add_scaled(P->pv, dt, insole_sym3_full(P->vv));
    ekf->coasting = true;
    ekf->t_us = t_us;
    return INSOLE_OK;
}
