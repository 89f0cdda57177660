/** @file headings.c  Walking directions of one simulated walk by all rivals, step by step.
 *
 *  usage: headings SCENARIO SEED [GROUP.KEY=VALUE ...]
 *
 *  Prints `attitude,method,t,error,sigma,certain` in rad, a row for each step that led anywhere.
 *  attitude: ukf, ekf, both with the magnetometer and the earth's field told, or true. method:
 *  rmpca; paper, the same as printed there, each step for itself; udirect; mean, what phone_walk
 *  makes of it for a phone that faces anywhere. Heading of the phone is told once, standing.
 *  GROUP is one of the simulator's, `walk_heading`, `attitude` or `magnetic`.
 *
 *  SPDX-License-Identifier: MIT
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "insole/insole.h"
#include "sim/magnet.h"
#include "sim/trunk.h"
#include "sim/walk.h"

static const double told_at_s = 1.5, shortest_m = 0.3;

enum { EKF, UKF, TRUE_ONE, ATTITUDES };
static const char *const attitude_names[ATTITUDES] = {"ekf", "ukf", "true"};

enum { RMPCA, PAPER, UDIRECT, METHODS };
static const char *const method_names[METHODS] = {"rmpca", "paper", "udirect"};

/* An attitude and all that goes by it. */
typedef struct {
    insole_attitude_method_t *method; /* NULL: the true one */
    bool told;
    insole_attitude_t attitude;
    insole_magnetic_t magnetic;
    insole_walk_heading_t headings[METHODS], of_phone;
    insole_phone_gait_t gait;
    insole_phone_walk_t phone;
} rival_t;

static rival_t rivals[ATTITUDES];
static sim_scenario_t scenario;
static sim_magnet_t magnet;
static insole_still_bias_t still;
static insole_step_counter_t counter;
static insole_walk_heading_config_t heading_config;
static insole_attitude_config_t attitude_config;
static insole_magnetic_config_t magnetic_config;

static void stop(const char *why)
{
    fprintf(stderr, "headings: %s\n", why);
    exit(2);
}

/* ---- settings ---- */

#define TAKE(kind, name, value, low, high, unit, text)                                             \
    if (strcmp(key, #name) == 0) {                                                                 \
        TARGET.name = (INSOLE_CONFIG_TYPE_##kind)number;                                           \
        return true;                                                                               \
    }

static bool take_ours(const char *group, const char *key, double number)
{
    if (strcmp(group, "walk_heading") == 0) {
#define TARGET heading_config
        INSOLE_WALK_HEADING_KEYS(TAKE)
#undef TARGET
    }
    if (strcmp(group, "attitude") == 0) {
#define TARGET attitude_config
        INSOLE_ATTITUDE_KEYS(TAKE)
#undef TARGET
    }
    if (strcmp(group, "magnetic") == 0) {
#define TARGET magnetic_config
        INSOLE_MAGNETIC_KEYS(TAKE)
#undef TARGET
    }
    return false;
}

static void take(char *setting)
{
    char *value = strchr(setting, '='), *key = strchr(setting, '.');
    sim_error_t error;
    if (!value || !key || key > value) {
        stop("a setting is GROUP.KEY=VALUE");
    }
    *value++ = '\0';
    if (sim_settings_set(&scenario.settings, setting, value, &error)) {
        return;
    }
    *key++ = '\0';
    if (!take_ours(setting, key, strtod(value, NULL))) {
        stop(error.text);
    }
}

static void begin(void)
{
    const int32_t methods[METHODS] = {INSOLE_WALK_HEADING_RMPCA, INSOLE_WALK_HEADING_RMPCA,
                                      INSOLE_WALK_HEADING_UDIRECT};
    insole_phone_walk_config_t walk = insole_phone_walk_defaults;
    insole_phone_gait_config_t gait = insole_phone_gait_defaults;
    gait.faces = 1;
    gait.gait = 0;
    for (int a = 0; a < ATTITUDES; a++) {
        rival_t *r = &rivals[a];
        r->method = a == EKF ? insole_attitude_ekf : a == UKF ? insole_attitude_ukf : NULL;
        bool done = insole_attitude_init(&r->attitude, &attitude_config) == INSOLE_OK;
        done = done && insole_magnetic_init(&r->magnetic, &magnetic_config) == INSOLE_OK;
        for (int m = 0; m < METHODS; m++) {
            insole_walk_heading_config_t c = heading_config;
            c.method = methods[m];
            if (m == PAPER) {
                c.steps = 1;
                c.sway_weight = INSOLE_R(1.0);
                c.axis_keep = INSOLE_R(0.0);
                c.level = 0;
            }
            done = done && insole_walk_heading_init(&r->headings[m], &c) == INSOLE_OK;
        }
        done = done && insole_walk_heading_init(&r->of_phone, &heading_config) == INSOLE_OK;
        insole_phone_guide_t guide = {&insole_phone_gait_calls, &r->gait};
        done =
            done && insole_phone_gait_init(&r->gait, &gait, &r->of_phone, NULL, NULL) == INSOLE_OK;
        done = done && insole_phone_walk_init(&r->phone, &walk, &guide) == INSOLE_OK;
        if (!done) {
            stop("a setting is out of its range");
        }
    }
    (void)insole_still_bias_init(&still, &insole_still_bias_defaults);
    (void)insole_step_init(&counter, &walk.step);
}

/* ---- attitudes ---- */

static insole_vec3_t vec3_of(sim_vec3_t v)
{
    return insole_vec3((insole_real_t)v.x, (insole_real_t)v.y, (insole_real_t)v.z);
}

/* Half of the turn about each axis, from the rotation vector. */
static insole_quat_t quat_of(sim_mat3_t attitude)
{
    return insole_quat_from_rotvec(vec3_of(sim_mat3_turn(attitude)));
}

static void tell_heading(rival_t *r, insole_quat_t truth)
{
    insole_heading_t heading = insole_heading(truth, NULL);
    (void)insole_attitude_set_heading(&r->attitude, heading.heading_rad, INSOLE_R(0.05));
    (void)insole_magnetic_set_field(&r->magnetic, vec3_of(magnet.earth_ut));
    r->told = true;
}

static void estimate(rival_t *r, const sim_sample_t *s, const insole_mag_t *mag)
{
    insole_quat_t truth = quat_of(s->truth.pose.attitude);
    if (!r->method) {
        r->attitude.aligned = true;
        r->attitude.q = truth;
        r->attitude.P = insole_sym3_diagonal(0, 0, 0);
        return;
    }
    (void)insole_attitude_push(&r->attitude, r->method, &s->imu, 0u);
    (void)insole_attitude_set_bias(&r->attitude, still.gyro_bias_radps);
    if (!r->told && s->truth.t_s > told_at_s) {
        tell_heading(r, truth);
    }
    if (r->told) {
        (void)insole_magnetic_push(&r->magnetic, &r->attitude, r->method, mag);
    }
}

/* ---- steps ---- */

/* @return whether the step led anywhere */
static bool find_way(const sim_steps_t *steps, const insole_footfall_t *f, double *way_rad)
{
    sim_place_t a = sim_trunk_at(steps, 1.0e-6 * (double)f->begin_us);
    sim_place_t b = sim_trunk_at(steps, 1.0e-6 * (double)f->end_us);
    *way_rad = atan2(b.y_m - a.y_m, b.x_m - a.x_m);
    return hypot(b.x_m - a.x_m, b.y_m - a.y_m) > shortest_m;
}

static void print_row(int attitude, const char *method, const insole_footfall_t *f, double off_rad,
                      double variance_rad2, bool certain)
{
    printf("%s,%s,%.3f,%.5f,%.5f,%d\n", attitude_names[attitude], method,
           1.0e-6 * (double)f->end_us, remainder(off_rad, 2.0 * SIM_PI), sqrt(variance_rad2),
           certain);
}

static void judge_step(int attitude, const insole_footfall_t *f, const sim_steps_t *steps)
{
    double way_rad;
    bool leads = find_way(steps, f, &way_rad);
    for (int m = 0; m < METHODS; m++) {
        insole_walked_t walked;
        insole_walk_heading_t *heading = &rivals[attitude].headings[m];
        if (insole_walk_heading_step(heading, f, &walked) == INSOLE_OK && leads) {
            print_row(attitude, method_names[m], f, (double)walked.direction_rad - way_rad,
                      (double)walked.variance_rad2, walked.is_certain);
        }
    }
}

static void judge_mean(int attitude, const sim_steps_t *steps)
{
    insole_footfall_t f;
    insole_pace_t pace;
    while (insole_phone_walk_next(&rivals[attitude].phone, &f, &pace) == INSOLE_OK) {
        double way_rad;
        if (find_way(steps, &f, &way_rad)) {
            print_row(attitude, "mean", &f, (double)pace.heading_rad - way_rad,
                      (double)pace.var_heading_rad2, true);
        }
    }
}

static void take_sample(const sim_sample_t *s, const sim_steps_t *steps)
{
    sim_vec3_t field = sim_magnet_read(&magnet, &s->truth.pose);
    insole_mag_t mag = {s->imu.t_us, vec3_of(field)};
    (void)insole_still_bias_push(&still, &s->imu);
    (void)insole_step_push(&counter, s->imu.t_us, s->imu.accel_mps2);
    for (int a = 0; a < ATTITUDES; a++) {
        rival_t *r = &rivals[a];
        estimate(r, s, &mag);
        insole_sym3_t P = insole_attitude_covariance(&r->attitude);
        for (int m = 0; m < METHODS; m++) {
            (void)insole_walk_heading_push(&r->headings[m], r->attitude.q, &P, s->imu.accel_mps2,
                                           s->imu.t_us);
        }
        (void)insole_phone_walk_push(&r->phone, &r->attitude, &s->imu);
        judge_mean(a, steps);
    }
    insole_footfall_t f;
    while (insole_step_next(&counter, &f) == INSOLE_OK) {
        for (int a = 0; a < ATTITUDES; a++) {
            judge_step(a, &f, steps);
        }
    }
}

int main(int count, char **arguments)
{
    sim_error_t error;
    heading_config = insole_walk_heading_defaults;
    attitude_config = insole_attitude_defaults;
    magnetic_config = insole_magnetic_defaults;
    magnetic_config.use = 1;
    if (count < 3) {
        stop("usage: headings SCENARIO SEED [GROUP.KEY=VALUE ...]");
    }
    if (!sim_scenario_load(arguments[1], &scenario, &error)) {
        stop(error.text);
    }
    for (int i = 3; i < count; i++) {
        take(arguments[i]);
    }
    uint64_t seed = strtoull(arguments[2], NULL, 10);
    sim_walk_t *walk = sim_walk_open(&scenario, seed, &error);
    if (!walk || !sim_magnet_open(&magnet, &scenario, seed, &error)) {
        stop(error.text);
    }
    begin();
    puts("attitude,method,t,error,sigma,certain");
    sim_sample_t sample;
    while (sim_walk_next(walk, &sample)) {
        if (sample.given) {
            take_sample(&sample, sim_walk_steps(walk));
        }
    }
    sim_magnet_close(&magnet);
    sim_walk_close(walk);
    sim_scenario_free(&scenario);
    return 0;
}
