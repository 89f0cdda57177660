/* SPDX-License-Identifier: MIT */
#include "insole/move/walk_heading.h"

#include <string.h>

#include "insole/base/sym2.h"
#include "insole/base/unscented.h"
#include "insole/move/heading.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)
#define HALF INSOLE_R(0.5)
#define TWO  INSOLE_R(2.0)

enum { N = 3, POINTS = 2 * N + 1 };

static const insole_real_t LARGEST_RAD2 = INSOLE_R(100.0);
static const insole_real_t FARTHEST_RAD = INSOLE_R(1.5);  /* tilt: the level plane stays in sight */
static const insole_real_t MOST_SPREAD = INSOLE_R(1.0e6); /* and of no end without scatter */
static const insole_real_t FIRST_WANDER = INSOLE_R(0.1);
static const insole_real_t LEAST_ORDER = INSOLE_R(0.002); /* of 1, of directions at random */
static const insole_real_t UNKNOWN_RAD2 = INSOLE_PI * INSOLE_PI / INSOLE_R(3.0);

const insole_walk_heading_config_t insole_walk_heading_defaults = {
    INSOLE_WALK_HEADING_KEYS(INSOLE_CONFIG_DEFAULT)};

static insole_status_t refuse(insole_walk_heading_t *walk, insole_status_t why)
{
    walk->refused++;
    return why;
}

insole_status_t insole_walk_heading_init(insole_walk_heading_t *walk,
                                         const insole_walk_heading_config_t *config)
{
    if (!walk || !config) {
        return INSOLE_ERR_NULL;
    }
    if (!(true INSOLE_WALK_HEADING_KEYS(INSOLE_CONFIG_IN_RANGE))) {
        return INSOLE_ERR_VALUE;
    }
    memset(walk, 0, sizeof *walk);
    walk->config = *config;
    return INSOLE_OK;
}

/* ---- samples ---------------------------------------------------------------------------- */

static bool is_unit(insole_quat_t q)
{
    insole_real_t norm2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    return insole_abs(norm2 - ONE) <= INSOLE_R(0.02);
}

static bool is_variance(insole_real_t v)
{
    return v >= ZERO && v <= LARGEST_RAD2;
}

static bool is_cov(const insole_sym3_t *P)
{
    insole_real_t most =
        insole_vec3_max_abs(insole_vec3(P->xy, P->xz, P->yz)); /* passes over what is none */
    return is_variance(P->xx) && is_variance(P->yy) && is_variance(P->zz) && most <= LARGEST_RAD2 &&
           insole_is_finite(P->xy + P->xz + P->yz);
}

insole_status_t insole_walk_heading_push(insole_walk_heading_t *walk, insole_quat_t q,
                                         const insole_sym3_t *cov_rad2, insole_vec3_t accel_mps2,
                                         uint64_t t_us)
{
    if (!walk || !cov_rad2) {
        return INSOLE_ERR_NULL;
    }
    if (!is_unit(q) || !is_cov(cov_rad2) || !insole_vec3_is_finite(accel_mps2)) {
        return refuse(walk, INSOLE_ERR_VALUE);
    }
    insole_heading_t device = insole_heading(q, cov_rad2);
    insole_vec3_t force_n = insole_quat_rotate(q, accel_mps2); /* [PhoneUKF (20)-(22)] */
    insole_status_t status =
        insole_gait_motion_push(&walk->motion, force_n, device.heading_rad, t_us);
    if (status != INSOLE_OK) {
        return refuse(walk, status);
    }
    walk->cov_rad2 = *cov_rad2;
    walk->device_var_rad2 = device.variance_rad2;
    return INSOLE_OK;
}

/* ---- axes ------------------------------------------------------------------------------- */

/* Scatter across the level plane. */
static insole_sym2_t level_part(insole_sym3_t S)
{
    return insole_sym2(S.xx, S.xy, S.yy);
}

/* Direction of the largest energy, counted from x; where the energy is least lies a quarter turn
 * away. [PhoneUKF (25), (29)] counts from y and leaves the quadrant open. */
static insole_real_t axis_of(insole_sym2_t A)
{
    return HALF * insole_atan2(TWO * A.xy, A.xx - A.yy);
}

/* One of the methods applied to a window: an angle, and all that tells how it moves with a tilt. */
typedef struct {
    bool is_axis;         /* of S; else the direction of `way` */
    insole_sym3_t S;      /* scatter, n */
    insole_vec3_t way;    /* n */
    insole_real_t rad;    /* the angle as the attitude stands */
    insole_real_t spread; /* what is across it over what is along */
    insole_spot_t pull;   /* evidence: longer and along the walk, the better */
} look_t;

/* How far the angle moves when the attitude is tilted: f(q). */
static insole_real_t angle_when_tilted(const look_t *look, insole_turn_t ahead, insole_real_t x_rad,
                                       insole_real_t y_rad)
{
    insole_vec3_t tilt = insole_vec3(x_rad, y_rad, ZERO);
    insole_real_t far = insole_vec3_norm(tilt);
    tilt = far > FARTHEST_RAD ? insole_vec3_scale(tilt, FARTHEST_RAD / far) : tilt;
    insole_mat3_t E = insole_quat_to_mat3(insole_quat_from_rotvec(tilt));
    /* rows of C Q, [PhoneUKF (23)-(24)] */
    insole_vec3_t along =
        insole_vec3_add_scaled(insole_vec3_scale(E.r0, ahead.cos), ahead.sin, E.r1);
    insole_vec3_t across =
        insole_vec3_add_scaled(insole_vec3_scale(E.r1, ahead.cos), -ahead.sin, E.r0);
    if (!look->is_axis) {
        return insole_atan2(insole_vec3_dot(across, look->way), insole_vec3_dot(along, look->way));
    }
    insole_vec3_t S_along = insole_sym3_mul_vec(look->S, along);
    insole_vec3_t S_across = insole_sym3_mul_vec(look->S, across);
    insole_sym2_t A = insole_sym2(insole_vec3_dot(along, S_along), insole_vec3_dot(across, S_along),
                                  insole_vec3_dot(across, S_across));
    return axis_of(A); /* [PhoneUKF (30)] */
}

/* Mean and variance of the angle over the errors of the attitude. One about the vertical adds to
 * the angle as it is, however large; f is curved in the tilt alone. */
static void through_attitude(const look_t *look, insole_sym3_t P, insole_real_t *mean_rad,
                             insole_real_t *variance_rad2)
{
    const insole_real_t A[N * N] = {P.xx, ZERO, ZERO, P.xy, P.yy, ZERO, P.xz, P.yz, P.zz};
    static const insole_real_t middle[N];
    insole_unscented_t ut = insole_unscented(N, ONE, TWO, ZERO);
    insole_real_t root[N * N], points[POINTS * N], values[POINTS];
    insole_turn_t ahead = insole_turn(look->rad);
    (void)insole_cholesky(N, A, root);
    insole_unscented_points(&ut, middle, root, points);
    const insole_real_t *a = points;
    for (uint32_t i = 0u; i < POINTS; i++, a += N) {
        values[i] = angle_when_tilted(look, ahead, a[0], a[1]) + a[2];
    }
    insole_unscented_mean(&ut, 1u, values, mean_rad);
    insole_unscented_cov(&ut, 1u, values, mean_rad, 1u, values, mean_rad, variance_rad2);
}

/* ---- methods ---------------------------------------------------------------------------- */

/* Variances along the principal axis and across it. */
typedef struct {
    insole_real_t most, least;
} energies_t;

static energies_t energies_of(insole_sym2_t A)
{
    insole_real_t most = insole_sym2_largest(A);
    energies_t e = {most, insole_max(A.xx + A.yy - most, ZERO)};
    return e;
}

/* Correlation of the level acceleration with the reference. */
static insole_spot_t pull_of(const insole_gait_moments_t *m, energies_t e)
{
    insole_real_t power = m->reference * e.most;
    insole_real_t per = power > ZERO ? ONE / insole_sqrt(power) : ZERO;
    return insole_spot(per * m->in_phase.x, per * m->in_phase.y);
}

static look_t by_axis(const insole_gait_moments_t *m, energies_t e)
{
    look_t look = {.is_axis = true, .S = m->scatter, .rad = axis_of(level_part(m->scatter))};
    look.pull = pull_of(m, e);
    look.spread = e.most * e.least / insole_square(e.most - e.least);
    return look;
}

static look_t by_way(insole_vec3_t way)
{
    look_t look = {.way = way, .rad = insole_atan2(way.y, way.x)};
    return look;
}

/* Paper, 2 and 7.2: at one moment of the step the forward acceleration dominates. */
static look_t by_moment(const insole_gait_moments_t *m, energies_t e)
{
    look_t look = by_way(m->falling_mps2);
    insole_real_t strength = insole_square(insole_vec3_level(look.way));
    look.spread = e.least / strength;
    insole_real_t per = ONE / insole_sqrt(TWO * e.most);
    look.pull = insole_spot(per * look.way.x, per * look.way.y);
    return look;
}

static look_t by_gait(const insole_gait_moments_t *m, energies_t e)
{
    look_t look = by_way(m->in_phase);
    look.pull = pull_of(m, e);
    look.spread = e.least / (insole_spot_dot(look.pull, look.pull) * e.most);
    return look;
}

static look_t look_by(int32_t method, const insole_gait_moments_t *m, energies_t e)
{
    if (method == INSOLE_WALK_HEADING_UDIRECT) {
        return by_moment(m, e);
    }
    return method == INSOLE_WALK_HEADING_GAIT ? by_gait(m, e) : by_axis(m, e);
}

/* ---- steps ------------------------------------------------------------------------------ */

static insole_walk_heading_row_t joined(insole_walk_heading_row_t row,
                                        const insole_footfall_t *footfall)
{
    bool follows = row.count > 0u && row.end_us == footfall->begin_us;
    row.count = follows ? row.count : 0u;
    for (uint32_t i = INSOLE_WALK_HEADING_STEPS - 1u; i > 0u; i--) {
        row.begins_us[i] = row.begins_us[i - 1u];
    }
    row.begins_us[0] = footfall->begin_us;
    row.end_us = footfall->end_us;
    row.count += row.count < INSOLE_WALK_HEADING_STEPS ? 1u : 0u;
    return row;
}

/* The newest steps, as many as shall be looked at and are still remembered. */
static insole_gait_window_t window_of(const insole_walk_heading_t *walk,
                                      const insole_walk_heading_row_t *row)
{
    const insole_walk_heading_config_t *c = &walk->config;
    uint32_t steps = c->method == INSOLE_WALK_HEADING_UDIRECT ? 1u : (uint32_t)c->steps;
    steps = steps < row->count ? steps : row->count;
    while (steps > 1u && !insole_gait_motion_reaches(&walk->motion, row->begins_us[steps - 1u])) {
        steps--;
    }
    insole_gait_window_t window = {row->begins_us[steps - 1u], row->end_us, steps, c->lead_rad};
    return window;
}

/* Gathers evidence, then takes the end of the axis that it is for. */
static void choose_end(insole_walk_heading_t *walk, insole_real_t rad, insole_spot_t pull,
                       insole_real_t pause_s, insole_walked_t *walked)
{
    const insole_walk_heading_config_t *c = &walk->config;
    insole_real_t kept = c->keep_share * insole_exp(-pause_s / c->forget_s);
    walk->pull = insole_spot_add_scaled(pull, kept, walk->pull);
    insole_turn_t turn = insole_turn(rad);
    insole_real_t evidence = insole_spot_dot(walk->pull, insole_spot(turn.cos, turn.sin));
    rad += evidence < ZERO ? INSOLE_PI : ZERO;
    walked->direction_rad = insole_wrap_pi(rad); /* [PhoneUKF (31)] */
    walked->evidence = insole_abs(evidence);
    walked->is_certain = walked->evidence >= c->certain_evidence;
}

/* Variance of a direction from how axes differed from each other lately: were the differences
 * normal, the mean of their sine squared would be (1 - exp(-2 variance)) / 2. */
static insole_real_t wander_of(insole_walk_heading_t *walk, insole_real_t rad)
{
    const insole_walk_heading_config_t *c = &walk->config;
    insole_real_t apart = insole_square(insole_sin(rad - walk->axis_rad));
    walk->wander = walk->has_axis ? apart + c->keep_share * (walk->wander - apart) : FIRST_WANDER;
    walk->has_axis = true;
    walk->axis_rad = rad;
    insole_real_t order = insole_max(ONE - TWO * walk->wander, LEAST_ORDER);
    return -HALF * c->wander_share * insole_log(order);
}

/* What the attitude does not know of its tilt is added. */
static insole_sym3_t cov_of(const insole_walk_heading_t *walk)
{
    insole_real_t tilt_rad2 = insole_square(walk->config.sigma_tilt_rad);
    return insole_sym3_add(walk->cov_rad2, insole_sym3_diagonal(tilt_rad2, tilt_rad2, ZERO));
}

/* From one walk to the next. */
static insole_real_t pause_before(const insole_walk_heading_t *walk,
                                  const insole_walk_heading_row_t *row)
{
    bool paused = row->count == 1u && walk->row.count > 0u && row->begins_us[0] > walk->row.end_us;
    return paused ? insole_seconds(walk->row.end_us, row->begins_us[0]) : ZERO;
}

/* What is seen of a step, and of those before it that are looked at with it. */
typedef struct {
    insole_gait_moments_t moments;
    energies_t energies;
    insole_real_t pause_s; /* before them */
} seen_t;

static void find_direction(insole_walk_heading_t *walk, const seen_t *seen, insole_walked_t *walked)
{
    const insole_walk_heading_config_t *c = &walk->config;
    look_t look = look_by(c->method, &seen->moments, seen->energies);
    insole_sym3_t P = cov_of(walk);
    insole_real_t off_rad, variance_rad2; /* of the small angle, [PhoneUKF (19)] */
    through_attitude(&look, P, &off_rad, &variance_rad2);
    /* A bounce seen at a slant is no motion ahead. */
    insole_real_t feigned = HALF * (P.xx + P.yy) * seen->moments.scatter.zz;
    insole_real_t trust = seen->energies.most / (seen->energies.most + feigned);
    insole_spot_t pull = insole_spot(trust * look.pull.x_m, trust * look.pull.y_m);
    choose_end(walk, look.rad + off_rad, pull, seen->pause_s, walked);
    walked->variance_rad2 = variance_rad2 + insole_square(c->sigma_rad) +
                            wander_of(walk, look.rad) +
                            c->scatter_share * insole_min(look.spread, MOST_SPREAD);
}

static void find_device(const insole_walk_heading_t *walk, const seen_t *seen,
                        insole_walked_t *walked)
{
    walked->direction_rad = seen->moments.device_rad;
    walked->variance_rad2 = walk->device_var_rad2;
    walked->evidence = ZERO;
    walked->is_certain = true;
}

static void answer(insole_walk_heading_t *walk, const seen_t *seen, insole_walked_t *walked)
{
    walked->t_us = walk->row.end_us;
    walked->rms_mps2 = insole_sqrt(seen->energies.most);
    walked->ratio = seen->energies.least / seen->energies.most;
    if (walk->config.method == INSOLE_WALK_HEADING_DEVICE) {
        find_device(walk, seen, walked);
    } else {
        find_direction(walk, seen, walked);
    }
    walked->variance_rad2 = insole_min(walked->variance_rad2, UNKNOWN_RAD2);
}

insole_status_t insole_walk_heading_step(insole_walk_heading_t *walk,
                                         const insole_footfall_t *footfall, insole_walked_t *walked)
{
    if (!walk || !footfall || !walked) {
        return INSOLE_ERR_NULL;
    }
    if (footfall->begin_us >= footfall->end_us ||
        (walk->row.count > 0u && footfall->end_us <= walk->row.end_us)) {
        return refuse(walk, INSOLE_ERR_TIME);
    }
    insole_walk_heading_row_t row = joined(walk->row, footfall);
    insole_gait_window_t window = window_of(walk, &row);
    seen_t seen;
    insole_status_t status = insole_gait_motion_look(&walk->motion, &window, &seen.moments);
    if (status != INSOLE_OK) {
        return refuse(walk, status);
    }
    seen.energies = energies_of(level_part(seen.moments.scatter));
    if (!(seen.energies.most >= insole_square(walk->config.least_mps2))) {
        return refuse(walk, INSOLE_ERR_STATE);
    }
    seen.pause_s = pause_before(walk, &row);
    walk->row = row;
    answer(walk, &seen, walked);
    return INSOLE_OK;
}
