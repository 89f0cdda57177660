/* SPDX-License-Identifier: MIT */
#include "insole/fuse/walker_cov.h"

#include "near.h"
#include "plane.h"
#include "suite.h"
#include "walker.h"

/* Rounding, times what one state tells of another; a double build holds it, too. */
#define TOLERANCE (1000.0 * (double)INSOLE_REAL_EPSILON)

enum { CASES = 300 };

static insole_rng_t rng;

static insole_walker_column_t some_column(void)
{
    insole_walker_column_t v;
    for (int i = 0; i < SIX; i++) {
        v.at[i] = insole_rng_normal(&rng);
    }
    return v;
}

/* Full rank, states of different sizes. */
static insole_walker_cov_t some_cov(void)
{
    insole_walker_cov_t P = {{0}, {0}};
    for (int k = 0; k < 2 * SIX; k++) {
        insole_walker_column_t v = some_column();
        v.at[INSOLE_WALKER_TURN] *= INSOLE_R(0.1);
        v.at[INSOLE_WALKER_TURN + 1] *= INSOLE_R(0.1);
        insole_walker_cov_add(&P, 1, v);
    }
    return P;
}

START_TEST(noise_adds_up)
{
    insole_rng_seed(&rng, 1u);
    worst_t off = {0.0, 0.0};
    for (int n = 0; n < CASES; n++) {
        insole_walker_cov_t P = {{0}, {0}};
        dense_t S = dense_diagonal(0.0);
        for (int k = 0; k < 1 + n % 9; k++) { /* fewer than six leave it singular */
            insole_walker_column_t v = some_column();
            column_t w = walker_wide(&v);
            insole_real_t weight = sample_between(&rng, 0, 3);
            insole_walker_cov_add(&P, weight, v);
            S = walker_outer(S, (double)weight, &w);
        }
        worst_note(&off, walker_off(&S, &P), n);
        worst_require(&off, walker_is_sane(&P), n);
    }
    ASSERT_WORST(off, TOLERANCE, "of the sigmas");
}
END_TEST

START_TEST(nothing_is_added_without_weight)
{
    insole_rng_seed(&rng, 2u);
    insole_walker_cov_t P = some_cov(), before = P;
    insole_walker_cov_add(&P, 0, some_column());
    insole_walker_cov_add(&P, -1, some_column());
    insole_walker_cov_add(&P, 1, insole_walker_column(2, insole_spot(0, 0)));
    insole_walker_cov_add_pair(&P, INSOLE_WALKER_X, insole_sym2(0, 0, 0));
    ck_assert_int_eq(memcmp(&P, &before, sizeof P), 0);
}
END_TEST

START_TEST(a_pair_gets_its_noise)
{
    static const int PLACE[] = {INSOLE_WALKER_BIAS, INSOLE_WALKER_X, INSOLE_WALKER_TURN};
    insole_rng_seed(&rng, 3u);
    worst_t off = {0.0, 0.0};
    for (int n = 0; n < CASES; n++) {
        insole_walker_cov_t P = some_cov();
        dense_t S = walker_dense(&P);
        insole_sym2_t Q = sample_sym2(&rng, 5);
        int p = PLACE[_i];
        S.at[p][p] += (double)Q.xx;
        S.at[p][p + 1] += (double)Q.xy;
        S.at[p + 1][p] += (double)Q.xy;
        S.at[p + 1][p + 1] += (double)Q.yy;
        insole_walker_cov_add_pair(&P, p, Q);
        worst_note(&off, walker_off(&S, &P), n);
        worst_note(&off,
                   plane_apart(plane_of(insole_sym2((insole_real_t)S.at[p][p],
                                                    (insole_real_t)S.at[p][p + 1],
                                                    (insole_real_t)S.at[p + 1][p + 1])),
                               insole_walker_cov_pair(&P, p)) /
                       (S.at[p][p] + S.at[p + 1][p + 1]),
                   n);
    }
    ASSERT_WORST(off, TOLERANCE, "of the sigmas");
}
END_TEST

START_TEST(walk_fade_and_turn_are_products)
{
    insole_rng_seed(&rng, 4u);
    worst_t off = {0.0, 0.0};
    for (int n = 0; n < CASES; n++) {
        insole_walker_cov_t P = some_cov();
        dense_t S = walker_dense(&P), F = dense_diagonal(1.0);
        insole_spot_t a = sample_spot(&rng, 3), b = sample_spot(&rng, 3);
        insole_real_t left = n % 5 == 0 ? INSOLE_R(0.0) : sample_between(&rng, 0, 1);
        if (_i == 0) {
            F.at[2][4] = (double)a.x_m;
            F.at[3][4] = (double)a.y_m;
            F.at[2][5] = (double)b.x_m;
            F.at[3][5] = (double)b.y_m;
            insole_walker_cov_walk(&P, a, b);
        } else if (_i == 1) {
            F.at[0][0] = F.at[1][1] = (double)left;
            insole_walker_cov_fade(&P, left);
        } else {
            b = insole_spot_add(b, insole_spot_left(a)); /* not along the other row */
            F.at[4][4] = (double)a.x_m;
            F.at[4][5] = (double)a.y_m;
            F.at[5][4] = (double)b.x_m;
            F.at[5][5] = (double)b.y_m;
            insole_walker_cov_turn(&P, a, b);
        }
        double det = _i == 2 ? F.at[4][4] * F.at[5][5] - F.at[4][5] * F.at[5][4] : 1.0;
        double size = _i == 2 ? F.at[4][4] * F.at[4][4] + F.at[5][5] * F.at[5][5] +
                                    F.at[4][5] * F.at[4][5] + F.at[5][4] * F.at[5][4]
                              : 1.0;
        dense_t T = dense_congruent(&F, &S);
        worst_note(&off, walker_off(&T, &P) * fmin(1.0, fabs(det) / size), n);
        worst_require(&off, walker_is_sane(&P), n);
    }
    ASSERT_WORST(off, TOLERANCE, "of the sigmas");
}
END_TEST

START_TEST(a_number_seen_corrects_by_the_book)
{
    insole_rng_seed(&rng, 5u);
    worst_t off = {0.0, 0.0}, gain = {0.0, 0.0};
    for (int n = 0; n < CASES; n++) {
        insole_walker_cov_t P = some_cov();
        dense_t S = walker_dense(&P);
        insole_walker_column_t h = some_column();
        column_t w = walker_wide(&h);
        insole_real_t r = insole_exp(sample_between(&rng, -5, 5));
        insole_walker_column_t K = insole_walker_cov_correct(&P, &h, r);
        column_t expected = walker_book(&S, &w, (double)r);
        worst_note(&off, walker_off(&S, &P), n);
        for (int i = 0; i < SIX; i++) {
            double size = 1e-3 + fabs(expected.at[i]);
            worst_note(&gain, fabs(expected.at[i] - (double)K.at[i]) / size, n);
        }
    }
    ASSERT_WORST(off, TOLERANCE, "of the sigmas");
    ASSERT_WORST(gain, TOLERANCE, "of it");
}
END_TEST

START_TEST(two_numbers_have_the_covariance_of_the_book)
{
    insole_rng_seed(&rng, 6u);
    worst_t off = {0.0, 0.0};
    for (int n = 0; n < CASES; n++) {
        insole_walker_cov_t P = some_cov();
        insole_walker_column_t hx = some_column(), hy = some_column();
        dense_t S = walker_dense(&P), H = dense_diagonal(0.0);
        for (int i = 0; i < SIX; i++) {
            H.at[0][i] = (double)hx.at[i];
            H.at[1][i] = (double)hy.at[i];
        }
        dense_t T = dense_congruent(&H, &S);
        plane_t expected = {T.at[0][0], T.at[0][1], T.at[1][0], T.at[1][1]};
        double size = T.at[0][0] + T.at[1][1];
        worst_note(&off, plane_apart(expected, insole_walker_cov_seen(&P, &hx, &hy)) / size, n);
    }
    ASSERT_WORST(off, TOLERANCE, "of them");
}
END_TEST

/* States that are known a million times better than others, and numbers that are better still. */
START_TEST(extremes_stay_positive)
{
    insole_rng_seed(&rng, 7u);
    insole_walker_cov_t P = {{0}, {0}};
    worst_t held = {0.0, 0.0};
    for (int n = 0; n < 20000; n++) {
        insole_real_t size = insole_exp(sample_between(&rng, -10, 10));
        insole_walker_cov_add(&P, size, some_column());
        insole_walker_column_t h = some_column();
        (void)insole_walker_cov_correct(&P, &h, insole_exp(sample_between(&rng, -12, 12)));
        insole_walker_cov_walk(&P, sample_spot(&rng, 1), sample_spot(&rng, 1));
        insole_walker_cov_fade(&P, insole_rng_uniform(&rng));
        worst_require(&held, walker_is_sane(&P), n);
    }
    ASSERT_ALL_HELD(held);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("walker_cov");
    suite_add(suite, "add", noise_adds_up);
    suite_add(suite, "nothing", nothing_is_added_without_weight);
    suite_add_loop(suite, "pair", a_pair_gets_its_noise, 3);
    suite_add_loop(suite, "product", walk_fade_and_turn_are_products, 3);
    suite_add(suite, "correct", a_number_seen_corrects_by_the_book);
    suite_add(suite, "seen", two_numbers_have_the_covariance_of_the_book);
    suite_add(suite, "extremes", extremes_stay_positive);
    return suite;
}
