/** @file zupt_ekf.h  Foot-mounted inertial navigation with zero-velocity updates.
 *
 *  Source  [TwoOrder] 3.1, eqs. 12-31, tables 1-2, with the slips of the paper mended.
 *  Frames  b: sensor on the shoe, any mounting.  n: local level, z up.
 *  State   p v q and, if wanted, the accelerometer's bias b; the filter estimates their error
 *          dx = [dp dv da db], eq. (18): p and v additive, R_true = (I + [da]x) R, b additive.
 *          Nine states when `sigma_accel_bias_mps2` is 0, twelve otherwise; a library that is
 *          compiled with INSOLE_ZUPT_STATES 9 has no other (zupt_cov.h).
 *
 *      static insole_zupt_ekf_t foot;
 *      insole_zupt_ekf_init(&foot, &insole_zupt_ekf_defaults);
 *      insole_zupt_ekf_align(&foot, mean_accel_while_standing_mps2, sigma_tilt_rad, yaw_rad, t_us);
 *      on each sample:
 *          insole_zupt_ekf_predict(&foot, &imu, 0);
 *          if (still) insole_zupt_ekf_correct(&foot, foot.dt_s, &nis);
 *      before the covariance is read: insole_zupt_ekf_settle(&foot);
 *
 *  The covariance is kept in its 3x3 blocks (zupt_cov.h), and carried on for up to eight samples at
 *  once: that takes most of what a sample costs off it.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_ZUPT_EKF_H
#define INSOLE_MOVE_ZUPT_EKF_H

#include "insole/base/config.h"
#include "insole/base/types.h"
#include "insole/move/zupt_cov.h"

#ifdef __cplusplus
extern "C" {
#endif

#if INSOLE_ZUPT_STATES == 12
#define INSOLE_ZUPT_BIAS_MPS2      0.05
#define INSOLE_ZUPT_BIAS_MOST_MPS2 1.0
#else
#define INSOLE_ZUPT_BIAS_MPS2      0.0
#define INSOLE_ZUPT_BIAS_MOST_MPS2 0.0
#endif

/* clang-format off */
#define INSOLE_ZUPT_EKF_KEYS(KEY)                                                                 \
    KEY(REAL, gravity_mps2, 9.81, 9.7, 9.9, "m/s^2",                                              \
        "gravity magnitude until a rest has told it")                                             \
    KEY(REAL, sigma_tilt_rad, 0.01, 0.0001, 1.0, "rad",                                           \
        "1-sigma of roll and pitch after alignment on a standing foot")                           \
    KEY(REAL, accel_noise_mps_rts, 0.04, 0.0001, 10.0, "m/s/sqrt(s)",                             \
        "velocity random walk: sensor noise and all that a first-order filter leaves out")        \
    KEY(REAL, point_share, 0.25, 0.0, 1.0, "",                                                    \
        "what a sample is: 0 = the mean over its interval, 1 = the value at its stamp")           \
    KEY(REAL, gyro_noise_rad_rts, 5.0e-4, 1.0e-6, 1.0, "rad/sqrt(s)",                             \
        "attitude random walk at rest")                                                           \
    KEY(REAL, gyro_turn_noise_rts, 1.5e-4, 0.0, 0.1, "sqrt(s)",                                   \
        "attitude random walk per turn rate (scale, misalignment); 0 = off")                      \
    KEY(REAL, clip_noise_rad_rts, 0.02, 0.0, 10.0, "rad/sqrt(s)",                                 \
        "attitude random walk about an axis whose gyro is clipped; 0 = off")                      \
    KEY(REAL, sigma_accel_bias_mps2, INSOLE_ZUPT_BIAS_MPS2, 0.0, INSOLE_ZUPT_BIAS_MOST_MPS2,       \
        "m/s^2",                                                                                  \
        "1-sigma of the accelerometer bias at the start; 0 = nine states, no bias")               \
    KEY(REAL, accel_bias_walk_mps2_rts, 1.0e-4, 0.0, 0.1, "m/s^2/sqrt(s)",                        \
        "random walk of the accelerometer bias")                                                  \
    KEY(REAL, sigma_zupt_mps, 0.028, 0.0001, 1.0, "m/s",                                           \
        "1-sigma of a stance's velocity over 5 ms; other intervals in proportion")                \
    KEY(REAL, roll_height_m, 0.09, 0.0, 0.5, "m",                                                 \
        "height of the sensor over the line the foot rolls on; 0 = a stance stands still")
/* clang-format on */

typedef struct {
    INSOLE_ZUPT_EKF_KEYS(INSOLE_CONFIG_MEMBER)
} insole_zupt_ekf_config_t;

extern const insole_zupt_ekf_config_t insole_zupt_ekf_defaults;

/** So many samples at most wait for the covariance. Long enough that their yaw noise is not lost to
 *  rounding beside a day's yaw variance, short enough that noise of a swing still turns into
 *  velocity within the swing. */
enum { INSOLE_ZUPT_BLOCK = 8 };

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_zupt_ekf_check(const insole_zupt_ekf_config_t *config);

/** What process noise grows with, waiting to be added: singly it would be lost to rounding within
 *  hours. */
typedef struct {
    insole_real_t time_s;
    insole_real_t turned_rad2ps; /**< square of the turn rate, summed over the time */
    uint32_t samples;
} insole_zupt_noise_t;

/** How the state came to where it is. */
typedef enum {
    INSOLE_ZUPT_STEP_ALIGN = 0,   /**< found anew */
    INSOLE_ZUPT_STEP_PREDICT = 1, /**< from the state before, by a sample */
    INSOLE_ZUPT_STEP_COAST = 2    /**< carried on without samples */
} insole_zupt_step_t;

/** What the last sample did: all that a smoother needs to know besides the state. */
typedef struct {
    insole_zupt_step_t step;
    insole_quat_t q;                  /**< attitude between prediction and correction */
    insole_vec3_t velocity_mps;       /**< of the rolling foot, as it was measured, n */
    insole_real_t velocity_var_m2ps2; /**< its variance on each axis; 0: no such correction */
    insole_real_t height_m;           /**< as it was told */
    insole_real_t height_var_m2;      /**< its variance; 0: no such correction */
} insole_zupt_trace_t;

typedef struct {
    insole_zupt_ekf_config_t config;
    uint64_t t_us;      /**< of the last sample */
    insole_real_t dt_s; /**< of the last interval */
    insole_real_t gravity_mps2;
    insole_vec3_t p_m, v_mps; /**< n */
    insole_quat_t q;          /**< b to n */
#if INSOLE_ZUPT_STATES == 12
    insole_vec3_t accel_bias_mps2; /**< b */
#endif
    insole_vec3_t force_mps2; /**< n, mean specific force of the last interval */
    insole_vec3_t last_accel_mps2, last_gyro_radps; /**< b, of the last sample, bias removed */
    insole_zupt_cov_t P;                            /**< before `pending` */
    insole_zupt_interval_t pending; /**< the newest samples, which P has not seen yet */
    insole_zupt_noise_t noise;
    insole_zupt_trace_t trace;
    uint32_t refused; /**< calls answered with a negative status */
    bool aligned;
} insole_zupt_ekf_t;

/** What is taken off a sample, b; none with nine states. */
static inline insole_vec3_t insole_zupt_ekf_accel_bias(const insole_zupt_ekf_t *ekf)
{
#if INSOLE_ZUPT_STATES == 12
    const insole_vec3_t *bias = &ekf->accel_bias_mps2;
    return insole_vec3(bias->x, bias->y, bias->z); /* no copy in memory */
#else
    (void)ekf;
    return insole_vec3_zero();
#endif
}

/** Position zero, not aligned.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_zupt_ekf_init(insole_zupt_ekf_t *ekf,
                                     const insole_zupt_ekf_config_t *config);

/** Roll and pitch from the specific force of a standing foot, [TwoOrder] table 1; yaw becomes
 *  `yaw_rad`, velocity zero, position stays. Covariance: position and yaw as before alignment (zero
 *  at the first), velocity known, tilt `sigma_tilt_rad`.
 *  @param mean_accel_mps2 b; its length must lie between a half and twice gravity
 *  @param sigma_tilt_rad  0..pi
 *  @return INSOLE_ERR_VALUE */
insole_status_t insole_zupt_ekf_align(insole_zupt_ekf_t *ekf, insole_vec3_t mean_accel_mps2,
                                      insole_real_t sigma_tilt_rad, insole_real_t yaw_rad,
                                      uint64_t t_us);

/** Mechanisation (12)-(17) and covariance (19)-(24) up to `imu->t_us`.
 *  @param imu  gyro bias already removed
 *  @param clipped bit m set: the gyro of body axis m is at the end of its range
 *  @return INSOLE_ERR_STATE before alignment, INSOLE_ERR_TIME, INSOLE_ERR_VALUE (more than
 *          1.5e4 m/s^2 or 1.5e3 rad/s, or a step of more than one second: use
 *          insole_zupt_ekf_coast) */
insole_status_t insole_zupt_ekf_predict(insole_zupt_ekf_t *ekf, const insole_imu_t *imu,
                                        uint32_t clipped);

/** The covariance comes up to the last sample. Corrections do so by themselves.
 *  @return INSOLE_ERR_NULL */
insole_status_t insole_zupt_ekf_settle(insole_zupt_ekf_t *ekf);

/** Zero-velocity correction (22)-(31): the foot rolls over the ground below the sensor. At most one
 *  per sample.
 *  @param still_s   what it speaks for: the time since the last one, or since the foot stands; up
 *                   to 1 s. As sure as `sigma_zupt_mps` for 5 ms, and more so for longer.
 *  @param[out] nis  normalised innovation squared, chi2(3) when consistent; NULL to skip
 *  @return INSOLE_ERR_STATE before alignment or when the innovation's covariance is not positive
 *          (then P has come up to the last sample), INSOLE_ERR_VALUE for a time out of its range */
insole_status_t insole_zupt_ekf_correct(insole_zupt_ekf_t *ekf, insole_real_t still_s,
                                        insole_real_t *nis);

/** Correction by a known height: z = `height_m` with 1-sigma `sigma_m`. At most one per sample.
 *  @return INSOLE_ERR_STATE before alignment, INSOLE_ERR_VALUE for a height beyond 1e6 m or a sigma
 *          outside 1e-4..1e4 m */
insole_status_t insole_zupt_ekf_correct_height(insole_zupt_ekf_t *ekf, insole_real_t height_m,
                                               insole_real_t sigma_m);

/** Carries on without samples up to `t_us`: moves with `velocity_mps`, which is known to
 *  `sigma_mps` per axis; the position's covariance grows, attitude stays as it was. Calls in a row
 *  are one coast: the velocity is wrong by the same error all the time, the first call's sigma.
 *  @return INSOLE_ERR_STATE before alignment, INSOLE_ERR_TIME, INSOLE_ERR_VALUE for a component or
 *          sigma beyond 1e3 m/s, or a negative sigma */
insole_status_t insole_zupt_ekf_coast(insole_zupt_ekf_t *ekf, insole_vec3_t velocity_mps,
                                      insole_real_t sigma_mps, uint64_t t_us);

#ifdef __cplusplus
}
#endif

#endif
