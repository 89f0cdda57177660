/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_aside.h"

/* 1-sigma of a way that is walked anew, as a share of what that shifts its end. */
static const insole_real_t ANEW_SHARE = INSOLE_R(0.3);

static insole_real_t apart(insole_real_t a_rad, insole_real_t b_rad)
{
    return insole_abs(insole_wrap_pi(a_rad - b_rad));
}

/* Does the compass say that the offset is right as it is? */
static bool is_north(const insole_phone_sight_t *sight, insole_real_t offset_rad,
                     insole_real_t askew_rad)
{
    return sight->is_known &&
           apart(offset_rad, sight->mean_rad) < apart(offset_rad - askew_rad, sight->mean_rad);
}

/* The end of the way once it goes `askew_rad` aside; known so much worse. */
static void walk_anew(insole_step_filter_begin_t *at, insole_real_t askew_rad, insole_spot_t way)
{
    insole_spot_t old = insole_turn_way(insole_turn(at->offset_rad), way);
    insole_spot_t shift = insole_spot_sub(insole_turn_way(insole_turn(askew_rad), old), old);
    at->spot = insole_spot_add(at->spot, shift);
    insole_real_t more_m2 = insole_square(ANEW_SHARE) * insole_spot_dot(shift, shift);
    at->cov_m2 = insole_spot_cov(insole_sym2_add(at->cov_m2, insole_sym2_circle(more_m2)));
}

INSOLE_COLD insole_status_t insole_phone_aside_turn(insole_step_filter_begin_t *at,
                                                    const insole_phone_sight_t *sight,
                                                    const insole_phone_aside_t *aside)
{
    if (!at || !sight || !aside) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_is_finite(aside->askew_rad) || !insole_spot_is_finite(aside->way)) {
        return INSOLE_ERR_VALUE;
    }
    if (!aside->may_be_held || is_north(sight, at->offset_rad, aside->askew_rad)) {
        walk_anew(at, aside->askew_rad, aside->way);
    } else {
        at->offset_rad = insole_wrap_pi(at->offset_rad - aside->askew_rad);
    }
    return INSOLE_OK;
}
