/* SPDX-License-Identifier: MIT */
#include "insole/place/propagation.h"

#include <string.h>

#include "insole/base/rng.h"
#include "near.h"
#include "suite.h"

static const insole_propagation_config_t *const defaults = &insole_propagation_defaults;

static insole_ap_t ap_at(double x, double y, double z, double p0, double exponent)
{
    insole_ap_t ap = {(insole_real_t)x,  (insole_real_t)y,        (insole_real_t)z,
                      (insole_real_t)p0, (insole_real_t)exponent, -50};
    return ap;
}

/* The constants that the paper prints: n0 2, l_w 20 dB, L_p + L_body 8.81 dB. */
static insole_propagation_config_t as_printed(void)
{
    insole_propagation_config_t config = *defaults;
    config.exponent = 2;
    config.wall_db = 20;
    config.walls_max_db = 1000;
    return config;
}

START_TEST(loss_as_printed)
{
    static const double cases[][4] = {/* d, k_w, p0, expected by (11) */
                                      {1, 0, -30, -38.81},      {10, 0, -30, -58.81},
                                      {10, 1, -30, -78.81},     {100, 2, -30, -118.81},
                                      {2, 0, -40, -54.8305999}, {1.5, 0, -38, -50.3318252}};
    insole_propagation_config_t config = as_printed();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        insole_ap_t ap = ap_at(3, 4, 0, cases[i][2], 2);
        insole_expected_rss_t expected;
        ck_assert_int_eq(insole_propagation_expect(&config, &ap, 3, 4 + (insole_real_t)cases[i][0],
                                                   (insole_real_t)cases[i][1] * config.wall_db, 1,
                                                   &expected),
                         INSOLE_OK);
        ASSERT_NEAR(expected.distance_m, cases[i][0], 1e-5, "m");
        ASSERT_NEAR(expected.rss_dbm, cases[i][3], 2e-5, "dBm");
    }
}
END_TEST

START_TEST(expectation_by_double_precision)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    for (int i = 0; i < 2000; i++) {
        insole_propagation_config_t config = *defaults;
        config.height_m = 3 * insole_rng_uniform(&rng);
        config.multipath_db = 5 * insole_rng_uniform(&rng);
        config.walls_max_db = 40 * insole_rng_uniform(&rng);
        insole_real_t share = insole_rng_uniform(&rng), walls = 40 * insole_rng_uniform(&rng);
        insole_real_t x = 200 * insole_rng_uniform(&rng), y = 100 * insole_rng_uniform(&rng);
        insole_ap_t ap = ap_at(50, 50, 2.5, -40, 1.5 + 2.0 * (double)insole_rng_uniform(&rng));
        double dx = (double)x - 50.0, dy = (double)y - 50.0, dz = (double)config.height_m - 2.5;
        double d = sqrt(dx * dx + dy * dy + dz * dz);
        double loss = 10.0 * (double)ap.exponent * log10(fmax(d, 0.3)) +
                      fmin((double)walls, (double)config.walls_max_db) +
                      (double)config.multipath_db + (double)share * 6.81;
        insole_expected_rss_t expected;
        ck_assert_int_eq(insole_propagation_expect(&config, &ap, x, y, walls, share, &expected),
                         INSOLE_OK);
        ASSERT_NEAR(expected.distance_m, d, 2e-5 + 1e-6 * d, "m");
        ASSERT_NEAR(expected.rss_dbm, -40.0 - loss, 3e-4, "dBm");
    }
}
END_TEST

START_TEST(standing_at_the_access_point)
{
    insole_ap_t ap = ap_at(3, 4, 0, -38, 2);
    insole_expected_rss_t here, beside;
    ck_assert_int_eq(insole_propagation_expect(defaults, &ap, 3, 4, 0, 0, &here), INSOLE_OK);
    ck_assert_int_eq(insole_propagation_expect(defaults, &ap, INSOLE_R(3.2), 4, 0, 0, &beside),
                     INSOLE_OK);
    ASSERT_NEAR(here.distance_m, 0.0, 0.0, "m");
    ASSERT_NEAR(here.rss_dbm, beside.rss_dbm, 0.0, "dBm");
    ASSERT_NEAR(here.rss_dbm, -40.0 + 20.0 * 0.5228787, 1e-4, "dBm");
}
END_TEST

START_TEST(range_undoes_the_expectation)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    for (int i = 0; i < 2000; i++) {
        insole_real_t d = INSOLE_R(0.35) + 150 * insole_square(insole_rng_uniform(&rng));
        insole_real_t share = insole_rng_uniform(&rng), walls = 30 * insole_rng_uniform(&rng);
        insole_ap_t ap = ap_at(0, 0, 0, -35.0 - 10.0 * (double)insole_rng_uniform(&rng),
                               1.6 + 3.0 * (double)insole_rng_uniform(&rng));
        insole_expected_rss_t expected;
        insole_rss_range_t range, further;
        ck_assert_int_eq(insole_propagation_expect(defaults, &ap, d, 0, walls, share, &expected),
                         INSOLE_OK);
        ck_assert_int_eq(
            insole_propagation_range(defaults, &ap, expected.rss_dbm, walls, share, &range),
            INSOLE_OK);
        ASSERT_NEAR(range.range_m / d, 1.0, 2e-5, "");
        /* spread: what a hundredth of sigma_db less would add, by finite difference */
        insole_real_t weaker = expected.rss_dbm - INSOLE_R(0.01) * defaults->sigma_db;
        ck_assert_int_eq(insole_propagation_range(defaults, &ap, weaker, walls, share, &further),
                         INSOLE_OK);
        ASSERT_NEAR(100 * (further.range_m - range.range_m) / range.sigma_m, 1.0, 0.03, "");
    }
}
END_TEST

START_TEST(range_keeps_within_sense)
{
    insole_ap_t ap = ap_at(0, 0, 0, -38, 2);
    insole_rss_range_t range;
    ck_assert_int_eq(insole_propagation_range(defaults, &ap, 20, 0, 0, &range), INSOLE_OK);
    ASSERT_NEAR(range.range_m, 0.3, 1e-6, "m");
    ck_assert_int_eq(insole_propagation_range(defaults, &ap, -5000, 0, 0, &range), INSOLE_OK);
    ASSERT_NEAR(range.range_m, 10000.0, 0.0, "m");
    ck_assert(insole_is_finite(range.sigma_m));
    ap.exponent = INSOLE_R(1e-30);
    ck_assert_int_eq(insole_propagation_range(defaults, &ap, -90, 0, 0, &range), INSOLE_OK);
    ck_assert(insole_is_finite(range.range_m) && insole_is_finite(range.sigma_m));
}
END_TEST

START_TEST(default_access_point)
{
    insole_ap_t ap;
    ck_assert_int_eq(insole_propagation_ap(defaults, 7, -8, INSOLE_R(2.5), &ap), INSOLE_OK);
    ASSERT_NEAR(ap.x_m, 7.0, 0.0, "m");
    ASSERT_NEAR(ap.y_m, -8.0, 0.0, "m");
    ASSERT_NEAR(ap.z_m, 2.5, 0.0, "m");
    ASSERT_NEAR(ap.p0_dbm, -38.0, 0.0, "dBm");
    ASSERT_NEAR(ap.exponent, 2.0, 0.0, "");
    /* -38 - 20 lg 1.5 - 2 - 6.81 / 2 */
    ASSERT_NEAR(ap.near_dbm, -46.9268252, 1e-5, "dBm");
}
END_TEST

START_TEST(nearest_of_a_scan)
{
    const insole_ap_t aps[] = {
        {0, 0, 0, -38, 2, -46}, {9, 0, 0, -38, 2, -46}, {9, 9, 0, -38, 2, -60}};
    static const struct {
        insole_rss_t readings[4];
        uint32_t count;
        int expected; /* -1: none */
    } cases[] = {
        {{{0, -40, 0}, {1, -45, 0}, {2, -50, 0}}, 3, 0},
        {{{1, -45, 0}, {0, -40, 0}, {2, -50, 0}}, 3, 1},
        {{{0, -47, 0}, {1, -48, 0}, {2, -59, 0}}, 3, 2}, /* its threshold is its own */
        {{{0, -46, 0}}, 1, 0},                           /* at the threshold is near */
        {{{0, -47, 0}, {2, -61, 0}}, 2, -1},
        {{{3, -20, 0}, {900, -20, 0}, {1, -44, 0}}, 3, 2}, /* unknown ones are passed over */
        {{{0, (double)NAN, 0}, {1, (double)INFINITY, 0}, {2, -(double)INFINITY, 0}, {1, -44, 0}},
         4,
         3},
        {{{1, -44, 0}, {0, -44, 0}}, 2, 0}, /* of equals the first */
        {{{0, 0, 0}}, 0, -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint32_t reading = 77u;
        insole_status_t status =
            insole_propagation_nearest(aps, 3, cases[i].readings, cases[i].count, &reading);
        ck_assert_int_eq(status, cases[i].expected < 0 ? INSOLE_ERR_STATE : INSOLE_OK);
        ck_assert_uint_eq(reading, cases[i].expected < 0 ? 77u : (uint32_t)cases[i].expected);
    }
}
END_TEST

static double likelihood(const insole_propagation_config_t *config, double deviation_db)
{
    return (double)insole_propagation_log_likelihood(config, (insole_real_t)deviation_db);
}

START_TEST(likelihood_by_double_precision)
{
    insole_propagation_config_t config = *defaults;
    for (double r = -60.0; r <= 60.0; r += 0.7) {
        config.tail = INSOLE_TAIL_GAUSS;
        config.power = 1;
        config.sigma_db = 5;
        ASSERT_NEAR(likelihood(&config, r), -0.5 * r * r / 25.0, 1e-5 * (1.0 + r * r), "");
        config.power = INSOLE_R(0.25);
        ASSERT_NEAR(likelihood(&config, r), -0.125 * r * r / 25.0, 1e-5 * (1.0 + r * r), "");
        config.tail = INSOLE_TAIL_STUDENT;
        config.tail_dof = 3;
        ASSERT_NEAR(likelihood(&config, r), -0.25 * 2.0 * log(1.0 + r * r / 75.0), 1e-5, "");
    }
}
END_TEST

/* Small deviations weigh the same with both tails but for (n + 1) / n; a large one is not the end.
 */
START_TEST(student_has_the_heavier_tail)
{
    insole_propagation_config_t gauss = *defaults, student = *defaults;
    gauss.tail = INSOLE_TAIL_GAUSS;
    student.tail = INSOLE_TAIL_STUDENT;
    ASSERT_NEAR(likelihood(&student, 0.1) / likelihood(&gauss, 0.1), 4.0 / 3.0, 1e-2, "");
    for (double r = 20.0; r < 200.0; r += 10.0) {
        ASSERT_AT_LEAST(likelihood(&student, r), likelihood(&gauss, r), "");
        ASSERT_AT_MOST(likelihood(&student, r), likelihood(&student, r - 10.0), "");
    }
    ASSERT_AT_LEAST(likelihood(&student, 1e30), -100.0, "");
    student.tail_dof = 1000;
    ASSERT_NEAR(likelihood(&student, 10.0) / likelihood(&gauss, 10.0), 1.0, 5e-3, "");
    ASSERT_AT_LEAST(likelihood(&gauss, 1e30), -1e30, "");
}
END_TEST

/* Whatever is in the way, or the way itself, takes from what is heard. */
START_TEST(farther_and_behind_is_weaker)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    for (int i = 0; i < 500; i++) {
        insole_ap_t ap = ap_at(0, 0, 0, -38, 1.5 + 2.0 * (double)insole_rng_uniform(&rng));
        insole_real_t d = 1 + 50 * insole_rng_uniform(&rng), walls = 8 * insole_rng_uniform(&rng);
        insole_real_t share = INSOLE_R(0.8) * insole_rng_uniform(&rng);
        insole_expected_rss_t here, farther, behind, turned;
        insole_propagation_expect(defaults, &ap, d, 0, walls, share, &here);
        insole_propagation_expect(defaults, &ap, 2 * d, 0, walls, share, &farther);
        insole_propagation_expect(defaults, &ap, d, 0, walls + 5, share, &behind);
        insole_propagation_expect(defaults, &ap, d, 0, walls, share + INSOLE_R(0.2), &turned);
        ASSERT_NEAR(here.rss_dbm - farther.rss_dbm, 3.0103 * (double)ap.exponent, 1e-4, "dB");
        ASSERT_NEAR(here.rss_dbm - behind.rss_dbm, 5.0, 1e-4, "dB");
        ASSERT_NEAR(here.rss_dbm - turned.rss_dbm, 0.2 * 6.81, 1e-4, "dB");
    }
}
END_TEST

/* The default access point counts as near within `near_m`, and not beyond, half the body in the
 * way. */
START_TEST(near_is_nearer_than_near_m)
{
    insole_ap_t ap;
    insole_propagation_config_t config = *defaults;
    for (double near = 0.5; near < 6.0; near += 0.5) {
        config.near_m = (insole_real_t)near;
        ck_assert_int_eq(insole_propagation_ap(&config, 5, 5, 0, &ap), INSOLE_OK);
        for (double d = 0.4; d < 8.0; d += 0.2) {
            if (fabs(d - near) > 0.01) {
                insole_expected_rss_t expected;
                uint32_t index;
                insole_propagation_expect(&config, &ap, 5, 5 + (insole_real_t)d, 0, INSOLE_R(0.5),
                                          &expected);
                insole_rss_t reading = {0, expected.rss_dbm, 0};
                ck_assert_int_eq(insole_propagation_nearest(&ap, 1, &reading, 1, &index),
                                 d < near ? INSOLE_OK : INSOLE_ERR_STATE);
            }
        }
    }
}
END_TEST

/* A deviation of one sigma is what the range's sigma makes of it. */
START_TEST(range_and_likelihood_agree)
{
    insole_propagation_config_t config = *defaults;
    insole_ap_t ap = ap_at(0, 0, 0, -38, 3);
    insole_rss_range_t range;
    insole_expected_rss_t expected;
    config.tail = INSOLE_TAIL_GAUSS;
    config.power = 1;
    config.sigma_db = INSOLE_R(0.1);
    for (int rss = -90; rss < -50; rss += 5) {
        insole_real_t rss_dbm = (insole_real_t)rss;
        insole_propagation_range(&config, &ap, rss_dbm, 0, 0, &range);
        insole_propagation_expect(&config, &ap, range.range_m + range.sigma_m, 0, 0, 0, &expected);
        ASSERT_NEAR(likelihood(&config, (double)(rss_dbm - expected.rss_dbm)), -0.5, 0.01, "");
    }
}
END_TEST

START_TEST(settings_out_of_range)
{
    ck_assert_int_eq(insole_propagation_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_check(defaults), INSOLE_OK);
#define CHECK_KEY(kind, name, value, low, high, unit, text)                                        \
    do {                                                                                           \
        insole_propagation_config_t config = *defaults;                                            \
        config.name = (INSOLE_CONFIG_TYPE_##kind)(low);                                            \
        ck_assert_int_eq(insole_propagation_check(&config), INSOLE_OK);                            \
        config.name = (INSOLE_CONFIG_TYPE_##kind)((low)-1);                                        \
        ck_assert_msg(insole_propagation_check(&config) == INSOLE_ERR_VALUE, #name);               \
        config.name = (INSOLE_CONFIG_TYPE_##kind)((high) + 1);                                     \
        ck_assert_msg(insole_propagation_check(&config) == INSOLE_ERR_VALUE, #name);               \
    } while (0);
    INSOLE_PROPAGATION_KEYS(CHECK_KEY)
    insole_propagation_config_t config = *defaults;
    config.power = (double)NAN;
    ck_assert_int_eq(insole_propagation_check(&config), INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(null_pointers)
{
    insole_ap_t ap = ap_at(0, 0, 0, -38, 2);
    insole_expected_rss_t expected;
    insole_rss_range_t range;
    insole_rss_t reading = {0, -40, 0};
    uint32_t index;
    ck_assert_int_eq(insole_propagation_ap(NULL, 0, 0, 0, &ap), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_ap(defaults, 0, 0, 0, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_expect(NULL, &ap, 1, 1, 0, 0, &expected), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_expect(defaults, NULL, 1, 1, 0, 0, &expected),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_expect(defaults, &ap, 1, 1, 0, 0, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_range(NULL, &ap, -60, 0, 0, &range), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_range(defaults, NULL, -60, 0, 0, &range), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_range(defaults, &ap, -60, 0, 0, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_nearest(NULL, 1, &reading, 1, &index), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_nearest(&ap, 1, NULL, 1, &index), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_propagation_nearest(&ap, 1, &reading, 1, NULL), INSOLE_ERR_NULL);
    ASSERT_NEAR(insole_propagation_log_likelihood(NULL, 3), 0.0, 0.0, "");
}
END_TEST

START_TEST(values_without_sense)
{
    static const insole_real_t bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    insole_ap_t ap = ap_at(0, 0, 0, -38, 2), before = ap;
    insole_expected_rss_t expected = {3, 4};
    insole_rss_range_t range = {5, 6};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        insole_real_t b = bad[i];
        ck_assert_int_eq(insole_propagation_ap(defaults, b, 0, 0, &ap), INSOLE_ERR_VALUE);
        ck_assert_int_eq(insole_propagation_ap(defaults, 0, b, 0, &ap), INSOLE_ERR_VALUE);
        ck_assert_int_eq(insole_propagation_ap(defaults, 0, 0, b, &ap), INSOLE_ERR_VALUE);
        ck_assert_mem_eq(&ap, &before, sizeof ap);
        for (int k = 0; k < 6; k++) {
            insole_ap_t wrong = ap;
            insole_real_t x[4] = {1, 1, 0, 0};
            if (k < 4) {
                x[k] = b;
            } else if (k == 4) {
                wrong.p0_dbm = b;
            } else {
                wrong.exponent = b;
            }
            if (k != 2 || i != 1) { /* walls that let nothing through are capped */
                ck_assert_int_eq(
                    insole_propagation_expect(defaults, &wrong, x[0], x[1], x[2], x[3], &expected),
                    INSOLE_ERR_VALUE);
            }
            if (k > 0 && (k != 2 || i != 1)) {
                ck_assert_int_eq(insole_propagation_range(defaults, &wrong, k == 1 ? b : -60, x[2],
                                                          x[3], &range),
                                 INSOLE_ERR_VALUE);
            }
        }
        ASSERT_NEAR(insole_propagation_log_likelihood(defaults, b), 0.0, 0.0, "");
    }
    static const insole_real_t shares[][2] = {{-1, 0}, {0, INSOLE_R(-0.1)}, {0, INSOLE_R(1.1)}};
    for (int i = 0; i < 3; i++) {
        ck_assert_int_eq(
            insole_propagation_expect(defaults, &ap, 1, 1, shares[i][0], shares[i][1], &expected),
            INSOLE_ERR_VALUE);
        ck_assert_int_eq(
            insole_propagation_range(defaults, &ap, -60, shares[i][0], shares[i][1], &range),
            INSOLE_ERR_VALUE);
    }
    ap.exponent = 0;
    ck_assert_int_eq(insole_propagation_range(defaults, &ap, -60, 0, 0, &range), INSOLE_ERR_VALUE);
    ASSERT_NEAR(expected.distance_m + expected.rss_dbm, 7.0, 0.0, "");
    ASSERT_NEAR(range.range_m + range.sigma_m, 11.0, 0.0, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("propagation");
    suite_add(suite, "loss as printed", loss_as_printed);
    suite_add(suite, "expectation by double precision", expectation_by_double_precision);
    suite_add(suite, "standing at the access point", standing_at_the_access_point);
    suite_add(suite, "range undoes the expectation", range_undoes_the_expectation);
    suite_add(suite, "range keeps within sense", range_keeps_within_sense);
    suite_add(suite, "default access point", default_access_point);
    suite_add(suite, "nearest of a scan", nearest_of_a_scan);
    suite_add(suite, "likelihood by double precision", likelihood_by_double_precision);
    suite_add(suite, "student has the heavier tail", student_has_the_heavier_tail);
    suite_add(suite, "farther and behind is weaker", farther_and_behind_is_weaker);
    suite_add(suite, "near is nearer than near_m", near_is_nearer_than_near_m);
    suite_add(suite, "range and likelihood agree", range_and_likelihood_agree);
    suite_add(suite, "settings out of range", settings_out_of_range);
    suite_add(suite, "null pointers", null_pointers);
    suite_add(suite, "values without sense", values_without_sense);
    return suite;
}
