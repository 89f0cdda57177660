/* SPDX-License-Identifier: MIT */
#include "insole/move/attitude.h"

#include <stddef.h>
#include <string.h>

#include "insole/move/heading.h"

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)

/* A tenth of a second of noise is not lost to rounding beside what ten days have gathered. */
static const insole_real_t BLOCK_S = INSOLE_R(0.1);

/* Variance of a direction of which nothing is known. */
static const insole_real_t MOST_VAR_RAD2 = INSOLE_PI * INSOLE_PI / INSOLE_R(3.0);

/* A gap that may hide a turn beyond this levels anew. */
static const insole_real_t MOST_BLIND_RAD = INSOLE_R(0.5);

/* 1-sigma of the heading after an upset: what turned the phone over turned it sideways too. */
static const insole_real_t UPSET_HEADING_RAD = INSOLE_R(1.0);

/* No hand and no field goes beyond; within, a day of nonsense stays finite. */
static const insole_real_t MOST_ACCEL_MPS2 = INSOLE_R(1.0e4), MOST_GYRO_RADPS = INSOLE_R(1.0e3);
static const insole_real_t MOST_SIGHTING = INSOLE_R(1.0e4), MOST_BIAS_RADPS = INSOLE_R(1.0);

const insole_attitude_config_t insole_attitude_defaults = {
    INSOLE_ATTITUDE_KEYS(INSOLE_CONFIG_DEFAULT)};

static insole_status_t refuse(insole_attitude_t *att, insole_status_t why)
{
    att->refused++;
    return why;
}

insole_status_t insole_attitude_check(const insole_attitude_config_t *config)
{
    typedef insole_attitude_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_ATTITUDE_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_attitude_init(insole_attitude_t *att,
                                                 const insole_attitude_config_t *config)
{
    if (!att || !config) {
        return INSOLE_ERR_NULL;
    }
    if (insole_attitude_check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(att, 0, sizeof *att);
    att->config = *config;
    att->q = insole_quat_identity();
    att->upset_cos =
        config->upset_rad < INSOLE_PI ? insole_turn(config->upset_rad).cos : -INSOLE_R(2.0);
    return INSOLE_OK;
}

/* A variance beyond the largest is scaled down with its row and column: P stays positive. */
static void bound_axis(insole_real_t *variance, insole_real_t *cov1, insole_real_t *cov2)
{
    if (*variance > MOST_VAR_RAD2) {
        insole_real_t shrink = insole_sqrt(MOST_VAR_RAD2 / *variance);
        *variance = MOST_VAR_RAD2;
        *cov1 *= shrink;
        *cov2 *= shrink;
    }
}

static void widen(insole_sym3_t *P, insole_sym3_t by_rad2)
{
    *P = insole_sym3_add(*P, by_rad2);
    bound_axis(&P->xx, &P->xy, &P->xz);
    bound_axis(&P->yy, &P->xy, &P->yz);
    bound_axis(&P->zz, &P->xz, &P->yz);
}

static void begin_levelling(insole_attitude_t *att, uint64_t t_us)
{
    att->levelling = true;
    att->level_us = t_us;
    att->up_count = 0u;
}

/* Up points where the mean force says. */
INSOLE_COLD static void level(insole_attitude_t *att)
{
    insole_vec3_t f_b = insole_quat_rotate_back(att->q, att->up_mps2);
    insole_real_t tilt_rad2 = insole_square(att->config.sigma_level_rad);
    att->q = insole_quat_level(att->q, f_b);
    att->up_mps2 = insole_vec3(ZERO, ZERO, insole_vec3_norm(f_b));
    att->P = insole_sym3_diagonal(tilt_rad2, tilt_rad2, att->P.zz);
}

/* Turns n: the attitude, the mean force and the tilt's covariance; the heading's own is lost. */
static void turn_heading(insole_attitude_t *att, insole_real_t heading_rad)
{
    insole_heading_t now = insole_heading(att->q, NULL);
    insole_real_t by_rad = heading_rad - now.heading_rad;
    insole_quat_t turn = insole_quat_from_yaw(by_rad);
    att->q = insole_quat_normalize(insole_quat_mul(turn, att->q));
    att->up_mps2 = insole_quat_rotate(turn, att->up_mps2);
    insole_turn_t t = insole_turn(by_rad);
    insole_sym3_t P = att->P;
    insole_vec3_t x = insole_vec3(t.cos, -t.sin, ZERO), y = insole_vec3(t.sin, t.cos, ZERO);
    insole_vec3_t Py = insole_sym3_mul_vec(P, y);
    att->P = insole_sym3_diagonal(insole_vec3_dot(x, insole_sym3_mul_vec(P, x)),
                                  insole_vec3_dot(y, Py), ZERO);
    att->P.xy = insole_vec3_dot(x, Py);
}

INSOLE_COLD static insole_status_t start(insole_attitude_t *att, const insole_imu_t *imu)
{
    insole_real_t g = att->config.gravity_mps2, f = insole_vec3_norm(imu->accel_mps2);
    if (!(f > HALF * g && f < INSOLE_R(2.0) * g)) {
        return refuse(att, INSOLE_ERR_STATE);
    }
    begin_levelling(att, imu->t_us);
    att->up_count = 1u;
    att->q = insole_quat_from_gravity(imu->accel_mps2);
    att->up_mps2 = insole_quat_rotate(att->q, imu->accel_mps2);
    level(att);
    turn_heading(att, ZERO);
    att->last_gyro_radps = insole_vec3_sub(imu->gyro_radps, att->gyro_bias_radps);
    att->t_us = imu->t_us;
    att->aligned = true;
    return INSOLE_OK;
}

/* A sample is the mean rate of its interval; with the coning term (w_prev x w) dt^2 / 12. */
static void turn(insole_attitude_t *att, insole_vec3_t rate, insole_real_t dt)
{
    insole_vec3_t coning = insole_vec3_cross(att->last_gyro_radps, rate);
    insole_vec3_t d = insole_vec3_add_scaled(insole_vec3_scale(rate, dt),
                                             dt * dt * (INSOLE_R(1.0) / INSOLE_R(12.0)), coning);
    insole_quat_t dq = insole_quat_from_rotvec(d); /* [PhoneEKF (7)], [PhoneUKF (9)] */
    /* q- = F q [PhoneEKF (9), (17)], [PhoneUKF (13)] */
    att->q = insole_quat_normalize(insole_quat_mul(att->q, dq));
}

/* Of a gyro whose axis m is at the end of its range. */
INSOLE_COLD static void gather_clip_noise(insole_attitude_t *att, const insole_mat3_t *C,
                                          uint32_t clipped, insole_real_t dt)
{
    insole_mat3_t axes = insole_mat3_transpose(*C);
    const insole_vec3_t *axis[3] = {&axes.r0, &axes.r1, &axes.r2};
    insole_real_t variance = insole_square(att->config.clip_noise_rad_rts) * dt;
    for (uint32_t m = 0u; m < 3u; m++) {
        insole_real_t on = (clipped >> m & 1u) != 0u ? INSOLE_R(1.0) : ZERO;
        att->waiting_rad2 = insole_sym3_add_outer(att->waiting_rad2, on * variance, *axis[m]);
    }
}

/* Xi Q Xi' of the 4x4 covariance: in n, white noise of the gyro is what it is in b. */
static void gather_noise(insole_attitude_t *att, const insole_mat3_t *C, insole_vec3_t rate,
                         uint32_t clipped, insole_real_t dt)
{
    const insole_attitude_config_t *c = &att->config;
    insole_real_t white = insole_square(c->gyro_noise_rad_rts) * dt; /* [PhoneEKF (10), (12)] */
    att->waiting_rad2 = insole_sym3_add_diagonal(att->waiting_rad2, white);
    att->waiting_rad2 =
        insole_sym3_add_outer(att->waiting_rad2, insole_square(c->gyro_turn_noise_rts) * dt,
                              insole_mat3_mul_vec(*C, rate));
    if ((clipped & 7u) != 0u) {
        gather_clip_noise(att, C, clipped, dt);
    }
    att->waiting_s += dt;
}

/* P- = F P F' + Q: seen from n, errors are not changed by a turn of b, and F P F' is P. */
INSOLE_COLD static void add_noise(insole_attitude_t *att)
{
    widen(&att->P, att->waiting_rad2); /* [PhoneEKF (18)], [PhoneUKF (13)] */
    att->waiting_rad2 = insole_sym3_zero();
    att->waiting_s = ZERO;
}

/* What an interval without samples may hide. */
INSOLE_COLD static void bridge(insole_attitude_t *att, insole_real_t gap_s, uint64_t t_us)
{
    insole_real_t blind_rad = gap_s * att->config.gap_turn_radps;
    insole_real_t variance = insole_min(insole_square(blind_rad), MOST_VAR_RAD2);
    widen(&att->P, insole_sym3_diagonal(variance, variance, variance));
    if (blind_rad > MOST_BLIND_RAD) {
        begin_levelling(att, t_us);
    }
    att->gaps++;
}

/* The mean force: of all samples of the levelling, then of the last seconds. */
static void follow_up(insole_attitude_t *att, insole_vec3_t force_n, insole_real_t dt)
{
    insole_real_t weight = insole_min(dt / att->config.upset_s, INSOLE_R(1.0));
    if (att->levelling) {
        att->up_count++;
        weight = INSOLE_R(1.0) / (insole_real_t)att->up_count;
    }
    insole_vec3_t apart = insole_vec3_sub(force_n, att->up_mps2);
    att->up_mps2 = insole_vec3_add_scaled(att->up_mps2, weight, apart);
}

static bool is_upset(const insole_attitude_t *att)
{
    insole_real_t up = insole_vec3_norm(att->up_mps2);
    return up > HALF * att->config.gravity_mps2 && att->up_mps2.z < up * att->upset_cos;
}

INSOLE_COLD static void recover(insole_attitude_t *att)
{
    insole_real_t lost = insole_square(UPSET_HEADING_RAD);
    level(att);
    widen(&att->P, insole_sym3_diagonal(ZERO, ZERO, lost));
    att->upsets++;
}

insole_real_t insole_trust_variance(const insole_trust_t *trust, insole_real_t deviation,
                                    insole_real_t dt_s)
{
    if (!(deviation < trust->gate)) {
        return ZERO;
    }
    /* [PhoneUKF (12)] */
    insole_real_t off = trust->soft > ZERO ? deviation / trust->soft : ZERO;
    return insole_square(trust->density) * (INSOLE_R(1.0) + off * off) / dt_s;
}

static insole_status_t correct(insole_attitude_t *att, insole_attitude_method_t *method,
                               const insole_sighting_t *sighting)
{
    insole_correction_t made;
    insole_status_t status = method(&att->P, sighting, &made);
    if (status != INSOLE_OK) {
        return INSOLE_ERR_STATE;
    }
    att->q = insole_quat_normalize(insole_quat_mul(made.turn, att->q)); /* [PhoneEKF (20)] */
    insole_vec3_t turn = insole_vec3(made.turn.x, made.turn.y, made.turn.z);
    att->up_mps2 =
        insole_vec3_add_scaled(att->up_mps2, INSOLE_R(2.0), insole_vec3_cross(turn, att->up_mps2));
    att->nis = made.nis;
    return INSOLE_OK;
}

static void correct_by_gravity(insole_attitude_t *att, insole_attitude_method_t *method,
                               insole_vec3_t force_n, insole_real_t dt)
{
    const insole_attitude_config_t *c = &att->config;
    insole_trust_t trust = {c->accel_noise_mps_rts, c->accel_soft_mps2, c->accel_gate_mps2};
    insole_real_t deviation = insole_abs(insole_vec3_norm(force_n) - c->gravity_mps2);
    insole_sighting_t gravity = {
        insole_vec3(ZERO, ZERO, c->gravity_mps2), force_n,
        insole_trust_variance(&trust, deviation, dt)}; /* [PhoneEKF (14)] */
    bool used = gravity.variance > ZERO && correct(att, method, &gravity) == INSOLE_OK;
    att->corrected += used ? 1u : 0u;
    att->passed += used ? 0u : 1u;
}

/* Gyro up to the sample, and what it felt, n. */
static insole_vec3_t predict(insole_attitude_t *att, const insole_imu_t *imu, uint32_t clipped)
{
    insole_vec3_t rate = insole_vec3_sub(imu->gyro_radps, att->gyro_bias_radps);
    insole_real_t dt = insole_seconds(att->t_us, imu->t_us);
    bool follows = dt <= att->config.gap_s;
    if (follows) {
        turn(att, rate, dt);
    }
    insole_mat3_t C = insole_quat_to_mat3(att->q);
    if (follows) {
        gather_noise(att, &C, rate, clipped, dt);
    } else {
        bridge(att, dt, imu->t_us);
    }
    if (att->waiting_s >= BLOCK_S) {
        add_noise(att);
    }
    att->last_gyro_radps = rate;
    return insole_mat3_mul_vec(C, imu->accel_mps2); /* [PhoneEKF (4), (13)], [PhoneUKF (7)] */
}

/* Gravity that was felt, over an interval `dt`. */
static void feel(insole_attitude_t *att, insole_attitude_method_t *method, insole_vec3_t force_n,
                 insole_real_t dt)
{
    follow_up(att, force_n, dt);
    if (att->levelling) {
        level(att);
        att->levelling = insole_seconds(att->level_us, att->t_us) < att->config.level_s;
    } else if (method) {
        correct_by_gravity(att, method, force_n, dt);
        if (is_upset(att)) {
            recover(att);
        }
    }
}

insole_status_t insole_attitude_push(insole_attitude_t *att, insole_attitude_method_t *method,
                                     const insole_imu_t *imu, uint32_t clipped)
{
    if (!att || !imu) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_vec3_is_within(imu->accel_mps2, MOST_ACCEL_MPS2) ||
        !insole_vec3_is_within(imu->gyro_radps, MOST_GYRO_RADPS)) {
        return refuse(att, INSOLE_ERR_VALUE);
    }
    if (!att->aligned) {
        return start(att, imu);
    }
    if (imu->t_us <= att->t_us) {
        return refuse(att, INSOLE_ERR_TIME);
    }
    insole_vec3_t force_n = predict(att, imu, clipped);
    insole_real_t dt = insole_min(insole_seconds(att->t_us, imu->t_us), att->config.gap_s);
    att->t_us = imu->t_us;
    feel(att, method, force_n, dt);
    return INSOLE_OK;
}

insole_status_t insole_attitude_observe(insole_attitude_t *att, insole_attitude_method_t *method,
                                        const insole_sighting_t *sighting)
{
    if (!att || !method || !sighting) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_vec3_is_within(sighting->known, MOST_SIGHTING) ||
        !insole_vec3_is_within(sighting->seen, MOST_SIGHTING) ||
        !(sighting->variance > ZERO && insole_is_finite(sighting->variance))) {
        return refuse(att, INSOLE_ERR_VALUE);
    }
    if (!att->aligned || att->levelling || correct(att, method, sighting) != INSOLE_OK) {
        return refuse(att, INSOLE_ERR_STATE);
    }
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_attitude_set_bias(insole_attitude_t *att,
                                                     insole_vec3_t gyro_bias_radps)
{
    if (!att) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_vec3_is_within(gyro_bias_radps, MOST_BIAS_RADPS)) {
        return refuse(att, INSOLE_ERR_VALUE);
    }
    insole_vec3_t step = insole_vec3_sub(gyro_bias_radps, att->gyro_bias_radps);
    att->last_gyro_radps = insole_vec3_sub(att->last_gyro_radps, step);
    att->gyro_bias_radps = gyro_bias_radps;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_attitude_set_heading(insole_attitude_t *att,
                                                        insole_real_t heading_rad,
                                                        insole_real_t sigma_rad)
{
    if (!att) {
        return INSOLE_ERR_NULL;
    }
    if (!(insole_abs(heading_rad) <= INSOLE_R(1.0e4) && sigma_rad >= ZERO &&
          sigma_rad <= INSOLE_PI)) {
        return refuse(att, INSOLE_ERR_VALUE);
    }
    if (!att->aligned) {
        return refuse(att, INSOLE_ERR_STATE);
    }
    add_noise(att);
    turn_heading(att, insole_wrap_pi(heading_rad));
    widen(&att->P, insole_sym3_diagonal(ZERO, ZERO, insole_square(sigma_rad)));
    return INSOLE_OK;
}

insole_sym3_t insole_attitude_covariance(const insole_attitude_t *att)
{
    return insole_sym3_add(att->P, att->waiting_rad2);
}

insole_status_t insole_attitude_fill(const insole_attitude_t *att, insole_step_t *step)
{
    if (!att || !step) {
        return INSOLE_ERR_NULL;
    }
    if (!att->aligned) {
        return INSOLE_ERR_STATE;
    }
    step->attitude = att->q;
    step->attitude_cov_rad2 = insole_attitude_covariance(att);
    return INSOLE_OK;
}
