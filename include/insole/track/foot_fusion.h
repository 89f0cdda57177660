/** @file foot_fusion.h  From a shoe's IMU, radio and a floor plan to positions: the second order.
 *
 *  foot_tracker -> strides -> particle_filter <- walls, signal strengths, ranges
 *
 *  Source  [TwoOrder] 3.2: the stage as printed (`two-order`), the propagation model alone
 *          (`wifi`), and ours (`best`).
 *  Frames  m: map. What the inertial filter calls north is found on the way.
 *
 *      static insole_particle_t particles[500];
 *      static insole_foot_fusion_t shoe;
 *      insole_fusion_memory_t memory = {.particles = particles, .count = 500};
 *      insole_foot_fusion_init(&shoe, &insole_foot_fusion_defaults, &memory, &building, seed);
 *      on each sample:   insole_foot_fusion_imu(&shoe, &imu);
 *                        while (insole_foot_fusion_next(&shoe, &fix) == INSOLE_OK) use(&fix);
 *      on each scan:     insole_foot_fusion_scan(&shoe, &scan);
 *      in idle time:     while (insole_foot_fusion_work(&shoe, 50)) {}
 *
 *  What a method may do without is lent to it (fusion_config.h) or called by name (foot_lag.h): a
 *  program that does neither links none of it.
 *
 *  Between strides the position moves on with the inertial filter. The memory and the building are
 *  the caller's and must stay where they are. Without plan and access points `best` is the first
 *  order alone.
 *
 *  Radio may be told as soon as it comes: it waits until the inertial filter, whose detector looks
 *  ahead, has come to its time. `wifi` knows of radio alone: a fix for each scan, at once.
 *
 *  With `lag_s` and foot_lag.h each fix leaves so much later, at where the ancestors of the cloud
 * of then were.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FOOT_FUSION_H
#define INSOLE_TRACK_FOOT_FUSION_H

#include "insole/track/foot_tracker.h"
#include "insole/track/fusion_config.h"
#include "insole/track/fusion_gap.h"
#include "insole/track/fusion_radio.h"
#include "insole/track/fusion_start.h"
#include "insole/track/fusion_strides.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint32_t starts;  /**< times the particles were drawn */
    uint32_t refused; /**< calls answered with a negative status that tells of an error */
} insole_foot_fusion_counts_t;

typedef struct {
    insole_foot_fusion_own_t config;
    insole_foot_fusion_counts_t counts;
    insole_foot_tracker_t foot;
    insole_particle_filter_t particles;
    insole_fusion_memory_t memory;
    const insole_building_t *building;

    insole_fusion_radio_t radio;
    insole_fusion_gap_t gap;

    insole_evidence_t news; /**< what the particles are told */
    bool is_told;           /**< a start that was told has been reached */
    bool wants_start;       /**< a start is told, and not yet used */
    bool working;           /**< the particles have work left */
    bool finished;
    uint32_t doubt; /**< strides that the cloud has yet to be good for after a gap */
    insole_fusion_strides_t strides;
} insole_foot_fusion_t;

/** @param building  NULL: nothing is known of it
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range or no particles */
insole_status_t insole_foot_fusion_init(insole_foot_fusion_t *fusion,
                                        const insole_foot_fusion_config_t *config,
                                        const insole_fusion_memory_t *memory,
                                        const insole_building_t *building, uint64_t seed);

/** As insole_foot_tracker_start. Without any start the first scan tells where to begin. */
insole_status_t insole_foot_fusion_start(insole_foot_fusion_t *fusion, const insole_start_t *start);

/** The sample call, as insole_foot_tracker_imu. */
insole_status_t insole_foot_fusion_imu(insole_foot_fusion_t *fusion, const insole_imu_t *imu);

/** A scan. Its readings are copied, the strongest of known access points.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE without access points, or when a fix of `wifi` waits
 */
insole_status_t insole_foot_fusion_scan(insole_foot_fusion_t *fusion, const insole_scan_t *scan);

/** Ranges of one moment.
 *  @return as insole_foot_fusion_scan; INSOLE_ERR_STATE also without `ranges` in the memory lent */
insole_status_t insole_foot_fusion_ranges(insole_foot_fusion_t *fusion,
                                          const insole_range_t *ranges, uint32_t count);

/** The next fix, as insole_foot_tracker_next.
 *  @return INSOLE_ERR_STATE when none is ready */
insole_status_t insole_foot_fusion_next(insole_foot_fusion_t *fusion, insole_fix_t *fix);

/** The work call: at most `particles` particles' worth.
 *  @return true while work is left */
bool insole_foot_fusion_work(insole_foot_fusion_t *fusion, uint32_t particles);

/** No more samples will come: all that is held leaves through insole_foot_fusion_next, in turns
 * with insole_foot_fusion_work until neither gives more. */
insole_status_t insole_foot_fusion_finish(insole_foot_fusion_t *fusion);

#ifdef __cplusplus
}
#endif

#endif
