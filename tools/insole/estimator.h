/** @file estimator.h  The library's trackers behind one face; nothing else here calls them.
 *
 *  It takes records and gives rows, both on the log's clock. There is no way in for truth.
 *
 *      estimator_init(&estimator, &setup);
 *      estimator_push(&estimator, &record);
 *      while (estimator_step(&estimator)) {
 *          while (estimator_event(&estimator, &event)) ...
 *          while (estimator_take(&estimator, &fix)) ...
 *      }
 *      estimator_finish(&estimator);         then step again; then
 *      estimator_settle(&estimator);         and take what is left
 *      estimator_free(&estimator);
 *
 *  Which tracker it is, the method tells.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_ESTIMATOR_H
#define INSOLE_HOST_ESTIMATOR_H

#include "foot_estimator.h"
#include "phone_estimator.h"

typedef struct {
    bool is_phone;
    foot_estimator_t foot;   /**< all zeros with a phone */
    phone_estimator_t phone; /**< all zeros without */
} estimator_t;

/** @return false when the library does not take the settings */
bool estimator_init(estimator_t *estimator, const estimator_setup_t *setup);

void estimator_free(estimator_t *estimator);

/** Takes START, IMU, MAG, RSS and RANGE records; others mean nothing to it. The ids of the radio
 *  are indexes of access points, or of those of the radio map. */
void estimator_push(estimator_t *estimator, const record_t *record);

/** One fix more is computed, or a part of one. @return false when the tracker has nothing to do */
bool estimator_step(estimator_t *estimator);

/** The next fix that is as good as it gets. */
bool estimator_take(estimator_t *estimator, track_row_t *fix);

/** Something that happened with the last step. */
bool estimator_event(estimator_t *estimator, event_t *event);

/** Has radio or a start put the track on the map of the building? The first order alone knows of no
 *  such map. */
bool estimator_is_placed(const estimator_t *estimator);

/** The log has ended: the tracker gives what it holds. */
void estimator_finish(estimator_t *estimator);

/** No step is left: nothing waits for what comes after it any more. */
void estimator_settle(estimator_t *estimator);

#endif
