/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_fusion.h"

#include "filter_calls.h"
#include "insole/base/snapshot.h"
#include "insole/fuse/step_ekf.h"
#include "insole/fuse/step_ukf.h"
#include "near.h"
#include "plane.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define EPS ((double)INSOLE_REAL_EPSILON)

static insole_step_method_t *const METHOD[] = {NULL, insole_step_ekf, insole_step_ukf};

static insole_step_fusion_t begin(const insole_step_fusion_config_t *config)
{
    insole_step_fusion_t fusion;
    ck_assert_int_eq(insole_step_fusion_init(&fusion, config), INSOLE_OK);
    ck_assert_int_eq(insole_step_fusion_start(&fusion, insole_spot(0, 0), insole_sym2_circle(4), 0),
                     INSOLE_OK);
    return fusion;
}

static insole_pace_t some_pace(insole_rng_t *rng)
{
    insole_pace_t pace = {sample_between(rng, INSOLE_R(0.3), 1), sample_between(rng, -3, 3),
                          sample_between(rng, 0, INSOLE_R(0.02)),
                          sample_between(rng, 0, INSOLE_R(0.2))};
    return pace;
}

static insole_spot_fix_t fix_at(uint64_t t_us, insole_spot_t spot, insole_real_t variance)
{
    insole_spot_fix_t fix = {t_us, spot, insole_sym2_circle(variance), {0, 0}};
    return fix;
}

static void take(insole_step_fusion_t *fusion, const insole_spot_fix_t *fix)
{
    ck_assert_int_eq(insole_step_fusion_fix(fusion, fix), INSOLE_OK);
}

/* ---- the filter by the book, in double ---------------------------------------------------- */

typedef struct {
    point_t x;
    plane_t P;
} book_t;

static void book_step(book_t *book, const insole_step_way_t *way)
{
    book->x.x += (double)way->mean.x_m;
    book->x.y += (double)way->mean.y_m;
    book->P = plane_add(book->P, 1.0, plane_of(way->Q));
}

static double book_fix(book_t *book, point_t z, plane_t R)
{
    plane_t W = plane_inverse(plane_add(book->P, 1.0, R)), K = plane_mul(book->P, W);
    point_t v = {z.x - book->x.x, z.y - book->x.y}, shift = plane_apply(K, v);
    book->x.x += shift.x;
    book->x.y += shift.y;
    book->P = plane_add(book->P, -1.0, plane_mul(K, book->P));
    return plane_form(W, v);
}

/* Turns a way by hand, so that the offset is not left to the code under test. */
static point_t turned(insole_spot_t way, double by)
{
    point_t p = {cos(by) * (double)way.x_m - sin(by) * (double)way.y_m,
                 sin(by) * (double)way.x_m + cos(by) * (double)way.y_m};
    return p;
}

START_TEST(it_is_the_filter_of_the_book)
{
    insole_step_method_t *method = METHOD[_i];
    insole_step_fusion_config_t config = insole_step_fusion_defaults;
    config.gate = INSOLE_R(1e9);
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    insole_step_fusion_t fusion = begin(&config);
    const insole_real_t offset = INSOLE_R(0.7);
    ck_assert_int_eq(
        insole_step_fusion_start(&fusion, insole_spot(3, -2), insole_sym2(9, 1, 4), offset),
        INSOLE_OK);
    book_t book = {{3.0, -2.0}, {9.0, 1.0, 1.0, 4.0}};
    worst_t spot = {0.0, 0.0}, covariance = {0.0, 0.0}, nis = {0.0, 0.0};
    for (int i = 0; i < 600; i++) {
        insole_pace_t pace = some_pace(&rng), in_m = pace;
        ck_assert_int_eq(insole_step_fusion_step(&fusion, method, &pace), INSOLE_OK);
        in_m.heading_rad += offset;
        insole_step_way_t way = method ? method(&in_m) : insole_step_ekf(&in_m);
        way.Q = method ? way.Q : insole_sym2_circle(insole_square(config.sigma_way_m));
        book_step(&book, &way);
        if (i % 3 == 0) {
            insole_spot_fix_t fix = {(uint64_t)i + 1u, sample_spot(&rng, 20), sample_sym2(&rng, 5),
                                     sample_spot(&rng, 3)};
            take(&fusion, &fix);
            point_t z = turned(fix.since, (double)offset);
            z.x += (double)fix.spot.x_m;
            z.y += (double)fix.spot.y_m;
            double expected = book_fix(&book, z, plane_of(fix.cov_m2));
            worst_note(&nis, fabs((double)fusion.nis - expected) / (1.0 + expected), i);
        }
        worst_note(&spot, point_apart(book.x, fusion.spot), i);
        worst_note(&covariance, plane_apart(book.P, fusion.P), i);
    }
    ASSERT_WORST(spot, 1000.0 * EPS, "m");
    ASSERT_WORST(covariance, 1000.0 * EPS, "m^2");
    ASSERT_WORST(nis, 2000.0 * EPS, "of it");
    ck_assert_uint_eq(fusion.steps, 600u);
    ck_assert_uint_eq(fusion.fixes, 200u);
}
END_TEST

START_TEST(constant_covariances_take_no_notice_of_what_is_told)
{
    insole_step_method_t *method = METHOD[_i];
    insole_step_fusion_config_t config = insole_step_fusion_defaults;
    config.process = INSOLE_STEP_CONSTANT;
    config.measurement = INSOLE_STEP_CONSTANT;
    config.sigma_length_m = INSOLE_R(0.15);
    config.sigma_heading_rad = INSOLE_R(0.3);
    config.sigma_way_m = INSOLE_R(0.25);
    config.sigma_fix_m = 3;
    insole_step_fusion_t a = begin(&config), b = begin(&config);
    book_t book = {{0.0, 0.0}, {4.0, 0.0, 0.0, 4.0}};
    const plane_t R = {9.0, 0.0, 0.0, 9.0};
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    for (uint64_t i = 1u; i < 100u; i++) {
        insole_pace_t pace = some_pace(&rng), other = pace;
        other.var_heading_rad2 = 1;
        other.var_length_m2 = 1;
        ck_assert_int_eq(insole_step_fusion_step(&a, method, &pace), INSOLE_OK);
        ck_assert_int_eq(insole_step_fusion_step(&b, method, &other), INSOLE_OK);
        other.var_length_m2 = INSOLE_R(0.0225);
        other.var_heading_rad2 = INSOLE_R(0.09);
        insole_step_way_t way = method ? method(&other) : insole_step_ekf(&other);
        way.Q = method ? way.Q : insole_sym2_circle(INSOLE_R(0.0625));
        book_step(&book, &way);
        insole_spot_fix_t fix = fix_at(i, insole_spot_add(a.spot, sample_spot(&rng, 3)), 1);
        take(&a, &fix);
        fix.cov_m2 = insole_sym2(30, 5, 20);
        take(&b, &fix);
        (void)book_fix(&book, point_of(fix.spot), R);
    }
    ck_assert_int_eq(memcmp(&a, &b, sizeof a), 0);
    ASSERT_AT_MOST(point_apart(book.x, a.spot), 1000.0 * EPS, "m");
    ASSERT_AT_MOST(plane_apart(book.P, a.P), 300.0 * EPS, "m^2");
}
END_TEST

/* Steps that err about what is told, as is told: the covariance says how far off the position is.
 */
START_TEST(the_covariance_is_honest)
{
    static const struct {
        insole_step_method_t *method;
        double sigma_rad, least, most;
    } ROWS[] = {
        {insole_step_ekf, 0.1, 1.85, 2.15},
        {insole_step_ukf, 0.1, 1.85, 2.15},
        {insole_step_ekf, 0.35, 2.3, 5.0}, /* too short in the mean: it claims too much */
        {insole_step_ukf, 0.35, 1.85, 2.15},
    };
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    double nees = 0.0, sigma = ROWS[_i].sigma_rad;
    enum { WALKS = 1500, STEPS = 40 };
    for (int w = 0; w < WALKS; w++) {
        insole_step_fusion_t fusion = begin(&insole_step_fusion_defaults);
        point_t truth = sample_of(&rng, plane_of(fusion.P));
        for (int k = 0; k < STEPS; k++) {
            insole_pace_t pace = {INSOLE_R(0.7), INSOLE_R(0.1) * (insole_real_t)k, INSOLE_R(0.01),
                                  (insole_real_t)(sigma * sigma)};
            double d = 0.7 + 0.1 * (double)insole_rng_normal(&rng);
            double psi = 0.1 * k + sigma * (double)insole_rng_normal(&rng);
            truth.x += d * cos(psi);
            truth.y += d * sin(psi);
            ck_assert_int_eq(insole_step_fusion_step(&fusion, ROWS[_i].method, &pace), INSOLE_OK);
            if (k % 3 == 2) {
                insole_sym2_t R = sample_sym2(&rng, 6);
                point_t e = sample_of(&rng, plane_of(R));
                insole_spot_fix_t fix = {
                    (uint64_t)k + 1u,
                    {(insole_real_t)(truth.x + e.x), (insole_real_t)(truth.y + e.y)},
                    R,
                    {0, 0}};
                take(&fusion, &fix);
            }
        }
        point_t e = {truth.x - (double)fusion.spot.x_m, truth.y - (double)fusion.spot.y_m};
        nees += plane_form(plane_inverse(plane_of(fusion.P)), e) / WALKS;
    }
    /* 2 when consistent, with a 1-sigma of 0.05 over 1500 walks */
    ASSERT_AT_LEAST(nees, ROWS[_i].least, "");
    ASSERT_AT_MOST(nees, ROWS[_i].most, "");
}
END_TEST

/* ---- the gate ------------------------------------------------------------------------------ */

START_TEST(one_far_fix_does_little)
{
    insole_step_fusion_config_t config = insole_step_fusion_defaults;
    config.gated = _i;
    insole_step_fusion_t fusion = begin(&config), before;
    before = fusion;
    insole_spot_fix_t fix = fix_at(1u, insole_spot(60, 0), 5);
    take(&fusion, &fix);
    ASSERT_NEAR(fusion.nis, 400.0, 400.0 * 8.0 * EPS, "");
    ck_assert_uint_eq(fusion.gated, 1u);
    ck_assert_uint_eq(fusion.gated_in_row, 1u);
    ck_assert_uint_eq(fusion.widened, 0u);
    if (_i == INSOLE_STEP_PASS) {
        ck_assert_int_eq(memcmp(&before.spot, &fusion.spot, sizeof fusion.spot), 0);
        ck_assert_int_eq(memcmp(&before.P, &fusion.P, sizeof fusion.P), 0);
    } else {
        book_t book = {{0.0, 0.0}, {4.0, 0.0, 0.0, 4.0}};
        double r = 5.0 * (400.0 / 9.0) * (400.0 / 9.0);
        plane_t R = {r, 0.0, 0.0, r};
        (void)book_fix(&book, point_of(fix.spot), R);
        ASSERT_AT_MOST(point_apart(book.x, fusion.spot), 100.0 * EPS, "m");
        ASSERT_AT_MOST(plane_apart(book.P, fusion.P), 100.0 * EPS, "m^2");
        ASSERT_AT_MOST(fusion.spot.x_m, 0.1, "m");
    }
    fix = fix_at(2u, insole_spot(1, 0), 5);
    take(&fusion, &fix);
    ck_assert_uint_eq(fusion.gated_in_row, 0u);
    ASSERT_AT_LEAST(fusion.spot.x_m, 0.4, "m");
}
END_TEST

START_TEST(patience_ends_with_the_fix_that_the_settings_name)
{
    insole_step_fusion_config_t config = insole_step_fusion_defaults;
    config.gated = INSOLE_STEP_PASS;
    insole_step_fusion_t fusion = begin(&config);
    for (int i = 1; i <= 6; i++) {
        insole_spot_fix_t fix = fix_at((uint64_t)i, insole_spot(900, 0), 1);
        take(&fusion, &fix);
        int widened = i < 4 ? 0 : i - 3;
        ck_assert_uint_eq(fusion.widened, (uint32_t)widened);
        ASSERT_NEAR(fusion.P.xx, 4.0 * pow(4.0, widened), 0.001, "m^2");
        ASSERT_NEAR(fusion.spot.x_m, 0.0, 0.0, "m");
    }
}
END_TEST

START_TEST(a_gate_that_is_off_lets_all_pass)
{
    insole_step_fusion_config_t config = insole_step_fusion_defaults;
    config.gate = INSOLE_R(1e9);
    insole_step_fusion_t fusion = begin(&config);
    insole_spot_fix_t fix = fix_at(1u, insole_spot(6000, 0), 4);
    take(&fusion, &fix);
    ASSERT_NEAR(fusion.spot.x_m, 3000.0, 0.001, "m");
    ck_assert_uint_eq(fusion.gated, 0u);
}
END_TEST

/* Carried off by `away` after a minute of good fixes: the number of fixes until it is back. */
static int fixes_until_back(const insole_step_fusion_config_t *config, insole_real_t away)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    insole_step_fusion_t fusion = begin(config);
    for (uint64_t t = 1u; t <= 200u; t++) {
        bool gone = t > 60u;
        insole_spot_t here = {gone ? away : 0, gone ? -away : 0};
        insole_spot_t noise = {2 * insole_rng_normal(&rng), 2 * insole_rng_normal(&rng)};
        insole_pace_t standing = {0, 0, INSOLE_R(0.01), 0};
        ck_assert_int_eq(insole_step_fusion_step(&fusion, insole_step_ekf, &standing), INSOLE_OK);
        insole_spot_fix_t fix = fix_at(t, insole_spot_add(here, noise), 4);
        take(&fusion, &fix);
        double off = (double)insole_spot_norm(insole_spot_sub(fusion.spot, here));
        ck_assert_msg(gone || off < 4.0, "lost without reason at %d", (int)t);
        if (gone && off < 5.0) {
            return (int)t - 60;
        }
    }
    return 1000;
}

START_TEST(who_was_carried_off_is_found_again)
{
    static const insole_real_t AWAY[] = {20, 100, 1000, 50000};
    insole_step_fusion_config_t config = insole_step_fusion_defaults;
    config.gated = _i % 2;
    int fixes = fixes_until_back(&config, AWAY[_i / 2]);
    double D2 = 2.0 * pow((double)AWAY[_i / 2], 2.0);
    double most = config.patience + ceil(log(D2 / (9.0 * 0.2)) / log((double)config.widen)) + 2.0;
    ASSERT_AT_LEAST(fixes, (double)config.patience - 1.0, "fixes");
    ASSERT_AT_MOST(fixes, most, "fixes");
}
END_TEST

/* Three wild fixes, however far and however sure, and all is well as soon as they end. */
START_TEST(a_burst_within_the_patience_is_weathered)
{
    insole_step_fusion_t fusion = begin(&insole_step_fusion_defaults);
    uint64_t t = 0u;
    for (int round = 0; round < 100; round++) {
        for (int wild = 0; wild < fusion.config.patience - 1; wild++) {
            insole_spot_fix_t fix = fix_at(++t, insole_spot(500, 300), 1);
            take(&fusion, &fix);
        }
        for (int good = 0; good < 3; good++) {
            insole_spot_fix_t fix = fix_at(++t, insole_spot(1, 1), 4);
            take(&fusion, &fix);
        }
        insole_pace_t standing = {0, 0, INSOLE_R(0.01), 0};
        ck_assert_int_eq(insole_step_fusion_step(&fusion, insole_step_ekf, &standing), INSOLE_OK);
    }
    ck_assert_uint_eq(fusion.widened, 0u);
    ASSERT_AT_MOST(insole_spot_norm(fusion.spot), 2.0, "m");
}
END_TEST

/* ---- for ever ------------------------------------------------------------------------------ */

START_TEST(a_day_leaves_a_covariance)
{
    insole_step_fusion_config_t config = insole_step_fusion_defaults;
    config.gated = _i % 2;
    insole_step_method_t *method = METHOD[_i];
    insole_step_fusion_t fusion = begin(&config);
    insole_rng_t rng;
    insole_rng_seed(&rng, 7u);
    worst_t held = {0.0, 0.0};
    for (uint32_t i = 0u; i < 170000u; i++) {
        insole_pace_t pace = some_pace(&rng);
        worst_require(&held, insole_step_fusion_step(&fusion, method, &pace) == INSOLE_OK, i);
        if (i % 4u == 0u && i % 20000u < 15000u) {
            insole_real_t size = insole_exp(sample_between(&rng, -4, 4));
            insole_spot_fix_t fix = {i + 1u, sample_spot(&rng, 50), sample_sym2(&rng, size),
                                     sample_spot(&rng, 3)};
            worst_require(&held, insole_step_fusion_fix(&fusion, &fix) == INSOLE_OK, i);
        }
        worst_require(&held, insole_sym2_is_between(fusion.P, INSOLE_R(1e-6), INSOLE_R(1e12)), i);
        worst_require(&held, insole_spot_norm(fusion.spot) < 20000, i);
    }
    ASSERT_ALL_HELD(held);
}
END_TEST

START_TEST(the_extremes_that_are_taken_stay_finite)
{
    insole_step_fusion_config_t config = insole_step_fusion_defaults;
    config.gated = _i % 2;
    config.gate = _i < 2 ? INSOLE_R(0.1) : INSOLE_R(1e9);
    config.widen = 100;
    config.patience = 3;
    insole_step_fusion_t fusion = begin(&config);
    insole_rng_t rng;
    insole_rng_seed(&rng, 8u);
    static const insole_real_t SIZE[] = {INSOLE_R(1e-6), 1, INSOLE_R(1e12)};
    worst_t held = {0.0, 0.0};
    for (uint32_t i = 0u; i < 20000u; i++) {
        insole_real_t a = SIZE[insole_rng_bits(&rng) % 3u], b = SIZE[insole_rng_bits(&rng) % 3u];
        insole_real_t r = sample_between(&rng, INSOLE_R(-0.9999), INSOLE_R(0.9999));
        insole_spot_fix_t fix = {i + 1u, sample_spot(&rng, INSOLE_R(1e5)),
                                 insole_sym2(a, r * insole_sqrt(a) * insole_sqrt(b), b),
                                 sample_spot(&rng, INSOLE_R(1e5))};
        worst_require(&held, insole_step_fusion_fix(&fusion, &fix) == INSOLE_OK, i);
        insole_pace_t pace = {10, sample_between(&rng, -1000, 1000), 100, INSOLE_R(1e30)};
        (void)insole_step_fusion_step(&fusion, METHOD[i % 3u], &pace);
        worst_require(&held, insole_sym2_is_between(fusion.P, INSOLE_R(1e-6), INSOLE_R(1e12)), i);
        worst_require(&held, insole_spot_norm(fusion.spot) < INSOLE_R(2e6), i);
    }
    ASSERT_ALL_HELD(held);
}
END_TEST

/* ---- contract ------------------------------------------------------------------------------ */

static insole_step_fusion_config_t config;

static insole_status_t judge(void)
{
    insole_step_fusion_t fusion;
    memset(&fusion, 0x5a, sizeof fusion);
    insole_step_fusion_t before = fusion;
    insole_status_t status = insole_step_fusion_init(&fusion, &config);
    ck_assert(status == INSOLE_OK || memcmp(&fusion, &before, sizeof fusion) == 0);
    return status;
}

START_TEST(settings_have_their_ranges)
{
    config = insole_step_fusion_defaults;
    INSOLE_STEP_FUSION_KEYS(SETTING_HAS_ENDS)
    insole_step_fusion_t fusion;
    memset(&fusion, 0x5a, sizeof fusion);
    ck_assert_int_eq(insole_step_fusion_init(NULL, &config), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(fusion, insole_step_fusion_init(&fusion, NULL), INSOLE_ERR_NULL);
}
END_TEST

#define REFUSED(call, why) ASSERT_REFUSED(f, f.refused, call, why)

START_TEST(bad_input_is_refused)
{
    const insole_real_t nan = (insole_real_t)NAN;
    const insole_sym2_t circle = insole_sym2_circle(1);
    insole_step_fusion_t f;
    ck_assert_int_eq(insole_step_fusion_init(&f, &insole_step_fusion_defaults), INSOLE_OK);
    insole_pace_t pace = {1, 0, 0, 0}, bad_pace = {-1, 0, 0, 0};
    insole_spot_fix_t fix = fix_at(5u, insole_spot(1, 1), 1), bad_fix = fix;
    bad_fix.cov_m2.xy = nan;
    REFUSED(insole_step_fusion_step(&f, NULL, &pace), INSOLE_ERR_STATE);
    REFUSED(insole_step_fusion_fix(&f, &fix), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_step_fusion_start(NULL, insole_spot(0, 0), circle, 0), INSOLE_ERR_NULL);
    REFUSED(insole_step_fusion_start(&f, insole_spot(nan, 0), circle, 0), INSOLE_ERR_VALUE);
    REFUSED(insole_step_fusion_start(&f, insole_spot(0, INSOLE_R(2e5)), circle, 0),
            INSOLE_ERR_VALUE);
    REFUSED(insole_step_fusion_start(&f, insole_spot(0, 0), insole_sym2(1, 1, 1), 0),
            INSOLE_ERR_VALUE);
    REFUSED(insole_step_fusion_start(&f, insole_spot(0, 0), circle, nan), INSOLE_ERR_VALUE);
    REFUSED(insole_step_fusion_start(&f, insole_spot(0, 0), circle, 1001), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_step_fusion_start(&f, insole_spot(0, 0), circle, 0), INSOLE_OK);
    ck_assert_int_eq(insole_step_fusion_step(NULL, NULL, &pace), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(f, insole_step_fusion_step(&f, NULL, NULL), INSOLE_ERR_NULL);
    REFUSED(insole_step_fusion_step(&f, insole_step_ekf, &bad_pace), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_step_fusion_fix(NULL, &fix), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(f, insole_step_fusion_fix(&f, NULL), INSOLE_ERR_NULL);
    REFUSED(insole_step_fusion_fix(&f, &bad_fix), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_step_fusion_fix(&f, &fix), INSOLE_OK);
    REFUSED(insole_step_fusion_fix(&f, &fix), INSOLE_ERR_TIME);
    fix.t_us = 4u;
    REFUSED(insole_step_fusion_fix(&f, &fix), INSOLE_ERR_TIME);
    ck_assert_int_eq(insole_step_fusion_start(&f, insole_spot(0, 0), circle, 0), INSOLE_OK);
    ck_assert_int_eq(insole_step_fusion_fix(&f, &fix), INSOLE_OK);
    f.spot.x_m = INSOLE_R(999995.0);
    pace.length_m = 10;
    REFUSED(insole_step_fusion_step(&f, NULL, &pace), INSOLE_ERR_VALUE);
}
END_TEST

static void walk(insole_step_fusion_t *fusion, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        insole_rng_t rng;
        insole_rng_seed(&rng, i);
        insole_pace_t pace = some_pace(&rng);
        ck_assert_int_eq(insole_step_fusion_step(fusion, insole_step_ukf, &pace), INSOLE_OK);
        insole_spot_fix_t fix = fix_at(i + 1u, sample_spot(&rng, i % 20u < 10u ? 5 : 90), 3);
        take(fusion, &fix);
    }
}

START_TEST(a_saved_state_goes_on_alike)
{
    insole_step_fusion_t fusion = begin(&insole_step_fusion_defaults), restored;
    walk(&fusion, 0u, 50u);
    unsigned char bytes[sizeof fusion + INSOLE_SNAPSHOT_HEADER_BYTES];
    size_t used;
    ck_assert_int_eq(insole_snapshot_save(9u, &fusion, sizeof fusion, bytes, sizeof bytes, &used),
                     INSOLE_OK);
    ck_assert_int_eq(insole_snapshot_load(9u, &restored, sizeof restored, bytes, used), INSOLE_OK);
    walk(&fusion, 50u, 200u);
    walk(&restored, 50u, 200u);
    ck_assert_int_eq(memcmp(&fusion, &restored, sizeof fusion), 0);
    ck_assert_uint_gt(fusion.widened, 0u);
}
END_TEST

static const insole_step_filter_calls_t *const CALLS[] = {
    &insole_step_kf_calls, &insole_step_ekf_calls, &insole_step_ukf_calls};

/* Bit for bit what the calls themselves do with the same news. */
START_TEST(the_tables_are_the_calls_they_name)
{
    insole_step_filter_begin_t at = filter_begin();
    insole_step_filter_answer_t answer;
    insole_step_fusion_t direct = begin(&insole_step_fusion_defaults), named = direct;
    insole_rng_t rng;
    insole_rng_seed(&rng, 40u + (uint64_t)_i);
    ck_assert_int_eq(insole_step_fusion_start(&direct, at.spot, at.cov_m2, at.offset_rad),
                     INSOLE_OK);
    ck_assert_int_eq(CALLS[_i]->start(&named, &at), INSOLE_OK);
    for (uint32_t i = 1u; i < 100u; i++) {
        insole_pace_t pace = some_pace(&rng);
        insole_spot_fix_t fix = fix_at(i, sample_spot(&rng, 9), 3);
        ck_assert_int_eq(insole_step_fusion_step(&direct, METHOD[_i], &pace), INSOLE_OK);
        ck_assert_int_eq(CALLS[_i]->step(&named, i, &pace), INSOLE_OK);
        take(&direct, &fix);
        ck_assert_int_eq(CALLS[_i]->fix(&named, &fix), INSOLE_OK);
        ck_assert_mem_eq(&direct, &named, sizeof direct);
    }
    ck_assert_int_eq(CALLS[_i]->answer(&named, &answer), INSOLE_OK);
    ck_assert_mem_eq(&answer.spot, &direct.spot, sizeof answer.spot);
    ck_assert_mem_eq(&answer.cov_m2, &direct.P, sizeof answer.cov_m2);
    ck_assert(answer.offset_rad == direct.offset_rad);
    ck_assert(answer.var_offset_rad2 == 0 && answer.scale == 1);
    ck_assert(!CALLS[_i]->compass && !CALLS[_i]->work);
}
END_TEST

START_TEST(the_tables_refuse_what_the_calls_refuse)
{
    insole_step_fusion_t fusion;
    ck_assert_int_eq(insole_step_fusion_init(&fusion, &insole_step_fusion_defaults), INSOLE_OK);
    check_filter_calls(CALLS[_i], &fusion);
    ck_assert_uint_eq(fusion.refused, 3u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("step_fusion");
    suite_add_loop(suite, "book", it_is_the_filter_of_the_book, 3);
    suite_add_loop(suite, "constant", constant_covariances_take_no_notice_of_what_is_told, 3);
    suite_add_loop(suite, "honest", the_covariance_is_honest, 4);
    suite_add_loop(suite, "gate", one_far_fix_does_little, 2);
    suite_add(suite, "patience", patience_ends_with_the_fix_that_the_settings_name);
    suite_add(suite, "open", a_gate_that_is_off_lets_all_pass);
    suite_add_loop(suite, "carried", who_was_carried_off_is_found_again, 8);
    suite_add(suite, "burst", a_burst_within_the_patience_is_weathered);
    suite_add_loop(suite, "day", a_day_leaves_a_covariance, 3);
    suite_add_loop(suite, "extremes", the_extremes_that_are_taken_stay_finite, 4);
    suite_add(suite, "settings", settings_have_their_ranges);
    suite_add(suite, "refused", bad_input_is_refused);
    suite_add(suite, "saved", a_saved_state_goes_on_alike);
    suite_add_loop(suite, "tables", the_tables_are_the_calls_they_name, 3);
    suite_add_loop(suite, "tables refuse", the_tables_refuse_what_the_calls_refuse, 3);
    return suite;
}
