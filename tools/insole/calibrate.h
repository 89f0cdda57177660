/** @file calibrate.h  What the defaults cannot know, measured and printed as config lines.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_CALIBRATE_H
#define INSOLE_HOST_CALIBRATE_H

#include <stdio.h>

#include "options.h"

/** Biases, noise and gravity from sessions of a resting sensor, each another pose perhaps. */
bool calibrate_imu(const arguments_t *arguments, const char *const *sessions, size_t count,
                   FILE *file, failure_t *failure);

/** K of [TwoOrder (33)] from walks. */
bool calibrate_stride(const arguments_t *arguments, const char *const *sessions, size_t count,
                      FILE *file, failure_t *failure);

/** Scale of the gyroscope from `--turns` whole turns between two rests. */
bool calibrate_gyro_scale(const arguments_t *arguments, const char *const *sessions, size_t count,
                          FILE *file, failure_t *failure);

/** Path loss from surveys: sessions with rss and truth, `--aps`, `--plan`, `--height`; writes
 * access points to `--out`. */
bool calibrate_pathloss(const arguments_t *arguments, const char *const *sessions, size_t count,
                        FILE *file, failure_t *failure);

/** Coefficients of the step length's models from walks with truth, or of `--distance`. */
bool calibrate_steplength(const arguments_t *arguments, const char *const *sessions, size_t count,
                          FILE *file, failure_t *failure);

/** Magnetic north on the map from walks with truth and a phone that points ahead. */
bool calibrate_compass(const arguments_t *arguments, const char *const *sessions, size_t count,
                       FILE *file, failure_t *failure);

/** Prints `key = value` with so many decimals. */
void calibrate_line(FILE *file, const char *key, double value, int decimals);

#endif
