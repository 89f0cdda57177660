/** @file normal_tail.h  The normal distribution below a limit, in double.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_NORMAL_TAIL_H
#define INSOLE_HOST_NORMAL_TAIL_H

#include <math.h>

/** Chance of a value below z, in sigmas. */
static inline double normal_below(double z)
{
    return 0.5 * erfc(-z * 0.70710678118654752);
}

/** Density at z over the chance to be below; grows like -z to the left. */
static inline double normal_hazard(double z)
{
    return z < -8.0 ? -z : exp(-0.5 * z * z) * 0.39894228040143268 / normal_below(z);
}

#endif
