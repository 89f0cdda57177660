/** @file plane.h  2x2 algebra in double, to hold what moves on the plane against.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_PLANE_H
#define INSOLE_TESTS_PLANE_H

#include <math.h>

#include "insole/base/sym2.h"
#include "sample.h"

/** Any 2x2 matrix: [a b; c d]. */
typedef struct {
    double a, b, c, d;
} plane_t;

typedef struct {
    double x, y;
} point_t;

static inline plane_t plane_of(insole_sym2_t s)
{
    plane_t m = {(double)s.xx, (double)s.xy, (double)s.xy, (double)s.yy};
    return m;
}

static inline point_t point_of(insole_spot_t spot)
{
    point_t p = {(double)spot.x_m, (double)spot.y_m};
    return p;
}

static inline plane_t plane_add(plane_t m, double s, plane_t n)
{
    plane_t sum = {m.a + s * n.a, m.b + s * n.b, m.c + s * n.c, m.d + s * n.d};
    return sum;
}

static inline plane_t plane_mul(plane_t m, plane_t n)
{
    plane_t p = {m.a * n.a + m.b * n.c, m.a * n.b + m.b * n.d, m.c * n.a + m.d * n.c,
                 m.c * n.b + m.d * n.d};
    return p;
}

static inline plane_t plane_transpose(plane_t m)
{
    plane_t t = {m.a, m.c, m.b, m.d};
    return t;
}

static inline plane_t plane_inverse(plane_t m)
{
    double det = m.a * m.d - m.b * m.c;
    plane_t i = {m.d / det, -m.b / det, -m.c / det, m.a / det};
    return i;
}

static inline point_t plane_apply(plane_t m, point_t p)
{
    point_t q = {m.a * p.x + m.b * p.y, m.c * p.x + m.d * p.y};
    return q;
}

/** p' M p */
static inline double plane_form(plane_t m, point_t p)
{
    point_t q = plane_apply(m, p);
    return p.x * q.x + p.y * q.y;
}

/** Largest difference of an entry. */
static inline double plane_apart(plane_t m, insole_sym2_t s)
{
    plane_t e = plane_add(m, -1.0, plane_of(s));
    return fmax(fmax(fabs(e.a), fabs(e.b)), fmax(fabs(e.c), fabs(e.d)));
}

static inline double point_apart(point_t p, insole_spot_t spot)
{
    return hypot(p.x - (double)spot.x_m, p.y - (double)spot.y_m);
}

/** Smallest eigenvalue. */
static inline double plane_least(insole_sym2_t s)
{
    double half = 0.5 * ((double)s.xx - (double)s.yy);
    return 0.5 * ((double)s.xx + (double)s.yy) - hypot(half, (double)s.xy);
}

/** A random covariance with 1-sigmas of up to `size`, the smaller at least a tenth of that. */
static inline insole_sym2_t sample_sym2(insole_rng_t *rng, insole_real_t size)
{
    insole_spot_t v = {sample_between(rng, -size, size), sample_between(rng, -size, size)};
    insole_sym2_t least = insole_sym2_circle(INSOLE_R(0.01) * size * size);
    return insole_sym2_add_outer(least, INSOLE_R(0.5), v);
}

static inline insole_spot_t sample_spot(insole_rng_t *rng, insole_real_t size)
{
    insole_real_t x = sample_between(rng, -size, size);
    return insole_spot(x, sample_between(rng, -size, size));
}

/** Two normal numbers with this covariance. */
static inline point_t sample_of(insole_rng_t *rng, plane_t cov)
{
    double l = sqrt(cov.a), m = cov.b / l, n = sqrt(cov.d - m * m);
    double u = (double)insole_rng_normal(rng), v = (double)insole_rng_normal(rng);
    point_t p = {l * u, m * u + n * v};
    return p;
}

#endif
