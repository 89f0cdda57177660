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

/* What a sample alone adds to the statistic. */
static insole_real_t part_of(const insole_still_window_t *w, insole_vec3_t accel,
                             insole_vec3_t gyro)
{
    switch (w->kind) {
    case INSOLE_STILL_MV:
        return w->accel_weight * insole_vec3_norm2(accel);
    case INSOLE_STILL_MAG:
        return w->accel_weight * insole_square(insole_vec3_norm(accel) - w->gravity_mps2);
    case INSOLE_STILL_ARE:
        return w->gyro_weight * insole_vec3_norm2(gyro);
    default:
        return w->accel_weight * insole_vec3_norm2(accel) +
               w->gyro_weight * insole_vec3_norm2(gyro);
    }
}

/* What their mean specific force adds. */
static insole_real_t part_of_mean(const insole_still_window_t *w)
{
    insole_real_t g = w->gravity_mps2;
    switch (w->kind) {
    case INSOLE_STILL_MV:
        return -w->accel_weight * insole_square(w->per_n) * insole_vec3_norm2(w->sums.accel);
    case INSOLE_STILL_MAG:
    case INSOLE_STILL_ARE:
        return ZERO;
    default:
        return w->accel_weight * g *
               (g - INSOLE_R(2.0) * w->per_n * insole_vec3_norm(w->sums.accel));
    }
}

static void add(insole_still_sums_t *sums, const insole_still_sums_t *one)
{
    sums->accel = insole_vec3_add(sums->accel, one->accel);
    sums->part += one->part;
}

static void subtract(insole_still_sums_t *sums, const insole_still_sums_t *one)
{
    sums->accel = insole_vec3_sub(sums->accel, one->accel);
    sums->part -= one->part;
}

/* The window moves on by one sample; `leaving` was its oldest. */
static void move_on(insole_still_window_t *w, const insole_still_sums_t *arriving,
                    const insole_still_sums_t *leaving)
{
    add(&w->fresh, arriving);
    if (++w->fresh_count == w->width) {
        static const insole_still_sums_t none;
        w->sums = w->fresh;
        w->fresh = none;
        w->fresh_count = 0u;
    } else {
        add(&w->sums, arriving);
        subtract(&w->sums, leaving);
    }
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
    insole_still_window_t *w = window;
    insole_still_sums_t arriving = {accel_mps2, part_of(w, accel_mps2, gyro_radps)};
    insole_still_sums_t *slot = &w->samples[w->at];
    if (w->count == w->width) {
        move_on(w, &arriving, slot);
    } else {
        add(&w->sums, &arriving);
        w->count++;
    }
    *slot = arriving;
    w->at = w->at + 1u < w->width ? w->at + 1u : 0u;
    if (w->count < w->width) {
        return INSOLE_ERR_STATE;
    }
    *statistic = w->sums.part * w->per_n + part_of_mean(w);
    return INSOLE_OK;
}
