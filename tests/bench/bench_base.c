/* SPDX-License-Identifier: MIT
 * base/: float functions, quaternions, matrices, random numbers, snapshots. */
#include "bench.h"

static insole_real_t x, y;
static insole_vec3_t v;
static insole_quat_t q, p;
static insole_mat3_t A, B, C;
static insole_sym3_t S, S_inverse;
static uint8_t bytes[256];

static void make_angle(uint32_t call)
{
    (void)call;
    x = bench_between(INSOLE_R(-10.0), INSOLE_R(10.0));
}

static void make_positive(uint32_t call)
{
    (void)call;
    x = bench_between(INSOLE_R(0.0), INSOLE_R(100.0));
}

static void make_point(uint32_t call)
{
    (void)call;
    x = bench_between(INSOLE_R(-1.0), INSOLE_R(1.0));
    y = bench_between(INSOLE_R(-1.0), INSOLE_R(1.0));
}

/* Small and large rotations by turns. */
static void make_rotation(uint32_t call)
{
    insole_real_t size = call % 2u != 0u ? INSOLE_R(0.05) : INSOLE_R(2.0);
    v = bench_vec3_between(-size, size);
}

static void make_quats(uint32_t call)
{
    (void)call;
    q = insole_quat_from_rotvec(bench_vec3_between(INSOLE_R(-1.0), INSOLE_R(1.0)));
    p = insole_quat_from_rotvec(bench_vec3_between(INSOLE_R(-1.0), INSOLE_R(1.0)));
    v = bench_vec3_between(INSOLE_R(-10.0), INSOLE_R(10.0));
}

static insole_mat3_t matrix(void)
{
    insole_vec3_t r0 = bench_vec3_between(INSOLE_R(-1.0), INSOLE_R(1.0));
    insole_vec3_t r1 = bench_vec3_between(INSOLE_R(-1.0), INSOLE_R(1.0));
    return insole_mat3_rows(r0, r1, bench_vec3_between(INSOLE_R(-1.0), INSOLE_R(1.0)));
}

static void make_matrices(uint32_t call)
{
    (void)call;
    A = matrix();
    B = matrix();
    S = insole_sym3_add_diagonal(insole_mat3_mul_t_sym(A, A), INSOLE_R(0.1));
}

static void take_matrix(insole_mat3_t M)
{
    bench_take_vec3(0u, M.r0);
    bench_take_vec3(3u, M.r1);
    bench_take_vec3(6u, M.r2);
}

static void call_insole_sin(uint32_t call)
{
    (void)call;
    bench_result[0] = insole_sin(x);
}

static void call_insole_cos(uint32_t call)
{
    (void)call;
    bench_result[0] = insole_cos(x);
}

static void call_insole_atan2(uint32_t call)
{
    (void)call;
    bench_result[0] = insole_atan2(y, x);
}

static void call_insole_exp(uint32_t call)
{
    (void)call;
    bench_result[0] = insole_exp(x);
}

static void call_insole_log(uint32_t call)
{
    (void)call;
    bench_result[0] = insole_log(x);
}

static void call_insole_wrap_pi(uint32_t call)
{
    (void)call;
    bench_result[0] = insole_wrap_pi(x);
}

static void call_insole_quat_from_rotvec(uint32_t call)
{
    (void)call;
    bench_take_quat(0u, insole_quat_from_rotvec(v));
}

static void call_insole_quat_normalize(uint32_t call)
{
    (void)call;
    bench_take_quat(0u, insole_quat_normalize(q));
}

static void call_insole_quat_mul(uint32_t call)
{
    (void)call;
    bench_take_quat(0u, insole_quat_mul(q, p));
}

static void call_insole_quat_rotate(uint32_t call)
{
    (void)call;
    bench_take_vec3(0u, insole_quat_rotate(q, v));
}

static void call_insole_mat3_mul(uint32_t call)
{
    (void)call;
    C = insole_mat3_mul(A, B);
}

static void call_insole_sym3_inverse(uint32_t call)
{
    (void)call;
    bench_result[9] = insole_sym3_inverse(S, &S_inverse) ? INSOLE_R(1.0) : INSOLE_R(0.0);
}

/* Results that the call leaves in a matrix are taken over when the next arguments are made. */
static void make_matrices_and_take(uint32_t call)
{
    take_matrix(C);
    bench_take_vec3(10u, insole_vec3(S_inverse.xx, S_inverse.yy, S_inverse.xz));
    make_matrices(call);
}

static void call_insole_rng_normal(uint32_t call)
{
    (void)call;
    bench_result[0] = insole_rng_normal(&bench_rng);
}

static void call_insole_crc32_256_bytes(uint32_t call)
{
    bytes[call] = (uint8_t)call;
    bench_result[0] = (insole_real_t)(insole_crc32(0u, bytes, sizeof bytes) >> 8);
}

static const bench_case_t cases[] = {
    {"insole_sin", 256u, NULL, make_angle, call_insole_sin, NULL},
    {"insole_cos", 256u, NULL, make_angle, call_insole_cos, NULL},
    {"insole_atan2", 256u, NULL, make_point, call_insole_atan2, NULL},
    {"insole_exp", 256u, NULL, make_angle, call_insole_exp, NULL},
    {"insole_log", 256u, NULL, make_positive, call_insole_log, NULL},
    {"insole_wrap_pi", 256u, NULL, make_angle, call_insole_wrap_pi, NULL},
    {"insole_quat_from_rotvec", 256u, NULL, make_rotation, call_insole_quat_from_rotvec, NULL},
    {"insole_quat_normalize", 256u, NULL, make_quats, call_insole_quat_normalize, NULL},
    {"insole_quat_mul", 256u, NULL, make_quats, call_insole_quat_mul, NULL},
    {"insole_quat_rotate", 256u, NULL, make_quats, call_insole_quat_rotate, NULL},
    {"insole_mat3_mul", 256u, NULL, make_matrices_and_take, call_insole_mat3_mul, NULL},
    {"insole_sym3_inverse", 256u, NULL, make_matrices_and_take, call_insole_sym3_inverse, NULL},
    {"insole_rng_normal", 256u, NULL, NULL, call_insole_rng_normal, NULL},
    {"insole_crc32_256_bytes", 256u, NULL, NULL, call_insole_crc32_256_bytes, NULL},
};

const bench_table_t bench_base = BENCH_TABLE(cases);
