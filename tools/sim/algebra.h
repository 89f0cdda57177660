/** @file algebra.h  Vectors and rotations of the simulator, in double.
 *
 *  The library computes in float; a trajectory that is differentiated twice cannot. Same
 *  conventions as base/: a rotation matrix turns vectors of the body into the outer frame.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_ALGEBRA_H
#define INSOLE_SIM_ALGEBRA_H

#include <math.h>

#define SIM_PI 3.14159265358979323846

typedef struct {
    double x, y, z;
} sim_vec3_t;

/** Three rows. */
typedef struct {
    sim_vec3_t r0, r1, r2;
} sim_mat3_t;

/** Where a body is and how it is turned: `attitude` turns its axes into the outer frame. */
typedef struct {
    sim_vec3_t position_m;
    sim_mat3_t attitude;
} sim_pose_t;

static inline sim_vec3_t sim_vec3(double x, double y, double z)
{
    sim_vec3_t v = {x, y, z};
    return v;
}

static inline sim_vec3_t sim_vec3_add(sim_vec3_t a, sim_vec3_t b)
{
    return sim_vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline sim_vec3_t sim_vec3_sub(sim_vec3_t a, sim_vec3_t b)
{
    return sim_vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline sim_vec3_t sim_vec3_scale(sim_vec3_t a, double s)
{
    return sim_vec3(a.x * s, a.y * s, a.z * s);
}

/** a + s b */
static inline sim_vec3_t sim_vec3_add_scaled(sim_vec3_t a, double s, sim_vec3_t b)
{
    return sim_vec3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

static inline double sim_vec3_dot(sim_vec3_t a, sim_vec3_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline double sim_vec3_norm(sim_vec3_t a)
{
    return sqrt(sim_vec3_dot(a, a));
}

static inline sim_mat3_t sim_mat3_identity(void)
{
    sim_mat3_t m = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    return m;
}

/** A v */
static inline sim_vec3_t sim_mat3_mul_vec(sim_mat3_t a, sim_vec3_t v)
{
    return sim_vec3(sim_vec3_dot(a.r0, v), sim_vec3_dot(a.r1, v), sim_vec3_dot(a.r2, v));
}

/** A' v */
static inline sim_vec3_t sim_mat3_mul_vec_t(sim_mat3_t a, sim_vec3_t v)
{
    return sim_vec3_add_scaled(sim_vec3_add_scaled(sim_vec3_scale(a.r0, v.x), v.y, a.r1), v.z,
                               a.r2);
}

/** A B */
static inline sim_mat3_t sim_mat3_mul(sim_mat3_t a, sim_mat3_t b)
{
    sim_mat3_t m = {sim_mat3_mul_vec_t(b, a.r0), sim_mat3_mul_vec_t(b, a.r1),
                    sim_mat3_mul_vec_t(b, a.r2)};
    return m;
}

/** Rz(yaw) Ry(pitch) Rx(roll): with z up and x forward a positive pitch lowers the nose. */
static inline sim_mat3_t sim_mat3_from_euler(double roll_rad, double pitch_rad, double yaw_rad)
{
    double cr = cos(roll_rad), sr = sin(roll_rad);
    double cp = cos(pitch_rad), sp = sin(pitch_rad);
    double cy = cos(yaw_rad), sy = sin(yaw_rad);
    sim_mat3_t m = {{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
                    {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
                    {-sp, cp * sr, cp * cr}};
    return m;
}

/** The turn by |v| about v. */
static inline sim_mat3_t sim_mat3_from_turn(sim_vec3_t v)
{
    double angle2 = sim_vec3_dot(v, v), angle = sqrt(angle2), half = sin(0.5 * angle);
    double s = angle < 1e-4 ? 1.0 - angle2 / 6.0 : sin(angle) / angle;
    double c = angle < 1e-4 ? 0.5 - angle2 / 24.0 : 2.0 * half * half / angle2;
    sim_mat3_t m = {
        {1.0 - c * (v.y * v.y + v.z * v.z), c * v.x * v.y - s * v.z, c * v.x * v.z + s * v.y},
        {c * v.x * v.y + s * v.z, 1.0 - c * (v.x * v.x + v.z * v.z), c * v.y * v.z - s * v.x},
        {c * v.x * v.z - s * v.y, c * v.y * v.z + s * v.x, 1.0 - c * (v.x * v.x + v.y * v.y)}};
    return m;
}

/** The turn that a rotation is, by 0 to pi. */
static inline sim_vec3_t sim_mat3_turn(sim_mat3_t m)
{
    sim_vec3_t w = sim_vec3(m.r2.y - m.r1.z, m.r0.z - m.r2.x, m.r1.x - m.r0.y); /* 2 sin axis */
    double sine = 0.5 * sim_vec3_norm(w), cosine = 0.5 * (m.r0.x + m.r1.y + m.r2.z - 1.0);
    double angle = atan2(sine, cosine);
    if (sine > 1e-6 || cosine > 0.0) {
        return sim_vec3_scale(w, sine > 1e-6 ? 0.5 * angle / sine : 0.5);
    }
    sim_vec3_t axis = sim_vec3(m.r0.x + 1.0, m.r0.y, m.r0.z); /* a row of 1 + R = 2 axis axis' */
    if (m.r1.y > m.r0.x && m.r1.y >= m.r2.z) {
        axis = sim_vec3(m.r1.x, m.r1.y + 1.0, m.r1.z);
    } else if (m.r2.z > m.r0.x) {
        axis = sim_vec3(m.r2.x, m.r2.y, m.r2.z + 1.0);
    }
    return sim_vec3_scale(axis, angle / sim_vec3_norm(axis));
}

/** First derivative in the middle of five values that are `step` apart; error step^4 / 30 f(5). */
static inline sim_vec3_t sim_vec3_derivative(const sim_vec3_t f[5], double step)
{
    sim_vec3_t near = sim_vec3_sub(f[3], f[1]), far = sim_vec3_sub(f[4], f[0]);
    return sim_vec3_scale(sim_vec3_add_scaled(sim_vec3_scale(near, 8.0), -1.0, far),
                          1.0 / (12.0 * step));
}

/** Second derivative there; error step^4 / 90 f(6). */
static inline sim_vec3_t sim_vec3_second_derivative(const sim_vec3_t f[5], double step)
{
    sim_vec3_t near = sim_vec3_add(sim_vec3_sub(f[3], f[2]), sim_vec3_sub(f[1], f[2]));
    sim_vec3_t far = sim_vec3_add(sim_vec3_sub(f[4], f[2]), sim_vec3_sub(f[0], f[2]));
    return sim_vec3_scale(sim_vec3_add_scaled(sim_vec3_scale(near, 16.0), -1.0, far),
                          1.0 / (12.0 * step * step));
}

/** The same angle in (-pi, pi]. */
static inline double sim_wrap_pi(double angle_rad)
{
    double wrapped = fmod(angle_rad, 2.0 * SIM_PI);
    if (wrapped > SIM_PI) {
        return wrapped - 2.0 * SIM_PI;
    }
    return wrapped <= -SIM_PI ? wrapped + 2.0 * SIM_PI : wrapped;
}

#endif
