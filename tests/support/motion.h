/** @file motion.h  Motions known by formula, what an IMU feels on them, and a filter put on them.
 *
 *  All in double. A reading is the mean over its interval or the value at its end.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_MOTION_H
#define INSOLE_TESTS_MOTION_H

#include <math.h>

#include "insole/move/zupt_ekf.h"

#define MOTION_G 9.81

typedef struct {
    double x, y, z;
} d3_t;

typedef struct {
    d3_t r0, r1, r2;
} d33_t;

static inline d3_t d3(double x, double y, double z)
{
    d3_t v = {x, y, z};
    return v;
}

static inline d3_t d3_add(d3_t a, double s, d3_t b)
{
    return d3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

static inline d3_t d3_scale(d3_t a, double s)
{
    return d3(a.x * s, a.y * s, a.z * s);
}

static inline double d3_dot(d3_t a, d3_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline d3_t d3_cross(d3_t a, d3_t b)
{
    return d3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double d3_norm(d3_t a)
{
    return sqrt(d3_dot(a, a));
}

static inline d3_t d33_apply(d33_t A, d3_t v)
{
    return d3(d3_dot(A.r0, v), d3_dot(A.r1, v), d3_dot(A.r2, v));
}

static inline d33_t d33_transpose(d33_t A)
{
    d33_t t = {d3(A.r0.x, A.r1.x, A.r2.x), d3(A.r0.y, A.r1.y, A.r2.y), d3(A.r0.z, A.r1.z, A.r2.z)};
    return t;
}

static inline d33_t d33_mul(d33_t A, d33_t B)
{
    d33_t t = d33_transpose(B);
    d33_t c = {d33_apply(t, A.r0), d33_apply(t, A.r1), d33_apply(t, A.r2)};
    return c;
}

static inline d33_t d33_inverse(d33_t A)
{
    d3_t bc = d3_cross(A.r1, A.r2), ca = d3_cross(A.r2, A.r0), ab = d3_cross(A.r0, A.r1);
    double per = 1.0 / d3_dot(A.r0, bc);
    d33_t cofactors = {d3_scale(bc, per), d3_scale(ca, per), d3_scale(ab, per)};
    return d33_transpose(cofactors);
}

static inline d33_t turn_x(double angle)
{
    double c = cos(angle), s = sin(angle);
    d33_t R = {d3(1.0, 0.0, 0.0), d3(0.0, c, -s), d3(0.0, s, c)};
    return R;
}

static inline d33_t turn_y(double angle)
{
    double c = cos(angle), s = sin(angle);
    d33_t R = {d3(c, 0.0, s), d3(0.0, 1.0, 0.0), d3(-s, 0.0, c)};
    return R;
}

static inline d33_t turn_z(double angle)
{
    double c = cos(angle), s = sin(angle);
    d33_t R = {d3(c, -s, 0.0), d3(s, c, 0.0), d3(0.0, 0.0, 1.0)};
    return R;
}

static inline d33_t d33_of(insole_mat3_t m)
{
    d33_t A = {d3((double)m.r0.x, (double)m.r0.y, (double)m.r0.z),
               d3((double)m.r1.x, (double)m.r1.y, (double)m.r1.z),
               d3((double)m.r2.x, (double)m.r2.y, (double)m.r2.z)};
    return A;
}

static inline d3_t d3_of(insole_vec3_t v)
{
    return d3((double)v.x, (double)v.y, (double)v.z);
}

static inline insole_vec3_t real_of(d3_t v)
{
    return insole_vec3((insole_real_t)v.x, (insole_real_t)v.y, (insole_real_t)v.z);
}

/** Rotation vector in n of the turn by less than a right angle that leads from `from` to `to`. */
static inline d3_t turn_between(d33_t from, d33_t to)
{
    d33_t E = d33_mul(to, d33_transpose(from));
    d3_t axis = d3(0.5 * (E.r2.y - E.r1.z), 0.5 * (E.r0.z - E.r2.x), 0.5 * (E.r1.x - E.r0.y));
    double s = d3_norm(axis);
    return s > 1.0e-9 ? d3_scale(axis, asin(fmin(s, 1.0)) / s) : axis;
}

/** Quaternion of a rotation matrix, by its largest component. */
static inline insole_quat_t quat_of(d33_t R)
{
    double four[4] = {1.0 + R.r0.x + R.r1.y + R.r2.z, 1.0 + R.r0.x - R.r1.y - R.r2.z,
                      1.0 - R.r0.x + R.r1.y - R.r2.z, 1.0 - R.r0.x - R.r1.y + R.r2.z};
    double wx = R.r2.y - R.r1.z, wy = R.r0.z - R.r2.x, wz = R.r1.x - R.r0.y;
    double xy = R.r1.x + R.r0.y, xz = R.r0.z + R.r2.x, yz = R.r2.y + R.r1.z;
    double rows[4][4] = {
        {four[0], wx, wy, wz}, {wx, four[1], xy, xz}, {wy, xy, four[2], yz}, {wz, xz, yz, four[3]}};
    int k = 0;
    for (int i = 1; i < 4; i++) {
        k = four[i] > four[k] ? i : k;
    }
    double s = 0.5 / sqrt(four[k]);
    return insole_quat((insole_real_t)(s * rows[k][0]), (insole_real_t)(s * rows[k][1]),
                       (insole_real_t)(s * rows[k][2]), (insole_real_t)(s * rows[k][3]));
}

/** A moment of a motion: place, velocity, acceleration in n; attitude; turn rate in b. */
typedef struct {
    d3_t p, v, a, w;
    d33_t R;
} moment_t;

typedef moment_t (*motion_t)(double t);

/** Specific force in b. */
static inline d3_t motion_force(const moment_t *m)
{
    return d33_apply(d33_transpose(m->R), d3_add(m->a, 1.0, d3(0.0, 0.0, MOTION_G)));
}

/** Means over [begin, end] by five points of Gauss. */
static inline void motion_mean(motion_t motion, double begin, double end, d3_t *force, d3_t *rate)
{
    static const double at[5] = {0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                                 -0.9061798459386640};
    static const double weight[5] = {0.2844444444444444, 0.2393143352496832, 0.2393143352496832,
                                     0.1184634425280945, 0.1184634425280945};
    *force = *rate = d3(0.0, 0.0, 0.0);
    for (int i = 0; i < 5; i++) {
        moment_t m = motion(0.5 * (begin + end) + 0.5 * (end - begin) * at[i]);
        *force = d3_add(*force, weight[i], motion_force(&m));
        *rate = d3_add(*rate, weight[i], m.w);
    }
}

/** A filter that knows where it is and how it moves; its last sample is that of the moment. */
static inline void motion_put(insole_zupt_ekf_t *ekf, const insole_zupt_ekf_config_t *config,
                              const moment_t *m, uint64_t t_us)
{
    insole_vec3_t up = insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), (insole_real_t)MOTION_G);
    (void)insole_zupt_ekf_init(ekf, config);
    ekf->gravity_mps2 = (insole_real_t)MOTION_G;
    (void)insole_zupt_ekf_align(ekf, up, config->sigma_tilt_rad, INSOLE_R(0.0), t_us);
    ekf->p_m = real_of(m->p);
    ekf->v_mps = real_of(m->v);
    ekf->q = quat_of(m->R);
    ekf->last_accel_mps2 = real_of(motion_force(m));
    ekf->last_gyro_radps = real_of(m->w);
}

#endif
