/** @file phone.h  A phone in a hand, in double: how it turns, and what its sensors tell.
 *
 *  Attitudes are rotation matrices, turned by the exact rotation of each interval; nothing of the
 *  library but the random numbers.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_PHONE_H
#define INSOLE_TESTS_PHONE_H

#include "insole/base/rng.h"
#include "insole/base/types.h"
#include "motion.h"

typedef struct {
    d33_t R; /**< b to n */
    uint64_t t_us;
    double gyro_noise;  /**< rad/sqrt(s) */
    double accel_noise; /**< m/s/sqrt(s) */
    double shake;       /**< m/s^2, amplitude of a step's bounce in n */
    d3_t gyro_bias;
    insole_rng_t rng;
} phone_t;

static inline phone_t phone(d33_t R, uint64_t seed)
{
    phone_t p = {.R = R, .t_us = 1000000u};
    insole_rng_seed(&p.rng, seed);
    return p;
}

/** Rotation matrix of a rotation vector, by Rodrigues. */
static inline d33_t d33_exp(d3_t r)
{
    double angle = d3_norm(r), a = angle > 1.0e-9 ? sin(angle) / angle : 1.0;
    double b = angle > 1.0e-4 ? (1.0 - cos(angle)) / (angle * angle) : 0.5;
    d33_t E = {
        d3(1.0 - b * (r.y * r.y + r.z * r.z), b * r.x * r.y - a * r.z, b * r.x * r.z + a * r.y),
        d3(b * r.x * r.y + a * r.z, 1.0 - b * (r.x * r.x + r.z * r.z), b * r.y * r.z - a * r.x),
        d3(b * r.x * r.z - a * r.y, b * r.y * r.z + a * r.x, 1.0 - b * (r.x * r.x + r.y * r.y))};
    return E;
}

static inline d3_t phone_noise(phone_t *p, double sigma)
{
    double x = sigma * (double)insole_rng_normal(&p->rng);
    double y = sigma * (double)insole_rng_normal(&p->rng);
    return d3(x, y, sigma * (double)insole_rng_normal(&p->rng));
}

/** What the accelerometer tells now of an interval. */
static inline d3_t phone_force(phone_t *p, double dt)
{
    double t = (double)p->t_us * 1.0e-6, phase = 4.0 * 3.14159265358979323846 * t;
    d3_t n = d3(p->shake * 0.5 * sin(0.5 * phase), p->shake * 0.3 * cos(0.5 * phase),
                MOTION_G + p->shake * sin(phase));
    d3_t b = d33_apply(d33_transpose(p->R), n);
    return d3_add(b, p->accel_noise / sqrt(dt), phone_noise(p, 1.0));
}

/** The phone turns at the rate `w` (b) for `dt_us`. */
static inline insole_imu_t phone_sample(phone_t *p, d3_t w, uint32_t dt_us)
{
    double dt = dt_us * 1.0e-6;
    p->R = d33_mul(p->R, d33_exp(d3_scale(w, dt)));
    p->t_us += dt_us;
    d3_t gyro = d3_add(d3_add(w, 1.0, p->gyro_bias), p->gyro_noise / sqrt(dt), phone_noise(p, 1.0));
    insole_imu_t imu = {p->t_us, real_of(phone_force(p, dt)), real_of(gyro)};
    return imu;
}

/** Angle between the vertical of `q` and that of the phone [rad]. */
static inline double phone_tilt_error(const phone_t *p, insole_quat_t q)
{
    d33_t Q = d33_of(insole_quat_to_mat3(q));
    d3_t apart = d3_add(Q.r2, -1.0, p->R.r2);
    return 2.0 * asin(fmin(0.5 * d3_norm(apart), 1.0));
}

/** Small rotation in n that leads from `q` to the phone's attitude. */
static inline d3_t phone_error(const phone_t *p, insole_quat_t q)
{
    return turn_between(d33_of(insole_quat_to_mat3(q)), p->R);
}

#endif
