/* SPDX-License-Identifier: MIT */
#include "insole/move/walk_axis.h"

#include "insole/base/unscented.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)
#define HALF INSOLE_R(0.5)
#define TWO  INSOLE_R(2.0)

enum { N = 3, POINTS = 2 * N + 1 };

static const insole_real_t FARTHEST_RAD = INSOLE_R(1.5); /* tilt: the level plane stays in sight */

static insole_sym2_t level_part(insole_sym3_t S)
{
    return insole_sym2(S.xx, S.xy, S.yy);
}

/* Direction of the largest energy, counted from x; where the energy is least lies a quarter turn
 * away. [PhoneUKF (25), (29)] counts from y and leaves the quadrant open. */
static insole_real_t angle_of(insole_sym2_t A)
{
    return HALF * insole_atan2(TWO * A.xy, A.xx - A.yy);
}

insole_walk_energies_t insole_walk_energies(insole_sym3_t S)
{
    insole_real_t most = insole_sym2_largest(level_part(S));
    insole_walk_energies_t e = {most, insole_max(S.xx + S.yy - most, ZERO)};
    return e;
}

insole_walk_axis_t insole_walk_axis_of(insole_sym3_t S)
{
    insole_walk_axis_t axis = {.is_axis = true, .S = S, .rad = angle_of(level_part(S))};
    return axis;
}

insole_walk_axis_t insole_walk_axis_along(insole_vec3_t way)
{
    insole_walk_axis_t axis = {.way = way, .rad = insole_atan2(way.y, way.x)};
    return axis;
}

/* How far the angle moves when the attitude is tilted: f(q). */
static insole_real_t angle_when_tilted(const insole_walk_axis_t *axis, insole_turn_t ahead,
                                       insole_real_t x_rad, insole_real_t y_rad)
{
    insole_vec3_t tilt = insole_vec3(x_rad, y_rad, ZERO);
    insole_real_t far = insole_vec3_norm(tilt);
    tilt = far > FARTHEST_RAD ? insole_vec3_scale(tilt, FARTHEST_RAD / far) : tilt;
    insole_mat3_t E = insole_quat_to_mat3(insole_quat_from_rotvec(tilt));
    /* rows of C Q, [PhoneUKF (23)-(24)] */
    insole_vec3_t along =
        insole_vec3_add_scaled(insole_vec3_scale(E.r0, ahead.cos), ahead.sin, E.r1);
    insole_vec3_t across =
        insole_vec3_add_scaled(insole_vec3_scale(E.r1, ahead.cos), -ahead.sin, E.r0);
    if (!axis->is_axis) {
        return insole_atan2(insole_vec3_dot(across, axis->way), insole_vec3_dot(along, axis->way));
    }
    insole_vec3_t S_along = insole_sym3_mul_vec(axis->S, along);
    insole_vec3_t S_across = insole_sym3_mul_vec(axis->S, across);
    insole_sym2_t A = insole_sym2(insole_vec3_dot(along, S_along), insole_vec3_dot(across, S_along),
                                  insole_vec3_dot(across, S_across));
    return angle_of(A); /* [PhoneUKF (30)] */
}

/* Mean and variance of the angle over the errors of the attitude. One about the vertical adds to
 * the angle as it is, however large; f is curved in the tilt alone. */
void insole_walk_axis_through(const insole_walk_axis_t *axis, insole_sym3_t P,
                              insole_real_t *off_rad, insole_real_t *variance_rad2)
{
    const insole_real_t A[N * N] = {P.xx, ZERO, ZERO, P.xy, P.yy, ZERO, P.xz, P.yz, P.zz};
    static const insole_real_t middle[N];
    insole_unscented_t ut = insole_unscented(N, ONE, TWO, ZERO);
    insole_real_t root[N * N], points[POINTS * N], values[POINTS];
    insole_turn_t ahead = insole_turn(axis->rad);
    (void)insole_cholesky(N, A, root);
    insole_unscented_points(&ut, middle, root, points);
    const insole_real_t *a = points;
    for (uint32_t i = 0u; i < POINTS; i++, a += N) {
        values[i] = angle_when_tilted(axis, ahead, a[0], a[1]) + a[2];
    }
    insole_unscented_mean(&ut, 1u, values, off_rad);
    insole_unscented_cov(&ut, 1u, values, off_rad, 1u, values, off_rad, variance_rad2);
}
