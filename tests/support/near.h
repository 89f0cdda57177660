/** @file near.h  Comparisons that print value, expectation, tolerance and unit.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_NEAR_H
#define INSOLE_TESTS_NEAR_H

#include <check.h>
#include <math.h>

/** |value - expected| <= tolerance; not-a-number fails. */
#define ASSERT_NEAR(value, expected, tolerance, unit)                                          \
    do {                                                                                       \
        double near_v_ = (double)(value), near_e_ = (double)(expected);                        \
        double near_t_ = (double)(tolerance);                                                  \
        ck_assert_msg(fabs(near_v_ - near_e_) <= near_t_,                                      \
                      "%s = %.9g %s, expected %.9g +- %.3g %s", #value, near_v_, unit, near_e_, \
                      near_t_, unit);                                                          \
    } while (0)

/** value <= limit; not-a-number fails. */
#define ASSERT_AT_MOST(value, limit, unit)                                                    \
    do {                                                                                      \
        double near_v_ = (double)(value), near_l_ = (double)(limit);                          \
        ck_assert_msg(near_v_ <= near_l_, "%s = %.9g %s, expected at most %.9g %s", #value,   \
                      near_v_, unit, near_l_, unit);                                          \
    } while (0)

/** value >= limit; not-a-number fails. */
#define ASSERT_AT_LEAST(value, limit, unit)                                                   \
    do {                                                                                      \
        double near_v_ = (double)(value), near_l_ = (double)(limit);                          \
        ck_assert_msg(near_v_ >= near_l_, "%s = %.9g %s, expected at least %.9g %s", #value,  \
                      near_v_, unit, near_l_, unit);                                          \
    } while (0)

#endif
