/* SPDX-License-Identifier: MIT */
#include "sim/torso.h"

#include "sim/seeds.h"
#include "sim/smooth.h"

static const double gravity_mps2 = 9.81;
static const double rounding_s = 0.35;  /* half of the time in which the way changes its rate */
static const double shift_s = 0.3;      /* the same for the weight of a walker who sets off */
static const double whole_step_m = 0.7; /* the step that the settings' amounts are meant for */
static const double largest_size = 1.3;
static const double run_share = -0.4;   /* of the arc: a running leg gives way in mid-stance */
static const double dead_decays = 30.0; /* after that nothing is left of a ringing */
static const double always_s = -1000.0;

typedef struct {
    const sim_steps_t *steps;
    const sim_person_settings_t *settings;
    sim_torso_t *torso;
    double bounce;
    insole_rng_t rng;
} maker_t;

static double varied(maker_t *m)
{
    double normal = (double)insole_rng_normal(&m->rng);
    return 1.0 + m->settings->spread * fmax(-3.0, fmin(3.0, normal));
}

/* --- making --- */

static const sim_step_t *step_of(const maker_t *m, size_t number)
{
    return sim_list_at(&m->steps->steps, number);
}

/* Puts the trunk between the footfalls `number` and the one before it. */
static bool add_knot(maker_t *m, double t_s, size_t number)
{
    const sim_place_t *a = &step_of(m, number - 1)->place, *b = &step_of(m, number)->place;
    sim_way_knot_t *last = sim_list_at(&m->torso->knots, m->torso->knots.count - 1);
    double heading = a->heading_rad + 0.5 * sim_wrap_pi(b->heading_rad - a->heading_rad);
    sim_way_knot_t knot = {
        .t_s = t_s,
        .at = {0.5 * (a->x_m + b->x_m), 0.5 * (a->y_m + b->y_m), 0.5 * (a->z_m + b->z_m), heading}};
    if (m->torso->knots.count > 0) {
        knot.at[3] = last->at[3] + sim_wrap_pi(heading - last->at[3]);
        for (int i = 0; i < 4; i++) {
            last->rate[i] = (knot.at[i] - last->at[i]) / (t_s - last->t_s);
        }
    }
    return sim_list_add(&m->torso->knots, &knot);
}

static bool add_standing(maker_t *m, double begin_s, size_t number)
{
    const sim_place_t *a = &step_of(m, number - 1)->place, *b = &step_of(m, number)->place;
    sim_stance_t stance = {.begin_s = begin_s,
                           .length_s = 1.0,
                           .handover_s = shift_s,
                           .x_m = 0.5 * (a->x_m + b->x_m),
                           .y_m = 0.5 * (a->y_m + b->y_m)};
    return sim_list_add(&m->torso->stances, &stance);
}

/* How far the last piece of the way led. */
static double led_m(const maker_t *m)
{
    const sim_list_t *knots = &m->torso->knots;
    const sim_way_knot_t *a = sim_list_at(knots, knots->count - 2);
    const sim_way_knot_t *b = sim_list_at(knots, knots->count - 1);
    return hypot(b->at[0] - a->at[0], b->at[1] - a->at[1]);
}

/* Speed that the rise takes: v dv = -g dz, over the sine of one step. */
static double surge_of(const maker_t *m, double length_m, double pace_s, double bounce)
{
    double rise_m = bounce * length_m * length_m / (8.0 * m->torso->leg_m);
    double speed_mps = fmax(0.3, length_m / pace_s);
    double ripple_mps = m->settings->surge * gravity_mps2 * 0.5 * rise_m / speed_mps;
    return ripple_mps * pace_s / (2.0 * SIM_PI);
}

/* While the foot `number` swings, the one before it carries. */
static bool add_stance(maker_t *m, size_t number, bool sets_off)
{
    const sim_step_t *carrier = step_of(m, number - 1), *swung = step_of(m, number);
    double length_m = led_m(m), pace_s = swung->pace_s;
    double bounce = m->bounce * varied(m);
    sim_stance_t stance = {.begin_s = swung->strike_s - pace_s,
                           .length_s = pace_s,
                           .handover_s = sets_off ? shift_s : m->settings->handover * pace_s,
                           .x_m = carrier->place.x_m,
                           .y_m = carrier->place.y_m,
                           .side = carrier->side,
                           .bounce = swung->kind == SIM_GAIT_RUN ? run_share * bounce : bounce,
                           .size = fmin(largest_size, length_m / whole_step_m) * varied(m)};
    stance.leg_rad = asin(fmin(0.6, 0.5 * length_m / m->torso->leg_m)) * varied(m);
    stance.surge_m = surge_of(m, length_m, pace_s, stance.bounce) * varied(m);
    sim_jolt_t jolt = {swung->strike_s, stance.size * varied(m),
                       swung->side == SIM_SIDE_LEFT ? SIM_LEFT : SIM_RIGHT};
    return sim_list_add(&m->torso->stances, &stance) && sim_list_add(&m->torso->jolts, &jolt);
}

static bool add_step(maker_t *m, size_t number)
{
    const sim_step_t *step = step_of(m, number);
    double begin_s = step->strike_s - step->pace_s;
    double before_s = number == 2 ? always_s : step_of(m, number - 1)->strike_s;
    bool stood = begin_s > before_s + 1e-6;
    if (stood && !add_standing(m, before_s, number - 1)) {
        return false;
    }
    if (stood && !add_knot(m, begin_s, number - 1)) {
        return false;
    }
    return add_knot(m, step->strike_s, number) && add_stance(m, number, stood);
}

bool sim_torso_plan(const sim_steps_t *steps, const sim_person_settings_t *settings,
                    const sim_person_t *person, uint64_t seed, sim_torso_t *torso,
                    sim_error_t *error)
{
    maker_t maker = {
        .steps = steps, .settings = settings, .torso = torso, .bounce = person->bounce};
    sim_seed(&maker.rng, seed, SIM_SEED_TORSO);
    torso->settings = *settings;
    torso->leg_m = person->leg_m;
    torso->knots = sim_list(sizeof(sim_way_knot_t));
    torso->stances = sim_list(sizeof(sim_stance_t));
    torso->jolts = sim_list(sizeof(sim_jolt_t));
    size_t count = steps->steps.count;
    bool done = add_knot(&maker, always_s, 1);
    for (size_t i = 2; done && i < count; i++) {
        done = add_step(&maker, i);
    }
    const sim_step_t *last = step_of(&maker, count - 1);
    if (!done || !add_standing(&maker, last->strike_s, count - 1)) {
        sim_torso_free(torso);
        return sim_fail(error, "out of memory");
    }
    return true;
}

void sim_torso_free(sim_torso_t *torso)
{
    sim_list_free(&torso->knots);
    sim_list_free(&torso->stances);
    sim_list_free(&torso->jolts);
}

/* --- the way --- */

/* The last item whose first member, a time, is not after t; 0 when there is none. */
static size_t last_before(const sim_list_t *list, double t_s)
{
    size_t low = 0, high = list->count;
    while (low < high) {
        size_t half = low + (high - low) / 2;
        const double *begin_s = sim_list_at(list, half);
        if (*begin_s <= t_s) {
            low = half + 1;
        } else {
            high = half;
        }
    }
    return low == 0 ? 0 : low - 1;
}

/* What a rounded ramp is above the ramp max(0, u): the second integral of a hump (1 - u^2)^3 of
 * area 1, for |u| < 1. */
static double rounded(double u)
{
    double u2 = u * u;
    double ramp =
        35.0 / 32.0 * u2 * (0.5 + u2 * (-0.25 + u2 * (0.1 - u2 / 56.0))) + 0.5 * u + 35.0 / 256.0;
    return u > 0.0 ? ramp - u : ramp;
}

static void add_rounding(const sim_torso_t *torso, size_t number, double t_s, double at[4])
{
    const sim_way_knot_t *knot = sim_list_at(&torso->knots, number);
    const sim_way_knot_t *before = sim_list_at(&torso->knots, number - 1);
    double more = rounding_s * rounded((t_s - knot->t_s) / rounding_s);
    for (int i = 0; i < 4; i++) {
        at[i] += more * (knot->rate[i] - before->rate[i]);
    }
}

static bool is_near(const sim_torso_t *torso, size_t number, double t_s)
{
    const sim_way_knot_t *knot = sim_list_at(&torso->knots, number);
    return knot != NULL && fabs(t_s - knot->t_s) < rounding_s;
}

static void way_at(const sim_torso_t *torso, double t_s, double at[4])
{
    size_t number = last_before(&torso->knots, t_s);
    const sim_way_knot_t *knot = sim_list_at(&torso->knots, number);
    for (int i = 0; i < 4; i++) {
        at[i] = knot->at[i] + knot->rate[i] * (t_s - knot->t_s);
    }
    for (size_t i = number; i > 0 && is_near(torso, i, t_s); i--) {
        add_rounding(torso, i, t_s, at);
    }
    for (size_t i = number + 1; is_near(torso, i, t_s); i++) {
        add_rounding(torso, i, t_s, at);
    }
}

/* --- what comes on top --- */

/* l - sqrt(l^2 - d^2) by its series, which goes on where the leg would be too short. */
static double arc(double leg_m, double far2)
{
    double u = far2 / (leg_m * leg_m);
    return leg_m * u * (0.5 + u * (0.125 + u * 0.0625));
}

static double drop_of(const sim_torso_t *torso, const sim_stance_t *stance, const double way[4])
{
    double x = way[0] - stance->x_m, y = way[1] - stance->y_m;
    return stance->bounce * arc(torso->leg_m, x * x + y * y);
}

/* How much of the weight has come to a stance. */
static double arrived(const sim_stance_t *stance, double t_s)
{
    return sim_ease(0.5 + 0.5 * (t_s - stance->begin_s) / stance->handover_s, 0.5, 0.5);
}

/* Share of the weight that a stance carries; the shares of all have the sum 1. */
static double weight_of(const sim_torso_t *torso, size_t number, double t_s)
{
    const sim_stance_t *stance = sim_list_at(&torso->stances, number);
    const sim_stance_t *next = sim_list_at(&torso->stances, number + 1);
    return arrived(stance, t_s) - (next == NULL ? 0.0 : arrived(next, t_s));
}

static void add_stance_motion(const sim_torso_t *torso, const sim_stance_t *stance, double weight,
                              double t_s, sim_trunk_motion_t *now)
{
    const sim_person_settings_t *s = &torso->settings;
    double phase = SIM_PI * (t_s - stance->begin_s) / stance->length_s;
    double over = weight * stance->size * stance->side * sin(phase); /* the foot that carries */
    double apart = weight * stance->side * cos(phase);
    double hump = weight * sin(phase) * sin(phase);
    now->size += weight * stance->size;
    now->position_m.y += s->sway_m * over;
    now->position_m.x += weight * stance->surge_m * sin(2.0 * phase);
    now->turn_rad.x -= s->lean_rad * over;
    now->turn_rad.y += s->nod_rad * weight * stance->size * cos(2.0 * phase);
    now->turn_rad.z += s->twist_rad * stance->size * apart;
    now->thigh_rad += stance->leg_rad * apart;
    now->lift[SIM_RIGHT] += stance->side == SIM_SIDE_LEFT ? stance->size * hump : 0.0;
    now->lift[SIM_LEFT] += stance->side == SIM_SIDE_RIGHT ? stance->size * hump : 0.0;
}

static void add_jolts(const sim_torso_t *torso, double t_s, sim_trunk_motion_t *now)
{
    const sim_person_settings_t *s = &torso->settings;
    double wave = 2.0 * SIM_PI * s->strike_hz;
    if (torso->jolts.count == 0) {
        return;
    }
    for (size_t i = last_before(&torso->jolts, t_s) + 1; i > 0; i--) {
        const sim_jolt_t *jolt = sim_list_at(&torso->jolts, i - 1);
        double since_s = t_s - jolt->t_s;
        if (since_s > dead_decays * s->strike_decay_s) {
            return;
        }
        if (since_s > 0.0) {
            now->jolt_s2[jolt->foot] +=
                jolt->size * sim_ringing(wave, s->strike_decay_s, since_s) / (wave * wave);
        }
    }
}

/* Adds what the stances do whose weight has not come or gone altogether. */
static void add_stances(const sim_torso_t *torso, double t_s, const double way[4],
                        sim_trunk_motion_t *now)
{
    size_t middle = last_before(&torso->stances, t_s);
    for (size_t i = middle > 2 ? middle - 2 : 0; i <= middle + 2 && i < torso->stances.count; i++) {
        const sim_stance_t *stance = sim_list_at(&torso->stances, i);
        double weight = weight_of(torso, i, t_s);
        if (weight != 0.0) {
            now->rise_m -= weight * drop_of(torso, stance, way);
            add_stance_motion(torso, stance, weight, t_s, now);
        }
    }
}

/* All but the way. */
static sim_trunk_motion_t on_top(const sim_torso_t *torso, double t_s, const double way[4])
{
    sim_trunk_motion_t now = {.rise_m = 0.0};
    add_stances(torso, t_s, way, &now);
    add_jolts(torso, t_s, &now);
    now.rise_m += torso->settings.strike_mps2 * (now.jolt_s2[SIM_RIGHT] + now.jolt_s2[SIM_LEFT]);
    return now;
}

double sim_torso_rise(const sim_torso_t *torso, double t_s)
{
    double way[4];
    way_at(torso, t_s, way);
    return on_top(torso, t_s, way).rise_m;
}

sim_trunk_motion_t sim_torso_at(const sim_torso_t *torso, double t_s)
{
    double way[4];
    way_at(torso, t_s, way);
    sim_trunk_motion_t now = on_top(torso, t_s, way);
    double ahead = now.position_m.x, left = now.position_m.y;
    double c = cos(way[3]), s = sin(way[3]);
    now.position_m =
        sim_vec3(way[0] + c * ahead - s * left, way[1] + s * ahead + c * left, way[2] + now.rise_m);
    now.heading_rad = way[3];
    return now;
}
