/* SPDX-License-Identifier: MIT
 * The foot path on a synthetic walk: two seconds of rest, then a stride a second at 200 Hz. */
#include "bench.h"

#define STANCE_S     INSOLE_R(0.4)
#define SWING_S      INSOLE_R(0.6)
#define PITCH_RAD    INSOLE_R(0.9)
#define SPEED_MPS    INSOLE_R(1.2)
#define LIFT_M       INSOLE_R(0.06)
#define GRAVITY_MPS2 INSOLE_R(9.81)

enum { RATE_HZ = 200, REST = 2 * RATE_HZ, WALK = 10 * RATE_HZ };

static insole_imu_t imu;

/* The foot in the plane of its walk, at `phase` (0 to 1) of the swing. */
static void make_swing(insole_real_t phase)
{
    insole_real_t angle = INSOLE_R(2.0) * INSOLE_PI * phase;
    insole_real_t rate = INSOLE_R(2.0) * INSOLE_PI / SWING_S;
    insole_real_t c = insole_cos(angle), s = insole_sin(angle);
    insole_real_t pitch = INSOLE_R(0.5) * PITCH_RAD * (INSOLE_R(1.0) - c);
    insole_real_t ahead = SPEED_MPS * rate * s;
    insole_real_t up = GRAVITY_MPS2 + INSOLE_R(0.5) * LIFT_M * rate * rate * c;
    insole_real_t cp = insole_cos(pitch), sp = insole_sin(pitch);
    imu.accel_mps2 = insole_vec3(cp * ahead - sp * up, INSOLE_R(0.0), sp * ahead + cp * up);
    imu.gyro_radps =
        insole_vec3(INSOLE_R(0.0), INSOLE_R(0.5) * PITCH_RAD * rate * s, INSOLE_R(0.0));
}

/* Noise of a good consumer sensor, so that no detector sees exact zeros. */
static void add_noise(void)
{
    insole_vec3_t a = bench_vec3_between(INSOLE_R(-0.03), INSOLE_R(0.03));
    insole_vec3_t w = bench_vec3_between(INSOLE_R(-0.003), INSOLE_R(0.003));
    imu.accel_mps2 = insole_vec3_add(imu.accel_mps2, a);
    imu.gyro_radps = insole_vec3_add(imu.gyro_radps, w);
}

static void make_sample(uint32_t call)
{
    imu.t_us = (uint64_t)(call + 1u) * (1000000u / RATE_HZ);
    imu.accel_mps2 = insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), GRAVITY_MPS2);
    imu.gyro_radps = insole_vec3_zero();
    uint32_t in_stride = call < REST ? 0u : (call - REST) % RATE_HZ;
    insole_real_t since_s = (insole_real_t)in_stride / (insole_real_t)RATE_HZ;
    if (since_s > STANCE_S) {
        make_swing((since_s - STANCE_S) / SWING_S);
    }
    add_noise();
}

static insole_screen_t screen;
static insole_clean_t clean;

static void begin_screen(void)
{
    insole_screen_init(&screen, &insole_screen_defaults);
}

static void call_insole_screen_push(uint32_t call)
{
    (void)call;
    insole_screen_push(&screen, &imu, &clean);
    bench_take_vec3(0u, clean.imu.accel_mps2);
}

static insole_still_bias_t rest;

static void begin_rest(void)
{
    insole_still_bias_init(&rest, &insole_still_bias_defaults);
}

static void call_insole_still_bias_push(uint32_t call)
{
    (void)call;
    insole_still_bias_push(&rest, &imu);
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
    insole_zero_velocity_push(&stance, &imu, 0u);
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
    insole_vec3_t up = insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), GRAVITY_MPS2);
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
    insole_zupt_ekf_predict(&ekf, &imu, 0u);
}

static void call_insole_zupt_ekf_predict_12(uint32_t call)
{
    (void)call;
    insole_zupt_ekf_predict(&ekf, &imu, 0u);
}

static void make_sample_and_predict(uint32_t call)
{
    make_sample(call);
    insole_zupt_ekf_predict(&ekf, &imu, 0u);
}

static void call_insole_zupt_ekf_correct_9(uint32_t call)
{
    (void)call;
    insole_zupt_ekf_correct(&ekf, NULL);
}

static void call_insole_zupt_ekf_correct_12(uint32_t call)
{
    (void)call;
    insole_zupt_ekf_correct(&ekf, NULL);
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
    insole_foot_tracker_imu(&shoe, &imu);
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
    {"insole_screen_push", WALK, begin_screen, make_sample, call_insole_screen_push, NULL},
    {"insole_still_bias_push", WALK, begin_rest, make_sample, call_insole_still_bias_push, NULL},
    {"insole_zero_velocity_push_next", WALK, begin_stance, make_sample,
     call_insole_zero_velocity_push_next, NULL},
    {"insole_zupt_ekf_predict_9", WALK, begin_nine, make_sample, call_insole_zupt_ekf_predict_9,
     take_ekf},
    {"insole_zupt_ekf_predict_12", WALK, begin_twelve, make_sample, call_insole_zupt_ekf_predict_12,
     take_ekf},
    {"insole_zupt_ekf_correct_9", REST, begin_nine, make_sample_and_predict,
     call_insole_zupt_ekf_correct_9, take_ekf},
    {"insole_zupt_ekf_correct_12", REST, begin_twelve, make_sample_and_predict,
     call_insole_zupt_ekf_correct_12, take_ekf},
    {"insole_foot_tracker_imu_next", WALK, begin_shoe, make_sample,
     call_insole_foot_tracker_imu_next, take_fix},
    {"insole_foot_tracker_imu_next_9", WALK, begin_shoe_9, make_sample,
     call_insole_foot_tracker_imu_next_9, take_fix},
};

const bench_table_t bench_foot = BENCH_TABLE(cases);
