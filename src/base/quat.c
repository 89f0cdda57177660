/* SPDX-License-Identifier: MIT */
#include "insole/base/quat.h"

#include "insole/base/fastmath.h"

/* Half a turn of 800 rad becomes small. */
enum { MOST_DOUBLINGS = 13 };

insole_quat_t insole_quat_normalize(insole_quat_t q)
{
    return insole_quat_unit(q);
}

insole_quat_t insole_quat_chain(insole_quat_t a, insole_quat_t b)
{
    return insole_quat_normalize(insole_quat_mul(a, b));
}

insole_quat_t insole_quat_from_rotvec(insole_vec3_t rotation_rad)
{
    insole_vec3_t v = insole_vec3_scale(rotation_rad, INSOLE_R(0.5));
    insole_real_t half2 = insole_vec3_norm2(v);
    if (half2 < INSOLE_QUAT_SMALL_RAD2) {
        return insole_quat_from_small(v, half2);
    }
    insole_real_t half = insole_sqrt(half2);
    insole_turn_t turn = insole_turn(half);
    insole_real_t s = turn.sin / half;
    return insole_quat(turn.cos, s * v.x, s * v.y, s * v.z);
}

INSOLE_COLD insole_quat_t insole_quat_from_half(insole_vec3_t half_rad)
{
    insole_real_t half2 = insole_vec3_norm2(half_rad);
    uint32_t doublings = 0u;
    while (half2 >= INSOLE_QUAT_SMALL_RAD2 && doublings < MOST_DOUBLINGS) {
        half_rad = insole_vec3_scale(half_rad, INSOLE_R(0.5));
        half2 *= INSOLE_R(0.25);
        doublings++;
    }
    insole_quat_t q = insole_quat_from_small(half_rad, half2);
    while (doublings > 0u) {
        q = insole_quat_mul(q, q);
        doublings--;
    }
    return insole_quat_normalize(q);
}

/* Half an angle by the sum of two vectors: no angle is needed. */
INSOLE_COLD insole_quat_t insole_quat_from_gravity(insole_vec3_t f_b)
{
    const insole_real_t zero = INSOLE_R(0.0);
    insole_real_t y = f_b.y, z = f_b.z, side = insole_sqrt(y * y + z * z);
    insole_quat_t roll = insole_quat(side + z, y, zero, zero);
    if (z < zero) {
        roll = insole_quat(insole_abs(y), y < zero ? z - side : side - z, zero, zero);
    }
    insole_quat_t pitch = insole_quat(insole_vec3_norm(f_b) + side, zero, -f_b.x, zero);
    return insole_quat_mul(insole_quat_normalize(pitch), insole_quat_normalize(roll));
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
