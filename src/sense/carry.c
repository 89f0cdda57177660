/* SPDX-License-Identifier: MIT */
#include "insole/sense/carry.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)

const insole_carry_config_t insole_carry_defaults = {INSOLE_CARRY_KEYS(INSOLE_CONFIG_DEFAULT)};

static insole_status_t check(const insole_carry_config_t *config)
{
    typedef insole_carry_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_CARRY_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_carry_init(insole_carry_t *carry, const insole_carry_config_t *config)
{
    if (!carry || !config) {
        return INSOLE_ERR_NULL;
    }
    if (check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(carry, 0, sizeof *carry);
    carry->config = *config;
    carry->told = carry->candidate = INSOLE_CARRY_NONE;
    return insole_carry_window_init(&carry->window, config->gravity_s);
}

insole_status_t insole_carry_push(insole_carry_t *carry, uint64_t t_us, insole_vec3_t accel_mps2,
                                  const insole_vec3_t *gyro_radps, const insole_vec3_t *up)
{
    return carry ? insole_carry_window_push(&carry->window, t_us, accel_mps2, gyro_radps, up)
                 : INSOLE_ERR_NULL;
}

bool insole_carry_is_still(const insole_carry_config_t *config,
                           const insole_carry_features_t *features)
{
    return config && features &&
           features->value[INSOLE_CARRY_VARIANCE] < insole_square(config->still_mps2);
}

/* The window of `votes` is the newest: does the position change? */
static void judge(insole_carry_t *c, const insole_carry_votes_t *votes)
{
    bool is_won = votes->share[votes->winner] >= c->config.min_share;
    int32_t winner = is_won ? votes->winner : INSOLE_CARRY_NONE;
    c->wins = winner == c->candidate ? c->wins : 0;
    c->wins += c->wins < c->config.switch_windows ? 1 : 0;
    c->candidate = winner;
    if (winner != INSOLE_CARRY_NONE && c->wins >= c->config.switch_windows) {
        c->told = winner;
    }
}

insole_status_t insole_carry_next(insole_carry_t *carry, const insole_carry_forest_t *forest,
                                  insole_carry_news_t *news)
{
    static const insole_carry_votes_t none = {{ZERO}, INSOLE_CARRY_NONE};
    insole_carry_features_t features;
    insole_carry_votes_t votes = none;
    if (!carry || !forest || !news) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_carry_window_next(&carry->window, &features);
    if (status != INSOLE_OK) {
        return status;
    }
    if (!insole_carry_is_still(&carry->config, &features)) {
        status = insole_carry_forest_vote(forest, &features, &votes);
        if (status != INSOLE_OK) {
            carry->window.is_new = status == INSOLE_ERR_DATA;
            return status;
        }
        judge(carry, &votes);
    }
    news->t_us = features.t_us;
    news->votes = votes;
    news->told = carry->told;
    return INSOLE_OK;
}
