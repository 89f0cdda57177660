/* SPDX-License-Identifier: MIT */
#include "insole/place/kde_fix.h"

#include "fingerprints.h"
#include "refusal.h"
#include "setting.h"
#include "solver_calls.h"
#include "suite.h"

enum { APS = 60 };

static prints_t prints;
static insole_kde_fix_t kde;
static insole_kde_fix_config_t config;
static insole_rss_t readings[2 * PRINTS_APS];
static insole_rng_t rng;

static void set_defaults(int kernel)
{
    config = insole_kde_fix_defaults;
    config.kernel = kernel;
    config.sigma_db = 8;
}

static void begin(int kernel)
{
    set_defaults(kernel);
    insole_rng_seed(&rng, 60u);
    prints_hall(&prints, APS, 0.0, 0.0);
    ck_assert_int_eq(insole_radio_map_check(&prints.map), INSOLE_OK);
    ck_assert_int_eq(insole_kde_fix_init(&kde, &config), INSOLE_OK);
}

static insole_status_t solve(const insole_trusted_area_t *area, uint32_t count,
                             insole_radio_fix_t *fix)
{
    return insole_kde_fix_solve(&kde, &prints.map, area, readings, count, fix);
}

static double miss(const insole_radio_fix_t *fix, double x_m, double y_m)
{
    return hypot((double)fix->spot.x_m - x_m, (double)fix->spot.y_m - y_m);
}

/* ---- the oracle: sums over all numbers of access points ---- */

static double bent(double dbm)
{
    double kept = -0.5 * floor(0.5 - 2.0 * dbm), floor_dbm = (double)config.floor_dbm;
    double share = isnan(dbm) ? 0.0 : (kept - floor_dbm) / -floor_dbm;
    return share > 0.0 ? pow(share, (double)config.power) : 0.0;
}

static double log_of(uint32_t point, uint32_t count, double offset_db)
{
    double common = 0.0, sum = 0.0, squares = 0.0, unheard = (double)config.unheard_dbm;
    for (uint32_t ap = 0; ap < prints.map.ap_count; ap++) {
        uint32_t entry;
        double mean = prints_mean(&prints, point, ap, &entry);
        double dbm = prints_heard(readings, count, ap) - offset_db;
        common += fmin(bent(mean), bent(dbm));
        sum += bent(mean) + bent(dbm);
        squares += pow((isnan(mean) ? unheard : mean) - (isnan(dbm) ? unheard : dbm), 2.0);
    }
    return config.kernel == INSOLE_KDE_FIX_GAUSS
               ? -0.5 * squares / pow((double)config.sigma_db, 2.0)
               : -(1.0 - 2.0 * common / sum) / (double)config.width;
}

static void check_against_sums(const insole_radio_fix_t *fix, const insole_trusted_area_t *area,
                               uint32_t count, double offset_db)
{
    static double logs[PRINTS_POINTS];
    static insole_spot_t inside[PRINTS_POINTS];
    uint32_t n = 0;
    for (uint32_t i = 0; i < prints.map.point_count; i++) {
        double x_m = area ? (double)(prints.spots[i].x_m - area->centre.x_m) : 0.0;
        double y_m = area ? (double)(prints.spots[i].y_m - area->centre.y_m) : 0.0;
        if (!area || hypot(x_m, y_m) <= (double)area->radius_m) {
            inside[n] = prints.spots[i];
            logs[n++] = log_of(i, count, offset_db);
        }
    }
    prints_moments_t m = prints_moments(inside, logs, n);
    double widen = (double)config.widen, point_m2 = pow((double)config.point_sigma_m, 2.0);
    ck_assert_uint_eq(fix->points, n);
    ASSERT_NEAR(fix->spot.x_m, m.x_m, 2e-3, "m");
    ASSERT_NEAR(fix->spot.y_m, m.y_m, 2e-3, "m");
    ASSERT_NEAR(fix->var_x_m2, point_m2 + widen * m.xx, 1e-3 * (1.0 + m.xx), "m2");
    ASSERT_NEAR(fix->cov_xy_m2, widen * m.xy, 1e-3 * (1.0 + m.xx + m.yy), "m2");
    ASSERT_NEAR(fix->var_y_m2, point_m2 + widen * m.yy, 1e-3 * (1.0 + m.yy), "m2");
    ASSERT_NEAR(fix->log_weight, logs[m.likeliest], 1e-4 * (1.0 + fabs(logs[m.likeliest])), "");
}

START_TEST(direct_sums)
{
    insole_trusted_area_t area = {{20, 15}, 14};
    begin(_i);
    for (int round = 0; round < 40; round++) {
        insole_radio_fix_t fix;
        uint32_t count = prints_listen(&rng, APS, prints_uniform(&rng, 0.0, 40.0),
                                       prints_uniform(&rng, 0.0, 40.0), 4.0, 0.0, readings);
        const insole_trusted_area_t *where = round % 2 ? &area : NULL;
        ck_assert_int_eq(solve(where, count, &fix), INSOLE_OK);
        check_against_sums(&fix, where, count, 0.0);
        ck_assert_uint_eq(fix.readings, count);
    }
}
END_TEST

/* The covariance times the mean square difference to the best point, in widths of the kernel;
 * place, weight and the other kernel know nothing of it. */
START_TEST(a_scan_that_fits_badly_says_so)
{
    begin(_i);
    for (int round = 0; round < 20; round++) {
        insole_radio_fix_t fix, doubted;
        double noise_db = 0.5 + round;
        uint32_t count = prints_listen(&rng, APS, prints_uniform(&rng, 0.0, 40.0),
                                       prints_uniform(&rng, 0.0, 40.0), noise_db, 0.0, readings);
        kde.config.misfit = INSOLE_KDE_FIX_MISFIT_PASSED_OVER;
        ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
        kde.config.misfit = INSOLE_KDE_FIX_MISFIT_TOLD;
        ck_assert_int_eq(solve(NULL, count, &doubted), INSOLE_OK);
        double times = -2.0 * log_of(fix.likeliest, count, 0.0) / (double)count;
        times = _i == INSOLE_KDE_FIX_GAUSS ? fmin(fmax(times, 0.1), 100.0) : 1.0;
        ASSERT_NEAR(doubted.var_x_m2, times * (double)fix.var_x_m2, 1e-4 * (double)doubted.var_x_m2,
                    "m2");
        ASSERT_NEAR(doubted.cov_xy_m2, times * (double)fix.cov_xy_m2,
                    1e-4 * (double)doubted.var_x_m2, "m2");
        ASSERT_NEAR(doubted.var_y_m2, times * (double)fix.var_y_m2, 1e-4 * (double)doubted.var_y_m2,
                    "m2");
        ck_assert_mem_eq(&doubted.spot, &fix.spot, sizeof fix.spot);
        ASSERT_NEAR(doubted.log_weight, fix.log_weight, 0.0, "");
    }
}
END_TEST

/* A scan as it stands in the map fits better than any noise would, one that is off by all means
 * not at all: what is told has ends. */
START_TEST(misfits_have_ends)
{
    for (int far = 0; far < 2; far++) {
        insole_radio_fix_t fix, doubted;
        begin(INSOLE_KDE_FIX_GAUSS);
        kde.config.sigma_db = far ? INSOLE_R(0.5) : INSOLE_R(1000.0);
        uint32_t count = prints_listen(&rng, APS, 20.0, 20.0, 8.0, 0.0, readings);
        ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
        kde.config.misfit = INSOLE_KDE_FIX_MISFIT_TOLD;
        ck_assert_int_eq(solve(NULL, count, &doubted), INSOLE_OK);
        ASSERT_NEAR(doubted.var_x_m2, (far ? 100.0 : 0.1) * (double)fix.var_x_m2,
                    1e-4 * (double)doubted.var_x_m2, "m2");
    }
}
END_TEST

/* Duplicated ids, strangers and hopeless readings change nothing. */
START_TEST(clutter_changes_nothing)
{
    begin(_i);
    insole_radio_fix_t clean, cluttered;
    uint32_t count = prints_listen(&rng, APS, 12.0, 31.0, 2.0, 0.0, readings);
    ck_assert_int_eq(solve(NULL, count, &clean), INSOLE_OK);
    for (uint32_t i = 0; i < count; i++) {
        readings[count + i] = readings[i];
        readings[count + i].rss_dbm -= i % 2u ? 0 : 7;
    }
    readings[2u * count].id = APS + 3u;
    readings[2u * count].rss_dbm = -30;
    readings[2u * count].age_us = 0;
    readings[2u * count + 1u] = readings[0];
    readings[2u * count + 1u].rss_dbm = (insole_real_t)NAN;
    ck_assert_int_eq(solve(NULL, 2u * count + 2u, &cluttered), INSOLE_OK);
    ck_assert_mem_eq(&clean.spot, &cluttered.spot, sizeof clean.spot);
    ck_assert_uint_eq(cluttered.readings, count);
}
END_TEST

START_TEST(slices_give_the_same_bits)
{
    static const uint32_t slices[] = {1, 3, 16, 64, 1000};
    for (int kernel = 0; kernel < 2; kernel++) {
        insole_radio_fix_t whole, cut;
        begin(kernel);
        uint32_t count = prints_listen(&rng, APS, 22.0, 9.0, 3.0, 0.0, readings);
        ck_assert_int_eq(solve(NULL, count, &whole), INSOLE_OK);
        ck_assert_int_eq(insole_kde_fix_begin(&kde, &prints.map, NULL, readings, count), INSOLE_OK);
        uint32_t calls = 1;
        for (; insole_kde_fix_work(&kde, &prints.map, slices[_i]); calls++) {
            ASSERT_UNCHANGED(kde, insole_kde_fix_finish(&kde, &prints.map, &cut), INSOLE_ERR_STATE);
        }
        ck_assert_uint_eq(calls, (PRINTS_POINTS + slices[_i] - 1u) / slices[_i]);
        ck_assert_int_eq(insole_kde_fix_finish(&kde, &prints.map, &cut), INSOLE_OK);
        ck_assert_mem_eq(&whole.spot, &cut.spot, sizeof whole.spot);
        ASSERT_NEAR(cut.var_x_m2, whole.var_x_m2, 0.0, "m2");
    }
}
END_TEST

/* In the middle of an instance's work a copy goes on as the instance does. */
START_TEST(saved_and_restored)
{
    insole_radio_fix_t fix, again;
    set_defaults(0);
    config.offset = 1;
    begin(0);
    config.offset = 1;
    ck_assert_int_eq(insole_kde_fix_init(&kde, &config), INSOLE_OK);
    uint32_t count = prints_listen(&rng, APS, 22.0, 9.0, 3.0, 5.0, readings);
    ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
    ck_assert_int_eq(insole_kde_fix_begin(&kde, &prints.map, NULL, readings, count), INSOLE_OK);
    insole_kde_fix_work(&kde, &prints.map, 20);
    insole_kde_fix_t saved = kde;
    insole_kde_fix_work(&kde, &prints.map, 100);
    ck_assert_int_eq(insole_kde_fix_finish(&kde, &prints.map, &fix), INSOLE_OK);
    memset(&readings, 0, sizeof readings); /* the scan is not needed any more */
    insole_kde_fix_work(&saved, &prints.map, 100);
    ck_assert_int_eq(insole_kde_fix_finish(&saved, &prints.map, &again), INSOLE_OK);
    ck_assert_mem_eq(&fix.spot, &again.spot, sizeof fix.spot);
    ASSERT_NEAR(saved.offset_db, kde.offset_db, 0.0, "dB");
}
END_TEST

/* A scan as a point has it finds the point; the covariance tells how good others fit. */
START_TEST(finds_the_place)
{
    double error_m = 0.0;
    begin(_i);
    config.unheard_dbm = -69; /* just below the weakest that is heard here */
    ck_assert_int_eq(insole_kde_fix_init(&kde, &config), INSOLE_OK);
    for (int round = 0; round < 200; round++) {
        insole_radio_fix_t fix;
        double x_m = prints_uniform(&rng, 5.0, 35.0), y_m = prints_uniform(&rng, 5.0, 35.0);
        uint32_t count = prints_listen(&rng, APS, x_m, y_m, 3.0, 0.0, readings);
        ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
        double xx = (double)fix.var_x_m2, xy = (double)fix.cov_xy_m2, yy = (double)fix.var_y_m2;
        ck_assert(xx > 0.0 && xx * yy - xy * xy > 0.0);
        error_m += miss(&fix, x_m, y_m) / 200.0;
    }
    ASSERT_AT_MOST(error_m, 3.5, "m");
}
END_TEST

/* One point: it is the answer, whatever is heard; its width is the covariance. */
START_TEST(map_of_one_point)
{
    insole_radio_fix_t fix;
    begin(_i);
    prints_begin(&prints);
    prints_point(&prints, 7.0, -3.0);
    for (uint32_t ap = 0; ap < 5u; ap++) {
        prints_entry(&prints, ap, -50.0 - ap, 1.0);
    }
    for (uint32_t ap = 0; ap < 5u; ap++) {
        insole_rss_t reading = {ap, (insole_real_t)(-90.0 + 2.0 * ap), 0};
        readings[ap] = reading;
    }
    ck_assert_int_eq(solve(NULL, 5, &fix), INSOLE_OK);
    ASSERT_AT_MOST(miss(&fix, 7.0, -3.0), 0.0, "m");
    ASSERT_NEAR(fix.var_x_m2, config.point_sigma_m * config.point_sigma_m, 0.0, "m2");
    ASSERT_NEAR(fix.cov_xy_m2, 0.0, 0.0, "m2");
}
END_TEST

/* Points that hear nothing of what the scan hears: nothing in common anywhere. */
START_TEST(nothing_in_common)
{
    insole_radio_fix_t fix;
    begin(_i);
    prints_begin(&prints);
    prints_point(&prints, 0.0, 0.0);
    prints_point(&prints, 10.0, 0.0);
    prints_entry(&prints, 50, -95.0, 1.0);
    for (uint32_t i = 0; i < 3u; i++) {
        insole_rss_t reading = {i, -126, 0};
        readings[i] = reading;
    }
    ck_assert_int_eq(solve(NULL, 3, &fix), INSOLE_OK);
    ASSERT_NEAR(fix.spot.x_m, 5.0, 1e-4, "m");
    ASSERT_NEAR(fix.spot.y_m, 0.0, 0.0, "m");
    ASSERT_NEAR(fix.var_x_m2, config.point_sigma_m * config.point_sigma_m + config.widen * 25, 1e-3,
                "m2");
}
END_TEST

START_TEST(many_access_points)
{
    insole_radio_fix_t fix;
    begin(_i);
    prints_hall(&prints, 500, 0.0, 0.0);
    uint32_t count = prints_listen(&rng, 500, 17.0, 23.0, 2.0, 0.0, readings);
    ck_assert_uint_gt(count, 400u);
    ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
    ck_assert_uint_eq(fix.readings, count);
    ASSERT_AT_MOST(miss(&fix, 17.0, 23.0), 4.0, "m");
}
END_TEST

/* A phone that reads 8 dB too much: found out within a few scans, and the fixes with it. */
START_TEST(offset_is_learned)
{
    double as_is_m = 0.0, learned_m = 0.0, alike_m = 0.0;
    begin(0);
    insole_kde_fix_t deaf = kde, alike = kde;
    config.offset = 1;
    ck_assert_int_eq(insole_kde_fix_init(&kde, &config), INSOLE_OK);
    for (int round = 0; round < 300; round++) {
        insole_radio_fix_t fix;
        double x_m = prints_uniform(&rng, 5.0, 35.0), y_m = prints_uniform(&rng, 5.0, 35.0);
        uint32_t count = prints_listen(&rng, APS, x_m, y_m, 3.0, 0.0, readings);
        ck_assert_int_eq(insole_kde_fix_solve(&alike, &prints.map, NULL, readings, count, &fix),
                         INSOLE_OK);
        alike_m += miss(&fix, x_m, y_m);
        for (uint32_t i = 0; i < count; i++) {
            readings[i].rss_dbm += _i ? -8 : 8;
        }
        ck_assert_int_eq(insole_kde_fix_solve(&deaf, &prints.map, NULL, readings, count, &fix),
                         INSOLE_OK);
        as_is_m += miss(&fix, x_m, y_m);
        ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
        learned_m += miss(&fix, x_m, y_m);
        if (round >= 100) {
            ASSERT_NEAR(kde.offset_db, _i ? -8.0 : 8.0, 2.5, "dB");
        }
    }
    ASSERT_AT_MOST(learned_m, 1.1 * alike_m, "m");
    ASSERT_AT_MOST(learned_m, 0.95 * as_is_m, "m");
    ASSERT_NEAR(deaf.offset_db, 0.0, 0.0, "dB");
}
END_TEST

START_TEST(offset_has_an_end)
{
    begin(0);
    config.offset = 1;
    config.offset_max_db = 3;
    ck_assert_int_eq(insole_kde_fix_init(&kde, &config), INSOLE_OK);
    for (int round = 0; round < 20; round++) {
        insole_radio_fix_t fix;
        uint32_t count = prints_listen(&rng, APS, 20.0, 20.0, 1.0, 12.0, readings);
        ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
        ASSERT_AT_MOST(kde.offset_db, 3.0, "dB");
    }
    ASSERT_NEAR(kde.offset_db, 3.0, 0.0, "dB");
}
END_TEST

/* [PhoneUKF (36)] by sums over a full table. */
START_TEST(normal_reference)
{
    insole_real_t sigma_db;
    begin(1);
    double sum = 0.0, d = prints.map.ap_count, n = PRINTS_POINTS;
    for (uint32_t ap = 0; ap < prints.map.ap_count; ap++) {
        double mean = 0.0, squares = 0.0, value[PRINTS_POINTS];
        for (uint32_t i = 0; i < PRINTS_POINTS; i++) {
            uint32_t entry;
            value[i] = prints_mean(&prints, i, ap, &entry);
            value[i] = isnan(value[i]) ? -90.0 : value[i];
            mean += value[i] / n;
        }
        for (uint32_t i = 0; i < PRINTS_POINTS; i++) {
            squares += (value[i] - mean) * (value[i] - mean);
        }
        sum += squares / n;
    }
    double expected = pow((d + 2.0) * n / 4.0, -1.0 / (d + 4.0)) * sqrt(sum / d);
    ck_assert_int_eq(insole_kde_fix_normal_reference(&prints.map, -90, &sigma_db), INSOLE_OK);
    ASSERT_NEAR(sigma_db, expected, 1e-4 * expected, "dB");
    static const double bad_dbm[] = {-128.0, -49.0, (double)NAN};
    for (int i = 0; i < 3; i++) {
        ck_assert_int_eq(
            insole_kde_fix_normal_reference(&prints.map, (insole_real_t)bad_dbm[i], &sigma_db),
            INSOLE_ERR_VALUE);
    }
    ASSERT_NEAR(sigma_db, expected, 1e-4 * expected, "dB");
    ck_assert_int_eq(insole_kde_fix_normal_reference(NULL, -90, &sigma_db), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_kde_fix_normal_reference(&prints.map, -90, NULL), INSOLE_ERR_NULL);
}
END_TEST

static insole_status_t judge(void)
{
    return insole_kde_fix_init(&kde, &config);
}

START_TEST(settings)
{
    set_defaults(0);
    INSOLE_KDE_FIX_KEYS(SETTING_HAS_ENDS)
    config.width = (insole_real_t)NAN;
    memset(&kde, 0x5a, sizeof kde);
    ASSERT_UNCHANGED(kde, judge(), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_kde_fix_init(NULL, &config), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(kde, insole_kde_fix_init(&kde, NULL), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(refusals)
{
    insole_radio_fix_t fix;
    insole_trusted_area_t nowhere = {{500, 500}, 10}, bad = {{0, 0}, -1};
    begin(0);
    memset(&fix, 0x5a, sizeof fix);
    insole_radio_fix_t untouched = fix;
    uint32_t count = prints_listen(&rng, APS, 20.0, 20.0, 1.0, 0.0, readings);
    ASSERT_UNCHANGED(kde, solve(&bad, count, &fix), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(kde, solve(NULL, 2, &fix), INSOLE_ERR_STATE);
    ASSERT_UNCHANGED(kde, solve(NULL, count, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(solve(&nowhere, count, &fix), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&fix, &untouched, sizeof fix);
    ck_assert_int_eq(solve(NULL, count, &fix), INSOLE_OK);
}
END_TEST

/* In slices through the table the same bits as at once. */
START_TEST(the_table_is_the_calls_it_names)
{
    insole_radio_fix_t direct;
    insole_trusted_area_t near = {{18, 22}, 12};
    begin(_i);
    uint32_t count = prints_listen(&rng, APS, 20.0, 20.0, 3.0, 0.0, readings);
    solver_scan_t scan = {&prints.map, readings, count};
    insole_kde_fix_t state = kde;
    ck_assert_int_eq(solve(&near, count, &direct), INSOLE_OK);
    check_solver_slices(&insole_kde_fix_calls, &state, &scan, &near, &direct);
    check_solver_refusals(&insole_kde_fix_calls, &state, sizeof state, &scan);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("kde_fix");
    suite_add_loop(suite, "direct sums", direct_sums, 2);
    suite_add_loop(suite, "misfit", a_scan_that_fits_badly_says_so, 2);
    suite_add(suite, "ends of misfit", misfits_have_ends);
    suite_add_loop(suite, "clutter", clutter_changes_nothing, 2);
    suite_add_loop(suite, "slices", slices_give_the_same_bits, 5);
    suite_add(suite, "saved and restored", saved_and_restored);
    suite_add_loop(suite, "finds the place", finds_the_place, 2);
    suite_add_loop(suite, "one point", map_of_one_point, 2);
    suite_add_loop(suite, "nothing in common", nothing_in_common, 1);
    suite_add_loop(suite, "many access points", many_access_points, 2);
    suite_add_loop(suite, "offset is learned", offset_is_learned, 2);
    suite_add(suite, "offset has an end", offset_has_an_end);
    suite_add(suite, "normal reference", normal_reference);
    suite_add(suite, "settings", settings);
    suite_add(suite, "refusals", refusals);
    suite_add_loop(suite, "table", the_table_is_the_calls_it_names, 2);
    return suite;
}
