/* SPDX-License-Identifier: MIT */
#include "insole/fuse/evidence.h"

#include <string.h>

#include "insole/base/rng.h"
#include "near.h"
#include "suite.h"

static insole_evidence_t news;
static insole_rng_t rng;

static double uniform(double low, double high)
{
    return low + (high - low) * (double)insole_rng_uniform(&rng);
}

static insole_spot_t spot(double x, double y)
{
    insole_spot_t s = {(insole_real_t)x, (insole_real_t)y};
    return s;
}

static insole_evidence_range_t range(double x, double y, double range_m, double sigma_m, double dof)
{
    insole_evidence_range_t r = {spot(x, y), spot(0.0, 0.0), (insole_real_t)range_m,
                                 (insole_real_t)sigma_m, (insole_real_t)dof};
    return r;
}

static void add_range(insole_evidence_range_t r)
{
    ck_assert_int_eq(insole_evidence_range(&news, &r), INSOLE_OK);
}

static double log_weight(double x, double y)
{
    return (double)insole_evidence_log_weight(&news, (insole_real_t)x, (insole_real_t)y);
}

/* Log of the density (34) along x and y, without what all particles have in common. */
START_TEST(a_position_weighs_as_printed)
{
    worst_t off = {0.0, 0.0};
    insole_rng_seed(&rng, 1u);
    for (int i = 0; i < 500; i++) {
        double x = uniform(-20.0, 20.0), y = uniform(-20.0, 20.0), sigma = uniform(0.5, 5.0);
        insole_evidence_clear(&news);
        ck_assert_int_eq(insole_evidence_position(&news, spot(3.0, 4.0), (insole_real_t)sigma),
                         INSOLE_OK);
        double w_x = exp(-pow(3.0 - x, 2.0) / (2.0 * sigma * sigma));
        double w_y = exp(-pow(4.0 - y, 2.0) / (2.0 * sigma * sigma));
        double expected = log(w_x) + log(w_y);
        if (expected > -600.0) { /* the product itself has underflown beyond */
            worst_note(&off, fabs(log_weight(x, y) - expected) / (1.0 - expected), i);
        }
    }
    ASSERT_WORST(off, 2e-6, "of it");
}
END_TEST

/* (38) and (39), counted once; with a tail that of Student. */
START_TEST(a_range_weighs_as_printed)
{
    worst_t off = {0.0, 0.0};
    insole_rng_seed(&rng, 2u);
    for (int i = 0; i < 500; i++) {
        double x = uniform(-20.0, 20.0), y = uniform(-20.0, 20.0), sigma = uniform(0.5, 3.0);
        double d = uniform(0.0, 20.0), dof = i % 2 == 0 ? 0.0 : uniform(1.0, 10.0);
        insole_evidence_clear(&news);
        add_range(range(-3.0, 5.0, d, sigma, dof));
        double z = (d - hypot(x + 3.0, y - 5.0)) / sigma;
        double expected = dof > 0.0 ? -0.5 * (dof + 1.0) * log1p(z * z / dof) : -0.5 * z * z;
        worst_note(&off, fabs(log_weight(x, y) - expected) / (1.0 - expected), i);
    }
    ASSERT_WORST(off, 3e-6, "of it");
}
END_TEST

/* (41): the product of all weights. */
START_TEST(weights_multiply)
{
    insole_rng_seed(&rng, 3u);
    for (int trial = 0; trial < 50; trial++) {
        double x = uniform(0.0, 20.0), y = uniform(0.0, 20.0), sum = 0.0;
        insole_evidence_range_t each[INSOLE_EVIDENCE_RANGES];
        for (int k = 0; k < INSOLE_EVIDENCE_RANGES; k++) {
            each[k] = range(uniform(0.0, 20.0), uniform(0.0, 20.0), uniform(0.0, 20.0), 2.0,
                            k % 2 == 0 ? 0.0 : 3.0);
            insole_evidence_clear(&news);
            add_range(each[k]);
            sum += log_weight(x, y);
        }
        insole_evidence_clear(&news);
        insole_evidence_position(&news, spot(10.0, 10.0), 3);
        sum += log_weight(x, y);
        for (int k = 0; k < INSOLE_EVIDENCE_RANGES; k++) {
            add_range(each[k]);
        }
        ASSERT_NEAR(log_weight(x, y), sum, 1e-4 * (1.0 - sum), "");
    }
}
END_TEST

START_TEST(nothing_told_weighs_nothing)
{
    insole_evidence_clear(&news);
    ASSERT_NEAR(log_weight(1e4, -1e4), 0.0, 0.0, "");
    ck_assert_int_eq(insole_evidence_stride(&news, 1, 0, 0), INSOLE_OK);
    ck_assert_int_eq(insole_evidence_scan(&news, NULL, 0, spot(1.0, 1.0)), INSOLE_OK);
    ASSERT_NEAR(log_weight(1e4, -1e4), 0.0, 0.0, "");
}
END_TEST

/* 13 sigmas off a factor would underflow float; the logarithm still tells near from far. */
START_TEST(far_particles_are_told_apart_and_stay_finite)
{
    insole_evidence_clear(&news);
    insole_evidence_position(&news, spot(0.0, 0.0), INSOLE_R(0.1));
    add_range(range(0.0, 0.0, 0.0, 1e-6, 0.0));
    ck_assert(log_weight(1.0, 0.0) > log_weight(1.1, 0.0));
    ck_assert(log_weight(300.0, 0.0) > log_weight(301.0, 0.0));
    double beyond = log_weight(1e30, 1e30);
    ck_assert(beyond < log_weight(1e5, 0.0) && beyond >= -HUGE_VAL * 0.5);
    ck_assert(insole_is_finite(insole_evidence_log_weight(&news, INSOLE_REAL_MAX, 0)));
}
END_TEST

/* A particle is weighed where it was when the range was measured. */
START_TEST(ways_since_are_turned_and_taken_off)
{
    insole_evidence_range_t r = range(10.0, 0.0, 5.0, 1.0, 0.0);
    r.since = spot(2.0, 1.0);
    insole_evidence_clear(&news);
    add_range(r);
    insole_evidence_scan(&news, NULL, 0, spot(0.0, 3.0));
    insole_turn_t turn = insole_turn(INSOLE_R(0.5) * INSOLE_PI);
    turn.cos *= 2;
    turn.sin *= 2;
    insole_evidence_turn(&news, turn);
    ASSERT_NEAR(news.range[0].since.x_m, -2.0, 1e-5, "m");
    ASSERT_NEAR(news.range[0].since.y_m, 4.0, 1e-5, "m");
    ASSERT_NEAR(news.since.x_m, -6.0, 1e-5, "m");
    ASSERT_NEAR(news.since.y_m, 0.0, 1e-5, "m");
    double z = 5.0 - hypot(7.0 + 2.0 - 10.0, 6.0 - 4.0);
    ASSERT_NEAR(log_weight(7.0, 6.0), -0.5 * z * z, 1e-4, "");
}
END_TEST

START_TEST(a_stride_is_noted_with_wrapped_angles)
{
    insole_evidence_clear(&news);
    ck_assert_int_eq(insole_evidence_stride(&news, INSOLE_R(1.4), 7, -4), INSOLE_OK);
    ck_assert(news.has_stride && !news.has_position && !news.has_scan);
    ASSERT_NEAR(news.length_m, 1.4, 1e-6, "m");
    ASSERT_NEAR(news.heading_rad, 7.0 - 6.283185307, 1e-5, "rad");
    ASSERT_NEAR(news.turn_rad, 6.283185307 - 4.0, 1e-5, "rad");
}
END_TEST

static const double odd[] = {(double)NAN, HUGE_VAL, -HUGE_VAL};

/* Refused, and everything as it was. */
#define REFUSED(call, status)                                                                      \
    do {                                                                                           \
        insole_evidence_t before_ = news;                                                          \
        ck_assert_int_eq(call, status);                                                            \
        ck_assert_mem_eq(&news, &before_, sizeof news);                                            \
    } while (0)

START_TEST(what_is_not_finite_is_refused)
{
    insole_real_t bad = (insole_real_t)odd[_i];
    insole_evidence_clear(&news);
    REFUSED(insole_evidence_stride(&news, bad, 0, 0), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_stride(&news, 1, bad, 0), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_stride(&news, 1, 0, bad), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_position(&news, spot(odd[_i], 0.0), 1), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_position(&news, spot(0.0, odd[_i]), 1), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_position(&news, spot(0.0, 0.0), bad), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_scan(&news, NULL, 0, spot(odd[_i], 0.0)), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_scan(&news, NULL, 0, spot(0.0, odd[_i])), INSOLE_ERR_VALUE);
    for (size_t k = 0; k < 7; k++) {
        insole_evidence_range_t r = range(1.0, 2.0, 3.0, 1.0, 0.0);
        insole_real_t *all[] = {&r.from.x_m, &r.from.y_m, &r.since.x_m, &r.since.y_m,
                                &r.range_m,  &r.sigma_m,  &r.dof};
        *all[k] = bad;
        REFUSED(insole_evidence_range(&news, &r), INSOLE_ERR_VALUE);
    }
}
END_TEST

START_TEST(what_is_out_of_range_is_refused)
{
    insole_evidence_clear(&news);
    REFUSED(insole_evidence_stride(&news, INSOLE_R(-0.01), 0, 0), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_stride(&news, INSOLE_R(100.1), 0, 0), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_position(&news, spot(0.0, 0.0), 0), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_position(&news, spot(0.0, 0.0), -1), INSOLE_ERR_VALUE);
    insole_evidence_range_t r = range(0.0, 0.0, -0.1, 1.0, 0.0);
    REFUSED(insole_evidence_range(&news, &r), INSOLE_ERR_VALUE);
    r = range(0.0, 0.0, 1.0, 0.0, 0.0);
    REFUSED(insole_evidence_range(&news, &r), INSOLE_ERR_VALUE);
    r = range(0.0, 0.0, 1.0, 1.0, -1.0);
    REFUSED(insole_evidence_range(&news, &r), INSOLE_ERR_VALUE);
    for (int k = 0; k < INSOLE_EVIDENCE_RANGES; k++) {
        add_range(range(0.0, 0.0, 1.0, 1.0, 0.0));
    }
    r = range(0.0, 0.0, 1.0, 1.0, 0.0);
    REFUSED(insole_evidence_range(&news, &r), INSOLE_ERR_ROOM);
}
END_TEST

START_TEST(null_is_refused)
{
    insole_evidence_range_t r = range(0.0, 0.0, 1.0, 1.0, 0.0);
    insole_evidence_clear(&news);
    ck_assert_int_eq(insole_evidence_stride(NULL, 1, 0, 0), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_evidence_position(NULL, spot(0.0, 0.0), 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_evidence_range(NULL, &r), INSOLE_ERR_NULL);
    REFUSED(insole_evidence_range(&news, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_evidence_scan(NULL, NULL, 0, spot(0.0, 0.0)), INSOLE_ERR_NULL);
    REFUSED(insole_evidence_scan(&news, NULL, 1, spot(0.0, 0.0)), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_evidence_check(NULL), INSOLE_ERR_NULL);
    insole_evidence_clear(NULL);
    insole_evidence_turn(NULL, insole_turn(0));
    ASSERT_NEAR(insole_evidence_log_weight(NULL, 1, 1), 0.0, 0.0, "");
}
END_TEST

/* ---- what a phone tells ---- */

static insole_spot_fix_t some_fix(void)
{
    insole_spot_fix_t fix = {7, {1, 2}, {4, 1, 9}, {3, 4}};
    return fix;
}

START_TEST(a_phone_s_news_are_noted)
{
    static insole_rss_weigh_t rss;
    insole_radio_map_t map;
    memset(&map, 0, sizeof map);
    insole_spot_fix_t fix = some_fix();
    insole_evidence_clear(&news);
    ck_assert_int_eq(insole_evidence_fix(&news, &fix), INSOLE_OK);
    ck_assert_int_eq(insole_evidence_compass(&news, 7, INSOLE_R(0.5)), INSOLE_OK);
    ck_assert_int_eq(insole_evidence_scatter(&news, INSOLE_R(0.2), INSOLE_R(0.3)), INSOLE_OK);
    REFUSED(insole_evidence_rss(&news, &rss, spot(1.0, 2.0)), INSOLE_ERR_STATE);
    rss.map = &map; /* one of no points, all compared */
    rss.search.in_work = true;
    ck_assert_int_eq(insole_evidence_rss(&news, &rss, spot(1.0, 2.0)), INSOLE_OK);
    ck_assert_int_eq(insole_evidence_check(&news), INSOLE_OK);
    ck_assert(news.fix == &fix && news.rss == &rss && news.has_compass);
    ASSERT_NEAR(news.compass_rad, 7.0 - 6.283185307, 1e-6, "rad");
    ASSERT_NEAR(news.sigma_compass_rad, 0.5, 1e-7, "rad");
    ASSERT_NEAR(news.var_length_m2, 0.2, 1e-7, "m2");
    ASSERT_NEAR(news.var_heading_rad2, 0.3, 1e-7, "rad2");
    ASSERT_NEAR(log_weight(5.0, 5.0), 0.0, 0.0, ""); /* each particle its own, not here */
    insole_evidence_turn(&news, insole_turn(1));
    ASSERT_NEAR(news.rss_since.x_m, 1.0, 0.0, "m"); /* particles turn it */
    ck_assert(news.fix == NULL && news.rss == NULL && news.readings == NULL && news.has_compass);
}
END_TEST

START_TEST(what_a_phone_cannot_have_meant_is_refused)
{
    static insole_rss_weigh_t rss;
    insole_real_t bad = (insole_real_t)odd[_i];
    insole_spot_fix_t fix = some_fix();
    insole_evidence_clear(&news);
    fix.spot.y_m = bad;
    REFUSED(insole_evidence_fix(&news, &fix), INSOLE_ERR_VALUE);
    fix = some_fix();
    fix.cov_m2.xy = 7;
    REFUSED(insole_evidence_fix(&news, &fix), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_fix(&news, NULL), INSOLE_ERR_NULL);
    REFUSED(insole_evidence_compass(&news, bad, 1), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_compass(&news, 0, bad), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_compass(&news, 0, 0), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_compass(&news, 0, 101), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_scatter(&news, bad, 0), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_scatter(&news, 0, bad), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_scatter(&news, -1, 0), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_scatter(&news, 0, -1), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_scatter(&news, 101, 0), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_scatter(&news, 0, 11), INSOLE_ERR_VALUE);
    REFUSED(insole_evidence_rss(&news, NULL, spot(0.0, 0.0)), INSOLE_ERR_NULL);
    REFUSED(insole_evidence_rss(&news, &rss, spot(odd[_i], 0.0)), INSOLE_ERR_VALUE);
    fix = some_fix();
    ck_assert_int_eq(insole_evidence_fix(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_evidence_compass(NULL, 0, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_evidence_scatter(NULL, 0, 0), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_evidence_rss(NULL, &rss, spot(0.0, 0.0)), INSOLE_ERR_NULL);
}
END_TEST

/* Written into the struct by hand, or changed after it was told. */
START_TEST(the_check_finds_what_a_phone_cannot_have_meant)
{
    insole_real_t bad = (insole_real_t)odd[_i];
    insole_spot_fix_t fix = some_fix();
    insole_real_t *told[] = {&news.compass_rad, &news.sigma_compass_rad, &news.var_length_m2,
                             &news.var_heading_rad2, &fix.since.x_m};
    insole_evidence_clear(&news);
    insole_evidence_fix(&news, &fix);
    insole_evidence_compass(&news, 1, 1);
    for (size_t k = 0; k < sizeof told / sizeof told[0]; k++) {
        insole_real_t kept = *told[k];
        ck_assert_int_eq(insole_evidence_check(&news), INSOLE_OK);
        *told[k] = bad;
        ck_assert_int_eq(insole_evidence_check(&news), INSOLE_ERR_VALUE);
        *told[k] = kept;
    }
}
END_TEST

static void tell_all(void)
{
    static insole_rss_t reading;
    insole_evidence_clear(&news);
    insole_evidence_stride(&news, 1, 0, 0);
    insole_evidence_position(&news, spot(0.0, 0.0), 1);
    add_range(range(0.0, 0.0, 1.0, 1.0, 0.0));
    insole_evidence_scan(&news, &reading, 1, spot(0.0, 0.0));
    ck_assert_int_eq(insole_evidence_check(&news), INSOLE_OK);
}

/* What somebody wrote into the struct by hand is found; what is not told may hold anything. */
START_TEST(the_check_finds_what_the_calls_would_refuse)
{
    insole_real_t bad = (insole_real_t)NAN;
    insole_real_t *told[] = {
        &news.length_m,         &news.heading_rad,      &news.turn_rad,
        &news.position.x_m,     &news.position.y_m,     &news.sigma_m,
        &news.since.x_m,        &news.since.y_m,        &news.range[0].from.x_m,
        &news.range[0].range_m, &news.range[0].sigma_m, &news.range[0].dof};
    for (size_t k = 0; k < sizeof told / sizeof told[0]; k++) {
        tell_all();
        *told[k] = bad;
        ck_assert_int_eq(insole_evidence_check(&news), INSOLE_ERR_VALUE);
        news.has_stride = news.has_position = news.has_scan = false;
        news.ranges = 0;
        ck_assert_int_eq(insole_evidence_check(&news), INSOLE_OK);
    }
    tell_all();
    news.ranges = INSOLE_EVIDENCE_RANGES + 1;
    ck_assert_int_eq(insole_evidence_check(&news), INSOLE_ERR_VALUE);
    tell_all();
    news.readings = NULL;
    ck_assert_int_eq(insole_evidence_check(&news), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("evidence");
    suite_add(suite, "position", a_position_weighs_as_printed);
    suite_add(suite, "range", a_range_weighs_as_printed);
    suite_add(suite, "product", weights_multiply);
    suite_add(suite, "nothing", nothing_told_weighs_nothing);
    suite_add(suite, "far", far_particles_are_told_apart_and_stay_finite);
    suite_add(suite, "ways since", ways_since_are_turned_and_taken_off);
    suite_add(suite, "stride", a_stride_is_noted_with_wrapped_angles);
    suite_add_loop(suite, "not finite", what_is_not_finite_is_refused, 3);
    suite_add(suite, "out of range", what_is_out_of_range_is_refused);
    suite_add(suite, "null", null_is_refused);
    suite_add(suite, "check", the_check_finds_what_the_calls_would_refuse);
    suite_add(suite, "phone", a_phone_s_news_are_noted);
    suite_add_loop(suite, "phone, bad input", what_a_phone_cannot_have_meant_is_refused, 3);
    suite_add_loop(suite, "phone, check", the_check_finds_what_a_phone_cannot_have_meant, 3);
    return suite;
}
