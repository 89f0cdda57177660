/** @file fastmath.h  sin, cos, atan2, exp and log of our own: the same bits on every machine.
 *
 *  Only additions, multiplications, divisions and exponent arithmetic in IEEE single precision,
 *  compiled without contraction; no table, no loop, no division in sin, cos, exp and log. In a
 *  build with INSOLE_DOUBLE the inside of the range is libm's (wrap_pi: 2.5 ulp of pi), the outside
 *  is the same.
 *
 *  | function       | range of the promise    | error, ulp of result | outside the range        |
 *  |----------------|-------------------------|----------------------|--------------------------|
 *  | insole_sin/cos | |x| <= 1e4 rad          | 1.6, zeros included  | counts as x = 0          |
 *  | insole_atan2   | all finite              | 1.7                  | as libm; (0, 0) gives 0  |
 *  | insole_exp     | results that are normal | 1                    | 0 below, REAL_MAX above  |
 *  | insole_log     | 0 < x <= REAL_MAX       | 1                    | -REAL_MAX, REAL_MAX over |
 *  | insole_wrap_pi | |x| <= 1e4 rad          | 1.3 ulp of pi        | counts as x = 0          |
 *
 *  What is not a number stays so; everything else, infinities too, gives a finite result.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_FASTMATH_H
#define INSOLE_BASE_FASTMATH_H

#include "insole/base/real.h"

#ifdef __cplusplus
extern "C" {
#endif

insole_real_t insole_sin(insole_real_t x_rad);
insole_real_t insole_cos(insole_real_t x_rad);

/** A direction, or a turn of the plane. */
typedef struct {
    insole_real_t cos, sin;
} insole_turn_t;

/** Both at once: the bits of insole_cos and insole_sin, for little more than the price of one. */
insole_turn_t insole_turn(insole_real_t x_rad);

/** Angle of the point (x, y), in (-pi, pi]. */
insole_real_t insole_atan2(insole_real_t y, insole_real_t x);

insole_real_t insole_exp(insole_real_t x);

/** Natural logarithm. */
insole_real_t insole_log(insole_real_t x);

/** The same angle in (-pi, pi], for angles that are mostly beyond. */
insole_real_t insole_wrap_far(insole_real_t angle_rad);

/** The same angle in (-pi, pi], for angles that are mostly within. */
insole_real_t insole_wrap_pi(insole_real_t angle_rad);

/** As insole_wrap_pi(), for loops over particles: nothing is called for an angle within. */
static inline insole_real_t insole_wrap_near(insole_real_t angle_rad)
{
    return angle_rad <= -INSOLE_PI || angle_rad > INSOLE_PI ? insole_wrap_far(angle_rad)
                                                            : angle_rad;
}

#ifdef __cplusplus
}
#endif

#endif
