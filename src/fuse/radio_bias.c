/* SPDX-License-Identifier: MIT */
#include "insole/fuse/radio_bias.h"

#include <stddef.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

#define SIGMA_MAX_M INSOLE_R(1e3)
#define TIME_MAX_S  INSOLE_R(1e6)

/* A weight so far off is told from no other, and stays finite when many are summed up. */
#define HALF_NIS_MAX INSOLE_R(1e24)

insole_status_t insole_radio_bias_init(insole_radio_bias_t *radio, insole_real_t sigma_m,
                                       insole_real_t time_s, insole_real_t floor)
{
    if (!radio) {
        return INSOLE_ERR_NULL;
    }
    if (!(sigma_m >= ZERO && sigma_m <= SIGMA_MAX_M && time_s > ZERO && time_s <= TIME_MAX_S &&
          floor >= ZERO && floor <= ONE)) {
        return INSOLE_ERR_VALUE;
    }
    *radio = (insole_radio_bias_t){
        .sigma_m = sigma_m, .time_s = time_s, .floor = floor, .most_m = sigma_m};
    insole_radio_bias_forget(radio);
    return INSOLE_OK;
}

void insole_radio_bias_forget(insole_radio_bias_t *radio)
{
    radio->P = insole_sym2_circle(insole_square(radio->sigma_m));
    radio->has_time = false;
}

insole_status_t insole_radio_bias_limit(insole_radio_bias_t *radio, insole_real_t sigma_m)
{
    if (!radio) {
        return INSOLE_ERR_NULL;
    }
    if (!(sigma_m >= ZERO) || !insole_is_finite(sigma_m)) {
        return INSOLE_ERR_VALUE;
    }
    radio->sigma_m = insole_min(sigma_m, radio->most_m);
    if (!radio->has_time) {
        insole_radio_bias_forget(radio);
    }
    return INSOLE_OK;
}

/* P after so much time, and how much is left of a mean. */
static insole_sym2_t moved_on(insole_radio_bias_t *radio, uint64_t t_us)
{
    insole_real_t share = ONE;
    if (radio->has_time) {
        share = insole_exp(-insole_seconds(radio->t_us, t_us) / radio->time_s);
    }
    insole_real_t left = share * share;
    radio->memory = share;
    return insole_sym2_add(insole_sym2_scale(radio->P, left),
                           insole_sym2_circle((ONE - left) * insole_square(radio->sigma_m)));
}

/* (I - K) P (I - K)' + K R K' */
static insole_sym2_t corrected(const insole_radio_bias_t *radio, insole_sym2_t P, insole_sym2_t R)
{
    insole_spot_t kx = radio->gain_x, ky = radio->gain_y;
    insole_spot_t x_left = {ONE - kx.x_m, -kx.y_m}, y_left = {-ky.x_m, ONE - ky.y_m};
    return insole_sym2_add(insole_sym2_map(x_left, y_left, P), insole_sym2_map(kx, ky, R));
}

INSOLE_COLD insole_status_t insole_radio_bias_hear(insole_radio_bias_t *radio,
                                                   const insole_spot_fix_t *fix, bool learns)
{
    if (!radio || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (insole_spot_fix_check(fix) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    if (radio->has_time && fix->t_us <= radio->t_us) {
        return INSOLE_ERR_TIME;
    }
    insole_radio_bias_t next = *radio;
    insole_sym2_t P = moved_on(&next, fix->t_us), W;
    if (!insole_sym2_inverse(insole_sym2_add(fix->cov_m2, P), &W)) {
        return INSOLE_ERR_VALUE;
    }
    next.gain_x = insole_sym2_mul(W, insole_spot(P.xx, P.xy));
    next.gain_y = insole_sym2_mul(W, insole_spot(P.xy, P.yy));
    next.P = learns ? corrected(&next, P, fix->cov_m2) : P;
    next.W = W;
    next.spot = fix->spot;
    next.t_us = fix->t_us;
    next.has_time = true;
    *radio = next;
    return INSOLE_OK;
}

static insole_spot_t gained(const insole_radio_bias_t *radio, insole_spot_t v)
{
    return insole_spot(insole_spot_dot(radio->gain_x, v), insole_spot_dot(radio->gain_y, v));
}

/* @param[out] share  by which the fix counts as right */
static insole_real_t log_weight(const insole_radio_bias_t *radio, insole_spot_t v,
                                insole_real_t *share)
{
    insole_real_t half_nis = insole_min(HALF * insole_sym2_form(radio->W, v), HALF_NIS_MAX);
    *share = ONE;
    if (radio->floor > ZERO) {
        insole_real_t right = insole_exp(-half_nis), sum = right + radio->floor;
        *share = right / sum;
        return insole_log(sum);
    }
    return -half_nis;
}

insole_real_t insole_radio_bias_weigh(const insole_radio_bias_t *radio, insole_spot_t spot,
                                      insole_spot_t *bias)
{
    insole_real_t share;
    insole_spot_t v = insole_spot_sub(radio->spot, spot);
    if (!bias) {
        return log_weight(radio, v, &share);
    }
    insole_spot_t before = insole_spot(radio->memory * bias->x_m, radio->memory * bias->y_m);
    v = insole_spot_sub(v, before);
    insole_real_t log = log_weight(radio, v, &share);
    *bias = insole_spot_add_scaled(before, share, gained(radio, v));
    return log;
}

insole_spot_t insole_radio_bias_at(const insole_radio_bias_t *radio, insole_spot_t spot)
{
    return gained(radio, insole_spot_sub(radio->spot, spot));
}
