/* SPDX-License-Identifier: MIT */
#include "settings.h"

static const sensor_config_t sensor_defaults = {SENSOR_KEYS(INSOLE_CONFIG_DEFAULT)};
static const phone_parts_config_t parts_defaults = {PHONE_PARTS_KEYS(INSOLE_CONFIG_DEFAULT)};

void settings_init(settings_t *settings)
{
    settings->sensor = sensor_defaults;
    settings->fusion = insole_foot_fusion_defaults;
    settings->propagation = insole_propagation_defaults;
    settings->phone.parts = parts_defaults;
    settings->phone.tracker = insole_phone_tracker_defaults;
    settings->phone.magnetic = insole_magnetic_defaults;
    settings->phone.gait = insole_phone_gait_defaults;
    settings->phone.walk_heading = insole_walk_heading_defaults;
    settings->phone.carry = insole_carry_defaults;
    settings->phone.step_fusion = insole_step_fusion_defaults;
    settings->phone.ml_shift = insole_ml_shift_defaults;
    settings->phone.walker_ekf = insole_walker_ekf_defaults;
    settings->phone.step_cloud = insole_step_cloud_defaults;
    settings->phone.plain_cloud = insole_step_cloud_plain;
    settings->phone.wpf = insole_step_cloud_wpf;
    settings->phone.zee = insole_step_cloud_zee;
    settings->phone.kde_fix = insole_kde_fix_defaults;
    settings->phone.ml_fix = insole_ml_fix_defaults;
}

void settings_correct(const sensor_config_t *sensor, insole_imu_t *imu)
{
    insole_vec3_t gyro_bias = insole_vec3(sensor->gyro_bias_x_radps, sensor->gyro_bias_y_radps,
                                          sensor->gyro_bias_z_radps);
    insole_vec3_t accel_bias = insole_vec3(sensor->accel_bias_x_mps2, sensor->accel_bias_y_mps2,
                                           sensor->accel_bias_z_mps2);
    imu->gyro_radps =
        insole_vec3_scale(insole_vec3_sub(imu->gyro_radps, gyro_bias), sensor->gyro_scale);
    imu->accel_mps2 = insole_vec3_sub(imu->accel_mps2, accel_bias);
}
