/** @file near.h  Comparisons that print value, expectation, tolerance and unit.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_NEAR_H
#define INSOLE_TESTS_NEAR_H

#include <check.h>
#include <math.h>

/** The largest of many deviations and where it was: one assertion after a long loop, since every
 *  ck_assert costs a system call. Start from {0.0, 0.0}. */
typedef struct {
    double off, at;
} worst_t;

/** Not-a-number is the worst of all. */
static inline void worst_note(worst_t *worst, double off, double at)
{
    if (!(off <= worst->off) && !isnan(worst->off)) {
        worst->off = off;
        worst->at = at;
    }
}

/** A yes-or-no fact: 1 off when it does not hold. */
static inline void worst_require(worst_t *worst, int holds, double at)
{
    worst_note(worst, holds ? 0.0 : 1.0, at);
}

/** worst.off <= limit; tells where. */
#define ASSERT_WORST(worst, limit, unit)                                                           \
    ck_assert_msg((worst).off <= (double)(limit), "%s: %.9g %s at %.9g, expected at most %.9g",    \
                  #worst, (worst).off, unit, (worst).at, (double)(limit))

/** Every worst_require() held. */
#define ASSERT_ALL_HELD(worst) ASSERT_WORST(worst, 0.0, "(1 = does not hold)")

/** |value - expected| <= tolerance; not-a-number fails. */
#define ASSERT_NEAR(value, expected, tolerance, unit)                                              \
    do {                                                                                           \
        double near_v_ = (double)(value), near_e_ = (double)(expected);                            \
        double near_t_ = (double)(tolerance);                                                      \
        ck_assert_msg(fabs(near_v_ - near_e_) <= near_t_,                                          \
                      "%s = %.9g %s, expected %.9g +- %.3g %s", #value, near_v_, unit, near_e_,    \
                      near_t_, unit);                                                              \
    } while (0)

/** value <= limit; not-a-number fails. */
#define ASSERT_AT_MOST(value, limit, unit)                                                         \
    do {                                                                                           \
        double near_v_ = (double)(value), near_l_ = (double)(limit);                               \
        ck_assert_msg(near_v_ <= near_l_, "%s = %.9g %s, expected at most %.9g %s", #value,        \
                      near_v_, unit, near_l_, unit);                                               \
    } while (0)

/** value >= limit; not-a-number fails. */
#define ASSERT_AT_LEAST(value, limit, unit)                                                        \
    do {                                                                                           \
        double near_v_ = (double)(value), near_l_ = (double)(limit);                               \
        ck_assert_msg(near_v_ >= near_l_, "%s = %.9g %s, expected at least %.9g %s", #value,       \
                      near_v_, unit, near_l_, unit);                                               \
    } while (0)

#endif
