/* SPDX-License-Identifier: MIT */
#include "insole/place/spot_mixture.h"

#define ZERO INSOLE_R(0.0)

insole_spot_mixture_t insole_spot_mixture_empty(void)
{
    insole_spot_mixture_t mixture = {0,    0,    {ZERO, ZERO}, ZERO, ZERO, {ZERO, ZERO},
                                     ZERO, ZERO, ZERO};
    return mixture;
}

/* The new weight becomes 1, all before shrink to their share of it. */
static void crown(insole_spot_mixture_t *mixture, uint32_t number, insole_spot_t spot,
                  insole_real_t log_weight)
{
    insole_real_t shrink = mixture->count > 0u ? insole_exp(mixture->log_top - log_weight) : ZERO;
    mixture->weight *= shrink;
    mixture->xx *= shrink;
    mixture->xy *= shrink;
    mixture->yy *= shrink;
    mixture->log_top = log_weight;
    mixture->likeliest = number;
    mixture->top = spot;
}

void insole_spot_mixture_add(insole_spot_mixture_t *mixture, uint32_t number, insole_spot_t spot,
                             insole_real_t log_weight)
{
    if (!insole_spot_is_finite(spot) || !insole_is_finite(log_weight)) {
        return;
    }
    if (mixture->count == 0u || log_weight > mixture->log_top) {
        crown(mixture, number, spot, log_weight);
    }
    insole_real_t w = insole_exp(log_weight - mixture->log_top);
    insole_real_t before = mixture->weight;
    mixture->count++;
    mixture->weight += w;
    insole_real_t share = w / mixture->weight;
    insole_real_t x_m = spot.x_m - mixture->mean.x_m, y_m = spot.y_m - mixture->mean.y_m;
    mixture->mean.x_m += share * x_m; /* [PhoneEKF (26), (36)] [PhoneUKF (43)] */
    mixture->mean.y_m += share * y_m;
    insole_real_t rest = before * share;
    mixture->xx += rest * x_m * x_m;
    mixture->xy += rest * x_m * y_m;
    mixture->yy += rest * y_m * y_m;
}

INSOLE_COLD void insole_spot_mixture_cov(const insole_spot_mixture_t *mixture, insole_spot_t at,
                                         insole_real_t sigma_m, insole_real_t widen,
                                         insole_radio_fix_t *fix)
{
    insole_real_t x_m = at.x_m - mixture->mean.x_m, y_m = at.y_m - mixture->mean.y_m;
    insole_real_t scale = widen / mixture->weight, point_m2 = sigma_m * sigma_m;
    fix->spot = at;
    fix->var_x_m2 = point_m2 + scale * mixture->xx + widen * x_m * x_m; /* [PhoneEKF (27), (37)] */
    fix->cov_xy_m2 = scale * mixture->xy + widen * x_m * y_m;           /* [PhoneUKF (44)] */
    fix->var_y_m2 = point_m2 + scale * mixture->yy + widen * y_m * y_m;
    fix->likeliest = mixture->likeliest;
    fix->log_weight = mixture->log_top;
    fix->points = mixture->count;
}
