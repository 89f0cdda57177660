/* SPDX-License-Identifier: MIT */
#include "insole/fuse/walker_ekf.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

/* A fix so many gates off tells nothing, and squares of more leave a float. */
static const insole_real_t FARTHEST_OFF = INSOLE_R(1.0e9);

static const insole_real_t MOST_ANGLE_RAD = INSOLE_R(1.0e3), LEAST_SIGMA_RAD = INSOLE_R(1.0e-3);

/* No offset is known better at the start, so that its covariance with the scale can be turned into
 * that of c. */
static const insole_real_t LEAST_RAD2 = INSOLE_R(1.0e-6);

const insole_walker_ekf_config_t insole_walker_ekf_defaults = {
    INSOLE_WALKER_EKF_KEYS(INSOLE_CONFIG_DEFAULT)};

static insole_status_t refuse(insole_walker_ekf_t *walker, insole_status_t why)
{
    walker->refused++;
    return why;
}

static insole_status_t check(const insole_walker_ekf_config_t *config)
{
    typedef insole_walker_ekf_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_WALKER_EKF_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_walker_ekf_init(insole_walker_ekf_t *walker,
                                       const insole_walker_ekf_config_t *config)
{
    if (!walker || !config) {
        return INSOLE_ERR_NULL;
    }
    if (check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(walker, 0, sizeof *walker);
    walker->config = *config;
    walker->bias_m = config->bias_m;
    return INSOLE_OK;
}

/* ---- start --------------------------------------------------------------------------------- */

static void begin(insole_walker_ekf_t *walker, const insole_walker_start_t *start)
{
    const insole_walker_ekf_config_t *c = &walker->config;
    insole_walker_state_t *state = &walker->state;
    memset(state, 0, sizeof *state);
    state->spot = start->spot;
    state->offset_rad = insole_wrap_pi(start->offset_rad);
    state->scale = ONE;
    /* a position from radio is off by what the fixes are off by */
    insole_real_t share = start->by_radio ? -ONE : ZERO, var_m2 = insole_square(walker->bias_m);
    insole_walker_column_t x = {{ONE, ZERO, share, ZERO, ZERO, ZERO}};
    insole_walker_column_t y = {{ZERO, ONE, ZERO, share, ZERO, ZERO}};
    insole_sym2_t turn = {LEAST_RAD2, ZERO, insole_square(c->sigma_scale)};
    insole_walker_cov_add_pair(&state->P, INSOLE_WALKER_X, start->cov_m2);
    insole_walker_cov_add(&state->P, var_m2, x);
    insole_walker_cov_add(&state->P, var_m2, y);
    insole_walker_cov_add_pair(&state->P, INSOLE_WALKER_TURN, turn);
    insole_walker_state_wander(state, start->var_offset_rad2);
    walker->started = true;
    walker->by_radio = start->by_radio;
    walker->has_fix = false;
    walker->bias_us = start->t_us;
    walker->ahead.cos = walker->ahead.sin = ZERO;
    walker->gated_in_row = 0u;
    walker->steps = 0u;
    walker->fixes = 0u;
}

insole_status_t insole_walker_ekf_start(insole_walker_ekf_t *walker,
                                        const insole_walker_start_t *start)
{
    if (!walker || !start) {
        return INSOLE_ERR_NULL;
    }
    bool usable = insole_spot_is_start(start->spot, start->cov_m2, start->offset_rad) &&
                  start->var_offset_rad2 >= ZERO && insole_is_finite(start->var_offset_rad2);
    if (!usable) {
        return refuse(walker, INSOLE_ERR_VALUE);
    }
    begin(walker, start);
    return INSOLE_OK;
}

/* ---- a step -------------------------------------------------------------------------------- */

/* What a pace tells of its heading, beyond what the one before told as well. */
typedef struct {
    insole_real_t drift_rad2, rise_rad2, own_rad2;
} told_t;

static told_t split(const insole_walker_ekf_t *walker, insole_real_t var_heading_rad2)
{
    insole_real_t all = insole_min(var_heading_rad2, INSOLE_HEADING_MOST_R2);
    if (walker->steps == 0u) {
        told_t first = {all, ZERO, ZERO};
        return first;
    }
    insole_real_t drift = insole_min(all, walker->told_rad2);
    told_t told = {drift, insole_max(drift - walker->drift_rad2, ZERO), all - drift};
    return told;
}

/* Covariance of a pace's way, m. When the direction is not known, in all directions alike. */
static insole_sym2_t noise_of(const insole_walker_ekf_t *walker, const insole_pace_t *pace,
                              insole_real_t e, insole_spot_t ahead)
{
    const insole_walker_ekf_config_t *c = &walker->config;
    insole_real_t length2 = insole_square(pace->length_m);
    insole_spot_t own = insole_walker_scatter(e);
    insole_real_t along = insole_max(length2 * insole_square(c->along), pace->var_length_m2);
    along += length2 * own.x_m;
    insole_real_t across = length2 * (insole_square(c->across_rad) + own.y_m);
    if (walker->state.is_wide) {
        return insole_sym2_circle(insole_max(along, across));
    }
    insole_real_t size2 = insole_square(walker->state.scale);
    insole_sym2_t Q = insole_sym2_add_outer(insole_sym2_circle(ZERO), size2 * along, ahead);
    return insole_sym2_add_outer(Q, size2 * across, insole_spot_left(ahead));
}

static void wander_of_pace(insole_walker_ekf_t *walker, insole_real_t rise_rad2)
{
    const insole_walker_ekf_config_t *c = &walker->config;
    insole_walker_state_stretch(&walker->state, insole_square(c->wander_scale),
                                insole_square(c->sigma_scale));
    insole_walker_state_wander(&walker->state, insole_max(insole_square(c->turn_rad), rise_rad2));
}

insole_status_t insole_walker_ekf_step(insole_walker_ekf_t *walker, const insole_pace_t *pace)
{
    if (!walker || !pace) {
        return INSOLE_ERR_NULL;
    }
    if (insole_pace_check(pace) != INSOLE_OK) {
        return refuse(walker, INSOLE_ERR_VALUE);
    }
    if (!walker->started) {
        return refuse(walker, INSOLE_ERR_STATE);
    }
    told_t told = split(walker, pace->var_heading_rad2);
    insole_turn_t n = insole_turn(pace->heading_rad);
    insole_real_t e = told.own_rad2 > ZERO ? insole_walker_kept(told.own_rad2) : ONE;
    insole_spot_t way =
        insole_spot_scale(insole_sqrt(e) * pace->length_m, insole_spot(n.cos, n.sin));
    insole_walker_lever_t lever = insole_walker_state_lever(&walker->state, way);
    insole_spot_t spot = insole_spot_add(walker->state.spot, lever.moved);
    if (!insole_spot_is_in_reach(spot)) {
        return refuse(walker, INSOLE_ERR_VALUE);
    }
    insole_turn_t ahead =
        insole_turn(pace->heading_rad + insole_walker_state_offset(&walker->state));
    insole_sym2_t Q = noise_of(walker, pace, e, insole_spot(ahead.cos, ahead.sin));
    insole_walker_cov_walk(&walker->state.P, lever.by_first, lever.by_second);
    insole_walker_cov_add_pair(&walker->state.P, INSOLE_WALKER_X, Q);
    wander_of_pace(walker, told.rise_rad2);
    walker->state.spot = spot;
    walker->ahead = pace->length_m > ZERO ? n : walker->ahead;
    walker->told_rad2 = insole_min(pace->var_heading_rad2, INSOLE_HEADING_MOST_R2);
    walker->drift_rad2 = told.drift_rad2;
    walker->steps++;
    return INSOLE_OK;
}

/* ---- a fix --------------------------------------------------------------------------------- */

/* A fix beside what the states make expect of it. */
typedef struct {
    insole_walker_column_t hx, hy;
    insole_spot_t innovation;
} sight_t;

static void fade_bias(insole_walker_ekf_t *walker, uint64_t t_us)
{
    insole_real_t dt_s = t_us > walker->bias_us ? insole_seconds(walker->bias_us, t_us) : ZERO;
    insole_real_t left = insole_exp(-dt_s / walker->config.bias_s);
    insole_real_t fresh_m2 = insole_square(walker->bias_m) * (ONE - left * left);
    insole_walker_cov_fade(&walker->state.P, left);
    insole_walker_cov_add_pair(&walker->state.P, INSOLE_WALKER_BIAS, insole_sym2_circle(fresh_m2));
    walker->state.bias = insole_spot_scale(left, walker->state.bias);
    walker->bias_us = t_us;
}

static sight_t look(const insole_walker_ekf_t *walker, const insole_spot_fix_t *fix)
{
    insole_real_t ahead_m =
        walker->config.ahead_m / (walker->state.is_wide ? ONE : walker->state.scale);
    insole_spot_t ahead =
        insole_spot_scale(ahead_m, insole_spot(walker->ahead.cos, walker->ahead.sin));
    insole_walker_lever_t since = insole_walker_state_lever(&walker->state, fix->since),
                          front = insole_walker_state_lever(&walker->state, ahead);
    if (!walker->state.is_wide) { /* the radio does not care how long the steps are */
        front.by_second = insole_spot(ZERO, ZERO);
    }
    insole_spot_t first = insole_spot_sub(front.by_first, since.by_first);
    insole_spot_t second = insole_spot_sub(front.by_second, since.by_second);
    insole_spot_t expected = insole_spot_add(walker->state.spot, walker->state.bias);
    expected = insole_spot_add(expected, insole_spot_sub(front.moved, since.moved));
    sight_t sight = {{{ONE, ZERO, ONE, ZERO, first.x_m, second.x_m}},
                     {{ZERO, ONE, ZERO, ONE, first.y_m, second.y_m}},
                     insole_spot_sub(fix->spot, expected)};
    return sight;
}

static insole_real_t nis_of(const insole_walker_ekf_t *walker, const sight_t *sight,
                            insole_sym2_t R)
{
    insole_sym2_t S = insole_walker_cov_seen(&walker->state.P, &sight->hx, &sight->hy), W = R;
    (void)insole_sym2_inverse(insole_spot_cov(insole_sym2_add(S, R)), &W);
    return insole_sym2_form(W, sight->innovation);
}

/* The walker may have been carried off, or turned the phone round. */
static void widen(insole_walker_ekf_t *walker)
{
    insole_real_t more = walker->config.widen - ONE,
                  variance = insole_walker_state_var_offset(&walker->state);
    insole_sym2_t S = insole_walker_cov_pair(&walker->state.P, INSOLE_WALKER_X);
    if ((S.xx + S.yy) * more < INSOLE_SPOT_MOST_M2) {
        insole_walker_cov_add_pair(&walker->state.P, INSOLE_WALKER_X, insole_sym2_scale(S, more));
    }
    insole_walker_state_wander(&walker->state,
                               insole_min(more * variance, insole_max(ONE - variance, ZERO)));
    walker->widened++;
}

/* As one number after the other, whose errors are independent. */
static void correct(insole_walker_ekf_t *walker, const sight_t *sight, insole_sym2_t R)
{
    insole_real_t slope = R.xy / R.xx;
    insole_walker_seen_t seen[2] = {
        {sight->hx, sight->innovation.x_m, R.xx},
        {sight->hy, sight->innovation.y_m - slope * sight->innovation.x_m, R.yy - slope * R.xy}};
    for (int i = 0; i < INSOLE_WALKER_STATES; i++) {
        seen[1].h.at[i] -= slope * sight->hx.at[i];
    }
    insole_walker_state_learn(&walker->state, seen, 2);
}

static void take(insole_walker_ekf_t *walker, const insole_spot_fix_t *fix)
{
    const insole_walker_ekf_config_t *c = &walker->config;
    fade_bias(walker, fix->t_us);
    sight_t sight = look(walker, fix);
    insole_real_t nis = nis_of(walker, &sight, fix->cov_m2);
    bool fits = nis <= c->gate;
    walker->nis = nis;
    walker->gated += fits ? 0u : 1u;
    walker->gated_in_row = fits ? 0u : walker->gated_in_row + 1u;
    if (walker->gated_in_row >= (uint32_t)c->patience) {
        widen(walker);
        sight = look(walker, fix);
        nis = nis_of(walker, &sight, fix->cov_m2);
        walker->gated_in_row = nis <= c->gate ? 0u : walker->gated_in_row;
    }
    insole_real_t off = insole_max(nis / c->gate, ONE);
    if (off < FARTHEST_OFF) {
        correct(walker, &sight, insole_sym2_scale(fix->cov_m2, off * off));
        insole_walker_state_settle(&walker->state);
    }
}

insole_status_t insole_walker_ekf_fix(insole_walker_ekf_t *walker, const insole_spot_fix_t *fix)
{
    if (!walker || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (insole_spot_fix_check(fix) != INSOLE_OK) {
        return refuse(walker, INSOLE_ERR_VALUE);
    }
    if (!walker->started) {
        return refuse(walker, INSOLE_ERR_STATE);
    }
    if (walker->has_fix && fix->t_us <= walker->bias_us) {
        return refuse(walker, INSOLE_ERR_TIME);
    }
    take(walker, fix);
    walker->has_fix = true;
    walker->fixes++;
    return INSOLE_OK;
}

insole_status_t insole_walker_ekf_bias(insole_walker_ekf_t *walker, insole_real_t sigma_m)
{
    if (!walker) {
        return INSOLE_ERR_NULL;
    }
    if (!(sigma_m >= ZERO) || !insole_is_finite(sigma_m)) {
        return refuse(walker, INSOLE_ERR_VALUE);
    }
    walker->bias_m = insole_min(sigma_m, walker->config.bias_m);
    bool is_unseen = walker->started && !walker->has_fix && !walker->by_radio;
    if (is_unseen) {
        insole_walker_cov_fade(&walker->state.P, ZERO);
        insole_walker_cov_add_pair(&walker->state.P, INSOLE_WALKER_BIAS,
                                   insole_sym2_circle(insole_square(walker->bias_m)));
    }
    return INSOLE_OK;
}

/* ---- compass and answer -------------------------------------------------------------------- */

/* c by a direction told: two numbers along and across it which, when nothing else is known, leave
 * exactly the moments of a direction that is wrong by so much. */
static void learn_c(insole_walker_ekf_t *walker, insole_turn_t told, insole_real_t var_rad2)
{
    insole_real_t e = insole_exp(-var_rad2), v = insole_square(walker->config.sigma_scale);
    insole_real_t most = HALF * (ONE + v); /* variances when nothing is known */
    insole_real_t scatter = HALF * insole_square(ONE - e) + HALF * v * (ONE + e * e);
    insole_real_t grow = most / insole_max(e * (ONE - most * e), LEAST_RAD2);
    insole_real_t across = insole_max(most * (ONE / (e * e) - ONE), var_rad2);
    insole_spot_t c = {walker->state.c.cos, walker->state.c.sin}, ahead = {told.cos, told.sin};
    insole_walker_seen_t seen[2] = {
        {insole_walker_column(INSOLE_WALKER_TURN, ahead),
         grow * insole_sqrt(e) - insole_spot_dot(ahead, c), grow * scatter},
        {insole_walker_column(INSOLE_WALKER_TURN, insole_spot_left(ahead)),
         -insole_spot_dot(insole_spot_left(ahead), c), across}};
    insole_walker_state_learn(&walker->state, seen, 2);
}

insole_status_t insole_walker_ekf_compass(insole_walker_ekf_t *walker, insole_real_t offset_rad,
                                          insole_real_t sigma_rad)
{
    if (!walker) {
        return INSOLE_ERR_NULL;
    }
    bool usable = insole_abs(offset_rad) <= MOST_ANGLE_RAD && sigma_rad >= LEAST_SIGMA_RAD &&
                  insole_is_finite(sigma_rad);
    if (!usable) {
        return refuse(walker, INSOLE_ERR_VALUE);
    }
    if (!walker->started) {
        return refuse(walker, INSOLE_ERR_STATE);
    }
    insole_real_t var_rad2 = insole_square(sigma_rad);
    insole_walker_seen_t seen = {
        insole_walker_column(INSOLE_WALKER_TURN, insole_spot(ONE, ZERO)),
        insole_wrap_pi(offset_rad - insole_walker_state_offset(&walker->state)), var_rad2};
    if (var_rad2 >= INSOLE_HEADING_MOST_R2) {
        return INSOLE_OK;
    }
    if (walker->state.is_wide) {
        learn_c(walker, insole_turn(offset_rad), var_rad2);
    } else {
        insole_walker_state_learn(&walker->state, &seen, 1);
    }
    insole_walker_state_settle(&walker->state);
    return INSOLE_OK;
}

insole_status_t insole_walker_ekf_answer(const insole_walker_ekf_t *walker,
                                         insole_walker_answer_t *answer)
{
    if (!walker || !answer) {
        return INSOLE_ERR_NULL;
    }
    if (!walker->started) {
        return INSOLE_ERR_STATE;
    }
    answer->spot = walker->state.spot;
    answer->cov_m2 = insole_spot_cov(insole_walker_cov_pair(&walker->state.P, INSOLE_WALKER_X));
    answer->offset_rad = insole_walker_state_offset(&walker->state);
    answer->var_offset_rad2 = insole_walker_state_var_offset(&walker->state);
    answer->scale = walker->state.scale;
    answer->var_scale = insole_walker_state_var_scale(&walker->state);
    return INSOLE_OK;
}
