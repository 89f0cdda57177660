/** @file yaw_track.h  How far a phone has turned about the vertical, however it lies.
 *
 *  Frames  b: phone, any mounting.  n: local level, z up.
 *
 *  A direction in b that is level while the phone lies as it does on average stays near the level
 *  when a thigh, an arm or a hand swings, so that its heading has no place where it jumps, as that
 *  of a fixed edge of the phone has. When the phone is tipped over, another direction is chosen,
 *  and the turn goes on from where it was.
 *
 *      insole_yaw_track_t yaw;
 *      insole_yaw_track_init(&yaw, INSOLE_R(0.9));
 *      on each sample, after the attitude:
 *          if (insole_yaw_track_push(&yaw, phone.q, imu.t_us)) ...     it was tipped over
 *          use(yaw.turned_rad);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_YAW_TRACK_H
#define INSOLE_MOVE_YAW_TRACK_H

#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_real_t tipped_cos;
    bool has_axis;
    uint64_t t_us;            /**< of the newest sample */
    insole_vec3_t up;         /**< b, of unit length: mean of the last second */
    insole_vec3_t lay;        /**< b, of unit length: that mean when the axis was chosen */
    insole_vec3_t axis;       /**< b, of unit length, at right angles to it */
    insole_real_t offset_rad; /**< added to the heading of the axis */
    insole_real_t turned_rad; /**< n, counter-clockwise, (-pi, pi], from 0 */
    uint32_t laid;            /**< how often an axis was chosen */
} insole_yaw_track_t;

/** @param tipped_rad  a phone is tipped over when its mean lie has changed by more, 0.1 .. 3.2
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_yaw_track_init(insole_yaw_track_t *yaw, insole_real_t tipped_rad);

/** Takes an attitude, times do not fall.
 *  @param q  b to n, of unit length
 *  @return whether the phone was tipped over; true for the first one */
bool insole_yaw_track_push(insole_yaw_track_t *yaw, insole_quat_t q, uint64_t t_us);

#ifdef __cplusplus
}
#endif

#endif
