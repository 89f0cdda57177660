/** @file anchors.h  Anchors, ranges and signal strengths for the tests of fixes.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_ANCHORS_H
#define INSOLE_TESTS_ANCHORS_H

#include <string.h>

#include "insole/base/rng.h"
#include "insole/place/propagation.h"
#include "insole/place/robust_fit.h"
#include "near.h"

enum { APS_MAX = 8 };

static insole_rng_t rng;
static insole_ap_t aps[APS_MAX];
static insole_range_t ranges[APS_MAX];
static insole_rss_t readings[APS_MAX];
static uint32_t count; /* of the access points in use */

static inline double uniform(double low, double high)
{
    return low + (high - low) * (double)insole_rng_uniform(&rng);
}

static inline void place_ap(uint32_t i, double x, double y)
{
    ck_assert_int_eq(insole_propagation_ap(&insole_propagation_defaults, (insole_real_t)x,
                                           (insole_real_t)y, 0, &aps[i]),
                     INSOLE_OK);
}

/** As many as there may be or fewer, as far apart as it comes, every fourth on the x axis.
 *  @return how far */
static inline double place_wildly(void)
{
    count = 1u + insole_rng_bits(&rng) % APS_MAX;
    double wide = pow(10.0, uniform(-3.0, 4.0));
    for (uint32_t k = 0; k < count; k++) {
        double x = uniform(-wide, wide);
        place_ap(k, x, insole_rng_bits(&rng) & 3u ? uniform(-wide, wide) : 0.0);
    }
    return wide;
}

static inline double distance(uint32_t i, double x, double y)
{
    return hypot(x - (double)aps[i].x_m, y - (double)aps[i].y_m);
}

/** Ranges from (x, y), too long by `bias_m`. */
static inline void measure(double x, double y, double bias_m, double sigma_m)
{
    for (uint32_t i = 0; i < count; i++) {
        double noise = sigma_m > 0.0 ? sigma_m * (double)insole_rng_normal(&rng) : 0.0;
        insole_range_t range = {0, i, (insole_real_t)fmax(0.0, distance(i, x, y) + bias_m + noise),
                                0};
        ranges[i] = range;
    }
}

/** Signal strengths at (x, y) by the model, half the body in the way. */
static inline void listen(double x, double y, double gain_db, double sigma_db)
{
    for (uint32_t i = 0; i < count; i++) {
        double loss = 10.0 * (double)aps[i].exponent * log10(fmax(0.3, distance(i, x, y)));
        double noise = sigma_db > 0.0 ? sigma_db * (double)insole_rng_normal(&rng) : 0.0;
        insole_rss_t rss = {
            i, (insole_real_t)((double)aps[i].p0_dbm - loss - 5.405 + gain_db + noise), 0};
        readings[i] = rss;
    }
}

/** Anchors around a hall of 20 m x 15 m, no two on the same spot. */
static inline void place_random(uint32_t n)
{
    count = n;
    for (uint32_t i = 0; i < n; i++) {
        double a = 6.2831853 * (i + uniform(0.0, 0.6)) / n;
        place_ap(i, 10.0 + 12.0 * cos(a), 7.5 + 9.0 * sin(a));
    }
}

static inline double miss(const insole_anchor_fix_t *fix, double x, double y)
{
    return hypot((double)fix->x_m - x, (double)fix->y_m - y);
}

/** Finite, symmetric by its kind, and positive. */
static inline void check_covariance(const insole_sym3_t *P)
{
    double xx = (double)P->xx, xy = (double)P->xy, xz = (double)P->xz;
    double yy = (double)P->yy, yz = (double)P->yz, zz = (double)P->zz;
    double minor = xx * yy - xy * xy;
    double determinant = zz * minor - xx * yz * yz - yy * xz * xz + 2.0 * xy * xz * yz;
    ck_assert_msg(xx > 0.0 && minor > 0.0 && determinant > 0.0 && determinant < HUGE_VAL,
                  "%g %g %g %g %g %g", xx, xy, xz, yy, yz, zz);
}

/** How a hall is laid on the map; coordinates are good to sharp_m there. */
typedef struct {
    double angle_rad, x_m, y_m, sharp_m;
} frame_t;

static const frame_t frames[] = {{0.645771823, 0.0, 0.0, 2e-3},
                                 {0.645771823, 500.0, -500.0, 2e-3},
                                 {0.0, -10000.0, 10000.0, 5e-3}};

/** Turns and shifts the anchors. */
static inline void move_aps(const frame_t *f)
{
    double c = cos(f->angle_rad), s = sin(f->angle_rad);
    for (uint32_t i = 0; i < count; i++) {
        double x = (double)aps[i].x_m, y = (double)aps[i].y_m;
        place_ap(i, c * x - s * y + f->x_m, s * x + c * y + f->y_m);
    }
}

static inline void check_moved(const frame_t *f, const insole_anchor_fix_t *fix,
                               const insole_anchor_fix_t *moved)
{
    double c = cos(f->angle_rad), s = sin(f->angle_rad);
    double x = (double)fix->x_m, y = (double)fix->y_m;
    ASSERT_NEAR(moved->x_m, c * x - s * y + f->x_m, f->sharp_m, "m");
    ASSERT_NEAR(moved->y_m, s * x + c * y + f->y_m, f->sharp_m, "m");
    double xx = (double)fix->P.xx, xy = (double)fix->P.xy, yy = (double)fix->P.yy;
    ASSERT_NEAR(moved->P.xx, c * c * xx - 2.0 * c * s * xy + s * s * yy, 0.01 * (xx + yy), "m2");
    ASSERT_NEAR(moved->P.xy, c * s * (xx - yy) + (c * c - s * s) * xy, 0.01 * (xx + yy), "m2");
    ASSERT_NEAR(moved->common, fix->common, f->sharp_m, "");
}

typedef double cost_t(double x, double y, double common);

/** Nowhere near by is the cost less, by more than a fix 3 cm off its least would leave. */
static inline void check_is_least(cost_t *cost, const insole_anchor_fix_t *fix)
{
    double x = (double)fix->x_m, y = (double)fix->y_m, c = (double)fix->common;
    double here = cost(x, y, c) - 1e-4;
    for (int i = 0; i < 8; i++) {
        double dx = 0.05 * cos(0.785398 * i), dy = 0.05 * sin(0.785398 * i);
        ASSERT_AT_LEAST(cost(x + dx, y + dy, c), here, "");
    }
    ASSERT_AT_LEAST(cost(x, y, c + 0.05), here, "");
    ASSERT_AT_LEAST(cost(x, y, c - 0.05), here, "");
}

#endif
