/* SPDX-License-Identifier: MIT */
#include "insole/move/attitude_ekf.h"

#include "near.h"
#include "phone.h"
#include "sample.h"
#include "sighting.h"
#include "suite.h"

#define EPS ((double)INSOLE_REAL_EPSILON)

/* The paper's filter as it is printed, in double: four states, 4x4 covariance, nothing left out.
 * H by central differences of (5) times g. */
typedef struct {
    double q[4], P[4][4];
} four_t;

static void quat_product(const double a[4], const double b[4], double c[4])
{
    c[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    c[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    c[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    c[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

/* (5): from n to b. */
static d3_t to_b(const double q[4], d3_t v)
{
    double q0 = q[0], q1 = q[1], q2 = q[2], q3 = q[3];
    d33_t C = {
        d3(q0 * q0 + q1 * q1 - q2 * q2 - q3 * q3, 2 * (q1 * q2 + q0 * q3), 2 * (q1 * q3 - q0 * q2)),
        d3(2 * (q1 * q2 - q0 * q3), q0 * q0 - q1 * q1 + q2 * q2 - q3 * q3, 2 * (q0 * q1 + q2 * q3)),
        d3(2 * (q1 * q3 + q0 * q2), 2 * (q2 * q3 - q0 * q1),
           q0 * q0 - q1 * q1 - q2 * q2 + q3 * q3)};
    return d33_apply(C, v);
}

/* 1/4 Xi S Xi' with the columns e_i q of Xi: what a small rotation in n does to q, doubled. */
static void sphere_covariance(const double q[4], insole_sym3_t s, double P[4][4])
{
    static const double E[3][4] = {{0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    double S[3][3] = {{(double)s.xx, (double)s.xy, (double)s.xz},
                      {(double)s.xy, (double)s.yy, (double)s.yz},
                      {(double)s.xz, (double)s.yz, (double)s.zz}};
    double X[3][4];
    for (int i = 0; i < 3; i++) {
        quat_product(E[i], q, X[i]);
    }
    memset(P, 0, 16 * sizeof(double));
    for (int r = 0; r < 4; r++) {
        for (int c = 0; c < 4; c++) {
            for (int i = 0; i < 3; i++) {
                for (int j = 0; j < 3; j++) {
                    P[r][c] += 0.25 * X[i][r] * S[i][j] * X[j][c];
                }
            }
        }
    }
}

/* A P A' */
static void congruence(double A[4][4], double P[4][4])
{
    double T[4][4] = {{0}};
    for (int r = 0; r < 4; r++) {
        for (int k = 0; k < 4; k++) {
            for (int c = 0; c < 4; c++) {
                T[r][c] += A[r][k] * P[k][c];
            }
        }
    }
    memset(P, 0, 16 * sizeof(double));
    for (int r = 0; r < 4; r++) {
        for (int k = 0; k < 4; k++) {
            for (int c = 0; c < 4; c++) {
                P[r][c] += T[r][k] * A[c][k];
            }
        }
    }
}

/* Matrix of p -> p r. */
static void right_factor(const double r[4], double A[4][4])
{
    for (int k = 0; k < 4; k++) {
        double e[4] = {0, 0, 0, 0}, column[4];
        e[k] = 1.0;
        quat_product(e, r, column);
        for (int i = 0; i < 4; i++) {
            A[i][k] = column[i];
        }
    }
}

static void make_unit(double q[4])
{
    double n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++) {
        q[i] /= n;
    }
}

/* (9)-(12), (17)-(18) */
static void four_predict(four_t *f, d3_t w, double dt, double sigma)
{
    double x = w.x, y = w.y, z = w.z, turn = d3_norm(w) * dt, F[4][4];
    double O[4][4] = {{0, -x, -y, -z}, {x, 0, z, -y}, {y, -z, 0, x}, {z, y, -x, 0}};
    double Xi[4][3], q[4] = {0, 0, 0, 0};
    for (int r = 0; r < 4; r++) {
        for (int c = 0; c < 4; c++) {
            F[r][c] = (r == c ? cos(0.5 * turn) : 0.0) + O[r][c] * dt * sin(0.5 * turn) / turn;
            q[r] += F[r][c] * f->q[c];
        }
    }
    memcpy(f->q, q, sizeof q);
    double X[4][3] = {
        {-q[1], -q[2], -q[3]}, {q[0], -q[3], q[2]}, {q[3], q[0], -q[1]}, {-q[2], q[1], q[0]}};
    memcpy(Xi, X, sizeof Xi);
    congruence(F, f->P);
    for (int r = 0; r < 4; r++) {
        for (int c = 0; c < 4; c++) {
            for (int k = 0; k < 3; k++) {
                f->P[r][c] += 0.25 * dt * dt * sigma * sigma * Xi[r][k] * Xi[c][k];
            }
        }
    }
}

/* (15)-(16), (19)-(21). `project`: P is projected on the tangent space of the new q, as a sphere
 * asks for; else it is carried there along the turn. */
static void four_correct(four_t *f, d3_t known, d3_t felt, double variance, int project)
{
    double H[3][4], PH[4][3], before[4];
    for (int k = 0; k < 4; k++) {
        double up[4], down[4];
        memcpy(up, f->q, sizeof up);
        memcpy(down, f->q, sizeof down);
        up[k] += 1.0e-5;
        down[k] -= 1.0e-5;
        d3_t slope = d3_scale(d3_add(to_b(up, known), -1.0, to_b(down, known)), 0.5e5);
        H[0][k] = slope.x;
        H[1][k] = slope.y;
        H[2][k] = slope.z;
    }
    double S[3][3];
    for (int i = 0; i < 3; i++) {
        for (int r = 0; r < 4; r++) {
            PH[r][i] = 0.0;
            for (int k = 0; k < 4; k++) {
                PH[r][i] += f->P[r][k] * H[i][k];
            }
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            S[i][j] = i == j ? variance : 0.0;
            for (int k = 0; k < 4; k++) {
                S[i][j] += H[i][k] * PH[k][j];
            }
        }
    }
    d33_t Sd = {d3(S[0][0], S[0][1], S[0][2]), d3(S[1][0], S[1][1], S[1][2]),
                d3(S[2][0], S[2][1], S[2][2])};
    d33_t W = d33_inverse(Sd);
    d3_t z = d33_apply(W, d3_add(felt, -1.0, to_b(f->q, known)));
    memcpy(before, f->q, sizeof before);
    for (int r = 0; r < 4; r++) {
        d3_t row = d3(PH[r][0], PH[r][1], PH[r][2]);
        f->q[r] += d3_dot(row, z);
        d3_t K = d33_apply(W, row);
        for (int c = 0; c < 4; c++) {
            f->P[r][c] -= d3_dot(K, d3(PH[c][0], PH[c][1], PH[c][2]));
        }
    }
    make_unit(f->q);
    double A[4][4], back[4] = {before[0], -before[1], -before[2], -before[3]}, turn[4];
    quat_product(back, f->q, turn);
    right_factor(turn, A);
    for (int r = 0; project && r < 4; r++) {
        for (int c = 0; c < 4; c++) {
            A[r][c] = (r == c ? 1.0 : 0.0) - f->q[r] * f->q[c];
        }
    }
    congruence(A, f->P);
}

static four_t four_of(insole_quat_t q, insole_sym3_t P)
{
    four_t f = {{(double)q.w, (double)q.x, (double)q.y, (double)q.z}, {{0}}};
    make_unit(f.q);
    sphere_covariance(f.q, P, f.P);
    return f;
}

static double apart_q(const four_t *f, insole_quat_t q)
{
    double s = f->q[0] * (double)q.w + f->q[1] * (double)q.x + f->q[2] * (double)q.y +
               f->q[3] * (double)q.z;
    double e[4] = {(double)q.w, (double)q.x, (double)q.y, (double)q.z}, sum = 0.0;
    for (int i = 0; i < 4; i++) {
        sum += pow(e[i] - (s < 0.0 ? -f->q[i] : f->q[i]), 2.0);
    }
    return sqrt(sum);
}

/* Largest difference of the covariances over the largest entry. */
static double apart_P(const four_t *f, insole_sym3_t s)
{
    double P[4][4], off = 0.0, most = 0.0;
    sphere_covariance(f->q, s, P);
    for (int r = 0; r < 4; r++) {
        for (int c = 0; c < 4; c++) {
            off = fmax(off, fabs(P[r][c] - f->P[r][c]));
            most = fmax(most, fabs(f->P[r][c]));
        }
    }
    return off / most;
}

static insole_vec3_t noisy(insole_rng_t *rng, insole_vec3_t v, insole_real_t sigma)
{
    return insole_vec3_add(v, sample_vec3(rng, sigma));
}

/* One correction by any direction from any attitude; gravity is every second. */
START_TEST(a_correction_is_that_of_the_four_state_filter)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t attitude = {0.0, 0.0}, covariance = {0.0, 0.0};
    for (int i = 0; i < 1000; i++) {
        insole_quat_t q = sample_quat(&rng);
        insole_sym3_t P = sighting_cov(&rng, INSOLE_R(0.5), INSOLE_R(0.01));
        insole_vec3_t known = sample_vec3(&rng, 50);
        if (i % 2 == 0) {
            known = insole_vec3(0, 0, INSOLE_R(9.81));
        }
        insole_sighting_t s = {known, noisy(&rng, known, 3), INSOLE_R(1.0)};
        four_t f = four_of(q, P);
        d3_t felt = d3_of(s.seen);
        felt = to_b(f.q, felt);
        four_correct(&f, d3_of(known), felt, 1.0, 0);
        insole_correction_t made;
        ck_assert_int_eq(insole_attitude_ekf(&P, &s, &made), INSOLE_OK);
        insole_quat_t after = insole_quat_normalize(insole_quat_mul(made.turn, q));
        worst_note(&attitude, apart_q(&f, after), i);
        worst_note(&covariance, apart_P(&f, P), i);
    }
    ASSERT_WORST(attitude, 1.0e-8 + 50.0 * EPS, "");
    ASSERT_WORST(covariance, 1.0e-7 + 300.0 * EPS, "of the largest entry");
}
END_TEST

/* A projection differs from carrying P along by half the correction's angle: small for small. */
START_TEST(projection_on_the_sphere_is_the_same_for_small_corrections)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t covariance = {0.0, 0.0};
    for (int i = 0; i < 300; i++) {
        insole_quat_t q = sample_quat(&rng);
        insole_sym3_t P = sighting_cov(&rng, INSOLE_R(0.1), INSOLE_R(0.01));
        insole_vec3_t known = insole_vec3(0, 0, INSOLE_R(9.81));
        insole_sighting_t s = {known, noisy(&rng, known, INSOLE_R(0.02)), INSOLE_R(1.0)};
        four_t f = four_of(q, P);
        four_correct(&f, d3_of(known), to_b(f.q, d3_of(s.seen)), 1.0, 1);
        insole_correction_t made;
        ck_assert_int_eq(insole_attitude_ekf(&P, &s, &made), INSOLE_OK);
        worst_note(&covariance, apart_P(&f, P), i);
    }
    ASSERT_WORST(covariance, 0.003, "of the largest entry");
}
END_TEST

/* Two hundred samples of a phone that turns and bounces, side by side. */
START_TEST(a_run_is_that_of_the_four_state_filter)
{
    insole_attitude_config_t config = insole_attitude_defaults;
    config.gap_s = INSOLE_R(1.0); /* every sample of 0.2 s has its own noise added */
    config.level_s = config.gyro_turn_noise_rts = config.accel_soft_mps2 = 0;
    config.accel_gate_mps2 = 1000;
    config.upset_rad = INSOLE_R(3.2);
    insole_attitude_t att;
    ck_assert_int_eq(insole_attitude_init(&att, &config), INSOLE_OK);
    phone_t p = phone(d33_mul(turn_x(2.0), turn_y(-1.0)), 3u);
    p.accel_noise = 0.5;
    p.gyro_noise = 0.05;
    const d3_t w = d3(0.3, -0.5, 0.4);
    four_t f = {{0}, {{0}}};
    worst_t attitude = {0.0, 0.0}, covariance = {0.0, 0.0};
    insole_vec3_t before = insole_vec3_zero();
    for (int i = 0; i < 200; i++) {
        insole_imu_t imu = phone_sample(&p, w, 200000u);
        insole_vec3_t now = imu.gyro_radps;
        ck_assert_int_eq(insole_attitude_push(&att, insole_attitude_ekf, &imu, 0u), INSOLE_OK);
        if (i < 3) {
            f = four_of(att.q, att.P);
        } else {
            d3_t a = d3_of(before), b = d3_of(now);
            d3_t coning = d3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
            double sigma = (double)config.gyro_noise_rad_rts / sqrt(0.2);
            four_predict(&f, d3_add(b, 0.2 / 12.0, coning), 0.2, sigma);
            double noise = (double)config.accel_noise_mps_rts;
            four_correct(&f, d3(0.0, 0.0, MOTION_G), d3_of(imu.accel_mps2), noise * noise / 0.2, 0);
            worst_note(&attitude, apart_q(&f, att.q), i);
            worst_note(&covariance, apart_P(&f, insole_attitude_covariance(&att)), i);
        }
        before = now;
    }
    ck_assert_uint_eq(att.corrected, 198u);
    ASSERT_WORST(attitude, 1.0e-7 + 100.0 * EPS, "");
    ASSERT_WORST(covariance, 1.0e-6 + 1000.0 * EPS, "of the largest entry");
}
END_TEST

/* H against central differences: with a huge noise K is P H' / R, column by column. */
START_TEST(the_jacobian_is_that_of_what_is_seen)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    worst_t slope = {0.0, 0.0};
    const double step = 1.0e-5;
    for (int i = 0; i < 300; i++) {
        insole_vec3_t known = sample_vec3(&rng, 1);
        d3_t e = d3_of(known);
        const insole_real_t units[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int k = 0; k < 3; k++) {
            insole_sym3_t P = insole_sym3_diagonal(1, 1, 1);
            insole_vec3_t unit = insole_vec3(units[k][0], units[k][1], units[k][2]);
            insole_sighting_t s = {known, insole_vec3_add(known, unit), INSOLE_R(1.0e6)};
            insole_correction_t made;
            ck_assert_int_eq(insole_attitude_ekf(&P, &s, &made), INSOLE_OK);
            d3_t row =
                d3_scale(d3((double)made.turn.x, (double)made.turn.y, (double)made.turn.z), 2.0e6);
            /* a rotation a of the phone against the estimate shows the known turned back by a */
            double J[3];
            for (int m = 0; m < 3; m++) {
                d3_t a = d3(m == 0 ? step : 0.0, m == 1 ? step : 0.0, m == 2 ? step : 0.0);
                d3_t up = d33_apply(d33_transpose(d33_exp(a)), e), down = d33_apply(d33_exp(a), e);
                d3_t d = d3_scale(d3_add(up, -1.0, down), 0.5 / step);
                J[m] = k == 0 ? d.x : k == 1 ? d.y : d.z;
            }
            worst_note(&slope, d3_norm(d3_add(row, -1.0, d3(J[0], J[1], J[2]))), i);
        }
    }
    ASSERT_WORST(slope, 1.0e-5, "");
}
END_TEST

/* From P without correlations: gravity tells nothing of the heading, however it is seen. */
START_TEST(gravity_leaves_the_heading_alone)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    insole_sym3_t P = insole_sym3_diagonal(INSOLE_R(0.3), INSOLE_R(0.2), INSOLE_R(0.7));
    for (int i = 0; i < 100; i++) {
        insole_vec3_t up = insole_vec3(0, 0, INSOLE_R(9.81));
        insole_sighting_t s = {up, noisy(&rng, up, 5), INSOLE_R(4.0)};
        insole_correction_t made;
        ck_assert_int_eq(insole_attitude_ekf(&P, &s, &made), INSOLE_OK);
        ASSERT_NEAR(made.turn.z, 0.0, 0.0, "rad");
        ASSERT_NEAR(P.zz, INSOLE_R(0.7), 0.0, "rad^2");
        ASSERT_NEAR(P.xz, 0.0, 0.0, "rad^2");
    }
    /* tilt after n equal readings: 1 / (1 / P + n g^2 / R) */
    double information = 100.0 * MOTION_G * MOTION_G / 4.0;
    ASSERT_NEAR(P.xx, 1.0 / (1.0 / 0.3 + information), 1.0e-7, "rad^2");
    ASSERT_NEAR(P.yy, 1.0 / (1.0 / 0.2 + information), 1.0e-7, "rad^2");
}
END_TEST

/* Very sharp sightings of very uncertain attitudes, the worst that the settings allow. */
START_TEST(the_covariance_stays_positive)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 6u);
    worst_t positive = {0.0, 0.0};
    for (int i = 0; i < 20000; i++) {
        insole_sym3_t P = insole_sym3_diagonal(INSOLE_R(3.2), INSOLE_R(3.2), INSOLE_R(3.2));
        if (i % 2 == 0) {
            P = sighting_cov(&rng, sample_between(&rng, INSOLE_R(0.001), 1), INSOLE_R(0.01));
        }
        worst_require(&positive, sighting_keeps_positive(insole_attitude_ekf, &rng, P), i);
    }
    ASSERT_ALL_HELD(positive);
}
END_TEST

START_TEST(what_it_can_not_do_it_refuses)
{
    check_sighting_refusals(insole_attitude_ekf);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("attitude_ekf");
    suite_add(suite, "correction", a_correction_is_that_of_the_four_state_filter);
    suite_add(suite, "projection", projection_on_the_sphere_is_the_same_for_small_corrections);
    suite_add(suite, "run", a_run_is_that_of_the_four_state_filter);
    suite_add(suite, "jacobian", the_jacobian_is_that_of_what_is_seen);
    suite_add(suite, "heading", gravity_leaves_the_heading_alone);
    suite_add(suite, "positive", the_covariance_stays_positive);
    suite_add(suite, "refused", what_it_can_not_do_it_refuses);
    return suite;
}
