/** @file stroll.h  A walker by formula, and what a phone feels that lies on them somewhere.
 *
 *  The trunk is an inverted pendulum: lowest and fastest when both feet stand, highest and slowest
 *  over the middle of a foot, with the energy of both the same; it sways from foot to foot. A hand
 *  that holds a phone gives way to the bounce at a slant; arm and thigh are pendulums that swing
 * once in two steps. All in double, accelerations by formula.
 *
 *      stroll_t stroll = stroll_in(STROLL_POCKET, mounting);
 *      stroll_moment(&stroll, t_s, &R, &accel);                    b to n; n, without gravity
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_STROLL_H
#define INSOLE_TESTS_STROLL_H

#include "insole/base/types.h"
#include "motion.h"

typedef enum { STROLL_HAND, STROLL_CALL, STROLL_SWING, STROLL_POCKET, STROLL_POSES } stroll_pose_t;

typedef struct {
    double step_s, speed_mps, bounce_m, sway_m;
    double slant;                       /**< forward motion of a hand over its bounce */
    double limb_m, limb_rad, limb_late; /**< length, amplitude and phase of what swings */
    double heading_rad;                 /**< before the turn */
    double turn_begin_s, turn_end_s, turn_rad;
    d33_t mounting; /**< of the phone on the trunk or the limb */
} stroll_t;

static inline stroll_t stroll_in(stroll_pose_t pose, d33_t mounting)
{
    stroll_t s = {.step_s = 0.55, .speed_mps = 1.3, .bounce_m = 0.02, .sway_m = 0.015};
    s.slant = pose == STROLL_HAND ? 0.3 : 0.0;
    s.limb_m = pose == STROLL_SWING ? 0.6 : 0.35;
    s.limb_rad = pose == STROLL_SWING ? 0.25 : pose == STROLL_POCKET ? 0.3 : 0.0;
    s.limb_late = pose == STROLL_POCKET ? 0.4 : 0.0;
    s.turn_begin_s = s.turn_end_s = 1.0e9;
    s.mounting = mounting;
    return s;
}

/** Of a phone whose y axis points aside of the way, to the left, and is raised by the pitch. */
static inline d33_t stroll_held(double aside_rad, double pitch_rad)
{
    return d33_mul(turn_z(aside_rad - 0.5 * 3.14159265358979323846), turn_x(pitch_rad));
}

static inline double stroll_heading(const stroll_t *s, double t)
{
    double share = (t - s->turn_begin_s) / (s->turn_end_s - s->turn_begin_s);
    return s->heading_rad + (share > 0.0 ? s->turn_rad * fmin(share, 1.0) : 0.0);
}

/** Attitude and acceleration of the phone: a step begins where t is a multiple of `step_s`. */
static inline void stroll_moment(const stroll_t *s, double t, d33_t *R, d3_t *accel)
{
    double w = 2.0 * 3.14159265358979323846 / s->step_s, half = 0.5 * w;
    double swing = half * t - s->limb_late; /* of the limb; farthest ahead or back at a step */
    double heading = stroll_heading(s, t), turning = t > s->turn_begin_s && t < s->turn_end_s;
    double rate = turning != 0.0 ? s->turn_rad / (s->turn_end_s - s->turn_begin_s) : 0.0;
    double quick = MOTION_G * s->bounce_m / s->speed_mps; /* v^2 / 2 + g z does not change */
    double up = s->bounce_m * w * w * cos(w * t);
    double ahead = -quick * w * sin(w * t) + s->slant * up;
    double left = (s->speed_mps + quick * cos(w * t)) * rate;
    left -= s->sway_m * half * half * sin(half * t);
    double a = s->limb_rad * cos(swing), a_rate = -half * s->limb_rad * sin(swing);
    double a_accel = -half * half * a;
    ahead += s->limb_m * (cos(a) * a_accel - sin(a) * a_rate * a_rate);
    up += s->limb_m * (sin(a) * a_accel + cos(a) * a_rate * a_rate);
    d33_t yaw = turn_z(heading);
    *accel = d33_apply(yaw, d3(ahead, left, up));
    *R = d33_mul(d33_mul(yaw, turn_y(-a)), s->mounting);
}

/** Specific force in b. */
static inline d3_t stroll_force(d33_t R, d3_t accel)
{
    return d33_apply(d33_transpose(R), d3_add(accel, 1.0, d3(0.0, 0.0, MOTION_G)));
}

#endif
