/** @file step_ukf.h  The way of a pace by the unscented transform.
 *
 *  Source  [PhoneUKF] 6.2, eqs. (38)-(41).
 *  Frames  that of the pace's heading.
 *
 *      insole_step_fusion_step(&fusion, insole_step_ukf, &pace);
 *
 *  Five points of (heading, length). A heading that is not known well makes a way shorter in the
 *  mean, and its covariance a bow: what linearisation does not see. Weights for normal errors,
 *  right to the fourth power of the heading's error; no weight is negative. The five leave out the
 *  product of both variances.
 *
 *  The way is the mean of what may have been walked, given the heading told. When headings scatter
 *  about one direction that is walked for long, the ways told are too short in that direction
 *  already, and shortening them again does harm: tell the variance of the direction walked, not
 *  the scatter of what was measured.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_STEP_UKF_H
#define INSOLE_FUSE_STEP_UKF_H

#include "insole/fuse/step_fusion.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A method of insole_step_fusion_step(). */
insole_step_way_t insole_step_ukf(const insole_pace_t *pace);

/** A step fusion with this method for a tracker; the state is an `insole_step_fusion_t`. */
extern const insole_step_filter_calls_t insole_step_ukf_calls;

#ifdef __cplusplus
}
#endif

#endif
