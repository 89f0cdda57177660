/* SPDX-License-Identifier: MIT */
#include "insole/base/quat.h"

#include "insole/base/fastmath.h"

insole_quat_t insole_quat_normalize(insole_quat_t q)
{
    insole_real_t n = insole_sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(n > INSOLE_R(0.0)) || !insole_is_finite(n)) {
        return insole_quat_identity();
    }
    insole_real_t s = INSOLE_R(1.0) / n;
    return insole_quat(q.w * s, q.x * s, q.y * s, q.z * s);
}

insole_quat_t insole_quat_from_rotvec(insole_vec3_t rotation_rad)
{
    insole_real_t half2 = INSOLE_R(0.25) * insole_vec3_norm2(rotation_rad);
    insole_real_t c, s; /* cos(half), sin(half) / (2 half) */
    if (half2 < INSOLE_R(0.01)) {
        c = INSOLE_R(1.0) -
            half2 * (INSOLE_R(0.5) - half2 * (INSOLE_R(0.04166666667) - half2 * INSOLE_R(0.001388888889)));
        s = INSOLE_R(0.5) - half2 * (INSOLE_R(0.08333333333) -
                                     half2 * (INSOLE_R(0.004166666667) - half2 * INSOLE_R(9.920634921e-5)));
    } else {
        insole_real_t half = insole_sqrt(half2);
        c = insole_cos(half);
        s = INSOLE_R(0.5) * insole_sin(half) / half;
    }
    return insole_quat(c, s * rotation_rad.x, s * rotation_rad.y, s * rotation_rad.z);
}

insole_quat_t insole_quat_from_gravity(insole_vec3_t f_b)
{
    insole_real_t horizontal = insole_sqrt(f_b.y * f_b.y + f_b.z * f_b.z);
    insole_real_t roll = insole_atan2(f_b.y, f_b.z);
    insole_real_t pitch = insole_atan2(-f_b.x, horizontal);
    insole_quat_t q_roll = insole_quat_from_rotvec(insole_vec3(roll, INSOLE_R(0.0), INSOLE_R(0.0)));
    insole_quat_t q_pitch = insole_quat_from_rotvec(insole_vec3(INSOLE_R(0.0), pitch, INSOLE_R(0.0)));
    return insole_quat_normalize(insole_quat_mul(q_pitch, q_roll));
}

insole_quat_t insole_quat_from_yaw(insole_real_t yaw_rad)
{
    return insole_quat_from_rotvec(insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), yaw_rad));
}

insole_real_t insole_quat_yaw(insole_quat_t q)
{
    insole_vec3_t x_n = insole_quat_rotate(q, insole_vec3(INSOLE_R(1.0), INSOLE_R(0.0), INSOLE_R(0.0)));
    return insole_atan2(x_n.y, x_n.x);
}
