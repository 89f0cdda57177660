/* SPDX-License-Identifier: MIT */
#include "insole/move/zupt_cov.h"

#include "dense.h"
#include "near.h"
#include "suite.h"

static const double EPS = (double)INSOLE_REAL_EPSILON;
enum { TRIES = 100, NINE = 9 };

typedef struct {
    dense_t dense;
    insole_zupt_cov_t P;
    insole_vec3_t u;
    insole_mat3_t C;
} case_t;

/* A covariance and an interval of 5 ms with up to 10 g. `dense` is the block form, exactly. */
static case_t make_case(insole_rng_t *rng)
{
    case_t c;
    dense_t any = dense_sample_cov(rng);
    c.P = dense_to_cov(&any);
    c.dense = dense_of(&c.P);
    c.u = sample_vec3(rng, INSOLE_R(0.5));
    c.C = insole_quat_to_mat3(sample_quat(rng));
    return c;
}

static insole_zupt_interval_t interval_of(const case_t *c, insole_real_t dt_s)
{
    insole_zupt_interval_t interval = {0};
    insole_zupt_interval_add(&interval, c->u, &c->C, dt_s, true);
    return interval;
}

static void propagate(case_t *c, insole_real_t dt_s, bool has_bias)
{
    insole_zupt_interval_t interval = interval_of(c, dt_s);
    insole_zupt_cov_propagate(&c->P, &interval, has_bias);
}

static void forget_bias(case_t *c)
{
    insole_mat3_t none = insole_mat3_zero();
    c->P.pb = c->P.vb = c->P.ab = none;
    c->P.bb = insole_sym3_zero();
    c->dense = dense_of(&c->P);
}

START_TEST(propagates_like_phi_p_phi)
{
    static const insole_real_t dt[2] = {INSOLE_R(0.005), INSOLE_R(1.0)};
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < TRIES; i++) {
        case_t c = make_case(&rng);
        dense_t phi = dense_phi(c.u, c.C, dt[i % 2]);
        dense_t expected = dense_congruent(&phi, &c.dense);
        propagate(&c, dt[i % 2], true);
        dense_t got = dense_of(&c.P);
        worst_note(&off, dense_off(&got, &expected, &expected), i);
    }
    ASSERT_WORST(off, 5.0 * EPS, "(of the 1-sigmas)");
}
END_TEST

START_TEST(nine_states_leave_the_bias_alone)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < TRIES; i++) {
        case_t c = make_case(&rng), with_bias;
        insole_zupt_cov_t before = c.P;
        propagate(&c, INSOLE_R(0.005), false);
        insole_zupt_cov_correct_velocity(&c.P, insole_sym3_diagonal(1, 1, 1), INSOLE_R(0.1),
                                         insole_vec3_zero(), false);
        worst_require(&off, memcmp(&c.P.bb, &before.bb, sizeof c.P.bb) == 0, i);
        worst_require(&off, memcmp(&c.P.vb, &before.vb, sizeof c.P.vb) == 0, i);

        c = make_case(&rng);
        forget_bias(&c);
        with_bias = c;
        propagate(&c, INSOLE_R(0.005), false);
        propagate(&with_bias, INSOLE_R(0.005), true);
        dense_t nine = dense_of(&c.P), twelve = dense_of(&with_bias.P);
        dense_t difference = dense_add(nine, -1.0, &twelve);
        for (int j = 0; j < DENSE * DENSE; j++) {
            worst_require(&off, difference.at[j / DENSE][j % DENSE] == 0.0, i);
        }
    }
    ASSERT_ALL_HELD(off);
}
END_TEST

static insole_sym3_t innovation_inverse(const insole_zupt_cov_t *P, insole_real_t r)
{
    insole_sym3_t W = insole_sym3_zero();
    ck_assert(insole_sym3_inverse(insole_sym3_add_diagonal(P->vv, r), &W));
    return W;
}

/* How far K z is from the dense one, in 1-sigmas of the state per 1-sigma of the measurement. */
static double gain_off(const insole_zupt_error_t *dx, const dense_t *gain, insole_vec3_t z,
                       const dense_t *P, double r)
{
    column_t got = column_of(dx);
    double worst = 0.0;
    for (int i = 0; i < DENSE; i++) {
        double expected = gain->at[i][0] * (double)z.x + gain->at[i][1] * (double)z.y +
                          gain->at[i][2] * (double)z.z;
        double size = P->at[i][i] > 0.0 ? sqrt(P->at[i][i] / r) : 1.0;
        worst = fmax(worst, fabs(got.at[i] - expected) / size);
    }
    return worst;
}

/* Variances of the velocity from far below to far above that of the measurement. */
START_TEST(corrects_velocity_like_joseph)
{
    static const double shrink[5] = {1.0e-4, 1.0e-2, 1.0, 1.0e1, 1.0e2};
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    worst_t off = {0.0, 0.0};
    insole_real_t r = (insole_real_t)(4.0e-4 * shrink[_i]);
    for (int i = 0; i < TRIES; i++) {
        case_t c = make_case(&rng);
        dense_t gain;
        dense_t expected = dense_joseph(&c.dense, DENSE_V, 3, (double)r, &gain);
        insole_vec3_t z = sample_vec3(&rng, 1);
        insole_zupt_error_t dx =
            insole_zupt_cov_correct_velocity(&c.P, innovation_inverse(&c.P, r), r, z, true);
        dense_t got = dense_of(&c.P);
        worst_note(&off, dense_off(&got, &expected, &c.dense), i);
        worst_note(&off, gain_off(&dx, &gain, z, &c.dense, (double)r), i);
    }
    ASSERT_WORST(off, 5.0 * EPS, "(of the 1-sigmas before)");
}
END_TEST

START_TEST(corrects_nine_states_like_joseph)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    worst_t off = {0.0, 0.0};
    const insole_real_t r = INSOLE_R(4.0e-4);
    for (int i = 0; i < TRIES; i++) {
        case_t c = make_case(&rng);
        forget_bias(&c);
        dense_t gain;
        dense_t expected = dense_joseph(&c.dense, DENSE_V, 3, (double)r, &gain);
        insole_vec3_t z = sample_vec3(&rng, 1);
        insole_zupt_error_t dx =
            insole_zupt_cov_correct_velocity(&c.P, innovation_inverse(&c.P, r), r, z, false);
        dense_t got = dense_of(&c.P);
        worst_note(&off, dense_off(&got, &expected, &c.dense), i);
        worst_note(&off, gain_off(&dx, &gain, z, &c.dense, (double)r), i);
        ck_assert(dx.b.x == 0 && dx.b.y == 0 && dx.b.z == 0);
    }
    ASSERT_WORST(off, 5.0 * EPS, "(of the 1-sigmas before)");
}
END_TEST

/* A velocity that is known far better than the measurement keeps its own variance to the last
 * digits: (I - K H) P has no difference in the velocity's row. */
START_TEST(well_known_velocity_stays_positive)
{
    worst_t off = {0.0, 0.0};
    const double r = 4.0e-4;
    for (double v = 1.0e-20; v < 1.0; v *= 3.0) {
        insole_zupt_cov_t P = {0};
        insole_real_t var = (insole_real_t)v;
        P.vv = insole_sym3_diagonal(var, var, var);
        insole_zupt_cov_correct_velocity(&P, innovation_inverse(&P, (insole_real_t)r),
                                         (insole_real_t)r, insole_vec3_zero(), true);
        worst_note(&off, fabs((double)P.vv.yy * (v + r) / (v * r) - 1.0), v);
    }
    ASSERT_WORST(off, 5.0 * EPS, "(relative)");
    insole_zupt_cov_t none = {0};
    insole_zupt_cov_correct_velocity(&none, innovation_inverse(&none, INSOLE_R(0.1)), INSOLE_R(0.1),
                                     insole_vec3_zero(), true);
    ck_assert(none.vv.xx == 0 && none.vv.yy == 0 && none.vv.zz == 0);
}
END_TEST

START_TEST(corrects_height_like_joseph)
{
    static const double sigma[4] = {0.001, 0.01, 0.1, 10.0};
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    worst_t off = {0.0, 0.0};
    insole_real_t r = (insole_real_t)(sigma[_i] * sigma[_i]);
    for (int i = 0; i < TRIES; i++) {
        case_t c = make_case(&rng);
        dense_t gain;
        dense_t expected = dense_joseph(&c.dense, DENSE_P + 2, 1, (double)r, &gain);
        insole_zupt_cov_correct_height(&c.P, r);
        dense_t got = dense_of(&c.P);
        worst_note(&off, dense_off(&got, &expected, &c.dense), i);
        worst_note(&off, fabs(got.at[2][2] / expected.at[2][2] - 1.0), i);
    }
    ASSERT_WORST(off, 5.0 * EPS, "(of the 1-sigmas before; height: relative)");
}
END_TEST

START_TEST(multiplies_like_the_full_matrix)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 6u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < TRIES; i++) {
        case_t c = make_case(&rng);
        insole_zupt_error_t x = {sample_vec3(&rng, 1), sample_vec3(&rng, 1), sample_vec3(&rng, 1),
                                 sample_vec3(&rng, 1)};
        insole_zupt_error_t only_v = {insole_vec3_zero(), x.v, insole_vec3_zero(),
                                      insole_vec3_zero()};
        insole_zupt_error_t e_z = {insole_vec3(0, 0, 1), insole_vec3_zero(), insole_vec3_zero(),
                                   insole_vec3_zero()};
        const insole_zupt_error_t arguments[3] = {x, only_v, e_z};
        const insole_zupt_error_t results[3] = {insole_zupt_cov_mul(&c.P, &x),
                                                insole_zupt_cov_of_velocity(&c.P, x.v),
                                                insole_zupt_cov_of_height(&c.P)};
        for (int j = 0; j < 3; j++) {
            column_t in = column_of(&arguments[j]), got = column_of(&results[j]);
            column_t expected = dense_apply(&c.dense, &in);
            for (int k = 0; k < DENSE; k++) {
                double size = sqrt(c.dense.at[k][k]);
                worst_note(&off, fabs(got.at[k] - expected.at[k]) / size, i);
            }
        }
    }
    ASSERT_WORST(off, 5.0 * EPS, "(of the state's 1-sigma)");
}
END_TEST

START_TEST(scales_every_part)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 7u);
    insole_zupt_error_t x = {sample_vec3(&rng, 1), sample_vec3(&rng, 1), sample_vec3(&rng, 1),
                             sample_vec3(&rng, 1)};
    insole_zupt_error_t y = insole_zupt_error_scale(x, INSOLE_R(-4.0));
    column_t from = column_of(&x), to = column_of(&y);
    for (int i = 0; i < DENSE; i++) {
        ck_assert(to.at[i] == -4.0 * from.at[i]);
    }
}
END_TEST

/* Many rounds on the worst mixture: known velocity, wide position, strong turns. */
START_TEST(stays_positive_over_random_rounds)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 8u);
    worst_t below = {0.0, 0.0};
    insole_zupt_cov_t P = make_case(&rng).P;
    const int n = _i == 0 ? NINE : DENSE;
    if (n == NINE) {
        case_t c = {.P = P};
        forget_bias(&c);
        P = c.P;
    }
    for (int i = 0; i < 20000; i++) {
        case_t c = make_case(&rng);
        insole_zupt_interval_t interval = interval_of(&c, INSOLE_R(0.005));
        insole_zupt_cov_propagate(&P, &interval, n == DENSE);
        P.vv = insole_sym3_add_diagonal(P.vv, INSOLE_R(8.0e-6));
        P.aa = insole_sym3_add_diagonal(P.aa, INSOLE_R(1.0e-9));
        if (i % 200 < 80) {
            insole_real_t r = INSOLE_R(4.0e-4);
            insole_zupt_cov_correct_velocity(&P, innovation_inverse(&P, r), r, insole_vec3_zero(),
                                             n == DENSE);
        }
        if (i % 200 == 80) {
            insole_zupt_cov_correct_height(&P, INSOLE_R(1.0e-4));
        }
        if (i % 100 == 99) {
            dense_t d = dense_of(&P), c1 = dense_correlation(&d, n);
            worst_note(&below, -dense_least_eigenvalue(c1, n), i);
        }
    }
    ASSERT_WORST(below, 2.0 * EPS, "(below zero, of a correlation)");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zupt_cov");
    suite_add(suite, "Phi P Phi' of the full matrix", propagates_like_phi_p_phi);
    suite_add(suite, "nine states", nine_states_leave_the_bias_alone);
    suite_add_loop(suite, "velocity by Joseph's form", corrects_velocity_like_joseph, 5);
    suite_add(suite, "nine states by Joseph's form", corrects_nine_states_like_joseph);
    suite_add(suite, "a well known velocity", well_known_velocity_stays_positive);
    suite_add_loop(suite, "height by Joseph's form", corrects_height_like_joseph, 4);
    suite_add(suite, "products with the full matrix", multiplies_like_the_full_matrix);
    suite_add(suite, "scale", scales_every_part);
    suite_add_loop(suite, "positive over many rounds", stays_positive_over_random_rounds, 2);
    return suite;
}
