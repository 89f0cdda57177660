/** @file convert.h  Times and values of a log as the library's, and back.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_CONVERT_H
#define INSOLE_HOST_CONVERT_H

#include <math.h>

#include "insole/base/real.h"
#include "number.h"

/** The library counts from 0 and never back; a log may begin before its own zero. */
#define LOG_ZERO_US (UINT64_C(1) << 62)

static inline uint64_t to_library_us(int64_t t_us)
{
    return LOG_ZERO_US + (uint64_t)t_us;
}

static inline int64_t to_log_us(uint64_t t_us)
{
    return (int64_t)(t_us - LOG_ZERO_US);
}

/** What does not fit a real becomes not-a-number, which the library knows how to refuse. */
static inline insole_real_t to_real(double value)
{
    return fabs(value) <= (double)INSOLE_REAL_MAX ? (insole_real_t)value
                                                  : (insole_real_t)NUMBER_UNKNOWN;
}

#endif
