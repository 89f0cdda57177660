/* SPDX-License-Identifier: MIT */
#include "insole/base/quat.h"

#include "insole/base/fastmath.h"

insole_quat_t insole_quat_normalize(insole_quat_t q)
{
    return insole_quat_unit(q);
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

INSOLE_COLD insole_quat_t insole_quat_from_gravity(insole_vec3_t f_b)
{
    insole_real_t horizontal = insole_sqrt(f_b.y * f_b.y + f_b.z * f_b.z);
    insole_real_t roll = insole_atan2(f_b.y, f_b.z);
    insole_real_t pitch = insole_atan2(-f_b.x, horizontal);
    insole_quat_t q_roll = insole_quat_from_rotvec(insole_vec3(roll, INSOLE_R(0.0), INSOLE_R(0.0)));
    insole_quat_t q_pitch =
        insole_quat_from_rotvec(insole_vec3(INSOLE_R(0.0), pitch, INSOLE_R(0.0)));
    return insole_quat_normalize(insole_quat_mul(q_pitch, q_roll));
}

INSOLE_COLD insole_quat_t insole_quat_from_yaw(insole_real_t yaw_rad)
{
    return insole_quat_from_rotvec(insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), yaw_rad));
}

INSOLE_COLD insole_quat_t insole_quat_level(insole_quat_t q, insole_vec3_t f_b)
{
    insole_vec3_t f = insole_quat_rotate(q, f_b);
    insole_quat_t tilt = insole_quat(insole_vec3_norm(f) + f.z, f.y, -f.x, INSOLE_R(0.0));
    return insole_quat_normalize(insole_quat_mul(insole_quat_normalize(tilt), q));
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
