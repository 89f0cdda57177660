/** @file step_ekf.h  The way of a pace by linearisation: extended Kalman filter.
 *
 *  Source  [PhoneEKF] 3.3, eqs. (31), (33)-(34).
 *  Frames  that of the pace's heading.
 *
 *      insole_step_fusion_step(&fusion, insole_step_ekf, &pace);
 *
 *  The paper's qd = (q, d) enters through heading and length alone: the Jacobian of the way by the
 *  quaternion is that by the heading times that of the heading (heading.h), so that the variance
 *  of the heading says all that the covariance of the quaternion would.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_STEP_EKF_H
#define INSOLE_FUSE_STEP_EKF_H

#include "insole/fuse/step_fusion.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A method of insole_step_fusion_step(). */
insole_step_way_t insole_step_ekf(const insole_pace_t *pace);

/** A step fusion with this method for a tracker; the state is an `insole_step_fusion_t`. */
extern const insole_step_filter_calls_t insole_step_ekf_calls;

#ifdef __cplusplus
}
#endif

#endif
