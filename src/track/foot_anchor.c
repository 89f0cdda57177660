/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_anchor.h"

#include <string.h>

#include "insole/base/fastmath.h"

#define ZERO INSOLE_R(0.0)

enum { START_STRIDES = 2 };

/* A shorter way has no direction worth comparing. */
static const insole_real_t WAY_WITH_DIRECTION_M = INSOLE_R(0.3);

/* A turn that may be any. */
static const insole_real_t ANY_TURN_RAD2 = INSOLE_PI * INSOLE_PI;

static const insole_real_t FARTHEST_M = INSOLE_R(1.0e6); /* a start beyond is an error */
static const insole_real_t TURNS_RAD = INSOLE_R(100.0);  /* and so is such a heading */

INSOLE_COLD insole_status_t insole_foot_anchor_init(insole_foot_anchor_t *anchor,
                                                    insole_real_t drift_radps, uint64_t t_us)
{
    if (!anchor) {
        return INSOLE_ERR_NULL;
    }
    if (!(drift_radps >= ZERO) || !insole_is_finite(drift_radps)) {
        return INSOLE_ERR_VALUE;
    }
    memset(anchor, 0, sizeof *anchor);
    anchor->turn = insole_turn(ZERO);
    anchor->drift_radps = drift_radps;
    anchor->t_us = t_us;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_foot_anchor_check(const insole_start_t *start)
{
    if (!start) {
        return INSOLE_ERR_NULL;
    }
    bool place = insole_abs(start->x_m) <= FARTHEST_M && insole_abs(start->y_m) <= FARTHEST_M &&
                 start->sigma_m >= ZERO && start->sigma_m <= FARTHEST_M;
    bool heading = insole_abs(start->heading_rad) <= TURNS_RAD && start->sigma_rad >= ZERO &&
                   start->sigma_rad <= TURNS_RAD;
    return place && (heading || !start->has_heading) ? INSOLE_OK : INSOLE_ERR_VALUE;
}

INSOLE_COLD insole_status_t insole_foot_anchor_start(insole_foot_anchor_t *anchor,
                                                     const insole_start_t *start,
                                                     insole_vec3_t position_n_m, uint64_t t_us)
{
    if (!anchor) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_foot_anchor_check(start);
    if (status != INSOLE_OK) {
        return status;
    }
    if (!insole_vec3_is_finite(position_n_m)) {
        return INSOLE_ERR_VALUE;
    }
    insole_real_t height_m = anchor->anchor_m_m.z + position_n_m.z - anchor->anchor_n_m.z;
    anchor->anchor_n_m = position_n_m;
    anchor->anchor_m_m = insole_vec3(start->x_m, start->y_m, height_m);
    anchor->var_m2 = insole_square(start->sigma_m);
    anchor->strides_left = 0u;
    if (start->has_heading) {
        anchor->heading_rad = start->heading_rad;
        anchor->var_rad2 = insole_square(start->sigma_rad);
        anchor->t_us = t_us;
        anchor->strides_left = START_STRIDES;
    }
    return INSOLE_OK;
}

insole_status_t insole_foot_anchor_follow(insole_foot_anchor_t *anchor, insole_vec3_t position_n_m,
                                          bool stride_ended)
{
    if (!anchor) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_vec3_is_finite(position_n_m)) {
        return INSOLE_ERR_VALUE;
    }
    if (anchor->strides_left == 0u) {
        return INSOLE_OK;
    }
    insole_vec3_t way = insole_vec3_sub(position_n_m, anchor->anchor_n_m);
    if (way.x * way.x + way.y * way.y > insole_square(WAY_WITH_DIRECTION_M)) {
        anchor->yaw_rad = insole_wrap_pi(anchor->heading_rad - insole_atan2(way.y, way.x));
        anchor->turn = insole_turn(anchor->yaw_rad);
    }
    anchor->strides_left -= stride_ended ? 1u : 0u;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_foot_anchor_renew(insole_foot_anchor_t *anchor,
                                                     const insole_fix_t *fix_m,
                                                     insole_vec3_t position_n_m,
                                                     insole_real_t turn_rad2)
{
    if (!anchor || !fix_m) {
        return INSOLE_ERR_NULL;
    }
    insole_real_t var_m2 = insole_max(fix_m->var_x_m2, fix_m->var_y_m2);
    if (!insole_vec3_is_finite(fix_m->position_m) || !insole_vec3_is_finite(position_n_m) ||
        !insole_is_finite(var_m2) || !(turn_rad2 >= ZERO) || !insole_is_finite(turn_rad2)) {
        return INSOLE_ERR_VALUE;
    }
    anchor->anchor_n_m = position_n_m;
    anchor->anchor_m_m = fix_m->position_m;
    anchor->var_m2 = var_m2;
    anchor->var_rad2 += turn_rad2;
    return INSOLE_OK;
}

/* 1-sigma squared of the turn at a later time. */
static insole_real_t turn_variance(const insole_foot_anchor_t *a, uint64_t t_us)
{
    insole_real_t age_s = t_us > a->t_us ? insole_seconds_of(t_us - a->t_us) : ZERO;
    return insole_min(a->var_rad2 + insole_square(age_s * a->drift_radps), ANY_TURN_RAD2);
}

/* Rounding may leave the variance of what has just been fixed a hair below zero. */
static insole_real_t positive(insole_real_t variance)
{
    return insole_max(variance, ZERO);
}

INSOLE_COLD static void wrap_heading(insole_fix_t *fix)
{
    fix->heading_rad = insole_wrap_pi(fix->heading_rad);
}

/* What may call another function comes last: nothing need be kept then. */
void insole_foot_anchor_place(const insole_foot_anchor_t *anchor, const insole_vec3_t *position_n_m,
                              const insole_sym3_t *cov_n_m2, insole_fix_t *fix)
{
    const insole_foot_anchor_t *a = anchor;
    insole_real_t var_yaw = turn_variance(a, fix->t_us), c = a->turn.cos, s = a->turn.sin;
    insole_real_t xx = cov_n_m2->xx, xy = cov_n_m2->xy, yy = cov_n_m2->yy;
    insole_vec3_t d = insole_vec3_sub(*position_n_m, a->anchor_n_m);
    insole_vec3_t way = insole_vec3(c * d.x - s * d.y, s * d.x + c * d.y, d.z);
    insole_real_t cs2 = INSOLE_R(2.0) * c * s * xy;
    insole_real_t var_x = c * c * xx - cs2 + s * s * yy, var_y = s * s * xx + cs2 + c * c * yy;
    insole_real_t cov = c * s * (xx - yy) + (c * c - s * s) * xy;
    fix->position_m = insole_vec3_add(a->anchor_m_m, way);
    fix->var_x_m2 = positive(var_x + (a->var_m2 + var_yaw * way.y * way.y));
    fix->cov_xy_m2 = cov - var_yaw * way.x * way.y;
    fix->var_y_m2 = positive(var_y + (a->var_m2 + var_yaw * way.x * way.x));
    fix->var_z_m2 = positive(cov_n_m2->zz);
    fix->var_heading_rad2 = positive(fix->var_heading_rad2 + var_yaw);
    fix->heading_rad += a->yaw_rad;
    if (insole_abs(fix->heading_rad) >= INSOLE_PI) {
        wrap_heading(fix);
    }
}

insole_status_t insole_foot_anchor_to_map(const insole_foot_anchor_t *anchor, insole_fix_t *fix)
{
    if (!fix) {
        return INSOLE_ERR_NULL;
    }
    insole_vec3_t position_n_m = fix->position_m;
    insole_sym3_t P = {fix->var_x_m2, fix->cov_xy_m2, ZERO, fix->var_y_m2, ZERO, fix->var_z_m2};
    return insole_foot_anchor_put(anchor, &position_n_m, &P, fix);
}
