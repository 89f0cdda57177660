/** @file smooth.h  The smooth curves that a walk is made of.
 *
 *  `sim_ease` goes from 0 to 1 with a rate that rises smoothly, stays level and falls smoothly:
 *  twice continuously differentiable everywhere. `sim_quintic_t` joins two states of motion.
 *
 *      pitch_rad = -down_rad * sim_ease((t - begin) / length, 0.65, 0.25);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_SMOOTH_H
#define INSOLE_SIM_SMOOTH_H

#include <math.h>

/** Integral from 0 to u of 3 u^2 - 2 u^3, the smooth rise of a rate; 1/2 at u = 1. */
static inline double sim_ease_rise(double u)
{
    return u * u * u * (1.0 - 0.5 * u);
}

/** From 0 (u <= 0) to 1 (u >= 1); the rate rises over the share `rise` and falls over the share
 *  `fall`, both > 0 and together at most 1. The peak rate is 1 / (1 - (rise + fall) / 2). */
static inline double sim_ease(double u, double rise, double fall)
{
    if (u <= 0.0 || u >= 1.0) {
        return u <= 0.0 ? 0.0 : 1.0;
    }
    double whole = 1.0 - 0.5 * (rise + fall);
    if (u < rise) {
        return rise * sim_ease_rise(u / rise) / whole;
    }
    if (u <= 1.0 - fall) {
        return (u - 0.5 * rise) / whole;
    }
    return 1.0 - fall * sim_ease_rise((1.0 - u) / fall) / whole;
}

/** 64 u^3 (1 - u)^3: a hump of height 1 that starts and ends with no rate and no acceleration. */
static inline double sim_hump(double u)
{
    double v = u <= 0.0 || u >= 1.0 ? 0.0 : 4.0 * u * (1.0 - u);
    return v * v * v;
}

/** What rings from t = 0 on: a wave and its double that together set in smoothly (as t^4), and die
 *  away; but for the decay the peak of its second derivative is about wave^2. */
static inline double sim_ringing(double wave_radps, double decay_s, double t_s)
{
    double swing = 1.0 - cos(wave_radps * t_s);
    return exp(-t_s / decay_s) * swing * swing / 3.0;
}

/** Position, velocity and acceleration along one axis. */
typedef struct {
    double p, v, a;
} sim_state1_t;

/** p(t) = c0 + c1 t + ... + c5 t^5 */
typedef struct {
    double c[6];
} sim_quintic_t;

/** The quintic that is in state `from` at t = 0 and in state `to` at t = length > 0. */
static inline sim_quintic_t sim_quintic(sim_state1_t from, sim_state1_t to, double length)
{
    double T = length;
    double p = to.p - (from.p + T * (from.v + 0.5 * T * from.a)); /* what is still missing */
    double v = T * (to.v - (from.v + T * from.a));
    double a = T * T * (to.a - from.a);
    double T3 = T * T * T;
    sim_quintic_t q = {{from.p, from.v, 0.5 * from.a, (10.0 * p - 4.0 * v + 0.5 * a) / T3,
                        (-15.0 * p + 7.0 * v - a) / (T3 * T),
                        (6.0 * p - 3.0 * v + 0.5 * a) / (T3 * T * T)}};
    return q;
}

static inline double sim_quintic_at(const sim_quintic_t *q, double t)
{
    const double *c = q->c;
    return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
}

#endif
