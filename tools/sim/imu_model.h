/** @file imu_model.h  What a real sensor makes of specific force and turn rate.
 *
 *      reading = steps(clip(scale and misalignment x truth + bias + g sensitivity + noise))
 *
 *  bias = turn-on bias + Gauss-Markov drift + random walk + temperature. All amounts are drawn at
 *  init from the seed; each kind of randomness has its own sequence.
 *
 *      sim_imu_t imu;
 *      sim_imu_init(&imu, &settings.imu, seed);
 *      if (sim_imu_read(&imu, t_s, force_mps2, rate_radps, &sample)) ...    not lost
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_IMU_MODEL_H
#define INSOLE_SIM_IMU_MODEL_H

#include "insole/base/types.h"
#include "sim/algebra.h"
#include "sim/seeds.h"
#include "sim/settings.h"

/** One triad: what belongs to the accelerometer or to the gyroscope alone. */
typedef struct {
    sim_mat3_t gain;      /**< identity + scale and misalignment */
    sim_mat3_t per_force; /**< reading per specific force; zero for the accelerometer */
    sim_vec3_t turn_on;
    sim_vec3_t drift; /**< Gauss-Markov, now */
    sim_vec3_t walk;  /**< random walk, now */
    sim_vec3_t per_kelvin;
    double noise;                   /**< 1-sigma of a sample */
    double drift_sigma, walk_sigma; /**< drift's stationary sigma; the walk's growth per sample */
    double range, step;
} sim_triad_t;

typedef struct {
    sim_imu_settings_t settings;
    sim_triad_t accel, gyro;
    insole_rng_t noise_rng, drift_rng, stamp_rng;
    double drift_keep; /**< share of the drift that a sample interval leaves */
    double gap_end_s;  /**< samples before this are lost */
    uint64_t last_t_us;
    uint32_t given, lost; /**< samples */
    uint32_t clipped;     /**< samples with an axis at its range */
} sim_imu_t;

void sim_imu_init(sim_imu_t *imu, const sim_imu_settings_t *settings, uint64_t seed);

/** The sample at t >= 0; times must come one sample interval apart.
 *  @return false when the sample is lost, `sample` untouched */
bool sim_imu_read(sim_imu_t *imu, double t_s, sim_vec3_t force_mps2, sim_vec3_t rate_radps,
                  insole_imu_t *sample);

#endif
