/* SPDX-License-Identifier: MIT
 * The foot path on a made-up walk. */
#include "bench.h"
#include "bench_walk.h"

static insole_screen_t screen;
static insole_clean_t clean;

static void begin_screen(void)
{
    insole_screen_init(&screen, &insole_screen_defaults);
}

static void call_insole_screen_push(uint32_t call)
{
    (void)call;
    insole_screen_push(&screen, &bench_imu, &clean);
    bench_take_vec3(0u, clean.imu.accel_mps2);
}

static insole_still_bias_t rest;

static void begin_rest(void)
{
    insole_still_bias_init(&rest, &insole_still_bias_defaults);
}

static void call_insole_still_bias_take(uint32_t call)
{
    (void)call;
    insole_still_bias_take(&rest, &bench_imu);
    bench_take_vec3(0u, rest.gyro_bias_radps);
}

static insole_zero_velocity_t stance;

static void begin_stance(void)
{
    insole_zero_velocity_init(&stance, &insole_zero_velocity_defaults);
}

static void call_insole_zero_velocity_push_next(uint32_t call)
{
    insole_labelled_t out;
    (void)call;
    insole_zero_velocity_push(&stance, &bench_imu, 0u);
    while (insole_zero_velocity_next(&stance, &out) == INSOLE_OK) {
        bench_result[0] = out.statistic;
        bench_result[1] = out.still ? INSOLE_R(1.0) : INSOLE_R(0.0);
    }
}

static insole_zupt_ekf_t ekf;

static void align(insole_real_t sigma_accel_bias_mps2)
{
    insole_zupt_ekf_config_t config = insole_zupt_ekf_defaults;
    config.sigma_accel_bias_mps2 = sigma_accel_bias_mps2;
    insole_zupt_ekf_init(&ekf, &config);
    insole_vec3_t up =
        insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), insole_zupt_ekf_defaults.gravity_mps2);
    insole_zupt_ekf_align(&ekf, up, INSOLE_R(0.01), INSOLE_R(0.0), 1u);
}

static void begin_nine(void)
{
    align(INSOLE_R(0.0));
}

static void begin_twelve(void)
{
    align(INSOLE_R(0.05));
}

static void take_ekf(void)
{
    bench_take_vec3(0u, ekf.p_m);
    bench_take_quat(3u, ekf.q);
    bench_take_vec3(7u, ekf.P.pv.r1);
}

static void call_insole_zupt_ekf_predict_9(uint32_t call)
{
    (void)call;
    insole_zupt_ekf_predict(&ekf, &bench_imu, 0u);
}

static void call_insole_zupt_ekf_predict_12(uint32_t call)
{
    (void)call;
    insole_zupt_ekf_predict(&ekf, &bench_imu, 0u);
}

static void make_sample_and_predict(uint32_t call)
{
    bench_make_sample(call);
    insole_zupt_ekf_predict(&ekf, &bench_imu, 0u);
}

static void call_insole_zupt_ekf_settle_9(uint32_t call)
{
    (void)call;
    insole_zupt_ekf_settle(&ekf);
}

static void call_insole_zupt_ekf_settle_12(uint32_t call)
{
    (void)call;
    insole_zupt_ekf_settle(&ekf);
}

static void make_sample_and_settle(uint32_t call)
{
    make_sample_and_predict(call);
    insole_zupt_ekf_settle(&ekf);
}

static void call_insole_zupt_ekf_correct_9(uint32_t call)
{
    (void)call;
    insole_zupt_ekf_correct(&ekf, ekf.dt_s, NULL);
}

static void call_insole_zupt_ekf_correct_12(uint32_t call)
{
    (void)call;
    insole_zupt_ekf_correct(&ekf, ekf.dt_s, NULL);
}

static insole_foot_tracker_t shoe;
static insole_fix_t fix;

static void begin_shoe(void)
{
    insole_foot_tracker_init(&shoe, &insole_foot_tracker_defaults);
}

static void begin_shoe_9(void)
{
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    config.zupt_ekf.sigma_accel_bias_mps2 = INSOLE_R(0.0);
    insole_foot_tracker_init(&shoe, &config);
}

static void take_fix(void)
{
    bench_take_vec3(0u, fix.position_m);
    bench_result[3] = fix.heading_rad;
    bench_result[4] = fix.var_x_m2;
    bench_result[5] = (insole_real_t)fix.state;
}

static void push_sample(void)
{
    insole_foot_tracker_imu(&shoe, &bench_imu);
    while (insole_foot_tracker_next(&shoe, &fix) == INSOLE_OK) {
    }
}

static void call_insole_foot_tracker_imu_next(uint32_t call)
{
    (void)call;
    push_sample();
}

static void call_insole_foot_tracker_imu_next_9(uint32_t call)
{
    (void)call;
    push_sample();
}

static const bench_case_t cases[] = {
    {"insole_screen_push", BENCH_WALK, begin_screen, bench_make_sample, call_insole_screen_push,
     NULL},
    {"insole_still_bias_take", BENCH_WALK, begin_rest, bench_make_sample,
     call_insole_still_bias_take, NULL},
    {"insole_zero_velocity_push_next", BENCH_WALK, begin_stance, bench_make_sample,
     call_insole_zero_velocity_push_next, NULL},
    {"insole_zupt_ekf_predict_9", BENCH_WALK, begin_nine, bench_make_sample,
     call_insole_zupt_ekf_predict_9, take_ekf},
    {"insole_zupt_ekf_predict_12", BENCH_WALK, begin_twelve, bench_make_sample,
     call_insole_zupt_ekf_predict_12, take_ekf},
    {"insole_zupt_ekf_settle_9", BENCH_WALK, begin_nine, make_sample_and_predict,
     call_insole_zupt_ekf_settle_9, take_ekf},
    {"insole_zupt_ekf_settle_12", BENCH_WALK, begin_twelve, make_sample_and_predict,
     call_insole_zupt_ekf_settle_12, take_ekf},
    {"insole_zupt_ekf_correct_9", BENCH_REST, begin_nine, make_sample_and_settle,
     call_insole_zupt_ekf_correct_9, take_ekf},
    {"insole_zupt_ekf_correct_12", BENCH_REST, begin_twelve, make_sample_and_settle,
     call_insole_zupt_ekf_correct_12, take_ekf},
    {"insole_foot_tracker_imu_next", BENCH_WALK, begin_shoe, bench_make_sample,
     call_insole_foot_tracker_imu_next, take_fix},
    {"insole_foot_tracker_imu_next_9", BENCH_WALK, begin_shoe_9, bench_make_sample,
     call_insole_foot_tracker_imu_next_9, take_fix},
};

const bench_table_t bench_foot = BENCH_TABLE(cases);
