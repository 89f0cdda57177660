/* SPDX-License-Identifier: MIT */
#include "insole/sense/still_window.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

static bool is_positive(insole_real_t x)
{
    return x > ZERO && insole_is_finite(x);
}

INSOLE_COLD insole_status_t insole_still_window_init(insole_still_window_t *window,
                                                     const insole_still_scale_t *scale,
                                                     uint32_t width)
{
    if (!window || !scale) {
        return INSOLE_ERR_NULL;
    }
    if (width < 1u || width > INSOLE_STILL_WINDOW || !is_positive(scale->gravity_mps2) ||
        !is_positive(scale->sigma_accel_mps2) || !is_positive(scale->sigma_gyro_radps)) {
        return INSOLE_ERR_VALUE;
    }
    memset(window, 0, sizeof *window);
    window->kind = scale->kind;
    window->width = width;
    window->gravity_mps2 = scale->gravity_mps2;
    window->per_n = ONE / (insole_real_t)width;
    window->accel_weight = ONE / insole_square(scale->sigma_accel_mps2);
    window->gyro_weight = ONE / insole_square(scale->sigma_gyro_radps);
    return INSOLE_OK;
}

/* What a sample alone adds to a statistic other than SHOE. */
static insole_real_t other_part(const insole_still_window_t *w, insole_vec3_t accel,
                                insole_vec3_t gyro)
{
    switch (w->kind) {
    case INSOLE_STILL_MV:
        return w->accel_weight * insole_vec3_norm2(accel);
    case INSOLE_STILL_MAG:
        return w->accel_weight * insole_square(insole_vec3_norm(accel) - w->gravity_mps2);
    default:
        return w->gyro_weight * insole_vec3_norm2(gyro);
    }
}

static insole_real_t part_of(const insole_still_window_t *w, insole_vec3_t accel,
                             insole_vec3_t gyro)
{
    if (w->kind != INSOLE_STILL_SHOE) {
        return other_part(w, accel, gyro);
    }
    return w->accel_weight * insole_vec3_norm2(accel) + w->gyro_weight * insole_vec3_norm2(gyro);
}

/* What their mean specific force adds. */
static insole_real_t part_of_mean(const insole_still_window_t *w, insole_vec3_t sum)
{
    insole_real_t g = w->gravity_mps2;
    if (w->kind == INSOLE_STILL_SHOE) {
        return w->accel_weight * g * (g - INSOLE_R(2.0) * w->per_n * insole_vec3_norm(sum));
    }
    return w->kind == INSOLE_STILL_MV
               ? -w->accel_weight * insole_square(w->per_n) * insole_vec3_norm2(sum)
               : ZERO;
}

static insole_still_sums_t plus(insole_still_sums_t a, insole_still_sums_t b)
{
    insole_still_sums_t sums = {insole_vec3_add(a.accel, b.accel), a.part + b.part};
    return sums;
}

static insole_still_sums_t minus(insole_still_sums_t a, insole_still_sums_t b)
{
    insole_still_sums_t sums = {insole_vec3_sub(a.accel, b.accel), a.part - b.part};
    return sums;
}

/* Of all slots, so that rounding cannot gather. */
INSOLE_APART static insole_still_sums_t sum_anew(const insole_still_window_t *w)
{
    insole_still_sums_t sums = w->samples[0];
    for (uint32_t i = 1u; i < w->width; i++) {
        sums = plus(sums, w->samples[i]);
    }
    return sums;
}

/* The window takes a sample and lets the oldest go: nothing as long as it is not full. */
static insole_still_sums_t move_on(insole_still_window_t *w, insole_still_sums_t arriving)
{
    insole_still_sums_t *slot = &w->samples[w->at], leaving = *slot;
    *slot = arriving;
    if (++w->at == w->width) {
        w->at = 0u;
        w->full = true;
        return sum_anew(w);
    }
    return minus(plus(w->sums, arriving), leaving);
}

/* A part of the statistic that is finite tells so of what it is made of; SHOE's is made of all. */
static bool is_finite(const insole_still_window_t *w, insole_vec3_t accel, insole_vec3_t gyro,
                      insole_real_t part)
{
    return (w->kind == INSOLE_STILL_SHOE && insole_is_finite(part)) ||
           (insole_vec3_is_finite(accel) && insole_vec3_is_finite(gyro));
}

insole_status_t insole_still_window_push(insole_still_window_t *window, insole_vec3_t accel_mps2,
                                         insole_vec3_t gyro_radps, insole_real_t *statistic)
{
    if (!window || !statistic) {
        return INSOLE_ERR_NULL;
    }
    insole_still_window_t *w = window;
    insole_still_sums_t arriving = {accel_mps2, part_of(w, accel_mps2, gyro_radps)};
    if (!is_finite(w, accel_mps2, gyro_radps, arriving.part)) {
        return INSOLE_ERR_VALUE;
    }
    insole_still_sums_t sums = w->sums = move_on(w, arriving);
    if (!w->full) {
        return INSOLE_ERR_STATE;
    }
    *statistic = sums.part * w->per_n + part_of_mean(w, sums.accel);
    return INSOLE_OK;
}
