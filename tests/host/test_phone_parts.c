/* SPDX-License-Identifier: MIT */
#include "phone_parts.h"

#include <stdlib.h>
#include <string.h>

#include "config_keys.h"
#include "insole/move/attitude_ekf.h"
#include "insole/move/attitude_ukf.h"
#include "suite.h"

static failure_t failure;

static estimator_setup_t setup_of(const settings_t *settings, method_t method, bool has_map)
{
    static const insole_radio_map_t map;
    estimator_setup_t setup;
    memset(&setup, 0, sizeof setup);
    setup.settings = settings;
    setup.method = method;
    setup.map = has_map ? &map : NULL;
    return setup;
}

START_TEST(methods_are_made_of_their_parts)
{
    settings_t settings;
    phone_parts_t *parts = malloc(sizeof *parts);
    settings_init(&settings);
    for (int i = METHOD_PHONE_BEST; i < METHODS; i++) {
        method_t method = (method_t)i;
        bool hears = !method_is_steps_alone(method), walks = !method_is_radio_alone(method);
        estimator_setup_t setup = setup_of(&settings, method, true);
        ck_assert(phone_parts_init(parts, &setup));
        ck_assert_int_eq(parts->library.solver.calls != NULL, hears);
        ck_assert_int_eq(parts->library.filter.calls != NULL, walks);
        ck_assert_int_eq(parts->map != NULL, hears);
        ck_assert_int_eq(parts->library.attitude == NULL, method == METHOD_PDR_GYRO);
        ck_assert(!walks || parts->library.filter.state);
        phone_parts_free(parts);
        setup = setup_of(&settings, method, false); /* nothing to look scans up in */
        ck_assert(phone_parts_init(parts, &setup));
        ck_assert(!parts->library.solver.calls && !parts->map);
        phone_parts_free(parts);
    }
    free(parts);
}
END_TEST

/* Of a method with a cloud: how many particles, and whether it is told the walls. */
START_TEST(rivals_have_clouds_of_their_own)
{
    static const struct {
        method_t method;
        uint32_t particles;
        bool takes_plan;
    } clouds[] = {{METHOD_PF, 1000u, false},       {METHOD_PF_KDE, 1000u, false},
                  {METHOD_WPF, 1000u, true},       {METHOD_ZEE, 10000u, true},
                  {METHOD_PHONE_BEST, 500u, true}, {METHOD_ML_SHIFT, 0u, false}};
    static const insole_floor_plan_t plan;
    const insole_building_t building = {.plan = &plan};
    settings_t settings;
    settings_init(&settings);
    phone_parts_t *parts = malloc(sizeof *parts);
    estimator_setup_t setup = setup_of(&settings, clouds[_i].method, true);
    setup.building = &building;
    ck_assert(phone_parts_init(parts, &setup));
    ck_assert_uint_eq(parts->memory.count, clouds[_i].particles);
    ck_assert((parts->step_cloud.building.plan == &plan) == clouds[_i].takes_plan);
    phone_parts_free(parts);
    setup.particles = 77u;
    ck_assert(phone_parts_init(parts, &setup));
    ck_assert_uint_eq(parts->memory.count, clouds[_i].particles > 0u ? 77u : 0u);
    phone_parts_free(parts);
    free(parts);
}
END_TEST

START_TEST(fixes_may_be_made_by_another_solver)
{
    settings_t settings;
    phone_parts_t *parts = malloc(sizeof *parts);
    settings_init(&settings);
    for (int i = METHOD_PHONE_BEST; i < METHODS; i++) {
        estimator_setup_t setup = setup_of(&settings, (method_t)i, true);
        ck_assert(config_set(&settings, "phone_parts.fix", "ml", &failure));
        ck_assert(phone_parts_init(parts, &setup));
        const insole_radio_solver_calls_t *calls = parts->library.solver.calls;
        bool is_free = !method_is_steps_alone((method_t)i) && i != METHOD_PF;
        ck_assert((calls == &insole_ml_fix_calls) == is_free);
        ck_assert(!is_free || parts->library.solver.state == &parts->ml_fix);
        phone_parts_free(parts);
        ck_assert(config_set(&settings, "phone_parts.fix", "kde", &failure));
        ck_assert(phone_parts_init(parts, &setup));
        ck_assert((parts->library.solver.calls == &insole_kde_fix_calls) == is_free);
        phone_parts_free(parts);
    }
    free(parts);
}
END_TEST

START_TEST(constant_covariances_are_those_of_the_rivals_alone)
{
    settings_t settings;
    phone_parts_t *parts = malloc(sizeof *parts);
    settings_init(&settings);
    for (int i = METHOD_EKF; i <= METHOD_UKF_CONST; i++) {
        estimator_setup_t setup = setup_of(&settings, (method_t)i, true);
        bool is_constant = i >= METHOD_KF_CONST;
        ck_assert(phone_parts_init(parts, &setup));
        ck_assert_int_eq(parts->step_fusion.config.process == INSOLE_STEP_CONSTANT, is_constant);
        ck_assert_int_eq(parts->step_fusion.config.measurement == INSOLE_STEP_CONSTANT,
                         is_constant);
        ck_assert(parts->library.attitude ==
                  (i == METHOD_EKF ? insole_attitude_ekf : insole_attitude_ukf));
        phone_parts_free(parts);
    }
    free(parts);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_parts");
    suite_add(suite, "parts", methods_are_made_of_their_parts);
    suite_add_loop(suite, "clouds", rivals_have_clouds_of_their_own, 6);
    suite_add(suite, "solver", fixes_may_be_made_by_another_solver);
    suite_add(suite, "constant", constant_covariances_are_those_of_the_rivals_alone);
    return suite;
}
