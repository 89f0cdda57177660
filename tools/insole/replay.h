/** @file replay.h  A session through the tracker: rows and events out, facts in the end.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPLAY_H
#define INSOLE_HOST_REPLAY_H

#include "estimator.h"
#include "sensor_stream.h"
#include "site.h"

/** Particles of the cloud where nobody tells. */
enum { REPLAY_PARTICLES = 500 };

/** What is to be replayed, and how. */
typedef struct {
    const char *const *logs; /**< files, folders or `-` */
    size_t log_count;
    settings_t settings;
    tracker_t tracker;
    method_t method;
    const site_t *site;                 /**< NULL: nothing is known of the building */
    uint32_t particles;                 /**< of the cloud */
    uint64_t seed;                      /**< of its random numbers */
    bool no_rss, no_range;              /**< those records do not count */
    bool leaves_radiomap;               /**< fingerprints were told that nobody takes */
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
    bool (*event)(void *context, const event_t *event, failure_t *failure);
} replay_sink_t;

/** What became of radio and cloud. */
typedef struct {
    bool is_fused; /**< building or radio made the position */
    unsigned long walls, aps;
    bool leaves_radiomap;           /**< fingerprints were told that nobody takes */
    unsigned long ids, unknown_ids; /**< of access points in the logs */
    radio_counts_t radio;
    insole_fusion_counts_t waits; /**< of what radio told */
    uint32_t starts;              /**< times the particles were drawn */
    insole_particle_counts_t particles;
    bool has_offset;
    double offset_db;      /**< the receiver hears so much stronger than expected */
    track_t cloud;         /**< the living particles at the end, the heaviest last; only places */
    unsigned long outside; /**< fixes well outside the plan, since the track is on the map */
    bool starts_outside;
    double start_distance_m; /**< then: from the nearest wall, at most REPLAY_FAR_M */
} replay_fusion_t;

#define REPLAY_FAR_M 1000.0

/** What the phone tracker tells of itself. */
typedef struct {
    unsigned long points, aps;                     /**< of the radio map */
    unsigned long unplaced;                        /**< scans that gave no position */
    unsigned long magnetic;                        /**< readings of the magnetometer taken */
    unsigned long starts;                          /**< times the filter was started */
    unsigned long particles;                       /**< that carry the track; 0: none do */
    unsigned long gaps;                            /**< long ones in the readings */
    unsigned long carried[INSOLE_CARRY_POSITIONS]; /**< steps by recognised position */
} replay_phone_t;

/** What is known after a replay. */
typedef struct {
    method_t method;
    unsigned long seen[RECORD_KINDS];          /**< records in the logs */
    unsigned long readings;                    /**< IMU readings handed to the tracker */
    int64_t first_us, last_us;                 /**< of the fixes */
    unsigned long fixes, strides;              /**< with a phone these are steps */
    double walked_m;                           /**< sum of the strides */
    double fastest_radps;                      /**< largest turn rate */
    bool knows_place, knows_heading;           /**< by a start, or by radio */
    int64_t start_us;                          /**< since when: what was before is not on the map */
    unsigned long states[INSOLE_FIX_LOST + 1]; /**< fixes in each */
    track_row_t last;                          /**< fix */
    insole_screen_counts_t screen;
    insole_foot_counts_t foot;
    double gravity_mps2;    /**< as the tracker took it in the end */
    unsigned long rests;    /**< of the sensor, not stances of a walk */
    replay_fusion_t fusion; /**< of a phone only its building and radio, without ranges */
    replay_phone_t phone;
    track_t truth; /**< found in the logs; never shown to the tracker */
} replay_facts_t;

/** @param[out] facts  to be freed by replay_facts_free, also after a failure */
bool replay_run(const replay_request_t *request, const replay_sink_t *sink, replay_facts_t *facts,
                failure_t *failure);

void replay_facts_free(replay_facts_t *facts);

#endif
