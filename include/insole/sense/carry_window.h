/** @file carry_window.h  What the acceleration is like over two seconds, however the phone is
 * turned.
 *
 *  Source  [PhoneUKF] 4, eqs. 1-3: length of the acceleration, of its level part and of its part
 *          along gravity; five statistics of each over windows of 2 s, each half over the last.
 *          The skewness of the three, the likenesses and what follows them are our own.
 *  Frames  b: any; turning the phone in its place changes nothing.
 *
 *      static insole_carry_window_t window;
 *      insole_carry_window_init(&window, 0.5);
 *      on each sample, 20 to 400 Hz:
 *          insole_carry_window_push(&window, t_us, accel_mps2, &gyro_radps, NULL);
 *          if (insole_carry_window_next(&window, &features) == INSOLE_OK) use(&features);
 *
 *  Gravity comes from a tracked attitude, or from a low-pass where there is none; forests are grown
 *  on the one or the other. Samples are laid on a grid of 50 Hz, so that any rate gives the same
 *  features. A push costs the same always: values are sorted as they come. A window's features
 *  must be taken before the next window is full, one second later. A gap of more than 0.25 s among
 *  the samples begins anew. A gyroscope tells how the phone turns with the steps: a forearm rocks
 * in time with the bounce, a head keeps still. Without one those features are absent.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_CARRY_WINDOW_H
#define INSOLE_SENSE_CARRY_WINDOW_H

#include "insole/base/mat.h"
#include "insole/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    INSOLE_CARRY_GRID_US = 20000, /**< 1/50 s */
    INSOLE_CARRY_HALF = 50,       /**< grid points in half a window, 1 s */
    INSOLE_CARRY_BLOCK = 5,       /**< grid points that the likenesses take together, 0.1 s */
    INSOLE_CARRY_BLOCKS = INSOLE_CARRY_HALF / INSOLE_CARRY_BLOCK,
    INSOLE_CARRY_GAP_US = 250000 /**< a longer interval between samples begins anew */
};

/** What is measured of each grid point [m/s^2]. */
typedef enum {
    INSOLE_CARRY_MACC = 0, /**< length of the acceleration */
    INSOLE_CARRY_HACC = 1, /**< of its level part */
    INSOLE_CARRY_GACC = 2, /**< of its part along gravity */
    INSOLE_CARRY_SERIES = 3
} insole_carry_series_t;

/** Statistics of a series. */
typedef enum {
    INSOLE_CARRY_VARIANCE = 0, /**< [m^2/s^4] */
    INSOLE_CARRY_MEAN = 1,     /**< [m/s^2], as the three after it */
    INSOLE_CARRY_MEDIAN = 2,
    INSOLE_CARRY_MAXIMUM = 3,
    INSOLE_CARRY_MINIMUM = 4,
    INSOLE_CARRY_STATISTICS = 5
} insole_carry_statistic_t;

/** Numbers of the features: statistic `s` of series `k` is number k * INSOLE_CARRY_STATISTICS + s;
 *  those of the paper come first. */
enum {
    INSOLE_CARRY_PAPER = INSOLE_CARRY_SERIES * INSOLE_CARRY_STATISTICS, /**< features it has */
    INSOLE_CARRY_SKEWNESS = INSOLE_CARRY_PAPER, /**< of the three series; near 0 without motion */
    INSOLE_CARRY_STEP_LIKENESS = INSOLE_CARRY_SKEWNESS + INSOLE_CARRY_SERIES,
    INSOLE_CARRY_STRIDE_LIKENESS,
    INSOLE_CARRY_TOGETHER, /**< of the upright and the level part: squared correlation, 0 to 1 */
    INSOLE_CARRY_ACCEL,    /**< features that an accelerometer gives; those of a gyroscope follow */
    INSOLE_CARRY_TURN = INSOLE_CARRY_ACCEL, /**< power of the turns across gravity [rad^2/s^2] */
    INSOLE_CARRY_TURN_UPRIGHT,              /**< that of the turns about gravity, over it */
    INSOLE_CARRY_TURN_PER_RISE, /**< it, over the power of the upright acceleration [rad^2 s^2/m^2]
                                 */
    INSOLE_CARRY_TURN_LINE, /**< turns across gravity about one axis alone 1, about all alike 0 */
    INSOLE_CARRY_TURN_LIKENESS, /**< theirs, one step earlier */
    INSOLE_CARRY_TURN_GAIN,     /**< theirs in time with the rise of the phone [rad/m] */
    INSOLE_CARRY_TURN_IN_TIME,  /**< share of their power that is so, 0 to 1 */
    INSOLE_CARRY_FEATURES
};

/** Of one window. The likenesses, in [-1, 1], compare the motion with itself one step (0.4 to 0.7
 *  s) or one stride (0.8 to 1.3 s) earlier; the best of these times counts. They and what follows
 *  see the means of blocks without the mean of the window; up is there the mean acceleration. */
typedef struct {
    uint64_t t_us; /**< end of the window */
    bool has_gyro; /**< false: all features of the turn rate are 0 */
    insole_real_t value[INSOLE_CARRY_FEATURES];
} insole_carry_features_t;

/** A sample, or a point of the grid. */
typedef struct {
    insole_vec3_t accel, gyro; /**< b */
    bool has_gyro;
} insole_carry_point_t;

/** Half a window. */
typedef struct {
    insole_real_t sorted[INSOLE_CARRY_SERIES][INSOLE_CARRY_HALF]; /**< rising */
    insole_vec3_t accel[INSOLE_CARRY_BLOCKS];                     /**< sums over blocks, b */
    insole_vec3_t gyro[INSOLE_CARRY_BLOCKS];
    bool has_gyro; /**< each point of it */
} insole_carry_half_t;

typedef struct {
    insole_real_t gravity_s;
    uint64_t t_us;               /**< of the newest sample */
    insole_carry_point_t newest; /**< that sample */
    uint64_t grid_us;            /**< time of the newest grid point */
    bool has_time;
    bool is_new;           /**< a full window has not been taken */
    uint32_t count;        /**< grid points in the half that is being filled */
    uint32_t points;       /**< grid points since the begin, up to a second's */
    uint32_t full;         /**< full halves before it, up to two */
    uint32_t filling;      /**< which half is being filled */
    insole_vec3_t gravity; /**< low-pass of the acceleration, b */
    insole_carry_half_t halves[3];
    uint32_t refused;
} insole_carry_window_t;

/** @param gravity_s  time constant of the low-pass that finds gravity [s]; 0.05 to 100
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_carry_window_init(insole_carry_window_t *window, insole_real_t gravity_s);

/** Takes a sample.
 *  @param gyro_radps  turn rate, b; NULL: there is no gyroscope
 *  @param up  direction against gravity in b, of any length but zero, from a tracked attitude;
 *             NULL: from the low-pass
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE: not finite, over 1000 m/s^2 or 1000 rad/s, or `up` no
 *          direction; INSOLE_ERR_TIME */
insole_status_t insole_carry_window_push(insole_carry_window_t *window, uint64_t t_us,
                                         insole_vec3_t accel_mps2, const insole_vec3_t *gyro_radps,
                                         const insole_vec3_t *up);

/** The features of the newest window, once.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_STATE when there is none */
insole_status_t insole_carry_window_next(insole_carry_window_t *window,
                                         insole_carry_features_t *features);

#ifdef __cplusplus
}
#endif

#endif
