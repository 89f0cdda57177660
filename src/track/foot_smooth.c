/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_smooth.h"

#include <string.h>

#include "insole/base/fastmath.h"

insole_status_t insole_foot_smooth_init(insole_foot_smooth_t *smooth, insole_zupt_node_t *nodes,
                                        insole_foot_past_t *fixes, uint32_t count)
{
    if (!smooth || !nodes || !fixes) {
        return INSOLE_ERR_NULL;
    }
    insole_zupt_smooth_t history;
    insole_status_t status = insole_zupt_smooth_init(&history, nodes, count);
    if (status == INSOLE_OK) {
        memset(smooth, 0, sizeof *smooth);
        smooth->history = history;
        smooth->fixes = fixes;
        smooth->ring = insole_ring(count);
    }
    return status;
}

insole_status_t insole_foot_smooth_push(insole_foot_smooth_t *smooth,
                                        const insole_foot_tracker_t *tracker,
                                        const insole_fix_t *fix)
{
    if (!smooth || !tracker || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (insole_ring_is_full(&smooth->ring)) {
        return INSOLE_ERR_ROOM;
    }
    const insole_zupt_ekf_t *ekf = &tracker->zupt_ekf;
    bool is_filtered = ekf->aligned && tracker->config.method == INSOLE_FOOT_INS;
    insole_foot_past_t *past = &smooth->fixes[insole_ring_push(&smooth->ring)];
    past->fix = *fix;
    past->has_node = is_filtered && insole_zupt_smooth_push(&smooth->history, ekf) == INSOLE_OK;
    past->anchor = tracker->anchor;
    smooth->anchor = tracker->anchor;
    return INSOLE_OK;
}

insole_status_t insole_foot_smooth_run(insole_foot_smooth_t *smooth, uint32_t keep)
{
    if (!smooth) {
        return INSOLE_ERR_NULL;
    }
    uint32_t count = insole_ring_count(&smooth->ring);
    smooth->ready = smooth->ring.end - (keep < count ? keep : count);
    return insole_zupt_smooth_run(&smooth->history, 0u);
}

static bool is_same_point(insole_vec3_t a, insole_vec3_t b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* The same anchor may have found its direction since. */
static const insole_foot_anchor_t *best_anchor(const insole_foot_smooth_t *smooth,
                                               const insole_foot_past_t *past)
{
    const insole_foot_anchor_t *newest = &smooth->anchor, *then = &past->anchor;
    bool is_same = is_same_point(newest->anchor_n_m, then->anchor_n_m) &&
                   is_same_point(newest->anchor_m_m, then->anchor_m_m);
    return is_same ? newest : then;
}

static void put_smoothed(insole_fix_t *fix, const insole_foot_past_t *past,
                         const insole_foot_anchor_t *anchor, const insole_zupt_smoothed_t *after)
{
    fix->position_m = after->p_m;
    fix->var_x_m2 = after->P_pp_m2.xx;
    fix->cov_xy_m2 = after->P_pp_m2.xy;
    fix->var_y_m2 = after->P_pp_m2.yy;
    fix->var_z_m2 = after->P_pp_m2.zz;
    (void)insole_foot_anchor_to_map(anchor, fix);
    insole_real_t turned = anchor->yaw_rad - past->anchor.yaw_rad;
    fix->heading_rad = insole_wrap_pi(past->fix.heading_rad + turned);
    fix->var_heading_rad2 = past->fix.var_heading_rad2;
}

insole_status_t insole_foot_smooth_take(insole_foot_smooth_t *smooth, insole_fix_t *fix)
{
    if (!smooth || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (smooth->ring.begin == smooth->ready) {
        return INSOLE_ERR_STATE;
    }
    uint32_t slot = insole_ring_slot(&smooth->ring, smooth->ring.begin);
    const insole_foot_past_t *past = &smooth->fixes[slot];
    insole_zupt_smoothed_t after;
    *fix = past->fix;
    if (past->has_node && insole_zupt_smooth_take(&smooth->history, &after) == INSOLE_OK) {
        put_smoothed(fix, past, best_anchor(smooth, past), &after);
    }
    insole_ring_pop(&smooth->ring);
    return INSOLE_OK;
}
