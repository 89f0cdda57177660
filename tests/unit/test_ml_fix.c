/* SPDX-License-Identifier: MIT */
#include "insole/place/ml_fix.h"

#include "fingerprints.h"
#include "refusal.h"
#include "setting.h"
#include "solver_calls.h"
#include "suite.h"

enum { APS = 60 };

static prints_t prints;
static insole_ml_fix_t ml;
static insole_ml_fix_config_t config;
static insole_rss_t readings[2 * PRINTS_APS];
static insole_rng_t rng;

static void begin(int density, int answer)
{
    config = insole_ml_fix_defaults;
    config.density = density;
    config.answer = answer;
    insole_rng_seed(&rng, 70u);
    prints_hall(&prints, APS, 0.0, 0.0);
    ck_assert_int_eq(insole_radio_map_check(&prints.map), INSOLE_OK);
    ck_assert_int_eq(insole_ml_fix_init(&ml, &config), INSOLE_OK);
}

static insole_status_t solve(const insole_trusted_area_t *area, uint32_t count,
                             insole_radio_fix_t *fix)
{
    return insole_ml_fix_solve(&ml, &prints.map, area, readings, count, fix);
}

static double miss(const insole_radio_fix_t *fix, double x_m, double y_m)
{
    return hypot((double)fix->spot.x_m - x_m, (double)fix->spot.y_m - y_m);
}

/* ---- the oracle: densities of all access points, multiplied ---- */

static double normal(double x, double mean, double sigma)
{
    return exp(-0.5 * pow((x - mean) / sigma, 2.0)) / (sqrt(2.0 * acos(-1.0)) * sigma);
}

static double gauss(uint32_t entry, double mean, double dbm)
{
    double n = prints.counts[entry], k = (double)config.prior_count;
    double std = prints.spread[entry] / 8.0, prior = (double)config.sigma_db;
    return normal(dbm, mean, sqrt((n * std * std + k * prior * prior) / (n + k)));
}

/* Nine cells, the first of them silence; each gives a quarter to the cells beside it. */
static double histogram(uint32_t point, uint32_t entry, double mean, bool heard, double dbm)
{
    double cells[11] = {0.0}, middles[11];
    cells[1] = prints.visits[point] - prints.counts[entry];
    middles[1] = (double)config.unheard_dbm;
    for (int b = 0; b < 8; b++) {
        cells[2 + b] = prints.bins[entry * 8u + (uint32_t)b];
        middles[2 + b] = -88.0 + 8.0 * b;
    }
    int cell = heard ? 2 + (int)fmin(7.0, fmax(0.0, floor((dbm + 92.0) / 8.0))) : 1;
    double seen = 0.5 * cells[cell] + 0.25 * cells[cell - 1] + 0.25 * cells[cell + 1];
    double k = (double)config.prior_count;
    double expected = k * 8.0 * normal(middles[cell], mean, (double)config.sigma_db);
    return (seen + expected) / (prints.visits[point] + k) / 8.0;
}

static double log_of(uint32_t point, uint32_t count)
{
    double sum = 0.0, sigma = (double)config.sigma_db, unheard = (double)config.unheard_dbm;
    for (uint32_t ap = 0; ap < prints.map.ap_count; ap++) {
        uint32_t entry = 0;
        double mean = prints_mean(&prints, point, ap, &entry);
        double dbm = prints_heard(readings, count, ap);
        bool heard = !isnan(dbm);
        dbm = heard ? dbm : unheard;
        double density = isnan(mean)           ? normal(dbm, unheard, sigma)
                         : config.density == 0 ? gauss(entry, mean, dbm)
                                               : histogram(point, entry, mean, heard, dbm);
        sum += log(density / normal(unheard, unheard, sigma));
    }
    return sum;
}

START_TEST(product_of_densities)
{
    insole_trusted_area_t area = {{20, 15}, 14};
    begin(_i / 2, _i % 2);
    for (int round = 0; round < 30; round++) {
        static double logs[PRINTS_POINTS];
        static insole_spot_t inside[PRINTS_POINTS];
        uint32_t n = 0;
        const insole_trusted_area_t *where = round % 2 ? &area : NULL;
        insole_radio_fix_t fix;
        uint32_t count = prints_listen(&rng, APS, prints_uniform(&rng, 0.0, 40.0),
                                       prints_uniform(&rng, 0.0, 40.0), 4.0, 0.0, readings);
        ck_assert_int_eq(solve(where, count, &fix), INSOLE_OK);
        for (uint32_t i = 0; i < PRINTS_POINTS; i++) {
            if (insole_radio_map_trusts(where, prints.spots[i])) {
                inside[n] = prints.spots[i];
                logs[n++] = (double)config.independent * log_of(i, count);
            }
        }
        prints_moments_t m = prints_moments(inside, logs, n);
        double top = logs[m.likeliest] / (double)config.independent;
        ASSERT_NEAR(fix.log_weight, top, 1e-4 * (10.0 + fabs(top)), "");
        double x_m = _i % 2 ? m.x_m : (double)inside[m.likeliest].x_m;
        double y_m = _i % 2 ? m.y_m : (double)inside[m.likeliest].y_m;
        ASSERT_AT_MOST(miss(&fix, x_m, y_m), 2e-3, "m");
        double xx = m.xx + pow(x_m - m.x_m, 2.0), yy = m.yy + pow(y_m - m.y_m, 2.0);
        double xy = m.xy + (x_m - m.x_m) * (y_m - m.y_m), widen = (double)config.widen;
        double point_m2 = pow((double)config.point_sigma_m, 2.0);
        ASSERT_NEAR(fix.var_x_m2, point_m2 + widen * xx, 2e-3 * (1.0 + xx), "m2");
        ASSERT_NEAR(fix.cov_xy_m2, widen * xy, 2e-3 * (1.0 + xx + yy), "m2");
        ASSERT_NEAR(fix.var_y_m2, point_m2 + widen * yy, 2e-3 * (1.0 + yy), "m2");
        ck_assert_uint_eq(fix.points, n);
        ck_assert_uint_eq(fix.readings, count);
    }
}
END_TEST

START_TEST(slices_give_the_same_bits)
{
    static const uint32_t slices[] = {1, 3, 16, 64, 1000};
    for (int density = 0; density < 2; density++) {
        insole_radio_fix_t whole, cut;
        begin(density, 1);
        uint32_t count = prints_listen(&rng, APS, 22.0, 9.0, 3.0, 0.0, readings), calls = 1;
        ck_assert_int_eq(solve(NULL, count, &whole), INSOLE_OK);
        ck_assert_int_eq(insole_ml_fix_begin(&ml, &prints.map, NULL, readings, count), INSOLE_OK);
        for (; insole_ml_fix_work(&ml, &prints.map, slices[_i]); calls++) {
            ASSERT_UNCHANGED(ml, insole_ml_fix_finish(&ml, &prints.map, &cut), INSOLE_ERR_STATE);
        }
        ck_assert_uint_eq(calls, (PRINTS_POINTS + slices[_i] - 1u) / slices[_i]);
        insole_ml_fix_t saved = ml;
        ck_assert_int_eq(insole_ml_fix_finish(&ml, &prints.map, &cut), INSOLE_OK);
        ck_assert_mem_eq(&whole.spot, &cut.spot, sizeof whole.spot);
        ck_assert_int_eq(insole_ml_fix_finish(&saved, &prints.map, &cut), INSOLE_OK);
        ck_assert_mem_eq(&whole.spot, &cut.spot, sizeof whole.spot);
    }
}
END_TEST

START_TEST(finds_the_place)
{
    double error_m = 0.0;
    begin(_i / 2, _i % 2);
    config.independent = 1;   /* as the noise of this hall */
    config.unheard_dbm = -69; /* just below the weakest that is heard here */
    ck_assert_int_eq(insole_ml_fix_init(&ml, &config), INSOLE_OK);
    for (int round = 0; round < 200; round++) {
        insole_radio_fix_t fix;
        double x_m = prints_uniform(&rng, 5.0, 35.0), y_m = prints_uniform(&rng, 5.0, 35.0);
        uint32_t count = prints_listen(&rng, APS, x_m, y_m, 3.0, 0.0, readings);
        ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
        double xx = (double)fix.var_x_m2, xy = (double)fix.cov_xy_m2, yy = (double)fix.var_y_m2;
        ck_assert(xx > 0.0 && xx * yy - xy * xy > 0.0);
        error_m += miss(&fix, x_m, y_m) / 200.0;
    }
    ASSERT_AT_MOST(error_m, 4.0, "m");
}
END_TEST

/* Two places alike but for one access point: who does not hear it is not where it is heard. */
START_TEST(silence_is_a_statement)
{
    begin(_i, 0);
    prints_begin(&prints);
    for (int point = 0; point < 2; point++) {
        prints_point(&prints, 10.0 * point, 0.0);
        for (uint32_t ap = 0; ap < 3u; ap++) {
            prints_entry(&prints, ap, -60.0, 2.0);
        }
    }
    prints_entry(&prints, 3, -55.0, 2.0);
    insole_radio_fix_t fix;
    for (uint32_t ap = 0; ap < 4u; ap++) {
        insole_rss_t reading = {ap, ap < 3u ? -60 : -55, 0};
        readings[ap] = reading;
    }
    ck_assert_int_eq(solve(NULL, 4, &fix), INSOLE_OK);
    ASSERT_NEAR(fix.spot.x_m, 10.0, 0.0, "m");
    ck_assert_int_eq(solve(NULL, 3, &fix), INSOLE_OK);
    ASSERT_NEAR(fix.spot.x_m, 0.0, 0.0, "m");
}
END_TEST

START_TEST(map_of_one_point)
{
    insole_radio_fix_t fix;
    begin(_i / 2, _i % 2);
    prints_begin(&prints);
    prints_point(&prints, 7.0, -3.0);
    for (uint32_t ap = 0; ap < 5u; ap++) {
        insole_rss_t reading = {ap, -120, 0};
        readings[ap] = reading;
        prints_entry(&prints, ap, -20.0 - ap, 0.0);
    }
    ck_assert_int_eq(solve(NULL, 5, &fix), INSOLE_OK);
    ASSERT_AT_MOST(miss(&fix, 7.0, -3.0), 0.0, "m");
    ASSERT_NEAR(fix.var_x_m2, config.point_sigma_m * config.point_sigma_m, 0.0, "m2");
    ck_assert(insole_is_finite(fix.log_weight));
}
END_TEST

START_TEST(many_access_points)
{
    insole_radio_fix_t fix;
    begin(_i, 0);
    prints_hall(&prints, 500, 0.0, 0.0);
    uint32_t count = prints_listen(&rng, 500, 17.0, 23.0, 2.0, 0.0, readings);
    ck_assert_uint_gt(count, 400u);
    ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
    ck_assert_uint_eq(fix.readings, count);
    ASSERT_AT_MOST(miss(&fix, 17.0, 23.0), 6.0, "m");
}
END_TEST

/* Whatever the settings, maps and scans: an answer is finite, its covariance one. */
START_TEST(whatever_comes_in)
{
    begin(_i, 1);
    for (int round = 0; round < 500; round++) {
        insole_radio_fix_t fix;
        uint32_t count = 3u + insole_rng_bits(&rng) % 60u;
        config.sigma_db = (insole_real_t)prints_uniform(&rng, 0.5, 50.0);
        config.prior_count = (insole_real_t)prints_uniform(&rng, 0.01, 10.0);
        config.independent = (insole_real_t)prints_uniform(&rng, 0.001, 1.0);
        ck_assert_int_eq(insole_ml_fix_init(&ml, &config), INSOLE_OK);
        for (uint32_t i = 0; i < count; i++) {
            insole_rss_t reading = {insole_rng_bits(&rng) % (APS - 1u),
                                    (insole_real_t)prints_uniform(&rng, -127.0, 0.0), 0};
            readings[i] = reading;
        }
        ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
        double xx = (double)fix.var_x_m2, xy = (double)fix.cov_xy_m2, yy = (double)fix.var_y_m2;
        ck_assert(insole_spot_is_finite(fix.spot) && isfinite(xx + yy));
        ck_assert(xx > 0.0 && xx * yy - xy * xy > 0.0);
    }
}
END_TEST

static insole_status_t judge(void)
{
    return insole_ml_fix_init(&ml, &config);
}

START_TEST(settings)
{
    config = insole_ml_fix_defaults;
    INSOLE_ML_FIX_KEYS(SETTING_HAS_ENDS)
    config.sigma_db = (insole_real_t)NAN;
    memset(&ml, 0x5a, sizeof ml);
    ASSERT_UNCHANGED(ml, judge(), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_ml_fix_init(NULL, &config), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(ml, insole_ml_fix_init(&ml, NULL), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(refusals)
{
    insole_radio_fix_t fix;
    insole_trusted_area_t nowhere = {{500, 500}, 10}, bad = {{0, 0}, -1};
    begin(1, 0);
    memset(&fix, 0x5a, sizeof fix);
    insole_radio_fix_t untouched = fix;
    uint32_t count = prints_listen(&rng, APS, 20.0, 20.0, 1.0, 0.0, readings);
    ASSERT_UNCHANGED(ml, solve(&bad, count, &fix), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(ml, solve(NULL, 2, &fix), INSOLE_ERR_STATE);
    ASSERT_UNCHANGED(ml, solve(NULL, count, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(solve(&nowhere, count, &fix), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&fix, &untouched, sizeof fix);
    prints.map.bins = NULL;
    ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_ERR_STATE);
    begin(0, 0);
    prints.map.bins = prints.map.spread = prints.map.counts = prints.map.visits = NULL;
    ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
}
END_TEST

/* In slices through the table the same bits as at once. */
START_TEST(the_table_is_the_calls_it_names)
{
    insole_radio_fix_t direct;
    insole_trusted_area_t near = {{18, 22}, 12};
    begin(_i % 2, _i / 2);
    uint32_t count = prints_listen(&rng, APS, 20.0, 20.0, 3.0, 0.0, readings);
    solver_scan_t scan = {&prints.map, readings, count};
    insole_ml_fix_t state = ml;
    ck_assert_int_eq(solve(&near, count, &direct), INSOLE_OK);
    check_solver_slices(&insole_ml_fix_calls, &state, &scan, &near, &direct);
    check_solver_refusals(&insole_ml_fix_calls, &state, sizeof state, &scan);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("ml_fix");
    suite_add_loop(suite, "product of densities", product_of_densities, 4);
    suite_add_loop(suite, "slices", slices_give_the_same_bits, 5);
    suite_add_loop(suite, "finds the place", finds_the_place, 4);
    suite_add_loop(suite, "silence is a statement", silence_is_a_statement, 2);
    suite_add_loop(suite, "one point", map_of_one_point, 4);
    suite_add_loop(suite, "many access points", many_access_points, 2);
    suite_add_loop(suite, "whatever comes in", whatever_comes_in, 2);
    suite_add(suite, "settings", settings);
    suite_add(suite, "refusals", refusals);
    suite_add_loop(suite, "table", the_table_is_the_calls_it_names, 4);
    return suite;
}
