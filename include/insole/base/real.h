/** @file real.h  The one floating-point type of the library.
 *
 *  `insole_real_t` is float. A build with INSOLE_DOUBLE makes it double: the oracle that the
 *  tests hold the float library against. Literals go through INSOLE_R(), functions through
 *  fastmath.h and insole_sqrt(), so that no double arithmetic slips into a float build.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_REAL_H
#define INSOLE_BASE_REAL_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef INSOLE_DOUBLE
typedef double insole_real_t;
#define INSOLE_R(literal)   literal
#define INSOLE_REAL_MAX     DBL_MAX
#define INSOLE_REAL_EPSILON DBL_EPSILON
#else
typedef float insole_real_t;
#define INSOLE_R(literal)   literal##f
#define INSOLE_REAL_MAX     FLT_MAX
#define INSOLE_REAL_EPSILON FLT_EPSILON
#endif

/** Before a function whose callees are to be inlined even where a compiler would rather not: no
 *  block is copied on its way from one step to the next. */
#ifdef __GNUC__
#define INSOLE_FLAT __attribute__((flatten))
#else
#define INSOLE_FLAT
#endif

/** Before a function that runs seldom: made small rather than fast, and kept out of those that run
 *  on each sample. */
#ifdef __GNUC__
#define INSOLE_COLD __attribute__((cold, noinline))
#else
#define INSOLE_COLD
#endif

/** Before a function that is not to be inlined: callers that do not take this step make no room for
 *  it. */
#ifdef __GNUC__
#define INSOLE_APART __attribute__((noinline))
#else
#define INSOLE_APART
#endif

#define INSOLE_PI INSOLE_R(3.14159265358979323846)

/** Square root; correctly rounded, hence the same bits on every machine. */
static inline insole_real_t insole_sqrt(insole_real_t x)
{
#ifdef INSOLE_DOUBLE
    return sqrt(x);
#else
    return sqrtf(x);
#endif
}

/** Absolute value. */
static inline insole_real_t insole_abs(insole_real_t x)
{
#ifdef INSOLE_DOUBLE
    return fabs(x);
#else
    return fabsf(x);
#endif
}

/** The larger of two; `b` when `a` is not a number. */
static inline insole_real_t insole_max(insole_real_t a, insole_real_t b)
{
    return a > b ? a : b;
}

/** The smaller of two; `b` when `a` is not a number. */
static inline insole_real_t insole_min(insole_real_t a, insole_real_t b)
{
    return a < b ? a : b;
}

/** True for everything but infinities and not-a-number. */
static inline bool insole_is_finite(insole_real_t x)
{
    return insole_abs(x) <= INSOLE_REAL_MAX;
}

/** Square. */
static inline insole_real_t insole_square(insole_real_t x)
{
    return x * x;
}

#endif
