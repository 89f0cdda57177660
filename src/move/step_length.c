/* SPDX-License-Identifier: MIT */
#include "insole/move/step_length.h"

#include "insole/base/fastmath.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

const insole_step_length_config_t insole_step_length_defaults = {
    INSOLE_STEP_LENGTH_KEYS(INSOLE_CONFIG_DEFAULT)};

/* Neither is worth a model beyond it: a fall of the phone, not a step. */
static const insole_real_t LARGEST_MPS2 = INSOLE_R(1.0e6);

static insole_real_t frequency_hz(const insole_step_length_config_t *config,
                                  const insole_footfall_t *footfall)
{
    insole_real_t lasted_s = insole_seconds(footfall->begin_us, footfall->end_us);
    return ONE / insole_min(insole_max(lasted_s, config->min_s), config->max_s);
}

static insole_real_t root(const insole_step_length_config_t *config, insole_real_t range_mps2)
{
    if (!(range_mps2 > ZERO)) {
        return ZERO;
    }
    return config->root_scale *
           insole_exp(insole_log(range_mps2) / config->root_degree); /* [PhoneEKF (3)] */
}

static insole_real_t by_model(const insole_step_length_config_t *config,
                              const insole_footfall_t *footfall)
{
    switch (config->model) {
    case INSOLE_STEP_LENGTH_LINEAR:
        return config->linear_alpha * frequency_hz(config, footfall) +
               config->linear_beta * insole_square(footfall->accel_sigma_mps2) +
               config->linear_gamma; /* [PhoneUKF (6)] */
    case INSOLE_STEP_LENGTH_MIXED:
        return config->mixed_a + config->mixed_b * frequency_hz(config, footfall) +
               config->mixed_c * insole_sqrt(footfall->range_mps2);
    case INSOLE_STEP_LENGTH_CONSTANT:
        return config->constant_m;
    default:
        return root(config, footfall->range_mps2);
    }
}

insole_status_t insole_step_length_check(const insole_step_length_config_t *config)
{
    typedef insole_step_length_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_STEP_LENGTH_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_step_length(const insole_step_length_config_t *config,
                                               const insole_footfall_t *footfall,
                                               insole_real_t *length_m)
{
    if (!config || !footfall || !length_m) {
        return INSOLE_ERR_NULL;
    }
    if (insole_step_length_check(config) != INSOLE_OK ||
        !(footfall->range_mps2 >= ZERO && footfall->range_mps2 <= LARGEST_MPS2) ||
        !(footfall->accel_sigma_mps2 >= ZERO && footfall->accel_sigma_mps2 <= LARGEST_MPS2)) {
        return INSOLE_ERR_VALUE;
    }
    if (footfall->end_us <= footfall->begin_us) {
        return INSOLE_ERR_TIME;
    }
    *length_m = insole_min(insole_max(by_model(config, footfall), config->min_m), config->max_m);
    return INSOLE_OK;
}
