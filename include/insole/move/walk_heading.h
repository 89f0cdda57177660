/** @file walk_heading.h  Which way somebody walks, however the phone lies on them.
 *
 *  Source  [PhoneUKF] 5.3, eqs. (19)-(25), (29)-(31): RMPCA; its rival uDirect as 2 and 7.2 tell of
 *          it. What is kept from step to step, the sign, the variance's other parts and the method
 *          `gait` are our own.
 *  Frames  b: phone, any mounting.  n: local level, z up.
 *
 *      static insole_walk_heading_t walk;
 *      insole_walk_heading_init(&walk, &insole_walk_heading_defaults);
 *      on each sample, after the attitude:
 *          insole_walk_heading_push(&walk, phone.q, &P, imu.accel_mps2, imu.t_us);
 *      on each step, up to 5 s late:
 *          if (insole_walk_heading_step(&walk, &footfall, &walked) == INSOLE_OK) use(&walked);
 *
 *  Samples are turned to n when they come and wait in slots of 0.05 s (gait_motion.h). Along the
 *  way a trunk moves at the frequency of the steps; it sways at half of it. So the scatter of the
 *  former counts whole and all else little (`sway_weight`): an arm that swings still outweighs its
 *  own sway. The scatter matrices of the steps are summed and slowly forgotten (`axis_keep`), in a
 *  frame that turns with the phone (yaw_track.h), for a walker turns with it, until it is tipped
 *  over. With weight 1, nothing kept and windows of one step it is the paper's.
 *
 *  An attitude that takes what a swinging arm feels for gravity is off by some degrees for as long
 *  as it swings. But over whole strides the mean force of who walks evenly is upright: by it the
 *  motion is levelled (`level`), the mean kept like the scatter.
 *
 *  An axis has two ends. The trunk falls from midstance to heel strike and is pushed on meanwhile:
 *  its forward acceleration leads the vertical one by a quarter of a step, that of a hand or a leg
 *  by less; none by more than a half. An arm or a thigh swings farther and higher ahead than back:
 *  at the frequency of a stride the forward acceleration goes with the vertical one, where a
 *  pendulum's own rise, twice as fast, does not take part. Both products, weighed by their size,
 *  are a vector that points ahead: evidence. It is summed over the steps in the same way, and the
 *  end is taken that the sum is for. So one bad step turns nobody round.
 *
 *  `rmpca`: the axis.  `udirect`: the acceleration at one moment of each step, when the body falls
 *  fastest.  `device`: where the phone points (heading.h).  `gait`: the evidence of a window.
 *
 *  The variance is that of the attitude through the unscented transform, that of an axis of
 *  scattered motion, that by which the axes of the last steps differ (who shakes a phone along a
 *  line gives it a sharp axis too, but another with each step), and that of turning. It speaks of
 *  the axis; which end of it is right, `is_certain` tells. The covariance of the attitude is the
 *  newest one, not that of the step.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_WALK_HEADING_H
#define INSOLE_MOVE_WALK_HEADING_H

#include "insole/base/config.h"
#include "insole/move/gait_memory.h"
#include "insole/move/gait_motion.h"
#include "insole/move/yaw_track.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_WALK_HEADING_STEPS = 4 /**< at most, that are looked at together */ };

typedef enum {
    INSOLE_WALK_HEADING_RMPCA = 0,
    INSOLE_WALK_HEADING_UDIRECT = 1,
    INSOLE_WALK_HEADING_DEVICE = 2,
    INSOLE_WALK_HEADING_GAIT = 3
} insole_walk_heading_method_t;

/* clang-format off */
#define INSOLE_WALK_HEADING_KEYS(KEY)                                                             \
    KEY(CHOICE, method, 0, 0, 3, "rmpca|udirect|device|gait", "what tells the direction")         \
    KEY(INT, steps, 2, 1, 4, "",                                                                  \
        "steps in a row that are looked at together (udirect: always 1); 1: as in the paper")     \
    KEY(REAL, sway_weight, 0.1, 0.0, 1.0, "",                                                     \
        "weight of motion at other than a step's frequency; 1 = as in the paper")                 \
    KEY(REAL, axis_keep, 0.93, 0.0, 0.99, "",                                                     \
        "kept from step to step of what tells the axis; 0 = as in the paper")                     \
    KEY(CHOICE, turned_by, 0, 0, 1, "walker|hand", "who has turned when the phone has")           \
    KEY(REAL, tipped_rad, 0.9, 0.1, 3.2, "rad", "a phone tipped over by so much is carried anew") \
    KEY(CHOICE, level, 1, 0, 1, "attitude|mean", "what tells the vertical: the attitude alone, "  \
        "or the mean force of the steps that are kept")                                           \
    KEY(REAL, lead_rad, 1.1, -3.2, 3.2, "rad",                                                    \
        "phase of a step by which the forward acceleration leads the vertical one")               \
    KEY(REAL, least_mps2, 0.15, 0.01, 10.0, "m/s^2",                                              \
        "a level acceleration of smaller rms along its axis has no direction")                    \
    KEY(REAL, sigma_tilt_rad, 0.01, 0.0, 1.0, "rad",                                              \
        "1-sigma of a tilt that the attitude does not know, or that the mean force leaves")       \
    KEY(REAL, sigma_rad, 0.02, 0.0, 3.0, "rad", "1-sigma of the best direction of a step")        \
    KEY(REAL, scatter_share, 0.02, 0.0, 100.0, "",                                                \
        "variance by motion across the axis, over its share; 0 = off")                            \
    KEY(REAL, wander_share, 0.45, 0.0, 100.0, "",                                                 \
        "variance over that between the axes of one foot's steps; 0 = off")                       \
    KEY(REAL, turn_share, 0.2, 0.0, 10.0, "",                                                     \
        "1-sigma by turning, over the angle turned; 0 = off")                                     \
    KEY(REAL, keep_share, 0.9, 0.0, 0.99, "",                                                     \
        "kept from step to step of the evidence for the end, and of how axes wander")             \
    KEY(REAL, forget_s, 5.0, 0.1, 1000.0, "s",                                                    \
        "time constant of all that is kept, between two walks")                                   \
    KEY(REAL, certain_evidence, 2.5, 0.0, 100.0, "", "evidence from which the end is certain")
/* clang-format on */

typedef struct {
    INSOLE_WALK_HEADING_KEYS(INSOLE_CONFIG_MEMBER)
} insole_walk_heading_config_t;

extern const insole_walk_heading_config_t insole_walk_heading_defaults;

/** Steps that follow each other without a pause. */
typedef struct {
    uint64_t begins_us[INSOLE_WALK_HEADING_STEPS]; /**< newest first */
    uint64_t end_us;                               /**< of the newest */
    uint32_t count;
} insole_walk_heading_row_t;

typedef struct {
    insole_walk_heading_config_t config;
    insole_gait_motion_t motion; /**< of the last 6.4 s, in n */
    insole_yaw_track_t yaw;
    insole_sym3_t cov_rad2;        /**< of the small rotation in n, newest */
    insole_real_t device_var_rad2; /**< of the heading of the phone, newest */
    insole_walk_heading_row_t row;
    insole_gait_memory_t memory;
    uint32_t refused;
} insole_walk_heading_t;

/** The direction of a step. */
typedef struct {
    uint64_t t_us;               /**< end of the step */
    insole_real_t direction_rad; /**< n, counter-clockwise from +x, (-pi, pi] */
    insole_real_t variance_rad2; /**< at most pi^2 / 3: nothing is known */
    insole_real_t rms_mps2;      /**< of the level acceleration along its principal axis */
    insole_real_t ratio;         /**< variance across that axis over that along it, 0 .. 1 */
    insole_real_t evidence;      /**< for this end of the axis; below 0: against it */
    bool is_certain;             /**< which end it is */
} insole_walked_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_walk_heading_init(insole_walk_heading_t *walk,
                                         const insole_walk_heading_config_t *config);

/** Takes a sample of the accelerometer, 20 Hz and more.
 *  @param q         b to n, of unit length
 *  @param cov_rad2  of the small rotation in n
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for a `q` that is not of unit length within 1 %, a
 *          variance that is negative or beyond 100 rad^2, an acceleration over 1000 m/s^2, anything
 *          not finite; INSOLE_ERR_TIME */
insole_status_t insole_walk_heading_push(insole_walk_heading_t *walk, insole_quat_t q,
                                         const insole_sym3_t *cov_rad2, insole_vec3_t accel_mps2,
                                         uint64_t t_us);

/** The direction of a step; steps come in their order.
 *  @param walked  untouched when refused
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_TIME for a step that does not end after its begin and after
 *          the step before, or ends after the newest sample; INSOLE_ERR_STATE when samples of it
 *          are missing or forgotten, or the level motion is too weak */
insole_status_t insole_walk_heading_step(insole_walk_heading_t *walk,
                                         const insole_footfall_t *footfall,
                                         insole_walked_t *walked);

#ifdef __cplusplus
}
#endif

#endif
