/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_ekf.h"

INSOLE_COLD insole_step_way_t insole_step_ekf(const insole_pace_t *pace)
{
    insole_turn_t t = insole_turn(pace->heading_rad);
    insole_real_t d = pace->length_m;
    insole_spot_t ahead = {t.cos, t.sin}, across = {-d * t.sin, d * t.cos}; /* columns of F */
    insole_real_t var_heading_rad2 = insole_min(pace->var_heading_rad2, INSOLE_HEADING_MOST_R2);
    insole_sym2_t Q = insole_sym2_add_outer(insole_sym2_circle(INSOLE_R(0.0)), pace->var_length_m2,
                                            ahead);             /* F P_qd F' [PhoneEKF (33)-(34)] */
    insole_step_way_t way = {insole_spot(d * t.cos, d * t.sin), /* [PhoneEKF (31)] */
                             insole_sym2_add_outer(Q, var_heading_rad2, across)};
    return way;
}

static insole_status_t step_state(void *state, uint64_t t_us, const insole_pace_t *pace)
{
    (void)t_us;
    return insole_step_fusion_step(state, insole_step_ekf, pace);
}

const insole_step_filter_calls_t insole_step_ekf_calls = {
    .start = insole_step_fusion_begin_state,
    .step = step_state,
    .fix = insole_step_fusion_fix_state,
    .answer = insole_step_fusion_answer_state,
};
