/** @file step.h  Steps of a walker from the length of the acceleration, wherever the phone is.
 *
 *  Source  [PhoneEKF] 3.1.1 and [PhoneUKF] 5.1: peaks by two thresholds; [WifiShift] II.B: of two
 *          peaks the first. That the thresholds follow the walker, and the rhythm, are our own.
 *  Frames  b: any; only |a| is used.
 *
 *      static insole_step_counter_t steps;
 *      insole_step_init(&steps, &insole_step_defaults);
 *      on each sample, 20 to 400 Hz:
 *          insole_step_push(&steps, t_us, accel_mps2);
 *          while (insole_step_next(&steps, &footfall) == INSOLE_OK) use(&footfall);
 *
 *  |a| without its slow mean goes through a low-pass of second order. A peak of it is a step when
 *  it rises enough over the trough before it and comes long enough after the peak before it. Both
 *  thresholds follow the walker, so that no position of the phone needs settings of its own. Of two
 *  peaks that are too close the higher counts, unless the trough between them is as deep as that
 *  between steps: then there are two (in a pocket one leg's step is short, the other's long).
 *
 *  Steps are told while the motion has the rhythm of a walk (rhythm.h). Those found before are held
 *  back, the last eight, and told at once when the rhythm is there: fidgeting is no step, and a
 * walk does not lose its first ones. A step is told when nothing can correct it any more, at most
 *  `max_dead_s` after its peak; the first of a walk when that has lasted for some 3 s. A walk of
 *  fewer than five steps may go unnoticed. Peaks of the smoothed |a| lag by about 0.1 s. A gap of
 *  more than 0.25 s among the samples begins anew.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_STEP_H
#define INSOLE_SENSE_STEP_H

#include "insole/base/config.h"
#include "insole/base/ring.h"
#include "insole/base/types.h"
#include "insole/sense/rhythm.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    INSOLE_STEP_HELD = 8, /**< steps that can wait for the rhythm of a walk */
    INSOLE_STEP_RING = 16 /**< and with them those that nobody has taken out yet */
};

typedef enum {
    INSOLE_STEP_HIGHEST = 0, /**< the false peak is corrected by the true one: [PhoneEKF] 3.1.1 */
    INSOLE_STEP_FIRST = 1    /**< the first one stays: [WifiShift] II.B */
} insole_step_rule_t;

/* clang-format off */
#define INSOLE_STEP_KEYS(KEY)                                                                     \
    KEY(CHOICE, rule, 0, 0, 1, "highest|first", "which of two peaks that are too close counts")   \
    KEY(REAL, low_pass_hz, 2.2, 1.0, 10.0, "Hz", "smoothing of |a|")                              \
    KEY(REAL, high_pass_hz, 0.5, 0.05, 1.0, "Hz", "what is slower belongs to the mean of |a|")    \
    KEY(REAL, min_height_mps2, 0.2, 0.0, 10.0, "m/s^2", "no peak is lower over the mean")         \
    KEY(REAL, min_rise_mps2, 0.7, 0.01, 10.0, "m/s^2",                                            \
        "no peak rises less over the trough before it")                                           \
    KEY(REAL, rise_share, 0.33, 0.0, 1.0, "",                                                     \
        "nor less than this share of the walker's usual range; 0 = off")                          \
    KEY(REAL, forget_s, 5.0, 0.1, 1000.0, "s",                                                    \
        "time constant at which the usual range is forgotten while there are no steps")           \
    KEY(REAL, min_interval_s, 0.28, 0.1, 1.0, "s", "no two peaks are closer")                     \
    KEY(REAL, interval_share, 0.667, 0.0, 0.9, "",                                                \
        "nor closer than this share of the walker's usual interval; 0 = off")                     \
    KEY(REAL, max_dead_s, 0.5, 0.1, 1.0, "s", "longest time that this share can be")              \
    KEY(REAL, deep_share, 0.6, 0.0, 2.0, "",                                                      \
        "unless the trough between is deeper than this share of the usual range; 2 = off")        \
    KEY(REAL, max_interval_s, 1.2, 0.5, 5.0, "s", "a longer interval ends the walk")              \
    KEY(INT, first_steps, 4, 2, 8, "", "a walk begins with at least so many")                     \
    KEY(REAL, start_likeness, 0.55, -1.0, 1.0, "", "and with this rhythm; -1 = off")              \
    KEY(INT, start_peaks, 2, 1, 8, "", "at so many peaks in a row")                               \
    KEY(REAL, keep_likeness, 0.3, -1.0, 1.0, "", "less rhythm ends it; -1 = off")
/* clang-format on */

typedef struct {
    INSOLE_STEP_KEYS(INSOLE_CONFIG_MEMBER)
} insole_step_config_t;

extern const insole_step_config_t insole_step_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_step_check(const insole_step_config_t *config);

/** What |a| did over a time. */
typedef struct {
    insole_real_t sum, sum_of_squares; /**< of |a| - 9.81 m/s^2 */
    insole_real_t min_mps2, max_mps2;  /**< of the smoothed |a| */
    uint32_t count;
} insole_step_span_t;

/** A peak of the smoothed |a|. */
typedef struct {
    uint64_t t_us;
    insole_real_t height_mps2; /**< over the mean */
    insole_step_span_t span;   /**< since the peak before it */
} insole_step_peak_t;

typedef struct {
    insole_step_config_t config;
    uint64_t t_us; /**< of the newest sample */
    bool has_time, has_peak, has_last, walking;
    insole_real_t mean_mps2;     /**< slow mean of |a| */
    insole_real_t band, low;     /**< states of the low-pass */
    insole_real_t newest, older; /**< the last two values of the smoothed |a| */
    insole_real_t trough;        /**< least of them since the peak */
    insole_step_peak_t peak;     /**< that may still be corrected */
    insole_step_span_t span;     /**< since it */
    uint64_t before_us;
    uint64_t last_us;               /**< of the peak before it */
    insole_real_t usual_interval_s; /**< of this walker */
    insole_real_t usual_range_mps2; /**< of this walker, over one step */
    insole_rhythm_t rhythm;         /**< of the smoothed |a| */
    insole_ring_t ring;             /**< footfalls told but not taken, then those held back */
    insole_footfall_t footfalls[INSOLE_STEP_RING];
    uint32_t alike; /**< peaks in a row with the rhythm of a walk */
    uint32_t held;  /**< how many of them are held back */
    uint32_t count; /**< steps told so far */
    uint32_t refused;
} insole_step_counter_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_step_init(insole_step_counter_t *counter,
                                 const insole_step_config_t *config);

/** Takes a sample of the accelerometer.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE: not finite or over 1000 m/s^2; INSOLE_ERR_TIME;
 *          INSOLE_ERR_ROOM: eight footfalls wait to be taken out */
insole_status_t insole_step_push(insole_step_counter_t *counter, uint64_t t_us,
                                 insole_vec3_t accel_mps2);

/** The oldest step that has not been taken out. The first of a walk has no step before it: its
 *  duration, range and scatter are those of the second.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_STATE when there is none */
insole_status_t insole_step_next(insole_step_counter_t *counter, insole_footfall_t *footfall);

/** A peak that is held back: it will be a step if this proves to be a walk. The first of them has
 *  the duration of the one after it, as far as there is one.
 *  @param number  0: the oldest
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_STATE when there are no more */
insole_status_t insole_step_held(const insole_step_counter_t *counter, uint32_t number,
                                 insole_footfall_t *footfall);

#ifdef __cplusplus
}
#endif

#endif
