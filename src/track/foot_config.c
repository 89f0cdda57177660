/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_config.h"

const insole_foot_tracker_config_t insole_foot_tracker_defaults = {
    INSOLE_FOOT_TRACKER_KEYS(INSOLE_CONFIG_DEFAULT){INSOLE_SCREEN_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_ZERO_VELOCITY_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_ZUPT_EKF_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_STRIDE_KEYS(INSOLE_CONFIG_DEFAULT)}};

static bool is_screen_in_range(const insole_screen_config_t *config)
{
    return true INSOLE_SCREEN_KEYS(INSOLE_CONFIG_IN_RANGE);
}

static bool is_still_bias_in_range(const insole_still_bias_config_t *config)
{
    return true INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_IN_RANGE);
}

static bool is_zero_velocity_in_range(const insole_zero_velocity_config_t *config)
{
    return true INSOLE_ZERO_VELOCITY_KEYS(INSOLE_CONFIG_IN_RANGE);
}

static bool is_zupt_ekf_in_range(const insole_zupt_ekf_config_t *config)
{
    return true INSOLE_ZUPT_EKF_KEYS(INSOLE_CONFIG_IN_RANGE);
}

static bool is_stride_in_range(const insole_stride_config_t *config)
{
    return true INSOLE_STRIDE_KEYS(INSOLE_CONFIG_IN_RANGE);
}

insole_status_t insole_foot_config_check(const insole_foot_tracker_config_t *config)
{
    if (!config) {
        return INSOLE_ERR_NULL;
    }
    bool own = true INSOLE_FOOT_TRACKER_KEYS(INSOLE_CONFIG_IN_RANGE);
    bool parts = is_screen_in_range(&config->screen) &&
                 is_still_bias_in_range(&config->still_bias) &&
                 is_zero_velocity_in_range(&config->zero_velocity) &&
                 is_zupt_ekf_in_range(&config->zupt_ekf) && is_stride_in_range(&config->stride);
    return own && parts ? INSOLE_OK : INSOLE_ERR_VALUE;
}
