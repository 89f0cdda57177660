/** @file gait_motion.h  What a walker's body did over a step that is told late.
 *
 *  Source  [PhoneUKF] 5.3, eqs. (20)-(22), (26).
 *  Frames  n: local level, z up.
 *
 *      static insole_gait_motion_t motion;
 *      insole_gait_motion_init(&motion);
 *      on each sample:
 *          insole_gait_facing_t facing = {heading_rad, turned_rad};
 *          insole_gait_motion_push(&motion, insole_quat_rotate(q, accel_mps2), &facing, t_us);
 *      on each step, up to 5 s late:
 *          insole_gait_window_t window = {begin_us, end_us, 2u};
 *          if (insole_gait_motion_look(&motion, &window, &moments) == INSOLE_OK) use(&moments);
 *
 *  Samples are kept as sums over slots of 0.05 s, the last 6.4 s of them. Whoever looks back sees
 *  the running mean of three slots: heel strikes and noise are above its band. All that is told of
 *  a window is turned to where the walker faced in the mean of its last step, as if they had not
 *  turned in it.
 *
 *  A step repeats what the trunk does, ahead and upwards; a stride, which is two of them, what it
 *  does sideways and what arms and legs do. So both frequencies are told apart.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_GAIT_MOTION_H
#define INSOLE_MOVE_GAIT_MOTION_H

#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    INSOLE_GAIT_SLOTS = 128,    /**< that are remembered; a power of two */
    INSOLE_GAIT_SLOT_US = 50000 /**< length of each */
};

/** Directions that go with a sample. */
typedef struct {
    insole_real_t device_rad; /**< heading of the phone */
    insole_real_t turned_rad; /**< n, by which who carries it has turned (yaw_track.h); 0: nobody */
} insole_gait_facing_t;

/** Samples of a slot. */
typedef struct {
    insole_vec3_t sum_mps2;      /**< n, specific force */
    insole_gait_facing_t facing; /**< of the last of them or of one before */
} insole_gait_slot_t;

typedef struct {
    bool has_time;
    uint64_t t_us;                               /**< of the newest sample */
    uint64_t newest;                             /**< number of its slot */
    insole_gait_slot_t slots[INSOLE_GAIT_SLOTS]; /**< at slot number mod 128 */
    uint8_t counts[INSOLE_GAIT_SLOTS];           /**< samples in them */
} insole_gait_motion_t;

/** One step, or some in a row. */
typedef struct {
    uint64_t begin_us, end_us;
    uint32_t steps; /**< in it, at least 1 */
} insole_gait_window_t;

/** An oscillation, c cos(wt) + s sin(wt) from the begin of its window. */
typedef struct {
    insole_vec3_t c, s; /**< [m/s^2] n */
} insole_gait_wave_t;

/** Means over the slots of a window, of the acceleration less its mean. `n` is n turned about the
 *  vertical: what was in a slot is turned by what the walker has turned since. */
typedef struct {
    insole_vec3_t force_mps2;   /**< n, the specific force's mean */
    insole_sym3_t scatter;      /**< [m^2/s^4] n, its second moment */
    insole_gait_wave_t step;    /**< its part at the frequency of a step */
    insole_gait_wave_t stride;  /**< and at half of it; 0 in a window of one step */
    insole_vec3_t falling_mps2; /**< n, itself at the lowest vertical velocity */
    insole_real_t device_rad;   /**< heading of the phone at the end */
    insole_real_t facing_rad;   /**< `turned_rad`, mean of the last step */
    insole_real_t turned_rad;   /**< from the first slot to the last */
} insole_gait_moments_t;

/** @return INSOLE_ERR_NULL */
insole_status_t insole_gait_motion_init(insole_gait_motion_t *motion);

/** Takes a sample, 20 Hz and more; over 5 kHz some are left out.
 *  @param force_mps2  n, specific force
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE over 1000 m/s^2, for an angle beyond 10 rad, or not
 *          finite; INSOLE_ERR_TIME */
insole_status_t insole_gait_motion_push(insole_gait_motion_t *motion, insole_vec3_t force_mps2,
                                        const insole_gait_facing_t *facing, uint64_t t_us);

/** Whether the slot of this time is still remembered. */
bool insole_gait_motion_reaches(const insole_gait_motion_t *motion, uint64_t t_us);

/** What happened in a window.
 *  @param moments  written to only on success
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE without a step; INSOLE_ERR_TIME for a window that does
 * not end after its begin, or ends after the newest sample; INSOLE_ERR_STATE when some of it is
 * forgotten, or has no samples for 0.15 s */
insole_status_t insole_gait_motion_look(const insole_gait_motion_t *motion,
                                        const insole_gait_window_t *window,
                                        insole_gait_moments_t *moments);

#ifdef __cplusplus
}
#endif

#endif
