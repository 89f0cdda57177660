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
}

static void take_attitude(void)
{
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

/* The walk's direction: level accelerations on an ellipse, steps of half a second. */

static insole_walk_heading_t walk;
static insole_footfall_t footfall;

static void begin_walk_heading(void)
{
    insole_walk_heading_init(&walk, &insole_walk_heading_defaults);
}

static void push_walk(void)
{
    static const insole_sym3_t cov = {INSOLE_R(1.0e-3), INSOLE_R(0.0), INSOLE_R(0.0),
                                      INSOLE_R(1.0e-3), INSOLE_R(0.0), INSOLE_R(1.0e-2)};
    insole_walk_heading_push(&walk, insole_quat_identity(), &cov, imu.accel_mps2, imu.t_us);
}

static void call_insole_walk_heading_push(uint32_t call)
{
    (void)call;
    push_walk();
    bench_take_vec3(0u, walk.motion.slots[0].sum_mps2);
}

static void make_step(uint32_t call)
{
    for (uint32_t k = 0u; k < RATE_HZ / 2; k++) {
        make_sample(call * (RATE_HZ / 2) + k);
        push_walk();
    }
    footfall.begin_us = footfall.end_us > imu.t_us ? 0u : footfall.end_us;
    footfall.end_us = imu.t_us;
}

static void call_insole_walk_heading_step(uint32_t call)
{
    insole_walked_t walked = {0};
    (void)call;
    insole_walk_heading_step(&walk, &footfall, &walked);
    bench_take_vec3(0u, insole_vec3(walked.direction_rad, walked.variance_rad2, walked.evidence));
}

/* A carrying position, by the forest of the library. */

static insole_carry_t carry;
static insole_carry_features_t features;
static insole_carry_votes_t votes;
static const insole_carry_forest_t *const forest = &insole_carry_table_forest;

static void begin_carry(void)
{
    insole_carry_init(&carry, &insole_carry_defaults);
}

static void call_insole_carry_push(uint32_t call)
{
    (void)call;
    insole_carry_push(&carry, imu.t_us, imu.accel_mps2, &imu.gyro_radps, NULL);
    bench_take_vec3(0u, carry.window.gravity);
}

static void make_window(uint32_t call)
{
    for (uint32_t i = 0u; i < 100u; i++) {
        make_sample(100u * call + i);
        insole_carry_push(&carry, imu.t_us, imu.accel_mps2, &imu.gyro_radps, NULL);
    }
}

static void call_insole_carry_next(uint32_t call)
{
    insole_carry_news_t news;
    (void)call;
    insole_carry_next(&carry, forest, &news);
    for (uint32_t k = 0u; k < 4u; k++) {
        bench_result[k] = news.votes.share[k];
    }
}

static void make_features(uint32_t call)
{
    make_window(call);
    insole_carry_window_next(&carry.window, &features);
}

static void call_insole_carry_forest_vote(uint32_t call)
{
    (void)call;
    insole_carry_forest_vote(forest, &features, &votes);
    for (uint32_t k = 0u; k < 4u; k++) {
        bench_result[k] = votes.share[k];
    }
}

/* A walk in the fusions: a pace each call, a fix each call. */

static insole_pace_t pace;
static insole_spot_fix_t fix;
static insole_step_fusion_t fusion;
static insole_ml_shift_t ml;
static insole_auto_start_t start;
static insole_walker_ekf_t walker;

static void make_news(uint32_t call)
{
    insole_pace_t next = {bench_between(INSOLE_R(0.6), INSOLE_R(0.8)),
                          bench_between(INSOLE_R(-3.0), INSOLE_R(3.0)), INSOLE_R(0.01),
                          INSOLE_R(0.02)};
    insole_vec3_t at = bench_vec3_between(INSOLE_R(-5.0), INSOLE_R(5.0));
    pace = next;
    fix.t_us = (uint64_t)(call + 1u) * 2000000u;
    fix.spot = insole_spot(at.x, at.y);
    fix.cov_m2 = insole_sym2(INSOLE_R(9.0), at.z, INSOLE_R(6.0));
    fix.since = insole_pace_way(&pace, INSOLE_R(0.0));
}

static void begin_fusion(void)
{
    insole_spot_t origin = {INSOLE_R(0.0), INSOLE_R(0.0)};
    insole_step_fusion_init(&fusion, &insole_step_fusion_defaults);
    insole_step_fusion_start(&fusion, origin, insole_sym2_circle(INSOLE_R(4.0)), INSOLE_R(0.5));
}

static void take_fusion(void)
{
    bench_take_vec3(0u, insole_vec3(fusion.spot.x_m, fusion.spot.y_m, fusion.nis));
    bench_take_vec3(3u, insole_vec3(fusion.P.xx, fusion.P.xy, fusion.P.yy));
}

static void call_insole_step_fusion_step_ekf(uint32_t call)
{
    (void)call;
    insole_step_fusion_step(&fusion, insole_step_ekf, &pace);
    take_fusion();
}

static void call_insole_step_fusion_step_ukf(uint32_t call)
{
    (void)call;
    insole_step_fusion_step(&fusion, insole_step_ukf, &pace);
    take_fusion();
}

static void call_insole_step_fusion_fix(uint32_t call)
{
    (void)call;
    insole_step_fusion_fix(&fusion, &fix);
    take_fusion();
}

static void begin_ml_shift(void)
{
    insole_spot_t origin = {INSOLE_R(0.0), INSOLE_R(0.0)};
    insole_ml_shift_init(&ml, &insole_ml_shift_defaults);
    insole_ml_shift_start(&ml, origin, insole_sym2_circle(INSOLE_R(4.0)), INSOLE_R(0.5));
}

static void call_insole_ml_shift_fix(uint32_t call)
{
    (void)call;
    insole_ml_shift_fix(&ml, &fix);
    bench_take_vec3(0u, insole_vec3(ml.spot.x_m, ml.spot.y_m, ml.P.xx));
}

/* The direction known to `sigma_rad` rad. */
static void begin_walker(insole_real_t sigma_rad)
{
    insole_walker_start_t known = {.cov_m2 = insole_sym2_circle(INSOLE_R(4.0)),
                                   .offset_rad = INSOLE_R(0.5),
                                   .var_offset_rad2 = sigma_rad * sigma_rad,
                                   .by_radio = true};
    insole_walker_ekf_init(&walker, &insole_walker_ekf_defaults);
    insole_walker_ekf_start(&walker, &known);
}

static void begin_walker_known(void)
{
    begin_walker(INSOLE_R(0.26));
}

static void begin_walker_wide(void)
{
    begin_walker(INSOLE_PI);
}

static void take_walker(void)
{
    insole_walker_answer_t answer;
    insole_walker_ekf_answer(&walker, &answer);
    bench_take_vec3(0u, insole_vec3(answer.spot.x_m, answer.spot.y_m, answer.offset_rad));
    bench_take_vec3(3u, insole_vec3(answer.cov_m2.xx, answer.cov_m2.xy, answer.cov_m2.yy));
    bench_take_vec3(6u, insole_vec3(answer.scale, answer.var_scale, answer.var_offset_rad2));
}

/* What happens between two counted calls, so that the direction stays as known as it was. */
static void make_walker_step(uint32_t call)
{
    make_news(call);
    insole_walker_ekf_fix(&walker, &fix);
}

static void make_walker_fix(uint32_t call)
{
    make_news(call);
    insole_walker_ekf_step(&walker, &pace);
}

static void make_walker_wide(uint32_t call)
{
    begin_walker_wide();
    make_news(call);
}

static void call_insole_walker_ekf_step(uint32_t call)
{
    (void)call;
    insole_walker_ekf_step(&walker, &pace);
    take_walker();
}

static void call_insole_walker_ekf_step_wide(uint32_t call)
{
    call_insole_walker_ekf_step(call);
}

static void call_insole_walker_ekf_fix(uint32_t call)
{
    (void)call;
    insole_walker_ekf_fix(&walker, &fix);
    take_walker();
}

static void call_insole_walker_ekf_compass(uint32_t call)
{
    (void)call;
    insole_walker_ekf_compass(&walker, INSOLE_R(0.5), INSOLE_R(0.8));
    take_walker();
}

/* Begun anew, so that each call is the last of five fixes. */
static void make_start(int32_t method)
{
    insole_auto_start_config_t config = insole_auto_start_defaults;
    config.method = method;
    insole_auto_start_init(&start, &config, &insole_auto_start_circles);
    for (uint32_t i = 0u; i < 5u; i++) {
        make_news(i);
        insole_auto_start_step(&start, &pace);
        if (i < 4u) {
            insole_auto_start_fix(&start, &fix);
        }
    }
}

static void make_moved(uint32_t call)
{
    (void)call;
    make_start(INSOLE_AUTO_START_MOVED);
}

static void make_circles(uint32_t call)
{
    (void)call;
    make_start(INSOLE_AUTO_START_CIRCLES);
}

static void take_start(void)
{
    insole_auto_start_answer_t answer;
    insole_auto_start_fix(&start, &fix);
    insole_auto_start_answer(&start, &answer);
    bench_take_vec3(0u, insole_vec3(answer.spot.x_m, answer.spot.y_m, answer.offset_rad));
    bench_take_vec3(3u, insole_vec3(answer.cov_m2.xx, answer.cov_m2.yy, answer.var_offset_rad2));
}

static void call_insole_auto_start_moved(uint32_t call)
{
    (void)call;
    take_start();
}

static void call_insole_auto_start_circles(uint32_t call)
{
    (void)call;
    take_start();
}

static const bench_case_t cases[] = {
    {"insole_attitude_push_gyro", WALK, begin_phone, make_sample, call_insole_attitude_push_gyro,
     take_attitude},
    {"insole_attitude_push_ekf", WALK, begin_phone, make_sample, call_insole_attitude_push_ekf,
     take_attitude},
    {"insole_attitude_push_ukf", WALK, begin_phone, make_sample, call_insole_attitude_push_ukf,
     take_attitude},
    {"insole_heading", WALK, begin_phone, make_attitude, call_insole_heading, NULL},
    {"insole_walk_heading_push", WALK, begin_walk_heading, make_sample,
     call_insole_walk_heading_push, NULL},
    {"insole_walk_heading_step", 40u, begin_walk_heading, make_step, call_insole_walk_heading_step,
     NULL},
    {"insole_carry_push", WALK, begin_carry, make_sample, call_insole_carry_push, NULL},
    {"insole_carry_next", 20u, begin_carry, make_window, call_insole_carry_next, NULL},
    {"insole_carry_forest_vote", 20u, begin_carry, make_features, call_insole_carry_forest_vote,
     NULL},
    {"insole_step_fusion_step_ekf", 200u, begin_fusion, make_news, call_insole_step_fusion_step_ekf,
     NULL},
    {"insole_step_fusion_step_ukf", 200u, begin_fusion, make_news, call_insole_step_fusion_step_ukf,
     NULL},
    {"insole_step_fusion_fix", 200u, begin_fusion, make_news, call_insole_step_fusion_fix, NULL},
    {"insole_ml_shift_fix", 200u, begin_ml_shift, make_news, call_insole_ml_shift_fix, NULL},
    {"insole_walker_ekf_step", 200u, begin_walker_known, make_walker_step,
     call_insole_walker_ekf_step, NULL},
    {"insole_walker_ekf_step_wide", 50u, NULL, make_walker_wide, call_insole_walker_ekf_step_wide,
     NULL},
    {"insole_walker_ekf_fix", 200u, begin_walker_known, make_walker_fix, call_insole_walker_ekf_fix,
     NULL},
    {"insole_walker_ekf_compass", 200u, begin_walker_known, make_walker_fix,
     call_insole_walker_ekf_compass, NULL},
    {"insole_auto_start_moved", 50u, NULL, make_moved, call_insole_auto_start_moved, NULL},
    {"insole_auto_start_circles", 50u, NULL, make_circles, call_insole_auto_start_circles, NULL},
};

const bench_table_t bench_phone = BENCH_TABLE(cases);
