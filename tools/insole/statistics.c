/* SPDX-License-Identifier: MIT */
#include "statistics.h"

#include <math.h>
#include <stdlib.h>

double statistics_mean(const double *values, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0u; i < count; i++) {
        sum += values[i];
    }
    return count > 0u ? sum / (double)count : 0.0;
}

static double mean_square_from(double center, const double *values, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0u; i < count; i++) {
        sum += (values[i] - center) * (values[i] - center);
    }
    return count > 0u ? sum / (double)count : 0.0;
}

double statistics_std(const double *values, size_t count)
{
    return sqrt(mean_square_from(statistics_mean(values, count), values, count));
}

double statistics_rms(const double *values, size_t count)
{
    return sqrt(mean_square_from(0.0, values, count));
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double statistics_percentile(double *values, size_t count, double percent)
{
    if (count == 0u) {
        return 0.0;
    }
    qsort(values, count, sizeof *values, compare);
    double rank = percent / 100.0 * (double)(count - 1u);
    size_t below = (size_t)rank;
    size_t above = below + 1u < count ? below + 1u : below;
    return values[below] + (rank - (double)below) * (values[above] - values[below]);
}
