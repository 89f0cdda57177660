/** @file zero_velocity.h  Is the foot still? A delay line: samples go in, labelled samples come
 * out.
 *
 *  Source  [TwoOrder] 2.2 and 4.3 for the two-step logic; SHOE, MV, MAG and ARE of still_window.h;
 *          an adaptive detector of our own.
 *  Frames  b: sensor on the shoe; only lengths and spreads are used, any mounting will do.
 *
 *      static insole_zero_velocity_t stance;
 *      insole_zero_velocity_init(&stance, &insole_zero_velocity_defaults);
 *      on each sample:
 *          insole_zero_velocity_push(&stance, &imu);
 *          while (insole_zero_velocity_next(&stance, &out) == INSOLE_OK) use(&out.imu, out.still);
 *
 *  The detectors compare a statistic of a short centred window (still_window.h) with a threshold.
 *  The adaptive one takes SHOE below its threshold as a plain stance and, where none is near, the
 *  least still moment of each gait cycle as a guaranteed one: nobody walks without putting the foot
 *  down. A sample leaves at the latest one interval after `reach_s` + `spread_s` have passed.
 *
 *  The line holds half a second at 250 Hz (sense/screen averages faster samples). Faster ones still
 *  come through, judged by the shorter time that it holds.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_ZERO_VELOCITY_H
#define INSOLE_SENSE_ZERO_VELOCITY_H

#include "insole/base/config.h"
#include "insole/base/ring.h"
#include "insole/base/types.h"
#include "insole/sense/past_min.h"
#include "insole/sense/still_window.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_STANCE_RING = 128 /**< samples in the delay line */ };

typedef enum {
    INSOLE_DETECT_ADAPTIVE = 0,
    INSOLE_DETECT_TWO_STEP = 1,
    INSOLE_DETECT_SHOE = 2,
    INSOLE_DETECT_MV = 3,
    INSOLE_DETECT_MAG = 4,
    INSOLE_DETECT_ARE = 5
} insole_detector_t;

/* clang-format off */
#define INSOLE_ZERO_VELOCITY_KEYS(KEY)                                                            \
    KEY(CHOICE, detector, 0, 0, 5, "adaptive|two-step|shoe|mv|mag|are",                           \
        "what tells a still foot")                                                                \
    KEY(REAL, window_s, 0.03, 0.0, 0.2, "s",                                                      \
        "window of the statistic; at least three samples are taken")                              \
    KEY(REAL, gravity_mps2, 9.81, 9.7, 9.9, "m/s^2", "gravity magnitude")                         \
    KEY(REAL, sigma_accel_mps2, 0.01, 0.0001, 1.0, "m/s^2", "scale of the accelerometer's part")  \
    KEY(REAL, sigma_gyro_radps, 0.00174533, 0.0001, 1.0, "rad/s", "scale of the gyro's part")     \
    KEY(REAL, plain_threshold, 4.0e4, 1.0, 1.0e9, "", "adaptive: SHOE below it is a stance")      \
    KEY(REAL, guaranteed_threshold, 1.0e6, 1.0, 1.0e9, "",                                        \
        "adaptive: no minimum above it is a stance")                                              \
    KEY(REAL, reach_s, 0.4, 0.1, 0.4, "s",                                                        \
        "adaptive: a guaranteed stance is the minimum over this time to both sides")              \
    KEY(REAL, spread_s, 0.05, 0.0, 0.05, "s",                                                     \
        "adaptive: how far a guaranteed stance reaches to both sides")                            \
    KEY(REAL, spread_factor, 4.0, 1.0, 100.0, "",                                                 \
        "adaptive: and up to how many times its minimum")                                         \
    KEY(REAL, early_share, 0.7, 0.0, 1.0, "",                                                     \
        "adaptive: a minimum before this share of the gait period must be as still as usual")     \
    KEY(REAL, early_log, 0.7, 0.0, 10.0, "",                                                      \
        "adaptive: how far above the usual ln(statistic) such a minimum may lie")                 \
    KEY(REAL, shoe_threshold, 3.0e5, 1.0, 1.0e9, "", "shoe: still below it")                      \
    KEY(REAL, mv_threshold, 8.0e4, 1.0, 1.0e9, "", "mv: still below it")                          \
    KEY(REAL, mag_threshold, 4.0e4, 1.0, 1.0e9, "", "mag: still below it")                        \
    KEY(REAL, are_threshold, 1.6e5, 1.0, 1.0e9, "", "are: still below it")                        \
    KEY(REAL, two_step_accel_mps2, 2.0, 0.01, 20.0, "m/s^2",                                      \
        "two-step: largest | |a| - g | of a still sample")                                        \
    KEY(REAL, two_step_gyro_radps, 0.8, 0.01, 20.0, "rad/s",                                      \
        "two-step: largest |w| of a still sample")                                                \
    KEY(REAL, two_step_hole_s, 0.05, 0.0, 0.2, "s",                                               \
        "two-step: a shorter run of moving samples between still ones is still")
/* clang-format on */

typedef struct {
    INSOLE_ZERO_VELOCITY_KEYS(INSOLE_CONFIG_MEMBER)
} insole_zero_velocity_config_t;

extern const insole_zero_velocity_config_t insole_zero_velocity_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_zero_velocity_check(const insole_zero_velocity_config_t *config);

/** A sample that leaves the delay line. */
typedef struct {
    insole_imu_t imu;
    insole_real_t statistic; /**< of the window around it */
    uint8_t tag;             /**< what the caller pushed with it */
    bool still;
    bool plain; /**< still by threshold, not by guarantee */
} insole_labelled_t;

/** One slot of the delay line. */
typedef struct {
    insole_vec3_t accel_mps2, gyro_radps;
    insole_real_t statistic;
    uint32_t t_us;    /**< low half of the stamp */
    uint16_t high_us; /**< of its high half as much as years need */
    uint8_t tag;      /**< the caller's, and the label */
    uint8_t label;
} insole_stance_slot_t;

/* The long arrays come last: what stands close to the begin of a struct is reached faster. */
typedef struct {
    insole_zero_velocity_config_t config;
    insole_ring_t ring;
    uint64_t newest_us;
    uint32_t reach_us, spread_us, hole_us; /**< settings in microseconds */
    uint32_t ahead_us;                     /**< time after a sample that its judgement looks at */
    uint32_t back_us;                      /**< time before a sample that its judgement may label */
    insole_real_t threshold;               /**< of the detector, where it knows one only */
    uint32_t half;                         /**< half window [samples]; 0 until the rate is known */
    uint32_t measured;       /**< running number of the next slot whose statistic is to be formed */
    uint32_t judged;         /**< running number of the next slot to be judged */
    uint32_t released;       /**< running number after the slots whose label is certain */
    insole_past_min_t past;  /**< of the statistic */
    uint32_t last_still_us;  /**< low half of the stamp of the last still sample */
    uint32_t last_stance_us; /**< of the last stance's first sample or minimum */
    bool has_still, has_stance;
    insole_real_t period_s;  /**< running mean of the gait period */
    insole_real_t usual_log; /**< running mean of ln(statistic) of stances */
    bool finished;
    uint32_t refused;
    insole_still_window_t window;
    insole_stance_slot_t slots[INSOLE_STANCE_RING];
} insole_zero_velocity_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_zero_velocity_init(insole_zero_velocity_t *zv,
                                          const insole_zero_velocity_config_t *config);

/** No sample has room until one is taken out. */
static inline bool insole_zero_velocity_is_full(const insole_zero_velocity_t *zv)
{
    return insole_ring_count(&zv->ring) >= INSOLE_STANCE_RING;
}

/** Takes a sample. `tag` travels with it.
 *  @return INSOLE_ERR_TIME, INSOLE_ERR_VALUE, INSOLE_ERR_STATE after finish, INSOLE_ERR_ROOM when
 *          the delay line is full: take some out first */
insole_status_t insole_zero_velocity_push(insole_zero_velocity_t *zv, const insole_imu_t *imu,
                                          uint8_t tag);

/** The same for what is known to be welcome: a sample of screen.h that follows the last, and room
 *  for it. Nothing is checked. */
void insole_zero_velocity_take(insole_zero_velocity_t *zv, const insole_imu_t *imu, uint8_t tag);

/** Is there a sample whose label is certain? */
static inline bool insole_zero_velocity_has_next(const insole_zero_velocity_t *zv)
{
    return zv->ring.begin != zv->released;
}

/** As insole_zero_velocity_next where there is a sample. Nothing is checked. */
void insole_zero_velocity_give(insole_zero_velocity_t *zv, insole_labelled_t *out);

/** The oldest sample whose label is certain. @return INSOLE_ERR_STATE when there is none yet */
static inline insole_status_t insole_zero_velocity_next(insole_zero_velocity_t *zv,
                                                        insole_labelled_t *out)
{
    if (!zv || !out) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_zero_velocity_has_next(zv)) {
        return INSOLE_ERR_STATE;
    }
    insole_zero_velocity_give(zv, out);
    return INSOLE_OK;
}

/** No more samples will come: those still held are judged by what there is. */
insole_status_t insole_zero_velocity_finish(insole_zero_velocity_t *zv);

#ifdef __cplusplus
}
#endif

#endif
