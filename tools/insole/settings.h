/** @file settings.h  Everything that can be set by `--set` and `--config`.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SETTINGS_H
#define INSOLE_HOST_SETTINGS_H

#include "insole/fuse/ml_shift.h"
#include "insole/fuse/step_cloud.h"
#include "insole/fuse/step_fusion.h"
#include "insole/fuse/walker_ekf.h"
#include "insole/move/magnetic.h"
#include "insole/move/walk_heading.h"
#include "insole/place/kde_fix.h"
#include "insole/place/ml_fix.h"
#include "insole/sense/carry.h"
#include "insole/track/foot_fusion.h"
#include "insole/track/phone_config.h"
#include "insole/track/phone_gait.h"

/* clang-format off */
/** What the program does to the readings of a sensor before the library sees them; firmware does
 *  the same where it reads the sensor. */
#define SENSOR_KEYS(KEY)                                                                          \
    KEY(REAL, gyro_scale, 1.0, 0.8, 1.25, "",                                                     \
        "turn rates are multiplied by it, from calibrate gyro-scale; 1 = as they are")            \
    KEY(REAL, gyro_bias_x_radps, 0.0, -1.0, 1.0, "rad/s",                                         \
        "turn rate about x at rest, from calibrate imu; subtracted first")                        \
    KEY(REAL, gyro_bias_y_radps, 0.0, -1.0, 1.0, "rad/s", "the same about y")                     \
    KEY(REAL, gyro_bias_z_radps, 0.0, -1.0, 1.0, "rad/s", "the same about z")                     \
    KEY(REAL, accel_bias_x_mps2, 0.0, -5.0, 5.0, "m/s^2",                                         \
        "bias of the accelerometer along x, from calibrate imu; subtracted")                      \
    KEY(REAL, accel_bias_y_mps2, 0.0, -5.0, 5.0, "m/s^2", "the same along y")                     \
    KEY(REAL, accel_bias_z_mps2, 0.0, -5.0, 5.0, "m/s^2", "the same along z")
/* clang-format on */

typedef struct {
    SENSOR_KEYS(INSOLE_CONFIG_MEMBER)
} sensor_config_t;

/* clang-format off */
/** What the methods of a phone are made of. */
#define PHONE_PARTS_KEYS(KEY)                                                                     \
    KEY(CHOICE, fix, 0, 0, 2, "own|kde|ml",                                                       \
        "what makes fixes of scans: the method's own, or another")
/* clang-format on */

typedef struct {
    PHONE_PARTS_KEYS(INSOLE_CONFIG_MEMBER)
} phone_parts_config_t;

/** Those of the phone tracker and of all that it may be made of. Its screen and its rests have the
 *  settings of the foot's. */
typedef struct {
    phone_parts_config_t parts;
    insole_phone_tracker_config_t tracker;
    insole_magnetic_config_t magnetic;
    insole_phone_gait_config_t gait;
    insole_walk_heading_config_t walk_heading;
    insole_carry_config_t carry;
    insole_step_fusion_config_t step_fusion;
    insole_ml_shift_config_t ml_shift;
    insole_walker_ekf_config_t walker_ekf;
    insole_step_cloud_config_t step_cloud;
    insole_step_cloud_config_t plain_cloud; /**< of the rivals of [PhoneEKF] */
    insole_step_cloud_config_t wpf, zee;    /**< of those of [WifiShift] */
    insole_kde_fix_config_t kde_fix;
    insole_ml_fix_config_t ml_fix;
} phone_settings_t;

typedef struct {
    sensor_config_t sensor;
    insole_foot_fusion_config_t fusion; /**< holds those of the first order, `foot` */
    insole_propagation_config_t propagation;
    phone_settings_t phone;
} settings_t;

void settings_init(settings_t *settings);

/** Corrects a reading as told by `sensor.*`. */
void settings_correct(const sensor_config_t *sensor, insole_imu_t *imu);

#endif
