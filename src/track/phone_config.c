/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_config.h"

const insole_phone_tracker_config_t insole_phone_tracker_defaults = {
    INSOLE_PHONE_TRACKER_KEYS(INSOLE_CONFIG_DEFAULT){INSOLE_SCREEN_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_ATTITUDE_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_MAGNETIC_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_PHONE_WALK_KEYS(INSOLE_CONFIG_DEFAULT){INSOLE_STEP_KEYS(INSOLE_CONFIG_DEFAULT)},
     {INSOLE_STEP_LENGTH_KEYS(INSOLE_CONFIG_DEFAULT)}},
    {INSOLE_PHONE_COMPASS_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_AUTO_START_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_PHONE_PLACE_KEYS(INSOLE_CONFIG_DEFAULT)}};

static bool is_screen_in_range(const insole_screen_config_t *config)
{
    return true INSOLE_SCREEN_KEYS(INSOLE_CONFIG_IN_RANGE);
}

static bool is_still_bias_in_range(const insole_still_bias_config_t *config)
{
    return true INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_IN_RANGE);
}

static bool is_attitude_in_range(const insole_attitude_config_t *config)
{
    return true INSOLE_ATTITUDE_KEYS(INSOLE_CONFIG_IN_RANGE);
}

static bool is_magnetic_in_range(const insole_magnetic_config_t *config)
{
    return true INSOLE_MAGNETIC_KEYS(INSOLE_CONFIG_IN_RANGE);
}

static bool is_compass_in_range(const insole_phone_compass_config_t *config)
{
    return true INSOLE_PHONE_COMPASS_KEYS(INSOLE_CONFIG_IN_RANGE);
}

static bool is_auto_start_in_range(const insole_auto_start_config_t *config)
{
    return true INSOLE_AUTO_START_KEYS(INSOLE_CONFIG_IN_RANGE);
}

static bool is_place_in_range(const insole_phone_place_config_t *config)
{
    return true INSOLE_PHONE_PLACE_KEYS(INSOLE_CONFIG_IN_RANGE);
}

insole_status_t insole_phone_config_check(const insole_phone_tracker_config_t *config)
{
    if (!config) {
        return INSOLE_ERR_NULL;
    }
    bool own = true INSOLE_PHONE_TRACKER_KEYS(INSOLE_CONFIG_IN_RANGE);
    bool parts =
        is_screen_in_range(&config->screen) && is_still_bias_in_range(&config->still_bias) &&
        is_attitude_in_range(&config->attitude) && is_magnetic_in_range(&config->magnetic) &&
        insole_phone_walk_check(&config->walk) == INSOLE_OK &&
        is_compass_in_range(&config->compass) && is_auto_start_in_range(&config->auto_start) &&
        is_place_in_range(&config->place);
    return own && parts ? INSOLE_OK : INSOLE_ERR_VALUE;
}
