/** @file foot_estimator.h  The library's foot tracker, fed with records.
 *
 *  Used as estimator.h tells.
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
#ifndef INSOLE_HOST_FOOT_ESTIMATOR_H
#define INSOLE_HOST_FOOT_ESTIMATOR_H

#include "insole/track/foot_lag.h"
#include "insole/track/foot_smooth.h"

#include "estimator_setup.h"
#include "foot_events.h"
#include "radio_group.h"
#include "track.h"

typedef struct {
    estimator_setup_t setup;
    bool is_fused;                 /**< the particles make the position */
    insole_building_t building;    /**< with the settings of this run */
    insole_foot_fusion_t fusion;   /**< its `foot` alone is the tracker of the first order */
    insole_fusion_memory_t memory; /**< lent to it */
    insole_fusion_ranges_t ranges;
    insole_fusion_start_t start; /**< for a start by several fixes */
    insole_foot_late_t late;     /**< its fixes, with a lag */
    radio_group_t radio;         /**< of the moment that is being read */
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
} foot_estimator_t;

/** @return false when the library does not take the settings */
bool foot_estimator_init(foot_estimator_t *estimator, const estimator_setup_t *setup);

void foot_estimator_free(foot_estimator_t *estimator);

/** Takes START, IMU, RSS and RANGE records; others mean nothing to it. The ids of the radio are
 *  indexes of access points. */
void foot_estimator_push(foot_estimator_t *estimator, const record_t *record);

/** One fix more is computed, or a part of one. @return false when the tracker has nothing to do */
bool foot_estimator_step(foot_estimator_t *estimator);

/** The next fix that is as good as it gets. */
bool foot_estimator_take(foot_estimator_t *estimator, track_row_t *fix);

/** Something that happened with the last step. */
bool foot_estimator_event(foot_estimator_t *estimator, event_t *event);

/** Has radio or a start put the track on the map of the building? The first order alone knows of no
 *  such map. */
bool foot_estimator_is_placed(const foot_estimator_t *estimator);

/** The log has ended: the tracker gives what it holds. */
void foot_estimator_finish(foot_estimator_t *estimator);

/** No step is left: nothing waits for what comes after it any more. */
void foot_estimator_settle(foot_estimator_t *estimator);

#endif
