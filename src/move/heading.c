/* SPDX-License-Identifier: MIT */
#include "insole/move/heading.h"

#define ZERO INSOLE_R(0.0)

/* Level part under which the top axis is steep; that of z is then above 0.93, however the phone is
 * rolled: of two axes at right angles only one can be steep. */
static const insole_real_t STEEP = INSOLE_R(0.35);

/* Columns of the rotation matrix: the axes of b in n. */
static insole_vec3_t axis_ahead(insole_mat3_t C)
{
    insole_vec3_t top = insole_vec3(C.r0.y, C.r1.y, C.r2.y);
    insole_vec3_t screen = insole_vec3(C.r0.z, C.r1.z, C.r2.z);
    if (insole_vec3_level(top) >= STEEP) {
        return top;
    }
    return top.z > ZERO ? insole_vec3_neg(screen) : screen;
}

insole_heading_t insole_heading(insole_quat_t q, const insole_sym3_t *cov)
{
    insole_vec3_t v = axis_ahead(insole_quat_to_mat3(q));
    insole_real_t level = insole_vec3_level(v);
    insole_heading_t heading;
    /* [PhoneEKF (30)] counts from +y: its cosine is our sine, its sine our cosine with a minus */
    heading.ahead.cos = v.x / level;
    heading.ahead.sin = v.y / level;
    heading.heading_rad = insole_atan2(v.y, v.x); /* [PhoneEKF (6)] */
    /* A rotation a moves v by a x v. */
    insole_real_t slope = -v.z / level;
    heading.jacobian =
        insole_vec3(slope * heading.ahead.cos, slope * heading.ahead.sin, INSOLE_R(1.0));
    heading.variance_rad2 = ZERO;
    if (cov) {
        insole_vec3_t Pj = insole_sym3_mul_vec(*cov, heading.jacobian);
        heading.variance_rad2 = insole_vec3_dot(heading.jacobian, Pj);
    }
    return heading;
}
