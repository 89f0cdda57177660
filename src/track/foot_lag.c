/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_lag.h"

#include <stddef.h>

static insole_status_t take(insole_foot_late_t *late, const insole_foot_fusion_t *f,
                            insole_fix_t *fix)
{
    insole_cloud_t cloud = insole_fusion_cloud(&f->memory);
    return insole_foot_late_take(late, &f->particles, &cloud, f->counts.starts, fix);
}

/* A fix goes in at the young end of what waits, and where the newest stride ended. */
static insole_status_t push_next(insole_foot_late_t *late, insole_foot_fusion_t *f)
{
    insole_late_row_t row;
    if (insole_foot_fusion_next(f, &row.fix) != INSOLE_OK) {
        return INSOLE_ERR_STATE;
    }
    (void)insole_foot_late_stride(late, f->particles.since_start, f->strides.told_n_m);
    row.n_m = insole_spot(f->foot.zupt_ekf.p_m.x, f->foot.zupt_ekf.p_m.y);
    row.stride = f->particles.since_start;
    row.start = f->counts.starts;
    return insole_foot_late_push(late, &row);
}

static insole_status_t next_late(insole_foot_late_t *late, insole_foot_fusion_t *f,
                                 insole_fix_t *fix)
{
    uint32_t lag_us = insole_microseconds(f->config.lag_s);
    while (!insole_foot_late_is_due(late, lag_us)) {
        if (f->finished && f->working) {
            return INSOLE_ERR_STATE;
        }
        if (push_next(late, f) != INSOLE_OK) {
            return f->finished ? take(late, f, fix) : INSOLE_ERR_STATE;
        }
    }
    return take(late, f, fix);
}

insole_status_t insole_foot_lag_next(insole_foot_late_t *late, insole_foot_fusion_t *fusion,
                                     insole_fix_t *fix)
{
    if (!late || !fusion || !fix) {
        return INSOLE_ERR_NULL;
    }
    bool lags = fusion->config.lag_s > INSOLE_R(0.0) && fusion->config.method != INSOLE_FUSION_WIFI;
    if (lags && !late->rows) {
        return INSOLE_ERR_NULL;
    }
    return lags ? next_late(late, fusion, fix) : insole_foot_fusion_next(fusion, fix);
}
