/* SPDX-License-Identifier: MIT */
#include "insole/fuse/auto_start.h"

#include <string.h>

#include "insole/fuse/step_ekf.h"

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)
#define TWO  INSOLE_R(2.0)

static const insole_real_t MOST_ANGLE_RAD = INSOLE_R(1.0e3), LEAST_SIGMA_RAD = INSOLE_R(1.0e-3);

const insole_auto_start_config_t insole_auto_start_defaults = {
    INSOLE_AUTO_START_KEYS(INSOLE_CONFIG_DEFAULT)};

static insole_status_t refuse(insole_auto_start_t *start, insole_status_t why)
{
    start->refused++;
    return why;
}

insole_status_t insole_auto_start_check(const insole_auto_start_config_t *config)
{
    typedef insole_auto_start_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_AUTO_START_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_auto_start_init(insole_auto_start_t *start,
                                                   const insole_auto_start_config_t *config,
                                                   const insole_auto_start_circles_t *circles)
{
    if (!start || !config) {
        return INSOLE_ERR_NULL;
    }
    if (insole_auto_start_check(config) != INSOLE_OK ||
        (config->method == INSOLE_AUTO_START_CIRCLES && !circles)) {
        return INSOLE_ERR_VALUE;
    }
    memset(start, 0, sizeof *start);
    start->config = *config;
    start->circles = circles;
    start->bias_m = config->bias_m;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_auto_start_step(insole_auto_start_t *start,
                                                   const insole_pace_t *pace)
{
    if (!start || !pace) {
        return INSOLE_ERR_NULL;
    }
    if (insole_pace_check(pace) != INSOLE_OK) {
        return refuse(start, INSOLE_ERR_VALUE);
    }
    insole_step_way_t step = insole_step_ekf(pace);
    insole_spot_t way = insole_spot_add(start->way, step.mean);
    if (!(insole_spot_norm(way) <= INSOLE_SPOT_MOST_M)) {
        return refuse(start, INSOLE_ERR_VALUE);
    }
    start->way = way;
    if (pace->length_m > ZERO) {
        insole_turn_t ahead = insole_turn(pace->heading_rad);
        start->ahead = insole_spot(ahead.cos, ahead.sin);
    }
    start->drift_m2 =
        insole_min(start->drift_m2 + insole_sym2_largest(step.Q), INSOLE_SPOT_MOST_M2);
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_auto_start_compass(insole_auto_start_t *start,
                                                      insole_real_t offset_rad,
                                                      insole_real_t sigma_rad)
{
    if (!start) {
        return INSOLE_ERR_NULL;
    }
    bool usable = insole_abs(offset_rad) <= MOST_ANGLE_RAD && sigma_rad >= LEAST_SIGMA_RAD &&
                  insole_is_finite(sigma_rad);
    if (!usable) {
        return refuse(start, INSOLE_ERR_VALUE);
    }
    start->has_compass = insole_square(sigma_rad) < INSOLE_HEADING_MOST_R2;
    start->compass_rad = insole_wrap_pi(offset_rad);
    start->compass_sigma_rad = sigma_rad;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_auto_start_bias(insole_auto_start_t *start,
                                                   insole_real_t sigma_m)
{
    if (!start) {
        return INSOLE_ERR_NULL;
    }
    if (!(sigma_m >= ZERO) || !insole_is_finite(sigma_m)) {
        return refuse(start, INSOLE_ERR_VALUE);
    }
    start->bias_m = insole_min(sigma_m, start->config.bias_m);
    return INSOLE_OK;
}

/* ---- what a fix adds ----------------------------------------------------------------------- */

/* a x + b y of two rows */
static insole_auto_start_row_t mix(insole_real_t a, insole_auto_start_row_t x, insole_real_t b,
                                   insole_auto_start_row_t y)
{
    insole_spot_t none = {ZERO, ZERO};
    insole_auto_start_row_t row = {
        a * x.one + b * y.one,
        insole_spot_add_scaled(insole_spot_add_scaled(none, a, x.way), b, y.way),
        insole_spot_add_scaled(insole_spot_add_scaled(none, a, x.radio), b, y.radio)};
    return row;
}

/* Adds a row whose entries are of unit variance and independent of all before. */
static void add_up(insole_auto_start_sums_t *sums, insole_auto_start_row_t row)
{
    sums->ones += row.one * row.one;
    sums->way = insole_spot_add_scaled(sums->way, row.one, row.way);
    sums->radio = insole_spot_add_scaled(sums->radio, row.one, row.radio);
    sums->along += insole_spot_dot(row.way, row.radio);
    sums->across += row.way.x_m * row.radio.y_m - row.way.y_m * row.radio.x_m;
}

/* Takes from the row what the shared error of the fixes before makes expect of it: a Kalman filter
 * of that error, whose gains are the same for ones, ways and fixes. What is left is new. */
static void whiten(insole_auto_start_t *start, insole_auto_start_row_t row, insole_real_t var_m2,
                   insole_real_t dt_s)
{
    insole_real_t all_m2 = insole_square(start->bias_m);
    insole_real_t left = insole_exp(-dt_s / start->config.bias_s);
    insole_real_t P = all_m2 + left * left * (start->var_shared_m2 - all_m2);
    insole_real_t S = P + var_m2, K = P / S;
    insole_auto_start_row_t fresh = mix(ONE, row, -left, start->shared);
    start->shared = mix(left, start->shared, K, fresh);
    start->var_shared_m2 = P * var_m2 / S;
    insole_real_t per = ONE / insole_sqrt(S);
    add_up(&start->sums, mix(per, fresh, ZERO, fresh));
}

static void take(insole_auto_start_t *start, const insole_spot_fix_t *fix)
{
    insole_spot_t heard = insole_spot_add_scaled(insole_spot_sub(start->way, fix->since),
                                                 start->config.ahead_m, start->ahead);
    insole_real_t dt_s = ZERO;
    if (start->fixes == 0u) {
        start->first_way = heard;
        start->first_radio = fix->spot;
        start->var_shared_m2 = insole_square(start->bias_m);
    } else {
        dt_s = insole_seconds(start->fix_us, fix->t_us);
    }
    insole_auto_start_row_t row = {ONE, insole_spot_sub(heard, start->first_way),
                                   insole_spot_sub(fix->spot, start->first_radio)};
    whiten(start, row, insole_sym2_largest(fix->cov_m2), dt_s);
    if (start->config.method == INSOLE_AUTO_START_CIRCLES) {
        start->circles->take(start, &row);
    }
    start->fix_us = fix->t_us;
    start->fixes++;
}

INSOLE_COLD insole_status_t insole_auto_start_fix(insole_auto_start_t *start,
                                                  const insole_spot_fix_t *fix)
{
    if (!start || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (insole_spot_fix_check(fix) != INSOLE_OK) {
        return refuse(start, INSOLE_ERR_VALUE);
    }
    if (start->fixes > 0u && fix->t_us <= start->fix_us) {
        return refuse(start, INSOLE_ERR_TIME);
    }
    take(start, fix);
    return INSOLE_OK;
}

/* ---- the answer ---------------------------------------------------------------------------- */

/* Of a density of von Mises. No less than its variance for any concentration, and right for large
 * ones and for none. */
static insole_real_t variance_of(insole_real_t concentration)
{
    insole_real_t least = ONE / INSOLE_HEADING_MOST_R2;
    return ONE / insole_max(concentration - INSOLE_R(0.75), least);
}

/* The offset by fixes and compass: product of two densities of von Mises.
 * @return its concentration */
static insole_real_t find_offset(const insole_auto_start_t *start,
                                 insole_auto_start_answer_t *answer)
{
    const insole_auto_start_sums_t *s = &start->sums;
    insole_real_t per = ONE / s->ones;
    insole_real_t along = s->along - per * insole_spot_dot(s->way, s->radio);
    insole_real_t across =
        s->across - per * (s->way.x_m * s->radio.y_m - s->way.y_m * s->radio.x_m);
    if (start->has_compass) {
        insole_turn_t compass = insole_turn(start->compass_rad);
        insole_real_t told = ONE / insole_square(start->compass_sigma_rad);
        along += told * compass.cos;
        across += told * compass.sin;
    }
    answer->offset_rad = insole_atan2(across, along);
    insole_real_t concentration = insole_sqrt(along * along + across * across);
    answer->var_offset_rad2 = variance_of(concentration);
    return concentration;
}

/* A / c with A = I1(c) / I0(c), the mean cosine of a density of von Mises: continued fraction, with
 * a bound of I3 / I2 at its end. It is never too large with end = 3.5, never too small with 2.5. */
static insole_real_t mean_cosine_per(insole_real_t c, insole_real_t end)
{
    insole_real_t third = c / (INSOLE_R(2.5) + insole_sqrt(c * c + end * end));
    insole_real_t second = c / (INSOLE_R(4.0) + c * third);
    return ONE / (TWO + c * second);
}

/* Mean squares along and across a way whose direction is known with this concentration c, of
 * (1 - cos)^2 and sin^2; the mean of cos 2 is 1 - 2 A / c. */
static insole_sym2_t cov_of_lever(insole_spot_t lever, insole_real_t concentration,
                                  insole_real_t sigma_scale)
{
    insole_real_t c = insole_min(concentration, INSOLE_R(1.0e9));
    insole_real_t low = mean_cosine_per(c, INSOLE_R(3.5));
    insole_real_t across = mean_cosine_per(c, INSOLE_R(2.5));
    insole_real_t along = insole_max(TWO - TWO * c * low - low, ZERO);
    insole_spot_t side = {-lever.y_m, lever.x_m};
    insole_sym2_t cov = insole_sym2_circle(ZERO);
    cov = insole_sym2_add_outer(cov, along + insole_square(sigma_scale), lever);
    return insole_sym2_add_outer(cov, across, side);
}

/* Now: from the middle of the fixes on, along the way walked since the middle of the ways. */
static void find_place(const insole_auto_start_t *start, insole_real_t concentration,
                       insole_auto_start_answer_t *answer)
{
    insole_real_t per = ONE / start->sums.ones;
    insole_spot_t none = {ZERO, ZERO};
    insole_spot_t middle = insole_spot_add_scaled(start->first_radio, per, start->sums.radio);
    insole_spot_t middle_way = insole_spot_add_scaled(none, per, start->sums.way);
    insole_spot_t way = insole_spot_sub(start->way, start->first_way);
    insole_turn_t turn = insole_turn(answer->offset_rad);
    insole_spot_t lever = insole_turn_way(turn, insole_spot_sub(way, middle_way));
    insole_sym2_t cov = cov_of_lever(lever, concentration, start->config.sigma_scale);
    answer->spot = insole_spot_add(middle, lever);
    answer->begin = insole_spot_sub(middle, insole_turn_way(turn, middle_way));
    answer->cov_m2 = insole_sym2_add(cov, insole_sym2_circle(per + start->drift_m2));
    answer->shared_m2 = start->shared.one * per;
}

INSOLE_COLD insole_status_t insole_auto_start_answer(const insole_auto_start_t *start,
                                                     insole_auto_start_answer_t *answer)
{
    if (!start || !answer) {
        return INSOLE_ERR_NULL;
    }
    if (start->fixes == 0u) {
        return INSOLE_ERR_STATE;
    }
    const insole_auto_start_config_t *c = &start->config;
    find_place(start, find_offset(start, answer), answer);
    if (c->method == INSOLE_AUTO_START_CIRCLES) {
        start->circles->answer(start, answer);
    }
    answer->cov_m2 = insole_spot_cov(answer->cov_m2);
    answer->fixes = start->fixes;
    bool sure = answer->var_offset_rad2 <= insole_square(c->refine_rad);
    bool late = start->fixes >= (uint32_t)c->fixes_most;
    answer->ready = late || (start->fixes >= (uint32_t)c->fixes && sure);
    return INSOLE_OK;
}

/* ---- circles ------------------------------------------------------------------------------- */

static void add_circle(insole_auto_start_t *start, const insole_auto_start_row_t *row)
{
    if (start->pairs >= (uint32_t)start->config.fixes) {
        return;
    }
    insole_circle_pair_t pair = {row->radio, row->way};
    start->pair[start->pairs++] = pair;
    insole_spot_t place = insole_circle_start_place(start->pair, start->pairs);
    insole_spot_t off = insole_spot_sub(place, start->circle_mean);
    start->circle_mean = /* [WifiShift (1)] */
        insole_spot_add_scaled(start->circle_mean, ONE / (insole_real_t)start->pairs, off);
}

/* The paper's answer in place of ours, and the difference of both in the covariances. */
static void take_circles(const insole_auto_start_t *start, insole_auto_start_answer_t *answer)
{
    insole_spot_t begin = start->circle_mean;
    insole_real_t offset_rad = insole_circle_start_direction(start->pair, start->pairs, begin);
    insole_spot_t way = insole_spot_sub(start->way, start->first_way);
    answer->begin = insole_spot_add(start->first_radio, begin);
    insole_spot_t spot =
        insole_spot_add(answer->begin, insole_turn_way(insole_turn(offset_rad), way));
    insole_real_t turn_rad = insole_wrap_pi(offset_rad - answer->offset_rad);
    insole_real_t variance = answer->var_offset_rad2 + insole_square(turn_rad);
    answer->cov_m2 =
        insole_sym2_add_outer(answer->cov_m2, ONE, insole_spot_sub(spot, answer->spot));
    answer->var_offset_rad2 = insole_min(variance, INSOLE_HEADING_MOST_R2);
    answer->spot = spot;
    answer->offset_rad = offset_rad;
}

const insole_auto_start_circles_t insole_auto_start_circles = {add_circle, take_circles};
