/** @file footsteps.h  What an accelerometer on a walker's body feels, made of steps.
 *
 *  |a| is gravity and, around each step, a narrow bump less a wide one of the same area: the
 *  body is pushed up by each step as much as it falls before and after it.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_FOOTSTEPS_H
#define INSOLE_TESTS_FOOTSTEPS_H

#include <math.h>

enum { FOOTSTEPS_MAX = 400 };

typedef struct {
    int count;
    double t_s[FOOTSTEPS_MAX];
    double height_mps2[FOOTSTEPS_MAX];
    double period_s[FOOTSTEPS_MAX]; /* its bump is as wide */
} footsteps_t;

static inline void footsteps_add(footsteps_t *steps, double t_s, double height_mps2,
                                 double period_s)
{
    steps->t_s[steps->count] = t_s;
    steps->height_mps2[steps->count] = height_mps2;
    steps->period_s[steps->count++] = period_s;
}

/** `count` even steps from begin_s on. @return the time at which the next would come */
static inline double footsteps_walk(footsteps_t *steps, double begin_s, int count, double period_s,
                                    double height_mps2)
{
    for (int i = 0; i < count; i++) {
        footsteps_add(steps, begin_s + i * period_s, height_mps2, period_s);
    }
    return begin_s + count * period_s;
}

/** |a| at a moment, m/s^2. */
static inline double footsteps_feel(const footsteps_t *steps, double t_s)
{
    const double narrow = 0.18, wide = 0.45; /* of a period, 1-sigma */
    double a = 9.81;
    for (int i = 0; i < steps->count; i++) {
        double off = (t_s - steps->t_s[i]) / steps->period_s[i];
        if (fabs(off) < 2.5) {
            a += steps->height_mps2[i] * (exp(-0.5 * off * off / (narrow * narrow)) -
                                          narrow / wide * exp(-0.5 * off * off / (wide * wide)));
        }
    }
    return a;
}

#endif
