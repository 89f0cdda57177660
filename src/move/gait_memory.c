/* SPDX-License-Identifier: MIT */
#include "insole/move/gait_memory.h"

#include "insole/base/sym2.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

static const insole_real_t STEEPEST = INSOLE_R(0.3);      /* sine of a tilt that can be one */
static const insole_real_t LEAST_MPS2 = INSOLE_R(1.0);    /* a weaker force has no direction */
static const insole_real_t LITTLE = INSOLE_R(0.1);        /* m^2/s^4: weaker steps count less */
static const insole_real_t FIRST_WANDER = INSOLE_R(0.1);  /* before there are two axes */
static const insole_real_t LEAST_ORDER = INSOLE_R(0.002); /* of 1, of directions at random */

static insole_sym3_t turned_sym3(insole_sym3_t S, insole_turn_t turn)
{
    insole_spot_t row_x = insole_spot(turn.cos, -turn.sin), row_y = insole_spot(turn.sin, turn.cos);
    insole_sym2_t level = insole_sym2_map(row_x, row_y, insole_sym2(S.xx, S.xy, S.yy));
    insole_spot_t with_z = insole_turn_way(turn, insole_spot(S.xz, S.yz));
    insole_sym3_t turned = {level.xx, level.xy, with_z.x_m, level.yy, with_z.y_m, S.zz};
    return turned;
}

void insole_gait_memory_fade(insole_gait_memory_t *memory, insole_real_t facing_rad,
                             insole_real_t axis_share, insole_real_t pull_share)
{
    insole_real_t by_rad = insole_wrap_pi(facing_rad - memory->facing_rad);
    insole_turn_t turn = insole_turn(by_rad);
    insole_spot_t level =
        insole_turn_way(turn, insole_spot(memory->force_mps2.x, memory->force_mps2.y));
    insole_vec3_t force = insole_vec3(level.x_m, level.y_m, memory->force_mps2.z);
    memory->facing_rad = facing_rad;
    memory->force_mps2 = insole_vec3_scale(force, axis_share);
    memory->scatter =
        insole_sym3_add_scaled(insole_sym3_zero(), axis_share, turned_sym3(memory->scatter, turn));
    memory->steps *= axis_share;
    memory->pull = insole_spot_scale(pull_share, insole_turn_way(turn, memory->pull));
    memory->axis_rad[0] = insole_wrap_pi(memory->axis_rad[0] + by_rad);
    memory->axis_rad[1] = insole_wrap_pi(memory->axis_rad[1] + by_rad);
}

static void turn_wave(insole_gait_wave_t *wave, insole_mat3_t E)
{
    wave->c = insole_mat3_mul_vec(E, wave->c);
    wave->s = insole_mat3_mul_vec(E, wave->s);
}

void insole_gait_memory_level(insole_gait_memory_t *memory, insole_gait_moments_t *moments)
{
    memory->force_mps2 = insole_vec3_add(memory->force_mps2, moments->force_mps2);
    insole_vec3_t up = memory->force_mps2;
    insole_real_t force = insole_vec3_norm(up), across = insole_vec3_level(up);
    if (!(force > LEAST_MPS2 && up.z > ZERO && across < STEEPEST * force)) {
        return;
    }
    /* up x z; its length is the sine, here the angle but for 2 % */
    insole_vec3_t tilt_rad = insole_vec3(up.y / force, -up.x / force, ZERO);
    insole_mat3_t E = insole_quat_to_mat3(insole_quat_from_rotvec(tilt_rad));
    moments->scatter = insole_mat3_mul_t_sym(insole_mat3_mul_sym(E, moments->scatter), E);
    moments->falling_mps2 = insole_mat3_mul_vec(E, moments->falling_mps2);
    turn_wave(&moments->step, E);
    turn_wave(&moments->stride, E);
}

void insole_gait_memory_add(insole_gait_memory_t *memory, insole_sym3_t scatter)
{
    insole_real_t per = ONE / (scatter.xx + scatter.yy + LITTLE);
    memory->scatter = insole_sym3_add_scaled(memory->scatter, per, scatter);
    memory->steps += ONE;
}

/* With the step before the last: a sway turns the axis to and fro from foot to foot, and is no
 * error of the mean. */
void insole_gait_memory_note(insole_gait_memory_t *memory, insole_real_t axis_rad,
                             insole_real_t share)
{
    insole_real_t apart = insole_square(insole_sin(axis_rad - memory->axis_rad[1]));
    insole_real_t kept = share * (memory->wander - apart);
    memory->wander = memory->axes == 2u ? apart + kept : FIRST_WANDER;
    memory->axes += memory->axes < 2u ? 1u : 0u;
    memory->axis_rad[1] = memory->axis_rad[0];
    memory->axis_rad[0] = axis_rad;
}

/* Were the differences normal, the mean of their sine squared would be (1 - exp(-2 variance)) / 2.
 */
insole_real_t insole_gait_memory_wander(const insole_gait_memory_t *memory)
{
    insole_real_t order = insole_max(ONE - INSOLE_R(2.0) * memory->wander, LEAST_ORDER);
    return -INSOLE_R(0.5) * insole_log(order);
}
