/* SPDX-License-Identifier: MIT */
#include "insole/sense/still_window.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

static bool is_positive(insole_real_t x)
{
    return x > ZERO && insole_is_finite(x);
}

/* Of the length of the mean, or of its square. */
static insole_real_t mean_weight(const insole_still_window_t *w)
{
    switch (w->kind) {
    case INSOLE_STILL_SHOE:
        return w->accel_weight * w->gravity_mps2;
    case INSOLE_STILL_MV:
        return -w->accel_weight * insole_square(w->per_n);
    default:
        return ZERO;
    }
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
    window->two_per_n = INSOLE_R(2.0) * window->per_n;
    window->accel_weight = ONE / insole_square(scale->sigma_accel_mps2);
    window->gyro_weight = ONE / insole_square(scale->sigma_gyro_radps);
    window->mean_weight = mean_weight(window);
    return INSOLE_OK;
}

/* What a sample alone adds to a statistic other than SHOE. */
INSOLE_APART static insole_real_t other_part(const insole_still_window_t *w,
                                             const insole_vec3_t *accel, const insole_vec3_t *gyro)
{
    switch (w->kind) {
    case INSOLE_STILL_MV:
        return w->accel_weight * insole_vec3_norm2(*accel);
    case INSOLE_STILL_MAG:
        return w->accel_weight * insole_square(insole_vec3_norm(*accel) - w->gravity_mps2);
    default:
        return w->gyro_weight * insole_vec3_norm2(*gyro);
    }
}

static insole_real_t part_of(const insole_still_window_t *w, const insole_vec3_t *accel,
                             const insole_vec3_t *gyro)
{
    if (w->kind != INSOLE_STILL_SHOE) {
        return other_part(w, accel, gyro);
    }
    return w->accel_weight * insole_vec3_norm2(*accel) + w->gyro_weight * insole_vec3_norm2(*gyro);
}

/* What their mean specific force adds. */
static insole_real_t part_of_mean(const insole_still_window_t *w, insole_vec3_t sum)
{
    if (w->kind == INSOLE_STILL_SHOE) {
        return w->mean_weight * (w->gravity_mps2 - w->two_per_n * insole_vec3_norm(sum));
    }
    return w->kind == INSOLE_STILL_MV ? w->mean_weight * insole_vec3_norm2(sum) : ZERO;
}

/* Of all slots, so that rounding cannot gather. */
INSOLE_APART static void sum_anew(insole_still_window_t *w)
{
    insole_still_sums_t sums = w->samples[0];
    for (uint32_t i = 1u; i < w->width; i++) {
        sums.accel = insole_vec3_add(sums.accel, w->samples[i].accel);
        sums.part += w->samples[i].part;
    }
    w->sums = sums;
}

/* The window takes a sample and lets the oldest go: nothing as long as it is not full. */
static void move_on(insole_still_window_t *w, const insole_vec3_t *accel, insole_real_t part)
{
    insole_still_sums_t *slot = &w->samples[w->at], *sums = &w->sums;
    insole_vec3_t with_both = insole_vec3_add(sums->accel, *accel);
    sums->accel = insole_vec3_sub(with_both, slot->accel);
    sums->part = sums->part + part - slot->part;
    slot->accel = *accel;
    slot->part = part;
    if (++w->at == w->width) {
        w->at = 0u;
        w->full = true;
        sum_anew(w);
    }
}

insole_real_t insole_still_window_take(insole_still_window_t *window,
                                       const insole_vec3_t *accel_mps2,
                                       const insole_vec3_t *gyro_radps)
{
    insole_still_window_t *w = window;
    move_on(w, accel_mps2, part_of(w, accel_mps2, gyro_radps));
    return w->sums.part * w->per_n + part_of_mean(w, w->sums.accel);
}

insole_status_t insole_still_window_push(insole_still_window_t *window, insole_vec3_t accel_mps2,
                                         insole_vec3_t gyro_radps, insole_real_t *statistic)
{
    if (!window || !statistic) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_vec3_is_finite(accel_mps2) || !insole_vec3_is_finite(gyro_radps)) {
        return INSOLE_ERR_VALUE;
    }
    insole_real_t present = insole_still_window_take(window, &accel_mps2, &gyro_radps);
    if (!window->full) {
        return INSOLE_ERR_STATE;
    }
    *statistic = present;
    return INSOLE_OK;
}
