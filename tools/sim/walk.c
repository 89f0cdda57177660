/* SPDX-License-Identifier: MIT */
#include "sim/walk.h"

#include <stdlib.h>

#include "sim/errands.h"
#include "sim/strides.h"

static const double walked_m = 0.3; /* a stride that leads somewhere */

struct sim_walk {
    sim_route_t route;
    sim_steps_t steps;
    sim_gait_t gait;
    sim_vec3_t lever_m;  /* of the sensor, foot axes */
    sim_mat3_t mounting; /* foot from sensor */
    bool has_phone;
    sim_phone_t phone; /* if so */
    sim_motion_stream_t stream;
    sim_imu_t imu;
    int32_t sampling;
};

static sim_pose_t sensor_pose(const void *state, double t_s)
{
    const sim_walk_t *walk = state;
    sim_pose_t foot = sim_gait_pose(&walk->gait, t_s);
    sim_pose_t sensor = {
        sim_vec3_add(foot.position_m, sim_mat3_mul_vec(foot.attitude, walk->lever_m)),
        sim_mat3_mul(foot.attitude, walk->mounting)};
    return sensor;
}

static sim_pose_t phone_pose(const void *state, double t_s)
{
    return sim_phone_pose(state, t_s);
}

sim_body_t sim_walk_body(const sim_walk_t *walk)
{
    sim_body_t shoe = {sensor_pose, walk}, phone = {phone_pose, &walk->phone};
    return walk->has_phone ? phone : shoe;
}

static sim_place_t start_place(const sim_scenario_t *scenario)
{
    const sim_order_t *start = sim_list_at(&scenario->orders, 0);
    sim_place_t place = {start->x_m, start->y_m, start->z_m, start->heading_rad};
    return place;
}

/* Errands become walks, orders a path. */
static bool plan_route(sim_route_t *route, const sim_scenario_t *scenario, uint64_t seed,
                       sim_error_t *error)
{
    sim_list_t orders;
    if (!sim_errands_plan(scenario, seed, &orders, error)) {
        return false;
    }
    bool done = sim_route_plan(&orders, &scenario->settings.walk, route, error);
    sim_list_free(&orders);
    return done;
}

/* Who carries a phone is somebody: other people take other steps. */
static sim_settings_t settings_of(const sim_scenario_t *scenario, uint64_t seed)
{
    sim_settings_t settings = scenario->settings;
    if (settings.log.sensor == SIM_SENSOR_PHONE) {
        settings.walk.step_length_m *= sim_person(&settings.person, seed).steps;
        settings.imu.rate_hz = settings.phone.rate_hz;
    }
    return settings;
}

/* Route, steps, strides: each is made from the one before. */
static bool plan(sim_walk_t *walk, const sim_scenario_t *scenario, const sim_settings_t *settings,
                 uint64_t seed, sim_error_t *error)
{
    if (!plan_route(&walk->route, scenario, seed, error)) {
        return false;
    }
    sim_place_t start = start_place(scenario);
    return sim_steps_plan(&walk->route, &start, settings, seed, &walk->steps, error) &&
           sim_strides_plan(&walk->steps, &settings->gait, seed, &walk->gait, error);
}

static bool carry_phone(sim_walk_t *walk, const sim_scenario_t *scenario, uint64_t seed,
                        sim_error_t *error)
{
    walk->has_phone = scenario->settings.log.sensor == SIM_SENSOR_PHONE &&
                      sim_phone_plan(scenario, &walk->steps, seed, &walk->phone, error);
    return walk->has_phone || scenario->settings.log.sensor == SIM_SENSOR_SHOE;
}

sim_walk_t *sim_walk_open(const sim_scenario_t *scenario, uint64_t seed, sim_error_t *error)
{
    sim_settings_t settings = settings_of(scenario, seed);
    const sim_mount_settings_t *mount = &settings.mount;
    sim_walk_t *walk = calloc(1, sizeof *walk);
    if (walk == NULL) {
        sim_fail(error, "out of memory");
        return NULL;
    }
    if (!plan(walk, scenario, &settings, seed, error) ||
        !carry_phone(walk, scenario, seed, error)) {
        sim_walk_close(walk);
        return NULL;
    }
    walk->lever_m = sim_vec3(mount->x_m, mount->y_m, mount->z_m);
    walk->mounting = sim_mat3_from_euler(mount->roll_rad, mount->pitch_rad, mount->yaw_rad);
    walk->sampling = settings.imu.sampling;
    walk->stream =
        sim_motion_stream(sim_walk_body(walk), settings.imu.rate_hz, settings.walk.gravity_mps2);
    sim_imu_init(&walk->imu, &settings.imu, seed);
    return walk;
}

bool sim_walk_next(sim_walk_t *walk, sim_sample_t *sample)
{
    sim_motion_t truth = walk->sampling == SIM_SAMPLING_POINT ? sim_motion_next_point(&walk->stream)
                                                              : sim_motion_next_mean(&walk->stream);
    if (truth.t_s > walk->steps.end_s) {
        return false;
    }
    sample->truth = truth;
    sample->foot_m = sim_gait_pose(&walk->gait, truth.t_s).position_m;
    sample->flat = sim_gait_is_flat(&walk->gait, truth.t_s);
    sample->given =
        sim_imu_read(&walk->imu, truth.t_s, truth.force_mps2, truth.rate_radps, &sample->imu);
    return true;
}

double sim_walk_duration(const sim_walk_t *walk)
{
    return walk->steps.end_s;
}

double sim_walk_distance(const sim_walk_t *walk)
{
    return walk->route.length_m;
}

const sim_imu_t *sim_walk_imu(const sim_walk_t *walk)
{
    return &walk->imu;
}

const sim_gait_t *sim_walk_gait(const sim_walk_t *walk)
{
    return &walk->gait;
}

const sim_steps_t *sim_walk_steps(const sim_walk_t *walk)
{
    return &walk->steps;
}

const sim_phone_t *sim_walk_phone(const sim_walk_t *walk)
{
    return walk->has_phone ? &walk->phone : NULL;
}

bool sim_walk_start_heading(const sim_walk_t *walk, double *heading_rad)
{
    const sim_list_t *strides = &walk->gait.strides;
    for (size_t i = 0; i + 1 < strides->count; i++) {
        const sim_stride_t *first = sim_list_at(strides, i), *second = sim_list_at(strides, i + 1);
        double x = second->to.x_m - first->from.x_m, y = second->to.y_m - first->from.y_m;
        if (hypot(first->to.x_m - first->from.x_m, first->to.y_m - first->from.y_m) > walked_m) {
            *heading_rad = atan2(y, x);
            return true;
        }
    }
    return false;
}

void sim_walk_close(sim_walk_t *walk)
{
    if (walk != NULL) {
        sim_route_free(&walk->route);
        sim_steps_free(&walk->steps);
        sim_strides_free(&walk->gait);
        if (walk->has_phone) {
            sim_phone_free(&walk->phone);
        }
        free(walk);
    }
}
