/* SPDX-License-Identifier: MIT */
#include "phone_parts.h"

#include <string.h>

#include "insole/fuse/step_ekf.h"
#include "insole/fuse/step_ukf.h"
#include "insole/move/attitude_ekf.h"
#include "insole/move/attitude_ukf.h"

/* What a method is made of; NULL: it has no such part. */
typedef struct {
    insole_attitude_method_t *attitude;
    const insole_radio_solver_calls_t *solver;
    const insole_step_filter_calls_t *filter;
    bool is_constant; /* covariances */
} recipe_t;

static recipe_t recipe_of(method_t method)
{
    const recipe_t recipes[METHODS] = {
        [METHOD_PHONE_BEST] = {insole_attitude_ekf, &insole_kde_fix_calls, &insole_walker_ekf_calls,
                               false},
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
                             false}};
    return recipes[method];
}

static bool set_up_solver(phone_parts_t *parts, const phone_settings_t *settings,
                          const insole_radio_solver_calls_t *calls)
{
    bool is_ml = calls == &insole_ml_fix_calls;
    parts->library.solver.calls = calls;
    parts->library.solver.state = is_ml ? (void *)&parts->ml_fix : (void *)&parts->kde_fix;
    return insole_kde_fix_init(&parts->kde_fix, &settings->kde_fix) == INSOLE_OK &&
           insole_ml_fix_init(&parts->ml_fix, &settings->ml_fix) == INSOLE_OK;
}

static void *state_of(phone_parts_t *parts, const insole_step_filter_calls_t *calls)
{
    if (calls == &insole_ml_shift_calls) {
        return &parts->ml_shift;
    }
    return calls == &insole_walker_ekf_calls ? (void *)&parts->walker_ekf
                                             : (void *)&parts->step_fusion;
}

static bool set_up_filter(phone_parts_t *parts, const phone_settings_t *settings,
                          const recipe_t *recipe)
{
    insole_step_fusion_config_t fusion = settings->step_fusion;
    if (recipe->is_constant) {
        fusion.process = fusion.measurement = INSOLE_STEP_CONSTANT;
    }
    parts->library.filter.calls = recipe->filter;
    parts->library.filter.state = state_of(parts, recipe->filter);
    return insole_step_fusion_init(&parts->step_fusion, &fusion) == INSOLE_OK &&
           insole_ml_shift_init(&parts->ml_shift, &settings->ml_shift) == INSOLE_OK &&
           insole_walker_ekf_init(&parts->walker_ekf, &settings->walker_ekf) == INSOLE_OK;
}

bool phone_parts_init(phone_parts_t *parts, const estimator_setup_t *setup)
{
    const phone_settings_t *settings = &setup->settings->phone;
    const recipe_t recipe = recipe_of(setup->method);
    memset(parts, 0, sizeof *parts);
    parts->config = settings->tracker;
    parts->config.screen = setup->settings->fusion.foot.screen;
    parts->config.still_bias = setup->settings->fusion.foot.still_bias;
    parts->library.attitude = recipe.attitude;
    parts->map = recipe.solver != NULL ? setup->map : NULL;
    return set_up_solver(parts, settings, parts->map != NULL ? recipe.solver : NULL) &&
           set_up_filter(parts, settings, &recipe);
}

void phone_parts_free(phone_parts_t *parts)
{
    (void)parts;
}
