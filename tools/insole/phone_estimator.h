/** @file phone_estimator.h  The library's phone tracker, fed with records.
 *
 *  Used as estimator.h tells.
 *
 *  Of radio alone each scan is a fix until readings of the IMU tell the time; then the last fix
 *  holds at each of them.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PHONE_ESTIMATOR_H
#define INSOLE_HOST_PHONE_ESTIMATOR_H

#include "insole/track/phone_tracker.h"

#include "insole/sense/carry_table.h"

#include "estimator_setup.h"
#include "event.h"
#include "phone_parts.h"
#include "radio_group.h"
#include "track.h"

/** A reading tells the steps of a walk that has begun; a scan before it and their fixes. */
enum { PHONE_EVENTS = 2 * (INSOLE_PHONE_WAY_STEPS + 4) };

typedef struct {
    estimator_setup_t setup;
    phone_parts_t parts;
    insole_phone_tracker_t tracker;
    radio_group_t radio; /**< of the moment that is being read */
    radio_counts_t counts;
    bool has_imu;
    int64_t imu_us;                           /**< newest */
    uint32_t reached;                         /**< fixes by radio that have been looked at */
    uint32_t starts;                          /**< of the filter, the same */
    uint32_t steps;                           /**< the same */
    uint32_t carried[INSOLE_CARRY_POSITIONS]; /**< steps of them by carrying position */
    insole_fix_t fix;                         /**< newest, until taken */
    bool has_fix;
    event_t events[PHONE_EVENTS];
    int event_count, event_taken;
} phone_estimator_t;

/** @return false when the library does not take the settings */
bool phone_estimator_init(phone_estimator_t *estimator, const estimator_setup_t *setup);

void phone_estimator_free(phone_estimator_t *estimator);

/** Takes START, IMU, MAG and RSS records; others mean nothing to it. */
void phone_estimator_push(phone_estimator_t *estimator, const record_t *record);

bool phone_estimator_step(phone_estimator_t *estimator);
bool phone_estimator_take(phone_estimator_t *estimator, track_row_t *fix);
bool phone_estimator_event(phone_estimator_t *estimator, event_t *event);
bool phone_estimator_is_placed(const phone_estimator_t *estimator);
void phone_estimator_finish(phone_estimator_t *estimator);

#endif
