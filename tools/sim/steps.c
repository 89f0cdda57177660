/* SPDX-License-Identifier: MIT */
#include "sim/steps.h"

#include "insole/base/rng.h"
#include "sim/algebra.h"
#include "sim/seeds.h"

static const double always_s = -1000.0; /* strike of the feet that stand from the beginning */
static const double slowest_mps = 0.3;
static const double shortest_stance_s = 0.12;

typedef struct {
    const sim_route_t *route;
    const sim_walk_settings_t *walk;
    const sim_gait_settings_t *gait;
    insole_rng_t rng;
    sim_steps_t *steps;
    double now_s;             /* last strike, or end of the last standing */
    double speed_mps, pace_s; /* of the last step; a standing walker has speed 0 */
    int next_side;
} walker_t;

/* A step as planned along a section. */
typedef struct {
    double length_m, speed_mps;
} pace_t;

/* Never further than three sigmas: a step keeps its direction. */
static double normal(walker_t *w, double sigma)
{
    return sigma * fmax(-3.0, fmin(3.0, (double)insole_rng_normal(&w->rng)));
}

/* Where the foot of that side belongs when the body is at `body`. */
static sim_place_t foot_place(const walker_t *w, const sim_place_t *body, int side)
{
    sim_place_t place = *body;
    double offset = 0.5 * w->gait->width_m * side;
    place.x_m -= offset * sin(body->heading_rad);
    place.y_m += offset * cos(body->heading_rad);
    place.heading_rad += w->gait->toe_out_rad * side;
    return place;
}

/* A foot put down in passing is not where it was meant to be. */
static void vary_place(walker_t *w, sim_place_t *place)
{
    double sideways = normal(w, w->walk->place_spread_m);
    place->x_m -= sideways * sin(place->heading_rad);
    place->y_m += sideways * cos(place->heading_rad);
    place->heading_rad += normal(w, w->walk->toe_spread_rad);
}

/* The faster, the shorter is a foot on the ground. */
static double stance_share(const walker_t *w, sim_gait_kind_t kind, double speed_mps)
{
    if (kind == SIM_GAIT_RUN) {
        return fmax(0.25, w->gait->run_stance_share - 0.03 * (speed_mps - 2.5));
    }
    return fmin(0.75, w->gait->stance_share - 0.05 * (speed_mps - 1.2));
}

/* The foot must have stood for a moment before it swings again. */
static double swing_time(const walker_t *w, sim_gait_kind_t kind, double speed_mps, double pace_s,
                         double strike_s)
{
    double wanted = 2.0 * (1.0 - stance_share(w, kind, speed_mps)) * pace_s;
    size_t count = w->steps->steps.count;
    const sim_step_t *same_foot = sim_list_at(&w->steps->steps, count - 2);
    double room = strike_s - same_foot->strike_s;
    return fmin(wanted, fmax(0.4 * room, room - shortest_stance_s));
}

static bool add_step(walker_t *w, sim_gait_kind_t kind, const sim_place_t *place, double pace_s,
                     double speed_mps)
{
    /* whoever stands shifts their weight before the first foot leaves the ground */
    double shift_s = w->speed_mps > 0.0 ? 0.0 : 0.3 * pace_s;
    double strike_s = w->now_s + shift_s + pace_s;
    sim_step_t step = {.side = w->next_side,
                       .kind = kind,
                       .strike_s = strike_s,
                       .pace_s = pace_s,
                       .place = *place};
    step.swing_s = swing_time(w, kind, speed_mps, pace_s, strike_s);
    w->now_s = strike_s;
    w->pace_s = pace_s;
    w->speed_mps = speed_mps;
    w->next_side = -w->next_side;
    return sim_list_add(&w->steps->steps, &step);
}

static double step_length(const walker_t *w, double speed_mps)
{
    if (speed_mps > w->walk->run_above_mps) {
        return speed_mps / w->walk->run_rate_hz;
    }
    return w->walk->step_length_m * sqrt(speed_mps);
}

/* The next step from `s_m` on, by the speed allowed there and the speed of the last step. */
static pace_t next_pace(const walker_t *w, const sim_section_t *section, double s_m,
                        double last_mps)
{
    double accel = w->walk->accel_mps2;
    double change = 0.5 * accel; /* a step takes about half a second */
    double speed = sim_route_speed(w->route, section, s_m, accel);
    speed = fmax(last_mps - 2.0 * change, fmin(last_mps + change, speed));
    pace_t pace = {0.0, fmax(slowest_mps, speed)};
    pace.length_m = step_length(w, pace.speed_mps);
    return pace;
}

/* Whole steps that fill the section: the last one is kept if that is nearer to its length. */
static bool plan_paces(walker_t *w, const sim_section_t *section, sim_list_t *paces)
{
    double s = 0.0, speed = w->speed_mps, before = 0.0;
    while (s < section->length_m) {
        pace_t pace = next_pace(w, section, s, speed);
        before = s;
        s += pace.length_m;
        speed = pace.speed_mps;
        pace.length_m *= 1.0 + normal(w, w->walk->length_spread);
        if (!sim_list_add(paces, &pace)) {
            return false;
        }
    }
    if (paces->count > 1 && s - section->length_m > section->length_m - before) {
        paces->count--;
    }
    return true;
}

static double total_length(const sim_list_t *paces)
{
    double total = 0.0;
    for (size_t i = 0; i < paces->count; i++) {
        total += ((const pace_t *)sim_list_at(paces, i))->length_m;
    }
    return total;
}

/* The other foot is put beside the one that stands already. */
static bool close_feet(walker_t *w, sim_gait_kind_t kind, const sim_place_t *body)
{
    sim_place_t place = foot_place(w, body, w->next_side);
    return add_step(w, kind, &place, fmax(0.5, w->pace_s), 0.0);
}

static bool take_pace(walker_t *w, const sim_section_t *section, const pace_t *pace, double s_m,
                      bool standing)
{
    sim_place_t body = sim_route_at(w->route, section, s_m);
    sim_place_t place = foot_place(w, &body, w->next_side);
    if (!standing) {
        vary_place(w, &place);
    }
    sim_gait_kind_t kind = pace->speed_mps > w->walk->run_above_mps ? SIM_GAIT_RUN : SIM_GAIT_WALK;
    double pace_s = pace->length_m / pace->speed_mps;
    return add_step(w, section->kind == SIM_SECTION_STAIRS ? SIM_GAIT_STAIRS : kind, &place,
                    pace_s * (1.0 + normal(w, w->walk->time_spread)), pace->speed_mps);
}

static bool take_paces(walker_t *w, const sim_section_t *section, sim_list_t *paces)
{
    double stretch = section->length_m / total_length(paces), s = 0.0;
    bool stops = section->end_speed_mps <= 0.0;
    for (size_t i = 0; i < paces->count; i++) {
        pace_t *pace = sim_list_at(paces, i);
        pace->length_m *= stretch;
        s += pace->length_m;
        if (!take_pace(w, section, pace, s, stops && i + 1 == paces->count)) {
            return false;
        }
    }
    return !stops || close_feet(w, SIM_GAIT_WALK, &section->to);
}

static bool walk_section(walker_t *w, const sim_section_t *section)
{
    sim_list_t paces = sim_list(sizeof(pace_t));
    bool done = plan_paces(w, section, &paces) && take_paces(w, section, &paces);
    sim_list_free(&paces);
    return done;
}

/* One footfall per stair. */
static bool climb_section(walker_t *w, const sim_section_t *section)
{
    const sim_piece_t *piece = sim_list_at(&w->route->pieces, section->first_piece);
    double rise = fabs(section->to.z_m - section->from.z_m);
    int count = (int)fmax(1.0, round(rise / w->walk->riser_m));
    pace_t pace = {section->length_m / count, piece->speed_mps};
    for (int i = 1; i <= count; i++) {
        bool standing = i == count && section->end_speed_mps <= 0.0;
        if (!take_pace(w, section, &pace, pace.length_m * i, standing)) {
            return false;
        }
    }
    return section->end_speed_mps > 0.0 || close_feet(w, SIM_GAIT_STAIRS, &section->to);
}

/* Both feet turn about the same point, one after the other. */
static bool turn_section(walker_t *w, const sim_section_t *section)
{
    double turn = section->to.heading_rad - section->from.heading_rad;
    int count = (int)ceil(fabs(turn) / w->walk->spot_turn_rad);
    for (int i = 2; i <= 2 * count + 1; i++) {
        int pair = i / 2;
        sim_place_t body = section->from;
        body.heading_rad += turn * pair / count;
        sim_place_t place = foot_place(w, &body, w->next_side);
        if (!add_step(w, SIM_GAIT_SHUFFLE, &place, w->walk->spot_step_s, 0.0)) {
            return false;
        }
    }
    return true;
}

static bool take_section(walker_t *w, const sim_section_t *section)
{
    switch (section->kind) {
    case SIM_SECTION_STAND:
        w->now_s += section->seconds;
        return true;
    case SIM_SECTION_TURN:
        return turn_section(w, section);
    case SIM_SECTION_WALK:
        return walk_section(w, section);
    case SIM_SECTION_STAIRS:
        return climb_section(w, section);
    }
    return false;
}

static bool stand_at_start(walker_t *w, const sim_place_t *start)
{
    for (int side = SIM_SIDE_RIGHT; side <= SIM_SIDE_LEFT; side += 2) {
        sim_step_t step = {.side = side,
                           .kind = SIM_GAIT_SHUFFLE,
                           .strike_s = always_s,
                           .place = foot_place(w, start, side)};
        if (!sim_list_add(&w->steps->steps, &step)) {
            return false;
        }
    }
    w->next_side = SIM_SIDE_RIGHT;
    return true;
}

bool sim_steps_plan(const sim_route_t *route, const sim_place_t *start,
                    const sim_settings_t *settings, uint64_t seed, sim_steps_t *steps,
                    sim_error_t *error)
{
    walker_t walker = {.route = route,
                       .walk = &settings->walk,
                       .gait = &settings->gait,
                       .steps = steps,
                       .now_s = settings->walk.lead_in_s};
    sim_seed(&walker.rng, seed, SIM_SEED_STEPS);
    steps->steps = sim_list(sizeof(sim_step_t));
    bool done = stand_at_start(&walker, start);
    for (size_t i = 0; done && i < route->sections.count; i++) {
        done = take_section(&walker, sim_list_at(&route->sections, i));
    }
    if (!done) {
        sim_steps_free(steps);
        return sim_fail(error, "out of memory");
    }
    steps->end_s = walker.now_s + settings->walk.lead_out_s;
    return true;
}

void sim_steps_free(sim_steps_t *steps)
{
    sim_list_free(&steps->steps);
}
