/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_strides.h"

#include <stddef.h>

#include "insole/base/fastmath.h"

#define ZERO INSOLE_R(0.0)

static void forget_waiting(insole_fusion_strides_t *strides)
{
    strides->waiting = 0u;
    strides->turn_rad = strides->model_m = ZERO;
}

INSOLE_COLD void insole_fusion_strides_begin(insole_fusion_strides_t *strides, insole_spot_t n_m)
{
    if (strides) {
        forget_waiting(strides);
        strides->told = 0u;
        strides->told_n_m = strides->done_n_m = n_m;
    }
}

INSOLE_COLD insole_status_t insole_fusion_strides_gather(insole_fusion_strides_t *strides,
                                                         const insole_stride_t *stride)
{
    if (!strides || !stride) {
        return INSOLE_ERR_NULL;
    }
    strides->turn_rad = insole_wrap_pi(strides->turn_rad + stride->turn_rad);
    strides->model_m += stride->model_length_m;
    strides->waiting++;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_fusion_strides_tell(insole_fusion_strides_t *strides,
                                                       insole_spot_t end_n_m, bool by_model,
                                                       insole_evidence_t *evidence)
{
    if (!strides || !evidence) {
        return INSOLE_ERR_NULL;
    }
    insole_real_t dx = end_n_m.x_m - strides->told_n_m.x_m;
    insole_real_t dy = end_n_m.y_m - strides->told_n_m.y_m;
    insole_real_t length_m = by_model ? strides->model_m : insole_sqrt(dx * dx + dy * dy);
    insole_status_t status =
        insole_evidence_stride(evidence, length_m, insole_atan2(dy, dx), strides->turn_rad);
    if (status == INSOLE_OK) {
        strides->told = strides->waiting;
        strides->told_n_m = end_n_m;
        forget_waiting(strides);
    }
    return status;
}

INSOLE_COLD void insole_fusion_strides_done(insole_fusion_strides_t *strides)
{
    if (strides) {
        strides->told = 0u;
        strides->done_n_m = strides->told_n_m;
    }
}

uint32_t insole_fusion_strides_behind(const insole_fusion_strides_t *strides)
{
    return strides ? strides->waiting + strides->told : 0u;
}
