/* SPDX-License-Identifier: MIT */
#include "insole/move/stride.h"

#include <string.h>

#include "insole/base/fastmath.h"

#define ZERO INSOLE_R(0.0)

const insole_stride_config_t insole_stride_defaults = {INSOLE_STRIDE_KEYS(INSOLE_CONFIG_DEFAULT)};

insole_status_t insole_stride_check(const insole_stride_config_t *config)
{
    typedef insole_stride_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_STRIDE_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_stride_init(insole_stride_counter_t *counter,
                                               const insole_stride_config_t *config)
{
    if (!counter || !config) {
        return INSOLE_ERR_NULL;
    }
    if (insole_stride_check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(counter, 0, sizeof *counter);
    counter->config = *config;
    counter->k = config->k_stride > ZERO ? config->k_stride : config->first_k_stride;
    return INSOLE_OK;
}

INSOLE_COLD void insole_stride_restart(insole_stride_counter_t *counter)
{
    if (counter) {
        counter->has_origin = false;
        counter->was_still = false;
        counter->settled = false;
    }
}

INSOLE_COLD static void begin_stride(insole_stride_counter_t *c, const insole_stride_input_t *at)
{
    c->origin_m = at->position_m;
    c->origin_yaw_rad = at->yaw_rad;
    c->force_min_mps2 = INSOLE_REAL_MAX;
    c->force_max_mps2 = -INSOLE_REAL_MAX;
    c->has_origin = true;
}

/* Fourth root of the range of the vertical acceleration: what K multiplies. */
static insole_real_t force_root(const insole_stride_counter_t *c)
{
    insole_real_t range = c->force_max_mps2 - c->force_min_mps2;
    return range > ZERO ? insole_sqrt(insole_sqrt(range)) : ZERO;
}

static void learn_k(insole_stride_counter_t *c, insole_real_t length_m, insole_real_t root)
{
    if (c->config.k_stride > ZERO || !(root > ZERO)) {
        return;
    }
    c->learned++;
    insole_real_t weight =
        insole_max(c->config.learn_weight, INSOLE_R(1.0) / (insole_real_t)c->learned);
    c->k += weight * (length_m / root - c->k);
}

static void fill(const insole_stride_counter_t *c, insole_stride_t *stride)
{
    insole_vec3_t d = insole_vec3_sub(c->last.position_m, c->origin_m);
    insole_real_t root = force_root(c);
    stride->begin_us = c->left_us;
    stride->end_us = c->arrived_us;
    stride->displacement_m = d;
    stride->length_m = insole_sqrt(d.x * d.x + d.y * d.y);
    stride->model_length_m = c->k * root; /* [TwoOrder (33)] */
    stride->heading_rad = insole_atan2(d.y, d.x);
    stride->turn_rad = insole_wrap_pi(c->last.yaw_rad - c->origin_yaw_rad);
    stride->accel_min_mps2 = root > ZERO ? c->force_min_mps2 : ZERO;
    stride->accel_max_mps2 = root > ZERO ? c->force_max_mps2 : ZERO;
}

static bool is_far_enough(const insole_stride_counter_t *c)
{
    insole_vec3_t d = insole_vec3_sub(c->last.position_m, c->origin_m);
    return d.x * d.x + d.y * d.y >= insole_square(c->config.min_length_m);
}

/* The present stance is good enough to end the stride in progress. */
INSOLE_COLD static bool end_stride(insole_stride_counter_t *c, insole_stride_t *stride)
{
    c->settled = true;
    if (!c->has_origin) {
        begin_stride(c, &c->last);
        return false;
    }
    if (!is_far_enough(c)) {
        return false;
    }
    fill(c, stride);
    learn_k(c, stride->length_m, force_root(c));
    begin_stride(c, &c->last);
    c->count++;
    return true;
}

static bool push_still(insole_stride_counter_t *c, const insole_stride_input_t *in,
                       insole_stride_t *stride)
{
    if (!c->was_still) {
        c->arrived_us = in->t_us;
        c->settled = false;
    }
    c->was_still = true;
    c->last = *in;
    return !c->settled && insole_seconds(c->arrived_us, in->t_us) >= c->config.settle_s &&
           end_stride(c, stride);
}

static bool push_moving(insole_stride_counter_t *c, const insole_stride_input_t *in,
                        insole_stride_t *stride)
{
    bool ended = c->was_still && !c->settled && end_stride(c, stride);
    if (c->was_still) {
        c->left_us = c->last.t_us;
    }
    c->was_still = false;
    c->force_min_mps2 = insole_min(in->vertical_force_mps2, c->force_min_mps2);
    c->force_max_mps2 = insole_max(in->vertical_force_mps2, c->force_max_mps2);
    return ended;
}

insole_status_t insole_stride_push(insole_stride_counter_t *counter,
                                   const insole_stride_input_t *input, insole_stride_t *stride)
{
    if (!counter || !input || !stride) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_vec3_is_finite(input->position_m) || !insole_is_finite(input->yaw_rad) ||
        !insole_is_finite(input->vertical_force_mps2)) {
        counter->refused++;
        return INSOLE_ERR_VALUE;
    }
    if (counter->has_time && input->t_us <= counter->t_us) {
        counter->refused++;
        return INSOLE_ERR_TIME;
    }
    counter->t_us = input->t_us;
    counter->has_time = true;
    bool ended =
        input->still ? push_still(counter, input, stride) : push_moving(counter, input, stride);
    return ended ? INSOLE_OK : INSOLE_ERR_STATE;
}
