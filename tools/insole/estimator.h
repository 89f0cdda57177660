/** @file estimator.h  The library's tracker behind one face; nothing else here calls it.
 *
 *  It takes records and gives rows, both on the log's clock. There is no way in for truth.
 *
 *      estimator_init(&estimator, &settings);
 *      estimator_push(&estimator, &record);
 *      while (estimator_next(&estimator, &fix)) ...
 *      estimator_finish(&estimator);         then take what is left
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_ESTIMATOR_H
#define INSOLE_HOST_ESTIMATOR_H

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
} estimator_t;

/** @return false when the library does not take the settings */
bool estimator_init(estimator_t *estimator, const settings_t *settings);

/** Takes START and IMU records; others mean nothing to it. */
void estimator_push(estimator_t *estimator, const record_t *record);

bool estimator_next(estimator_t *estimator, track_row_t *fix);

/** A stance or stride that ended with the last fix. */
bool estimator_event(estimator_t *estimator, foot_event_t *event);

/** The log has ended. */
void estimator_finish(estimator_t *estimator);

#endif
