/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_start.h"

#include <stddef.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

/* What the walls and people around make all ranges of some seconds wrong by. */
static const insole_real_t BIAS_M = INSOLE_R(1.0);

/* With a larger one the direction counts as not known. */
static const insole_real_t VAGUE_RAD = INSOLE_R(1.2);

INSOLE_COLD insole_status_t insole_fusion_start_init(insole_fusion_start_t *start, int32_t fixes)
{
    if (!start) {
        return INSOLE_ERR_NULL;
    }
    insole_auto_start_config_t config = insole_auto_start_defaults;
    config.fixes = fixes;
    config.refine_rad = INSOLE_R(3.2);
    config.bias_m = BIAS_M;
    config.sigma_scale = INSOLE_R(0.02);
    config.ahead_m = ZERO;
    insole_status_t status = insole_auto_start_init(&start->fixes, &config, NULL);
    if (status == INSOLE_OK) {
        start->n_m = insole_spot(ZERO, ZERO);
    }
    return status;
}

static insole_spot_fix_t fix_of(const insole_fusion_radio_t *radio)
{
    const insole_anchor_fix_t *heard = &radio->fix;
    insole_spot_fix_t fix = {radio->fix_us,
                             {heard->x_m, heard->y_m},
                             insole_spot_cov(insole_sym2(heard->P.xx, heard->P.xy, heard->P.yy)),
                             {ZERO, ZERO}};
    return fix;
}

INSOLE_COLD bool insole_fusion_start_first(const insole_fusion_radio_t *radio,
                                           insole_particle_start_t *where)
{
    if (!radio || !where || !radio->has_fix) {
        return false;
    }
    insole_spot_fix_t fix = fix_of(radio);
    if (insole_spot_fix_check(&fix) != INSOLE_OK) {
        return false;
    }
    insole_real_t var_m2 = insole_square(BIAS_M) + insole_sym2_largest(fix.cov_m2);
    insole_real_t per_m = ONE / insole_sqrt(var_m2); /* a row of unit variance, and back */
    insole_sym2_t cov_m2 = insole_spot_cov(insole_sym2_circle(ONE / insole_square(per_m)));
    *where = (insole_particle_start_t){fix.spot.x_m, fix.spot.y_m, insole_sqrt(cov_m2.xx), ZERO,
                                       INSOLE_PI};
    return true;
}

/* The way from fix to fix is one pace. */
static void go_on(insole_fusion_start_t *start, insole_spot_t n_m)
{
    insole_spot_t way = insole_spot_sub(n_m, start->n_m);
    insole_pace_t pace = {insole_spot_norm(way), insole_atan2(way.y_m, way.x_m), ZERO, ZERO};
    if (start->fixes.fixes > 0u) {
        (void)insole_auto_start_step(&start->fixes, &pace);
    }
    start->n_m = n_m;
}

INSOLE_COLD bool insole_fusion_start_hear(insole_fusion_start_t *start,
                                          const insole_fusion_radio_t *radio,
                                          insole_particle_start_t *where)
{
    if (!start || !radio || !where || !radio->has_fix) {
        return false;
    }
    bool is_old = start->fixes.fixes > 0u && radio->fix_us <= start->fixes.fix_us;
    if (is_old) {
        return false;
    }
    const insole_spot_fix_t fix = fix_of(radio);
    insole_auto_start_answer_t found;
    go_on(start, radio->fix_n_m);
    if (insole_auto_start_fix(&start->fixes, &fix) != INSOLE_OK ||
        insole_auto_start_answer(&start->fixes, &found) != INSOLE_OK || !found.ready) {
        return false;
    }
    insole_real_t sigma_rad = insole_sqrt(found.var_offset_rad2);
    *where = (insole_particle_start_t){
        found.spot.x_m, found.spot.y_m, insole_sqrt(HALF * (found.cov_m2.xx + found.cov_m2.yy)),
        found.offset_rad, sigma_rad < VAGUE_RAD ? sigma_rad : INSOLE_PI};
    return true;
}
