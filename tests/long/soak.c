/* SPDX-License-Identifier: MIT
 *
 * A day in the shoe: 24 hours at 200 Hz, rounds of a corridor with a rest after each, biases that
 * follow the temperature. Nothing may stall, get lost, grow without end or become more certain than
 * it is. SOAK_HOURS in the environment makes it shorter. */
#include <stdio.h>
#include <stdlib.h>

#include "fusion_walk.h"
#include "suite.h"

#define LAP_STEP_US 5000u

/* A check that costs nothing where it holds: there are hundreds of millions. */
#define MUST(condition, t_us)                                                                      \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            ck_abort_msg("%s, at %.3f s", #condition, 1e-6 * (double)(t_us));                      \
        }                                                                                          \
    } while (0)

enum {
    LAP_SAMPLES = 15000,
    SOAK_PARTICLES = 300, /* that fusion_walk.h has room for */
    HOURS_MAX = 24
};

/* What became of one hour. */
typedef struct {
    uint32_t fixes, lost;
    double error_m, worst_m; /* mean at first a sum */
    double nees;             /* of the position in the plane, 2 when honest */
} hour_t;

static insole_imu_t lap[LAP_SAMPLES]; /* one round without noise, stamped from its begin */
static uint32_t lap_samples;
static uint64_t lap_us;
static insole_rng_t sensor_noise;
static hour_t hours[HOURS_MAX];

static int soak_hours(void)
{
    const char *text = getenv("SOAK_HOURS");
    int told = text != NULL ? atoi(text) : HOURS_MAX;
    return told >= 1 && told <= HOURS_MAX ? told : HOURS_MAX;
}

static void make_lap(void)
{
    walk = WALK;
    walk.strides = FUSION_ROUND;
    walk.turn_rad = 2.0 * FUSION_PI / FUSION_ROUND;
    walk.heading_rad = 0.8;
    walk_x_m = 110.0;
    walk_y_m = 45.0;
    build_round();
    lap_samples = (uint32_t)ceil(walk_end_s(&walk) / 0.005);
    ck_assert_uint_le(lap_samples, LAP_SAMPLES);
    lap_us = (uint64_t)lap_samples * LAP_STEP_US;
    for (uint32_t i = 0u; i < lap_samples; i++) {
        lap[i] = walk_sample(&walk, 0.005 * i, 0.005 * (i + 1u), NULL);
    }
}

static insole_real_t noisy(insole_real_t value, double sigma, double drift)
{
    return value + (insole_real_t)(sigma * (double)insole_rng_normal(&sensor_noise) + drift);
}

/* The sensor cools and warms with a period of four hours, one axis after the other. */
static insole_imu_t sample_at(uint64_t t_us)
{
    uint64_t in_lap = (t_us - LAP_STEP_US) % lap_us;
    insole_imu_t imu = lap[in_lap / LAP_STEP_US];
    double phase = 2.0 * FUSION_PI * 1e-6 * (double)t_us / 14400.0;
    insole_real_t *a = &imu.accel_mps2.x, *w = &imu.gyro_radps.x;
    imu.t_us = t_us;
    for (int i = 0; i < 3; i++) {
        a[i] = noisy(a[i], 0.02, 0.05 * sin(phase + 2.0 * i));
        w[i] = noisy(w[i], 0.002, 0.003 * sin(phase + 1.0 + 2.0 * i));
    }
    return imu;
}

/* As if a round began now: what a position is to be compared with. */
static double lap_time_s(uint64_t t_us)
{
    return 1e-6 * (double)(t_us % lap_us);
}

static void count(const insole_fix_t *fix)
{
    hour_t *hour = &hours[(fix->t_us - 1u) / UINT64_C(3600000000)];
    insole_spot_t at = truth_at(lap_time_s(fix->t_us));
    double dx = (double)(fix->position_m.x - at.x_m), dy = (double)(fix->position_m.y - at.y_m);
    double a = (double)fix->var_x_m2, b = (double)fix->cov_xy_m2, d = (double)fix->var_y_m2;
    double determinant = a * d - b * b;
    MUST(is_sane_fix(fix), fix->t_us);
    MUST(determinant > 0.0, fix->t_us);
    hour->fixes++;
    hour->lost += fix->state == INSOLE_FIX_LOST ? 1u : 0u;
    hour->error_m += hypot(dx, dy);
    hour->worst_m = fmax(hour->worst_m, hypot(dx, dy));
    hour->nees += (d * dx * dx - 2.0 * b * dx * dy + a * dy * dy) / determinant;
}

static void settle_hours(void)
{
    for (int i = 0; i < HOURS_MAX; i++) {
        double n = hours[i].fixes > 0u ? (double)hours[i].fixes : 1.0;
        hours[i].error_m /= n;
        hours[i].nees /= n;
        if (hours[i].fixes > 0u) {
            printf("hour %d: error %.3f m, worst %.2f m, NEES %.2f, lost %u of %u\n", i,
                   hours[i].error_m, hours[i].worst_m, hours[i].nees, hours[i].lost,
                   hours[i].fixes);
        }
    }
}

static void tell_scan(uint64_t t_us)
{
    insole_rss_t readings[FUSION_APS];
    double in_lap_s = lap_time_s(t_us);
    insole_spot_t at = truth_at(in_lap_s);
    walk_pose_t pose = walk_pose(&walk, in_lap_s);
    insole_scan_t scan = {t_us, readings, FUSION_APS};
    radio_listen(&radio, &rng, (double)at.x_m, (double)at.y_m, pose.yaw_rad, 3.0, FUSION_APS,
                 readings);
    MUST(insole_foot_fusion_scan(&fusion, &scan) == INSOLE_OK, t_us);
}

/* A fix for each sample, with its very stamp and no later than half a second and a stride's work
 * after it. */
static uint64_t take_new_fixes(uint64_t expected_us, uint64_t now_us)
{
    insole_fix_t fix;
    while (insole_foot_fusion_next(&fusion, &fix) == INSOLE_OK) {
        MUST(fix.t_us == expected_us, expected_us);
        expected_us += LAP_STEP_US;
        if (fix.t_us > 60000000u) {
            count(&fix);
        }
    }
    MUST(now_us + LAP_STEP_US - expected_us <= 2000000u, now_us);
    return expected_us;
}

static void run_day(const fusion_case_t *c)
{
    uint64_t end_us = (uint64_t)soak_hours() * UINT64_C(3600000000), expected_us = LAP_STEP_US;
    memset(hours, 0, sizeof hours);
    insole_rng_seed(&sensor_noise, 5u);
    insole_rng_seed(&rng, 6u);
    set_up(c);
    for (uint64_t t_us = LAP_STEP_US; t_us <= end_us; t_us += LAP_STEP_US) {
        insole_imu_t imu = sample_at(t_us);
        if (c->scans && t_us % 1000000u == 500000u) {
            tell_scan(t_us);
        }
        MUST(insole_foot_fusion_imu(&fusion, &imu) == INSOLE_OK, t_us);
        expected_us = take_new_fixes(expected_us, t_us);
        (void)insole_foot_fusion_work(&fusion, c->slice);
    }
    ck_assert_int_eq(insole_foot_fusion_finish(&fusion), INSOLE_OK);
    expected_us = take_new_fixes(expected_us, end_us);
    ck_assert_uint_eq(expected_us, end_us + LAP_STEP_US);
    settle_hours();
}

/* In a building the last hour is as good as the first. */
START_TEST(a_day_in_a_building)
{
    make_lap();
    fusion_case_t c = usual_case();
    c.particles = SOAK_PARTICLES;
    run_day(&c);
    for (int i = 0; i < soak_hours(); i++) {
        ck_assert_uint_eq(hours[i].lost, 0u);
        ASSERT_AT_MOST(hours[i].error_m, 0.4, "m");
        ASSERT_AT_MOST(hours[i].nees, 2.0, "");
    }
}
END_TEST

/* Alone the track drifts, and says so. */
START_TEST(a_day_alone)
{
    static const insole_building_t nothing;
    make_lap();
    fusion_case_t c = usual_case();
    c.building = &nothing;
    c.scans = false;
    run_day(&c);
    for (int i = 0; i < soak_hours(); i++) {
        ASSERT_AT_MOST(hours[i].nees, 2.0, "");
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("soak");
    suite_add(suite, "in a building", a_day_in_a_building);
    suite_add(suite, "alone", a_day_alone);
    return suite;
}
