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
 *  `best` without a building is the first order, as the settings have it.
 *
 *  Smoothing holds fixes of the first order back: those of a long window are smoothed together, the
 *  older part leaves, the newer waits for what comes after it.
 *
 *  `wifi` gives a fix for each scan. IMU readings only tell it the time: at each the last fix
 * holds, for as long as RADIO_FRESH_US as state track, then as coast. Where a moment has ranges and
 * signal strengths it uses the ranges.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_ESTIMATOR_H
#define INSOLE_HOST_ESTIMATOR_H

#include "insole/track/foot_smooth.h"

#include "foot_events.h"
#include "method.h"
#include "radio_group.h"
#include "record.h"
#include "track.h"

/** What a start that does not tell its own is taken for. */
#define START_SIGMA_M   0.3
#define START_SIGMA_RAD 0.09

#define RADIO_FRESH_US INT64_C(5000000)

/** Radio so far ahead of the IMU has a stamp that cannot be [us]. */
#define RADIO_AHEAD_US INT64_C(60000000)

/** What an estimator is made of. */
typedef struct {
    const settings_t *settings; /**< stay where they are */
    method_t method;
    const insole_building_t *building; /**< its place is the caller's; NULL: nothing is known */
    uint32_t particles;
    uint64_t seed;
    bool is_smooth; /**< for the first order only */
} estimator_setup_t;

/** What became of the radio. */
typedef struct {
    unsigned long scans, ranges; /**< told; scans of several readings, single ranges */
    unsigned long worked_in;     /**< times that either was worked in */
    unsigned long wild;          /**< moments left out because of their stamps */
} radio_counts_t;

typedef struct {
    estimator_setup_t setup;
    bool is_fused;                 /**< the particles make the position */
    insole_building_t building;    /**< with the settings of this run */
    insole_foot_fusion_t fusion;   /**< its `foot` alone is the tracker of the first order */
    insole_fusion_memory_t memory; /**< lent to it */
    radio_group_t radio;           /**< of the moment that is being read */
    radio_counts_t counts;
    foot_events_t events;
    bool has_imu;
    int64_t imu_us; /**< newest */

    bool is_due;           /**< wifi: a reading of the IMU asks for a row */
    track_row_t radio_row; /**< wifi: last fix */
    int64_t radio_us;      /**< wifi: its time */

    insole_fix_t fix; /**< newest, until taken */
    bool has_fix;
    insole_foot_smooth_t past;
    insole_zupt_node_t *nodes; /**< of the past; NULL unless smoothed */
    insole_foot_past_t *fixes;
    bool is_held; /**< `fix` waits for room in the past */
} estimator_t;

/** @return false when the library does not take the settings */
bool estimator_init(estimator_t *estimator, const estimator_setup_t *setup);

void estimator_free(estimator_t *estimator);

/** Takes START, IMU, RSS and RANGE records; others mean nothing to it. The ids of the radio are
 *  indexes of access points. */
void estimator_push(estimator_t *estimator, const record_t *record);

/** One fix more is computed, or a part of one. @return false when the tracker has nothing to do */
bool estimator_step(estimator_t *estimator);

/** The next fix that is as good as it gets. */
bool estimator_take(estimator_t *estimator, track_row_t *fix);

/** Something that happened with the last step. */
bool estimator_event(estimator_t *estimator, foot_event_t *event);

/** Has radio or a start put the track on the map of the building? The first order alone knows of no
 *  such map. */
bool estimator_is_placed(const estimator_t *estimator);

/** The log has ended: the tracker gives what it holds. */
void estimator_finish(estimator_t *estimator);

/** No step is left: nothing waits for what comes after it any more. */
void estimator_settle(estimator_t *estimator);

#endif
