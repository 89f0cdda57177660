/** @file still_bias.h  Gyro bias and gravity from moments of real rest.
 *
 *  A stance is not a rest: the foot rolls while it stands, and a bias learned there is wrong. The
 *  stream is cut into blocks of an eighth of a second; only two blocks in a row that are quiet and
 *  agree with each other count, and the less they agree the less they count. Both are judged by
 *  lengths of vectors, so that a turned sensor learns the same. Samples come at 256 Hz at most, as
 *  screen.h sees to: a faster sensor has to lie the quieter.
 *
 *  Frames  b: sensor, any mounting.
 *
 *      static insole_still_bias_t rest;
 *      insole_still_bias_init(&rest, &insole_still_bias_defaults);
 *      on each sample:
 *          insole_still_bias_push(&rest, &imu);
 *          gyro = insole_vec3_sub(imu.gyro_radps, rest.gyro_bias_radps);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_STILL_BIAS_H
#define INSOLE_SENSE_STILL_BIAS_H

#include "insole/base/config.h"
#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_STILL_BIAS_KEYS(KEY)                                                               \
    KEY(REAL, block_s, 0.125, 0.02, 2.0, "s", "length of a block")                                \
    KEY(REAL, quiet_gyro_radps, 0.035, 0.0, 1.0, "rad/s",                                         \
        "largest standard deviation of the gyro at rest, all axes; 0 = no bias is learned")       \
    KEY(REAL, quiet_accel_mps2, 0.14, 0.0, 10.0, "m/s^2",                                         \
        "largest standard deviation of the accelerometer at rest, all axes")                      \
    KEY(REAL, agree_radps, 0.018, 0.0, 1.0, "rad/s",                                              \
        "largest difference of the gyro means of two blocks in a row")                            \
    KEY(REAL, agree_mps2, 0.08, 0.0, 10.0, "m/s^2",                                               \
        "and of their accelerometer means: a foot that rolls turns gravity, a bias does not")     \
    KEY(REAL, sigma_bias_radps, 0.015, 1.0e-6, 1.0, "rad/s",                                      \
        "1-sigma of the bias when switched on")                                                   \
    KEY(REAL, bias_walk_radps_rts, 2.0e-4, 0.0, 0.1, "rad/s/sqrt(s)", "random walk of the bias")  \
    KEY(REAL, sigma_block_radps, 0.0015, 1.0e-6, 1.0, "rad/s",                                    \
        "1-sigma of the mean of two blocks that agree perfectly")                                 \
    KEY(REAL, agree_weight, 2.3, 0.0, 100.0, "",                                                  \
        "how much their difference adds to it")                                                   \
    KEY(REAL, gravity_s, 4.0, 0.0, 3600.0, "s",                                                   \
        "rests this soon after the first sample tell the magnitude of gravity; 0 = never")        \
    KEY(REAL, gravity_mps2, 9.81, 9.7, 9.9, "m/s^2", "gravity magnitude without such a rest")
/* clang-format on */

typedef struct {
    INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_MEMBER)
} insole_still_bias_config_t;

extern const insole_still_bias_config_t insole_still_bias_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_still_bias_check(const insole_still_bias_config_t *config);

/** Sums over one block, and what became of them. Values are taken relative to the block's first
 *  sample, so that the squares do not drown in gravity. */
typedef struct {
    uint32_t begin_us; /**< low half of the stamp */
    insole_vec3_t accel0_mps2, gyro0_radps;
    insole_vec3_t accel, gyro;   /**< sums of differences to the first sample */
    insole_real_t accel2, gyro2; /**< sums of their squares, all axes */
    uint32_t count;
    bool lively; /**< it is no rest, whatever comes: nothing more is added to the sums */
} insole_still_block_t;

/** Means over one block and variances, those of all axes together. */
typedef struct {
    insole_vec3_t accel_mps2, gyro_radps;
    insole_real_t var_accel, var_gyro;
} insole_still_moments_t;

typedef struct {
    insole_still_bias_config_t config;
    uint32_t block_us;
    insole_vec3_t gyro_bias_radps;
    insole_vec3_t variance_radps2; /**< of the bias, per axis */
    insole_real_t gravity_mps2;
    uint64_t first_us, last_us;
    insole_still_block_t block;    /**< being filled */
    insole_still_moments_t before; /**< of the block before */
    bool has_before;               /**< there was one, no gap since, and it may have been quiet */
    uint32_t rests;                /**< times the bias was learned */
    uint32_t gravity_rests;        /**< of these, used for gravity */
    bool has_first;
    uint32_t refused;
} insole_still_bias_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_still_bias_init(insole_still_bias_t *rest,
                                       const insole_still_bias_config_t *config);

/** @return INSOLE_ERR_TIME, INSOLE_ERR_VALUE for a sample that is not finite */
insole_status_t insole_still_bias_push(insole_still_bias_t *rest, const insole_imu_t *imu);

/** The same for what is known to be welcome: a sample of screen.h that follows the last. Nothing is
 *  checked. */
void insole_still_bias_take(insole_still_bias_t *rest, const insole_imu_t *imu);

#ifdef __cplusplus
}
#endif

#endif
