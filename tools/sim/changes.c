/* SPDX-License-Identifier: MIT */
#include "sim/changes.h"

#include "sim/seeds.h"

static const double shortest_carry = 3.0;   /* between two changes drawn by seed, in changes */
static const double least_standing_s = 1.5; /* a walker who stands for less does not fidget */
static const double shortest_fidget_s = 1.2, longest_fidget_s = 3.0;
static const double largest_turn = 2.0; /* sigmas */

static double uniform(insole_rng_t *rng)
{
    return (double)insole_rng_uniform(rng);
}

/* --- ways to carry --- */

static bool add_pose(sim_changes_t *changes, double t_s, int32_t pose, sim_error_t *error)
{
    sim_pose_change_t change = {.t_s = t_s, .pose = pose};
    return sim_list_add(&changes->poses, &change) || sim_fail(error, "out of memory");
}

/* The change before must be over. */
static bool take_poses(sim_changes_t *changes, const sim_scenario_t *scenario, sim_error_t *error)
{
    double free_s = 0.0;
    for (size_t i = 0; i < scenario->changes.count; i++) {
        const sim_pose_change_t *change = sim_list_at(&scenario->changes, i);
        if (change->t_s < free_s) {
            sim_fail(error, "pose at %g s, expected not before %g s", change->t_s, free_s);
            return sim_fail_on_line(error, change->line);
        }
        free_s = change->t_s + scenario->settings.phone.change_s;
        if (!add_pose(changes, change->t_s, change->pose, error)) {
            return false;
        }
    }
    return true;
}

static bool draw_poses(sim_changes_t *changes, const sim_phone_settings_t *phone, double end_s,
                       uint64_t seed, sim_error_t *error)
{
    insole_rng_t rng;
    int32_t pose = phone->pose;
    double t_s = 0.0;
    sim_seed(&rng, seed, SIM_SEED_CHANGES);
    for (;;) {
        double carried_s = -phone->change_every_s * log(1.0 - uniform(&rng));
        t_s += fmax(shortest_carry * phone->change_s, carried_s);
        if (t_s + phone->change_s > end_s) {
            return true;
        }
        pose = (pose + 1 + (int32_t)((SIM_POSES - 1) * uniform(&rng))) % SIM_POSES;
        if (!add_pose(changes, t_s, pose, error)) {
            return false;
        }
    }
}

static bool plan_poses(sim_changes_t *changes, const sim_scenario_t *scenario, double end_s,
                       uint64_t seed, sim_error_t *error)
{
    const sim_phone_settings_t *phone = &scenario->settings.phone;
    if (!add_pose(changes, 0.0, phone->pose, error)) {
        return false;
    }
    if (scenario->changes.count > 0) {
        return take_poses(changes, scenario, error);
    }
    return phone->change_every_s <= 0.0 || draw_poses(changes, phone, end_s, seed, error);
}

/* --- fidgeting --- */

static double drawn_turn(insole_rng_t *rng, double sigma_rad)
{
    return sigma_rad * fmax(-largest_turn, fmin(largest_turn, (double)insole_rng_normal(rng)));
}

static bool fidget(sim_changes_t *changes, const sim_phone_settings_t *phone, double begin_s,
                   double end_s, insole_rng_t *rng)
{
    double t_s = begin_s;
    for (;;) {
        t_s -= log(1.0 - uniform(rng)) / phone->fidgets_hz;
        double length_s = shortest_fidget_s + (longest_fidget_s - shortest_fidget_s) * uniform(rng);
        double x = drawn_turn(rng, phone->fidget_rad), y = drawn_turn(rng, phone->fidget_rad);
        sim_fidget_t f = {t_s, length_s, sim_vec3(x, y, drawn_turn(rng, phone->fidget_rad))};
        if (t_s + length_s > end_s) {
            return true;
        }
        if (!sim_list_add(&changes->fidgets, &f)) {
            return false;
        }
        t_s += length_s;
    }
}

static bool plan_fidgets(sim_changes_t *changes, const sim_phone_settings_t *phone,
                         const sim_torso_t *torso, double end_s, uint64_t seed)
{
    insole_rng_t rng;
    sim_seed(&rng, seed, SIM_SEED_FIDGETS);
    for (size_t i = 0; phone->fidgets_hz > 0.0 && i < torso->stances.count; i++) {
        const sim_stance_t *stance = sim_list_at(&torso->stances, i);
        const sim_stance_t *next = sim_list_at(&torso->stances, i + 1);
        double begin_s = fmax(0.0, stance->begin_s), stop_s = next == NULL ? end_s : next->begin_s;
        if (stance->side == 0 && stop_s - begin_s > least_standing_s &&
            !fidget(changes, phone, begin_s, stop_s, &rng)) {
            return false;
        }
    }
    return true;
}

bool sim_changes_plan(const sim_scenario_t *scenario, const sim_torso_t *torso, double end_s,
                      uint64_t seed, sim_changes_t *changes, sim_error_t *error)
{
    changes->poses = sim_list(sizeof(sim_pose_change_t));
    changes->fidgets = sim_list(sizeof(sim_fidget_t));
    bool good = plan_poses(changes, scenario, end_s, seed, error);
    if (good && !plan_fidgets(changes, &scenario->settings.phone, torso, end_s, seed)) {
        good = sim_fail(error, "out of memory");
    }
    if (!good) {
        sim_changes_free(changes);
    }
    return good;
}

void sim_changes_free(sim_changes_t *changes)
{
    sim_list_free(&changes->poses);
    sim_list_free(&changes->fidgets);
}
