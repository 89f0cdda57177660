/* SPDX-License-Identifier: MIT */
#include "insole/fuse/particle_config.h"

#include <stddef.h>

#define ONE INSOLE_R(1.0)

/* Where walls are not known a cloud must be so much wider for scans to say much. */
#define BLIND_WIDER INSOLE_R(2.5)

const insole_particle_filter_config_t insole_particle_filter_defaults = {
    INSOLE_PARTICLE_FILTER_KEYS(INSOLE_CONFIG_DEFAULT){
        INSOLE_RSS_FIELD_KEYS(INSOLE_CONFIG_DEFAULT)}};

const insole_particle_filter_config_t insole_particle_filter_two_order =
    INSOLE_PARTICLE_FILTER_TWO_ORDER;

insole_status_t insole_particle_config_check(const insole_particle_filter_config_t *config)
{
    if (!config) {
        return INSOLE_ERR_NULL;
    }
    if (!(true INSOLE_PARTICLE_FILTER_KEYS(INSOLE_CONFIG_IN_RANGE))) {
        return INSOLE_ERR_VALUE;
    }
    return insole_rss_field_check(&config->field);
}

insole_real_t insole_particle_config_scan_power(const insole_particle_filter_config_t *config,
                                                const insole_cloud_source_t *cloud, bool is_blind)
{
    insole_real_t least = is_blind ? config->blind_power : ONE;
    insole_real_t most = is_blind ? config->blind_search_power : config->search_power;
    insole_real_t wider = is_blind ? BLIND_WIDER : ONE;
    insole_real_t width = insole_cloud_source_width(cloud, wider * config->search_sigma_m,
                                                    wider * config->search_offset_rad);
    return least + (most - least) * width;
}
