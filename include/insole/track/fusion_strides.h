/** @file fusion_strides.h  Strides on their way to the particles.
 *
 *  Strides that end while the particles are busy are told as one. How many have not come out of the
 *  work yet tells how far the cloud lags behind.
 *
 *  Frames  n: level, as the inertial filter left it.
 *
 *      insole_fusion_strides_begin(&strides, n_m);          where the cloud is drawn
 *      on each stride:          insole_fusion_strides_gather(&strides, &stride);
 *      when the particles are free and strides.waiting > 0:
 *          insole_fusion_strides_tell(&strides, end_n_m, false, &evidence);
 *      when they have done:     insole_fusion_strides_done(&strides);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FUSION_STRIDES_H
#define INSOLE_TRACK_FUSION_STRIDES_H

#include "insole/base/types.h"
#include "insole/fuse/evidence.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint32_t waiting;       /**< not told yet */
    uint32_t told;          /**< being worked in */
    insole_real_t turn_rad; /**< the foot's turn over those that wait */
    insole_real_t model_m;  /**< their length by (33), which the paper walks */
    insole_spot_t told_n_m; /**< n, where the stride told last ended */
    insole_spot_t done_n_m; /**< n, where the one worked in last ended */
} insole_fusion_strides_t;

/** Nothing waits, and the walk goes on from `n_m`. */
void insole_fusion_strides_begin(insole_fusion_strides_t *strides, insole_spot_t n_m);

/** One more that ended. @return INSOLE_ERR_NULL */
insole_status_t insole_fusion_strides_gather(insole_fusion_strides_t *strides,
                                             const insole_stride_t *stride);

/** All that wait, as one from where the last one told ended.
 *  @param by_model  its length is that of the model
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE when they lead farther than a stride may: they wait on
 */
insole_status_t insole_fusion_strides_tell(insole_fusion_strides_t *strides, insole_spot_t end_n_m,
                                           bool by_model, insole_evidence_t *evidence);

/** What was told has been worked in. */
void insole_fusion_strides_done(insole_fusion_strides_t *strides);

/** How many the cloud lags behind. */
uint32_t insole_fusion_strides_behind(const insole_fusion_strides_t *strides);

#ifdef __cplusplus
}
#endif

#endif
