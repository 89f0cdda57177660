/** @file vec3.h  Vectors of three, by value.
 *
 *      insole_vec3_t v = insole_vec3_add(a, insole_vec3_scale(b, dt_s));
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_VEC3_H
#define INSOLE_BASE_VEC3_H

#include "insole/base/real.h"

typedef struct {
    insole_real_t x, y, z;
} insole_vec3_t;

static inline insole_vec3_t insole_vec3(insole_real_t x, insole_real_t y, insole_real_t z)
{
    insole_vec3_t v = {x, y, z};
    return v;
}

static inline insole_vec3_t insole_vec3_zero(void)
{
    return insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), INSOLE_R(0.0));
}

static inline insole_vec3_t insole_vec3_add(insole_vec3_t a, insole_vec3_t b)
{
    return insole_vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline insole_vec3_t insole_vec3_sub(insole_vec3_t a, insole_vec3_t b)
{
    return insole_vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline insole_vec3_t insole_vec3_neg(insole_vec3_t a)
{
    return insole_vec3(-a.x, -a.y, -a.z);
}

static inline insole_vec3_t insole_vec3_scale(insole_vec3_t a, insole_real_t s)
{
    return insole_vec3(a.x * s, a.y * s, a.z * s);
}

/** a + s b */
static inline insole_vec3_t insole_vec3_add_scaled(insole_vec3_t a, insole_real_t s,
                                                   insole_vec3_t b)
{
    return insole_vec3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

/** (a + b) / 2 */
static inline insole_vec3_t insole_vec3_middle(insole_vec3_t a, insole_vec3_t b)
{
    return insole_vec3_scale(insole_vec3_add(a, b), INSOLE_R(0.5));
}

static inline insole_real_t insole_vec3_dot(insole_vec3_t a, insole_vec3_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline insole_vec3_t insole_vec3_cross(insole_vec3_t a, insole_vec3_t b)
{
    return insole_vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline insole_real_t insole_vec3_norm2(insole_vec3_t a)
{
    return insole_vec3_dot(a, a);
}

static inline insole_real_t insole_vec3_norm(insole_vec3_t a)
{
    return insole_sqrt(insole_vec3_norm2(a));
}

/** Length of the part along x and y. */
static inline insole_real_t insole_vec3_level(insole_vec3_t a)
{
    return insole_sqrt(a.x * a.x + a.y * a.y);
}

/** Largest magnitude among the three components. */
static inline insole_real_t insole_vec3_max_abs(insole_vec3_t a)
{
    return insole_max(insole_max(insole_abs(a.x), insole_abs(a.y)), insole_abs(a.z));
}

/** Is each component finite, and no larger? */
static inline bool insole_vec3_is_within(insole_vec3_t a, insole_real_t limit)
{
    return insole_abs(a.x) <= limit && insole_abs(a.y) <= limit && insole_abs(a.z) <= limit;
}

/** One comparison for three: nothing times what is not finite is not nothing. */
static inline bool insole_vec3_is_finite(insole_vec3_t a)
{
    const insole_real_t none = INSOLE_R(0.0);
    return none * a.x + none * a.y + none * a.z == none;
}

#endif
