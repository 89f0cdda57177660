/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_gap.h"

#define ZERO INSOLE_R(0.0)

/* A turn that may be any. */
static const insole_real_t ANY_TURN_RAD2 = INSOLE_PI * INSOLE_PI;

bool insole_fusion_gap_follow(insole_fusion_gap_t *gap, const insole_foot_tracker_t *foot,
                              const insole_fix_t *fix)
{
    if (!gap || !foot || !fix) {
        return false;
    }
    if (!gap->is_open) {
        gap->before = gap->now;
    }
    gap->now.m2 = insole_max(fix->var_x_m2, fix->var_y_m2);
    gap->now.rad2 = foot->anchor.var_rad2 + foot->gap_turn_rad2;
    gap->is_open = gap->is_open || foot->coasting;
    bool is_crossed = gap->is_open && !foot->coasting && !(foot->gap_turn_rad2 > ZERO);
    if (is_crossed && !gap->is_crossed) {
        gap->crossed_us = fix->t_us;
    }
    gap->is_crossed = is_crossed;
    return gap->is_open;
}

insole_fusion_unknown_t insole_fusion_gap_lost(const insole_fusion_gap_t *gap)
{
    insole_fusion_unknown_t lost = {ZERO, ZERO};
    if (gap && gap->is_open) {
        lost.m2 = insole_max(ZERO, gap->now.m2 - gap->before.m2);
        lost.rad2 = insole_max(ZERO, gap->now.rad2 - gap->before.rad2);
    }
    return lost;
}

void insole_fusion_gap_widen(const insole_fusion_gap_t *gap, insole_fix_t *fix)
{
    if (fix) {
        insole_fusion_unknown_t lost = insole_fusion_gap_lost(gap);
        fix->var_x_m2 += lost.m2;
        fix->var_y_m2 += lost.m2;
        fix->var_heading_rad2 = insole_min(fix->var_heading_rad2 + lost.rad2, ANY_TURN_RAD2);
    }
}

void insole_fusion_gap_close(insole_fusion_gap_t *gap)
{
    if (gap) {
        gap->is_open = gap->is_crossed = false;
        gap->before = gap->now;
    }
}
