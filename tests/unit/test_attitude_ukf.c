/* SPDX-License-Identifier: MIT */
#include "insole/move/attitude_ukf.h"

#include "insole/move/attitude_ekf.h"
#include "near.h"
#include "phone.h"
#include "sample.h"
#include "sighting.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define DEG (PI / 180.0)
#define EPS ((double)INSOLE_REAL_EPSILON)

static const d3_t STILL = {0.0, 0.0, 0.0};

/* A + s v w' */
static d33_t add_outer(d33_t A, double s, d3_t v, d3_t w)
{
    d33_t B = {d3_add(A.r0, s * v.x, w), d3_add(A.r1, s * v.y, w), d3_add(A.r2, s * v.z, w)};
    return B;
}

/* The unscented filter by the book, in double: seven points, each turned by Rodrigues. */
static void by_the_book(d33_t *P, d3_t known, d3_t seen, double variance, d3_t *turn, double *nis)
{
    double l11 = sqrt(P->r0.x), l21 = P->r1.x / l11, l31 = P->r2.x / l11;
    double l22 = sqrt(P->r1.y - l21 * l21), l32 = (P->r2.y - l31 * l21) / l22;
    double l33 = sqrt(P->r2.z - l31 * l31 - l32 * l32), spread = sqrt(3.0);
    const d3_t columns[3] = {d3(l11, l21, l31), d3(0.0, l22, l32), d3(0.0, 0.0, l33)};
    d3_t a[7], z[7], mean = d3(0.0, 0.0, 0.0);
    for (int i = 0; i < 7; i++) {
        double side = i == 0 ? 0.0 : i <= 3 ? spread : -spread;
        a[i] = d3_scale(columns[(i + 2) % 3], side);
        z[i] = d33_apply(d33_exp(d3_scale(a[i], -1.0)), known);
        mean = d3_add(mean, i == 0 ? 0.0 : 1.0 / 6.0, z[i]);
    }
    const d3_t o = d3(0.0, 0.0, 0.0);
    d33_t P_zz = {d3(variance, 0.0, 0.0), d3(0.0, variance, 0.0), d3(0.0, 0.0, variance)};
    d33_t P_az = {o, o, o};
    for (int i = 0; i < 7; i++) {
        d3_t d = d3_add(z[i], -1.0, mean);
        P_zz = add_outer(P_zz, i == 0 ? 2.0 : 1.0 / 6.0, d, d);
        P_az = add_outer(P_az, i == 0 ? 2.0 : 1.0 / 6.0, a[i], d);
    }
    d33_t W = d33_inverse(P_zz), K = d33_mul(P_az, W);
    d3_t innovation = d3_add(seen, -1.0, mean);
    *turn = d33_apply(K, innovation);
    *nis = d3_dot(innovation, d33_apply(W, innovation));
    d33_t T = d33_mul(K, d33_mul(P_zz, d33_transpose(K)));
    P->r0 = d3_add(P->r0, -1.0, T.r0);
    P->r1 = d3_add(P->r1, -1.0, T.r1);
    P->r2 = d3_add(P->r2, -1.0, T.r2);
}

static double apart(d33_t A, insole_sym3_t s)
{
    d33_t B = d33_of(insole_sym3_full(s));
    return d3_norm(d3_add(A.r0, -1.0, B.r0)) + d3_norm(d3_add(A.r1, -1.0, B.r1)) +
           d3_norm(d3_add(A.r2, -1.0, B.r2));
}

START_TEST(a_correction_is_that_of_seven_points)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t turn = {0.0, 0.0}, covariance = {0.0, 0.0}, nis = {0.0, 0.0};
    for (int i = 0; i < 2000; i++) {
        insole_sym3_t P = sighting_cov(&rng, sample_between(&rng, INSOLE_R(0.05), INSOLE_R(0.35)),
                                       INSOLE_R(0.05));
        insole_vec3_t known =
            i % 2 == 0 ? insole_vec3(0, 0, INSOLE_R(9.81)) : sample_vec3(&rng, 50);
        insole_sighting_t s = {known, insole_vec3_add(known, sample_vec3(&rng, 5)), 4};
        d33_t Pd = d33_of(insole_sym3_full(P));
        d3_t a;
        double expected_nis;
        by_the_book(&Pd, d3_of(known), d3_of(s.seen), 4.0, &a, &expected_nis);
        insole_correction_t made;
        ck_assert_int_eq(insole_attitude_ukf(&P, &s, &made), INSOLE_OK);
        d33_t T = d33_of(insole_quat_to_mat3(insole_quat_normalize(made.turn))), E = d33_exp(a);
        worst_note(&turn, apart(d33_mul(T, d33_transpose(E)), insole_sym3_diagonal(1, 1, 1)), i);
        worst_note(&covariance, apart(Pd, P), i);
        worst_note(&nis, fabs((double)made.nis / expected_nis - 1.0), i);
    }
    ASSERT_WORST(turn, 1.0e-8 + 200.0 * EPS, "rad");
    ASSERT_WORST(covariance, 1.0e-8 + 200.0 * EPS, "rad^2");
    ASSERT_WORST(nis, 1.0e-8 + 1000.0 * EPS, "of it");
}
END_TEST

/* Where everything is small the extended filter is right, and this one agrees. */
START_TEST(small_uncertainty_gives_what_the_ekf_gives)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t turn = {0.0, 0.0}, covariance = {0.0, 0.0};
    for (int i = 0; i < 500; i++) {
        insole_sym3_t P = sighting_cov(&rng, INSOLE_R(0.003), INSOLE_R(0.05)), Q = P;
        insole_vec3_t known = sample_vec3(&rng, 10);
        insole_sighting_t s = {known, insole_vec3_add(known, sample_vec3(&rng, INSOLE_R(0.03))),
                               INSOLE_R(0.001)};
        insole_correction_t u, e;
        ck_assert_int_eq(insole_attitude_ukf(&P, &s, &u), INSOLE_OK);
        ck_assert_int_eq(insole_attitude_ekf(&Q, &s, &e), INSOLE_OK);
        insole_vec3_t off =
            insole_vec3(u.turn.x - e.turn.x, u.turn.y - e.turn.y, u.turn.z - e.turn.z);
        worst_note(&turn, 2.0 * (double)insole_vec3_norm(off), i);
        worst_note(&covariance, apart(d33_of(insole_sym3_full(Q)), P), i);
    }
    ASSERT_WORST(turn, 1.0e-5, "rad");
    ASSERT_WORST(covariance, 1.0e-7, "rad^2");
}
END_TEST

START_TEST(gravity_leaves_the_heading_alone)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    insole_sym3_t P = insole_sym3_diagonal(INSOLE_R(0.3), INSOLE_R(0.2), INSOLE_R(0.7));
    for (int i = 0; i < 100; i++) {
        insole_vec3_t up = insole_vec3(0, 0, INSOLE_R(9.81));
        insole_sighting_t s = {up, insole_vec3_add(up, sample_vec3(&rng, 5)), 4};
        insole_correction_t made;
        ck_assert_int_eq(insole_attitude_ukf(&P, &s, &made), INSOLE_OK);
        ASSERT_NEAR(made.turn.z, 0.0, 0.0, "");
        ASSERT_NEAR(P.zz, INSOLE_R(0.7), 0.0, "rad^2");
        ASSERT_NEAR(P.xz, 0.0, 0.0, "rad^2");
    }
    ASSERT_AT_MOST(P.xx, 0.01, "rad^2");
}
END_TEST

/* From any attitude to the right one, by gravity and another direction, knowing nothing. */
START_TEST(any_start_converges)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    insole_real_t var = INSOLE_PI * INSOLE_PI / INSOLE_R(3.0);
    int lost = 0;
    for (int i = 0; i < 200; i++) {
        insole_quat_t truth = sample_quat(&rng), q = sample_quat(&rng);
        insole_sym3_t P = insole_sym3_diagonal(var, var, var);
        insole_vec3_t up = insole_vec3(0, 0, INSOLE_R(9.81)), north = insole_vec3(20, 0, -43);
        for (int k = 0; k < 200; k++) {
            insole_vec3_t known = k % 2 == 0 ? up : north;
            insole_vec3_t b = insole_quat_rotate_back(truth, known);
            insole_sighting_t s = {known, insole_quat_rotate(q, b), k % 2 == 0 ? 1 : 9};
            insole_correction_t made;
            ck_assert_int_eq(insole_attitude_ukf(&P, &s, &made), INSOLE_OK);
            q = insole_quat_normalize(insole_quat_mul(made.turn, q));
            P = insole_sym3_add_diagonal(P, INSOLE_R(0.0004));
        }
        d3_t e = turn_between(d33_of(insole_quat_to_mat3(q)), d33_of(insole_quat_to_mat3(truth)));
        double w = fabs((double)insole_quat_mul(truth, insole_quat_conjugate(q)).w);
        lost += d3_norm(e) < 0.02 && w > 0.99 ? 0 : 1;
    }
    ck_assert_int_eq(lost, 0);
}
END_TEST

/* Sixty degrees of tilt error that the filter expects: seconds until five degrees are left. */
static double time_to_level(insole_attitude_method_t *method)
{
    insole_attitude_config_t config = insole_attitude_defaults;
    config.upset_rad = INSOLE_R(3.2);
    phone_t p = phone(turn_x(0.3), 12u);
    insole_attitude_t att;
    ck_assert_int_eq(insole_attitude_init(&att, &config), INSOLE_OK);
    double since = 0.0;
    for (int i = 0; i < 600; i++) {
        insole_imu_t imu = phone_sample(&p, STILL, 20000u);
        ck_assert_int_eq(insole_attitude_push(&att, method, &imu, 0u), INSOLE_OK);
        if (i == 100) {
            att.P = insole_sym3_diagonal(1, 1, 0);
            att.q = quat_of(d33_mul(turn_x(60.0 * DEG), d33_of(insole_quat_to_mat3(att.q))));
        }
        since = i > 100 && phone_tilt_error(&p, att.q) > 5.0 * DEG ? (i - 100) * 0.02 : since;
    }
    return since;
}

START_TEST(a_large_tilt_error_is_found_back_no_later_than_by_the_ekf)
{
    double ukf = time_to_level(insole_attitude_ukf), ekf = time_to_level(insole_attitude_ekf);
    ASSERT_AT_MOST(ukf, 1.0, "s");
    ASSERT_AT_MOST(ukf, ekf + 0.02, "s");
}
END_TEST

/* Whole runs with turns, noise and a known start of the heading: errors as P tells them. */
START_TEST(the_covariance_is_honest)
{
    enum { RUNS = 300 };
    insole_attitude_config_t config = insole_attitude_defaults;
    config.gyro_turn_noise_rts = config.accel_soft_mps2 = 0;
    config.accel_gate_mps2 = 1000;
    double nees = 0.0, nis = 0.0;
    for (int run = 0; run < RUNS; run++) {
        phone_t p = phone(d33_mul(turn_z(run), turn_x(0.5)), (uint64_t)run);
        p.gyro_noise = (double)config.gyro_noise_rad_rts;
        p.accel_noise = (double)config.accel_noise_mps_rts;
        insole_attitude_t att;
        ck_assert_int_eq(insole_attitude_init(&att, &config), INSOLE_OK);
        for (int i = 0; i < 530; i++) {
            double t = 0.02 * i;
            d3_t w = d3(0.6 * cos(2.0 * t), 0.8 * cos(2.6 * t), 0.7 * sin(0.7 * t + run));
            insole_imu_t imu = phone_sample(&p, w, 20000u);
            insole_status_t status = insole_attitude_push(&att, insole_attitude_ukf, &imu, 0u);
            ck_assert(status == INSOLE_OK || !att.aligned);
            if (i == 30) {
                double told = atan2(p.R.r1.y, p.R.r0.y) + 0.2 * (double)insole_rng_normal(&p.rng);
                (void)insole_attitude_set_heading(&att, (insole_real_t)told, INSOLE_R(0.2));
            }
            nis += i > 30 ? (double)att.nis / (499.0 * RUNS) : 0.0;
        }
        insole_sym3_t W;
        ck_assert(insole_sym3_inverse(insole_attitude_covariance(&att), &W));
        insole_vec3_t e = real_of(phone_error(&p, att.q));
        nees += (double)insole_vec3_dot(e, insole_sym3_mul_vec(W, e)) / RUNS;
    }
    ASSERT_NEAR(nees, 3.0, 3.0 * sqrt(6.0 / RUNS), "");
    ASSERT_NEAR(nis, 3.0, 0.03, "");
}
END_TEST

/* Gravity and a known field: the heading stays where it is though the gyro has a bias. */
START_TEST(two_directions_hold_the_heading)
{
    insole_attitude_t att;
    ck_assert_int_eq(insole_attitude_init(&att, &insole_attitude_defaults), INSOLE_OK);
    phone_t p = phone(turn_x(0.4), 5u);
    p.gyro_bias = d3(0.002, -0.003, 0.01);
    p.accel_noise = 0.05;
    const insole_vec3_t field = insole_vec3(20, 5, -43);
    for (int i = 0; i < 6000; i++) {
        insole_imu_t imu = phone_sample(&p, d3(0.3 * cos(0.03 * i), 0.0, 0.5), 20000u);
        ck_assert_int_eq(insole_attitude_push(&att, insole_attitude_ukf, &imu, 0u), INSOLE_OK);
        if (i == 50) {
            insole_real_t heading = (insole_real_t)atan2(p.R.r1.y, p.R.r0.y);
            ck_assert_int_eq(insole_attitude_set_heading(&att, heading, INSOLE_R(0.1)), INSOLE_OK);
        }
        if (i > 50) {
            insole_vec3_t b = real_of(d33_apply(d33_transpose(p.R), d3_of(field)));
            insole_sighting_t s = {field, insole_quat_rotate(att.q, b), 400};
            ck_assert_int_eq(insole_attitude_observe(&att, insole_attitude_ukf, &s), INSOLE_OK);
        }
    }
    /* without the field: 0.01 rad/s for two minutes */
    ASSERT_AT_MOST(d3_norm(phone_error(&p, att.q)) / DEG, 5.0, "degrees");
}
END_TEST

START_TEST(the_covariance_stays_positive)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 6u);
    worst_t positive = {0.0, 0.0};
    for (int i = 0; i < 20000; i++) {
        insole_sym3_t P =
            sighting_cov(&rng, sample_between(&rng, INSOLE_R(0.001), 1), INSOLE_R(0.05));
        worst_require(&positive, sighting_keeps_positive(insole_attitude_ukf, &rng, P), i);
    }
    ASSERT_ALL_HELD(positive);
}
END_TEST

/* xy is too large for any covariance: the root that is found is (1, 2, 0), and P starts from it. */
START_TEST(a_covariance_without_a_root_is_mended)
{
    insole_sym3_t bad = {1, 2, 0, 1, 0, 1}, mended = {1, 2, 0, 4, 0, 1};
    insole_vec3_t up = insole_vec3(0, 0, INSOLE_R(9.81));
    insole_sighting_t s = {up, insole_vec3_add(up, insole_vec3(1, 2, 0)), INSOLE_R(4.0)};
    insole_correction_t a, b;
    ck_assert_int_eq(insole_attitude_ukf(&bad, &s, &a), INSOLE_OK);
    ck_assert_int_eq(insole_attitude_ukf(&mended, &s, &b), INSOLE_OK);
    ck_assert_int_eq(memcmp(&bad, &mended, sizeof bad), 0);
    ck_assert_int_eq(memcmp(&a, &b, sizeof a), 0);
    insole_sym3_t known = insole_sym3_diagonal(INSOLE_R(0.5), INSOLE_R(0.5), 0);
    ck_assert_int_eq(insole_attitude_ukf(&known, &s, &a), INSOLE_OK);
    ASSERT_NEAR(known.zz, 0.0, 0.0, "rad^2");
}
END_TEST

START_TEST(what_it_can_not_do_it_refuses)
{
    check_sighting_refusals(insole_attitude_ukf);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("attitude_ukf");
    suite_add(suite, "correction", a_correction_is_that_of_seven_points);
    suite_add(suite, "small", small_uncertainty_gives_what_the_ekf_gives);
    suite_add(suite, "heading", gravity_leaves_the_heading_alone);
    suite_add(suite, "any_start", any_start_converges);
    suite_add(suite, "tilt", a_large_tilt_error_is_found_back_no_later_than_by_the_ekf);
    suite_add(suite, "honest", the_covariance_is_honest);
    suite_add(suite, "two", two_directions_hold_the_heading);
    suite_add(suite, "positive", the_covariance_stays_positive);
    suite_add(suite, "mended", a_covariance_without_a_root_is_mended);
    suite_add(suite, "refused", what_it_can_not_do_it_refuses);
    return suite;
}
