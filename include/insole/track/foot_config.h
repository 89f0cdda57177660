/** @file foot_config.h  All settings of the foot tracker, its own and those of its parts.
 *
 *      insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
 *      config.zupt_ekf.roll_height_m = INSOLE_R(0.12);
 *      insole_foot_tracker_init(&shoe, &config);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FOOT_CONFIG_H
#define INSOLE_TRACK_FOOT_CONFIG_H

#include "insole/move/stride.h"
#include "insole/move/zupt_ekf.h"
#include "insole/sense/screen.h"
#include "insole/sense/still_bias.h"
#include "insole/sense/zero_velocity.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    INSOLE_FOOT_INS = 0, /**< first order: inertial navigation with zero-velocity updates */
    INSOLE_FOOT_PDR = 1  /**< strides of length (33) in the direction of the inertial strides */
} insole_foot_method_t;

/* clang-format off */
#define INSOLE_FOOT_TRACKER_KEYS(KEY)                                                             \
    KEY(CHOICE, method, 0, 0, 1, "ins|pdr", "what makes the position")                            \
    KEY(REAL, align_s, 0.08, 0.0, 2.0, "s", "longest stance whose mean gives the first attitude") \
    KEY(REAL, sigma_moving_tilt_rad, 0.05, 0.001, 1.0, "rad",                                     \
        "1-sigma of roll and pitch after alignment on a stance of a walk")                        \
    KEY(REAL, correct_every_s, 0.02, 0.0, 0.2, "s",                                               \
        "time between the measurements of a stance's velocity; 0 = on each sample;"               \
        " a runner wants 0.05 or less")                                                           \
    KEY(REAL, floor_step_m, 0.05, 0.0, 1.0, "m",                                                  \
        "stances that differ less in height stand on the same floor; 0 = off")                    \
    KEY(REAL, sigma_floor_m, 0.01, 0.001, 1.0, "m", "1-sigma of the evenness of that floor")      \
    KEY(REAL, sigma_walk_mps, 0.7, 0.01, 10.0, "m/s",                                             \
        "1-sigma of the velocity, per axis, while samples are missing")                           \
    KEY(REAL, bridge_s, 0.25, 0.0, 0.5, "s",                                                      \
        "a gap up to this long is bridged by rates between those at its ends")                    \
    KEY(REAL, sigma_gap_turn_rad_rts, 0.75, 0.0, 3.0, "rad/sqrt(s)",                              \
        "1-sigma of the unknown turn during a gap of one second; grows with its root")            \
    KEY(REAL, yaw_drift_radps, 8.7e-4, 0.0, 0.1, "rad/s",                                         \
        "1-sigma of the yaw's drift by bias and scale, added to the reported heading")            \
    KEY(REAL, lost_sigma_m, 10.0, 0.1, 1.0e6, "m", "a position with a larger 1-sigma is lost")
/* clang-format on */

typedef struct {
    INSOLE_FOOT_TRACKER_KEYS(INSOLE_CONFIG_MEMBER)
    insole_screen_config_t screen;
    insole_still_bias_config_t still_bias;
    insole_zero_velocity_config_t zero_velocity;
    insole_zupt_ekf_config_t zupt_ekf;
    insole_stride_config_t stride;
} insole_foot_tracker_config_t;

/** The tracker's own, which it keeps; its parts keep theirs. */
typedef struct {
    INSOLE_FOOT_TRACKER_KEYS(INSOLE_CONFIG_MEMBER)
} insole_foot_tracker_own_t;

extern const insole_foot_tracker_config_t insole_foot_tracker_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_foot_config_check(const insole_foot_tracker_config_t *config);

#ifdef __cplusplus
}
#endif

#endif
