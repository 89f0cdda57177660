/** @file replay.h  A session through the tracker: rows and events out, facts in the end.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPLAY_H
#define INSOLE_HOST_REPLAY_H

#include "estimator.h"
#include "sensor_stream.h"

/** What is to be replayed, and how. */
typedef struct {
    const char *const *logs; /**< files, folders or `-` */
    size_t log_count;
    settings_t settings;
    const char *accel_unit, *gyro_unit; /**< NULL: m/s^2, rad/s */
    double rate_hz;                     /**< rows per second; 0: one per fix */
    bool is_smooth;                     /**< what comes after a moment counts for it too */
    bool has_start;                     /**< `start` counts, those in the logs do not */
    bool no_start;                      /**< those in the logs do not count */
    record_t start;                     /**< its time is that of the first reading */
} replay_request_t;

/** Where the results go; a NULL function is not called. Each answers false to stop. */
typedef struct {
    void *context;
    /** The logs are open, nothing has been read: the time to open what will be written. */
    bool (*begin)(void *context, const session_t *session, failure_t *failure);
    bool (*row)(void *context, const track_row_t *row, failure_t *failure);
    bool (*event)(void *context, const foot_event_t *event, failure_t *failure);
} replay_sink_t;

/** What is known after a replay. */
typedef struct {
    unsigned long seen[RECORD_KINDS]; /**< records in the logs */
    unsigned long readings;           /**< IMU readings handed to the tracker */
    int64_t first_us, last_us;        /**< of the fixes */
    unsigned long fixes, strides;
    double walked_m;                 /**< sum of the strides */
    double fastest_radps;            /**< largest turn rate */
    bool knows_place, knows_heading; /**< by a start */
    int64_t start_us;                /**< of the first start: what was before is not on the map */
    track_row_t last;                /**< fix */
    insole_screen_counts_t screen;
    insole_foot_counts_t foot;
    double gravity_mps2; /**< as the tracker took it in the end */
    unsigned long rests; /**< of the sensor, not stances of a walk */
    track_t truth;       /**< found in the logs; never shown to the tracker */
} replay_facts_t;

/** @param[out] facts  to be freed by replay_facts_free, also after a failure */
bool replay_run(const replay_request_t *request, const replay_sink_t *sink, replay_facts_t *facts,
                failure_t *failure);

void replay_facts_free(replay_facts_t *facts);

#endif
