/* SPDX-License-Identifier: MIT */
#include "sim/hold.h"

#include "sim/seeds.h"

/* Places on a walker whose hips are 0.9 m over the soles. */
static const double usual_leg_m = 0.9;
static const sim_vec3_t chest_m = {0.36, 0.05, 1.18}, ear_m = {0.03, 0.09, 1.60};
static const sim_vec3_t shoulder_m = {0.0, 0.21, 1.38}, hip_m = {0.0, 0.11, 0.92};
static const sim_vec3_t down_arm_m = {0.03, 0.0, -0.66}, down_thigh_m = {0.09, 0.03, -0.20};
static const double forearm_m = 0.35;
static const double head_rock = 0.25;     /* of the hand's: an arm that is held to the head */
static const double largest_rock = 2.5;   /* times its mean */
static const double ear_tilt_rad = 0.5;   /* lower edge of the phone towards the mouth */
static const double arm_bend_rad = 0.1;   /* the elbow is never straight */
static const double arm_lag_s = 0.08;     /* of the arms behind the legs */
static const double usual_legs_rad = 0.4; /* upright to leg in a step of 0.7 m */
static const double sitting_turn = 0.15;  /* of the thigh: how it turns the phone about up */

static double normal(insole_rng_t *rng)
{
    return (double)insole_rng_normal(rng);
}

/* Any turn is as likely as any other. */
static sim_mat3_t any_turn(insole_rng_t *rng)
{
    double w = normal(rng), x = normal(rng), y = normal(rng), z = normal(rng);
    double n = w * w + x * x + y * y + z * z, s = 2.0 / n;
    sim_mat3_t m = {{1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                    {s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)},
                    {s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)}};
    return m;
}

/* Columns: the phone's right, top and screen. */
static sim_mat3_t of_axes(sim_vec3_t x, sim_vec3_t y, sim_vec3_t z)
{
    sim_mat3_t m = {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
    return m;
}

/* As a hand puts it there, without the error of the hold. */
static sim_mat3_t put(const sim_hold_t *hold, int32_t pose)
{
    double c, s;
    switch (pose) {
    case SIM_POSE_HAND: /* the screen looks up and back */
        c = cos(hold->settings.tilt_rad);
        s = sin(hold->settings.tilt_rad);
        return of_axes(sim_vec3(0.0, -1.0, 0.0), sim_vec3(c, 0.0, s), sim_vec3(-s, 0.0, c));
    case SIM_POSE_EAR: /* the screen looks at the head */
        c = cos(ear_tilt_rad);
        s = sin(ear_tilt_rad);
        return of_axes(sim_vec3(hold->side * c, 0.0, hold->side * s), sim_vec3(-s, 0.0, c),
                       sim_vec3(0.0, -hold->side, 0.0));
    case SIM_POSE_SWING: /* hangs from the hand, the screen to the thigh */
        return of_axes(sim_vec3(-hold->side, 0.0, 0.0), sim_vec3(0.0, 0.0, -1.0),
                       sim_vec3(0.0, -hold->side, 0.0));
    default: /* upright, the screen to the thigh */
        return of_axes(sim_vec3(0.0, -1.0, 0.0), sim_vec3(0.0, 0.0, 1.0), sim_vec3(-1.0, 0.0, 0.0));
    }
}

static bool is_turned_at_random(const sim_hold_t *hold, int32_t pose)
{
    int32_t mounting = hold->settings.mounting;
    return mounting == SIM_MOUNTING_RANDOM ||
           (mounting == SIM_MOUNTING_POCKET && pose == SIM_POSE_POCKET);
}

/* Draws the same amount of chance for every pose and mounting. */
static sim_mat3_t rest_of(const sim_hold_t *hold, int32_t pose, insole_rng_t *rng)
{
    const sim_phone_settings_t *s = &hold->settings;
    double roll = normal(rng), pitch = normal(rng), yaw = normal(rng);
    sim_vec3_t error = sim_vec3_scale(sim_vec3(roll, pitch, yaw), s->hold_rad);
    sim_mat3_t any = any_turn(rng);
    sim_mat3_t told = sim_mat3_from_euler(s->roll_rad, s->pitch_rad, s->yaw_rad);
    sim_mat3_t mounting = is_turned_at_random(hold, pose) ? any : told;
    return sim_mat3_mul(sim_mat3_from_turn(error), sim_mat3_mul(put(hold, pose), mounting));
}

void sim_hold_init(sim_hold_t *hold, const sim_phone_settings_t *settings, double leg_m,
                   uint64_t seed)
{
    insole_rng_t rng;
    sim_seed(&rng, seed, SIM_SEED_HOLD);
    hold->settings = *settings;
    hold->size = leg_m / usual_leg_m;
    hold->side = settings->side == SIM_LEFT ? 1.0 : -1.0;
    double rock = 1.0 + settings->rock_spread * normal(&rng);
    hold->rock = settings->rock * fmax(0.0, fmin(largest_rock, rock));
    for (int32_t pose = 0; pose < SIM_POSES; pose++) {
        hold->rest[pose] = rest_of(hold, pose, &rng);
    }
    for (int i = 0; i < 3; i++) {
        sim_waves_init(&hold->wander[i], 0.03, 0.4, &rng);
        sim_waves_init(&hold->tremor[i], 5.0, 11.0, &rng);
    }
}

/* A place on the body, on the side that carries. */
static sim_vec3_t on_body(const sim_hold_t *hold, sim_vec3_t place)
{
    return sim_vec3_scale(sim_vec3(place.x, hold->side * place.y, place.z), hold->size);
}

/* What hangs from a joint, swung ahead by an angle; `turn_rad` gets the turn. */
static sim_held_t hung(const sim_hold_t *hold, sim_vec3_t joint, sim_vec3_t lever,
                       sim_vec3_t turn_rad)
{
    sim_vec3_t to = sim_mat3_mul_vec(sim_mat3_from_turn(turn_rad), on_body(hold, lever));
    sim_held_t held = {sim_vec3_add(on_body(hold, joint), to), turn_rad};
    return held;
}

/* The elbow stays, the hand goes up and down with what moves the trunk. */
static sim_held_t in_hand(const sim_hold_t *hold, sim_vec3_t place, double rise_m)
{
    sim_held_t held = {on_body(hold, place), sim_vec3(0.0, -rise_m / forearm_m, 0.0)};
    held.at_m.z += rise_m;
    return held;
}

/* Arms swing against the legs. */
static sim_held_t in_swinging_hand(const sim_hold_t *hold, double thigh_rad)
{
    double legs = thigh_rad * hold->side / usual_legs_rad;
    double ahead_rad = -hold->settings.swing_rad * legs + arm_bend_rad;
    return hung(hold, shoulder_m, down_arm_m, sim_vec3(0.0, -ahead_rad, 0.0));
}

static sim_held_t in_pocket(const sim_hold_t *hold, const sim_trunk_motion_t *trunk)
{
    int own = hold->side > 0.0 ? SIM_LEFT : SIM_RIGHT;
    double ahead_rad = trunk->thigh_rad * hold->side + hold->settings.lift_rad * trunk->lift[own];
    sim_vec3_t turn = sim_vec3(0.0, -ahead_rad, sitting_turn * hold->side * ahead_rad);
    sim_held_t held = hung(hold, hip_m, down_thigh_m, turn);
    double jolt_m = hold->settings.thigh_mps2 * trunk->jolt_s2[own];
    held.at_m.x -= 0.5 * jolt_m;
    held.at_m.z += jolt_m;
    return held;
}

static sim_held_t moved(const sim_hold_t *hold, int32_t pose, const sim_torso_t *torso,
                        const sim_trunk_motion_t *trunk, double t_s)
{
    double rise_m = hold->rock * sim_torso_rise(torso, t_s - hold->settings.rock_lag_s);
    switch (pose) {
    case SIM_POSE_HAND:
        return in_hand(hold, chest_m, rise_m);
    case SIM_POSE_EAR:
        return in_hand(hold, ear_m, head_rock * rise_m);
    case SIM_POSE_SWING:
        return in_swinging_hand(hold, sim_torso_at(torso, t_s - arm_lag_s).thigh_rad);
    default:
        return in_pocket(hold, trunk);
    }
}

static sim_vec3_t three_waves(const sim_waves_t waves[3], double t_s)
{
    return sim_vec3(sim_waves_at(&waves[0], t_s), sim_waves_at(&waves[1], t_s),
                    sim_waves_at(&waves[2], t_s));
}

/* Looking at the screen: most about the axis to the left, least about up. */
static sim_vec3_t wandering(const sim_hold_t *hold, double t_s)
{
    sim_vec3_t w = sim_vec3_scale(three_waves(hold->wander, t_s), hold->settings.wander_rad);
    return sim_vec3(0.6 * w.x, w.y, 0.5 * w.z);
}

sim_held_t sim_hold_at(const sim_hold_t *hold, int32_t pose, const sim_torso_t *torso,
                       const sim_trunk_motion_t *trunk, double t_s)
{
    bool in_hands = pose != SIM_POSE_POCKET;
    sim_held_t held = moved(hold, pose, torso, trunk, t_s);
    held.turn_rad = sim_vec3_add(held.turn_rad, trunk->turn_rad);
    if (in_hands) {
        sim_vec3_t tremor = three_waves(hold->tremor, t_s);
        held.turn_rad = sim_vec3_add(held.turn_rad, wandering(hold, t_s));
        held.turn_rad = sim_vec3_add_scaled(held.turn_rad, hold->settings.tremor_rad, tremor);
    }
    return held;
}
