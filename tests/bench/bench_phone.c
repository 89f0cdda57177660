/* SPDX-License-Identifier: MIT
 * The phone path on a synthetic walk: a phone held at a slant, bouncing twice a second, at 50 Hz.
 */
#include <stddef.h>

#include "bench.h"

#define GRAVITY_MPS2 INSOLE_R(9.81)

enum { RATE_HZ = 50, WALK = 20 * RATE_HZ };

static insole_imu_t imu;

static void make_sample(uint32_t call)
{
    insole_real_t t = (insole_real_t)call / (insole_real_t)RATE_HZ;
    insole_turn_t bounce = insole_turn(INSOLE_R(4.0) * INSOLE_PI * t);
    insole_vec3_t up = insole_vec3(INSOLE_R(0.1), INSOLE_R(0.5), INSOLE_R(0.86));
    insole_real_t force = GRAVITY_MPS2 + INSOLE_R(2.0) * bounce.sin;
    insole_vec3_t noise = bench_vec3_between(INSOLE_R(-0.3), INSOLE_R(0.3));
    imu.t_us = (uint64_t)(call + 1u) * (1000000u / RATE_HZ);
    imu.accel_mps2 = insole_vec3_add(insole_vec3_scale(up, force), noise);
    imu.gyro_radps = insole_vec3(INSOLE_R(0.2) * bounce.cos, INSOLE_R(0.1) * bounce.sin,
                                 bench_between(INSOLE_R(-0.3), INSOLE_R(0.3)));
}

static insole_attitude_t phone;

static void begin_phone(void)
{
    insole_attitude_init(&phone, &insole_attitude_defaults);
}

static void push(insole_attitude_method_t *method)
{
    insole_attitude_push(&phone, method, &imu, 0u);
    bench_take_quat(0u, phone.q);
    bench_take_vec3(4u, insole_vec3(phone.P.xx, phone.P.yy, phone.P.zz));
}

static void call_insole_attitude_push_gyro(uint32_t call)
{
    (void)call;
    push(NULL);
}

static void call_insole_attitude_push_ekf(uint32_t call)
{
    (void)call;
    push(insole_attitude_ekf);
}

static void call_insole_attitude_push_ukf(uint32_t call)
{
    (void)call;
    push(insole_attitude_ukf);
}

static void make_attitude(uint32_t call)
{
    make_sample(call);
    push(insole_attitude_ekf);
}

static void call_insole_heading(uint32_t call)
{
    (void)call;
    insole_heading_t heading = insole_heading(phone.q, &phone.P);
    bench_result[0] = heading.heading_rad;
    bench_result[1] = heading.variance_rad2;
}

static const bench_case_t cases[] = {
    {"insole_attitude_push_gyro", WALK, begin_phone, make_sample, call_insole_attitude_push_gyro},
    {"insole_attitude_push_ekf", WALK, begin_phone, make_sample, call_insole_attitude_push_ekf},
    {"insole_attitude_push_ukf", WALK, begin_phone, make_sample, call_insole_attitude_push_ukf},
    {"insole_heading", WALK, begin_phone, make_attitude, call_insole_heading},
};

const bench_table_t bench_phone = BENCH_TABLE(cases);
