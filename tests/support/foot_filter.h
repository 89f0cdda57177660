/** @file foot_filter.h  Filters on a foot, in the states that tests begin from.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_FOOT_FILTER_H
#define INSOLE_TESTS_FOOT_FILTER_H

#include "dense.h"
#include "gait.h"

enum { FILTER_STEP_US = 5000 };

static const insole_vec3_t FILTER_UP = {INSOLE_R(0.0), INSOLE_R(0.0), INSOLE_R(9.81)};

static inline insole_zupt_ekf_t filter_new(void)
{
    insole_zupt_ekf_t ekf;
    (void)insole_zupt_ekf_init(&ekf, &insole_zupt_ekf_defaults);
    return ekf;
}

static inline insole_zupt_ekf_t filter_aligned(void)
{
    insole_zupt_ekf_t ekf = filter_new();
    (void)insole_zupt_ekf_align(&ekf, FILTER_UP, INSOLE_R(0.01), INSOLE_R(0.0), 1000000u);
    return ekf;
}

/** The next sample, after FILTER_STEP_US. */
static inline insole_status_t filter_feel(insole_zupt_ekf_t *ekf, insole_vec3_t accel,
                                          insole_vec3_t gyro)
{
    insole_imu_t imu = {ekf->t_us + FILTER_STEP_US, accel, gyro};
    return insole_zupt_ekf_predict(ekf, &imu, 0u);
}

/** Somewhere in a swing, in any attitude, all states correlated, a sample already taken. */
static inline insole_zupt_ekf_t filter_swinging(insole_rng_t *rng)
{
    insole_zupt_ekf_t ekf = filter_aligned();
    ekf.q = sample_quat(rng);
    ekf.p_m = sample_vec3(rng, INSOLE_R(1.0));
    ekf.v_mps = sample_vec3(rng, INSOLE_R(0.3));
    ekf.accel_bias_mps2 = sample_vec3(rng, INSOLE_R(0.05));
    (void)filter_feel(&ekf, FILTER_UP, sample_vec3(rng, INSOLE_R(2.0)));
    (void)insole_zupt_ekf_settle(&ekf);
    dense_t P = dense_sample_cov(rng);
    ekf.P = dense_to_cov(&P);
    return ekf;
}

/** The filter's covariance as it is now, without touching the filter. */
static inline insole_zupt_cov_t filter_cov(const insole_zupt_ekf_t *ekf)
{
    insole_zupt_ekf_t copy = *ekf;
    (void)insole_zupt_ekf_settle(&copy);
    return copy.P;
}

/** Samples `from`..`to` of a walk, with the corrections of its stances; sample 0 ends after
 *  FILTER_STEP_US. */
static inline void filter_walk(insole_zupt_ekf_t *ekf, const gait_t *gait, int from, int to)
{
    const double dt = 1.0e-6 * FILTER_STEP_US;
    for (int k = from; k < to; k++) {
        d3_t force, rate;
        gait_reading(gait, dt * k, dt * (k + 1), &force, &rate);
        (void)filter_feel(ekf, real_of(force), real_of(rate));
        if (gait_is_still(gait, dt * k, dt * (k + 1))) {
            (void)insole_zupt_ekf_correct(ekf, ekf->dt_s, NULL);
        }
    }
}

#endif
