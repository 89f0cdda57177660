/** @file gait.h  A foot that walks, by formula: a rest, then strides of a swing and a stance.
 *
 *      gait_t gait = gait_usual();
 *      gait_reading(&gait, begin_s, end_s, &force, &rate);      means over the interval, b
 *      moment_t m = gait_moment(&gait, end_s);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_GAIT_H
#define INSOLE_TESTS_GAIT_H

#include "motion.h"

typedef struct {
    double rest_s, swing_s, stance_s;
    double length_m, lift_m, climb_m; /**< of a stride */
    double pitch_rad, roll_rad;       /**< largest in the swing */
    double turn_rad;                  /**< of a stride */
    d33_t mounting;                   /**< of the sensor on the foot */
} gait_t;

static inline gait_t gait_usual(void)
{
    gait_t g = {2.0, 0.6, 0.4, 1.3, 0.08, 0.0, 0.5, 0.1, 0.2, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    g.mounting = d33_mul(turn_y(0.3), turn_z(0.5));
    return g;
}

static inline double gait_stride_s(const gait_t *g)
{
    return g->swing_s + g->stance_s;
}

/** Share of the swing of stride `*number` that is over; 1 in a stance. */
static inline double gait_phase(const gait_t *g, double t, double *number)
{
    double since = (t - g->rest_s) / gait_stride_s(g);
    *number = since < 0.0 ? 0.0 : floor(since);
    double in_swing = (since - *number) * gait_stride_s(g) / g->swing_s;
    return since < 0.0 ? 0.0 : fmin(in_swing, 1.0);
}

/** The foot stands over the whole interval. */
static inline bool gait_is_still(const gait_t *g, double begin, double end)
{
    double number, phase = gait_phase(g, 0.5 * (begin + end), &number);
    return phase <= 0.0 || phase >= 1.0;
}

/** Place and attitude alone. Progress and lift begin and end without acceleration. */
static inline moment_t gait_pose(const gait_t *g, double t)
{
    moment_t m;
    double k, s = gait_phase(g, t, &k);
    double progress = s * s * s * (10.0 - s * (15.0 - 6.0 * s));
    double swing = 64.0 * s * s * s * (1.0 - s) * (1.0 - s) * (1.0 - s);
    m.p = d3(0.0, 0.0, g->climb_m * (k + progress) + g->lift_m * swing);
    double half = 0.5 * g->turn_rad;
    double chord = fabs(half) > 1.0e-9 ? sin(k * half) / sin(half) : k;
    m.p = d3_add(m.p, g->length_m * chord, d3(cos(k * half), sin(k * half), 0.0));
    double ahead = (2.0 * k + 1.0) * half;
    m.p = d3_add(m.p, g->length_m * progress, d3(cos(ahead), sin(ahead), 0.0));
    d33_t yaw = turn_z(g->turn_rad * (k + progress));
    d33_t pitch = turn_y(g->pitch_rad * swing * (1.0 - 2.0 * s) * 2.0);
    m.R = d33_mul(d33_mul(yaw, pitch), d33_mul(turn_x(g->roll_rad * swing), g->mounting));
    return m;
}

/** With velocity, acceleration and turn rate by differences over 0.2 ms. */
static inline moment_t gait_moment(const gait_t *g, double t)
{
    const double h = 1.0e-4;
    moment_t m = gait_pose(g, t), before = gait_pose(g, t - h), after = gait_pose(g, t + h);
    d3_t way = d3_add(after.p, -1.0, before.p);
    d3_t bend = d3_add(d3_add(after.p, -2.0, m.p), 1.0, before.p);
    m.v = d3_scale(way, 0.5 / h);
    m.a = d3_scale(bend, 1.0 / (h * h));
    d3_t turn = turn_between(before.R, after.R);
    m.w = d33_apply(d33_transpose(m.R), d3_scale(turn, 0.5 / h));
    return m;
}

/** What the sensor feels in the mean over [begin, end]: three points of Gauss. */
static inline void gait_reading(const gait_t *g, double begin, double end, d3_t *force, d3_t *rate)
{
    static const double at[3] = {0.0, 0.7745966692414834, -0.7745966692414834};
    static const double weight[3] = {8.0 / 18.0, 5.0 / 18.0, 5.0 / 18.0};
    *force = *rate = d3(0.0, 0.0, 0.0);
    for (int i = 0; i < 3; i++) {
        moment_t m = gait_moment(g, 0.5 * (begin + end) + 0.5 * (end - begin) * at[i]);
        *force = d3_add(*force, weight[i], motion_force(&m));
        *rate = d3_add(*rate, weight[i], m.w);
    }
}

#endif
