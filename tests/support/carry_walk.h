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
    double rock; /**< turn of a forearm that gives way to the bounce [rad/m] */
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

/** Turn rate at a time: rocking about the axis to the left, swinging, twisting [rad/s]. */
static inline d3_t carry_turn(const carry_gait_t *gait, double t_s)
{
    double w = 2.0 * 3.14159265358979323846 / gait->stride_s, a = w * t_s + gait->phase;
    double speed = -gait->bounce / (2.0 * w) * cos(2.0 * a);
    return d3(0.05 * gait->sway * sin(a), -gait->rock * speed + 0.1 * gait->swing * cos(a),
              0.2 * cos(a + 1.0));
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

enum { CARRY_BLOCKS = CARRY_POINTS / 5 };

/** Means of tenths of a second, without that of the window, which is returned. */
static inline d3_t carry_blocks(const d3_t *values, d3_t block[CARRY_BLOCKS])
{
    d3_t mean = d3(0, 0, 0);
    for (int i = 0; i < CARRY_POINTS; i++) {
        block[i / 5] = d3_add(i % 5 == 0 ? d3(0, 0, 0) : block[i / 5], 0.2, values[i]);
        mean = d3_add(mean, 1.0 / CARRY_POINTS, values[i]);
    }
    for (int i = 0; i < CARRY_BLOCKS; i++) {
        block[i] = d3_add(block[i], -1.0, mean);
    }
    return mean;
}

/** The best likeness among lags of so many tenths of a second. */
static inline double carry_likeness(const d3_t *block, double least, int from, int to)
{
    double best = -1.0;
    for (int lag = from; lag <= to; lag++) {
        double product = 0.0, power = least * (CARRY_BLOCKS - lag);
        for (int i = lag; i < CARRY_BLOCKS; i++) {
            d3_t a = block[i], b = block[i - lag];
            product += 2.0 * d3_dot(a, b);
            power += d3_dot(a, a) + d3_dot(b, b);
        }
        best = fmax(best, product / power);
    }
    return best;
}

/** Two level axes and up. */
static inline void carry_axes(d3_t mean, d3_t axis[3])
{
    double norm = d3_norm(mean);
    axis[2] = norm > 0.0 ? d3_scale(mean, 1.0 / norm) : d3(0, 0, 0);
    d3_t other = fabs(axis[2].x) < 0.7 ? d3(1, 0, 0) : d3(0, 1, 0);
    d3_t level = d3_cross(axis[2], other);
    axis[0] = d3_norm(level) > 0.0 ? d3_scale(level, 1.0 / d3_norm(level)) : d3(1, 0, 0);
    axis[1] = d3_cross(axis[2], axis[0]);
}

/** Mean product of two components of blocks. */
static inline double carry_product(const d3_t *block, d3_t a, d3_t b)
{
    double sum = 0.0;
    for (int i = 0; i < CARRY_BLOCKS; i++) {
        sum += d3_dot(block[i], a) * d3_dot(block[i], b) / CARRY_BLOCKS;
    }
    return sum;
}

/** Speeds upwards: the sums of the steps before and half of its own, less the line by the normal
 *  equations. */
static inline void carry_speeds(const d3_t *block, d3_t up, double speed[CARRY_BLOCKS])
{
    double s = 0.0, sx = 0.0, sxx = 0.0, sy = 0.0, sxy = 0.0;
    for (int i = 0; i < CARRY_BLOCKS; i++) {
        speed[i] = s + 0.05 * d3_dot(block[i], up);
        s += 0.1 * d3_dot(block[i], up);
        sx += i;
        sxx += i * i;
        sy += speed[i];
        sxy += i * speed[i];
    }
    double n = CARRY_BLOCKS, b = (n * sxy - sx * sy) / (n * sxx - sx * sx), a = (sy - b * sx) / n;
    for (int i = 0; i < CARRY_BLOCKS; i++) {
        speed[i] -= a + b * i;
    }
}

/** Those of the turn rate, in axes of which the last is up. */
static inline void carry_turn_features(const d3_t *turn, const d3_t axis[3], double rise,
                                       const double speed[CARRY_BLOCKS], double *features)
{
    d3_t block[CARRY_BLOCKS];
    (void)carry_blocks(turn, block);
    double p = carry_product(block, axis[0], axis[0]), q = carry_product(block, axis[1], axis[1]);
    double pq = carry_product(block, axis[0], axis[1]), across = p + q, in_time[2] = {0.0, 0.0};
    double squares = 0.0;
    features[INSOLE_CARRY_TURN] = across;
    features[INSOLE_CARRY_TURN_UPRIGHT] =
        carry_product(block, axis[2], axis[2]) / (across + 1.0e-3);
    features[INSOLE_CARRY_TURN_PER_RISE] = across / (rise + 0.05);
    /* eigenvalues of the level 2x2 block differ by the root of (p - q)^2 + 4 pq^2 */
    features[INSOLE_CARRY_TURN_LINE] =
        ((p - q) * (p - q) + 4.0 * pq * pq) / (across * across + 1.0e-6);
    for (int i = 0; i < CARRY_BLOCKS; i++) {
        block[i] = d3(d3_dot(block[i], axis[0]), d3_dot(block[i], axis[1]), 0.0);
        in_time[0] += block[i].x * speed[i];
        in_time[1] += block[i].y * speed[i];
        squares += speed[i] * speed[i];
    }
    double product = hypot(in_time[0], in_time[1]);
    features[INSOLE_CARRY_TURN_LIKENESS] = carry_likeness(block, 1.0e-4, 4, 7);
    features[INSOLE_CARRY_TURN_GAIN] = product / (squares + 1.0e-3);
    features[INSOLE_CARRY_TURN_IN_TIME] =
        product * product / (squares * across * CARRY_BLOCKS + 1.0e-4);
}

/** Those of the motion. @param turn  NULL: there is no gyroscope */
static inline void carry_motion_features(const d3_t *force, const d3_t *turn, double *features)
{
    d3_t block[CARRY_BLOCKS], axis[3];
    double speed[CARRY_BLOCKS];
    carry_axes(carry_blocks(force, block), axis);
    double rise = carry_product(block, axis[2], axis[2]);
    double level = carry_product(block, axis[0], axis[0]) + carry_product(block, axis[1], axis[1]);
    double both =
        hypot(carry_product(block, axis[0], axis[2]), carry_product(block, axis[1], axis[2]));
    features[INSOLE_CARRY_STEP_LIKENESS] = carry_likeness(block, 0.0025, 4, 7);
    features[INSOLE_CARRY_STRIDE_LIKENESS] = carry_likeness(block, 0.0025, 8, 13);
    features[INSOLE_CARRY_TOGETHER] = both * both / (rise * level + 0.01);
    for (int k = INSOLE_CARRY_ACCEL; k < INSOLE_CARRY_FEATURES; k++) {
        features[k] = 0.0;
    }
    if (turn != NULL) {
        carry_speeds(block, axis[2], speed);
        carry_turn_features(turn, axis, rise, speed, features);
    }
}

/** All features of a window. @param up  unit vectors against gravity */
static inline void carry_features(const d3_t *force, const d3_t *turn, const d3_t *up,
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
    carry_motion_features(force, turn, features);
}

#endif
