/** @file attitude_ekf.h  Correction of an attitude by a direction: extended Kalman filter.
 *
 *  Source  [PhoneEKF] 3.1.2, eqs. (15)-(16), (19), (21).
 *  Frames  n: local level, z up.
 *
 *      insole_attitude_push(&phone, insole_attitude_ekf, &imu, 0u);
 *
 *  The paper's H = da/dq is, for the small rotation in n and what is seen turned to n, the skew
 *  matrix of what is known: of gravity only two entries are not zero. The three components have
 *  equal, independent noise, before the turn and after; so they correct one after the other, and
 *  nothing is inverted.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_ATTITUDE_EKF_H
#define INSOLE_MOVE_ATTITUDE_EKF_H

#include "insole/move/attitude.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The method of insole_attitude_push().
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_STATE when an innovation's variance is not positive or the
 *          result not finite */
insole_status_t insole_attitude_ekf(insole_sym3_t *P, const insole_sighting_t *sighting,
                                    insole_correction_t *correction);

#ifdef __cplusplus
}
#endif

#endif
