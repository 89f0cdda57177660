/** @file oracle.h  libm in the next wider type, to hold the library's functions against.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_ORACLE_H
#define INSOLE_TESTS_ORACLE_H

#include "insole/base/real.h"

#ifdef INSOLE_DOUBLE
typedef long double oracle_t;
#define ORACLE(function) function##l
#define REAL_NEXT        nextafter
#define REAL_MANT_DIG    DBL_MANT_DIG
#define REAL_MIN_EXP     DBL_MIN_EXP
#define REAL_MIN         DBL_MIN
#else
typedef double oracle_t;
#define ORACLE(function) function
#define REAL_NEXT        nextafterf
#define REAL_MANT_DIG    FLT_MANT_DIG
#define REAL_MIN_EXP     FLT_MIN_EXP
#define REAL_MIN         FLT_MIN
#endif

/** Distance in units of the last place that a real has where the exact value lies. */
static inline double ulps_off(insole_real_t value, oracle_t exact)
{
    int exponent;
    (void)ORACLE(frexp)(exact, &exponent);
    exponent = exponent < REAL_MIN_EXP ? REAL_MIN_EXP : exponent;
    return (double)ORACLE(ldexp)(ORACLE(fabs)((oracle_t)value - exact), REAL_MANT_DIG - exponent);
}

/** The number with these bits in single precision; in a double build with more bits behind. */
static inline insole_real_t number_of(uint32_t bits)
{
    union {
        uint32_t bits;
        float value;
    } single = {bits};
#ifdef INSOLE_DOUBLE
    return (double)single.value * 1.0000000123456789;
#else
    return single.value;
#endif
}

static inline uint32_t bits_of(float value)
{
    union {
        float value;
        uint32_t bits;
    } single = {value};
    return single.bits;
}

#endif
