/** @file statistics.h  Mean, scatter and percentiles of a list of numbers.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_STATISTICS_H
#define INSOLE_HOST_STATISTICS_H

#include <stddef.h>

double statistics_mean(const double *values, size_t count);

/** Root of the mean square distance from the mean (divided by the count). */
double statistics_std(const double *values, size_t count);

double statistics_rms(const double *values, size_t count);

/** Percentile 0..100, interpolated between the ranks; 0 of an empty list. Sorts the values. */
double statistics_percentile(double *values, size_t count, double percent);

#endif
