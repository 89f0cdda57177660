/** @file estimator.h  The library's tracker behind one face; nothing else here calls it.
 *
 *  It takes records and gives rows, both on the log's clock. There is no way in for truth.
 *
 *      estimator_init(&estimator, &settings, is_smooth);
 *      estimator_push(&estimator, &record);
 *      while (estimator_step(&estimator)) {
 *          while (estimator_event(&estimator, &event)) ...
 *          while (estimator_take(&estimator, &fix)) ...
 *      }
 *      estimator_finish(&estimator);         then step again; then
 *      estimator_settle(&estimator);         and take what is left
 *      estimator_free(&estimator);
 *
 *  Smoothing holds fixes back: those of a long window are smoothed together, the older part leaves,
 *  the newer waits for what comes after it.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_ESTIMATOR_H
#define INSOLE_HOST_ESTIMATOR_H

#include "insole/track/foot_smooth.h"

#include "record.h"
#include "settings.h"
#include "track.h"

/** What a start that does not tell its own is taken for. */
#define START_SIGMA_M   0.3
#define START_SIGMA_RAD 0.09

/** Something that happened to the foot. */
typedef struct {
    int64_t begin_us, end_us;
    bool is_stride;        /**< false: a stance, of which only the times are told */
    double length_m;       /**< horizontal */
    double height_m;       /**< climbed */
    double heading_rad;    /**< direction, m */
    double turn_rad;       /**< of the foot */
    double model_length_m; /**< by [TwoOrder (33)] */
    double accel_min_mps2, accel_max_mps2;
} foot_event_t;

typedef struct {
    sensor_config_t sensor;
    insole_foot_tracker_t foot;
    int64_t fix_us;          /**< of the last fix */
    int64_t stance_begin_us; /**< of the stance in progress */
    bool is_still;
    foot_event_t stance, stride; /**< newest, until taken */
    bool has_stance, has_stride;
    insole_fix_t fix; /**< newest, until taken */
    bool has_fix, is_smooth;
    insole_foot_smooth_t past;
    insole_zupt_node_t *nodes; /**< of the past; NULL unless smoothed */
    insole_foot_past_t *fixes;
    bool is_held; /**< `fix` waits for room in the past */
} estimator_t;

/** @return false when the library does not take the settings */
bool estimator_init(estimator_t *estimator, const settings_t *settings, bool is_smooth);

void estimator_free(estimator_t *estimator);

/** Takes START and IMU records; others mean nothing to it. */
void estimator_push(estimator_t *estimator, const record_t *record);

/** One fix more is computed. @return false when the tracker has none */
bool estimator_step(estimator_t *estimator);

/** The next fix that is as good as it gets. */
bool estimator_take(estimator_t *estimator, track_row_t *fix);

/** A stance or stride that ended with the last step. */
bool estimator_event(estimator_t *estimator, foot_event_t *event);

/** The log has ended: the tracker gives what it holds. */
void estimator_finish(estimator_t *estimator);

/** No step is left: nothing waits for what comes after it any more. */
void estimator_settle(estimator_t *estimator);

#endif
