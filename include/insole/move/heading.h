/** @file heading.h  Which way a phone points, and how well that is known.
 *
 *  Source  [PhoneEKF] 3.1.2, eqs. (6), (30).
 *  Frames  b: phone, x right, y to its top, z out of the screen.  n: local level, z up.
 *
 *  Ahead is the level part of the phone's y axis. Where that axis is steep (its level part under
 *  0.35: more than 69.5 degrees from level) it is that of the back, -z, if the top points up, and
 *  of the screen, z, if it points down: who pitches the phone through the vertical keeps the
 *  heading. One of the two always has a direction, so that every attitude has a heading.
 *
 *  The papers count yaw from the navigation frame's +y; it is turned into a heading, which counts
 *  from +x, here and nowhere else.
 *
 *      insole_heading_t heading = insole_heading(q, &P);
 *      x_m += length_m * heading.ahead.cos;
 *      y_m += length_m * heading.ahead.sin;
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_HEADING_H
#define INSOLE_MOVE_HEADING_H

#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_turn_t ahead;       /**< the direction itself, of unit length */
    insole_real_t heading_rad; /**< counter-clockwise from +x, (-pi, pi] */
    insole_vec3_t jacobian;    /**< of the heading by the small rotation in n */
    insole_real_t variance_rad2;
} insole_heading_t;

/** @param q    b to n, of unit length
 *  @param cov  of the small rotation in n [rad^2]; NULL: variance 0 */
insole_heading_t insole_heading(insole_quat_t q, const insole_sym3_t *cov);

#ifdef __cplusplus
}
#endif

#endif
