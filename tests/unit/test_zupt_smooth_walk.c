/* SPDX-License-Identifier: MIT
 * What smoothing is worth on a walk, and whether it knows that. */
#include "insole/move/zupt_smooth.h"
#include "near.h"
#include "noisy_gait.h"
#include "suite.h"

enum { SAMPLES = 2400, ROOM = 4096, RUNS = 100, STRIDE = 200 };

static noisy_sample_t samples[SAMPLES];
static insole_zupt_node_t nodes[ROOM];
static insole_zupt_smoothed_t smoothed[SAMPLES];

/* What was true, and what the filter thought, at each sample of a run. */
typedef struct {
    d3_t p, v;
    insole_vec3_t filtered_p, filtered_v;
    insole_sym3_t filtered_P;
    d33_t filtered_C;
} record_t;
static record_t records[SAMPLES];

/* A walk through a history of `room` samples of which each window keeps half. */
static void walk_and_smooth(uint64_t seed, uint32_t room)
{
    gait_t gait = gait_usual();
    noisy_gait_t run;
    insole_zupt_smooth_t smooth;
    int taken = 0;
    noisy_gait_begin(&run, &gait, seed);
    ck_assert_int_eq(insole_zupt_smooth_init(&smooth, nodes, room), INSOLE_OK);
    for (int k = 0; k < SAMPLES; k++) {
        noisy_gait_step(&run, samples);
        record_t r = {d3_add(samples[k].end.p, 1.0, run.drift),
                      d3_add(samples[k].end.v, 1.0, run.tremble),
                      run.ekf.p_m,
                      run.ekf.v_mps,
                      filter_cov(&run.ekf).pp,
                      d33_of(insole_quat_to_mat3(run.ekf.q))};
        records[k] = r;
        if (insole_zupt_smooth_push(&smooth, &run.ekf) == INSOLE_ERR_ROOM) {
            (void)insole_zupt_smooth_run(&smooth, room / 2u);
            while (insole_zupt_smooth_take(&smooth, &smoothed[taken]) == INSOLE_OK) {
                taken++;
            }
            ck_assert_int_eq(insole_zupt_smooth_push(&smooth, &run.ekf), INSOLE_OK);
        }
    }
    (void)insole_zupt_smooth_run(&smooth, 0u);
    while (insole_zupt_smooth_take(&smooth, &smoothed[taken]) == INSOLE_OK) {
        taken++;
    }
    ck_assert_int_eq(taken, SAMPLES);
}

static void begin(void)
{
    gait_t gait = gait_usual();
    noisy_gait_fill(samples, SAMPLES, &gait);
}

/* In the air, away from both stances. */
static bool is_swing(int k)
{
    gait_t gait = gait_usual();
    double number, phase = gait_phase(&gait, 1.0e-6 * FILTER_STEP_US * (k + 1), &number);
    return phase > 0.3 && phase < 0.9;
}

static d3_t position_error(int k, bool after)
{
    return d3_add(records[k].p, -1.0, d3_of(after ? smoothed[k].p_m : records[k].filtered_p));
}

static d3_t velocity_error(int k, bool after)
{
    return d3_add(records[k].v, -1.0, d3_of(after ? smoothed[k].v_mps : records[k].filtered_v));
}

static double tilt_error(int k, bool after)
{
    d33_t C = after ? d33_of(insole_quat_to_mat3(smoothed[k].q)) : records[k].filtered_C;
    d3_t turn = turn_between(C, samples[k].end.R);
    return hypot(turn.x, turn.y);
}

/* Sums of squares over the swings: filtered, smoothed. */
typedef struct {
    double place[2];  /* position */
    double stride[2]; /* position since the last stance */
    double velocity[2], tilt[2];
} squares_t;

static void add_squares(squares_t *sum, int k, int last_still)
{
    for (int after = 0; after < 2; after++) {
        d3_t p = position_error(k, after), v = velocity_error(k, after);
        d3_t since = d3_add(p, -1.0, position_error(last_still, after));
        sum->place[after] += d3_dot(p, p);
        sum->stride[after] += d3_dot(since, since);
        sum->velocity[after] += d3_dot(v, v);
        sum->tilt[after] += pow(tilt_error(k, after), 2.0);
    }
}

static double ratio(const double squares[2])
{
    return sqrt(squares[1] / squares[0]);
}

/* What is wrong in the air comes to light on the ground. */
START_TEST(brings_the_swing_nearer_to_the_truth)
{
    squares_t sum = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
    begin();
    for (uint64_t seed = 1u; seed <= RUNS; seed++) {
        walk_and_smooth(seed, ROOM);
        int last_still = 0;
        for (int k = 0; k < SAMPLES - STRIDE; k++) {
            last_still = samples[k].still ? k : last_still;
            if (is_swing(k)) {
                add_squares(&sum, k, last_still);
            }
        }
    }
    ASSERT_AT_MOST(ratio(sum.place), 0.95, "of the filter's error");
    ASSERT_AT_MOST(ratio(sum.stride), 0.7, "of the filter's error");
    ASSERT_AT_MOST(ratio(sum.velocity), 0.65, "of the filter's error");
    ASSERT_AT_MOST(ratio(sum.tilt), 0.65, "of the filter's error");
}
END_TEST

static dense_t position_block(insole_sym3_t P)
{
    dense_t d = dense_diagonal(0.0);
    dense_put(&d, 0, 0, insole_sym3_full(P));
    return d;
}

/* Its covariance is smaller than the filter's and still not too small. */
START_TEST(knows_how_good_it_is)
{
    double nees = 0.0, count = 0.0;
    begin();
    for (uint64_t seed = 1u; seed <= RUNS; seed++) {
        walk_and_smooth(seed, ROOM);
        for (int k = 0; k < SAMPLES; k++) {
            if (is_swing(k)) {
                d3_t e = position_error(k, true);
                column_t x = {{e.x, e.y, e.z}};
                dense_t P = position_block(smoothed[k].P_pp_m2);
                nees += dense_mahalanobis(&P, &x, 0, 3);
                count += 1.0;
            }
        }
    }
    /* the error of a run hardly changes from sample to sample: as many draws as runs */
    ASSERT_NEAR(nees / count, 3.0, 4.0 * sqrt(2.0 * 3.0 / RUNS), "(chi2 of 3)");
}
END_TEST

START_TEST(never_becomes_less_certain)
{
    worst_t more = {0.0, 0.0}, negative = {0.0, 0.0};
    double gained = 0.0;
    begin();
    walk_and_smooth(1u, ROOM);
    for (int k = 100; k < SAMPLES; k++) {
        dense_t before = position_block(records[k].filtered_P);
        dense_t after = position_block(smoothed[k].P_pp_m2);
        dense_t less = dense_add(before, -1.0, &after);
        worst_note(&more, -dense_least_eigenvalue(less, 3) / before.at[2][2], k);
        worst_note(&negative, -dense_least_eigenvalue(after, 3) / after.at[2][2], k);
        gained = fmax(gained, 1.0 - after.at[2][2] / before.at[2][2]);
    }
    ASSERT_WORST(more, 10.0 * (double)INSOLE_REAL_EPSILON, "(of the filter's)");
    ASSERT_WORST(negative, 0.0, "(of itself)");
    ASSERT_AT_LEAST(gained, 0.5, "of the variance of the height, at best");
}
END_TEST

/* Windows of ten seconds of which five are kept: the whole walk knows a little more of the bias. */
START_TEST(smooths_in_windows_like_the_whole)
{
    static insole_zupt_smoothed_t whole[SAMPLES];
    worst_t off = {0.0, 0.0}, moved = {0.0, 0.0};
    begin();
    walk_and_smooth(1u, ROOM);
    memcpy(whole, smoothed, sizeof whole);
    walk_and_smooth(1u, 2048u);
    for (int k = 0; k < SAMPLES; k++) {
        ck_assert_uint_eq(smoothed[k].t_us, whole[k].t_us);
        d3_t by = d3_add(d3_of(whole[k].p_m), -1.0, d3_of(records[k].filtered_p));
        d3_t apart = d3_add(d3_of(whole[k].p_m), -1.0, d3_of(smoothed[k].p_m));
        worst_note(&moved, d3_norm(by), k);
        worst_note(&off, d3_norm(apart), k);
    }
    ASSERT_WORST(off, 0.005, "m");
    ASSERT_AT_LEAST(moved.off, 0.02, "m by which smoothing moves a sample at most");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zupt_smooth walk");
    suite_add(suite, "errors of the swing", brings_the_swing_nearer_to_the_truth);
    suite_add(suite, "consistency", knows_how_good_it_is);
    suite_add(suite, "certainty", never_becomes_less_certain);
    suite_add(suite, "windows", smooths_in_windows_like_the_whole);
    return suite;
}
