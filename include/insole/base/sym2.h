/** @file sym2.h  Symmetric 2x2 matrices by value: covariances on the plane.
 *
 *      insole_sym2_t P = insole_sym2_add_outer(insole_sym2_circle(4), variance, way);
 *      if (insole_sym2_inverse(P, &W)) nis = insole_sym2_form(W, innovation);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_SYM2_H
#define INSOLE_BASE_SYM2_H

#include "insole/base/types.h"

typedef struct {
    insole_real_t xx, xy, yy;
} insole_sym2_t;

static inline insole_sym2_t insole_sym2(insole_real_t xx, insole_real_t xy, insole_real_t yy)
{
    insole_sym2_t s = {xx, xy, yy};
    return s;
}

/** s I */
static inline insole_sym2_t insole_sym2_circle(insole_real_t s)
{
    return insole_sym2(s, INSOLE_R(0.0), s);
}

/** A + B */
static inline insole_sym2_t insole_sym2_add(insole_sym2_t a, insole_sym2_t b)
{
    return insole_sym2(a.xx + b.xx, a.xy + b.xy, a.yy + b.yy);
}

static inline insole_sym2_t insole_sym2_scale(insole_sym2_t a, insole_real_t s)
{
    return insole_sym2(s * a.xx, s * a.xy, s * a.yy);
}

/** A + s v v' */
static inline insole_sym2_t insole_sym2_add_outer(insole_sym2_t a, insole_real_t s, insole_spot_t v)
{
    return insole_sym2(a.xx + s * v.x_m * v.x_m, a.xy + s * v.x_m * v.y_m,
                       a.yy + s * v.y_m * v.y_m);
}

/** A v */
static inline insole_spot_t insole_sym2_mul(insole_sym2_t a, insole_spot_t v)
{
    insole_spot_t product = {a.xx * v.x_m + a.xy * v.y_m, a.xy * v.x_m + a.yy * v.y_m};
    return product;
}

/** v' A v */
static inline insole_real_t insole_sym2_form(insole_sym2_t a, insole_spot_t v)
{
    return insole_spot_dot(v, insole_sym2_mul(a, v));
}

/** M A M' of the matrix M with these two rows. */
static inline insole_sym2_t insole_sym2_map(insole_spot_t row_x, insole_spot_t row_y,
                                            insole_sym2_t a)
{
    insole_spot_t Ax = insole_sym2_mul(a, row_x);
    return insole_sym2(insole_spot_dot(row_x, Ax), insole_spot_dot(row_y, Ax),
                       insole_sym2_form(a, row_y));
}

/** The larger eigenvalue: variance in the worst direction. */
static inline insole_real_t insole_sym2_largest(insole_sym2_t a)
{
    insole_real_t half = INSOLE_R(0.5) * (a.xx - a.yy);
    return INSOLE_R(0.5) * (a.xx + a.yy) + insole_sqrt(half * half + a.xy * a.xy);
}

/** Inverse of a positive definite matrix, by pivots.
 *  @return false, and `inverse` untouched, when it is not positive definite or has no finite
 *          inverse */
static inline bool insole_sym2_inverse(insole_sym2_t a, insole_sym2_t *inverse)
{
    insole_real_t l = a.xy / a.xx, iy = INSOLE_R(1.0) / (a.yy - l * a.xy);
    insole_sym2_t s = insole_sym2(INSOLE_R(1.0) / a.xx + l * l * iy, -l * iy, iy);
    bool definite = a.xx > INSOLE_R(0.0) && iy > INSOLE_R(0.0);
    if (!definite || !insole_is_finite(s.xx + s.yy)) {
        return false;
    }
    *inverse = s;
    return true;
}

/** Positive definite, with variances from `least` to `most` and a correlation that a float can
 *  still tell from one. */
static inline bool insole_sym2_is_between(insole_sym2_t a, insole_real_t least, insole_real_t most)
{
    return a.xx >= least && a.yy >= least && a.xx <= most && a.yy <= most &&
           a.xy * a.xy <= INSOLE_R(0.9999) * a.xx * a.yy;
}

/** A matrix near by of which insole_sym2_is_between() holds: one too large is scaled down as a
 *  whole, a variance too small is raised, a correlation too near one is lowered. */
static inline insole_sym2_t insole_sym2_bound(insole_sym2_t a, insole_real_t least,
                                              insole_real_t most)
{
    insole_real_t largest = insole_max(a.xx, a.yy);
    insole_sym2_t s = largest > most ? insole_sym2_scale(a, most / largest) : a;
    s.xx = insole_min(insole_max(s.xx, least), most);
    s.yy = insole_min(insole_max(s.yy, least), most);
    insole_real_t reach = INSOLE_R(0.9999) * insole_sqrt(s.xx) * insole_sqrt(s.yy);
    s.xy = insole_min(insole_max(s.xy, -reach), reach);
    return s;
}

#endif
