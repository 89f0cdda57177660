/* SPDX-License-Identifier: MIT */
#include "insole/fuse/particle_config.h"

#include <stddef.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

/* Where walls are not known a cloud must be so much wider for scans to say much. */
#define BLIND_WIDER INSOLE_R(2.5)

const insole_particle_filter_config_t insole_particle_filter_defaults = {
    INSOLE_PARTICLE_FILTER_KEYS(INSOLE_CONFIG_DEFAULT){
        INSOLE_RSS_FIELD_KEYS(INSOLE_CONFIG_DEFAULT)}};

const insole_particle_filter_config_t insole_particle_filter_two_order =
    INSOLE_PARTICLE_FILTER_TWO_ORDER;

const insole_particle_filter_config_t insole_particle_filter_phone = INSOLE_PARTICLE_FILTER_PHONE;

const insole_particle_filter_config_t insole_particle_filter_phone_plain =
    INSOLE_PARTICLE_FILTER_PHONE_PLAIN;

const insole_particle_filter_config_t insole_particle_filter_phone_wpf =
    INSOLE_PARTICLE_FILTER_PHONE_WPF;

const insole_particle_filter_config_t insole_particle_filter_phone_zee =
    INSOLE_PARTICLE_FILTER_PHONE_ZEE;

static insole_status_t check_own(const insole_particle_filter_config_t *config)
{
    typedef insole_particle_filter_config_t config_t;
    static const insole_config_range_t ranges[] = {
        INSOLE_PARTICLE_FILTER_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t
insole_particle_config_check(const insole_particle_filter_config_t *config)
{
    insole_status_t status = check_own(config);
    return status == INSOLE_OK ? insole_rss_field_check(&config->field) : status;
}

/* A 1-sigma with variances added to it; as it is, to the bit, when there are none. */
static insole_real_t wider(insole_real_t sigma, insole_real_t variances)
{
    return variances > ZERO ? insole_sqrt(insole_square(sigma) + variances) : sigma;
}

INSOLE_COLD insole_cloud_stride_t insole_particle_config_stride(
    const insole_particle_filter_config_t *config, const insole_evidence_t *news)
{
    insole_real_t length_var = insole_square(config->length_share * news->length_m);
    insole_real_t heading_var = insole_square(config->sigma_heading_rad);
    insole_cloud_stride_t stride = {
        .length_m = news->length_m,
        .sigma_length_m = wider(config->sigma_length_m, length_var + news->var_length_m2),
        .heading_rad = news->heading_rad,
        .sigma_heading_rad = wider(config->turn_share * insole_abs(news->turn_rad),
                                   heading_var + news->var_heading_rad2),
        .sigma_wander_rad = config->sigma_wander_rad,
        .scale_memory = config->scale_memory,
        .sigma_scale =
            config->sigma_scale * insole_sqrt(ONE - insole_square(config->scale_memory))};
    if (config->scatter == INSOLE_SCATTER_APART) {
        stride.is_apart = true;
        stride.apart_wander_rad = stride.sigma_wander_rad;
        stride.apart_scale = stride.sigma_scale;
        stride.sigma_wander_rad = ZERO;
        stride.sigma_scale = ZERO;
    }
    return stride;
}

INSOLE_COLD insole_real_t
insole_particle_config_scan_power(const insole_particle_filter_config_t *config,
                                  const insole_cloud_source_t *cloud, bool is_blind)
{
    insole_real_t least = is_blind ? config->blind_power : ONE;
    insole_real_t most = is_blind ? config->blind_search_power : config->search_power;
    insole_real_t wider = is_blind ? BLIND_WIDER : ONE;
    insole_real_t width = insole_cloud_source_width(cloud, wider * config->search_sigma_m,
                                                    wider * config->search_offset_rad);
    return least + (most - least) * width;
}
