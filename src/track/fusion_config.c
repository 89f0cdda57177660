/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_config.h"

#include <stddef.h>

const insole_foot_fusion_config_t insole_foot_fusion_defaults = {
    INSOLE_FOOT_FUSION_KEYS(INSOLE_CONFIG_DEFAULT){
        INSOLE_FOOT_TRACKER_KEYS(INSOLE_CONFIG_DEFAULT){INSOLE_SCREEN_KEYS(INSOLE_CONFIG_DEFAULT)},
        {INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_DEFAULT)},
        {INSOLE_ZERO_VELOCITY_KEYS(INSOLE_CONFIG_DEFAULT)},
        {INSOLE_ZUPT_EKF_KEYS(INSOLE_CONFIG_DEFAULT)},
        {INSOLE_STRIDE_KEYS(INSOLE_CONFIG_DEFAULT)}},
    {INSOLE_PARTICLE_FILTER_KEYS(INSOLE_CONFIG_DEFAULT){
        INSOLE_RSS_FIELD_KEYS(INSOLE_CONFIG_DEFAULT)}},
    INSOLE_PARTICLE_FILTER_TWO_ORDER,
    {INSOLE_RSS_FIX_KEYS(INSOLE_CONFIG_DEFAULT)},
    {INSOLE_RANGE_FIX_KEYS(INSOLE_CONFIG_DEFAULT)}};

static insole_status_t check_own(const insole_foot_fusion_config_t *config)
{
    typedef insole_foot_fusion_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_FOOT_FUSION_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_fusion_config_check(const insole_foot_fusion_config_t *config)
{
    if (!config) {
        return INSOLE_ERR_NULL;
    }
    bool all = check_own(config) == INSOLE_OK &&
               insole_foot_config_check(&config->foot) == INSOLE_OK &&
               insole_particle_config_check(&config->particles) == INSOLE_OK &&
               insole_particle_config_check(&config->two_order) == INSOLE_OK &&
               insole_rss_fix_check(&config->rss_fix) == INSOLE_OK &&
               insole_range_fix_check(&config->range_fix) == INSOLE_OK;
    return all ? INSOLE_OK : INSOLE_ERR_VALUE;
}

/* What these settings cannot do without, and what is lent but not set up. */
static bool is_lacking(const insole_fusion_memory_t *memory,
                       const insole_foot_fusion_config_t *config)
{
    bool is_patient = config->method == INSOLE_FUSION_BEST && config->start_fixes > 1;
    const insole_particle_filter_config_t *particles =
        config->method == INSOLE_FUSION_TWO_ORDER ? &config->two_order : &config->particles;
    return (config->lag_s > INSOLE_R(0.0) && !memory->past) ||
           (is_patient && !(memory->starter.hear && memory->starter.state)) ||
           (particles->walls == INSOLE_WALLS_SOFT && !memory->steps) ||
           (memory->ranges && !memory->ranges->calls);
}

INSOLE_COLD insole_status_t insole_fusion_memory_check(const insole_fusion_memory_t *memory,
                                                       const insole_foot_fusion_config_t *config)
{
    if (!memory || !config || is_lacking(memory, config)) {
        return INSOLE_ERR_NULL;
    }
    insole_cloud_t cloud = insole_fusion_cloud(memory);
    return insole_cloud_check(&cloud);
}
