/** @file robust_fit.h  Robust least squares over a place and what all readings have in common.
 *
 *  Source  our own; what range_fix and rss_fix share.
 *  Frames  m: map, metres, relative to an origin near by.
 *
 *      insole_robust_fit_t fit = insole_robust_fit_begin(&known, x);
 *      for each reading:
 *          insole_robust_fit_add(&fit, &reading, loosen);
 *      insole_robust_fit_step(&fit, &step, &P);     then x = x + step, and again
 *
 *  Gauss and Newton over x, y and one common unknown (the delay of a ranging radio, the gain of a
 *  receiver). Weights 1 / (1 + (r / (tail sigma))^2) let a reading that does not fit count less the
 *  less it fits; tails that begin loose and tighten on the way keep it from deciding where it goes.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_ROBUST_FIT_H
#define INSOLE_PLACE_ROBUST_FIT_H

#include "insole/base/mat.h"
#include "insole/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A position found from access points alone, and how far it can be trusted. */
typedef struct {
    insole_real_t x_m, y_m;
    insole_real_t common; /**< all ranges too long by this [m], or all RSS too strong [dB] */
    insole_sym3_t P;      /**< covariance of (x, y, common) */
    uint32_t used;        /**< readings that passed the gates */
} insole_anchor_fix_t;

/** What is known: a mean of (x, y, common) and the inverse of its covariance. */
typedef struct {
    insole_vec3_t mean;
    insole_sym3_t information;
} insole_known_t;

/** One reading, linear about the present estimate. */
typedef struct {
    insole_vec3_t J;        /**< change of the expectation with (x, y, common) */
    insole_real_t residual; /**< reading less expectation */
    insole_real_t sigma;    /**< 1-sigma, > 0 */
    insole_real_t tail;     /**< a residual of so many sigma halves the weight, > 0 */
    insole_real_t bend;     /**< second derivative of the expectation across J, 1/m; 0: none */
} insole_robust_reading_t;

/** Normal equations about the present estimate. */
typedef struct {
    insole_vec3_t pull;
    insole_sym3_t information;
} insole_robust_fit_t;

/** Adds a second piece of knowledge to the first.
 *  @return false, and `known` as it was, when the covariance `P` is none */
bool insole_robust_fit_recall(insole_known_t *known, insole_vec3_t mean, insole_sym3_t P);

/** Begins with what is known, about the estimate `x`. */
insole_robust_fit_t insole_robust_fit_begin(const insole_known_t *known, insole_vec3_t x);

/** Adds a reading; its tail counts `loosen` times as wide, >= 1. */
void insole_robust_fit_add(insole_robust_fit_t *fit, const insole_robust_reading_t *reading,
                           insole_real_t loosen);

/** The step to the solution, no longer than 5 m along the floor and half as long when it turns
 * back, and the covariance.
 *  @param[in,out] step  the step before, zero at first; then the next
 *  @return false when the equations have no solution in finite numbers */
bool insole_robust_fit_step(const insole_robust_fit_t *fit, insole_vec3_t *step, insole_sym3_t *P);

/** How loose the tails are in one of `iterations`: from `loosen` down to 1 over their first half.
 */
insole_real_t insole_robust_fit_loosening(insole_real_t loosen, int32_t iteration,
                                          int32_t iterations);

/** A step so short ends the iteration [m]. */
#define INSOLE_ROBUST_FIT_DONE_M INSOLE_R(0.001)

#ifdef __cplusplus
}
#endif

#endif
