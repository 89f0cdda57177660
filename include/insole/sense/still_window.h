/** @file still_window.h  How still a sensor is: statistics of a short window of samples.
 *
 *  Source  the likelihood ratio of a resting sensor (SHOE) and its parts MV, MAG and ARE.
 *  Frames  b: only lengths and spreads are used, any mounting will do.
 *
 *      SHOE  (mean|a|^2 - 2 g |mean a| + g^2) / sa^2 + mean|w|^2 / sw^2
 *      MV    (mean|a|^2 - |mean a|^2) / sa^2
 *      MAG   (mean|a|^2 - 2 g mean|a| + g^2) / sa^2
 *      ARE   mean|w|^2 / sw^2
 *
 *      static insole_still_window_t window;
 *      insole_still_window_init(&window, &scale, 7);
 *      on each sample:
 *          if (insole_still_window_push(&window, accel, gyro, &statistic) == INSOLE_OK)
 *              use(statistic);                                of the last seven samples
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_STILL_WINDOW_H
#define INSOLE_SENSE_STILL_WINDOW_H

#include "insole/base/status.h"
#include "insole/base/vec3.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_STILL_WINDOW = 15 /**< longest window [samples] */ };

typedef enum {
    INSOLE_STILL_SHOE = 0,
    INSOLE_STILL_MV = 1,
    INSOLE_STILL_MAG = 2,
    INSOLE_STILL_ARE = 3
} insole_still_kind_t;

/** What is measured, and in which units: g, sa and sw of the formulas. */
typedef struct {
    insole_still_kind_t kind;
    insole_real_t gravity_mps2, sigma_accel_mps2, sigma_gyro_radps; /**< > 0 */
} insole_still_scale_t;

/** What one sample adds to the sums, and the sums. */
typedef struct {
    insole_vec3_t accel;
    insole_real_t part; /**< of the statistic, what does not depend on the mean */
} insole_still_sums_t;

typedef struct {
    insole_still_kind_t kind;
    insole_real_t gravity_mps2, accel_weight, gyro_weight; /**< g, 1 / sa^2, 1 / sw^2 */
    insole_real_t per_n, two_per_n;                        /**< 1 / width, 2 / width */
    insole_real_t mean_weight;                             /**< of what the mean adds */
    uint32_t width;                                        /**< of the window [samples] */
    uint32_t at;                                           /**< slot of the next sample */
    bool full;                                             /**< `width` samples have come */
    insole_still_sums_t sums;                              /**< anew whenever `at` comes round */
    insole_still_sums_t samples[INSOLE_STILL_WINDOW];
} insole_still_window_t;

/** @param width  1 to INSOLE_STILL_WINDOW
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_still_window_init(insole_still_window_t *window,
                                         const insole_still_scale_t *scale, uint32_t width);

/** Takes a sample. @param[out] statistic  of the window that ends with it
 *  @return INSOLE_ERR_STATE while the window is not full; INSOLE_ERR_NULL; INSOLE_ERR_VALUE for a
 *          sample that is not finite */
insole_status_t insole_still_window_push(insole_still_window_t *window, insole_vec3_t accel_mps2,
                                         insole_vec3_t gyro_radps, insole_real_t *statistic);

/** The same for a sample that is known to be finite. Nothing is checked.
 *  @return the statistic; it means something once the window is full */
insole_real_t insole_still_window_take(insole_still_window_t *window,
                                       const insole_vec3_t *accel_mps2,
                                       const insole_vec3_t *gyro_radps);

#ifdef __cplusplus
}
#endif

#endif
