/* SPDX-License-Identifier: MIT */
#include "sim/phone.h"

#include "sim/smooth.h"

bool sim_phone_plan(const sim_scenario_t *scenario, const sim_steps_t *steps, uint64_t seed,
                    sim_phone_t *phone, sim_error_t *error)
{
    const sim_settings_t *s = &scenario->settings;
    sim_person_t person = sim_person(&s->person, seed);
    if (!sim_torso_plan(steps, &s->person, &person, seed, &phone->torso, error)) {
        return false;
    }
    sim_hold_init(&phone->hold, &s->phone, person.leg_m, seed);
    if (sim_changes_plan(scenario, &phone->torso, steps->end_s, seed, &phone->changes, error)) {
        return true;
    }
    sim_torso_free(&phone->torso);
    return false;
}

void sim_phone_free(sim_phone_t *phone)
{
    sim_torso_free(&phone->torso);
    sim_changes_free(&phone->changes);
}

/* Number of the change that began last. */
static size_t change_at(const sim_phone_t *phone, double t_s)
{
    size_t number = 0;
    const sim_pose_change_t *next = sim_list_at(&phone->changes.poses, 1);
    while (next != NULL && next->t_s <= t_s) {
        number++;
        next = sim_list_at(&phone->changes.poses, number + 1);
    }
    return number;
}

static sim_vec3_t fidgeted(const sim_phone_t *phone, double t_s)
{
    sim_vec3_t turn = sim_vec3(0.0, 0.0, 0.0);
    for (size_t i = 0; i < phone->changes.fidgets.count; i++) {
        const sim_fidget_t *f = sim_list_at(&phone->changes.fidgets, i);
        double size = sim_hump((t_s - f->begin_s) / f->length_s);
        turn = sim_vec3_add_scaled(turn, size, f->turn_rad);
    }
    return turn;
}

static sim_vec3_t between(sim_vec3_t a, sim_vec3_t b, double share)
{
    return sim_vec3_add_scaled(sim_vec3_scale(a, 1.0 - share), share, b);
}

/* Part of the turn from a to b that a share of the way is. */
static sim_mat3_t part_of(sim_mat3_t a, sim_mat3_t b, double share)
{
    sim_mat3_t inverse = {
        {a.r0.x, a.r1.x, a.r2.x}, {a.r0.y, a.r1.y, a.r2.y}, {a.r0.z, a.r1.z, a.r2.z}};
    sim_vec3_t turn = sim_mat3_turn(sim_mat3_mul(inverse, b));
    return sim_mat3_mul(a, sim_mat3_from_turn(sim_vec3_scale(turn, share)));
}

sim_pose_t sim_phone_pose(const sim_phone_t *phone, double t_s)
{
    const sim_hold_t *hold = &phone->hold;
    sim_trunk_motion_t trunk = sim_torso_at(&phone->torso, t_s);
    size_t number = change_at(phone, t_s);
    const sim_pose_change_t *now = sim_list_at(&phone->changes.poses, number);
    sim_held_t held = sim_hold_at(hold, now->pose, &phone->torso, &trunk, t_s);
    sim_mat3_t rest = hold->rest[now->pose];
    double share = sim_ease((t_s - now->t_s) / hold->settings.change_s, 0.5, 0.5);
    if (number > 0 && share < 1.0) {
        const sim_pose_change_t *before = sim_list_at(&phone->changes.poses, number - 1);
        sim_held_t left = sim_hold_at(hold, before->pose, &phone->torso, &trunk, t_s);
        held.at_m = between(left.at_m, held.at_m, share);
        held.turn_rad = between(left.turn_rad, held.turn_rad, share);
        rest = part_of(hold->rest[before->pose], rest, share);
    }
    sim_vec3_t turn = sim_vec3_add(held.turn_rad, fidgeted(phone, t_s));
    sim_mat3_t heading = sim_mat3_from_euler(0.0, 0.0, trunk.heading_rad);
    sim_pose_t pose = {sim_vec3_add(trunk.position_m, sim_mat3_mul_vec(heading, held.at_m)),
                       sim_mat3_mul(heading, sim_mat3_mul(sim_mat3_from_turn(turn), rest))};
    return pose;
}
