/* SPDX-License-Identifier: MIT */
#include "insole/fuse/radio_bias.h"

#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

static insole_radio_bias_t radio;
static insole_rng_t rng;

static void begin(double sigma_m, double time_s, double floor)
{
    ck_assert_int_eq(insole_radio_bias_init(&radio, (insole_real_t)sigma_m, (insole_real_t)time_s,
                                            (insole_real_t)floor),
                     INSOLE_OK);
}

static insole_spot_fix_t fix_of(double t_s, double x, double y, double xx, double xy, double yy)
{
    insole_spot_fix_t fix = {(uint64_t)(t_s * 1e6),
                             {(insole_real_t)x, (insole_real_t)y},
                             {(insole_real_t)xx, (insole_real_t)xy, (insole_real_t)yy},
                             {0, 0}};
    return fix;
}

static void hear(const insole_spot_fix_t *fix)
{
    ck_assert_int_eq(insole_radio_bias_hear(&radio, fix, true), INSOLE_OK);
}

/* ---- a Kalman filter of the bias by the book, in double, one per way ---- */

typedef struct {
    double b[2], P[2][2], t_s;
} book_t;

static book_t book_begin(double sigma_m)
{
    book_t book = {{0, 0}, {{sigma_m * sigma_m, 0}, {0, sigma_m * sigma_m}}, -1.0};
    return book;
}

/* @return logarithm of the weight without its floor */
static double book_take(book_t *k, const insole_spot_fix_t *fix, double x, double y, double sigma_m,
                        double time_s)
{
    double t_s = 1e-6 * (double)fix->t_us, e = k->t_s < 0 ? 1.0 : exp((k->t_s - t_s) / time_s);
    double R[2][2] = {{(double)fix->cov_m2.xx, (double)fix->cov_m2.xy},
                      {(double)fix->cov_m2.xy, (double)fix->cov_m2.yy}};
    double S[2][2], W[2][2], K[2][2], P[2][2], v[2];
    for (int i = 0; i < 2; i++) {
        k->b[i] *= e;
        for (int j = 0; j < 2; j++) {
            k->P[i][j] = e * e * k->P[i][j] + (i == j ? (1.0 - e * e) * sigma_m * sigma_m : 0.0);
            S[i][j] = R[i][j] + k->P[i][j];
        }
    }
    double det = S[0][0] * S[1][1] - S[0][1] * S[1][0];
    W[0][0] = S[1][1] / det;
    W[1][1] = S[0][0] / det;
    W[0][1] = W[1][0] = -S[0][1] / det;
    v[0] = (double)fix->spot.x_m - x - k->b[0];
    v[1] = (double)fix->spot.y_m - y - k->b[1];
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            K[i][j] = k->P[i][0] * W[0][j] + k->P[i][1] * W[1][j];
        }
    }
    for (int i = 0; i < 2; i++) {
        k->b[i] += K[i][0] * v[0] + K[i][1] * v[1];
        for (int j = 0; j < 2; j++) {
            P[i][j] = k->P[i][j] - K[i][0] * k->P[0][j] - K[i][1] * k->P[1][j];
        }
    }
    memcpy(k->P, P, sizeof P);
    k->t_s = t_s;
    return -0.5 *
           (v[0] * (W[0][0] * v[0] + W[0][1] * v[1]) + v[1] * (W[1][0] * v[0] + W[1][1] * v[1]));
}

/* Weights, means and covariance over twenty fixes that come at uneven times, for three ways. */
START_TEST(it_is_the_filter_by_the_book)
{
    enum { WAYS = 3 };
    worst_t weight = {0, 0}, mean = {0, 0}, cov = {0, 0};
    insole_rng_seed(&rng, 11u + (uint64_t)_i);
    double sigma_m = _i % 2 ? 3.5 : 6.0, time_s = _i < 2 ? 15.0 : 2.0, t_s = 100.0;
    insole_spot_t bias[WAYS] = {{0, 0}, {0, 0}, {0, 0}};
    book_t book[WAYS];
    begin(sigma_m, time_s, 0.0);
    for (int w = 0; w < WAYS; w++) {
        book[w] = book_begin(sigma_m);
    }
    for (int k = 0; k < 20; k++) {
        t_s += (double)sample_between(&rng, 1, 6);
        insole_spot_fix_t fix =
            fix_of(t_s, 3.0 + k, 20.0 - k, (double)sample_between(&rng, 4, 30),
                   (double)sample_between(&rng, -3, 3), (double)sample_between(&rng, 4, 30));
        hear(&fix);
        for (int w = 0; w < WAYS; w++) {
            double x = k + 3.0 * w, y = 20.0 - k - w, x_32 = (double)(insole_real_t)x;
            double expected = book_take(&book[w], &fix, x_32, y, sigma_m, time_s);
            insole_real_t log = insole_radio_bias_weigh(
                &radio, insole_spot((insole_real_t)x, (insole_real_t)y), &bias[w]);
            worst_note(&weight, fabs((double)log - expected), k);
            worst_note(
                &mean,
                hypot((double)bias[w].x_m - book[w].b[0], (double)bias[w].y_m - book[w].b[1]), k);
            worst_note(&cov, fabs((double)radio.P.xx - book[w].P[0][0]), k);
            worst_note(&cov, fabs((double)radio.P.xy - book[w].P[0][1]), k);
            worst_note(&cov, fabs((double)radio.P.yy - book[w].P[1][1]), k);
        }
    }
    ASSERT_WORST(weight, 2e-5, "");
    ASSERT_WORST(mean, 5e-5, "m");
    ASSERT_WORST(cov, 5e-5, "m2");
}
END_TEST

/* The errors of fixes that a Gauss-Markov process with noise makes: at the true place normalised
 * squares are chi-square of two, on average 2; white errors of the same size would be told far more
 * than they are. */
START_TEST(what_is_left_is_white_and_of_the_size_told)
{
    enum { FIXES = 20000 };
    double b[2] = {0, 0}, nis = 0.0, product = 0.0, before = 0.0;
    insole_rng_seed(&rng, 5u);
    insole_spot_t bias = {0, 0};
    begin(3.5, 15.0, 0.0);
    for (int i = 0; i < 2; i++) {
        b[i] = 3.5 * (double)insole_rng_normal(&rng);
    }
    for (int k = 0; k < FIXES; k++) {
        double e = exp(-2.0 / 15.0), spread = 3.5 * sqrt(1.0 - e * e);
        double at[2];
        for (int i = 0; i < 2; i++) {
            b[i] = k > 0 ? e * b[i] + spread * (double)insole_rng_normal(&rng) : b[i];
            at[i] = b[i] + 3.0 * (double)insole_rng_normal(&rng);
        }
        insole_spot_fix_t fix = fix_of(2.0 * k + 1.0, at[0], at[1], 9, 0, 9);
        double mean = (double)bias.x_m * (k > 0 ? e : 1.0);
        hear(&fix);
        nis += -2.0 * (double)insole_radio_bias_weigh(&radio, insole_spot(0, 0), &bias) / FIXES;
        double v = at[0] - mean;
        product += v * before / FIXES / (9.0 + (double)radio.P.xx);
        before = v;
    }
    ASSERT_NEAR(nis, 2.0, 0.05, "");
    ASSERT_NEAR(product, 0.0, 0.03, "");
}
END_TEST

/* exp(-g / 2) + floor, and the share by which the bias is corrected. */
START_TEST(the_floor_by_hand)
{
    begin(2.0, 15.0, 0.01);
    insole_spot_fix_t fix = fix_of(1.0, 0, 0, 12, 0, 4); /* S = 16, 8; gains 1/4, 1/2 */
    hear(&fix);
    for (double off = 0.0; off < 60.0; off += 3.0) {
        insole_spot_t bias = {0, 0};
        double right = exp(-0.5 * (off * off / 16.0 + 1.0 / 8.0)), share = right / (right + 0.01);
        double log_weight =
            (double)insole_radio_bias_weigh(&radio, insole_spot((insole_real_t)-off, -1), &bias);
        ASSERT_NEAR(log_weight, log(right + 0.01), 2e-6, "");
        ASSERT_NEAR(bias.x_m, share * off / 4.0, 1e-5, "m");
        ASSERT_NEAR(bias.y_m, share * 1.0 / 2.0, 1e-6, "m");
    }
}
END_TEST

/* White errors: the kernel about the fix with its covariance, nothing else. */
START_TEST(without_a_bias_it_is_the_kernel_of_the_paper)
{
    begin(0.0, 15.0, 0.0);
    for (int k = 0; k < 5; k++) {
        insole_spot_fix_t fix = fix_of(k + 1.0, 10, 5, 9, 0, 4);
        insole_spot_t bias = {0, 0};
        hear(&fix);
        ASSERT_NEAR(insole_radio_bias_weigh(&radio, insole_spot(7, 9), &bias),
                    -0.5 * (9.0 / 9.0 + 16.0 / 4.0), 1e-6, "");
        ASSERT_NEAR(bias.x_m, 0.0, 0.0, "m");
        ASSERT_NEAR(bias.y_m, 0.0, 0.0, "m");
    }
}
END_TEST

/* Nobody learns: each fix is as wide as noise and bias together, whatever came before. */
START_TEST(who_has_no_mean_does_not_learn)
{
    begin(3.0, 15.0, 0.0);
    for (int k = 0; k < 4; k++) {
        insole_spot_fix_t fix = fix_of(k + 1.0, 5, 0, 7, 0, 7);
        ck_assert_int_eq(insole_radio_bias_hear(&radio, &fix, false), INSOLE_OK);
        ASSERT_NEAR(insole_radio_bias_weigh(&radio, insole_spot(0, 0), NULL), -0.5 * 25.0 / 16.0,
                    2e-6, "");
    }
}
END_TEST

/* A cloud drawn about a fix with R + P: b given the place, by many draws of place and bias. */
START_TEST(a_cloud_drawn_about_a_fix_knows_its_bias)
{
    begin(3.0, 15.0, 0.01);
    insole_spot_fix_t fix = fix_of(1.0, 4, 2, 16, 0, 7); /* K = 9/25, 9/16 */
    hear(&fix);
    insole_spot_t b = insole_radio_bias_at(&radio, insole_spot(-1, 6));
    ASSERT_NEAR(b.x_m, 9.0 / 25.0 * 5.0, 1e-6, "m");
    ASSERT_NEAR(b.y_m, 9.0 / 16.0 * -4.0, 1e-6, "m");
    ASSERT_NEAR(radio.P.xx, 9.0 - 81.0 / 25.0, 1e-5, "m2");
    ASSERT_NEAR(radio.P.yy, 9.0 - 81.0 / 16.0, 1e-5, "m2");
    insole_radio_bias_forget(&radio);
    ASSERT_NEAR(radio.P.xx, 9.0, 0.0, "m2");
    ck_assert_int_eq(insole_radio_bias_hear(&radio, &fix, true), INSOLE_OK); /* the same time */
}
END_TEST

/* Told before the first fix, a smaller sigma is that of init; the one of init is the most. */
START_TEST(what_fixes_share_can_be_told)
{
    insole_spot_fix_t fix = fix_of(1.0, 4, 2, 16, 1, 7), next = fix_of(4.0, 5, 2, 16, 1, 7);
    begin(2.0, 15.0, 0.01);
    hear(&fix);
    hear(&next);
    insole_sym2_t P = radio.P;
    begin(3.0, 15.0, 0.01);
    ck_assert_int_eq(insole_radio_bias_limit(&radio, 2), INSOLE_OK);
    hear(&fix);
    hear(&next);
    ck_assert(radio.P.xx == P.xx && radio.P.xy == P.xy && radio.P.yy == P.yy);
    ck_assert_int_eq(insole_radio_bias_limit(&radio, 50), INSOLE_OK);
    ck_assert(radio.sigma_m == INSOLE_R(3.0));
    ck_assert(radio.P.xx == P.xx); /* what is known stays */
    ck_assert_int_eq(insole_radio_bias_limit(NULL, 1), INSOLE_ERR_NULL);
    const double bad[] = {-1.0, (double)NAN, (double)INFINITY};
    for (int i = 0; i < 3; i++) {
        ASSERT_UNCHANGED(radio, insole_radio_bias_limit(&radio, (insole_real_t)bad[i]),
                         INSOLE_ERR_VALUE);
    }
}
END_TEST

/* The float that a chip computes stays a covariance over a day of fixes. */
START_TEST(the_covariance_stays_one)
{
    worst_t held = {0, 0};
    insole_rng_seed(&rng, 3u);
    begin(1000.0, 1e6, 0.01);
    for (int k = 0; k < 43200; k++) {
        insole_spot_fix_t fix = fix_of(2.0 * k + 1.0, 0, 0, k % 3 ? 1e-6 : 1e12, 0, 1e-6);
        hear(&fix);
        worst_require(&held, radio.P.xx >= 0 && radio.P.yy >= 0 && radio.P.xx <= INSOLE_R(1.001e6),
                      k);
        worst_require(&held, radio.P.xy * radio.P.xy <= INSOLE_R(1.001) * radio.P.xx * radio.P.yy,
                      k);
    }
    ASSERT_ALL_HELD(held);
}
END_TEST

START_TEST(far_off_stays_finite)
{
    begin(3.5, 15.0, _i ? 0.01 : 0.0);
    insole_spot_fix_t fix = fix_of(1.0, 1e5, -1e5, 1e-6, 0, 1e-6);
    insole_spot_t bias = {0, 0};
    hear(&fix);
    double log_weight = (double)insole_radio_bias_weigh(&radio, insole_spot(-1e6, 1e6), &bias);
    ck_assert(log_weight <= (_i ? log(0.01) + 1e-6 : -1e9) && log_weight > -1e30);
    ck_assert(insole_spot_is_finite(bias));
}
END_TEST

static void refuse_init(insole_real_t sigma_m, insole_real_t time_s, insole_real_t floor)
{
    ASSERT_UNCHANGED(radio, insole_radio_bias_init(&radio, sigma_m, time_s, floor),
                     INSOLE_ERR_VALUE);
}

START_TEST(bad_input_changes_nothing)
{
    const insole_real_t nan = (insole_real_t)(double)NAN, inf = (insole_real_t)(double)INFINITY;
    begin(3.5, 15.0, 0.01);
    refuse_init(-1, 15, 0);
    refuse_init(INSOLE_R(1000.1), 15, 0);
    refuse_init(nan, 15, 0);
    refuse_init(3, 0, 0);
    refuse_init(3, nan, 0);
    refuse_init(3, inf, 0);
    refuse_init(3, 15, INSOLE_R(-0.1));
    refuse_init(3, 15, INSOLE_R(1.1));
    refuse_init(3, 15, nan);
    ck_assert_int_eq(insole_radio_bias_init(NULL, 3, 15, 0), INSOLE_ERR_NULL);
    insole_spot_fix_t fix = fix_of(5.0, 0, 0, 4, 0, 4), bad[] = {fix, fix, fix, fix};
    hear(&fix);
    bad[0].spot.x_m = nan;
    bad[1].cov_m2.xx = 0;
    bad[2].cov_m2.xy = 5;
    bad[3].since.y_m = inf;
    for (int i = 0; i < 4; i++) {
        bad[i].t_us += 1u;
        ASSERT_UNCHANGED(radio, insole_radio_bias_hear(&radio, &bad[i], true), INSOLE_ERR_VALUE);
    }
    ASSERT_UNCHANGED(radio, insole_radio_bias_hear(&radio, &fix, true), INSOLE_ERR_TIME);
    fix.t_us--;
    ASSERT_UNCHANGED(radio, insole_radio_bias_hear(&radio, &fix, true), INSOLE_ERR_TIME);
    ASSERT_UNCHANGED(radio, insole_radio_bias_hear(&radio, NULL, true), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_radio_bias_hear(NULL, &fix, true), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("radio_bias");
    suite_add_loop(suite, "by the book", it_is_the_filter_by_the_book, 4);
    suite_add(suite, "white and honest", what_is_left_is_white_and_of_the_size_told);
    suite_add(suite, "floor", the_floor_by_hand);
    suite_add(suite, "no bias", without_a_bias_it_is_the_kernel_of_the_paper);
    suite_add(suite, "no mean", who_has_no_mean_does_not_learn);
    suite_add(suite, "drawn about a fix", a_cloud_drawn_about_a_fix_knows_its_bias);
    suite_add(suite, "told", what_fixes_share_can_be_told);
    suite_add(suite, "covariance", the_covariance_stays_one);
    suite_add_loop(suite, "far off", far_off_stays_finite, 2);
    suite_add(suite, "bad input", bad_input_changes_nothing);
    return suite;
}
