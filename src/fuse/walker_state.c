/* SPDX-License-Identifier: MIT */
#include "insole/fuse/walker_state.h"

#include "insole/fuse/step_news.h"

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

/* Variance of the offset at which the two last states become c, and offset and scale again. */
static const insole_real_t WIDE_RAD2 = INSOLE_R(0.25), NARROW_RAD2 = INSOLE_R(0.1225);

/* Whoever rounds pi^2 / 3 otherwise means the same. */
static const insole_real_t UNKNOWN_RAD2 = INSOLE_R(0.999) * INSOLE_HEADING_MOST_R2;

/* Of the square of a mean direction, when nothing is left of it. */
static const insole_real_t LEAST_KEPT = INSOLE_R(1.0e-6);

/* sinh(pi^2 / 3) and more: nothing is known. */
static const insole_real_t MOST_ACROSS = INSOLE_R(13.4);

static const insole_real_t LEAST_SCALE = INSOLE_R(0.25), MOST_SCALE = INSOLE_R(4.0);

/* ---- the direction ------------------------------------------------------------------------- */

static insole_spot_t c_of(const insole_walker_state_t *state)
{
    return insole_spot(state->c.cos, state->c.sin);
}

insole_real_t insole_walker_kept(insole_real_t var_rad2)
{
    return var_rad2 < UNKNOWN_RAD2 ? insole_exp(-var_rad2) : LEAST_KEPT;
}

insole_spot_t insole_walker_scatter(insole_real_t left)
{
    return insole_spot(HALF * insole_square(ONE - left), HALF * (ONE - insole_square(left)));
}

/* The mean of what a way in n is multiplied by. */
static insole_turn_t factor(const insole_walker_state_t *state)
{
    if (state->is_wide) {
        return state->c;
    }
    insole_turn_t turn = insole_turn(state->offset_rad);
    insole_real_t size = state->scale * insole_exp(-HALF * insole_walker_state_turn(state).xx);
    turn.cos *= size;
    turn.sin *= size;
    return turn;
}

insole_walker_lever_t insole_walker_state_lever(const insole_walker_state_t *state,
                                                insole_spot_t way)
{
    insole_walker_lever_t lever = {insole_turn_way(factor(state), way), way, insole_spot_left(way)};
    if (!state->is_wide) {
        lever.by_first = insole_spot_left(lever.moved);
        lever.by_second = insole_spot_scale(ONE / state->scale, lever.moved);
    }
    return lever;
}

/* From offset and scale to c = scale exp(i offset): the exact moments when both are normal and
 * independent. The mean is that of the slope, too; what is not linear is noise. */
static void make_wide(insole_walker_state_t *state)
{
    insole_sym2_t S = insole_walker_state_turn(state);
    insole_turn_t turn = insole_turn(state->offset_rad), c = factor(state);
    insole_real_t e = insole_walker_kept(S.xx), root = insole_sqrt(e);
    insole_spot_t rest = insole_walker_scatter(e);
    insole_real_t size2 = insole_square(state->scale) + S.yy;
    insole_real_t along = size2 * rest.x_m, across = size2 * (rest.y_m - S.xx * e);
    insole_sym2_t N = insole_sym2_circle(ZERO);
    N = insole_sym2_add_outer(N, along, insole_spot(turn.cos, turn.sin));
    N = insole_sym2_add_outer(N, across, insole_spot(-turn.sin, turn.cos));
    insole_walker_cov_turn(&state->P, insole_spot(-c.sin, root * turn.cos),
                           insole_spot(c.cos, root * turn.sin));
    insole_walker_cov_add_pair(&state->P, INSOLE_WALKER_TURN, N);
    state->c = c;
    state->var_scale = S.yy;
    state->is_wide = true;
}

void insole_walker_state_wander(insole_walker_state_t *state, insole_real_t var_rad2)
{
    if (!state->is_wide && insole_walker_state_turn(state).xx + var_rad2 <= WIDE_RAD2) {
        insole_walker_cov_add(&state->P, var_rad2,
                              insole_walker_column(INSOLE_WALKER_TURN, insole_spot(ONE, ZERO)));
        return;
    }
    if (!state->is_wide) {
        make_wide(state);
    }
    insole_real_t e = insole_walker_kept(var_rad2), root = insole_sqrt(e);
    insole_spot_t c = c_of(state);
    insole_sym2_t M =
        insole_sym2_add_outer(insole_walker_state_turn(state), ONE, c); /* mean of c c' */
    insole_sym2_t N = insole_sym2_circle(HALF * (ONE - e * e) * (M.xx + M.yy));
    N = insole_sym2_add(N, insole_sym2_scale(M, e * e - e));
    insole_walker_cov_turn(&state->P, insole_spot(root, ZERO), insole_spot(ZERO, root));
    insole_walker_cov_add_pair(&state->P, INSOLE_WALKER_TURN, N);
    state->c.cos *= root;
    state->c.sin *= root;
}

insole_real_t insole_walker_state_var_scale(const insole_walker_state_t *state)
{
    return state->is_wide ? state->var_scale : insole_walker_state_turn(state).yy;
}

void insole_walker_state_stretch(insole_walker_state_t *state, insole_real_t variance,
                                 insole_real_t most)
{
    insole_real_t room = most - insole_walker_state_var_scale(state);
    insole_real_t more = insole_max(insole_min(variance, room), ZERO);
    if (state->is_wide) {
        state->var_scale += more;
    } else {
        insole_walker_cov_add(&state->P, more,
                              insole_walker_column(INSOLE_WALKER_TURN, insole_spot(ZERO, ONE)));
    }
}

/* Of the offset. Across c, in units of its length squared, the exact moments have sinh(variance).
 */
insole_real_t insole_walker_state_var_offset(const insole_walker_state_t *state)
{
    insole_sym2_t S = insole_walker_state_turn(state);
    if (!state->is_wide) {
        return insole_min(S.xx, INSOLE_HEADING_MOST_R2);
    }
    insole_spot_t c = c_of(state);
    insole_real_t across =
        insole_sym2_form(S, insole_spot_left(c)) / insole_square(insole_spot_dot(c, c));
    if (!(across < MOST_ACROSS)) {
        return INSOLE_HEADING_MOST_R2;
    }
    insole_real_t variance = insole_log(across + insole_sqrt(across * across + ONE));
    return insole_min(variance, INSOLE_HEADING_MOST_R2);
}

insole_real_t insole_walker_state_offset(const insole_walker_state_t *state)
{
    return state->is_wide ? insole_atan2(state->c.sin, state->c.cos) : state->offset_rad;
}

/* ---- what is learned ----------------------------------------------------------------------- */

static insole_real_t dot(const insole_walker_column_t *a, const insole_walker_column_t *b)
{
    insole_real_t sum = ZERO;
    for (int i = 0; i < INSOLE_WALKER_STATES; i++) {
        sum += a->at[i] * b->at[i];
    }
    return sum;
}

static insole_real_t within(insole_real_t x, insole_real_t low, insole_real_t high)
{
    return insole_min(insole_max(x, low), high);
}

static void shift(insole_walker_state_t *state, const insole_real_t *dx)
{
    state->bias = insole_spot_add(state->bias, insole_spot(dx[0], dx[1]));
    state->spot = insole_spot_add(state->spot, insole_spot(dx[2], dx[3]));
    if (state->is_wide) {
        state->c.cos += dx[4];
        state->c.sin += dx[5];
    } else {
        state->offset_rad = insole_wrap_pi(state->offset_rad + dx[4]);
        state->scale = within(state->scale + dx[5], LEAST_SCALE, MOST_SCALE);
    }
}

void insole_walker_state_learn(insole_walker_state_t *state, const insole_walker_seen_t *seen,
                               int count)
{
    insole_walker_cov_t P = state->P;
    insole_walker_column_t dx = {{ZERO, ZERO, ZERO, ZERO, ZERO, ZERO}};
    for (int k = 0; k < count; k++) {
        insole_real_t left = seen[k].innovation - dot(&seen[k].h, &dx);
        insole_walker_column_t K = insole_walker_cov_correct(&P, &seen[k].h, seen[k].variance);
        for (int i = 0; i < INSOLE_WALKER_STATES; i++) {
            dx.at[i] += left * K.at[i];
        }
    }
    insole_spot_t by = {dx.at[INSOLE_WALKER_X], dx.at[INSOLE_WALKER_X + 1]};
    if (insole_spot_is_in_reach(insole_spot_add(state->spot, by))) {
        state->P = P;
        shift(state, dx.at);
    }
}

/* The scale that rested, or what c tells, whichever is known better: nothing counts twice. */
static void recall_scale(insole_walker_state_t *state, insole_real_t rested)
{
    insole_real_t now = insole_walker_state_turn(state).yy, most = state->var_scale;
    if (now > most) {
        insole_real_t per = now / (now - most);
        insole_walker_seen_t seen = {
            insole_walker_column(INSOLE_WALKER_TURN, insole_spot(ZERO, ONE)),
            per * (rested - state->scale), per * most};
        insole_walker_state_learn(state, &seen, 1);
    }
}

void insole_walker_state_settle(insole_walker_state_t *state)
{
    insole_real_t variance = insole_walker_state_var_offset(state);
    if (!state->is_wide || variance > NARROW_RAD2) {
        return;
    }
    insole_spot_t c = c_of(state);
    insole_real_t length = insole_spot_norm(c), per = ONE / length;
    insole_real_t longer = insole_exp(HALF * variance), rested = state->scale;
    insole_walker_cov_turn(&state->P, insole_spot_scale(per * per, insole_spot_left(c)),
                           insole_spot_scale(per * longer, c));
    state->offset_rad = insole_atan2(c.y_m, c.x_m);
    state->scale = within(length * longer, LEAST_SCALE, MOST_SCALE);
    state->is_wide = false;
    recall_scale(state, rested);
}
