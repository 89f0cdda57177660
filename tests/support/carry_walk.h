/** @file carry_walk.h  What a phone on a walker feels, by formula, and the features of a window as
 *  their definitions have them, in double.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_CARRY_WALK_H
#define INSOLE_TESTS_CARRY_WALK_H

#include <stdlib.h>

#include "insole/base/quat.h"
#include "insole/sense/carry_window.h"
#include "motion.h"

enum { CARRY_POINTS = 2 * INSOLE_CARRY_HALF, CARRY_LONGEST = 2000 };

/** A gait: bounce of each step, sway and swing of each stride [m/s^2]. */
typedef struct {
    double stride_s, bounce, sway, swing, phase;
} carry_gait_t;

/** Specific force at a time, level frame, z up. */
static inline d3_t carry_force(const carry_gait_t *gait, double t_s)
{
    double w = 2.0 * 3.14159265358979323846 / gait->stride_s, a = w * t_s + gait->phase;
    double x = gait->swing * sin(a) + 0.3 * gait->bounce * cos(2.0 * a + 0.4);
    double y = gait->sway * cos(a) + 0.2 * gait->sway * sin(3.0 * a);
    double z = MOTION_G + gait->bounce * sin(2.0 * a) + 0.3 * gait->bounce * cos(4.0 * a);
    return d3(x, y, z);
}

static inline int carry_compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/** Statistics of one series: five of the paper, then the skewness. */
static inline void carry_describe(const double *values, double out[6])
{
    double sorted[CARRY_POINTS], sum = 0.0, squares = 0.0, cubes = 0.0;
    for (int i = 0; i < CARRY_POINTS; i++) {
        sorted[i] = values[i];
        sum += values[i] / CARRY_POINTS;
    }
    for (int i = 0; i < CARRY_POINTS; i++) {
        squares += pow(values[i] - sum, 2.0) / CARRY_POINTS;
        cubes += pow(values[i] - sum, 3.0) / CARRY_POINTS;
    }
    qsort(sorted, CARRY_POINTS, sizeof *sorted, carry_compare);
    out[INSOLE_CARRY_VARIANCE] = squares;
    out[INSOLE_CARRY_MEAN] = sum;
    out[INSOLE_CARRY_MEDIAN] = 0.5 * (sorted[CARRY_POINTS / 2 - 1] + sorted[CARRY_POINTS / 2]);
    out[INSOLE_CARRY_MAXIMUM] = sorted[CARRY_POINTS - 1];
    out[INSOLE_CARRY_MINIMUM] = sorted[0];
    out[5] = cubes / (pow(squares, 1.5) + 0.01);
}

/** The best likeness among lags of so many tenths of a second. */
static inline double carry_likeness(const d3_t *force, int from, int to)
{
    enum { BLOCKS = CARRY_POINTS / 5 };
    d3_t block[BLOCKS], mean = d3(0, 0, 0);
    double best = -1.0;
    for (int i = 0; i < CARRY_POINTS; i++) {
        block[i / 5] = d3_add(i % 5 == 0 ? d3(0, 0, 0) : block[i / 5], 0.2, force[i]);
        mean = d3_add(mean, 1.0 / CARRY_POINTS, force[i]);
    }
    for (int lag = from; lag <= to; lag++) {
        double product = 0.0, power = 0.0025 * (BLOCKS - lag);
        for (int i = lag; i < BLOCKS; i++) {
            d3_t a = d3_add(block[i], -1.0, mean), b = d3_add(block[i - lag], -1.0, mean);
            product += 2.0 * d3_dot(a, b);
            power += d3_dot(a, a) + d3_dot(b, b);
        }
        best = fmax(best, product / power);
    }
    return best;
}

/** All features of a window. @param up  unit vectors against gravity */
static inline void carry_features(const d3_t *force, const d3_t *up,
                                  double features[INSOLE_CARRY_FEATURES])
{
    double series[INSOLE_CARRY_SERIES][CARRY_POINTS], six[6];
    for (int i = 0; i < CARRY_POINTS; i++) {
        double along = d3_dot(force[i], up[i]);
        series[INSOLE_CARRY_MACC][i] = d3_norm(force[i]);
        series[INSOLE_CARRY_HACC][i] = d3_norm(d3_add(force[i], -along, up[i]));
        series[INSOLE_CARRY_GACC][i] = fabs(along);
    }
    for (int k = 0; k < INSOLE_CARRY_SERIES; k++) {
        carry_describe(series[k], six);
        for (int s = 0; s < INSOLE_CARRY_STATISTICS; s++) {
            features[k * INSOLE_CARRY_STATISTICS + s] = six[s];
        }
        features[INSOLE_CARRY_SKEWNESS + k] = six[5];
    }
    features[INSOLE_CARRY_STEP_LIKENESS] = carry_likeness(force, 4, 7);
    features[INSOLE_CARRY_STRIDE_LIKENESS] = carry_likeness(force, 8, 13);
}

#endif
