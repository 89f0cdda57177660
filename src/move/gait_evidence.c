/* SPDX-License-Identifier: MIT */
#include "insole/move/gait_evidence.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

static insole_real_t level_energy(const insole_gait_wave_t *wave)
{
    return wave->c.x * wave->c.x + wave->c.y * wave->c.y + wave->s.x * wave->s.x +
           wave->s.y * wave->s.y;
}

static insole_real_t upright_energy(const insole_gait_wave_t *wave)
{
    return wave->c.z * wave->c.z + wave->s.z * wave->s.z;
}

/* A wave times its own vertical part, that one ahead by a phase. */
static insole_vec3_t product(const insole_gait_wave_t *wave, insole_real_t lead_rad)
{
    insole_turn_t lead = insole_turn(lead_rad);
    insole_real_t with_c = lead.cos * wave->c.z + lead.sin * wave->s.z;
    insole_real_t with_s = lead.cos * wave->s.z - lead.sin * wave->c.z;
    return insole_vec3_add_scaled(insole_vec3_scale(wave->c, with_c), with_s, wave->s);
}

/* Share of an energy that a tilt of this variance can not feign from another one. */
static insole_real_t trust(insole_real_t energy, insole_real_t tilt_rad2, insole_real_t other)
{
    insole_real_t feigned = tilt_rad2 * other;
    return energy > ZERO ? energy / (energy + feigned) : ZERO;
}

insole_vec3_t insole_gait_ahead(const insole_gait_moments_t *m, insole_real_t lead_rad,
                                insole_real_t tilt_rad2)
{
    insole_real_t level = level_energy(&m->step), up = upright_energy(&m->step);
    insole_real_t level2 = level_energy(&m->stride), up2 = upright_energy(&m->stride);
    insole_real_t size = insole_sqrt(level * up) + insole_sqrt(level2 * up2);
    insole_real_t per = size > ZERO ? ONE / size : ZERO;
    /* A bounce seen at a slant is no motion ahead, and what swings seen at a slant does not rise.
     */
    insole_real_t of_step = per * trust(level, tilt_rad2, up);
    insole_real_t of_stride = per * trust(up2, tilt_rad2, level2);
    insole_vec3_t ahead = insole_vec3_scale(product(&m->step, lead_rad), of_step);
    return insole_vec3_add_scaled(ahead, of_stride, product(&m->stride, ZERO));
}

insole_sym3_t insole_gait_ahead_scatter(const insole_gait_moments_t *m, insole_real_t sway_weight)
{
    insole_real_t own = INSOLE_R(0.5) * (ONE - sway_weight);
    insole_sym3_t S = insole_sym3_add_scaled(insole_sym3_zero(), sway_weight, m->scatter);
    S = insole_sym3_add_outer(S, own, m->step.c);
    return insole_sym3_add_outer(S, own, m->step.s);
}
