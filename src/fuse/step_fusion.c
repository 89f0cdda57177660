/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_fusion.h"

#include <stddef.h>
#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

/* A fix so many gates off tells nothing, and squares of more leave a float. */
static const insole_real_t FARTHEST_OFF = INSOLE_R(1.0e9);

const insole_step_fusion_config_t insole_step_fusion_defaults = {
    INSOLE_STEP_FUSION_KEYS(INSOLE_CONFIG_DEFAULT)};

static insole_status_t refuse(insole_step_fusion_t *fusion, insole_status_t why)
{
    fusion->refused++;
    return why;
}

static insole_status_t check(const insole_step_fusion_config_t *config)
{
    typedef insole_step_fusion_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_STEP_FUSION_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_step_fusion_init(insole_step_fusion_t *fusion,
                                                    const insole_step_fusion_config_t *config)
{
    if (!fusion || !config) {
        return INSOLE_ERR_NULL;
    }
    if (check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(fusion, 0, sizeof *fusion);
    fusion->config = *config;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_step_fusion_start(insole_step_fusion_t *fusion,
                                                     insole_spot_t spot, insole_sym2_t cov_m2,
                                                     insole_real_t offset_rad)
{
    if (!fusion) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_spot_is_start(spot, cov_m2, offset_rad)) {
        return refuse(fusion, INSOLE_ERR_VALUE);
    }
    fusion->started = true;
    fusion->has_fix = false;
    fusion->spot = spot;
    fusion->P = insole_spot_cov(cov_m2);
    fusion->offset_rad = insole_wrap_pi(offset_rad);
    fusion->gated_in_row = 0u;
    fusion->steps = 0u;
    fusion->fixes = 0u;
    return INSOLE_OK;
}

/* The way as told, and the same covariance for every one. */
static insole_step_way_t plain_way(const insole_pace_t *pace, insole_real_t sigma_m)
{
    insole_step_way_t way = {insole_pace_way(pace, ZERO),
                             insole_sym2_circle(insole_square(sigma_m))};
    return way;
}

/* The pace in m, with the variances that count. */
static insole_pace_t pace_on_map(const insole_step_fusion_t *fusion, const insole_pace_t *pace)
{
    const insole_step_fusion_config_t *c = &fusion->config;
    insole_pace_t in_m = *pace;
    in_m.heading_rad = insole_wrap_pi(pace->heading_rad + fusion->offset_rad); /* [PhoneEKF (29)] */
    if (c->process == INSOLE_STEP_CONSTANT) {
        in_m.var_length_m2 = insole_square(c->sigma_length_m);
        in_m.var_heading_rad2 = insole_square(c->sigma_heading_rad);
    }
    return in_m;
}

INSOLE_COLD insole_status_t insole_step_fusion_step(insole_step_fusion_t *fusion,
                                                    insole_step_method_t *method,
                                                    const insole_pace_t *pace)
{
    if (!fusion || !pace) {
        return INSOLE_ERR_NULL;
    }
    if (insole_pace_check(pace) != INSOLE_OK) {
        return refuse(fusion, INSOLE_ERR_VALUE);
    }
    if (!fusion->started) {
        return refuse(fusion, INSOLE_ERR_STATE);
    }
    insole_pace_t in_m = pace_on_map(fusion, pace);
    insole_step_way_t way = method ? method(&in_m) : plain_way(&in_m, fusion->config.sigma_way_m);
    insole_spot_t spot = insole_spot_add(fusion->spot, way.mean); /* [PhoneEKF (31)-(32)] */
    if (!insole_spot_is_in_reach(spot)) {
        return refuse(fusion, INSOLE_ERR_VALUE);
    }
    fusion->spot = spot; /* [PhoneUKF (38)-(39)] */
    fusion->P =
        insole_spot_cov(insole_sym2_add(fusion->P, way.Q)); /* [PhoneEKF (33)], [PhoneUKF (40)] */
    fusion->steps++;
    return INSOLE_OK;
}

/* P becomes (I - K) P- (I - K)' + K R K', equal to (I - K) P-; but an error of K only adds. What
 * would carry the position out of reach is nonsense and changes nothing. */
static void correct(insole_step_fusion_t *fusion, insole_spot_t innovation, insole_sym2_t R,
                    insole_sym2_t W)
{
    insole_sym2_t P = fusion->P;
    /* rows of K = P- W [PhoneEKF (38)], [PhoneUKF (45)] */
    insole_spot_t kx = insole_sym2_mul(W, insole_spot(P.xx, P.xy));
    insole_spot_t ky = insole_sym2_mul(W, insole_spot(P.xy, P.yy));
    insole_spot_t shift = {insole_spot_dot(kx, innovation), insole_spot_dot(ky, innovation)};
    insole_spot_t spot = insole_spot_add(fusion->spot, shift);
    if (!insole_spot_is_in_reach(spot)) {
        return;
    }
    fusion->spot = spot; /* [PhoneEKF (39)], [PhoneUKF (46)] */
    insole_spot_t x_left = {ONE - kx.x_m, -kx.y_m}, y_left = {-ky.x_m, ONE - ky.y_m};
    fusion->P = insole_spot_cov(
        insole_sym2_add(/* [PhoneEKF (40)], [PhoneUKF (47)] */
                        insole_sym2_map(x_left, y_left, P), insole_sym2_map(kx, ky, R)));
}

/* The inverse W of the innovation's covariance, and the normalised innovation squared. */
static bool weigh(insole_sym2_t P, insole_sym2_t R, insole_spot_t innovation, insole_sym2_t *W,
                  insole_real_t *nis)
{
    if (!insole_sym2_inverse(insole_sym2_add(P, R), W)) {
        return false;
    }
    *nis = insole_sym2_form(*W, innovation);
    return insole_is_finite(*nis);
}

/* A fix that does not fit: P is widened after too many, then R as far as is needed.
 * @return whether it is to be used */
static bool hold_off(insole_step_fusion_t *fusion, insole_spot_t innovation, insole_sym2_t *R,
                     insole_sym2_t *W)
{
    const insole_step_fusion_config_t *c = &fusion->config;
    insole_real_t nis = fusion->nis;
    fusion->gated++;
    fusion->gated_in_row++;
    if (fusion->gated_in_row >= (uint32_t)c->patience) {
        fusion->P = insole_spot_cov(insole_sym2_scale(fusion->P, c->widen));
        fusion->widened++;
        if (weigh(fusion->P, *R, innovation, W, &nis) && nis <= c->gate) {
            fusion->gated_in_row = 0u;
            return true;
        }
    }
    insole_real_t off = nis / c->gate;
    if (c->gated == INSOLE_STEP_PASS || !(off < FARTHEST_OFF)) {
        return false;
    }
    *R = insole_sym2_scale(*R, off * off);
    return weigh(fusion->P, *R, innovation, W, &nis);
}

static insole_status_t take(insole_step_fusion_t *fusion, const insole_spot_fix_t *fix)
{
    insole_spot_t since = insole_turn_way(insole_turn(fusion->offset_rad), fix->since);
    insole_spot_t seen = insole_spot_add(fix->spot, since); /* [PhoneEKF (35)], [PhoneUKF (42)] */
    insole_spot_t innovation = insole_spot_sub(seen, fusion->spot);
    insole_real_t variance = insole_square(fusion->config.sigma_fix_m);
    bool told = fusion->config.measurement == INSOLE_STEP_TOLD;
    insole_sym2_t R = told ? fix->cov_m2 : insole_sym2_circle(variance), W;
    insole_real_t nis;
    if (!weigh(fusion->P, R, innovation, &W, &nis)) {
        return refuse(fusion, INSOLE_ERR_VALUE);
    }
    fusion->nis = nis;
    fusion->has_fix = true;
    fusion->fix_us = fix->t_us;
    fusion->fixes++;
    bool fits = nis <= fusion->config.gate;
    fusion->gated_in_row = fits ? 0u : fusion->gated_in_row;
    if (fits || hold_off(fusion, innovation, &R, &W)) {
        correct(fusion, innovation, R, W);
    }
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_step_fusion_fix(insole_step_fusion_t *fusion,
                                                   const insole_spot_fix_t *fix)
{
    if (!fusion || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (insole_spot_fix_check(fix) != INSOLE_OK) {
        return refuse(fusion, INSOLE_ERR_VALUE);
    }
    if (!fusion->started) {
        return refuse(fusion, INSOLE_ERR_STATE);
    }
    if (fusion->has_fix && fix->t_us <= fusion->fix_us) {
        return refuse(fusion, INSOLE_ERR_TIME);
    }
    return take(fusion, fix);
}

/* ---- for a tracker ---------------------------------------------------------------------- */

INSOLE_COLD insole_status_t insole_step_fusion_begin_state(void *state,
                                                           const insole_step_filter_begin_t *begin)
{
    return begin ? insole_step_fusion_start(state, begin->spot, begin->cov_m2, begin->offset_rad)
                 : INSOLE_ERR_NULL;
}

INSOLE_COLD insole_status_t insole_step_fusion_fix_state(void *state, const insole_spot_fix_t *fix)
{
    return insole_step_fusion_fix(state, fix);
}

insole_status_t insole_step_fusion_answer_state(const void *state,
                                                insole_step_filter_answer_t *answer)
{
    const insole_step_fusion_t *fusion = state;
    if (!fusion || !answer) {
        return INSOLE_ERR_NULL;
    }
    if (!fusion->started) {
        return INSOLE_ERR_STATE;
    }
    *answer = (insole_step_filter_answer_t){fusion->spot, fusion->P, fusion->offset_rad, ZERO, ONE};
    return INSOLE_OK;
}

static insole_status_t step_state(void *state, uint64_t t_us, const insole_pace_t *pace)
{
    (void)t_us;
    return insole_step_fusion_step(state, NULL, pace);
}

const insole_step_filter_calls_t insole_step_kf_calls = {
    .start = insole_step_fusion_begin_state,
    .step = step_state,
    .fix = insole_step_fusion_fix_state,
    .answer = insole_step_fusion_answer_state,
};
