/** @file attitude.h  Attitude of a phone from gyro and gravity.
 *
 *  Source  [PhoneEKF] 3.1.2, eqs. (4)-(14), (17)-(18), (20); [PhoneUKF] 5.2, eqs. (7)-(13).
 *  Frames  b: phone, any mounting.  n: local level, z up; heading 0 at the start until told.
 *  State   q, b to n, and the covariance P of the small rotation a in n: R_true = (I + [a]x) R.
 *
 *  What both papers share is here: prediction by the gyro, the adaptive noise of what is seen, the
 *  start, gaps and upsets. What they differ in is the method that a direction corrects with:
 *  insole_attitude_ekf (attitude_ekf.h) or insole_attitude_ukf (attitude_ukf.h), or NULL: the gyro
 *  alone after a level start. Only the method that is named is linked.
 *
 *  The papers carry a 4x4 covariance of the quaternion. Held on the unit sphere, that is
 *  1/4 Xi P Xi' with the columns e_i q of Xi = dq/d(a/2): P says the same in 3x3, can not leave
 *  the sphere, and, seen from n, is not changed by a turn of the phone. A turn about the vertical
 *  changes no gravity that is seen, wherever the filter stands, so that gravity never feigns
 *  knowledge of the heading.
 *
 *      static insole_attitude_t phone;
 *      insole_attitude_init(&phone, &insole_attitude_defaults);
 *      on each sample:
 *          insole_attitude_push(&phone, insole_attitude_ekf, &imu, 0u);
 *          if (at rest) insole_attitude_set_bias(&phone, rest.gyro_bias_radps);
 *      on each step:
 *          insole_attitude_fill(&phone, &step);
 *          insole_heading_t heading = insole_heading(step.attitude, &step.attitude_cov_rad2);
 *
 *  The bias is learned at rest alone (zero attitude update, sense/still_bias.h): in motion it
 *  could not be told from turns. What is not known of it is no part of P: `gyro_noise_rad_rts` has
 *  to cover it over the walk.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_ATTITUDE_H
#define INSOLE_MOVE_ATTITUDE_H

#include "insole/base/config.h"
#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_ATTITUDE_KEYS(KEY)                                                                 \
    KEY(REAL, gravity_mps2, 9.81, 9.7, 9.9, "m/s^2", "gravity magnitude")                         \
    KEY(REAL, gyro_noise_rad_rts, 0.02, 1.0e-6, 1.0, "rad/sqrt(s)", "attitude random walk")       \
    KEY(REAL, gyro_turn_noise_rts, 0.01, 0.0, 1.0, "sqrt(s)",                                     \
        "attitude random walk about the turn's axis per turn rate (scale); 0 = off")              \
    KEY(REAL, clip_noise_rad_rts, 0.3, 0.0, 10.0, "rad/sqrt(s)",                                  \
        "attitude random walk about an axis whose gyro is clipped; 0 = off")                      \
    KEY(REAL, gap_s, 0.1, 0.01, 1.0, "s", "a longer interval is a gap: nothing is turned")        \
    KEY(REAL, gap_turn_radps, 0.5, 0.0, 100.0, "rad/s",                                           \
        "1-sigma of the turn rate that a gap hides")                                              \
    KEY(REAL, accel_noise_mps_rts, 0.3, 0.02, 100.0, "m/s/sqrt(s)",                               \
        "velocity random walk of a hand that carries: what is not gravity in a specific force")   \
    KEY(REAL, accel_soft_mps2, 1.0, 0.0, 100.0, "m/s^2",                                          \
        "deviation of |a| from gravity that doubles the variance; 0 = off")                       \
    KEY(REAL, accel_gate_mps2, 4.0, 0.01, 1000.0, "m/s^2",                                        \
        "deviation of |a| from gravity beyond which nothing is learned")         \
    KEY(REAL, level_s, 0.5, 0.0, 10.0, "s", "mean over this time levels the start")               \
    KEY(REAL, sigma_level_rad, 0.1, 1.0e-4, 1.0, "rad", "1-sigma of roll and pitch after it")     \
    KEY(REAL, upset_s, 1.0, 0.05, 60.0, "s", "time constant of the mean that finds an upset")     \
    KEY(REAL, upset_rad, 1.3, 0.1, 3.2, "rad",                                                    \
        "that mean this far from the vertical: levelled anew; 3.2 = never")
/* clang-format on */

typedef struct {
    INSOLE_ATTITUDE_KEYS(INSOLE_CONFIG_MEMBER)
} insole_attitude_config_t;

extern const insole_attitude_config_t insole_attitude_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_attitude_check(const insole_attitude_config_t *config);

/** A vector that is known in n, and how it looks from the estimated attitude. */
typedef struct {
    insole_vec3_t known, seen; /**< n; seen = R times what the sensor tells */
    insole_real_t variance;    /**< of each component of what is seen */
} insole_sighting_t;

/** What a sighting tells. */
typedef struct {
    insole_quat_t turn; /**< in n, that the attitude is to make; of any length */
    insole_real_t nis;  /**< normalised innovation squared */
} insole_correction_t;

/** How much a reading can be trusted. */
typedef struct {
    insole_real_t density; /**< noise density of one that fits, times the root of a second */
    insole_real_t soft;    /**< deviation that doubles the variance; 0: none does */
    insole_real_t gate;    /**< deviation beyond which the variance has no end */
} insole_trust_t;

/** Variance of a reading that stands for `dt_s`; 0 for one without end. */
insole_real_t insole_trust_variance(const insole_trust_t *trust, insole_real_t deviation,
                                    insole_real_t dt_s);

/** How a method corrects: P becomes that after the correction.
 *  @return INSOLE_ERR_STATE, all untouched, when the numbers do not allow it */
typedef insole_status_t insole_attitude_method_t(insole_sym3_t *P,
                                                 const insole_sighting_t *sighting,
                                                 insole_correction_t *correction);

typedef struct {
    insole_attitude_config_t config;
    bool aligned;
    bool levelling;             /**< the mean that levels is not complete */
    uint64_t t_us, level_us;    /**< of the newest sample; of the first of the levelling */
    insole_quat_t q;            /**< b to n */
    insole_sym3_t P;            /**< [rad^2] of the small rotation in n, but for what waits */
    insole_sym3_t waiting_rad2; /**< noise: singly it would be lost to rounding within hours */
    insole_real_t waiting_s;    /**< time it belongs to */
    insole_vec3_t gyro_bias_radps, last_gyro_radps; /**< b; the latter without the former */
    insole_vec3_t up_mps2;                          /**< n, mean specific force */
    uint32_t up_count;                              /**< samples of the levelling */
    insole_real_t upset_cos;
    insole_real_t nis;          /**< of the last correction */
    uint32_t corrected, passed; /**< samples whose gravity was used, and was not trusted */
    uint32_t gaps, upsets, refused;
} insole_attitude_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_attitude_init(insole_attitude_t *att,
                                     const insole_attitude_config_t *config);

/** Turns with the gyro and, with a method, corrects by gravity. The first sample whose specific
 *  force is between half and twice gravity is the start.
 *  @param method   NULL: the gyro alone
 *  @param imu      gyro as read
 *  @param clipped  bit m set: the gyro of body axis m is at the end of its range
 *  @return INSOLE_ERR_STATE for a sample that can not be the start; INSOLE_ERR_TIME;
 *          INSOLE_ERR_VALUE for a component beyond 1e4 m/s^2 or 1e3 rad/s */
insole_status_t insole_attitude_push(insole_attitude_t *att, insole_attitude_method_t *method,
                                     const insole_imu_t *imu, uint32_t clipped);

/** Corrects by another direction that is known in n, with the attitude of the newest sample;
 *  `sighting->seen` is what the sensor tells, turned by `q`.
 *  @return INSOLE_ERR_STATE before the start is level or when the method refuses;
 *          INSOLE_ERR_VALUE for vectors beyond 1e4 or a variance that is not positive */
insole_status_t insole_attitude_observe(insole_attitude_t *att, insole_attitude_method_t *method,
                                        const insole_sighting_t *sighting);

/** The gyro reads this at rest.
 *  @return INSOLE_ERR_VALUE beyond 1 rad/s */
insole_status_t insole_attitude_set_bias(insole_attitude_t *att, insole_vec3_t gyro_bias_radps);

/** Turns n about its vertical so that the phone's heading becomes `heading_rad`.
 *  @param sigma_rad  0..pi
 *  @return INSOLE_ERR_STATE before the start, INSOLE_ERR_VALUE */
insole_status_t insole_attitude_set_heading(insole_attitude_t *att, insole_real_t heading_rad,
                                            insole_real_t sigma_rad);

/** Covariance of the small rotation in n [rad^2]. */
insole_sym3_t insole_attitude_covariance(const insole_attitude_t *att);

/** Attitude and covariance of a step; its other members stay.
 *  @return INSOLE_ERR_STATE, the step untouched, before the start */
insole_status_t insole_attitude_fill(const insole_attitude_t *att, insole_step_t *step);

#ifdef __cplusplus
}
#endif

#endif
