/** @file bench_walk.h  What a shoe feels on a made-up walk: two seconds of rest, then every second
 * a stride of 0.72 m along a line.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_BENCH_WALK_H
#define INSOLE_TESTS_BENCH_WALK_H

#include "insole/base/types.h"

enum {
    BENCH_RATE_HZ = 200,
    BENCH_REST = 2 * BENCH_RATE_HZ,
    BENCH_WALK = 10 * BENCH_RATE_HZ /**< samples */
};

/** The sample made last. */
extern insole_imu_t bench_imu;

void bench_make_sample(uint32_t number);

#endif
