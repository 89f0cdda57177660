/** @file phone_gait.h  Where a step goes that a phone does not point: by the gait.
 *
 *  Source  [PhoneUKF] 5.3, 6.2.
 *  Frames  b: phone.  n: level, that of the attitude.
 *
 *  The gait tells the direction of each step (walk_heading.h). It is used step by step, or, the
 *  default, as a mean: the angle between where the phone points and where the gait goes stays the
 *  same while the phone is carried in the same way, so its mean over the last steps is far better
 *  than each, and turns are those of the phone. When the position changes, or the phone is tipped
 *  over, the mean begins anew. Step by step, the direction of one whose end is not certain counts
 *  as unknown: it may be the opposite one. Which position it is, carry.h tells, if it is there and
 *  the setting `faces` asks it; until it knows, the phone points ahead. The settings are those of
 *  the walk (phone_walk.h).
 *
 *      insole_phone_gait_init(&gait, &heading, &carry, &insole_carry_table_forest);
 *      insole_phone_guide_t guide = {&insole_phone_gait_calls, &gait};
 *      insole_phone_walk_init(&walk, &insole_phone_walk_defaults, &guide);
 *
 *  A walk that names no guide links nothing of this.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_PHONE_GAIT_H
#define INSOLE_TRACK_PHONE_GAIT_H

#include "insole/move/walk_heading.h"
#include "insole/sense/carry.h"
#include "insole/track/phone_walk.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The angle from where the phone points to where its walker goes. */
typedef struct {
    insole_turn_t sum; /**< weighted by what each step knew of it; 0, 0: nothing is known */
    insole_vec3_t up;  /**< b, of unit length: as the phone lay while it was learned */
} insole_phone_askew_t;

typedef struct {
    insole_walk_heading_t *heading;      /**< NULL: a step always goes where the phone points */
    insole_carry_t *carry;               /**< NULL: nobody knows the position */
    const insole_carry_forest_t *forest; /**< NULL: as without carry */
    insole_vec3_t up;                    /**< b, of unit length, smoothed */
    insole_phone_askew_t askew;
} insole_phone_gait_t;

extern const insole_phone_guide_calls_t insole_phone_gait_calls;

/** @param heading  a state that was set up, or NULL; so `carry`
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_DATA for a forest that is none */
insole_status_t insole_phone_gait_init(insole_phone_gait_t *gait, insole_walk_heading_t *heading,
                                       insole_carry_t *carry, const insole_carry_forest_t *forest);

#ifdef __cplusplus
}
#endif

#endif
