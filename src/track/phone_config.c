/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_config.h"

const insole_phone_tracker_config_t insole_phone_tracker_defaults = {
    INSOLE_PHONE_TRACKER_KEYS(INSOLE_CONFIG_DEFAULT){INSOLE_SCREEN_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_ATTITUDE_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_PHONE_WALK_KEYS(INSOLE_CONFIG_DEFAULT){INSOLE_STEP_KEYS(INSOLE_CONFIG_DEFAULT)},
     {INSOLE_STEP_LENGTH_KEYS(INSOLE_CONFIG_DEFAULT)}},
    {INSOLE_PHONE_COMPASS_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_AUTO_START_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_PHONE_PLACE_KEYS(INSOLE_CONFIG_DEFAULT)}};

static insole_status_t check_own(const insole_phone_tracker_config_t *config)
{
    typedef insole_phone_tracker_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_PHONE_TRACKER_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_phone_config_check(const insole_phone_tracker_config_t *config)
{
    if (!config) {
        return INSOLE_ERR_NULL;
    }
    bool all = check_own(config) == INSOLE_OK &&
               insole_screen_check(&config->screen) == INSOLE_OK &&
               insole_still_bias_check(&config->still_bias) == INSOLE_OK &&
               insole_attitude_check(&config->attitude) == INSOLE_OK &&
               insole_phone_walk_check(&config->walk) == INSOLE_OK &&
               insole_phone_compass_check(&config->compass) == INSOLE_OK &&
               insole_auto_start_check(&config->auto_start) == INSOLE_OK &&
               insole_phone_place_check(&config->place) == INSOLE_OK;
    return all ? INSOLE_OK : INSOLE_ERR_VALUE;
}
