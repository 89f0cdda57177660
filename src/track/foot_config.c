/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_config.h"

const insole_foot_tracker_config_t insole_foot_tracker_defaults = {
    INSOLE_FOOT_TRACKER_KEYS(INSOLE_CONFIG_DEFAULT){INSOLE_SCREEN_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_ZERO_VELOCITY_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_ZUPT_EKF_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_STRIDE_KEYS(INSOLE_CONFIG_DEFAULT)}};

static insole_status_t check_own(const insole_foot_tracker_config_t *config)
{
    typedef insole_foot_tracker_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_FOOT_TRACKER_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_foot_config_check(const insole_foot_tracker_config_t *config)
{
    if (!config) {
        return INSOLE_ERR_NULL;
    }
    bool all = check_own(config) == INSOLE_OK &&
               insole_screen_check(&config->screen) == INSOLE_OK &&
               insole_still_bias_check(&config->still_bias) == INSOLE_OK &&
               insole_zero_velocity_check(&config->zero_velocity) == INSOLE_OK &&
               insole_zupt_ekf_check(&config->zupt_ekf) == INSOLE_OK &&
               insole_stride_check(&config->stride) == INSOLE_OK;
    return all ? INSOLE_OK : INSOLE_ERR_VALUE;
}
