/** @file step_fit.h  Coefficients of a model of the step length, by least squares.
 *
 *  Source  [PhoneEKF (3)], [PhoneUKF (6)]; the models are those of step_length.h.
 *
 *  The distance of each segment is the sum over its steps; it scatters by the root of its length.
 *  Standard errors are of any kind of error that is a session's own, from five sessions on; below
 *  that, a segment's own: another walker is not in them.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_STEP_FIT_H
#define INSOLE_HOST_STEP_FIT_H

#include "step_walks.h"

enum { STEP_COEFFICIENTS = 3 };

/** A model is linear in its coefficients: `count` features of step_walks.h and their keys. */
typedef struct {
    const char *name;
    int count;
    int feature[STEP_COEFFICIENTS];
    const char *key[STEP_COEFFICIENTS]; /**< of step_length */
} step_model_t;

/** root, linear, mixed, constant; in the order of insole_step_length_model_t. */
extern const step_model_t step_models[INSOLE_STEP_LENGTH_CONSTANT + 1];

typedef struct {
    bool is_told; /**< there are enough segments, and they tell the coefficients apart */
    double value[STEP_COEFFICIENTS];
    double error[STEP_COEFFICIENTS]; /**< 1-sigma; not-a-number: a single segment */
    double segment_m;                /**< rms of what segments are longer or shorter */
    double session_share;            /**< mean of |error| / distance over sessions */
} step_fit_t;

void step_fit(step_fit_t *fit, const step_model_t *model, const step_walks_t *walks);

/** Length of a segment by the coefficients. */
double step_fit_length(const step_fit_t *fit, const step_model_t *model,
                       const step_segment_t *segment);

#endif
