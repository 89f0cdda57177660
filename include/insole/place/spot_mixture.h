/** @file spot_mixture.h  Weighted places made one: their mean, their covariance, the likeliest.
 *
 *  Source  [PhoneEKF] 3.2, eqs. 22-27; [PhoneUKF] 6.1, eqs. 32-35.
 *  Frames  m: map, metres.
 *
 *      insole_spot_mixture_t mixture = insole_spot_mixture_empty();
 *      for each point: insole_spot_mixture_add(&mixture, i, spots[i], log_weight);
 *      fix.spot = mixture.mean;
 *      insole_spot_mixture_cov(&mixture, mixture.mean, point_sigma_m, widen, &fix);
 *
 *  Weights come as logarithms of any size, one at a time; only their differences count.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_SPOT_MIXTURE_H
#define INSOLE_PLACE_SPOT_MIXTURE_H

#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint32_t count;        /**< places added */
    uint32_t likeliest;    /**< number of the place with the largest weight; the first of equals */
    insole_spot_t top;     /**< that place */
    insole_real_t log_top; /**< logarithm of its weight */
    insole_real_t weight;  /**< sum of all weights; the largest is 1 */
    insole_spot_t mean;
    insole_real_t xx, xy, yy; /**< weighted sums of squares about the mean */
} insole_spot_mixture_t;

/** A position from signal strengths. */
typedef struct {
    insole_spot_t spot;
    insole_real_t var_x_m2, cov_xy_m2, var_y_m2;
    uint32_t likeliest;       /**< point of the map that fits best */
    insole_real_t log_weight; /**< its logarithm of likelihood or kernel; compares scans */
    uint32_t points;          /**< points of the map that were weighed */
    uint32_t readings;        /**< access points of the scan that count */
} insole_radio_fix_t;

insole_spot_mixture_t insole_spot_mixture_empty(void);

/** A place or weight that is not finite is passed over. */
void insole_spot_mixture_add(insole_spot_mixture_t *mixture, uint32_t number, insole_spot_t spot,
                             insole_real_t log_weight);

/** Fills in position `at` and the mean square about it: `widen` times that of the places, and the
 *  width `sigma_m` of each. Always positive definite with sigma_m > 0. Needs a place added. */
void insole_spot_mixture_cov(const insole_spot_mixture_t *mixture, insole_spot_t at,
                             insole_real_t sigma_m, insole_real_t widen, insole_radio_fix_t *fix);

#ifdef __cplusplus
}
#endif

#endif
