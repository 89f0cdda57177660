/** @file quat.h  Unit quaternions: Hamilton, scalar first, body to navigation frame.
 *
 *      insole_vec3_t f_n = insole_quat_rotate(q, f_b);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_QUAT_H
#define INSOLE_BASE_QUAT_H

#include "insole/base/mat.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_real_t w, x, y, z;
} insole_quat_t;

static inline insole_quat_t insole_quat(insole_real_t w, insole_real_t x, insole_real_t y,
                                        insole_real_t z)
{
    insole_quat_t q = {w, x, y, z};
    return q;
}

static inline insole_quat_t insole_quat_identity(void)
{
    return insole_quat(INSOLE_R(1.0), INSOLE_R(0.0), INSOLE_R(0.0), INSOLE_R(0.0));
}

/** First `b`, then `a`. */
static inline insole_quat_t insole_quat_mul(insole_quat_t a, insole_quat_t b)
{
    return insole_quat(a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
                       a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                       a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                       a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w);
}

static inline insole_quat_t insole_quat_conjugate(insole_quat_t q)
{
    return insole_quat(q.w, -q.x, -q.y, -q.z);
}

/** Rotation matrix, [TwoOrder (15)], [PhoneEKF (5)] transposed, [PhoneUKF (8)]; `q` of unit length.
 */
static inline insole_mat3_t insole_quat_to_mat3(insole_quat_t q)
{
    insole_real_t x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
    insole_real_t xx = q.x * x2, yy = q.y * y2, zz = q.z * z2;
    insole_real_t xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
    insole_real_t wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
    return insole_mat3_rows(insole_vec3(INSOLE_R(1.0) - (yy + zz), xy - wz, xz + wy),
                            insole_vec3(xy + wz, INSOLE_R(1.0) - (xx + zz), yz - wx),
                            insole_vec3(xz - wy, yz + wx, INSOLE_R(1.0) - (xx + yy)));
}

insole_vec3_t insole_quat_rotate(insole_quat_t q, insole_vec3_t v);

/** Rotation by the inverse of `q`. */
insole_vec3_t insole_quat_rotate_back(insole_quat_t q, insole_vec3_t v);

/** Square of half an angle, [rad^2], below which insole_quat_from_small holds. */
#define INSOLE_QUAT_SMALL_RAD2 INSOLE_R(0.01)

/** Rotation by a small angle: `half_rad` is half its rotation vector, `half2_rad2` the square of
 *  its length. What these series leave out is below the last bit. */
static inline insole_quat_t insole_quat_from_small(insole_vec3_t half_rad, insole_real_t half2_rad2)
{
    const insole_real_t one = INSOLE_R(1.0), z = half2_rad2;
    insole_real_t c = one, s = one; /* the next two terms, that only a double sees */
    if (INSOLE_REAL_EPSILON < INSOLE_R(1.0e-10)) {
        c = one - z * (one / INSOLE_R(30.0)) * (one - z * (one / INSOLE_R(56.0)));
        s = one - z * (one / INSOLE_R(42.0)) * (one - z * (one / INSOLE_R(72.0)));
    }
    insole_real_t y = z * INSOLE_R(0.5);
    c = one - y * (one - y * (one / INSOLE_R(6.0)) * c); /* cos(half) */
    s = one - z * (one / INSOLE_R(6.0)) * (one - z * (one / INSOLE_R(20.0)) * s);
    return insole_quat(c, s * half_rad.x, s * half_rad.y, s * half_rad.z);
}

/** To unit length; a quaternion of no length becomes the identity. */
insole_quat_t insole_quat_normalize(insole_quat_t q);

/** The same in line, for what runs on each sample. */
static inline insole_quat_t insole_quat_unit(insole_quat_t q)
{
    insole_real_t n = insole_sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(n > INSOLE_R(0.0) && n <= INSOLE_REAL_MAX)) {
        return insole_quat_identity();
    }
    insole_real_t s = INSOLE_R(1.0) / n;
    return insole_quat(q.w * s, q.x * s, q.y * s, q.z * s);
}
/** The product of two, brought to unit length. */
insole_quat_t insole_quat_chain(insole_quat_t a, insole_quat_t b);

/** Rotation by the angle |v| about v [rad]. */
insole_quat_t insole_quat_from_rotvec(insole_vec3_t rotation_rad);

/** Rotation by the angle 2 |half_rad| about it, up to 800 rad, without a sine: half as far until it
 *  is small, and as often twice that. The error is that of the small rotation, as often doubled. */
insole_quat_t insole_quat_from_half(insole_vec3_t half_rad);

/** Attitude with yaw 0 of a resting sensor that feels the specific force `f_b`, table 1 of
 *  [TwoOrder] with the pitch of its erratum. Any mounting, upside down too. */
insole_quat_t insole_quat_from_gravity(insole_vec3_t f_b);

/** Rotation by `yaw_rad` about the vertical. */
insole_quat_t insole_quat_from_yaw(insole_real_t yaw_rad);

/** The attitude nearest to `q` in which the specific force `f_b` of a resting sensor points up; the
 *  same for any mounting. An `f_b` of no length, or one that points straight down, changes
 *  nothing. */
insole_quat_t insole_quat_level(insole_quat_t q, insole_vec3_t f_b);

/** Turn about the vertical from one attitude to another, in (-pi, pi]; holds for any mounting. */
insole_real_t insole_quat_turn(insole_quat_t from, insole_quat_t to);

/** Heading of the body's x axis, counter-clockwise from n-frame x, in (-pi, pi]. */
insole_real_t insole_quat_yaw(insole_quat_t q);

#ifdef __cplusplus
}
#endif

#endif
