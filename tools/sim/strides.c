/* SPDX-License-Identifier: MIT */
#include "sim/strides.h"

#include "sim/seeds.h"

static const double whole_stride_m = 1.4; /* the stride that the settings' angles are meant for */
static const double largest_scale = 1.15;
static const double long_stance_s = 1.5; /* who stands longer than this stands flat */
static const double longest_roll_s = 0.8;
static const double rise_share = 0.25; /* of the pitch toe down: the heel's rise before push-off */
static const double difference_s = 1e-3; /* for the derivatives at lift and strike */

/* Begin and end as shares of the swing: 0 at lift, 1 at strike. */
typedef struct {
    double begin, end, rise, fall;
} window_t;

typedef struct {
    window_t rise, push, fold, swing, land;
} timing_t;

static const timing_t walking = {{-0.57, 0.26, 0.70, 0.30},
                                 {-0.17, 0.29, 0.55, 0.32},
                                 {0.10, 0.40, 0.50, 0.50},
                                 {0.28, 0.95, 0.50, 0.15},
                                 {0.95, 1.33, 0.20, 0.75}};
static const timing_t running = {{-0.40, 0.10, 0.60, 0.30},
                                 {-0.30, 0.13, 0.40, 0.40},
                                 {0.03, 0.40, 0.30, 0.50},
                                 {0.33, 0.94, 0.40, 0.15},
                                 {0.94, 1.12, 0.40, 0.50}};

/* How far a stride's angles go, and what else it has of its kind. */
typedef struct {
    const timing_t *timing;
    double toe_off_rad, fold_rad, strike_rad, clearance_m, settle_mps, shock_mps2, shock_radps;
} style_t;

typedef struct {
    const sim_gait_settings_t *settings;
    insole_rng_t rng;
    sim_gait_t *gait;
} maker_t;

static style_t walking_style(const sim_gait_settings_t *s)
{
    style_t style = {&walking,       s->toe_off_rad, 0.0,           s->strike_rad,
                     s->clearance_m, s->settle_mps,  s->shock_mps2, s->shock_radps};
    return style;
}

static style_t style_of(const sim_gait_settings_t *s, const sim_step_t *step)
{
    style_t style = walking_style(s);
    if (step->kind == SIM_GAIT_RUN) {
        style.timing = &running;
        style.toe_off_rad = s->run_toe_off_rad;
        style.fold_rad = s->run_fold_rad;
        style.strike_rad = s->run_strike_rad;
        style.clearance_m = s->run_clearance_m;
        style.settle_mps = s->run_settle_mps;
        style.shock_mps2 = s->run_shock_mps2;
    }
    if (step->kind == SIM_GAIT_STAIRS) { /* the foot comes down flat, and stays clear of edges */
        style.toe_off_rad *= 0.6;
        style.strike_rad *= 0.1;
        style.clearance_m += 0.08;
    }
    return style;
}

static double uniform(maker_t *m, double low, double high)
{
    return low + (high - low) * (double)insole_rng_uniform(&m->rng);
}

/* Around 1, never further than three sigmas. */
static double varied(maker_t *m)
{
    double deviate = (double)insole_rng_normal(&m->rng);
    return 1.0 + m->settings->spread * fmax(-3.0, fmin(3.0, deviate));
}

static sim_transition_t transition(const sim_stride_t *stride, const window_t *window,
                                   double change_rad)
{
    double swing_s = stride->strike_s - stride->lift_s;
    sim_transition_t part = {stride->lift_s + window->begin * swing_s,
                             (window->end - window->begin) * swing_s, window->rise, window->fall,
                             change_rad};
    return part;
}

/* Shorter strides have smaller angles and softer shocks. */
static double scale_of(const sim_stride_t *stride)
{
    double length = hypot(stride->to.x_m - stride->from.x_m, stride->to.y_m - stride->from.y_m);
    return fmin(largest_scale, pow(length / whole_stride_m, 0.9));
}

static sim_vec3_t along_foot(const sim_place_t *place, double ahead, double left, double up)
{
    double sine = sin(place->heading_rad), cosine = cos(place->heading_rad);
    return sim_vec3(ahead * cosine - left * sine, ahead * sine + left * cosine, up);
}

static sim_shock_t make_shock(maker_t *m, const sim_stride_t *stride, const style_t *style)
{
    double wave = 2.0 * SIM_PI * m->settings->shock_hz * uniform(m, 0.85, 1.15);
    double scale = scale_of(stride), size = scale * scale * varied(m) / wave;
    double speed = scale * varied(m) * style->settle_mps;
    /* one draw a statement: the order of arguments is the compiler's */
    double up = uniform(m, 0.7, 1.0), left = uniform(m, -0.3, 0.3);
    double ahead = uniform(m, -0.8, -0.2);
    sim_vec3_t shake = along_foot(&stride->to, ahead, left, up);
    sim_shock_t shock = {.settle_mps = along_foot(&stride->to, 0.8 * speed,
                                                  uniform(m, -0.2, 0.2) * speed, -0.25 * speed),
                         .settle_s = m->settings->settle_s,
                         .shake_m = sim_vec3_scale(shake, -size * style->shock_mps2 / wave),
                         .pitch_rad = size * style->shock_radps,
                         .wave_radps = wave,
                         .decay_s = m->settings->shock_decay_s};
    return shock;
}

static void make_sway(maker_t *m, sim_stride_t *stride, int side)
{
    const sim_gait_settings_t *s = m->settings;
    stride->side_m = s->side_swing_m * side * varied(m);
    stride->roll_rad = s->swing_roll_rad * side * varied(m);
    stride->yaw_rad = s->swing_yaw_rad * side * varied(m);
    stride->roll_phase_rad = uniform(m, 0.0, 2.0);
    stride->yaw_phase_rad = uniform(m, -2.0, 0.0);
}

/* Everything but the roll in stance and the path in the air, which need the neighbours. */
static bool add_stride(maker_t *m, const sim_step_t *step, const sim_step_t *before)
{
    style_t style = style_of(m->settings, step);
    sim_stride_t stride = {.lift_s = step->strike_s - step->swing_s,
                           .strike_s = step->strike_s,
                           .from = before->place,
                           .to = step->place};
    double scale = scale_of(&stride);
    double down = style.toe_off_rad * scale * varied(m), up = style.strike_rad * scale * varied(m);
    double fold = style.fold_rad * scale * varied(m);
    const timing_t *timing = style.timing;
    stride.pitch[SIM_RISE] = transition(&stride, &timing->rise, -down * rise_share);
    stride.pitch[SIM_PUSH] = transition(&stride, &timing->push, -down * (1.0 - rise_share));
    stride.pitch[SIM_FOLD] = transition(&stride, &timing->fold, -fold);
    stride.pitch[SIM_SWING] = transition(&stride, &timing->swing, down + fold + up);
    stride.pitch[SIM_LAND] = transition(&stride, &timing->land, -up);
    stride.clearance_m = style.clearance_m * varied(m);
    stride.shock = make_shock(m, &stride, &style);
    make_sway(m, &stride, step->side);
    return sim_list_add(&m->gait->strides, &stride);
}

static bool add_strides(maker_t *m, const sim_list_t *steps, int side)
{
    const sim_step_t *before = NULL;
    for (size_t i = 0; i < steps->count; i++) {
        const sim_step_t *step = sim_list_at(steps, i);
        if (step->side != side) {
            continue;
        }
        if (before == NULL) {
            m->gait->home = step->place;
        } else if (!add_stride(m, step, before)) {
            return false;
        }
        before = step;
    }
    return true;
}

/* The foot lands a little toe up and rolls over to a little toe down; a standing one to flat. */
static void add_roll(maker_t *m, sim_stride_t *stride, sim_stride_t *next)
{
    sim_transition_t *land = &stride->pitch[SIM_LAND];
    double landed_s = land->begin_s + land->length_s;
    double stance_s = next == NULL ? 2.0 * long_stance_s : next->lift_s - stride->strike_s;
    double share = fmin(1.0, scale_of(stride)) * m->settings->flat_roll_rad;
    double after = 0.4 * share, end = stance_s > long_stance_s ? 0.0 : -0.6 * share;
    double begin_s = land->begin_s + 0.5 * land->length_s;
    double end_s = fmin(landed_s + longest_roll_s, stride->strike_s + stance_s);
    sim_transition_t roll = {begin_s, end_s - begin_s, 0.3, 0.7, end - after};
    land->change_rad += after;
    stride->pitch[SIM_ROLL] = roll;
    if (next != NULL) {
        next->pitch_before_rad = end;
        next->pitch[SIM_PUSH].change_rad -= end;
    }
}

static void begin_not_before(sim_transition_t *part, double t_s)
{
    double late_s = fmax(0.0, t_s - part->begin_s);
    part->begin_s += late_s;
    part->length_s -= late_s;
}

/* The heel must not rise before the foot is down, nor the landing end after it has left. */
static void fit_stance(sim_stride_t *stride, sim_stride_t *next)
{
    sim_transition_t *land = &stride->pitch[SIM_LAND];
    begin_not_before(&next->pitch[SIM_RISE], stride->strike_s);
    begin_not_before(&next->pitch[SIM_PUSH], stride->strike_s);
    land->length_s = fmin(land->length_s, 0.9 * (next->lift_s - land->begin_s));
}

static void join_strides(maker_t *m)
{
    sim_list_t *strides = &m->gait->strides;
    for (size_t i = 0; i < strides->count; i++) {
        sim_stride_t *stride = sim_list_at(strides, i), *next = sim_list_at(strides, i + 1);
        if (next != NULL) {
            fit_stance(stride, next);
        }
        add_roll(m, stride, next);
    }
}

/* Position, velocity and acceleration of a foot that rolls: of its origin, z: of its ball. */
typedef struct {
    sim_vec3_t p, v, a;
} rolling_t;

static rolling_t rolling_at(const sim_gait_t *gait, const sim_place_t *place, double t_s)
{
    sim_vec3_t p[5];
    for (int i = 0; i < 5; i++) {
        double pitch = sim_gait_pitch(gait, t_s + (i - 2) * difference_s);
        p[i] = sim_gait_rolled(gait, place, pitch);
        p[i].z += gait->ball_m * sin(pitch);
    }
    rolling_t state = {p[2], sim_vec3_derivative(p, difference_s),
                       sim_vec3_second_derivative(p, difference_s)};
    return state;
}

static sim_quintic_t join(double p0, double v0, double a0, double p1, double v1, double a1,
                          double length_s)
{
    sim_state1_t from = {p0, v0, a0}, to = {p1, v1, a1};
    return sim_quintic(from, to, length_s);
}

/* In the air: from rolling off to rolling on. */
static void make_swing(const sim_gait_t *gait, sim_stride_t *stride)
{
    double T = stride->strike_s - stride->lift_s;
    rolling_t off = rolling_at(gait, &stride->from, stride->lift_s);
    rolling_t on = rolling_at(gait, &stride->to, stride->strike_s);
    const sim_shock_t *shock = &stride->shock;
    on.p = sim_vec3_add_scaled(on.p, -shock->settle_s, shock->settle_mps);
    on.v = sim_vec3_add(on.v, shock->settle_mps);
    on.a = sim_vec3_add_scaled(on.a, -1.0 / shock->settle_s, shock->settle_mps);
    stride->x = join(off.p.x, off.v.x, off.a.x, on.p.x, on.v.x, on.a.x, T);
    stride->y = join(off.p.y, off.v.y, off.a.y, on.p.y, on.v.y, on.a.y, T);
    stride->ball = join(off.p.z, off.v.z, off.a.z, on.p.z, on.v.z, on.a.z, T);
}

static sim_tremble_t make_tremble(maker_t *m)
{
    sim_tremble_t waves;
    for (int i = 0; i < SIM_TREMBLE_WAVES; i++) {
        waves.wave_radps[i] = 2.0 * SIM_PI * uniform(m, 2.0, 9.0);
        waves.phase_rad[i] = uniform(m, 0.0, 2.0 * SIM_PI);
    }
    return waves;
}

bool sim_strides_plan(const sim_steps_t *steps, const sim_gait_settings_t *settings, uint64_t seed,
                      sim_gait_t *gait, sim_error_t *error)
{
    maker_t maker = {.settings = settings, .gait = gait};
    sim_seed(&maker.rng, seed, SIM_SEED_GAIT);
    gait->strides = sim_list(sizeof(sim_stride_t));
    gait->sole = sim_sole(settings->heel_m, settings->ball_m, settings->soft_rad);
    gait->ball_m = settings->ball_m;
    gait->wobble_rad = settings->wobble_rad;
    gait->still_rad = settings->still_rad;
    gait->roll = make_tremble(&maker);
    gait->pitch = make_tremble(&maker);
    gait->yaw = make_tremble(&maker);
    int side = settings->foot == SIM_FOOT_LEFT ? SIM_SIDE_LEFT : SIM_SIDE_RIGHT;
    if (!add_strides(&maker, &steps->steps, side)) {
        sim_strides_free(gait);
        return sim_fail(error, "out of memory");
    }
    join_strides(&maker);
    for (size_t i = 0; i < gait->strides.count; i++) {
        make_swing(gait, sim_list_at(&gait->strides, i));
    }
    return true;
}

void sim_strides_free(sim_gait_t *gait)
{
    sim_list_free(&gait->strides);
}
