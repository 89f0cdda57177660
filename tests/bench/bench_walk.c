/* SPDX-License-Identifier: MIT */
#include "bench_walk.h"

#include "bench.h"

#define STANCE_S     INSOLE_R(0.4)
#define SWING_S      INSOLE_R(0.6)
#define PITCH_RAD    INSOLE_R(0.9)
#define SPEED_MPS    INSOLE_R(1.2)
#define LIFT_M       INSOLE_R(0.06)
#define GRAVITY_MPS2 INSOLE_R(9.81)

insole_imu_t bench_imu;

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
    bench_imu.accel_mps2 = insole_vec3(cp * ahead - sp * up, INSOLE_R(0.0), sp * ahead + cp * up);
    bench_imu.gyro_radps =
        insole_vec3(INSOLE_R(0.0), INSOLE_R(0.5) * PITCH_RAD * rate * s, INSOLE_R(0.0));
}

/* Noise of a good consumer sensor, so that no detector sees exact zeros. */
static void add_noise(void)
{
    insole_vec3_t a = bench_vec3_between(INSOLE_R(-0.03), INSOLE_R(0.03));
    insole_vec3_t w = bench_vec3_between(INSOLE_R(-0.003), INSOLE_R(0.003));
    bench_imu.accel_mps2 = insole_vec3_add(bench_imu.accel_mps2, a);
    bench_imu.gyro_radps = insole_vec3_add(bench_imu.gyro_radps, w);
}

void bench_make_sample(uint32_t call)
{
    bench_imu.t_us = (uint64_t)(call + 1u) * (1000000u / BENCH_RATE_HZ);
    bench_imu.accel_mps2 = insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), GRAVITY_MPS2);
    bench_imu.gyro_radps = insole_vec3_zero();
    uint32_t in_stride = call < BENCH_REST ? 0u : (call - BENCH_REST) % BENCH_RATE_HZ;
    insole_real_t since_s = (insole_real_t)in_stride / (insole_real_t)BENCH_RATE_HZ;
    if (since_s > STANCE_S) {
        make_swing((since_s - STANCE_S) / SWING_S);
    }
    add_noise();
}
