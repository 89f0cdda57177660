/* SPDX-License-Identifier: MIT */
#include "insole/move/attitude.h"

#include "insole/move/attitude_ekf.h"
#include "insole/move/heading.h"
#include "insole/sense/still_bias.h"
#include "near.h"
#include "phone.h"
#include "refusal.h"
#include "sample.h"
#include "setting.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define DEG (PI / 180.0)
#define EPS ((double)INSOLE_REAL_EPSILON)

enum { MS = 1000 };

static const d3_t STILL = {0.0, 0.0, 0.0};

static insole_attitude_t begin(const insole_attitude_config_t *config)
{
    insole_attitude_t att;
    ck_assert_int_eq(insole_attitude_init(&att, config), INSOLE_OK);
    return att;
}

static void push(insole_attitude_t *att, insole_attitude_method_t *method, const insole_imu_t *imu)
{
    ck_assert_int_eq(insole_attitude_push(att, method, imu, 0u), INSOLE_OK);
}

/* The phone turns at `w` for `time_s`, 50 samples a second. */
static void turn_for(insole_attitude_t *att, insole_attitude_method_t *method, phone_t *p, d3_t w,
                     double time_s)
{
    for (int i = 0, n = (int)lround(time_s * 50.0); i < n; i++) {
        insole_imu_t imu = phone_sample(p, w, 20 * MS);
        push(att, method, &imu);
    }
}

static double heading_of(const insole_attitude_t *att)
{
    return (double)insole_heading(att->q, NULL).heading_rad;
}

static d33_t any_attitude(insole_rng_t *rng)
{
    return d33_of(insole_quat_to_mat3(sample_quat(rng)));
}

/* Any mounting, upside down too: half a second of a noisy rest levels, and the heading is zero. */
START_TEST(a_rest_levels_any_mounting)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t tilt = {0.0, 0.0}, heading = {0.0, 0.0};
    for (int i = 0; i < 200; i++) {
        phone_t p = phone(i == 0 ? turn_x(PI) : any_attitude(&rng), (uint64_t)i);
        p.accel_noise = 0.01;
        insole_attitude_t att = begin(&insole_attitude_defaults);
        insole_imu_t imu = phone_sample(&p, STILL, 20 * MS);
        push(&att, insole_attitude_ekf, &imu);
        worst_note(&heading, fabs(heading_of(&att)), i);
        turn_for(&att, insole_attitude_ekf, &p, STILL, 0.6);
        ck_assert(!att.levelling);
        worst_note(&tilt, phone_tilt_error(&p, att.q) / DEG, i);
    }
    ASSERT_WORST(heading, 10.0 * EPS, "rad");
    ASSERT_WORST(tilt, 0.5, "degrees");
}
END_TEST

/* Starts on the way, turning, with the bounce of a walk: a second and it is right. */
START_TEST(a_start_in_motion_levels_too)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t tilt = {0.0, 0.0};
    for (int i = 0; i < 100; i++) {
        phone_t p = phone(any_attitude(&rng), (uint64_t)i);
        p.t_us += (uint64_t)i * 37u * MS;
        p.shake = 3.0;
        insole_attitude_t att = begin(&insole_attitude_defaults);
        turn_for(&att, insole_attitude_ekf, &p, d3(0.3, 0.8, -0.5), 10.0);
        worst_note(&tilt, phone_tilt_error(&p, att.q) / DEG, i);
        ck_assert_uint_eq(att.upsets, 0u);
    }
    ASSERT_WORST(tilt, 3.0, "degrees");
}
END_TEST

START_TEST(what_falls_is_no_start)
{
    insole_attitude_t att = begin(&insole_attitude_defaults);
    insole_imu_t imu = {5u, {0, INSOLE_R(0.1), INSOLE_R(0.3)}, {0, 0, 0}};
    ASSERT_REFUSED(att, att.refused, insole_attitude_push(&att, insole_attitude_ekf, &imu, 0u),
                   INSOLE_ERR_STATE);
    imu.accel_mps2 = insole_vec3(0, 30, 0);
    ASSERT_REFUSED(att, att.refused, insole_attitude_push(&att, insole_attitude_ekf, &imu, 0u),
                   INSOLE_ERR_STATE);
    insole_step_t step;
    memset(&step, 0x5a, sizeof step);
    ASSERT_UNCHANGED(step, insole_attitude_fill(&att, &step), INSOLE_ERR_STATE);
    imu.accel_mps2 = insole_vec3(0, 10, 0);
    push(&att, insole_attitude_ekf, &imu);
    ck_assert_int_eq(insole_attitude_fill(&att, &step), INSOLE_OK);
    ck_assert(memcmp(&step.attitude, &att.q, sizeof att.q) == 0);
}
END_TEST

/* The gyro alone at a constant rate, against the exact rotation: any rate, any interval. */
START_TEST(a_constant_rate_turns_exactly)
{
    static const uint32_t DT_US[] = {1250u, 5000u, 10000u, 20000u, 50000u};
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    insole_attitude_config_t config = insole_attitude_defaults;
    config.level_s = 0;
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 20; i++) {
        d3_t w = d3_of(sample_vec3(&rng, 8));
        phone_t p = phone(any_attitude(&rng), 4u);
        insole_attitude_t att = begin(&config);
        for (int k = 0; k < 3; k++) { /* level and at its rate */
            insole_imu_t imu = phone_sample(&p, w, 10 * MS);
            push(&att, NULL, &imu);
        }
        d33_t R0 = p.R, Q0 = d33_of(insole_quat_to_mat3(att.q));
        for (int k = 0; k < 400; k++) {
            insole_imu_t imu = phone_sample(&p, w, DT_US[(i + k / 100) % 5]);
            push(&att, NULL, &imu);
        }
        d33_t truth = d33_mul(Q0, d33_mul(d33_transpose(R0), p.R));
        d3_t e = turn_between(truth, d33_of(insole_quat_to_mat3(att.q)));
        worst_note(&off, d3_norm(e), i);
    }
    ASSERT_WORST(off, 600.0 * EPS, "rad");
}
END_TEST

/* A cone, whose body rates turn, in means over the intervals: with the coning term of two samples
 * it is followed to fourth order; without it ten seconds at 50 Hz would be off by 0.05 rad. */
static moment_t cone(double t)
{
    const double tilt = 0.3, rate = 12.0;
    moment_t m = {.R = d33_mul(turn_z(rate * t), d33_mul(turn_x(tilt), turn_z(-rate * t)))};
    d3_t spin = d33_apply(d33_transpose(m.R), d3(0.0, 0.0, rate));
    m.w = d3_add(spin, -rate, d3(0.0, 0.0, 1.0));
    return m;
}

START_TEST(a_cone_is_followed)
{
    double off[2];
    for (int half = 0; half < 2; half++) {
        insole_attitude_config_t config = insole_attitude_defaults;
        config.level_s = 0;
        insole_attitude_t att = begin(&config);
        const int n = half != 0 ? 1000 : 500;
        for (int i = -2; i <= n; i++) {
            moment_t m = cone(10.0 * i / n);
            d3_t force, rate;
            motion_mean(cone, 10.0 * (i - 1) / n, 10.0 * i / n, &force, &rate);
            insole_imu_t imu = {(uint64_t)llround(1.0e6 + 1.0e7 * i / n), real_of(force),
                                real_of(rate)};
            push(&att, NULL, &imu);
            if (i == 0) {
                att.q = quat_of(m.R);
            }
        }
        d3_t e = turn_between(cone(10.0).R, d33_of(insole_quat_to_mat3(att.q)));
        off[half] = d3_norm(e);
    }
    ASSERT_AT_MOST(off[0], 0.001, "rad");
    ASSERT_AT_MOST(off[1], 0.1 * off[0] + 500.0 * EPS, "rad");
}
END_TEST

/* The same motion in samples of any length, even and uneven: the same answer. */
START_TEST(the_rate_of_the_samples_does_not_matter)
{
    insole_sym3_t P[4];
    double tilt[4];
    for (int row = 0; row < 4; row++) {
        static const uint32_t DT_US[4][2] = {
            {20000u, 20000u}, {10000u, 10000u}, {5000u, 5000u}, {5000u, 35000u}};
        phone_t p = phone(turn_x(0.4), 5u);
        p.accel_noise = 0.05;
        p.gyro_noise = 0.003;
        insole_attitude_config_t settings = insole_attitude_defaults;
        settings.accel_soft_mps2 = 0; /* noise of a sample is larger when it is short */
        insole_attitude_t att = begin(&settings);
        for (int i = 0; p.t_us < 21000000u; i++) {
            insole_imu_t imu = phone_sample(&p, d3(0.2, 0.1, -0.3), DT_US[row][i & 1]);
            push(&att, insole_attitude_ekf, &imu);
        }
        P[row] = insole_attitude_covariance(&att);
        tilt[row] = phone_tilt_error(&p, att.q);
        ASSERT_AT_MOST(tilt[row], 0.04, "rad");
        ASSERT_NEAR(P[row].xx, P[0].xx, 0.05 * (double)P[0].xx, "rad^2");
        ASSERT_NEAR(P[row].zz, P[0].zz, 0.01 * (double)P[0].zz, "rad^2");
    }
}
END_TEST

/* Errors of many phones against the covariance that the filter tells of them. */
START_TEST(the_covariance_is_honest)
{
    enum { RUNS = 300 };
    insole_attitude_config_t config = insole_attitude_defaults;
    config.gyro_turn_noise_rts = config.accel_soft_mps2 = 0;
    config.accel_gate_mps2 = 1000;
    double nees = 0.0, yaw = 0.0, nis = 0.0, heading = 0.0;
    for (int run = 0; run < RUNS; run++) {
        phone_t p = phone(d33_mul(turn_z(run), turn_x(0.5)), (uint64_t)run);
        p.gyro_noise = (double)config.gyro_noise_rad_rts;
        p.accel_noise = (double)config.accel_noise_mps_rts;
        insole_attitude_t att = begin(&config);
        turn_for(&att, insole_attitude_ekf, &p, STILL, 0.6);
        double told = atan2(p.R.r1.y, p.R.r0.y) + 0.2 * (double)insole_rng_normal(&p.rng);
        ck_assert_int_eq(insole_attitude_set_heading(&att, (insole_real_t)told, INSOLE_R(0.2)),
                         INSOLE_OK);
        for (int i = 0; i < 500; i++) {
            double t = 0.02 * i;
            d3_t w = d3(0.6 * cos(2.0 * t), 0.8 * cos(2.6 * t), 0.7 * sin(0.7 * t + run));
            insole_imu_t imu = phone_sample(&p, w, 20 * MS);
            push(&att, insole_attitude_ekf, &imu);
            nis += (double)att.nis / (500.0 * RUNS);
        }
        insole_sym3_t P = insole_attitude_covariance(&att), W;
        ck_assert(insole_sym3_inverse(P, &W));
        d3_t e = phone_error(&p, att.q);
        nees += (double)insole_vec3_dot(real_of(e), insole_sym3_mul_vec(W, real_of(e))) / RUNS;
        yaw += e.z * e.z / (double)P.zz / RUNS;
        insole_heading_t h = insole_heading(att.q, &P), truth = insole_heading(quat_of(p.R), NULL);
        double off = remainder((double)(h.heading_rad - truth.heading_rad), 2.0 * PI);
        heading += off * off / (double)h.variance_rad2 / RUNS;
    }
    /* three standard deviations of means of chi-squares */
    ASSERT_NEAR(nees, 3.0, 3.0 * sqrt(6.0 / RUNS), "");
    ASSERT_NEAR(yaw, 1.0, 3.0 * sqrt(2.0 / RUNS), "");
    ASSERT_NEAR(heading, 1.0, 3.0 * sqrt(2.0 / RUNS), "");
    ASSERT_NEAR(nis, 2.0, 0.03, "");
}
END_TEST

/* A gate of the paper and a soft shoulder: what is felt beyond counts for nothing. */
START_TEST(accelerated_samples_are_not_trusted)
{
    insole_trust_t trust = {INSOLE_R(0.5), INSOLE_R(2.0), INSOLE_R(5.0)};
    ASSERT_NEAR(insole_trust_variance(&trust, 0, INSOLE_R(0.02)), 12.5, 30.0 * EPS, "");
    ASSERT_NEAR(insole_trust_variance(&trust, 2, INSOLE_R(0.02)), 25.0, 60.0 * EPS, "");
    ASSERT_NEAR(insole_trust_variance(&trust, 4, INSOLE_R(0.1)), 12.5, 30.0 * EPS, "");
    ASSERT_NEAR(insole_trust_variance(&trust, 5, INSOLE_R(0.02)), 0.0, 0.0, "");
    ASSERT_NEAR(insole_trust_variance(&trust, (insole_real_t)NAN, 1), 0.0, 0.0, "");
    trust.soft = 0;
    ASSERT_NEAR(insole_trust_variance(&trust, 4, INSOLE_R(0.02)), 12.5, 30.0 * EPS, "");
    phone_t p = phone(turn_x(0.3), 6u);
    insole_attitude_t att = begin(&insole_attitude_defaults);
    turn_for(&att, insole_attitude_ekf, &p, STILL, 1.0);
    insole_attitude_t alone = att;
    insole_imu_t imu = phone_sample(&p, STILL, 20 * MS);
    imu.accel_mps2 = insole_vec3(INSOLE_R(14.0), 0, 0);
    uint32_t corrected = att.corrected, passed = att.passed;
    push(&att, insole_attitude_ekf, &imu);
    push(&alone, NULL, &imu);
    ck_assert_int_eq(memcmp(&att.q, &alone.q, sizeof att.q), 0);
    ck_assert_int_eq(memcmp(&att.P, &alone.P, sizeof att.P), 0);
    ck_assert_uint_eq(att.corrected, corrected);
    ck_assert_uint_eq(att.passed, passed + 1u);
}
END_TEST

/* What the paper compares: the gyro alone drifts in tilt, gravity holds it; the heading drifts in
 * both by the bias, and in neither once the bias is known from a rest. */
START_TEST(gravity_holds_the_tilt_and_a_rest_the_heading)
{
    static const insole_still_bias_config_t *REST = &insole_still_bias_defaults;
    insole_attitude_method_t *const methods[2] = {NULL, insole_attitude_ekf};
    for (int row = 0; row < 4; row++) {
        phone_t p = phone(turn_x(0.3), 7u);
        p.gyro_bias = d3(0.01, -0.02, 0.015);
        p.gyro_noise = 0.0005;
        p.accel_noise = 0.005;
        insole_attitude_t att = begin(&insole_attitude_defaults);
        insole_still_bias_t rest;
        ck_assert_int_eq(insole_still_bias_init(&rest, REST), INSOLE_OK);
        d33_t R0 = p.R;
        double first = 0.0;
        for (int i = 0; i < 150 + 1500; i++) {
            d3_t w = i < 150 ? STILL : d3(0.5 * sin(i * 0.02), 0.0, 0.6 * cos(i * 0.021));
            insole_imu_t imu = phone_sample(&p, w, 20 * MS);
            push(&att, methods[row & 1], &imu);
            ck_assert_int_eq(insole_still_bias_push(&rest, &imu), INSOLE_OK);
            if (row >= 2) {
                ck_assert_int_eq(insole_attitude_set_bias(&att, rest.gyro_bias_radps), INSOLE_OK);
            }
            first = i == 150 ? heading_of(&att) : first;
        }
        double tilt = phone_tilt_error(&p, att.q) / DEG;
        double turned = atan2(p.R.r1.y, p.R.r0.y) - atan2(R0.r1.y, R0.r0.y);
        double drift = fabs(remainder(heading_of(&att) - first - turned, 2.0 * PI)) / DEG;
        if (row == 0) {
            ASSERT_AT_LEAST(tilt, 10.0, "degrees");
        } else {
            ASSERT_AT_MOST(tilt, row == 2 ? 3.0 : 2.0, "degrees");
        }
        if (row < 2) {
            ASSERT_AT_LEAST(drift, 5.0, "degrees");
        } else {
            ASSERT_AT_MOST(drift, 3.0, "degrees");
        }
    }
}
END_TEST

/* A gap turns nothing, and P tells what it may have hidden; a long one levels anew. */
START_TEST(gaps_are_bridged)
{
    phone_t p = phone(turn_x(0.3), 8u);
    insole_attitude_config_t config = insole_attitude_defaults;
    insole_attitude_t att = begin(&config);
    turn_for(&att, insole_attitude_ekf, &p, STILL, 2.0);
    insole_sym3_t before = insole_attitude_covariance(&att);
    insole_quat_t q = att.q;
    p.t_us += 480u * MS;
    insole_imu_t imu = phone_sample(&p, STILL, 20 * MS);
    imu.gyro_radps = insole_vec3(3, 3, 3);
    push(&att, NULL, &imu);
    ck_assert_uint_eq(att.gaps, 1u);
    ck_assert(!att.levelling);
    ck_assert_int_eq(memcmp(&q, &att.q, sizeof q), 0);
    insole_sym3_t after = insole_attitude_covariance(&att);
    ASSERT_NEAR(after.zz, (double)before.zz + 0.25 * 0.25, 1.0e-6, "rad^2");
    ASSERT_NEAR(after.xx, (double)before.xx + 0.25 * 0.25, 1.0e-6, "rad^2");
    p.R = d33_mul(p.R, turn_y(2.5)); /* somebody put it down, face down */
    p.t_us += (uint64_t)3600u * 24u * 1000u * MS;
    turn_for(&att, insole_attitude_ekf, &p, STILL, 0.02);
    ck_assert(att.levelling);
    ASSERT_NEAR(insole_attitude_covariance(&att).zz, PI * PI / 3.0, 1.0e-4, "rad^2");
    turn_for(&att, insole_attitude_ekf, &p, STILL, 0.6);
    ck_assert(!att.levelling);
    ASSERT_AT_MOST(phone_tilt_error(&p, att.q), 0.01, "rad");
    ASSERT_NEAR(att.P.zz, PI * PI / 3.0, 1.0e-4, "rad^2");
}
END_TEST

/* Axis 1 of the phone points along -x of n: what its clipped gyro leaves open lies there. */
START_TEST(a_clipped_gyro_opens_its_axis)
{
    insole_attitude_config_t config = insole_attitude_defaults;
    config.level_s = config.gyro_noise_rad_rts = INSOLE_R(1.0e-6);
    phone_t p = phone(turn_z(0.5 * PI), 9u);
    insole_attitude_t att = begin(&config);
    insole_imu_t imu;
    for (int i = 0; i < 3; i++) {
        imu = phone_sample(&p, STILL, 20 * MS);
        push(&att, NULL, &imu);
    }
    ck_assert_int_eq(insole_attitude_set_heading(&att, INSOLE_PI, 0), INSOLE_OK);
    insole_sym3_t before = insole_attitude_covariance(&att);
    for (int i = 0; i < 50; i++) {
        imu = phone_sample(&p, STILL, 20 * MS);
        ck_assert_int_eq(insole_attitude_push(&att, NULL, &imu, 2u), INSOLE_OK);
    }
    insole_sym3_t after = insole_attitude_covariance(&att);
    double clip = (double)config.clip_noise_rad_rts;
    ASSERT_NEAR(after.xx - before.xx, clip * clip, 1.0e-5, "rad^2");
    ASSERT_NEAR(after.yy - before.yy, 0.0, 1.0e-6, "rad^2");
    ASSERT_NEAR(after.zz - before.zz, 0.0, 1.0e-6, "rad^2");
}
END_TEST

/* Noise per turn rate lies along the turn's axis. */
START_TEST(fast_turns_are_less_known_along_their_axis)
{
    insole_attitude_config_t config = insole_attitude_defaults;
    config.level_s = 0;
    config.gyro_noise_rad_rts = INSOLE_R(1.0e-6);
    config.gyro_turn_noise_rts = INSOLE_R(0.05);
    phone_t p = phone(turn_x(0.0), 10u);
    insole_attitude_t att = begin(&config);
    turn_for(&att, NULL, &p, d3(0.0, 0.0, 2.0), 0.06);
    insole_sym3_t before = insole_attitude_covariance(&att);
    turn_for(&att, NULL, &p, d3(0.0, 0.0, 2.0), 5.0);
    insole_sym3_t after = insole_attitude_covariance(&att);
    ASSERT_NEAR(after.zz - before.zz, 0.05 * 0.05 * 4.0 * 5.0, 1.0e-4, "rad^2");
    ASSERT_NEAR(after.xx - before.xx, 0.0, 1.0e-6, "rad^2");
}
END_TEST

/* Turned over while the gyro said nothing: levelled anew, and the heading is open. */
START_TEST(an_upset_is_found)
{
    for (int off = 0; off < 2; off++) {
        insole_attitude_config_t config = insole_attitude_defaults;
        config.upset_rad = off != 0 ? INSOLE_R(3.2) : config.upset_rad;
        phone_t p = phone(turn_x(0.3), 11u);
        insole_attitude_t att = begin(&config);
        turn_for(&att, insole_attitude_ekf, &p, STILL, 5.0);
        double before = (double)insole_attitude_covariance(&att).zz;
        p.R = d33_mul(turn_x(PI - 0.01), p.R);
        turn_for(&att, insole_attitude_ekf, &p, STILL, 3.0);
        ck_assert_uint_eq(att.upsets, off != 0 ? 0u : 1u);
        if (off == 0) {
            ASSERT_AT_MOST(phone_tilt_error(&p, att.q), 0.05, "rad");
            ASSERT_NEAR(insole_attitude_covariance(&att).zz, before + 1.0, 0.01, "rad^2");
        }
    }
}
END_TEST

/* Sixty degrees of tilt error, of which the filter knows: it comes back. */
START_TEST(a_large_tilt_error_is_found_back)
{
    insole_attitude_config_t config = insole_attitude_defaults;
    config.upset_rad = INSOLE_R(3.2);
    phone_t p = phone(turn_x(0.3), 12u);
    p.accel_noise = 0.1;
    insole_attitude_t att = begin(&config);
    turn_for(&att, insole_attitude_ekf, &p, STILL, 1.0);
    att.P = insole_sym3_diagonal(1, 1, 0);
    att.q = quat_of(d33_mul(turn_x(60.0 * DEG), d33_of(insole_quat_to_mat3(att.q))));
    turn_for(&att, insole_attitude_ekf, &p, STILL, 3.0);
    ASSERT_AT_MOST(phone_tilt_error(&p, att.q) / DEG, 3.0, "degrees");
}
END_TEST

/* n turns about its vertical: attitude, covariance and all. */
START_TEST(a_heading_can_be_told)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 13u);
    for (int i = 0; i < 100; i++) {
        phone_t p = phone(any_attitude(&rng), 14u);
        insole_attitude_t att = begin(&insole_attitude_defaults);
        turn_for(&att, insole_attitude_ekf, &p, d3_of(sample_vec3(&rng, 1)), 1.0);
        insole_mat3_t M = sample_mat3(&rng, INSOLE_R(0.3));
        att.P = insole_mat3_mul_t_sym(M, M);
        d33_t before = d33_of(insole_sym3_full(insole_attitude_covariance(&att)));
        double told = 3.0 * (double)insole_rng_normal(&rng), from = heading_of(&att);
        ck_assert_int_eq(insole_attitude_set_heading(&att, (insole_real_t)told, INSOLE_R(0.4)),
                         INSOLE_OK);
        ASSERT_NEAR(remainder(heading_of(&att) - told, 2.0 * PI), 0.0, 1.0e-5, "rad");
        before.r0.z = before.r1.z = before.r2.x = before.r2.y = before.r2.z = 0.0;
        d33_t T = turn_z(told - from), P = d33_mul(T, d33_mul(before, d33_transpose(T)));
        insole_sym3_t now = insole_attitude_covariance(&att);
        ASSERT_NEAR(now.xx, P.r0.x, 1.0e-5, "rad^2");
        ASSERT_NEAR(now.xy, P.r0.y, 1.0e-5, "rad^2");
        ASSERT_NEAR(now.yy, P.r1.y, 1.0e-5, "rad^2");
        ASSERT_NEAR(now.zz, 0.16, 1.0e-6, "rad^2");
        ASSERT_NEAR(now.xz, 0.0, 0.0, "rad^2");
    }
}
END_TEST

/* A day in a drawer, samples at 50 Hz: nothing stalls, nothing grows that should not. */
START_TEST(a_day_does_not_wear_it_out)
{
    insole_attitude_config_t config = insole_attitude_defaults;
    config.gyro_noise_rad_rts = INSOLE_R(2.0e-4);
    phone_t p = phone(d33_mul(turn_x(2.0), turn_y(0.5)), 15u);
    insole_attitude_t att = begin(&config);
    turn_for(&att, insole_attitude_ekf, &p, STILL, 1000.0);
    double tilt = (double)att.P.xx;
    insole_imu_t imu = phone_sample(&p, STILL, 20 * MS);
    imu.gyro_radps = insole_vec3(INSOLE_R(1.0e-3), INSOLE_R(-2.0e-3), INSOLE_R(0.5e-3));
    worst_t unit = {0.0, 0.0};
    for (int i = 0; i < 24 * 3600 * 50; i++) {
        imu.t_us += 20u * MS;
        if (insole_attitude_push(&att, insole_attitude_ekf, &imu, 0u) != INSOLE_OK) {
            ck_abort_msg("refused");
        }
        double n2 =
            (double)(att.q.w * att.q.w + att.q.x * att.q.x + att.q.y * att.q.y + att.q.z * att.q.z);
        worst_note(&unit, fabs(n2 - 1.0), i);
    }
    ASSERT_WORST(unit, 6.0 * EPS, "");
    double day = 87400.0 * 4.0e-8;
    ASSERT_NEAR(insole_attitude_covariance(&att).zz, day, 0.02 * day, "rad^2");
    ASSERT_NEAR(att.P.xx, tilt, 0.1 * tilt, "rad^2");
    /* a bias of 2.2e-3 rad/s in balance with gravity, which comes back with a time constant of
     * 0.3 m/s/sqrt(s) / (9.81 m/s^2 x 2e-4 rad/sqrt(s)) = 153 s */
    ASSERT_AT_MOST(phone_tilt_error(&p, att.q), 153.0 * 2.3e-3, "rad");
}
END_TEST

/* Nonsense within the limits, for long: whatever comes out is finite and of unit length. */
START_TEST(nonsense_stays_finite)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 16u);
    insole_attitude_t att = begin(&insole_attitude_defaults);
    worst_t sane = {0.0, 0.0};
    insole_imu_t imu = {1u, {0, 0, 9}, {0, 0, 0}};
    for (int i = 0; i < 200000; i++) {
        static const insole_real_t SIZES[] = {1, 10, 100, 1000, 10000};
        imu.accel_mps2 = sample_vec3(&rng, SIZES[i / 7 % 5]);
        imu.gyro_radps = sample_vec3(&rng, SIZES[i / 3 % 4]);
        imu.t_us +=
            i % 1000 == 0 ? 100000000000u : (uint64_t)(insole_rng_bits(&rng) % 150000u + 1u);
        insole_status_t status =
            insole_attitude_push(&att, insole_attitude_ekf, &imu, insole_rng_bits(&rng) & 15u);
        insole_sym3_t P = insole_attitude_covariance(&att), W;
        insole_heading_t h = insole_heading(att.q, &P);
        worst_require(&sane, status == INSOLE_OK || !att.aligned, i);
        worst_require(&sane, insole_is_finite(h.heading_rad + h.variance_rad2), i);
        worst_require(&sane, !att.aligned || h.variance_rad2 >= 0, i);
        worst_require(&sane, !att.aligned || att.P.zz == 0 || insole_sym3_inverse(P, &W), i);
        double n = sqrt((double)(att.q.w * att.q.w + att.q.x * att.q.x + att.q.y * att.q.y +
                                 att.q.z * att.q.z));
        worst_require(&sane, fabs(n - 1.0) < 6.0 * EPS, i);
    }
    ASSERT_ALL_HELD(sane);
}
END_TEST

START_TEST(a_copy_goes_on_alike)
{
    phone_t p = phone(turn_x(0.3), 17u);
    p.accel_noise = 0.1;
    insole_attitude_t att = begin(&insole_attitude_defaults);
    turn_for(&att, insole_attitude_ekf, &p, d3(0.1, 0.2, 0.3), 1.23);
    insole_attitude_t copy = att;
    phone_t same = p;
    turn_for(&att, insole_attitude_ekf, &p, d3(0.3, -0.2, 0.3), 2.0);
    turn_for(&copy, insole_attitude_ekf, &same, d3(0.3, -0.2, 0.3), 2.0);
    ck_assert_int_eq(memcmp(&att, &copy, sizeof att), 0);
}
END_TEST

static insole_attitude_config_t config;

static insole_status_t judge(void)
{
    insole_attitude_t att;
    memset(&att, 0x5a, sizeof att);
    insole_attitude_t before = att;
    insole_status_t status = insole_attitude_init(&att, &config);
    ck_assert(status == INSOLE_OK || memcmp(&att, &before, sizeof att) == 0);
    return status;
}

START_TEST(settings_have_their_ranges)
{
    config = insole_attitude_defaults;
    INSOLE_ATTITUDE_KEYS(SETTING_HAS_ENDS)
    insole_attitude_t att;
    memset(&att, 0x5a, sizeof att);
    ck_assert_int_eq(insole_attitude_init(NULL, &config), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(att, insole_attitude_init(&att, NULL), INSOLE_ERR_NULL);
}
END_TEST

#define REFUSED(call, why) ASSERT_REFUSED(att, att.refused, call, why)

START_TEST(bad_samples_are_refused)
{
    phone_t p = phone(turn_x(0.3), 18u);
    insole_attitude_t att = begin(&insole_attitude_defaults);
    turn_for(&att, insole_attitude_ekf, &p, STILL, 1.0);
    const insole_imu_t good = phone_sample(&p, STILL, 20 * MS);
    insole_imu_t imu = good;
    ck_assert_int_eq(insole_attitude_push(NULL, NULL, &imu, 0u), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(att, insole_attitude_push(&att, NULL, NULL, 0u), INSOLE_ERR_NULL);
    static const insole_real_t BAD[] = {(insole_real_t)NAN, (insole_real_t)INFINITY, 10001};
    for (int i = 0; i < 3; i++) {
        imu = good;
        imu.accel_mps2.y = BAD[i];
        REFUSED(insole_attitude_push(&att, NULL, &imu, 0u), INSOLE_ERR_VALUE);
        imu = good;
        imu.gyro_radps.z = BAD[i];
        REFUSED(insole_attitude_push(&att, NULL, &imu, 0u), INSOLE_ERR_VALUE);
    }
    imu = good;
    imu.t_us = att.t_us;
    REFUSED(insole_attitude_push(&att, NULL, &imu, 0u), INSOLE_ERR_TIME);
    imu.t_us = 0u;
    REFUSED(insole_attitude_push(&att, NULL, &imu, 0u), INSOLE_ERR_TIME);
    push(&att, insole_attitude_ekf, &good);
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    const insole_real_t nan = (insole_real_t)NAN, half = INSOLE_R(0.5);
    insole_vec3_t up = insole_vec3(0, 0, INSOLE_R(9.81));
    insole_sighting_t s = {up, up, half};
    insole_step_t step;
    memset(&step, 0, sizeof step);
    insole_attitude_t att = begin(&insole_attitude_defaults);
    REFUSED(insole_attitude_set_heading(&att, 0, half), INSOLE_ERR_STATE);
    REFUSED(insole_attitude_observe(&att, insole_attitude_ekf, &s), INSOLE_ERR_STATE);
    phone_t p = phone(turn_x(0.3), 19u);
    turn_for(&att, insole_attitude_ekf, &p, STILL, 0.2);
    REFUSED(insole_attitude_observe(&att, insole_attitude_ekf, &s), INSOLE_ERR_STATE);
    turn_for(&att, insole_attitude_ekf, &p, STILL, 1.0);
    ck_assert_int_eq(insole_attitude_set_heading(NULL, 0, half), INSOLE_ERR_NULL);
    REFUSED(insole_attitude_set_heading(&att, nan, half), INSOLE_ERR_VALUE);
    REFUSED(insole_attitude_set_heading(&att, INSOLE_R(1.0e5), half), INSOLE_ERR_VALUE);
    REFUSED(insole_attitude_set_heading(&att, 0, -half), INSOLE_ERR_VALUE);
    REFUSED(insole_attitude_set_heading(&att, 0, 4), INSOLE_ERR_VALUE);
    REFUSED(insole_attitude_set_heading(&att, 0, nan), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_attitude_set_bias(NULL, up), INSOLE_ERR_NULL);
    REFUSED(insole_attitude_set_bias(&att, up), INSOLE_ERR_VALUE);
    REFUSED(insole_attitude_set_bias(&att, insole_vec3(nan, 0, 0)), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_attitude_observe(NULL, insole_attitude_ekf, &s), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(att, insole_attitude_observe(&att, NULL, &s), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(att, insole_attitude_observe(&att, insole_attitude_ekf, NULL),
                     INSOLE_ERR_NULL);
    const insole_real_t bad[] = {nan, 0, -1, (insole_real_t)INFINITY};
    for (int i = 0; i < 4; i++) {
        s.variance = bad[i];
        REFUSED(insole_attitude_observe(&att, insole_attitude_ekf, &s), INSOLE_ERR_VALUE);
    }
    s.variance = half;
    s.seen.y = nan;
    REFUSED(insole_attitude_observe(&att, insole_attitude_ekf, &s), INSOLE_ERR_VALUE);
    s.seen = up;
    s.known.x = INSOLE_R(2.0e4);
    REFUSED(insole_attitude_observe(&att, insole_attitude_ekf, &s), INSOLE_ERR_VALUE);
    s.known = up;
    ck_assert_int_eq(insole_attitude_observe(&att, insole_attitude_ekf, &s), INSOLE_OK);
    ck_assert_int_eq(insole_attitude_fill(NULL, &step), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(att, insole_attitude_fill(&att, NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("attitude");
    suite_add(suite, "mounting", a_rest_levels_any_mounting);
    suite_add(suite, "motion", a_start_in_motion_levels_too);
    suite_add(suite, "fall", what_falls_is_no_start);
    suite_add(suite, "turn", a_constant_rate_turns_exactly);
    suite_add(suite, "cone", a_cone_is_followed);
    suite_add(suite, "rate", the_rate_of_the_samples_does_not_matter);
    suite_add(suite, "honest", the_covariance_is_honest);
    suite_add(suite, "trust", accelerated_samples_are_not_trusted);
    suite_add(suite, "drift", gravity_holds_the_tilt_and_a_rest_the_heading);
    suite_add(suite, "gaps", gaps_are_bridged);
    suite_add(suite, "clipped", a_clipped_gyro_opens_its_axis);
    suite_add(suite, "fast", fast_turns_are_less_known_along_their_axis);
    suite_add(suite, "upset", an_upset_is_found);
    suite_add(suite, "tilt", a_large_tilt_error_is_found_back);
    suite_add(suite, "heading", a_heading_can_be_told);
    suite_add(suite, "day", a_day_does_not_wear_it_out);
    suite_add(suite, "nonsense", nonsense_stays_finite);
    suite_add(suite, "copy", a_copy_goes_on_alike);
    suite_add(suite, "settings", settings_have_their_ranges);
    suite_add(suite, "samples", bad_samples_are_refused);
    suite_add(suite, "arguments", bad_arguments_are_refused);
    return suite;
}
