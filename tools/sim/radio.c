/* SPDX-License-Identifier: MIT */
#include "sim/radio.h"

static const double nearest_m = 0.2; /* no signal is stronger than at this distance */
static const double near_m = 1.5;
enum { NEAR_PLACES = 24 };

static double normal(insole_rng_t *rng)
{
    return (double)insole_rng_normal(rng);
}

/* Settings with everything off that a matched model does not have. */
static sim_radio_settings_t effective(const sim_radio_settings_t *settings)
{
    sim_radio_settings_t kept = *settings;
    if (settings->model == SIM_RADIO_MATCHED) {
        kept.p0_spread_db = kept.exponent_spread = kept.wall_spread = 0.0;
        kept.wall_keep = 1.0;
        kept.shadow_db = kept.body_db = kept.offset_db = 0.0;
        kept.step_db = kept.lost_share = kept.crowd_db = 0.0;
    }
    return kept;
}

static double or_default(double told, double otherwise)
{
    return isnan(told) ? otherwise : told;
}

static bool add_sources(sim_radio_t *radio, const sim_list_t *aps, uint64_t building)
{
    const sim_radio_settings_t *s = &radio->settings;
    insole_rng_t unit, shadow;
    sim_seed(&unit, building, SIM_SEED_RADIO_APS);
    sim_seed(&shadow, building, SIM_SEED_RADIO_SHADOW);
    for (size_t i = 0; i < aps->count; i++) {
        const sim_ap_t *ap = sim_list_at(aps, i);
        sim_source_t source;
        source.at_m = sim_vec3(ap->x_m, ap->y_m, or_default(ap->z_m, s->ap_height_m));
        source.p0_dbm = or_default(ap->p0_dbm, s->p0_dbm) + s->p0_spread_db * normal(&unit);
        source.exponent =
            fmax(1.0, or_default(ap->exponent, s->exponent) + s->exponent_spread * normal(&unit));
        source.crowd = normal(&radio->people);
        sim_shadow_init(&source.shadow, s->shadow_db, s->shadow_m, &shadow);
        if (!sim_list_add(&radio->sources, &source)) {
            return false;
        }
    }
    return true;
}

/* All pieces of a ring or wall have one loss. */
static bool add_losses(sim_radio_t *radio, uint64_t building)
{
    insole_rng_t rng;
    sim_seed(&rng, building, SIM_SEED_RADIO_WALLS);
    for (size_t i = 0; i < radio->plan->walls.count; i++) {
        const sim_wall_t *wall = sim_plan_wall(radio->plan, i);
        if (wall->line < radio->losses_db.count) {
            continue;
        }
        double told_db = or_default(wall->loss_db, radio->settings.wall_db);
        double loss_db = told_db * fmax(0.0, 1.0 + radio->settings.wall_spread * normal(&rng));
        if (!sim_list_add(&radio->losses_db, &loss_db)) {
            return false;
        }
    }
    return true;
}

bool sim_radio_open(sim_radio_t *radio, const sim_scenario_t *scenario, uint64_t seed,
                    sim_error_t *error)
{
    insole_rng_t receiver;
    radio->settings = effective(&scenario->settings.radio);
    radio->plan = &scenario->plan;
    radio->sources = sim_list(sizeof(sim_source_t));
    radio->losses_db = sim_list(sizeof(double));
    uint64_t number = (uint64_t)radio->settings.building;
    uint64_t building = number == 0 ? seed : number;
    sim_seed(&receiver, seed, SIM_SEED_RADIO_RECEIVER);
    sim_seed(&radio->noise, seed, SIM_SEED_RADIO_NOISE);
    sim_seed(&radio->people, seed, SIM_SEED_RADIO_CROWD);
    radio->offset_db = radio->settings.offset_db * normal(&receiver);
    if (add_sources(radio, &scenario->aps, building) && add_losses(radio, building)) {
        return true;
    }
    sim_radio_close(radio);
    return sim_fail(error, "out of memory");
}

/* Each further wall on the way takes a smaller share; their order does not matter. */
static double walls_loss(const sim_radio_t *radio, sim_point_t from, sim_point_t to)
{
    double sum_db = 0.0, shares = 0.0, share = 1.0;
    int crossed = 0;
    for (size_t i = 0; i < radio->plan->walls.count; i++) {
        const sim_wall_t *wall = sim_plan_wall(radio->plan, i);
        if (sim_wall_is_crossed(wall, from, to)) {
            sum_db += *(const double *)sim_list_at(&radio->losses_db, wall->line);
            shares += share;
            share *= radio->settings.wall_keep;
            crossed++;
        }
    }
    return crossed == 0 ? 0.0 : sum_db * shares / crossed;
}

/* Smooth in the angle between the way ahead and the way to the access point. */
static double body_loss(const sim_radio_t *radio, double angle_rad)
{
    return 0.5 * radio->settings.body_db * (1.0 - cos(angle_rad));
}

double sim_radio_mean(const sim_radio_t *radio, size_t ap, sim_vec3_t at_m, double heading_rad)
{
    const sim_source_t *source = sim_list_at(&radio->sources, ap);
    sim_vec3_t way = sim_vec3_sub(source->at_m, at_m);
    sim_point_t from = {source->at_m.x, source->at_m.y}, to = {at_m.x, at_m.y};
    double angle = atan2(way.y, way.x) - heading_rad;
    double spread_db = 10.0 * source->exponent * log10(fmax(nearest_m, sim_vec3_norm(way)));
    return source->p0_dbm - spread_db - walls_loss(radio, from, to) -
           sim_shadow_at(&source->shadow, at_m.x, at_m.y) - body_loss(radio, angle) +
           radio->offset_db;
}

/* Power of one direct path and many scattered ones against its mean. */
static double rice(double direct_over_scattered_db, double in_phase, double quadrature)
{
    double k = pow(10.0, 0.1 * direct_over_scattered_db);
    double scattered = sqrt(0.5 / (k + 1.0));
    double x = sqrt(k / (k + 1.0)) + scattered * in_phase, y = scattered * quadrature;
    return 10.0 * log10(x * x + y * y + 1e-12);
}

/* Chance that a signal of this strength is heard. */
static double audibility(const sim_radio_settings_t *settings, double dbm)
{
    return 1.0 / (1.0 + exp((settings->floor_dbm - dbm) / settings->floor_soft_db));
}

void sim_radio_wait(sim_radio_t *radio, double seconds)
{
    double keep = exp(-seconds / radio->settings.crowd_s), push = sqrt(1.0 - keep * keep);
    for (size_t i = 0; i < radio->sources.count; i++) {
        sim_source_t *source = sim_list_at(&radio->sources, i);
        source->crowd = keep * source->crowd + push * normal(&radio->people);
    }
}

static double crowd_loss(const sim_radio_t *radio, size_t ap)
{
    const sim_source_t *source = sim_list_at(&radio->sources, ap);
    return radio->settings.crowd_db * fmax(0.0, source->crowd);
}

bool sim_radio_hear(sim_radio_t *radio, size_t ap, sim_vec3_t at_m, double heading_rad, double *dbm)
{
    const sim_radio_settings_t *s = &radio->settings;
    double mean = sim_radio_mean(radio, ap, at_m, heading_rad);
    double a = normal(&radio->noise), b = normal(&radio->noise);
    double luck = (double)insole_rng_uniform(&radio->noise);
    double loss = (double)insole_rng_uniform(&radio->noise);
    if (s->model == SIM_RADIO_MATCHED) {
        *dbm = mean + s->noise_db * a;
        return mean >= s->floor_dbm;
    }
    double received = mean + rice(s->rice_db, a, b) - crowd_loss(radio, ap);
    *dbm = s->step_db > 0.0 ? s->step_db * round(received / s->step_db) : received;
    return luck < audibility(s, received) && loss >= s->lost_share;
}

double sim_radio_near(const sim_radio_t *radio, size_t ap, double z_m)
{
    const sim_source_t *source = sim_list_at(&radio->sources, ap);
    sim_point_t from = {source->at_m.x, source->at_m.y};
    double sum = 0.0;
    int places = 0;
    for (int i = 0; i < NEAR_PLACES; i++) {
        double angle = 2.0 * SIM_PI * i / NEAR_PLACES;
        sim_point_t to = {from.x_m + near_m * cos(angle), from.y_m + near_m * sin(angle)};
        if (sim_plan_clearance(radio->plan, from, to) > 0.0) {
            sim_vec3_t at = {to.x_m, to.y_m, z_m};
            sum +=
                sim_radio_mean(radio, ap, at, angle - 0.5 * SIM_PI); /* half of the body's loss */
            places++;
        }
    }
    return places == 0 ? nan("") : sum / places;
}

void sim_radio_close(sim_radio_t *radio)
{
    sim_list_free(&radio->sources);
    sim_list_free(&radio->losses_db);
}
