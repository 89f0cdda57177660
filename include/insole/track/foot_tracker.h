/** @file foot_tracker.h  From a shoe's IMU to positions: the ready-made path.
 *
 *  screen -> still_bias -> zero_velocity -> zupt_ekf -> stride -> position
 *
 *  Source  [TwoOrder], first order.
 *  Frames  b: sensor on the shoe, any mounting.  m: map; without a start record x is the direction
 *          in which the sensor's x axis pointed when it was aligned, and the walk begins at (0, 0).
 *
 *      static insole_foot_tracker_t shoe;
 *      insole_foot_tracker_init(&shoe, &insole_foot_tracker_defaults);
 *      on each sample:
 *          insole_foot_tracker_imu(&shoe, &imu);
 *          while (insole_foot_tracker_next(&shoe, &fix) == INSOLE_OK) use(&fix);
 *
 *  The detector looks ahead, so a sample becomes a fix nearly half a second after it came.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FOOT_TRACKER_H
#define INSOLE_TRACK_FOOT_TRACKER_H

#include "insole/track/foot_anchor.h"
#include "insole/track/foot_config.h"
#include "insole/track/foot_walk.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint32_t fixes;       /**< samples that became a fix */
    uint32_t still;       /**< of these, with the foot still */
    uint32_t corrections; /**< zero-velocity corrections made */
    uint32_t stances;     /**< stances begun */
    uint32_t bridged;     /**< short gaps, bridged */
    uint32_t coasts;      /**< long gaps, carried over by the way the walk went */
    uint32_t realigned;   /**< attitudes found anew after them */
    uint32_t refused;     /**< calls answered with a negative status that tells of an error */
    bool aligned_moving;  /**< the first attitude comes from a stance in motion, not from a rest */
} insole_foot_counts_t;

typedef struct {
    insole_foot_tracker_own_t config;
    insole_foot_counts_t counts;
    insole_screen_t screen;
    insole_still_bias_t still_bias;
    insole_zupt_ekf_t zupt_ekf;
    insole_stride_counter_t strides;

    insole_vec3_t still_accel; /**< sum over the stance that will give the attitude */
    uint32_t still_count;
    uint64_t still_since_us;
    insole_quat_t first_q;      /**< attitude when the foot was aligned */
    insole_quat_t stance_q;     /**< in the last stance */
    uint64_t stance_us;         /**< last sample of it */
    insole_real_t unmeasured_s; /**< of it, since its velocity was measured */
    insole_real_t floor_m;      /**< height of the floor being walked on */

    insole_foot_walk_t walk;
    insole_real_t gap_turn_rad2; /**< variance of the turns in gaps since the last stance */
    insole_foot_anchor_t anchor;
    insole_start_t start;   /**< told, not yet reached */
    insole_stride_t stride; /**< newest, until taken */
    bool was_still, coasting, finished, has_floor, has_start, has_stride;
    insole_zero_velocity_t zero_velocity; /**< last: it is large */
} insole_foot_tracker_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_foot_tracker_init(insole_foot_tracker_t *tracker,
                                         const insole_foot_tracker_config_t *config);

/** Where the walker is at `start->t_us`; may be told ahead. Told late it holds for the next fix.
 *  A later start replaces the earlier, and what was uncertain is as certain as it says.
 *  @return INSOLE_ERR_VALUE for a start that is not finite, more than 1e6 m or 100 rad away, or has
 *          a sigma that is negative or as large */
insole_status_t insole_foot_tracker_start(insole_foot_tracker_t *tracker,
                                          const insole_start_t *start);

/** The sample call: bad samples are repaired and counted in `tracker->screen.counts`.
 *  @return INSOLE_OK; INSOLE_ERR_ROOM: take the fixes that wait, the sample was not used;
 *          INSOLE_ERR_STATE after finish */
insole_status_t insole_foot_tracker_imu(insole_foot_tracker_t *tracker, const insole_imu_t *imu);

/** The next fix, one per sample that came through the screen, in the order of time. Its variances
 *  may be those of up to INSOLE_ZUPT_BLOCK samples before.
 *  @return INSOLE_ERR_STATE when none is ready */
insole_status_t insole_foot_tracker_next(insole_foot_tracker_t *tracker, insole_fix_t *fix);

/** No more samples will come: those still held become fixes through insole_foot_tracker_next. */
insole_status_t insole_foot_tracker_finish(insole_foot_tracker_t *tracker);

/** The newest stride that ended since the last call; displacement and heading in n.
 *  @return INSOLE_ERR_STATE when there is none */
insole_status_t insole_foot_tracker_stride(insole_foot_tracker_t *tracker, insole_stride_t *stride);

#ifdef __cplusplus
}
#endif

#endif
