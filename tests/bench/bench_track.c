/* SPDX-License-Identifier: MIT
 * track/: the ready-made path of the shoe. Samples with and without a correction apart, and whole
 * seconds of a walk in an office, with all that falls due in them. */
#include "bench.h"
#include "bench_office.h"
#include "bench_walk.h"

#define BEGIN_X_M    INSOLE_R(2.0)
#define CORRIDOR_Y_M INSOLE_R(6.1)
#define STRIDE_M     INSOLE_R(0.72)

enum { PARTICLES = 500, SLICE = 50, SECONDS = 8, SORTED = 600 };

/* ---- a sample ---- */

static insole_foot_tracker_t shoe, ahead; /* `ahead` has had the sample that comes next */
static insole_fix_t fix;
static uint32_t made;

static void push_to(insole_foot_tracker_t *tracker)
{
    insole_foot_tracker_imu(tracker, &bench_imu);
    while (insole_foot_tracker_next(tracker, &fix) == INSOLE_OK) {
    }
}

static void make_next(void)
{
    bench_make_sample(made++);
    push_to(&ahead);
}

static void begin_sorted(void)
{
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    config.zupt_ekf.sigma_accel_bias_mps2 = INSOLE_R(0.0);
    insole_foot_tracker_init(&shoe, &config);
    insole_foot_tracker_init(&ahead, &config);
    made = 0u;
    while (shoe.counts.corrections == 0u) {
        make_next();
        push_to(&shoe);
    }
}

static void make_until(bool corrected)
{
    make_next();
    while ((ahead.counts.corrections > shoe.counts.corrections) != corrected) {
        push_to(&shoe);
        make_next();
    }
}

static void make_corrected(uint32_t call)
{
    (void)call;
    make_until(true);
}

static void make_moving(uint32_t call)
{
    (void)call;
    make_until(false);
}

static void take_fix(void)
{
    bench_take_vec3(0u, fix.position_m);
    bench_result[3] = fix.heading_rad;
    bench_result[4] = fix.var_x_m2;
}

static void call_insole_foot_tracker_imu_next_9_moving(uint32_t call)
{
    (void)call;
    push_to(&shoe);
}

static void call_insole_foot_tracker_imu_next_9_corrected(uint32_t call)
{
    (void)call;
    push_to(&shoe);
}

/* ---- a second ---- */

static insole_particle_t particles[PARTICLES];
static insole_foot_fusion_t fusion;
static insole_imu_t samples[BENCH_RATE_HZ];

static void make_samples(void)
{
    for (uint32_t i = 0u; i < BENCH_RATE_HZ; i++) {
        bench_make_sample(made++);
        samples[i] = bench_imu;
    }
}

static void push_samples(void)
{
    for (uint32_t i = 0u; i < BENCH_RATE_HZ; i++) {
        insole_foot_fusion_imu(&fusion, &samples[i]);
        while (insole_foot_fusion_next(&fusion, &fix) == INSOLE_OK) {
        }
        while (insole_foot_fusion_work(&fusion, SLICE)) {
        }
    }
}

/* The two seconds of rest; in the second the walker's place is told. */
static void begin_fusion(int32_t method, bool has_bias)
{
    static const insole_fusion_memory_t memory = {.particles = particles, .count = PARTICLES};
    insole_foot_fusion_config_t config = insole_foot_fusion_defaults;
    insole_start_t start = {1000000u,      BEGIN_X_M,     CORRIDOR_Y_M, true,
                            INSOLE_R(0.0), INSOLE_R(0.3), INSOLE_R(0.1)};
    config.method = method;
    config.foot.zupt_ekf.sigma_accel_bias_mps2 *= has_bias ? INSOLE_R(1.0) : INSOLE_R(0.0);
    bench_build_office(7u, 13u);
    bench_put_aps();
    insole_foot_fusion_init(&fusion, &config, &memory, &bench_building, 1u);
    insole_foot_fusion_start(&fusion, &start);
    for (made = 0u; made < BENCH_REST;) {
        make_samples();
        push_samples();
    }
}

static void begin_best(void)
{
    begin_fusion(INSOLE_FUSION_BEST, true);
}

static void begin_two_order(void)
{
    begin_fusion(INSOLE_FUSION_TWO_ORDER, true);
}

static void begin_nine(void)
{
    begin_fusion(INSOLE_FUSION_BEST, false);
}

static void make_second(uint32_t call)
{
    insole_spot_t at = {BEGIN_X_M + STRIDE_M * (insole_real_t)call, CORRIDOR_Y_M};
    bench_listen(at, INSOLE_R(0.0));
    make_samples();
}

static void pass_second(void)
{
    insole_scan_t scan = {samples[0].t_us, bench_readings, BENCH_APS};
    insole_foot_fusion_scan(&fusion, &scan);
    push_samples();
}

static void call_insole_foot_fusion_second(uint32_t call)
{
    (void)call;
    pass_second();
}

static void call_insole_foot_fusion_second_9(uint32_t call)
{
    (void)call;
    pass_second();
}

static void call_insole_foot_fusion_second_two_order(uint32_t call)
{
    (void)call;
    pass_second();
}

static const bench_case_t cases[] = {
    {"insole_foot_tracker_imu_next_9_moving", SORTED, begin_sorted, make_moving,
     call_insole_foot_tracker_imu_next_9_moving, take_fix},
    {"insole_foot_tracker_imu_next_9_corrected", SORTED, begin_sorted, make_corrected,
     call_insole_foot_tracker_imu_next_9_corrected, take_fix},
    {"insole_foot_fusion_second", SECONDS, begin_best, make_second, call_insole_foot_fusion_second,
     take_fix},
    {"insole_foot_fusion_second_9", SECONDS, begin_nine, make_second,
     call_insole_foot_fusion_second_9, take_fix},
    {"insole_foot_fusion_second_two_order", SECONDS, begin_two_order, make_second,
     call_insole_foot_fusion_second_two_order, take_fix},
};

const bench_table_t bench_track = BENCH_TABLE(cases);
