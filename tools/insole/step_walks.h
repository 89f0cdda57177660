/** @file step_walks.h  Walks of known distance: how far, and what the accelerometer felt of the
 * steps.
 *
 *  The truth of a session is cut into segments of 10 m or more; the last may be half as long. A
 * step that begins in one segment and ends in the next counts in both, by the time it spends there.
 *
 *      step_walks_t walks = {0};
 *      for each session: if (!step_walks_add(&walks, path, &source, &failure)) ...
 *      walks.segments, walks.count: for step_fit
 *      step_walks_free(&walks);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_STEP_WALKS_H
#define INSOLE_HOST_STEP_WALKS_H

#include "failure.h"
#include "insole/move/step_length.h"
#include "track.h"

/** What the models of step_length.h are made of, summed over steps. */
enum { STEP_ONE, STEP_HZ, STEP_VARIANCE, STEP_SQUARE_ROOT, STEP_ROOT, STEP_FEATURES };

typedef struct {
    size_t session; /**< counted from 0 */
    double distance_m;
    double sum[STEP_FEATURES];
} step_segment_t;

/** Where readings and distances come from. */
typedef struct {
    const char *accel_unit, *gyro_unit; /**< NULL: m/s^2, rad/s */
    double distance_m;                  /**< of the whole session; 0: the truth tells */
} step_source_t;

/** Empty walks are all zeros. */
typedef struct {
    step_segment_t *segments;
    size_t count, room;
    size_t sessions;
    unsigned long steps;
    unsigned long without_steps; /**< segments left out: hardly a step in them */
} step_walks_t;

/** Features of one step, by the defaults of step_length. */
void step_features(const insole_footfall_t *footfall, double feature[STEP_FEATURES]);

/** Adds a session whose steps are known.
 *  @param truth  sorted; its times and those of the steps are on one clock
 *  @param distance_m  of all steps together; 0: the truth tells */
void step_walks_add_steps(step_walks_t *walks, const insole_footfall_t *steps, size_t count,
                          const track_t *truth, double distance_m);

/** @param path  a session: a file, a folder or `-` */
bool step_walks_add(step_walks_t *walks, const char *path, const step_source_t *source,
                    failure_t *failure);

void step_walks_free(step_walks_t *walks);

#endif
