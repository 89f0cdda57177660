/** @file fusion_fix.h  A fix of the foot becomes one of the cloud.
 *
 *  Between strides the position moves on with the foot, as the cloud on the whole would go.
 *
 *  Frames  n: level, as the inertial filter left it.  m: map.
 *
 *      insole_fusion_fix_by_cloud(&particles.fix, then_n_m, now_n_m, anchor.yaw_rad, &fix);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FUSION_FIX_H
#define INSOLE_TRACK_FUSION_FIX_H

#include "insole/fuse/particle_cloud.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Place, heading and what is not known of them are the cloud's, height and state stay the foot's.
 *  @param then_n_m  where the foot was when the cloud was as told
 *  @param now_n_m   where it is
 *  @param yaw_rad   turn from n to m by which the foot's fix was made
 *  @return INSOLE_ERR_NULL */
insole_status_t insole_fusion_fix_by_cloud(const insole_cloud_fix_t *cloud, insole_spot_t then_n_m,
                                           insole_spot_t now_n_m, insole_real_t yaw_rad,
                                           insole_fix_t *fix);

#ifdef __cplusplus
}
#endif

#endif
