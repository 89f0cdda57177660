/** @file phone_aside.h  A phone that was taken to point ahead proves to point aside.
 *
 *  Frames  m: map.  n: level, that of the attitude.
 *
 *  Either its walker's heading was told, or fixes have shown it: then the offset from n to m that
 *  came of that holds the angle, and the way that was walked is right. Or a compass told the
 * offset: then that is right, and the way since the phone lies so went astray. The compass decides,
 * if there is one.
 *
 *      insole_step_filter_begin_t anew = {.t_us = t_us, .spot = spot, .offset_rad = offset_rad};
 *      insole_phone_aside_turn(&anew, &sight, askew_rad, way);
 *      filter.calls->start(filter.state, &anew);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_PHONE_ASIDE_H
#define INSOLE_TRACK_PHONE_ASIDE_H

#include "insole/fuse/step_filter.h"
#include "insole/track/phone_compass.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @param at        where the filter is; where it is to begin anew
 *  @param sight     of the compass
 *  @param askew_rad from where the phone points to where its walker goes
 *  @param way       n, of the steps that have gone aside, as they were taken
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for an angle or a way that is not finite */
insole_status_t insole_phone_aside_turn(insole_step_filter_begin_t *at,
                                        const insole_phone_sight_t *sight, insole_real_t askew_rad,
                                        insole_spot_t way);

#ifdef __cplusplus
}
#endif

#endif
