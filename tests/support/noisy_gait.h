/** @file noisy_gait.h  A walk whose errors are just those that the filter believes in.
 *
 *  White noise on both sensors, a tilt of the first attitude, a bias that wanders; and since a
 *  correction says that the velocity of a still foot is zero but for noise, the foot trembles: its
 *  velocity in a stance is white, and the accelerometer feels that.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_NOISY_GAIT_H
#define INSOLE_TESTS_NOISY_GAIT_H

#include "foot_filter.h"

/** Readings of the gait itself, which all runs share. */
typedef struct {
    d3_t force, rate;
    moment_t end; /**< at the end of the interval */
    bool still;
} noisy_sample_t;

typedef struct {
    insole_rng_t rng;
    insole_zupt_ekf_t ekf;
    d3_t bias;           /**< true */
    d3_t tremble, drift; /**< true velocity and place beside the gait's */
    insole_real_t nis;   /**< of the last correction; 0 without one */
    int next;
} noisy_gait_t;

static inline d3_t noisy_normal(insole_rng_t *rng, double sigma)
{
    double x = sigma * (double)insole_rng_normal(rng), y = sigma * (double)insole_rng_normal(rng);
    return d3(x, y, sigma * (double)insole_rng_normal(rng));
}

static inline void noisy_gait_fill(noisy_sample_t *samples, int count, const gait_t *gait)
{
    const double dt = 1.0e-6 * FILTER_STEP_US;
    for (int k = 0; k < count; k++) {
        gait_reading(gait, dt * k, dt * (k + 1), &samples[k].force, &samples[k].rate);
        samples[k].end = gait_moment(gait, dt * (k + 1));
        samples[k].still = gait_is_still(gait, dt * k, dt * (k + 1));
    }
}

/** Settings under which the filter's model is that of the walk. */
static inline insole_zupt_ekf_config_t noisy_gait_config(void)
{
    insole_zupt_ekf_config_t config = insole_zupt_ekf_defaults;
    config.point_share = INSOLE_R(0.0);
    config.roll_height_m = INSOLE_R(0.0);
    config.gyro_turn_noise_rts = INSOLE_R(0.0);
    return config;
}

static inline void noisy_gait_begin(noisy_gait_t *run, const gait_t *gait, uint64_t seed)
{
    insole_zupt_ekf_config_t config = noisy_gait_config();
    moment_t m = gait_moment(gait, 0.0);
    insole_rng_seed(&run->rng, seed);
    d3_t tilt = noisy_normal(&run->rng, (double)config.sigma_tilt_rad);
    tilt.z = 0.0;
    motion_put(&run->ekf, &config, &m, 1000000u);
    insole_quat_t wrong = insole_quat_from_rotvec(real_of(d3_scale(tilt, -1.0)));
    run->ekf.q = insole_quat_normalize(insole_quat_mul(wrong, run->ekf.q));
    run->bias = noisy_normal(&run->rng, (double)config.sigma_accel_bias_mps2);
    run->tremble = run->drift = d3(0.0, 0.0, 0.0);
    run->nis = INSOLE_R(0.0);
    run->next = 0;
}

/** One sample: noise, prediction, and the correction of a stance. */
static inline void noisy_gait_step(noisy_gait_t *run, const noisy_sample_t *samples)
{
    const insole_zupt_ekf_config_t *c = &run->ekf.config;
    const double dt = 1.0e-6 * FILTER_STEP_US, per_rt = 1.0 / sqrt(dt);
    const noisy_sample_t *s = &samples[run->next++];
    d3_t before = run->tremble;
    run->tremble = noisy_normal(&run->rng, s->still ? (double)c->sigma_zupt_mps : 0.0);
    run->drift = d3_add(run->drift, 0.5 * dt, d3_add(before, 1.0, run->tremble));
    d3_t shaken = d3_scale(d3_add(run->tremble, -1.0, before), 1.0 / dt);
    d3_t accel = d3_add(s->force, 1.0, d33_apply(d33_transpose(s->end.R), shaken));
    run->bias =
        d3_add(run->bias, sqrt(dt), noisy_normal(&run->rng, (double)c->accel_bias_walk_mps2_rts));
    accel = d3_add(accel, 1.0, run->bias);
    accel = d3_add(accel, per_rt, noisy_normal(&run->rng, (double)c->accel_noise_mps_rts));
    d3_t gyro = d3_add(s->rate, per_rt, noisy_normal(&run->rng, (double)c->gyro_noise_rad_rts));
    (void)filter_feel(&run->ekf, real_of(accel), real_of(gyro));
    run->nis = INSOLE_R(0.0);
    if (s->still) {
        (void)insole_zupt_ekf_correct(&run->ekf, run->ekf.dt_s, &run->nis);
    }
}

/** True less estimated state, as the covariance has it. */
static inline column_t noisy_gait_error(const noisy_gait_t *run, const moment_t *truth, d3_t p_m,
                                        d3_t v_mps, d33_t C)
{
    d3_t p = d3_add(d3_add(truth->p, 1.0, run->drift), -1.0, p_m);
    d3_t v = d3_add(d3_add(truth->v, 1.0, run->tremble), -1.0, v_mps);
    d3_t a = turn_between(C, truth->R);
    d3_t b = d3_add(run->bias, -1.0, d3_of(run->ekf.accel_bias_mps2));
    column_t x = {{p.x, p.y, p.z, v.x, v.y, v.z, a.x, a.y, a.z, b.x, b.y, b.z}};
    return x;
}

#endif
