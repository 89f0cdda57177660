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
 *  The detector looks ahead, so a sample becomes a fix half a second after it came.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FOOT_TRACKER_H
#define INSOLE_TRACK_FOOT_TRACKER_H

#include "insole/move/stride.h"
#include "insole/move/zupt_ekf.h"
#include "insole/sense/screen.h"
#include "insole/sense/still_bias.h"
#include "insole/sense/zero_velocity.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    INSOLE_FOOT_INS = 0, /**< first order: inertial navigation with zero-velocity updates */
    INSOLE_FOOT_PDR = 1  /**< strides of length (33) in the direction of the inertial strides */
} insole_foot_method_t;

/* clang-format off */
#define INSOLE_FOOT_TRACKER_KEYS(KEY)                                                             \
    KEY(CHOICE, method, 0, 0, 1, "ins|pdr", "what makes the position")                            \
    KEY(REAL, align_s, 0.08, 0.0, 2.0, "s", "longest stance whose mean gives the first attitude") \
    KEY(REAL, sigma_moving_tilt_rad, 0.05, 0.001, 1.0, "rad",                                     \
        "1-sigma of roll and pitch after alignment on a stance of a walk")                        \
    KEY(REAL, floor_step_m, 0.05, 0.0, 1.0, "m",                                                  \
        "stances that differ less in height stand on the same floor; 0 = off")                    \
    KEY(REAL, sigma_floor_m, 0.01, 0.001, 1.0, "m", "1-sigma of the evenness of that floor")      \
    KEY(REAL, sigma_walk_mps, 0.7, 0.01, 10.0, "m/s",                                             \
        "1-sigma of the velocity, per axis, while samples are missing")                           \
    KEY(REAL, sigma_gap_yaw_rad, 0.35, 0.0, 3.0, "rad", "1-sigma of the turn during a gap")       \
    KEY(REAL, yaw_drift_radps, 8.7e-4, 0.0, 0.1, "rad/s",                                         \
        "1-sigma of the yaw's drift by bias and scale, added to the reported heading")            \
    KEY(REAL, lost_sigma_m, 10.0, 0.1, 1.0e6, "m", "a position with a larger 1-sigma is lost")
/* clang-format on */

typedef struct {
    INSOLE_FOOT_TRACKER_KEYS(INSOLE_CONFIG_MEMBER)
    insole_screen_config_t screen;
    insole_still_bias_config_t still_bias;
    insole_zero_velocity_config_t zero_velocity;
    insole_zupt_ekf_config_t zupt_ekf;
    insole_stride_config_t stride;
} insole_foot_tracker_config_t;

extern const insole_foot_tracker_config_t insole_foot_tracker_defaults;

typedef struct {
    uint32_t fixes;       /**< samples that became a fix */
    uint32_t still;       /**< of these, with the foot still */
    uint32_t corrections; /**< zero-velocity corrections made */
    uint32_t stances;     /**< stances begun */
    uint32_t coasts;      /**< gaps carried over without samples */
    uint32_t realigned;   /**< attitudes found anew after a gap */
    uint32_t refused;     /**< calls answered with a negative status that tells of an error */
    bool aligned_moving;  /**< the first attitude comes from a stance in motion, not from a rest */
} insole_foot_counts_t;

/** How n lies in m: position = turn about the anchor in n, then to the anchor in m. */
typedef struct {
    insole_vec3_t anchor_n_m, anchor_m_m;
    insole_real_t yaw_rad;          /**< from n to m */
    insole_real_t var_m2, var_rad2; /**< of the start */
    insole_real_t heading_rad;      /**< told by the start record */
    uint32_t strides_left;          /**< until the told heading is compared */
    uint64_t t_us;
} insole_foot_anchor_t;

typedef struct {
    insole_foot_tracker_config_t config;
    insole_foot_counts_t counts;
    insole_screen_t screen;
    insole_still_bias_t still_bias;
    insole_zero_velocity_t zero_velocity;
    insole_zupt_ekf_t zupt_ekf;
    insole_stride_counter_t strides;

    insole_vec3_t still_accel; /**< sum over the stance that will give the attitude */
    uint32_t still_count;
    uint64_t still_since_us;
    bool was_still, coasting, finished;
    insole_real_t stance_yaw_rad; /**< yaw of the foot in the last stance */
    insole_real_t floor_m;        /**< height of the floor being walked on */
    bool has_floor;
    uint64_t last_us; /**< stamp of the last labelled sample */
    uint64_t aligned_us;

    insole_vec3_t walk_mps;      /**< velocity over the last stride */
    uint64_t walk_us;            /**< when it ended */
    insole_vec3_t pdr_m;         /**< n, sum of the model's strides */
    insole_real_t pdr_var_m2;    /**< of pdr_m, per axis */
    insole_real_t heading_n_rad; /**< direction of the last stride */
    insole_foot_anchor_t anchor;
    insole_start_t start; /**< told, not yet reached */
    bool has_start;
    insole_stride_t stride; /**< newest, until taken */
    bool has_stride;
} insole_foot_tracker_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_foot_tracker_init(insole_foot_tracker_t *tracker,
                                         const insole_foot_tracker_config_t *config);

/** Where the walker is at `start->t_us`; may be told ahead. A later start replaces the earlier.
 *  @return INSOLE_ERR_VALUE for a start that is not finite, more than 1e6 m or 100 rad away, or has
 *          a sigma that is negative or as large */
insole_status_t insole_foot_tracker_start(insole_foot_tracker_t *tracker,
                                          const insole_start_t *start);

/** The sample call: bad samples are repaired and counted in `tracker->screen.counts`.
 *  @return INSOLE_OK; INSOLE_ERR_ROOM: take the fixes that wait, the sample was not used;
 *          INSOLE_ERR_STATE after finish */
insole_status_t insole_foot_tracker_imu(insole_foot_tracker_t *tracker, const insole_imu_t *imu);

/** The next fix, one per sample that came through the screen, in the order of time.
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
