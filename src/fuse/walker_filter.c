/* SPDX-License-Identifier: MIT */
#include "insole/fuse/walker_filter.h"

static insole_status_t begin_state(void *state, const insole_step_filter_begin_t *begin)
{
    if (!begin) {
        return INSOLE_ERR_NULL;
    }
    insole_walker_ekf_t *walker = state;
    if (!walker) {
        return INSOLE_ERR_NULL;
    }
    const insole_walker_start_t start = {begin->t_us,
                                         begin->spot,
                                         insole_step_filter_less_bias(begin, walker->bias_m),
                                         begin->offset_rad,
                                         begin->var_offset_rad2,
                                         begin->from_radio};
    return insole_walker_ekf_start(walker, &start);
}

static insole_status_t step_state(void *state, uint64_t t_us, const insole_pace_t *pace)
{
    (void)t_us;
    return insole_walker_ekf_step(state, pace);
}

static insole_status_t bias_state(void *state, insole_real_t sigma_m)
{
    return insole_walker_ekf_bias(state, sigma_m);
}

static insole_status_t fix_state(void *state, const insole_spot_fix_t *fix)
{
    return insole_walker_ekf_fix(state, fix);
}

static insole_status_t compass_state(void *state, insole_real_t offset_rad, insole_real_t sigma_rad)
{
    return insole_walker_ekf_compass(state, offset_rad, sigma_rad);
}

static insole_status_t answer_state(const void *state, insole_step_filter_answer_t *answer)
{
    insole_walker_answer_t known;
    if (!answer) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_walker_ekf_answer(state, &known);
    if (status == INSOLE_OK) {
        *answer = (insole_step_filter_answer_t){known.spot, known.cov_m2, known.offset_rad,
                                                known.var_offset_rad2, known.scale};
    }
    return status;
}

const insole_step_filter_calls_t insole_walker_filter_calls = {.start = begin_state,
                                                               .step = step_state,
                                                               .bias = bias_state,
                                                               .fix = fix_state,
                                                               .compass = compass_state,
                                                               .answer = answer_state};
