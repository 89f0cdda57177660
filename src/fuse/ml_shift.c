/* SPDX-License-Identifier: MIT */
#include "insole/fuse/ml_shift.h"

#include <string.h>

#include "insole/fuse/step_ekf.h"

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

const insole_ml_shift_config_t insole_ml_shift_defaults = {
    INSOLE_ML_SHIFT_KEYS(INSOLE_CONFIG_DEFAULT)};

static insole_status_t refuse(insole_ml_shift_t *ml, insole_status_t why)
{
    ml->refused++;
    return why;
}

static insole_status_t check(const insole_ml_shift_config_t *config)
{
    typedef insole_ml_shift_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_ML_SHIFT_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_ml_shift_init(insole_ml_shift_t *ml, const insole_ml_shift_config_t *config)
{
    if (!ml || !config) {
        return INSOLE_ERR_NULL;
    }
    if (check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(ml, 0, sizeof *ml);
    ml->config = *config;
    return INSOLE_OK;
}

insole_status_t insole_ml_shift_start(insole_ml_shift_t *ml, insole_spot_t spot,
                                      insole_sym2_t cov_m2, insole_real_t offset_rad)
{
    if (!ml) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_spot_is_start(spot, cov_m2, offset_rad)) {
        return refuse(ml, INSOLE_ERR_VALUE);
    }
    ml->started = true;
    ml->spot = spot;
    ml->P = insole_spot_cov(insole_sym2_circle(insole_sym2_largest(cov_m2)));
    ml->offset_rad = insole_wrap_pi(offset_rad);
    ml->count = 0u;
    ml->next = 0u;
    ml->steps = 0u;
    ml->fixes = 0u;
    return INSOLE_OK;
}

/* Over the last `memory` numbers, the older the less. */
static void scatter_add(insole_ml_shift_scatter_t *scatter, insole_real_t x, int32_t memory)
{
    scatter->count += scatter->count < (uint32_t)memory ? 1u : 0u;
    insole_real_t off = x - scatter->mean, share = ONE / (insole_real_t)scatter->count;
    scatter->mean += share * off;
    scatter->variance += share * (off * (x - scatter->mean) - scatter->variance);
}

insole_status_t insole_ml_shift_step(insole_ml_shift_t *ml, const insole_pace_t *pace)
{
    if (!ml || !pace) {
        return INSOLE_ERR_NULL;
    }
    if (insole_pace_check(pace) != INSOLE_OK) {
        return refuse(ml, INSOLE_ERR_VALUE);
    }
    if (!ml->started) {
        return refuse(ml, INSOLE_ERR_STATE);
    }
    insole_pace_t in_m = *pace;
    in_m.heading_rad = insole_wrap_pi(pace->heading_rad + ml->offset_rad);
    insole_step_way_t way = insole_step_ekf(&in_m);
    insole_spot_t spot = insole_spot_add(ml->spot, way.mean);
    if (!insole_spot_is_in_reach(spot)) {
        return refuse(ml, INSOLE_ERR_VALUE);
    }
    ml->spot = spot; /* the sum over D of (4) */
    insole_real_t wider = insole_sym2_largest(way.Q);
    ml->P = insole_spot_cov(insole_sym2_add(ml->P, insole_sym2_circle(wider)));
    scatter_add(&ml->lengths, pace->length_m, ml->config.memory);
    ml->steps++;
    return INSOLE_OK;
}

static const insole_ml_shift_pair_t *newest(const insole_ml_shift_t *ml)
{
    uint32_t size = (uint32_t)ml->config.window;
    return &ml->pair[(ml->next + size - 1u) % size];
}

static void push(insole_ml_shift_t *ml, const insole_spot_fix_t *fix, insole_spot_t since)
{
    uint32_t size = (uint32_t)ml->config.window;
    insole_ml_shift_pair_t pair = {fix->spot, insole_spot_sub(ml->spot, since), fix->cov_m2,
                                   ml->steps};
    insole_spot_t apart = insole_spot_sub(pair.radio, pair.pdr);
    if (ml->count > 0u) {
        insole_spot_t moved = insole_spot_sub(pair.radio, newest(ml)->radio);
        scatter_add(&ml->distances, insole_spot_norm(moved), ml->config.memory);
    }
    scatter_add(&ml->innovations, HALF * insole_spot_dot(apart, apart), ml->config.memory);
    ml->pair[ml->next] = pair;
    ml->next = (ml->next + 1u) % size;
    ml->count += ml->count < size ? 1u : 0u;
}

/* A variance that `count` numbers tell and that the settings told before. */
static insole_real_t learned(const insole_ml_shift_t *ml, insole_real_t before_m,
                             insole_real_t told_m2, uint32_t count)
{
    insole_real_t prior = ml->config.prior_count, n = (insole_real_t)count;
    insole_real_t variance = (prior * insole_square(before_m) + n * told_m2) / (prior + n);
    return insole_max(variance, insole_square(ml->config.least_m));
}

/* sigma*^2 */
static insole_real_t radio_variance(const insole_ml_shift_t *ml)
{
    const insole_ml_shift_config_t *c = &ml->config;
    insole_sym2_t told = newest(ml)->cov_m2;
    if (c->radio == INSOLE_ML_SHIFT_DISTANCES) {
        return learned(ml, c->sigma_radio_m, ml->distances.variance, ml->distances.count);
    }
    return c->radio == INSOLE_ML_SHIFT_TOLD ? HALF * (told.xx + told.yy)
                                            : insole_square(c->sigma_radio_m);
}

/* sigma^2 */
static insole_real_t pdr_variance(const insole_ml_shift_t *ml, insole_real_t var_radio_m2)
{
    const insole_ml_shift_config_t *c = &ml->config;
    uint32_t oldest = ml->count < (uint32_t)c->window ? 0u : ml->next;
    if (c->pdr == INSOLE_ML_SHIFT_INNOVATIONS) {
        insole_real_t left_over = ml->innovations.mean - var_radio_m2;
        return learned(ml, c->sigma_pdr_m, left_over, ml->innovations.count);
    }
    if (c->pdr == INSOLE_ML_SHIFT_STRIDES) {
        insole_real_t steps = (insole_real_t)(ml->steps - ml->pair[oldest].step);
        return insole_max(steps * ml->lengths.variance, insole_square(c->least_m));
    }
    return insole_square(c->sigma_pdr_m);
}

/* Information of the fixes of the window, and what it pulls at L_p. */
static insole_sym2_t gather(const insole_ml_shift_t *ml, insole_spot_t *pull)
{
    insole_sym2_t sum = insole_sym2_circle(ZERO), W = insole_sym2_circle(ONE / ml->var_radio_m2);
    *pull = insole_spot(ZERO, ZERO);
    for (uint32_t i = 0u; i < ml->count; i++) {
        const insole_ml_shift_pair_t *pair = &ml->pair[i];
        if (ml->config.radio == INSOLE_ML_SHIFT_TOLD) {
            (void)insole_sym2_inverse(pair->cov_m2, &W);
        }
        insole_spot_t apart = insole_spot_sub(pair->radio, pair->pdr);
        *pull = insole_spot_add(*pull, insole_sym2_mul(W, apart));
        sum = insole_sym2_add(sum, W);
    }
    return sum;
}

/* However fixes and paces hang together, the shares of both sigmas add up at most. */
static void blend(insole_ml_shift_t *ml, insole_sym2_t known, insole_real_t own)
{
    insole_real_t most = insole_sym2_largest(known);
    insole_real_t least = insole_max(known.xx + known.yy - most, ZERO);
    insole_real_t told_m2 = insole_sym2_largest(newest(ml)->cov_m2);
    insole_real_t fix_m = insole_sqrt(insole_max(told_m2, ml->var_radio_m2));
    insole_real_t sigma_m =
        own / (own + least) * insole_sqrt(ml->P.xx) + most / (own + most) * fix_m;
    ml->P = insole_spot_cov(insole_sym2_circle(insole_square(sigma_m)));
}

/* Everything in the window goes with the shift, so that the next one starts from there. */
static void move(insole_ml_shift_t *ml, insole_spot_t shift)
{
    ml->shift = shift;
    ml->spot = insole_spot_add(ml->spot, shift); /* [WifiShift (4)] */
    for (uint32_t i = 0u; i < ml->count; i++) {
        ml->pair[i].pdr = insole_spot_add(ml->pair[i].pdr, shift);
    }
}

/* The largest value of (2), equal to that of the product in (3). Its logarithm is
 * -1/2 [n |shift|^2 / sigma^2 + sum (apart - shift)' W (apart - shift)]. */
static void shift_by_window(insole_ml_shift_t *ml)
{
    ml->var_radio_m2 = radio_variance(ml);
    ml->var_pdr_m2 = pdr_variance(ml, ml->var_radio_m2);
    insole_real_t own = (insole_real_t)ml->count / ml->var_pdr_m2;
    insole_spot_t pull, shift = {ZERO, ZERO};
    insole_sym2_t known = gather(ml, &pull), V;
    if (insole_sym2_inverse(insole_sym2_add(known, insole_sym2_circle(own)), &V)) {
        shift = insole_sym2_mul(V, pull); /* [WifiShift (2)-(3)] */
        blend(ml, known, own);
    }
    bool moves = insole_spot_is_in_reach(insole_spot_add(ml->spot, shift));
    move(ml, moves ? shift : insole_spot(ZERO, ZERO));
}

insole_status_t insole_ml_shift_fix(insole_ml_shift_t *ml, const insole_spot_fix_t *fix)
{
    if (!ml || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (insole_spot_fix_check(fix) != INSOLE_OK) {
        return refuse(ml, INSOLE_ERR_VALUE);
    }
    if (!ml->started) {
        return refuse(ml, INSOLE_ERR_STATE);
    }
    if (ml->fixes > 0u && fix->t_us <= ml->fix_us) {
        return refuse(ml, INSOLE_ERR_TIME);
    }
    push(ml, fix, insole_turn_way(insole_turn(ml->offset_rad), fix->since));
    shift_by_window(ml);
    ml->fix_us = fix->t_us;
    ml->fixes++;
    return INSOLE_OK;
}

/* ---- for a tracker ---------------------------------------------------------------------- */

static insole_status_t begin_state(void *state, const insole_step_filter_begin_t *begin)
{
    return begin ? insole_ml_shift_start(state, begin->spot, begin->cov_m2, begin->offset_rad)
                 : INSOLE_ERR_NULL;
}

static insole_status_t step_state(void *state, uint64_t t_us, const insole_pace_t *pace)
{
    (void)t_us;
    return insole_ml_shift_step(state, pace);
}

static insole_status_t fix_state(void *state, const insole_spot_fix_t *fix)
{
    return insole_ml_shift_fix(state, fix);
}

static insole_status_t answer_state(const void *state, insole_step_filter_answer_t *answer)
{
    const insole_ml_shift_t *ml = state;
    if (!ml || !answer) {
        return INSOLE_ERR_NULL;
    }
    if (!ml->started) {
        return INSOLE_ERR_STATE;
    }
    *answer = (insole_step_filter_answer_t){ml->spot, ml->P, ml->offset_rad, ZERO, ONE};
    return INSOLE_OK;
}

const insole_step_filter_calls_t insole_ml_shift_calls = {
    .start = begin_state, .step = step_state, .fix = fix_state, .answer = answer_state};
