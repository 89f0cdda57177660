/** @file phone_aside.h  A phone that was taken to point ahead proves to point aside.
 *
 *  Frames  m: map.  n: level, that of the attitude.
 *
 *  Either it has done so all the time, and its walker's heading was told or fixes have shown it:
 *  then the offset from n to m that came of that holds the angle, and the way is right. Or the
 *  offset is older, or a compass told it: then that is right, and the way since the phone lies so
 *  went astray. In doubt the compass decides, if there is one.
 *
 *      insole_step_filter_begin_t anew = {.t_us = t_us, .spot = spot, .offset_rad = offset_rad};
 *      insole_phone_aside_t aside = {askew_rad, way, true};
 *      insole_phone_aside_turn(&anew, &sight, &aside);
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

/** What has proved. */
typedef struct {
    insole_real_t askew_rad; /**< from where the phone points to where its walker goes */
    insole_spot_t way;       /**< n, of the steps that have gone aside, as they were taken */
    bool may_be_held;        /**< the offset may hold the angle */
} insole_phone_aside_t;

/** @param at     where the filter is; where it is to begin anew
 *  @param sight  of the compass
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for an angle or a way that is not finite */
insole_status_t insole_phone_aside_turn(insole_step_filter_begin_t *at,
                                        const insole_phone_sight_t *sight,
                                        const insole_phone_aside_t *aside);

#ifdef __cplusplus
}
#endif

#endif
