/* SPDX-License-Identifier: MIT */
#include "insole/sense/step.h"

#include <string.h>

#include "footsteps.h"
#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "setting.h"
#include "suite.h"

enum { TOLD_MAX = 600 };

static insole_step_config_t config;
static insole_step_counter_t counter;
static footsteps_t walk;
static insole_rng_t rng;
static double rate_hz, noise_mps2;
static uint64_t clock_us; /* of the first sample */
static insole_vec3_t direction;
static insole_footfall_t told[TOLD_MAX];
static double told_at_s[TOLD_MAX]; /* when each was told */
static int tolds;

static void setup(void)
{
    memset(&walk, 0, sizeof walk);
    config = insole_step_defaults;
    insole_rng_seed(&rng, 11u);
    rate_hz = 50.0;
    noise_mps2 = 0.05;
    clock_us = 1000000u;
    direction = insole_vec3(0, 0, 1);
    tolds = 0;
}

static void begin(void)
{
    ck_assert_int_eq(insole_step_init(&counter, &config), INSOLE_OK);
}

static void push(double t_s, double length_mps2)
{
    insole_vec3_t a = insole_vec3_scale(direction, (insole_real_t)length_mps2);
    uint64_t t_us = clock_us + (uint64_t)(t_s * 1e6 + 0.5);
    insole_footfall_t footfall;
    if (insole_step_push(&counter, t_us, a) != INSOLE_OK) {
        ck_abort_msg("a good sample was refused at %g s", t_s);
    }
    while (insole_step_next(&counter, &footfall) == INSOLE_OK) {
        ck_assert_int_lt(tolds, TOLD_MAX);
        told_at_s[tolds] = t_s;
        told[tolds++] = footfall;
    }
}

static double felt(double t_s)
{
    return footsteps_feel(&walk, t_s) + noise_mps2 * (double)insole_rng_normal(&rng);
}

static void feel(double from_s, double to_s)
{
    for (long i = lround(from_s * rate_hz); (double)i / rate_hz < to_s; i++) {
        push((double)i / rate_hz, felt((double)i / rate_hz));
    }
}

static double end_s(int i)
{
    return (double)(told[i].end_us - clock_us) * 1e-6;
}

/* ---- walks are counted ------------------------------------------------------------------ */

static const struct {
    double speed_mps, frequency_hz, height_mps2;
} GAITS[] = {{0.8, 1.3, 3.0}, {1.0, 1.6, 4.0},  {1.3, 1.8, 6.0},
             {1.6, 2.0, 8.0}, {2.2, 2.5, 14.0}, {3.0, 2.9, 25.0}};
static const double RATES_HZ[] = {20.0, 50.0, 97.0, 200.0, 400.0};
enum { GAIT_COUNT = 6, RATE_COUNT = 5 };

START_TEST(every_step_of_a_walk_is_told_once)
{
    double period_s = 1.0 / GAITS[_i / RATE_COUNT].frequency_hz;
    rate_hz = RATES_HZ[_i % RATE_COUNT];
    direction = insole_quat_rotate(sample_quat(&rng), direction);
    double over_s = footsteps_walk(&walk, 3.0, 60, period_s, GAITS[_i / RATE_COUNT].height_mps2);
    begin();
    feel(0.0, over_s + 4.0);
    ck_assert_int_eq(tolds, 60);
    ck_assert_uint_eq(counter.count, 60u);
    worst_t late = {0.0, 0.0};
    for (int i = 0; i < tolds; i++) { /* the filter lags by less than 0.15 s */
        worst_note(&late, fabs(end_s(i) - walk.t_s[i] - 0.075), walk.t_s[i]);
    }
    ASSERT_WORST(late, 0.075 + 1.0 / rate_hz, "s");
}
END_TEST

START_TEST(footfalls_of_a_walk_follow_each_other)
{
    double over_s = footsteps_walk(&walk, 3.0, 40, 0.55, 6.0);
    begin();
    feel(0.0, over_s + 4.0);
    ck_assert_int_eq(tolds, 40);
    for (int i = 1; i < tolds; i++) {
        ck_assert_uint_eq(told[i].begin_us, told[i - 1].end_us);
        ASSERT_NEAR(end_s(i) - end_s(i - 1), 0.55, 0.061, "s");
    }
    ck_assert_uint_eq(told[0].end_us - told[0].begin_us, told[1].end_us - told[1].begin_us);
    ASSERT_NEAR(told[0].range_mps2, told[1].range_mps2, 0.0, "m/s^2");
    ASSERT_NEAR(told[0].accel_sigma_mps2, told[1].accel_sigma_mps2, 0.0, "m/s^2");
}
END_TEST

/* The walk is sure after some seconds; from then on a step is told within max_dead_s. */
START_TEST(steps_are_told_in_time)
{
    double over_s = footsteps_walk(&walk, 3.0, 40, 0.55, 6.0);
    begin();
    feel(0.0, over_s + 4.0);
    ASSERT_AT_MOST(told_at_s[0] - end_s(0), 3.5, "s");
    for (int i = 8; i < tolds; i++) {
        ASSERT_AT_MOST(told_at_s[i] - end_s(i), (double)config.max_dead_s + 0.021, "s");
    }
}
END_TEST

/* A pure tone has its amplitude from the frequency responses of the two filters. */
START_TEST(footfall_of_a_tone)
{
    const double f = 1.8, amplitude = 3.0, pi = 3.14159265358979;
    rate_hz = 400.0;
    begin();
    for (int i = 0; i < 8000; i++) {
        push(i / rate_hz, 9.81 + amplitude * sin(2 * pi * f * i / rate_hz));
    }
    double low = f / 2.2, high = 0.5 / f;
    double gain = 1.0 / sqrt((1 + low * low * low * low) * (1 + high * high));
    ck_assert_int_ge(tolds, 34);
    ck_assert_int_le(tolds, 36);
    for (int i = 8; i < tolds; i++) {
        ASSERT_NEAR(told[i].end_us - told[i].begin_us, 1e6 / f, 2501.0, "us");
        ASSERT_NEAR(told[i].peak_mps2, amplitude * gain, 0.01 * amplitude, "m/s^2");
        ASSERT_NEAR(told[i].range_mps2, 2 * amplitude * gain, 0.02 * amplitude, "m/s^2");
        ASSERT_NEAR(told[i].accel_sigma_mps2, amplitude / sqrt(2.0), 0.01, "m/s^2");
    }
}
END_TEST

START_TEST(stops_in_between_are_no_steps)
{
    double t_s = 3.0;
    for (int i = 0; i < 5; i++) {
        t_s = 6.0 + footsteps_walk(&walk, t_s, 12 + i, 0.5 + 0.02 * i, 5.0);
    }
    begin();
    feel(0.0, t_s);
    ck_assert_int_eq(tolds, 5 * 12 + 10);
}
END_TEST

/* One leg's step is short, the other's long and soft: a phone in a pocket. */
START_TEST(pocket_counts_both_legs)
{
    for (int i = 0; i < 60; i++) {
        footsteps_add(&walk, 3.0 + 0.58 * i + (i % 2 ? 0.1 : 0.0), i % 2 ? 6.0 : 11.0, 0.5);
    }
    begin();
    feel(0.0, 3.0 + 0.58 * 60 + 3.0);
    ck_assert_int_eq(tolds, 60);
}
END_TEST

START_TEST(change_of_pace_loses_no_step)
{
    double t_s = 3.0;
    static const double PERIODS_S[] = {0.56, 0.36, 0.75, 0.45, 0.62};
    static const double HEIGHTS_MPS2[] = {6.0, 18.0, 4.0, 9.0, 5.0};
    for (int i = 0; i < 5; i++) {
        t_s = footsteps_walk(&walk, t_s, 30, PERIODS_S[i], HEIGHTS_MPS2[i]);
    }
    begin();
    feel(0.0, t_s + 3.0);
    ck_assert_int_ge(tolds, 148);
    ck_assert_int_le(tolds, 151);
}
END_TEST

/* Heel and toe: each step has a lower peak 0.3 s from the true one. */
static void heel_and_toe(double first_mps2, double second_mps2)
{
    config.low_pass_hz = INSOLE_R(5.0); /* both peaks survive, and no trough is deep */
    config.deep_share = INSOLE_R(2.0);
    for (int i = 0; i < 30; i++) {
        footsteps_add(&walk, 3.0 + 0.85 * i, first_mps2, 0.5);
        footsteps_add(&walk, 3.3 + 0.85 * i, second_mps2, 0.5);
    }
    begin();
    feel(0.0, 3.0 + 0.85 * 30 + 3.0);
}

/* One peak a step, this long after the first of its two. */
static void expect_peaks(double after_s)
{
    ck_assert_int_eq(tolds, 30);
    for (int i = 0; i < tolds; i++) {
        ASSERT_NEAR(fmod(end_s(i) - 3.0, 0.85), after_s + 0.06, 0.06, "s");
    }
}

START_TEST(false_peak_is_corrected_by_the_true_one)
{
    heel_and_toe(4.0, 7.0);
    expect_peaks(0.3);
}
END_TEST

START_TEST(false_peak_after_the_true_one_is_none)
{
    heel_and_toe(7.0, 4.0);
    expect_peaks(0.0);
}
END_TEST

START_TEST(first_peak_stays_if_told_so)
{
    config.rule = INSOLE_STEP_FIRST;
    heel_and_toe(4.0, 7.0);
    expect_peaks(0.0);
}
END_TEST

START_TEST(weak_sensor_scale_and_jitter_do_no_harm)
{
    double over_s = footsteps_walk(&walk, 3.0, 50, 0.52, 6.0);
    begin();
    for (double t_s = 0.0; t_s < over_s + 3.0;
         t_s += 0.005 + 0.04 * (double)insole_rng_uniform(&rng)) {
        push(t_s, 0.94 * felt(t_s));
    }
    ck_assert_int_eq(tolds, 50);
}
END_TEST

/* ---- what is no walk ---------------------------------------------------------------------- */

START_TEST(standing_is_no_step)
{
    noise_mps2 = 0.2;
    begin();
    feel(0.0, 600.0);
    ck_assert_int_eq(tolds, 0);
}
END_TEST

/* A tap pushes the phone and the hand pushes back. */
START_TEST(tapping_is_no_step)
{
    begin();
    double next_s = 1.0;
    for (int i = 0; i < 60 * 100; i++) {
        double since_s = i / 100.0 - next_s;
        push(i / 100.0, 9.81 + (since_s < 0.0 ? 0.0 : since_s < 0.03 ? 3.0 : -3.0));
        if (since_s > 0.055) {
            next_s += 0.2 + 0.2 * (double)insole_rng_uniform(&rng);
        }
    }
    ck_assert_int_eq(tolds, 0);
}
END_TEST

/* The phone is carried around the body and tilted: slow, and never the same twice. */
START_TEST(turning_on_the_spot_is_no_step)
{
    begin();
    for (int turn = 0; turn < 40; turn++) {
        double lasts_s = 2.5 + 2.0 * (double)insole_rng_uniform(&rng);
        footsteps_add(&walk, 5.0 + 5.0 * turn, 0.5 + 1.5 * (double)insole_rng_uniform(&rng),
                      lasts_s);
    }
    feel(0.0, 210.0);
    ck_assert_int_eq(tolds, 0);
}
END_TEST

/* Jerks as strong as steps at moments of no rhythm, hardly further apart than steps. */
static int fidget(void)
{
    double t_s = 3.0;
    setup();
    while (walk.count < 300) {
        t_s += 0.3 - 0.7 * log((double)insole_rng_uniform(&rng) + 1e-9);
        footsteps_add(&walk, t_s, 1.0 + 5.0 * (double)insole_rng_uniform(&rng),
                      0.3 + 0.4 * (double)insole_rng_uniform(&rng));
    }
    return (int)t_s;
}

START_TEST(fidgeting_is_seldom_a_step)
{
    double over_s = fidget();
    begin();
    feel(0.0, over_s);
    int with_rhythm = tolds;
    (void)fidget();
    config.start_likeness = config.keep_likeness = INSOLE_R(-1.0);
    config.first_steps = 2;
    begin();
    feel(0.0, over_s);
    ck_assert_int_gt(tolds, 150);
    ASSERT_AT_MOST(with_rhythm, tolds / 3, "steps");
}
END_TEST

START_TEST(putting_the_phone_away_after_a_walk_is_no_walk)
{
    double t_s = footsteps_walk(&walk, 3.0, 40, 0.55, 9.0);
    for (int i = 0; i < 12; i++) {
        footsteps_add(&walk, t_s + 0.6 * (i + 1), 1.2, 0.4);
    }
    begin();
    feel(0.0, t_s + 12.0);
    ck_assert_int_ge(tolds, 40);
    ck_assert_int_le(tolds, 41);
}
END_TEST

START_TEST(few_peaks_are_no_walk)
{
    footsteps_walk(&walk, 3.0, 3, 0.55, 6.0);
    begin();
    feel(0.0, 12.0);
    ck_assert_int_eq(tolds, 0);
}
END_TEST

START_TEST(without_the_gate_two_peaks_are_a_walk)
{
    config.first_steps = 2;
    config.start_likeness = INSOLE_R(-1.0);
    footsteps_walk(&walk, 3.0, 2, 0.55, 6.0);
    begin();
    feel(0.0, 12.0);
    ck_assert_int_eq(tolds, 2);
}
END_TEST

/* ---- samples that are missing, bad, or not taken out ------------------------------------------
 */

START_TEST(gap_costs_the_steps_within_it_alone)
{
    footsteps_walk(&walk, 3.0, 60, 0.5, 6.0);
    begin();
    feel(0.0, 15.0);
    feel(18.0, 40.0);
    ck_assert_int_ge(tolds, 60 - 6 - 2);
    ck_assert_int_le(tolds, 60 - 6);
    for (int i = 1; i < tolds; i++) {
        ck_assert_uint_ge(told[i].begin_us, told[i - 1].end_us);
    }
}
END_TEST

START_TEST(clock_of_years_changes_nothing)
{
    static insole_footfall_t kept[TOLD_MAX];
    footsteps_walk(&walk, 1.0, 40, 0.55, 6.0);
    begin();
    feel(0.0, 28.0);
    int count = tolds;
    memcpy(kept, told, sizeof kept);
    uint64_t first_us = clock_us;
    tolds = 0;
    clock_us = (uint64_t)1 << 60;
    insole_rng_seed(&rng, 11u);
    begin();
    feel(0.0, 28.0);
    ck_assert_int_eq(tolds, count);
    for (int i = 0; i < count; i++) {
        ck_assert_uint_eq(told[i].begin_us - clock_us, kept[i].begin_us - first_us);
        ck_assert_uint_eq(told[i].end_us - clock_us, kept[i].end_us - first_us);
        ASSERT_NEAR(told[i].range_mps2, kept[i].range_mps2, 0.0, "m/s^2");
    }
}
END_TEST

START_TEST(first_step_at_the_begin_of_time_does_not_wrap)
{
    config.first_steps = 2;
    config.start_likeness = INSOLE_R(-1.0);
    clock_us = 0u;
    footsteps_walk(&walk, 0.2, 8, 0.9, 6.0);
    begin();
    feel(0.0, 10.0);
    ck_assert_int_ge(tolds, 2);
    ck_assert_uint_eq(told[0].begin_us, 0u);
    ck_assert_uint_gt(told[0].end_us, 0u);
}
END_TEST

START_TEST(copy_goes_on_like_the_original)
{
    static insole_footfall_t kept[TOLD_MAX];
    static insole_step_counter_t copy;
    footsteps_walk(&walk, 2.0, 40, 0.55, 6.0);
    noise_mps2 = 0.0;
    begin();
    feel(0.0, 4.0); /* steps are held back */
    copy = counter;
    feel(4.0, 30.0);
    int count = tolds;
    memcpy(kept, told, sizeof kept);
    tolds = 0;
    counter = copy;
    feel(4.0, 30.0);
    ck_assert_int_eq(tolds, count);
    for (int i = 0; i < count; i++) {
        ck_assert_uint_eq(told[i].end_us, kept[i].end_us);
        ck_assert(told[i].accel_sigma_mps2 == kept[i].accel_sigma_mps2);
    }
}
END_TEST

static void refuse(uint64_t t_us, double x, double y, double z, insole_status_t expected)
{
    insole_vec3_t a = insole_vec3((insole_real_t)x, (insole_real_t)y, (insole_real_t)z);
    ASSERT_REFUSED(counter, counter.refused, insole_step_push(&counter, t_us, a), expected);
}

START_TEST(bad_samples_are_refused_and_counted)
{
    footsteps_walk(&walk, 1.0, 30, 0.5, 6.0);
    begin();
    feel(0.0, 6.0);
    uint64_t t_us = counter.t_us;
    refuse(t_us + 10000u, (double)NAN, 0.0, 9.81, INSOLE_ERR_VALUE);
    refuse(t_us + 10000u, 0.0, (double)INFINITY, 9.81, INSOLE_ERR_VALUE);
    refuse(t_us + 10000u, 0.0, 0.0, -(double)INFINITY, INSOLE_ERR_VALUE);
    refuse(t_us + 10000u, 3e38, 0.0, 0.0, INSOLE_ERR_VALUE);
    refuse(t_us + 10000u, 0.0, 1000.5, 0.0, INSOLE_ERR_VALUE);
    refuse(t_us, 0.0, 0.0, 9.81, INSOLE_ERR_TIME);
    refuse(t_us - 1u, 0.0, 0.0, 9.81, INSOLE_ERR_TIME);
    ck_assert_uint_eq(counter.refused, 7u);
    feel(6.0, 20.0);
    ck_assert_int_eq(tolds, 30);
}
END_TEST

/* Whatever the accelerometer says, what comes out is finite and in order of time. */
START_TEST(any_signal_gives_finite_footfalls)
{
    uint64_t last_us = 0u;
    begin();
    config.start_likeness = INSOLE_R(-1.0);
    for (int i = 0; i < 50000; i++) {
        double strength = pow(10.0, (double)sample_between(&rng, -3, 3));
        push(i * 0.0125 + 0.01 * (double)insole_rng_uniform(&rng),
             strength * (double)insole_rng_uniform(&rng));
        for (int k = 0; k < tolds; k++) {
            ck_assert(insole_is_finite(told[k].peak_mps2) && told[k].peak_mps2 > 0);
            ck_assert(insole_is_finite(told[k].range_mps2) && told[k].range_mps2 > 0);
            ck_assert(insole_is_finite(told[k].accel_sigma_mps2) && told[k].accel_sigma_mps2 >= 0);
            ck_assert_uint_lt(told[k].begin_us, told[k].end_us);
            ck_assert_uint_lt(last_us, told[k].end_us);
            last_us = told[k].end_us;
        }
        tolds = 0;
    }
    ck_assert_uint_gt(counter.count, 0u);
}
END_TEST

START_TEST(steps_that_nobody_takes_out_stop_the_counter)
{
    insole_footfall_t footfall;
    insole_status_t status = INSOLE_OK;
    uint64_t t_us = clock_us;
    footsteps_walk(&walk, 1.0, 60, 0.5, 6.0);
    begin();
    while (status == INSOLE_OK && t_us < clock_us + 60000000u) {
        t_us += 20000u;
        double t_s = (double)(t_us - clock_us) * 1e-6;
        status = insole_step_push(&counter, t_us, insole_vec3(0, 0, (insole_real_t)felt(t_s)));
    }
    ck_assert_int_eq(status, INSOLE_ERR_ROOM);
    refuse(t_us, 0.0, 0.0, 9.81, INSOLE_ERR_ROOM);
    for (uint32_t i = 0; i < counter.count; i++) {
        ck_assert_int_eq(insole_step_next(&counter, &footfall), INSOLE_OK);
    }
    ASSERT_UNCHANGED(counter, insole_step_next(&counter, &footfall), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_step_push(&counter, t_us, insole_vec3(0, 0, 9)), INSOLE_OK);
}
END_TEST

static insole_status_t judge(void)
{
    return insole_step_init(&counter, &config);
}

START_TEST(settings_have_ends)
{
    INSOLE_STEP_KEYS(SETTING_HAS_ENDS)
    begin();
    config.low_pass_hz = INSOLE_R(-1.0);
    ASSERT_UNCHANGED(counter, judge(), INSOLE_ERR_VALUE);
}
END_TEST

/* What is held back is, once it is told, the very same steps, the first of them too. */
START_TEST(held_steps_are_those_that_will_be_told)
{
    insole_footfall_t held[INSOLE_STEP_HELD], none;
    uint32_t count = 0u;
    footsteps_walk(&walk, 2.0, 20, 0.55, 6.0);
    begin();
    for (double t_s = 0.0; tolds == 0; t_s += 0.02) {
        ck_assert(t_s < 10.0);
        for (count = 0u; insole_step_held(&counter, count, &held[count]) == INSOLE_OK; count++) {
            ck_assert_uint_lt(count + 1u, INSOLE_STEP_HELD);
        }
        ck_assert_uint_eq(count, counter.held);
        push(t_s, felt(t_s));
    }
    ck_assert_uint_ge(count, 3u); /* and the peak that made it a walk */
    ck_assert_int_eq(tolds, (int)count + 1);
    for (uint32_t i = 0u; i < count; i++) {
        ck_assert(held[i].begin_us == told[i].begin_us && held[i].end_us == told[i].end_us);
        ck_assert(held[i].peak_mps2 == told[i].peak_mps2);
        ck_assert(held[i].range_mps2 == told[i].range_mps2);
        ck_assert(held[i].accel_sigma_mps2 == told[i].accel_sigma_mps2);
    }
    ASSERT_UNCHANGED(counter, insole_step_held(&counter, 0u, &none), INSOLE_ERR_STATE);
}
END_TEST

START_TEST(held_steps_wait_behind_those_not_taken_out)
{
    insole_footfall_t footfall;
    bool seen = false;
    footsteps_walk(&walk, 2.0, 6, 0.55, 6.0);
    footsteps_walk(&walk, 18.0, 3, 0.55, 6.0);
    begin();
    for (long i = 0; i < 1100; i++) { /* nobody takes out a step */
        double t_s = (double)i / rate_hz;
        insole_vec3_t a = insole_vec3_scale(direction, (insole_real_t)felt(t_s));
        (void)insole_step_push(&counter, clock_us + (uint64_t)(t_s * 1e6 + 0.5), a);
        uint32_t waiting = insole_ring_count(&counter.ring) - counter.held;
        for (uint32_t n = 0u; waiting > 0u && n < counter.held; n++) {
            ck_assert_int_eq(insole_step_held(&counter, n, &footfall), INSOLE_OK);
            ck_assert(footfall.end_us > counter.footfalls[0].end_us);
            ck_assert(footfall.end_us > footfall.begin_us);
            seen = true;
        }
    }
    ck_assert(seen);
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    insole_footfall_t footfall;
    insole_vec3_t a = insole_vec3(0, 0, 9);
    begin();
    ASSERT_UNCHANGED(counter, insole_step_init(&counter, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(counter, insole_step_next(&counter, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(counter, insole_step_next(&counter, &footfall), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_step_init(NULL, &config), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_push(NULL, 1u, a), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_next(NULL, &footfall), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(counter, insole_step_held(&counter, 0u, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(counter, insole_step_held(&counter, 0u, &footfall), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_step_held(NULL, 0u, &footfall), INSOLE_ERR_NULL);
}
END_TEST

static void add(Suite *suite, const char *behaviour, const TTest *test, int rows)
{
    TCase *tcase = tcase_create(behaviour);
    tcase_add_checked_fixture(tcase, setup, NULL);
    tcase_set_timeout(tcase, 120.0);
    tcase_add_loop_test(tcase, test, 0, rows);
    suite_add_tcase(suite, tcase);
}

Suite *insole_suite(void)
{
    Suite *suite = suite_create("step");
    add(suite, "count", every_step_of_a_walk_is_told_once, GAIT_COUNT * RATE_COUNT);
    add(suite, "chain", footfalls_of_a_walk_follow_each_other, 1);
    add(suite, "in time", steps_are_told_in_time, 1);
    add(suite, "tone", footfall_of_a_tone, 1);
    add(suite, "stops", stops_in_between_are_no_steps, 1);
    add(suite, "pocket", pocket_counts_both_legs, 1);
    add(suite, "pace", change_of_pace_loses_no_step, 1);
    add(suite, "corrected", false_peak_is_corrected_by_the_true_one, 1);
    add(suite, "false after true", false_peak_after_the_true_one_is_none, 1);
    add(suite, "first peak", first_peak_stays_if_told_so, 1);
    add(suite, "jitter", weak_sensor_scale_and_jitter_do_no_harm, 1);
    add(suite, "standing", standing_is_no_step, 1);
    add(suite, "tapping", tapping_is_no_step, 1);
    add(suite, "turning", turning_on_the_spot_is_no_step, 1);
    add(suite, "fidgeting", fidgeting_is_seldom_a_step, 1);
    add(suite, "putting away", putting_the_phone_away_after_a_walk_is_no_walk, 1);
    add(suite, "few peaks", few_peaks_are_no_walk, 1);
    add(suite, "no gate", without_the_gate_two_peaks_are_a_walk, 1);
    add(suite, "gap", gap_costs_the_steps_within_it_alone, 1);
    add(suite, "years", clock_of_years_changes_nothing, 1);
    add(suite, "begin of time", first_step_at_the_begin_of_time_does_not_wrap, 1);
    add(suite, "copy", copy_goes_on_like_the_original, 1);
    add(suite, "bad samples", bad_samples_are_refused_and_counted, 1);
    add(suite, "any signal", any_signal_gives_finite_footfalls, 1);
    add(suite, "room", steps_that_nobody_takes_out_stop_the_counter, 1);
    add(suite, "settings", settings_have_ends, 1);
    add(suite, "held", held_steps_are_those_that_will_be_told, 1);
    add(suite, "held behind", held_steps_wait_behind_those_not_taken_out, 1);
    add(suite, "bad arguments", bad_arguments_are_refused, 1);
    return suite;
}
