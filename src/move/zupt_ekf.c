/* SPDX-License-Identifier: MIT */
#include "insole/move/zupt_ekf.h"

#include <string.h>

#define ZERO  INSOLE_R(0.0)
#define SIXTH (INSOLE_R(1.0) / INSOLE_R(6.0))

/* Longer intervals are no sampling but a gap. */
static const uint32_t LONGEST_STEP_US = 1000000u;

/* The interval that sigma_zupt_mps speaks of. */
static const insole_real_t ZUPT_INTERVAL_S = INSOLE_R(0.005);
static const insole_real_t LONGEST_STILL_S = INSOLE_R(1.0);

/* No foot and no building goes beyond; within, a day of nonsense stays finite. */
static const insole_real_t MOST_ACCEL_MPS2 = INSOLE_R(1.5e4), MOST_GYRO_RADPS = INSOLE_R(1.5e3);
static const insole_real_t MOST_SPEED_MPS = INSOLE_R(1.0e3), MOST_HEIGHT_M = INSOLE_R(1.0e6);
static const insole_real_t LEAST_SIGMA_M = INSOLE_R(1.0e-4), MOST_SIGMA_M = INSOLE_R(1.0e4);

const insole_zupt_ekf_config_t insole_zupt_ekf_defaults = {
    INSOLE_ZUPT_EKF_KEYS(INSOLE_CONFIG_DEFAULT)};

INSOLE_COLD static insole_status_t refuse(insole_zupt_ekf_t *ekf, insole_status_t why)
{
    ekf->refused++;
    return why;
}

static bool has_bias(const insole_zupt_ekf_t *ekf)
{
    return INSOLE_ZUPT_STATES == 12 && ekf->config.sigma_accel_bias_mps2 > ZERO;
}

static void add_bias_var(insole_zupt_cov_t *P, insole_real_t var)
{
#if INSOLE_ZUPT_STATES == 12
    P->bb = insole_sym3_add_diagonal(P->bb, var);
#else
    (void)P, (void)var;
#endif
}

static void shift_bias(insole_zupt_ekf_t *ekf, insole_vec3_t shift_mps2)
{
#if INSOLE_ZUPT_STATES == 12
    ekf->accel_bias_mps2 = insole_vec3_add(ekf->accel_bias_mps2, shift_mps2);
#else
    (void)ekf, (void)shift_mps2;
#endif
}

static bool is_within(insole_vec3_t v, insole_real_t limit)
{
    return insole_abs(v.x) <= limit && insole_abs(v.y) <= limit && insole_abs(v.z) <= limit;
}

static void begin_trace(insole_zupt_ekf_t *ekf, insole_zupt_step_t step)
{
    ekf->trace.step = step;
    ekf->trace.q = insole_quat(ekf->q.w, ekf->q.x, ekf->q.y, ekf->q.z);
    ekf->trace.velocity_var_m2ps2 = ZERO;
    ekf->trace.height_var_m2 = ZERO;
}

insole_status_t insole_zupt_ekf_check(const insole_zupt_ekf_config_t *config)
{
    typedef insole_zupt_ekf_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_ZUPT_EKF_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_zupt_ekf_init(insole_zupt_ekf_t *ekf,
                                                 const insole_zupt_ekf_config_t *config)
{
    if (!ekf || !config) {
        return INSOLE_ERR_NULL;
    }
    if (insole_zupt_ekf_check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(ekf, 0, sizeof *ekf);
    ekf->config = *config;
    ekf->gravity_mps2 = config->gravity_mps2;
    ekf->q = insole_quat_identity();
    add_bias_var(&ekf->P, insole_square(config->sigma_accel_bias_mps2));
    return INSOLE_OK;
}

/* The covariance alone; noise waits for the end of its block. */
INSOLE_APART insole_status_t insole_zupt_ekf_settle(insole_zupt_ekf_t *ekf)
{
    static const insole_zupt_interval_t nothing;
    if (!ekf) {
        return INSOLE_ERR_NULL;
    }
    if (ekf->pending.time_s > ZERO) {
        insole_zupt_cov_propagate(&ekf->P, &ekf->pending, has_bias(ekf));
        ekf->pending = nothing;
    }
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_zupt_ekf_align(insole_zupt_ekf_t *ekf,
                                                  insole_vec3_t mean_accel_mps2,
                                                  insole_real_t sigma_tilt_rad,
                                                  insole_real_t yaw_rad, uint64_t t_us)
{
    if (!ekf) {
        return INSOLE_ERR_NULL;
    }
    insole_real_t length = insole_vec3_norm(mean_accel_mps2);
    bool plausible =
        length > INSOLE_R(0.5) * ekf->gravity_mps2 && length < INSOLE_R(2.0) * ekf->gravity_mps2;
    if (!plausible || !insole_is_finite(yaw_rad) ||
        !(sigma_tilt_rad >= ZERO && sigma_tilt_rad <= INSOLE_PI)) {
        return refuse(ekf, INSOLE_ERR_VALUE);
    }
    insole_quat_t level = insole_quat_from_gravity(mean_accel_mps2); /* [TwoOrder] table 1 */
    insole_real_t half = INSOLE_R(0.5) * insole_wrap_pi(yaw_rad);
    insole_quat_t turn = insole_quat_from_half(insole_vec3(ZERO, ZERO, half));
    ekf->q = insole_quat_normalize(insole_quat_mul(turn, level));
    ekf->v_mps = insole_vec3_zero();
    ekf->last_accel_mps2 = mean_accel_mps2;
    ekf->last_gyro_radps = insole_vec3_zero();
    insole_real_t tilt_var = insole_square(sigma_tilt_rad);
    (void)insole_zupt_ekf_settle(ekf);
    insole_zupt_cov_forget_motion(&ekf->P);
    ekf->P.aa = insole_sym3_diagonal(tilt_var, tilt_var, ekf->P.aa.zz);
    begin_trace(ekf, INSOLE_ZUPT_STEP_ALIGN);
    ekf->aligned = true;
    ekf->t_us = t_us;
    return INSOLE_OK;
}

/* What the sensor felt over the interval. A sample lies between the mean of its interval and the
 * value at its end, where the mean would be half way `back` to the sample before. */
static insole_vec3_t mean_of(insole_vec3_t now, insole_real_t part, insole_vec3_t back)
{
    return insole_vec3_add_scaled(now, part, back);
}

/* Turns by twice `half_rad`. */
static void turn(insole_zupt_ekf_t *ekf, insole_vec3_t half_rad)
{
    insole_real_t half2 = insole_vec3_norm2(half_rad);
    insole_quat_t dq = half2 < INSOLE_QUAT_SMALL_RAD2 ? insole_quat_from_small(half_rad, half2)
                                                      : insole_quat_from_half(half_rad);
    ekf->q = insole_quat_mul(ekf->q, dq); /* [TwoOrder (12)-(14)] */
}

/* Velocity and position, [TwoOrder (16)-(17)]; u: what the specific force adds to the velocity. */
static void move(insole_zupt_ekf_t *ekf, insole_vec3_t u, insole_real_t dt)
{
    insole_vec3_t before = ekf->v_mps;
    u.z -= ekf->gravity_mps2 * dt;
    ekf->v_mps = insole_vec3_add(before, u);
    insole_vec3_t twice = insole_vec3_add(before, ekf->v_mps);
    ekf->p_m = insole_vec3_add_scaled(ekf->p_m, INSOLE_R(0.5) * dt, twice);
}

/* Mechanisation. Of two samples, whose values change evenly, with w the mean turn rate, a the mean
 * specific force and b_w, b_a the ways back to the sample before:
 *     the half turn     half = w dt / 2, and with coning  half + cone x half,  cone = b_w dt / 12;
 *     the mean force seen from the attitude at the end    a + (a + b_a / 6) x (half - cone):
 * half the turn is taken back, and sculling added but for a share of the product of the ways.
 * What it did to the errors waits for the covariance. */
static void mechanise(insole_zupt_ekf_t *ekf, insole_vec3_t accel, insole_vec3_t gyro,
                      insole_real_t dt)
{
    insole_real_t part = INSOLE_R(0.5) * ekf->config.point_share, half_dt = INSOLE_R(0.5) * dt;
    insole_vec3_t back_accel = insole_vec3_sub(ekf->last_accel_mps2, accel);
    insole_vec3_t back_gyro = insole_vec3_sub(ekf->last_gyro_radps, gyro);
    insole_vec3_t cone = insole_vec3_scale(back_gyro, SIXTH * half_dt);
    insole_vec3_t half = insole_vec3_scale(mean_of(gyro, part, back_gyro), half_dt);
    insole_vec3_t mean = mean_of(accel, part, back_accel);
    insole_vec3_t a = insole_vec3_add_scaled(mean, SIXTH, back_accel);
    insole_vec3_t force = insole_vec3_add(mean, insole_vec3_cross(a, insole_vec3_sub(half, cone)));
    ekf->last_accel_mps2 = accel;
    ekf->last_gyro_radps = gyro;
    turn(ekf, insole_vec3_add(half, insole_vec3_cross(cone, half)));
    insole_mat3_t C = insole_quat_to_mat3(ekf->q);
    ekf->force_mps2 = insole_mat3_mul_vec(C, force);
    insole_vec3_t u = insole_vec3_scale(ekf->force_mps2, dt);
    move(ekf, u, dt);
    insole_zupt_interval_add(&ekf->pending, u, &C, dt, has_bias(ekf));
}

INSOLE_COLD static void add_clip_noise(insole_zupt_ekf_t *ekf, uint32_t clipped)
{
    insole_mat3_t axes = insole_mat3_transpose(insole_quat_to_mat3(ekf->q));
    const insole_vec3_t *axis[3] = {&axes.r0, &axes.r1, &axes.r2};
    insole_real_t var = insole_square(ekf->config.clip_noise_rad_rts) * ekf->dt_s;
    (void)insole_zupt_ekf_settle(ekf);
    for (uint32_t m = 0u; m < 3u; m++) {
        insole_real_t var_m = (clipped >> m & 1u) != 0u ? var : ZERO;
        ekf->P.aa = insole_sym3_add_outer(ekf->P.aa, var_m, *axis[m]);
    }
}

/* What Q of table 1 grows with, put aside until a block is full. */
static void gather_noise(insole_zupt_ekf_t *ekf, insole_real_t turn2, insole_real_t dt)
{
    ekf->noise.time_s += dt;
    ekf->noise.turned_rad2ps += turn2 * dt;
}

static void add_noise(insole_zupt_ekf_t *ekf)
{
    const insole_zupt_ekf_config_t *c = &ekf->config;
    insole_zupt_noise_t *noise = &ekf->noise;
    insole_real_t attitude = insole_square(c->gyro_noise_rad_rts) * noise->time_s +
                             insole_square(c->gyro_turn_noise_rts) * noise->turned_rad2ps;
    insole_real_t velocity = insole_square(c->accel_noise_mps_rts) * noise->time_s;
    ekf->P.vv = insole_sym3_add_diagonal(ekf->P.vv, velocity);
    ekf->P.aa = insole_sym3_add_diagonal(ekf->P.aa, attitude);
    if (has_bias(ekf)) {
        add_bias_var(&ekf->P, insole_square(c->accel_bias_walk_mps2_rts) * noise->time_s);
    }
    noise->time_s = noise->turned_rad2ps = ZERO;
    noise->samples = 0u;
}

/* Rounding has had no time to be seen in the quaternion's length. */
INSOLE_FLAT static void end_block(insole_zupt_ekf_t *ekf)
{
    (void)insole_zupt_ekf_settle(ekf);
    add_noise(ekf);
    insole_quat_t q = insole_quat_unit(ekf->q);
    ekf->q = ekf->trace.q = q;
}

INSOLE_FLAT insole_status_t insole_zupt_ekf_predict(insole_zupt_ekf_t *ekf, const insole_imu_t *imu,
                                                    uint32_t clipped)
{
    if (!ekf || !imu) {
        return INSOLE_ERR_NULL;
    }
    if (!ekf->aligned) {
        return refuse(ekf, INSOLE_ERR_STATE);
    }
    uint64_t step_us = imu->t_us - ekf->t_us; /* beyond all when time went back */
    if (step_us >> 32 != 0u || (uint32_t)step_us - 1u >= LONGEST_STEP_US) {
        return refuse(ekf, imu->t_us <= ekf->t_us ? INSOLE_ERR_TIME : INSOLE_ERR_VALUE);
    }
    insole_real_t turn2 = insole_vec3_norm2(imu->gyro_radps);
    if (!(insole_vec3_norm2(imu->accel_mps2) <= insole_square(MOST_ACCEL_MPS2) &&
          turn2 <= insole_square(MOST_GYRO_RADPS))) {
        return refuse(ekf, INSOLE_ERR_VALUE);
    }
    insole_real_t dt = (insole_real_t)(uint32_t)step_us * INSOLE_R(1.0e-6);
    ekf->dt_s = dt;
    ekf->t_us = imu->t_us;
    gather_noise(ekf, turn2, dt);
    insole_vec3_t accel = insole_vec3_sub(imu->accel_mps2, insole_zupt_ekf_accel_bias(ekf));
    mechanise(ekf, accel, imu->gyro_radps, dt);
    begin_trace(ekf, INSOLE_ZUPT_STEP_PREDICT);
    if (clipped != 0u) {
        add_clip_noise(ekf, clipped);
    }
    if (++ekf->noise.samples >= INSOLE_ZUPT_BLOCK) {
        end_block(ekf);
    }
    return INSOLE_OK;
}

/* (28)-(31): the nominal state takes the error, whose estimate is zero again. */
static void inject(insole_zupt_ekf_t *ekf, const insole_zupt_error_t *dx, bool biased)
{
    if (biased) {
        shift_bias(ekf, dx->b);
    }
    ekf->p_m = insole_vec3_add(ekf->p_m, dx->p); /* [TwoOrder (29)] */
    ekf->v_mps = insole_vec3_add(ekf->v_mps, dx->v);
    /* (2I + Omega)(2I - Omega)^-1 is the rotation of the quaternion (1, a/2) made unit. */
    insole_vec3_t half = insole_vec3_scale(dx->a, INSOLE_R(0.5));
    insole_quat_t cayley = insole_quat(INSOLE_R(1.0), half.x, half.y, half.z);
    ekf->q = insole_quat_unit(insole_quat_mul(cayley, ekf->q)); /* [TwoOrder (30)-(31)] */
}

/* Velocity of a sensor at roll_height_m over the line on which the foot rolls. */
static insole_vec3_t rolling_velocity(const insole_zupt_ekf_t *ekf)
{
    insole_vec3_t w = insole_quat_rotate(ekf->q, ekf->last_gyro_radps);
    insole_real_t h = ekf->config.roll_height_m;
    return insole_vec3(w.y * h, -w.x * h, ZERO); /* w x (0, 0, h) */
}

INSOLE_FLAT insole_status_t insole_zupt_ekf_correct(insole_zupt_ekf_t *ekf, insole_real_t still_s,
                                                    insole_real_t *nis)
{
    if (!ekf) {
        return INSOLE_ERR_NULL;
    }
    if (!ekf->aligned || !(ekf->dt_s > ZERO)) {
        return refuse(ekf, INSOLE_ERR_STATE);
    }
    if (!(still_s > ZERO && still_s <= LONGEST_STILL_S)) {
        return refuse(ekf, INSOLE_ERR_VALUE);
    }
    (void)insole_zupt_ekf_settle(ekf);
    insole_real_t r = insole_square(ekf->config.sigma_zupt_mps) * ZUPT_INTERVAL_S / still_s;
    insole_sym3_t S = insole_sym3_add_diagonal(ekf->P.vv, r); /* H P H' + R, [TwoOrder (23)] */
    insole_sym3_t W;                                          /* S^-1 */
    if (!insole_sym3_inverse(S, &W)) {
        return refuse(ekf, INSOLE_ERR_STATE);
    }
    /* z = -H x [TwoOrder (27)]: what the rolling foot does less what the state says. */
    ekf->trace.velocity_mps = rolling_velocity(ekf);
    ekf->trace.velocity_var_m2ps2 = r;
    insole_vec3_t z = insole_vec3_sub(ekf->trace.velocity_mps, ekf->v_mps);
    if (nis) {
        *nis = insole_vec3_dot(z, insole_sym3_mul_vec(W, z)); /* z' S^-1 z */
    }
    bool biased = has_bias(ekf);
    insole_zupt_error_t dx = insole_zupt_cov_correct_velocity(&ekf->P, W, r, z, biased);
    inject(ekf, &dx, biased);
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_zupt_ekf_correct_height(insole_zupt_ekf_t *ekf,
                                                           insole_real_t height_m,
                                                           insole_real_t sigma_m)
{
    if (!ekf) {
        return INSOLE_ERR_NULL;
    }
    if (!ekf->aligned) {
        return refuse(ekf, INSOLE_ERR_STATE);
    }
    if (!(insole_abs(height_m) <= MOST_HEIGHT_M && sigma_m >= LEAST_SIGMA_M &&
          sigma_m <= MOST_SIGMA_M)) {
        return refuse(ekf, INSOLE_ERR_VALUE);
    }
    (void)insole_zupt_ekf_settle(ekf);
    insole_real_t r = insole_square(sigma_m);
    insole_real_t per_s = INSOLE_R(1.0) / (ekf->P.pp.zz + r);
    insole_zupt_error_t column = insole_zupt_cov_of_height(&ekf->P);
    insole_zupt_error_t dx = insole_zupt_error_scale(column, (height_m - ekf->p_m.z) * per_s);
    insole_zupt_cov_correct_height(&ekf->P, r);
    inject(ekf, &dx, has_bias(ekf));
    ekf->trace.height_m = height_m;
    ekf->trace.height_var_m2 = r;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_zupt_ekf_coast(insole_zupt_ekf_t *ekf,
                                                  insole_vec3_t velocity_mps,
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
    if (!is_within(velocity_mps, MOST_SPEED_MPS) ||
        !(sigma_mps >= ZERO && sigma_mps <= MOST_SPEED_MPS)) {
        return refuse(ekf, INSOLE_ERR_VALUE);
    }
    (void)insole_zupt_ekf_settle(ekf);
    insole_zupt_cov_t *P = &ekf->P;
    insole_real_t dt = insole_seconds(ekf->t_us, t_us);
    if (ekf->trace.step != INSOLE_ZUPT_STEP_COAST) {
        insole_zupt_cov_forget_motion(P);
        P->vv = insole_sym3_add_diagonal(P->vv, insole_square(sigma_mps));
    }
    ekf->p_m = insole_vec3_add_scaled(ekf->p_m, dt, velocity_mps);
    ekf->v_mps = velocity_mps;
    const insole_zupt_interval_t interval = {.time_s = dt};
    insole_zupt_cov_propagate(P, &interval, false);
    ekf->t_us = t_us;
    begin_trace(ekf, INSOLE_ZUPT_STEP_COAST);
    return INSOLE_OK;
}
