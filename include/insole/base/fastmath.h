/** @file fastmath.h  sin, cos, atan2, exp and log of our own: the same bits on every machine.
 *
 *  Only additions, multiplications, divisions and exponent arithmetic in IEEE single precision,
 *  compiled without contraction. In a build with INSOLE_DOUBLE they are those of libm.
 *
 *  | function       | range of the promise | largest error | outside the range            |
 *  |----------------|----------------------|---------------|------------------------------|
 *  | insole_sin/cos | |x| <= 1e4 rad       | 2 ulp of 1    | finite, in [-1, 1]; nan->nan |
 *  | insole_atan2   | all finite           | 2 ulp         | nan->nan, (0, 0) gives 0     |
 *  | insole_exp     | -87 .. 88            | 2 ulp         | 0 below, largest real above  |
 *  | insole_log     | normal x > 0         | 2 ulp         | -largest for x <= 0          |
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

/** Angle of the point (x, y), in (-pi, pi]. */
insole_real_t insole_atan2(insole_real_t y, insole_real_t x);

insole_real_t insole_exp(insole_real_t x);

/** Natural logarithm. */
insole_real_t insole_log(insole_real_t x);

/** The same angle in (-pi, pi]. */
insole_real_t insole_wrap_pi(insole_real_t angle_rad);

#ifdef __cplusplus
}
#endif

#endif
