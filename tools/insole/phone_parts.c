/* SPDX-License-Identifier: MIT */
#include "phone_parts.h"

#include <stdlib.h>
#include <string.h>

#include "insole/fuse/step_ekf.h"
#include "insole/fuse/step_ukf.h"
#include "insole/move/attitude_ekf.h"
#include "insole/move/attitude_ukf.h"
#include "insole/sense/carry_table.h"

#include "memory.h"

/* What a method is made of; NULL: it has no such part. */
typedef struct {
    insole_attitude_method_t *attitude;
    const insole_radio_solver_calls_t *solver;
    const insole_step_filter_calls_t *filter;
    bool is_constant; /* covariances */
} recipe_t;

static recipe_t recipe_of(method_t method, bool has_plan)
{
    const insole_step_filter_calls_t *best =
        has_plan ? &insole_step_cloud_calls : &insole_walker_filter_calls;
    const recipe_t recipes[METHODS] = {
        [METHOD_PHONE_BEST] = {insole_attitude_ekf, &insole_kde_fix_calls, best, false},
        [METHOD_PHONE_PDR] = {insole_attitude_ekf, NULL, &insole_step_ekf_calls, false},
        [METHOD_PDR_GYRO] = {NULL, NULL, &insole_step_ekf_calls, false},
        [METHOD_WIFI_KDE] = {insole_attitude_ekf, &insole_kde_fix_calls, NULL, false},
        [METHOD_WIFI_ML] = {insole_attitude_ekf, &insole_ml_fix_calls, NULL, false},
        [METHOD_EKF] = {insole_attitude_ekf, &insole_kde_fix_calls, &insole_step_ekf_calls, false},
        [METHOD_UKF] = {insole_attitude_ukf, &insole_kde_fix_calls, &insole_step_ukf_calls, false},
        [METHOD_KF_CONST] = {insole_attitude_ukf, &insole_kde_fix_calls, &insole_step_kf_calls,
                             true},
        [METHOD_EKF_CONST] = {insole_attitude_ukf, &insole_kde_fix_calls, &insole_step_ekf_calls,
                              true},
        [METHOD_UKF_CONST] = {insole_attitude_ukf, &insole_kde_fix_calls, &insole_step_ukf_calls,
                              true},
        [METHOD_ML_SHIFT] = {insole_attitude_ekf, &insole_kde_fix_calls, &insole_ml_shift_calls,
                             false},
        [METHOD_PF] = {insole_attitude_ekf, &phone_rival_solver, &phone_rival_filter, false},
        [METHOD_PF_KDE] = {insole_attitude_ekf, &insole_kde_fix_calls, &insole_step_cloud_calls,
                           false},
        [METHOD_WPF] = {insole_attitude_ekf, &insole_ml_fix_calls, &insole_step_cloud_calls, false},
        [METHOD_ZEE] = {insole_attitude_ekf, &insole_ml_fix_calls, &insole_step_cloud_zee_calls,
                        false}};
    return recipes[method];
}

/* ---- particles -------------------------------------------------------------------------- */

/* What a method's cloud is like; NULL: it has none. */
typedef struct {
    const insole_step_cloud_config_t *config;
    uint32_t particles;
    bool takes_plan;
} flock_t;

static flock_t flock_of(const phone_settings_t *settings, const recipe_t *recipe, method_t method)
{
    const flock_t none = {NULL, 0u, false}, best = {&settings->step_cloud, PHONE_PARTICLES, true};
    const flock_t rivals[METHODS] = {
        [METHOD_PF] = {&settings->plain_cloud, PHONE_RIVAL_PARTICLES, false},
        [METHOD_PF_KDE] = {&settings->plain_cloud, PHONE_RIVAL_PARTICLES, false},
        [METHOD_WPF] = {&settings->wpf, PHONE_RIVAL_PARTICLES, true},
        [METHOD_ZEE] = {&settings->zee, PHONE_ZEE_PARTICLES, true}};
    if (rivals[method].config != NULL) {
        return rivals[method];
    }
    return recipe->filter == &insole_step_cloud_calls ? best : none;
}

static void lend_memory(phone_parts_t *parts, uint32_t particles)
{
    insole_cloud_t *memory = &parts->memory;
    memory->count = particles;
    memory->particles = memory_new(particles, sizeof *memory->particles);
    memory->bias = memory_new(particles, sizeof *memory->bias);
}

static bool set_up_cloud(phone_parts_t *parts, const estimator_setup_t *setup, const flock_t *flock)
{
    const insole_floor_plan_t *plan =
        setup->building != NULL && flock->takes_plan ? setup->building->plan : NULL;
    lend_memory(parts, setup->particles > 0u ? setup->particles : flock->particles);
    phone_rival_init(&parts->rival, &parts->kde_fix, &parts->step_cloud,
                     parts->map != NULL ? parts->map->point_count : 0u);
    return insole_step_cloud_init(&parts->step_cloud, flock->config, &parts->memory, plan,
                                  setup->seed) == INSOLE_OK;
}

/* ---- states ----------------------------------------------------------------------------- */

static void *solver_state(phone_parts_t *parts, const insole_radio_solver_calls_t *calls)
{
    if (calls == &phone_rival_solver) {
        return &parts->rival;
    }
    return calls == &insole_ml_fix_calls ? (void *)&parts->ml_fix : (void *)&parts->kde_fix;
}

static void *filter_state(phone_parts_t *parts, const insole_step_filter_calls_t *calls)
{
    if (calls == &phone_rival_filter) {
        return &parts->rival;
    }
    if (calls == &insole_step_cloud_calls || calls == &insole_step_cloud_zee_calls) {
        return &parts->step_cloud;
    }
    if (calls == &insole_ml_shift_calls) {
        return &parts->ml_shift;
    }
    return calls == &insole_walker_filter_calls ? (void *)&parts->walker_ekf
                                                : (void *)&parts->step_fusion;
}

/* The settings may ask for another than the method's. */
static const insole_radio_solver_calls_t *solver_of(const recipe_t *recipe,
                                                    const phone_settings_t *settings)
{
    static const insole_radio_solver_calls_t *const asked[] = {NULL, &insole_kde_fix_calls,
                                                               &insole_ml_fix_calls};
    bool is_free = recipe->solver != NULL && recipe->solver != &phone_rival_solver;
    return is_free && settings->parts.fix > 0 ? asked[settings->parts.fix] : recipe->solver;
}

/* Whatever direction it gives. */
static void start_by_first_fix(insole_auto_start_config_t *config)
{
    config->method = INSOLE_AUTO_START_MOVED;
    config->fixes = 1;
    config->refine_rad = INSOLE_R(3.2);
}

static bool set_up_states(phone_parts_t *parts, const phone_settings_t *settings, bool is_constant)
{
    insole_step_fusion_config_t fusion = settings->step_fusion;
    if (is_constant) {
        fusion.process = fusion.measurement = INSOLE_STEP_CONSTANT;
    }
    parts->library.guide.calls = &insole_phone_gait_calls;
    parts->library.guide.state = &parts->gait;
    parts->library.magnetic.push = insole_magnetic_push;
    parts->library.magnetic.state = &parts->magnetic;
    parts->library.circles = &insole_auto_start_circles;
    return insole_magnetic_init(&parts->magnetic, &settings->magnetic) == INSOLE_OK &&
           insole_walk_heading_init(&parts->walk_heading, &settings->walk_heading) == INSOLE_OK &&
           insole_carry_init(&parts->carry, &settings->carry) == INSOLE_OK &&
           insole_phone_gait_init(&parts->gait, &settings->gait, &parts->walk_heading,
                                  &parts->carry, &insole_carry_table_forest) == INSOLE_OK &&
           insole_kde_fix_init(&parts->kde_fix, &settings->kde_fix) == INSOLE_OK &&
           insole_ml_fix_init(&parts->ml_fix, &settings->ml_fix) == INSOLE_OK &&
           insole_step_fusion_init(&parts->step_fusion, &fusion) == INSOLE_OK &&
           insole_ml_shift_init(&parts->ml_shift, &settings->ml_shift) == INSOLE_OK &&
           insole_walker_ekf_init(&parts->walker_ekf, &settings->walker_ekf) == INSOLE_OK;
}

bool phone_parts_init(phone_parts_t *parts, const estimator_setup_t *setup)
{
    const phone_settings_t *settings = &setup->settings->phone;
    bool has_plan = setup->building != NULL && setup->building->plan != NULL;
    const recipe_t recipe = recipe_of(setup->method, has_plan);
    const flock_t flock = flock_of(settings, &recipe, setup->method);
    const insole_radio_solver_calls_t *solver = solver_of(&recipe, settings);
    memset(parts, 0, sizeof *parts);
    parts->config = settings->tracker;
    parts->config.screen = setup->settings->fusion.foot.screen;
    parts->config.still_bias = setup->settings->fusion.foot.still_bias;
    if (setup->method == METHOD_ZEE) {
        start_by_first_fix(&parts->config.auto_start);
    }
    parts->map = solver != NULL ? setup->map : NULL;
    parts->library.attitude = recipe.attitude;
    parts->library.solver.calls = parts->map != NULL ? solver : NULL;
    parts->library.solver.state = solver_state(parts, solver);
    parts->library.filter.calls = recipe.filter;
    parts->library.filter.state = filter_state(parts, recipe.filter);
    return set_up_states(parts, settings, recipe.is_constant) &&
           (flock.config == NULL || set_up_cloud(parts, setup, &flock));
}

void phone_parts_free(phone_parts_t *parts)
{
    free(parts->memory.particles);
    free(parts->memory.bias);
    phone_rival_free(&parts->rival);
}
