/** @file convergence.c  Both attitude filters from a start that is tilted by 60 degrees.
 *
 *  Prints the mean and the largest error of 200 starts after 1, 2, 5 and 10 s: of the tilt by
 *  gravity alone, phone at rest and phone shaken, and of the whole attitude, heading too, with an
 *  undisturbed compass. Both filters get the same samples, know that they may be off by so much,
 * and may not be levelled anew. Fails when one of them does not get there.
 *
 *  SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdio.h>

#include "insole/insole.h"

enum { STARTS = 200, TIMES = 4, RATE_HZ = 50 };
static const int times_s[TIMES] = {1, 2, 5, 10};
static const double degree = 0.01745329251994329577;
static const double off_degrees = 60.0;

typedef struct {
    const char *name;
    double shaken_mps2; /* white, of each axis and sample */
    bool has_compass;
    double limit_degrees; /* of the mean after 10 s */
} trial_t;

static const trial_t trials[] = {{"tilt, at rest", 0.05, false, 2.0},
                                 {"tilt, shaken", 3.0, false, 5.0},
                                 {"all, with a compass", 0.05, true, 2.0}};

typedef struct {
    double sum[TIMES], most[TIMES];
} errors_t;

static insole_real_t normal(insole_rng_t *rng, double sigma)
{
    return (insole_real_t)sigma * insole_rng_normal(rng);
}

static insole_vec3_t normal_vec3(insole_rng_t *rng, double sigma)
{
    insole_real_t x = normal(rng, sigma), y = normal(rng, sigma);
    return insole_vec3(x, y, normal(rng, sigma));
}

/* Off by 60 degrees about an axis: level, or any with a compass. */
static insole_quat_t wrong_turn(insole_rng_t *rng, bool any)
{
    insole_vec3_t axis = normal_vec3(rng, 1.0);
    axis.z = any ? axis.z : INSOLE_R(0.0);
    insole_real_t size = (insole_real_t)(off_degrees * degree) / insole_vec3_norm(axis);
    return insole_quat_from_rotvec(insole_vec3_scale(axis, size));
}

static void begin(insole_attitude_t *att, const insole_quat_t *truth, bool has_compass,
                  insole_rng_t *rng)
{
    insole_attitude_config_t config = insole_attitude_defaults;
    config.upset_rad = INSOLE_R(3.2);
    config.level_s = INSOLE_R(0.0);
    const insole_vec3_t g = {0, 0, INSOLE_R(9.81)};
    (void)insole_attitude_init(att, &config);
    for (uint64_t t_us = 1u; t_us < 50000u; t_us += 20000u) {
        insole_imu_t imu = {t_us, insole_quat_rotate_back(*truth, g), {0, 0, 0}};
        (void)insole_attitude_push(att, NULL, &imu, 0u);
    }
    insole_real_t unsure = (insole_real_t)(off_degrees * degree * off_degrees * degree);
    att->q = insole_quat_mul(wrong_turn(rng, has_compass), *truth);
    att->P = insole_sym3_diagonal(unsure, unsure, has_compass ? unsure : INSOLE_R(0.01));
}

static double error_of(insole_quat_t q, insole_quat_t truth, bool has_compass)
{
    insole_quat_t off = insole_quat_mul(q, insole_quat_conjugate(truth));
    double level = hypot((double)off.x, (double)off.y);
    double size = has_compass ? hypot(level, (double)off.z) : level;
    return 2.0 * asin(fmin(1.0, size)) / degree;
}

static void run_start(const trial_t *trial, insole_attitude_method_t *method, uint64_t seed,
                      errors_t *errors)
{
    const insole_vec3_t g = {0, 0, INSOLE_R(9.81)}, field = {0, INSOLE_R(28.6), INSOLE_R(-36.0)};
    insole_rng_t rng;
    insole_attitude_t att;
    insole_rng_seed(&rng, seed);
    insole_quat_t truth = insole_quat_normalize(
        insole_quat(normal(&rng, 1.0), normal(&rng, 1.0), normal(&rng, 1.0), normal(&rng, 1.0)));
    begin(&att, &truth, trial->has_compass, &rng);
    for (int k = 1; k <= times_s[TIMES - 1] * RATE_HZ; k++) {
        insole_vec3_t shaken = normal_vec3(&rng, trial->shaken_mps2);
        insole_imu_t imu = {att.t_us + 1000000u / RATE_HZ,
                            insole_vec3_add(insole_quat_rotate_back(truth, g), shaken),
                            normal_vec3(&rng, 0.002)};
        insole_vec3_t read_ut =
            insole_vec3_add(insole_quat_rotate_back(truth, field), normal_vec3(&rng, 0.6));
        (void)insole_attitude_push(&att, method, &imu, 0u);
        if (trial->has_compass) { /* [PhoneUKF (11)] without a test for disturbance */
            insole_sighting_t seen = {field, insole_quat_rotate(att.q, read_ut), INSOLE_R(450.0)};
            (void)insole_attitude_observe(&att, method, &seen);
        }
        for (int i = 0; i < TIMES; i++) {
            if (k == times_s[i] * RATE_HZ) {
                double error = error_of(att.q, truth, trial->has_compass);
                errors->sum[i] += error;
                errors->most[i] = fmax(errors->most[i], error);
            }
        }
    }
}

static bool judge(const trial_t *trial, const char *name, insole_attitude_method_t *method)
{
    errors_t errors = {{0.0}, {0.0}};
    for (uint64_t seed = 1u; seed <= STARTS; seed++) {
        run_start(trial, method, seed, &errors);
    }
    printf("%-20s %s ", trial->name, name);
    for (int i = 0; i < TIMES; i++) {
        printf("  %6.2f (%6.2f)", errors.sum[i] / STARTS, errors.most[i]);
    }
    puts("");
    return errors.sum[TIMES - 1] / STARTS < trial->limit_degrees;
}

int main(void)
{
    bool done = true;
    printf("error in degrees, mean (largest), after %d, %d, %d, %d s\n", times_s[0], times_s[1],
           times_s[2], times_s[3]);
    for (size_t i = 0; i < sizeof trials / sizeof trials[0]; i++) {
        done = judge(&trials[i], "ekf", insole_attitude_ekf) && done;
        done = judge(&trials[i], "ukf", insole_attitude_ukf) && done;
    }
    return done ? 0 : 1;
}
