/** @file phone_tracker.h  From a phone's sensors to positions: the ready-made path.
 *
 *  screen -> attitude -> heading ----+
 *         -> step -> step_length ----+-> steps -> filter -> position
 *  scans  -> solver of fixes ----------------------^  ^
 *  magnetometer -> offset of the heading -------------+
 *
 *  Source  [PhoneEKF], [PhoneUKF], [WifiShift]: their systems are choices of the parts.
 *  Frames  b: phone.  n: level, as the attitude was at the start.  m: map; without a map and a
 *          start the walk begins at (0, 0) and x is where the phone pointed.
 *
 *      static insole_step_fusion_t fusion;
 *      static insole_kde_fix_t kde;
 *      static insole_phone_tracker_t phone;
 *      insole_step_fusion_init(&fusion, &insole_step_fusion_defaults);
 *      insole_kde_fix_init(&kde, &insole_kde_fix_defaults);
 *      insole_phone_parts_t parts = {.attitude = insole_attitude_ekf,
 *                                    .solver = {&insole_kde_fix_calls, &kde},
 *                                    .filter = {&insole_step_ekf_calls, &fusion}};
 *      insole_phone_tracker_init(&phone, &insole_phone_tracker_defaults, &parts, &map);
 *      on each sample:   insole_phone_tracker_imu(&phone, &imu);
 *                        while (insole_phone_tracker_next(&phone, &fix) == INSOLE_OK) use(&fix);
 *      on each scan:     insole_phone_tracker_scan(&phone, &scan);
 *      in idle time:     while (insole_phone_tracker_work(&phone, 16)) {}
 *
 *  A part that nobody names is not linked. Without a filter radio alone makes the position, without
 *  a solver the steps alone.
 *
 *  Start: the one that was told; without it, where the fixes by radio place the walk, and its
 *  direction by the compass or by the fixes (auto_start.h). Until then the state is `search`.
 *
 *  A phone that is not held in front of its walker needs a guide (phone_gait.h).
 *
 *  The first steps of a walk are held back until there is a rhythm; the position shows them before.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_PHONE_TRACKER_H
#define INSOLE_TRACK_PHONE_TRACKER_H

#include "insole/move/magnetic.h"
#include "insole/track/phone_config.h"
#include "insole/track/phone_radio.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What the tracker is made of. */
typedef struct {
    insole_attitude_method_t *attitude; /**< NULL: the gyro alone */
    insole_radio_solver_t solver;
    insole_step_filter_t filter;
    insole_phone_guide_t guide;      /**< NULL: a step goes where the phone points */
    insole_magnetic_part_t magnetic; /**< push NULL: the field does not correct the attitude */
    const insole_auto_start_circles_t *circles; /**< NULL: no start by that method */
} insole_phone_parts_t;

typedef struct {
    uint32_t fixes;    /**< samples that became a fix */
    uint32_t steps;    /**< told */
    uint32_t gaps;     /**< long ones in the samples */
    uint32_t magnetic; /**< readings of the magnetometer taken */
    uint32_t refused;  /**< calls answered with a negative status */
} insole_phone_counts_t;

typedef struct {
    insole_phone_tracker_own_t config;
    insole_phone_counts_t counts;
    insole_phone_parts_t parts;

    insole_screen_t screen;
    insole_still_bias_t still_bias;
    insole_attitude_t attitude;
    insole_phone_walk_t walk; /**< its `way` holds the last steps, n */
    insole_phone_compass_t compass;
    insole_phone_radio_t radio;
    insole_phone_place_t place; /**< unless there is no filter */

    uint64_t t_us;        /**< of the newest clean sample */
    uint32_t starts;      /**< of the filter, when they were looked at last */
    bool trusts_pointing; /**< the last was directed by a phone that was taken to point ahead, and
                               no steps have shown since that it does */
    bool has_time, coasting, finished;
    insole_fix_t fix; /**< newest, until taken */
    bool has_fix;
} insole_phone_tracker_t;

/** @param parts  their states must have been set up, and stay where they are
 *  @param map    one that has passed insole_radio_map_check(); NULL: there is none
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for a setting out of its range, or when there is
 *          neither a filter nor a solver */
insole_status_t insole_phone_tracker_init(insole_phone_tracker_t *tracker,
                                          const insole_phone_tracker_config_t *config,
                                          const insole_phone_parts_t *parts,
                                          const insole_radio_map_t *map);

/** Where the walker is at `start->t_us`; may be told ahead. A later start replaces the earlier.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE as insole_foot_tracker_start */
insole_status_t insole_phone_tracker_start(insole_phone_tracker_t *tracker,
                                           const insole_start_t *start);

/** The sample call: bad samples are repaired and counted in `tracker->screen.counts`.
 *  @return INSOLE_OK; INSOLE_ERR_ROOM: take the fix that waits, the sample was not used;
 *          INSOLE_ERR_STATE after finish */
insole_status_t insole_phone_tracker_imu(insole_phone_tracker_t *tracker, const insole_imu_t *imu);

/** A reading of the magnetometer, after the sample before it.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the attitude is known; INSOLE_ERR_VALUE for a
 *          field that is not finite */
insole_status_t insole_phone_tracker_mag(insole_phone_tracker_t *tracker, const insole_mag_t *mag);

/** A scan. Its readings are copied; one still in work is given up.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE without solver and map, or when too little is known of
 *          what was heard; with a filter INSOLE_ERR_TIME for one that is a minute and more
 *          ahead of the samples, or older than the last 16 steps */
insole_status_t insole_phone_tracker_scan(insole_phone_tracker_t *tracker,
                                          const insole_scan_t *scan);

/** The work call: at most `count` fingerprints' or particles' worth.
 *  @return true while work is left */
bool insole_phone_tracker_work(insole_phone_tracker_t *tracker, uint32_t count);

/** The fix of the newest sample.
 *  @return INSOLE_ERR_STATE when none is ready */
insole_status_t insole_phone_tracker_next(insole_phone_tracker_t *tracker, insole_fix_t *fix);

/** No more samples will come: those that are held back become fixes, to be taken one by one. */
insole_status_t insole_phone_tracker_finish(insole_phone_tracker_t *tracker);

#ifdef __cplusplus
}
#endif

#endif
