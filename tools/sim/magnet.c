/* SPDX-License-Identifier: MIT */
#include "sim/magnet.h"

static const double ut_m3_per_am2 = 0.1; /* mu0 / (4 pi) */
static const double piece_m = 0.5;       /* half the size of a piece: nowhere is it a point */
static const double lowest_m = -0.3, highest_m = 3.2;
enum { MOST_PIECES = 5000 };

static double normal(insole_rng_t *rng)
{
    return (double)insole_rng_normal(rng);
}

static sim_vec3_t normal3(insole_rng_t *rng, double sigma)
{
    double x = normal(rng), y = normal(rng), z = normal(rng);
    return sim_vec3(sigma * x, sigma * y, sigma * z);
}

static double between(insole_rng_t *rng, double low, double high)
{
    return low + (high - low) * (double)insole_rng_uniform(rng);
}

static bool add_steel(sim_magnet_t *magnet, const sim_plan_t *plan, uint64_t building)
{
    sim_point_t low, high;
    insole_rng_t rng;
    if (!sim_plan_box(plan, &low, &high)) {
        return true;
    }
    double area_m2 = (high.x_m - low.x_m) * (high.y_m - low.y_m);
    double count = fmin(MOST_PIECES, area_m2 / magnet->settings.steel_m2);
    sim_seed(&rng, building, SIM_SEED_STEEL);
    for (int i = 0; i < (int)count; i++) {
        double x = between(&rng, low.x_m, high.x_m), y = between(&rng, low.y_m, high.y_m);
        double z = between(&rng, lowest_m, highest_m);
        sim_steel_t piece = {sim_vec3(x, y, z), normal3(&rng, magnet->settings.steel_am2)};
        if (!sim_list_add(&magnet->steel, &piece)) {
            return false;
        }
    }
    return true;
}

static sim_vec3_t earth_field(const sim_magnet_settings_t *s)
{
    double level = s->field_ut * cos(s->dip_rad);
    return sim_vec3(level * sin(s->declination_rad), level * cos(s->declination_rad),
                    -s->field_ut * sin(s->dip_rad));
}

/* What belongs to the phone. */
static void draw_unit(sim_magnet_t *magnet, uint64_t seed)
{
    const sim_magnet_settings_t *s = &magnet->settings;
    insole_rng_t unit;
    sim_seed(&unit, seed, SIM_SEED_MAGNET_UNIT);
    sim_seed(&magnet->noise, seed, SIM_SEED_MAGNET_NOISE);
    bool full = s->model == SIM_MAGNET_FULL;
    magnet->hard_ut = normal3(&unit, full ? s->hard_ut : 0.0);
    magnet->soft = sim_mat3_identity();
    if (full) {
        magnet->soft.r0 = sim_vec3_add(magnet->soft.r0, normal3(&unit, s->soft));
        magnet->soft.r1 = sim_vec3_add(magnet->soft.r1, normal3(&unit, s->soft));
        magnet->soft.r2 = sim_vec3_add(magnet->soft.r2, normal3(&unit, s->soft));
    }
}

bool sim_magnet_open(sim_magnet_t *magnet, const sim_scenario_t *scenario, uint64_t seed,
                     sim_error_t *error)
{
    uint64_t number = (uint64_t)scenario->settings.radio.building;
    magnet->settings = scenario->settings.magnet;
    magnet->earth_ut = earth_field(&magnet->settings);
    magnet->steel = sim_list(sizeof(sim_steel_t));
    draw_unit(magnet, seed);
    if (add_steel(magnet, &scenario->plan, number == 0 ? seed : number)) {
        return true;
    }
    sim_magnet_close(magnet);
    return sim_fail(error, "out of memory");
}

/* 3 (m r) r / r^5 - m / r^3, with a distance that never is 0. */
static sim_vec3_t dipole_field(const sim_steel_t *piece, sim_vec3_t at_m)
{
    sim_vec3_t r = sim_vec3_sub(at_m, piece->at_m);
    double far2 = sim_vec3_dot(r, r) + piece_m * piece_m;
    double scale = ut_m3_per_am2 / (far2 * sqrt(far2));
    double along = 3.0 * sim_vec3_dot(piece->moment_am2, r) / far2;
    return sim_vec3_scale(sim_vec3_add_scaled(sim_vec3_scale(r, along), -1.0, piece->moment_am2),
                          scale);
}

sim_vec3_t sim_magnet_field(const sim_magnet_t *magnet, sim_vec3_t at_m)
{
    sim_vec3_t field = magnet->earth_ut;
    for (size_t i = 0; i < magnet->steel.count; i++) {
        field = sim_vec3_add(field, dipole_field(sim_list_at(&magnet->steel, i), at_m));
    }
    return field;
}

static double stepped(double value, double step)
{
    return step > 0.0 ? step * round(value / step) : value;
}

sim_vec3_t sim_magnet_read(sim_magnet_t *magnet, const sim_pose_t *pose)
{
    sim_vec3_t field = sim_magnet_field(magnet, pose->position_m);
    sim_vec3_t b = sim_mat3_mul_vec_t(pose->attitude, field);
    if (magnet->settings.model == SIM_MAGNET_IDEAL) {
        return b;
    }
    sim_vec3_t v = sim_vec3_add(sim_mat3_mul_vec(magnet->soft, b), magnet->hard_ut);
    v = sim_vec3_add(v, normal3(&magnet->noise, magnet->settings.noise_ut));
    double step = magnet->settings.step_ut;
    return sim_vec3(stepped(v.x, step), stepped(v.y, step), stepped(v.z, step));
}

void sim_magnet_close(sim_magnet_t *magnet)
{
    sim_list_free(&magnet->steel);
}
