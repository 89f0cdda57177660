/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_compass.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)

const insole_phone_compass_config_t insole_phone_compass_defaults = {
    INSOLE_PHONE_COMPASS_KEYS(INSOLE_CONFIG_DEFAULT)};

/* A sum of unit vectors stays where another one still counts. */
static const insole_real_t LONGEST_SUM = INSOLE_R(1.0e5);

static const insole_turn_t nothing = {ZERO, ZERO};

insole_status_t insole_phone_compass_check(const insole_phone_compass_config_t *config)
{
    typedef insole_phone_compass_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_PHONE_COMPASS_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_phone_compass_init(insole_phone_compass_t *compass,
                                                      const insole_phone_compass_config_t *config)
{
    if (!compass || !config) {
        return INSOLE_ERR_NULL;
    }
    if (insole_phone_compass_check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(compass, 0, sizeof *compass);
    compass->config = *config;
    return INSOLE_OK;
}

static void add(insole_turn_t *sum, insole_turn_t turn)
{
    insole_real_t size = insole_abs(sum->cos) + insole_abs(sum->sin);
    insole_real_t keep = size > LONGEST_SUM ? INSOLE_R(0.5) : INSOLE_R(1.0);
    sum->cos = keep * sum->cos + turn.cos;
    sum->sin = keep * sum->sin + turn.sin;
}

static void begin_block(insole_phone_compass_t *c)
{
    c->block = nothing;
    c->readings = 0u;
}

static bool close_block(insole_phone_compass_t *c, uint64_t t_us)
{
    if (c->readings == 0u || insole_seconds(c->block_us, t_us) < c->config.block_s) {
        return false;
    }
    c->block_rad = insole_atan2(c->block.sin, c->block.cos);
    begin_block(c);
    return true;
}

bool insole_phone_compass_push(insole_phone_compass_t *compass, uint64_t t_us,
                               insole_real_t strength_ut, insole_real_t azimuth_rad)
{
    const insole_phone_compass_config_t *config = &compass->config;
    bool fits = strength_ut >= config->least_ut && strength_ut <= config->most_ut &&
                insole_abs(azimuth_rad) <= INSOLE_R(7.0);
    if (config->use == 0 || !fits) {
        compass->passed++;
        return false;
    }
    if (compass->readings > 0u && t_us < compass->block_us) {
        begin_block(compass);
    }
    bool is_full = close_block(compass, t_us);
    insole_turn_t turn = insole_turn(config->north_rad - azimuth_rad);
    compass->block_us = compass->readings == 0u ? t_us : compass->block_us;
    compass->readings++;
    compass->used++;
    add(&compass->block, turn);
    add(&compass->all, turn);
    compass->mean_rad = insole_atan2(compass->all.sin, compass->all.cos);
    return is_full;
}

INSOLE_COLD void insole_phone_compass_forget(insole_phone_compass_t *compass)
{
    begin_block(compass);
    compass->all = nothing;
    compass->used = 0u;
}

insole_phone_sight_t insole_phone_compass_sight(const insole_phone_compass_t *compass)
{
    insole_phone_sight_t sight = {compass->used > 0u, compass->block_rad,
                                  compass->config.sigma_block_rad, compass->mean_rad,
                                  compass->config.sigma_mean_rad};
    return sight;
}
