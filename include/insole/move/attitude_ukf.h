/** @file attitude_ukf.h  Correction of an attitude by a direction: unscented Kalman filter.
 *
 *  Source  [PhoneUKF] 5.2.2, eqs. (14)-(18).
 *  Frames  n: local level, z up.
 *
 *      insole_attitude_push(&phone, insole_attitude_ukf, &imu, 0u);
 *
 *  Sigma points stay on the unit sphere: they are rotation vectors a in n, three dimensions, drawn
 *  from P about zero, and stand for the attitudes exp(a) q; the correction is a rotation vector
 *  again. Two points a and -a see the known direction e turned by exp(-+a): what both share is
 *  e + 2 v x (v x e), what they differ in -+2 w v x e with (w, v) the quaternion of a; so that
 *  six turns cost three, and means take the one part, P_az the other. The prediction is linear in
 *  the paper too and stands in attitude.h. The blocks of (11), gravity and magnetic field,
 *  correct one after the other, each when it comes.
 *
 *  Weights: alpha 1, beta 2, kappa 0 (base/unscented.h says why not the paper's small alpha).
 *  A P that has no root, by rounding or damage, is replaced by the nearest that has one
 *  (insole_cholesky).
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_ATTITUDE_UKF_H
#define INSOLE_MOVE_ATTITUDE_UKF_H

#include "insole/move/attitude.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The method of insole_attitude_push().
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_STATE when the innovation's covariance is not positive or
 *          the result not finite */
insole_status_t insole_attitude_ukf(insole_sym3_t *P, const insole_sighting_t *sighting,
                                    insole_correction_t *correction);

#ifdef __cplusplus
}
#endif

#endif
