/* SPDX-License-Identifier: MIT */
#include "insole/sense/still_window.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

static bool is_positive(insole_real_t x)
{
    return x > ZERO && insole_is_finite(x);
}

insole_status_t insole_still_window_init(insole_still_window_t *window,
                                         const insole_still_scale_t *scale, uint32_t width)
{
    if (!window || !scale) {
        return INSOLE_ERR_NULL;
    }
    if (width < 1u || width > INSOLE_STILL_WINDOW || !is_positive(scale->gravity_mps2) ||
        !is_positive(scale->sigma_accel_mps2) || !is_positive(scale->sigma_gyro_radps)) {
        return INSOLE_ERR_VALUE;
    }
    memset(window, 0, sizeof *window);
    window->scale = *scale;
    window->width = width;
    return INSOLE_OK;
}

static insole_still_sums_t of_sample(insole_vec3_t accel, insole_vec3_t gyro)
{
    insole_real_t accel2 = insole_vec3_norm2(accel);
    insole_still_sums_t one = {accel, accel2, insole_sqrt(accel2), insole_vec3_norm2(gyro)};
    return one;
}

static void add(insole_still_sums_t *sums, insole_real_t sign, const insole_still_sums_t *one)
{
    sums->accel = insole_vec3_add_scaled(sums->accel, sign, one->accel);
    sums->accel2 += sign * one->accel2;
    sums->accel_norm += sign * one->accel_norm;
    sums->gyro2 += sign * one->gyro2;
}

static insole_real_t statistic_of(const insole_still_scale_t *c, const insole_still_sums_t *sums,
                                  insole_real_t per_n)
{
    insole_real_t g = c->gravity_mps2;
    insole_real_t accel2 = sums->accel2 * per_n;
    insole_real_t gyro = sums->gyro2 * per_n / insole_square(c->sigma_gyro_radps);
    insole_real_t per_var = ONE / insole_square(c->sigma_accel_mps2);
    insole_real_t mean2 = insole_vec3_norm2(sums->accel) * insole_square(per_n);
    switch (c->kind) {
    case INSOLE_STILL_MV:
        return (accel2 - mean2) * per_var;
    case INSOLE_STILL_MAG:
        return (accel2 - INSOLE_R(2.0) * g * sums->accel_norm * per_n + g * g) * per_var;
    case INSOLE_STILL_ARE:
        return gyro;
    default:
        return (accel2 - INSOLE_R(2.0) * g * insole_sqrt(mean2) + g * g) * per_var + gyro;
    }
}

/* The window moves on by one sample; `leaving` was its oldest. */
static void move_on(insole_still_window_t *w, const insole_still_sums_t *arriving,
                    const insole_still_sums_t *leaving)
{
    add(&w->fresh, ONE, arriving);
    if (++w->fresh_count == w->width) {
        static const insole_still_sums_t none;
        w->sums = w->fresh;
        w->fresh = none;
        w->fresh_count = 0u;
    } else {
        add(&w->sums, ONE, arriving);
        add(&w->sums, -ONE, leaving);
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
    insole_still_sums_t arriving = of_sample(accel_mps2, gyro_radps), leaving = w->samples[w->at];
    w->samples[w->at] = arriving;
    w->at = (w->at + 1u) % w->width;
    if (w->count == w->width) {
        move_on(w, &arriving, &leaving);
    } else {
        add(&w->sums, ONE, &arriving);
        w->count++;
    }
    if (w->count < w->width) {
        return INSOLE_ERR_STATE;
    }
    *statistic = statistic_of(&w->scale, &w->sums, ONE / (insole_real_t)w->width);
    return INSOLE_OK;
}
