/* SPDX-License-Identifier: MIT */
#include "insole/base/quat.h"

#include "insole/base/fastmath.h"

/* One n-th, folded by the compiler. */
#define SHARE(n) (INSOLE_R(1.0) / INSOLE_R(n))

insole_quat_t insole_quat_normalize(insole_quat_t q)
{
    insole_real_t n = insole_sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(n > INSOLE_R(0.0)) || !insole_is_finite(n)) {
        return insole_quat_identity();
    }
    insole_real_t s = INSOLE_R(1.0) / n;
    return insole_quat(q.w * s, q.x * s, q.y * s, q.z * s);
}

insole_quat_t insole_quat_chain(insole_quat_t a, insole_quat_t b)
{
    return insole_quat_normalize(insole_quat_mul(a, b));
}

insole_quat_t insole_quat_from_rotvec(insole_vec3_t rotation_rad)
{
    insole_real_t half2 = INSOLE_R(0.25) * insole_vec3_norm2(rotation_rad);
    insole_real_t c, s; /* cos(half), sin(half) / (2 half) */
    if (half2 < INSOLE_R(0.01)) {
        /* what these series leave out is below the last bit, and with two more terms of a double */
        const insole_real_t one = INSOLE_R(1.0), z = half2;
        c = s = one;
        if (INSOLE_REAL_EPSILON < INSOLE_R(1.0e-10)) {
            c = one - z * SHARE(30.0) * (one - z * SHARE(56.0));
            s = one - z * SHARE(42.0) * (one - z * SHARE(72.0));
        }
        c = one - z * SHARE(2.0) * (one - z * SHARE(12.0) * c);
        s = SHARE(2.0) * (one - z * SHARE(6.0) * (one - z * SHARE(20.0) * s));
    } else {
        insole_real_t half = insole_sqrt(half2);
        insole_turn_t turn = insole_turn(half);
        c = turn.cos;
        s = SHARE(2.0) * turn.sin / half;
    }
    return insole_quat(c, s * rotation_rad.x, s * rotation_rad.y, s * rotation_rad.z);
}

INSOLE_COLD insole_quat_t insole_quat_from_gravity(insole_vec3_t f_b)
{
    insole_real_t horizontal = insole_sqrt(f_b.y * f_b.y + f_b.z * f_b.z);
    insole_real_t roll = insole_atan2(f_b.y, f_b.z);
    insole_real_t pitch = insole_atan2(-f_b.x, horizontal);
    insole_quat_t q_roll = insole_quat_from_rotvec(insole_vec3(roll, INSOLE_R(0.0), INSOLE_R(0.0)));
    insole_quat_t q_pitch =
        insole_quat_from_rotvec(insole_vec3(INSOLE_R(0.0), pitch, INSOLE_R(0.0)));
    return insole_quat_chain(q_pitch, q_roll);
}

INSOLE_COLD insole_quat_t insole_quat_from_yaw(insole_real_t yaw_rad)
{
    return insole_quat_from_rotvec(insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), yaw_rad));
}

INSOLE_COLD insole_quat_t insole_quat_level(insole_quat_t q, insole_vec3_t f_b)
{
    insole_vec3_t f = insole_quat_rotate(q, f_b);
    insole_quat_t tilt = insole_quat(insole_vec3_norm(f) + f.z, f.y, -f.x, INSOLE_R(0.0));
    return insole_quat_chain(insole_quat_normalize(tilt), q);
}

insole_real_t insole_quat_turn(insole_quat_t from, insole_quat_t to)
{
    insole_quat_t turn = insole_quat_mul(to, insole_quat_conjugate(from));
    return insole_wrap_pi(INSOLE_R(2.0) * insole_atan2(turn.z, turn.w));
}

insole_real_t insole_quat_yaw(insole_quat_t q)
{
    insole_mat3_t C = insole_quat_to_mat3(q);
    return insole_atan2(C.r1.x, C.r0.x);
}

insole_vec3_t insole_quat_rotate(insole_quat_t q, insole_vec3_t v)
{
    return insole_mat3_mul_vec(insole_quat_to_mat3(q), v);
}

insole_vec3_t insole_quat_rotate_back(insole_quat_t q, insole_vec3_t v)
{
    return insole_mat3_mul_vec_t(insole_quat_to_mat3(q), v);
}
