/* SPDX-License-Identifier: MIT */
#include "insole/place/rss_fix.h"

#include "anchors.h"
#include "rtt.h"
#include "setting.h"
#include "suite.h"

static insole_rss_fix_config_t config;
static insole_propagation_config_t propagation;

static void set_defaults(void)
{
    config = insole_rss_fix_defaults;
    propagation = insole_propagation_defaults;
}

static insole_status_t solve_rss(insole_anchor_fix_t *fix)
{
    return insole_rss_fix_solve(&config, &propagation, aps, APS_MAX, readings, count, fix);
}

static insole_status_t solve_centroid(insole_anchor_fix_t *fix)
{
    return insole_rss_fix_centroid(&config, &propagation, aps, APS_MAX, readings, count, fix);
}

START_TEST(true_signals_give_the_true_place)
{
    insole_rng_seed(&rng, 120u + (uint32_t)_i);
    set_defaults();
    config.centroid_sigma_m = 1000;
    config.sigma_db = INSOLE_R(0.1);
    config.gain_sigma_db = _i == 0 ? INSOLE_R(0.001) : 20;
    config.iterations = 30;
    for (int i = 0; i < 100; i++) {
        double x = uniform(3.0, 17.0), y = uniform(2.0, 13.0), gain = _i == 0 ? 0.0 : 4.0;
        insole_anchor_fix_t fix;
        place_random(6);
        listen(x, y, gain, 0.0);
        ck_assert_int_eq(solve_rss(&fix), INSOLE_OK);
        ASSERT_AT_MOST(miss(&fix, x, y), 0.05, "m");
        ASSERT_NEAR(fix.common, gain, 0.1, "dB");
    }
}
END_TEST

/* The sum that a fix should make least, in double precision. */
static double rss_cost(double x, double y, double gain)
{
    double mean_x = 0.0, mean_y = 0.0, weight = 0.0, near = 0.0, cost = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        double rss = (double)readings[i].rss_dbm, n = (double)aps[i].exponent;
        double at_1_m = (double)aps[i].p0_dbm - 5.405;
        double w = pow(10.0, 0.1 * (double)config.centroid_power * rss);
        mean_x += w * (double)aps[i].x_m;
        mean_y += w * (double)aps[i].y_m;
        weight += w;
        near += 1.0 / pow(fmax(1.0, pow(10.0, (at_1_m - rss) / (10.0 * n))), 2.0);
        double r = rss - (at_1_m - 10.0 * n * log10(fmax(0.3, distance(i, x, y))) + gain);
        double k2 = pow((double)config.tail, 2.0);
        cost += 0.5 * k2 * log1p(r * r / (k2 * pow((double)config.sigma_db, 2.0)));
    }
    double dx = x - mean_x / weight, dy = y - mean_y / weight;
    double dg = gain / (double)config.gain_sigma_db;
    double variance = pow((double)config.centroid_sigma_m, 2.0) + 1.0 / (count * near);
    return cost + 0.5 * (dx * dx + dy * dy) / variance + 0.5 * dg * dg;
}

static double nearest_ap(const insole_anchor_fix_t *fix)
{
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < count; i++) {
        least = fmin(least, distance(i, (double)fix->x_m, (double)fix->y_m));
    }
    return least;
}

START_TEST(fix_from_signals_is_where_the_cost_is_least)
{
    int told = 0;
    insole_rng_seed(&rng, 130u);
    set_defaults();
    config.iterations = 100;
    config.tail = 2;
    config.rss_min_dbm = -200;
    for (int i = 0; i < 300; i++) {
        insole_anchor_fix_t fix;
        place_random(2u + insole_rng_bits(&rng) % 6u);
        for (uint32_t k = 0; k < count; k++) {
            aps[k].exponent = (insole_real_t)uniform(1.5, 3.5);
            aps[k].p0_dbm = (insole_real_t)uniform(-45.0, -30.0);
        }
        listen(uniform(3.0, 17.0), uniform(2.0, 13.0), uniform(-3.0, 3.0), 5.0);
        ck_assert_int_eq(solve_rss(&fix), INSOLE_OK);
        if (nearest_ap(&fix) > 0.5) { /* nearer, the model has a blunted peak */
            check_is_least(rss_cost, &fix);
            told++;
        }
    }
    ck_assert_int_gt(told, 200);
}
END_TEST

/* In open space with shadowing, the model is worth more than the mean of the places heard. */
START_TEST(model_beats_the_centroid)
{
    enum { N = 1000 };
    double by_model = 0.0, by_centroid = 0.0;
    insole_rng_seed(&rng, 140u);
    set_defaults();
    config.sigma_db = 5;
    config.centroid_sigma_m = 5;
    for (int i = 0; i < N; i++) {
        double x = uniform(1.0, 19.0), y = uniform(1.0, 14.0);
        insole_anchor_fix_t model, centroid;
        place_random(8);
        listen(x, y, 0.0, 4.0);
        ck_assert_int_eq(solve_rss(&model), INSOLE_OK);
        ck_assert_int_eq(solve_centroid(&centroid), INSOLE_OK);
        by_model += miss(&model, x, y) / N;
        by_centroid += miss(&centroid, x, y) / N;
    }
    ASSERT_AT_MOST(by_model, 0.9 * by_centroid, "m");
    ASSERT_AT_MOST(by_model, 3.0, "m");
}
END_TEST

START_TEST(centroid_by_hand)
{
    insole_anchor_fix_t fix;
    set_defaults();
    config.centroid_sigma_m = 2;
    count = 3;
    place_ap(0, 0.0, 0.0);
    place_ap(1, 11.0, 0.0);
    place_ap(2, 0.0, 5.0);
    const insole_rss_t scan[] = {
        {0, -40, 0}, {1, -60, 0}, {2, -96, 0}, {9, -20, 0}, {1, (double)NAN, 0}};
    ck_assert_int_eq(insole_rss_fix_centroid(&config, &propagation, aps, 3, scan, 5, &fix),
                     INSOLE_OK);
    ck_assert_uint_eq(fix.used, 2u);
    ASSERT_NEAR(fix.x_m, 1.0, 1e-5, "m"); /* weights 1 and 1/10 */
    ASSERT_NEAR(fix.y_m, 0.0, 0.0, "m");
    ASSERT_NEAR(fix.common, 0.0, 0.0, "dB");
    /* heard as from 1 m (nearer counts as that) and from 10^((60 - 38 - 5.405) / 20) m */
    double near = 1.0 + 1.0 / pow(10.0, 0.1 * 16.595);
    ASSERT_NEAR(fix.P.xx, 4.0 + 1.0 / (2.0 * near), 1e-4, "m2");
    ASSERT_NEAR(fix.P.yy, fix.P.xx, 0.0, "m2");
    check_covariance(&fix.P);
}
END_TEST

/* One access point is where it is; how wide around it depends on how strong it is. */
START_TEST(one_access_point)
{
    insole_anchor_fix_t fix, centre;
    set_defaults();
    count = 1;
    place_ap(0, 3.0, 4.0);
    listen(3.0, 12.0, 0.0, 0.0);
    ck_assert_int_eq(solve_rss(&fix), INSOLE_OK);
    ck_assert_int_eq(solve_centroid(&centre), INSOLE_OK);
    ASSERT_AT_MOST(miss(&fix, 3.0, 4.0), 1e-5, "m");
    ASSERT_AT_MOST(miss(&centre, 3.0, 4.0), 1e-5, "m");
    ASSERT_NEAR(insole_sqrt(fix.P.xx), sqrt(9.0 + 64.0), 0.05, "m");
    ASSERT_NEAR(insole_sqrt(centre.P.yy), sqrt(9.0 + 64.0), 0.05, "m");
}
END_TEST

START_TEST(all_on_one_spot)
{
    insole_anchor_fix_t fix;
    set_defaults();
    count = 5;
    for (uint32_t i = 0; i < count; i++) {
        place_ap(i, -7.0, 5.0);
    }
    listen(-7.0, 11.0, 0.0, 2.0);
    ck_assert_int_eq(solve_rss(&fix), INSOLE_OK);
    ASSERT_AT_MOST(miss(&fix, -7.0, 5.0), 1e-4, "m");
    check_covariance(&fix.P);
}
END_TEST

START_TEST(gates_leave_out)
{
    insole_anchor_fix_t clean, gated;
    set_defaults();
    insole_rng_seed(&rng, 145u);
    place_random(4);
    listen(7.0, 9.0, 1.0, 2.0);
    ck_assert_int_eq(solve_rss(&clean), INSOLE_OK);
    const insole_rss_t bad[] = {{4, (double)NAN, 0},       {5, (double)INFINITY, 0},
                                {6, -(double)INFINITY, 0}, {7, -96, 0},
                                {APS_MAX, -50, 0},         {UINT32_MAX, -50, 0}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        insole_rss_t mixed[5];
        memcpy(mixed, readings, sizeof(insole_rss_t) * 4);
        mixed[4] = mixed[1];
        mixed[1] = bad[i];
        ck_assert_int_eq(
            insole_rss_fix_solve(&config, &propagation, aps, APS_MAX, mixed, 5, &gated), INSOLE_OK);
        ck_assert_uint_eq(gated.used, 4u);
        ASSERT_AT_MOST(miss(&gated, (double)clean.x_m, (double)clean.y_m), 2e-3, "m");
        ck_assert_int_eq(
            insole_rss_fix_solve(&config, &propagation, aps, APS_MAX, &bad[i], 1, &gated),
            INSOLE_ERR_STATE);
    }
}
END_TEST

START_TEST(turned_and_shifted_alike)
{
    const frame_t *f = &frames[_i];
    insole_anchor_fix_t fix, moved;
    set_defaults();
    config.iterations = 100;
    insole_rng_seed(&rng, 80u);
    for (int i = 0; i < 100; i++) {
        place_random(5);
        listen(uniform(3.0, 17.0), uniform(2.0, 13.0), 1.0, 3.0);
        ck_assert_int_eq(solve_rss(&fix), INSOLE_OK);
        move_aps(f);
        ck_assert_int_eq(solve_rss(&moved), INSOLE_OK);
        check_moved(f, &fix, &moved);
    }
}
END_TEST

START_TEST(whatever_comes_in)
{
    insole_rng_seed(&rng, 150u);
    for (int i = 0; i < 20000; i++) {
        insole_anchor_fix_t fix;
        set_defaults();
        (void)place_wildly();
        for (uint32_t k = 0; k < count; k++) {
            insole_rss_t rss = {k, (insole_real_t)uniform(-100.0, 10.0), 0};
            readings[k] = rss;
        }
        config.sigma_db = (insole_real_t)pow(10.0, uniform(-1.0, 1.5));
        config.gain_sigma_db = (insole_real_t)pow(10.0, uniform(-3.0, 2.0));
        insole_status_t status = solve_rss(&fix);
        ck_assert(status == INSOLE_OK || status == INSOLE_ERR_STATE);
        ck_assert_int_eq(solve_centroid(&fix), status);
        if (status == INSOLE_OK) {
            check_covariance(&fix.P);
            ck_assert_int_eq(solve_rss(&fix), INSOLE_OK);
            ck_assert(insole_is_finite(fix.x_m) && insole_is_finite(fix.y_m));
            check_covariance(&fix.P);
        }
    }
}
END_TEST

/* A receiver that reads all too strong finds itself in the same place, and finds out. */
START_TEST(gain_is_told_apart)
{
    insole_rng_seed(&rng, 170u);
    set_defaults();
    config.gain_sigma_db = 50;
    config.iterations = 50;
    for (int i = 0; i < 100; i++) {
        insole_anchor_fix_t fix, louder;
        place_random(6);
        listen(uniform(3.0, 17.0), uniform(2.0, 13.0), 0.0, 3.0);
        ck_assert_int_eq(solve_rss(&fix), INSOLE_OK);
        for (uint32_t k = 0; k < count; k++) {
            readings[k].rss_dbm += 2;
        }
        ck_assert_int_eq(solve_rss(&louder), INSOLE_OK);
        ASSERT_AT_MOST(miss(&louder, (double)fix.x_m, (double)fix.y_m), 0.25, "m");
        ASSERT_NEAR(louder.common - fix.common, 2.0, 0.25, "dB");
    }
}
END_TEST

/* The stronger an access point is heard, the nearer to it the fix. */
START_TEST(stronger_is_nearer)
{
    insole_rng_seed(&rng, 180u);
    set_defaults();
    place_random(5);
    listen(10.0, 7.5, 0.0, 0.0);
    double before = HUGE_VAL, centre_before = HUGE_VAL;
    for (int i = 0; i < 8; i++) {
        insole_anchor_fix_t fix, centre;
        ck_assert_int_eq(solve_rss(&fix), INSOLE_OK);
        ck_assert_int_eq(solve_centroid(&centre), INSOLE_OK);
        double to_ap = distance(2, (double)fix.x_m, (double)fix.y_m);
        double centre_to_ap = distance(2, (double)centre.x_m, (double)centre.y_m);
        ASSERT_AT_MOST(to_ap, before - 0.01, "m");
        ASSERT_AT_MOST(centre_to_ap, centre_before - 0.01, "m");
        before = to_ap;
        centre_before = centre_to_ap;
        readings[2].rss_dbm += 2;
    }
}
END_TEST

/* ---- recordings ---- */

static rtt_scene_t scene;

/* Signal strengths alone, in two buildings whose walls and access points nobody has calibrated. */
START_TEST(recorded_signal_strengths)
{
    static const double limits_m[2] = {3.0, 3.7};
    double by_model = 0.0, by_centroid = 0.0;
    uint32_t n = 0;
    set_defaults();
    if (!rtt_load(&scene, _i)) {
        return;
    }
    for (uint32_t i = 0; i < scene.count; i++) {
        const rtt_epoch_t *e = &scene.epochs[i];
        insole_anchor_fix_t model, centroid;
        if (e->rss_count >= 3u &&
            insole_rss_fix_solve(&config, &propagation, scene.aps, RTT_APS, e->readings,
                                 e->rss_count, &model) == INSOLE_OK &&
            insole_rss_fix_centroid(&config, &propagation, scene.aps, RTT_APS, e->readings,
                                    e->rss_count, &centroid) == INSOLE_OK) {
            by_model += miss(&model, e->x_m, e->y_m);
            by_centroid += miss(&centroid, e->x_m, e->y_m);
            n++;
        }
    }
    ck_assert_uint_gt(n, 9000u);
    ASSERT_AT_MOST(by_model / n, limits_m[_i], "m");
    ASSERT_AT_MOST(by_model, 0.98 * by_centroid, "m");
}
END_TEST

/* ---- bad input ---- */

static insole_status_t judge(void)
{
    return insole_rss_fix_check(&config);
}

START_TEST(settings_out_of_range)
{
    ck_assert_int_eq(insole_rss_fix_check(NULL), INSOLE_ERR_NULL);
    set_defaults();
    INSOLE_RSS_FIX_KEYS(SETTING_HAS_ENDS)
}
END_TEST

START_TEST(null_pointers)
{
    insole_anchor_fix_t fix;
    const insole_rss_fix_config_t *c = &config;
    const insole_propagation_config_t *p = &propagation;
    set_defaults();
    ck_assert_int_eq(insole_rss_fix_solve(NULL, p, aps, 1, readings, 1, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_fix_solve(c, NULL, aps, 1, readings, 1, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_fix_solve(c, p, NULL, 1, readings, 1, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_fix_solve(c, p, aps, 1, NULL, 1, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_fix_solve(c, p, aps, 1, readings, 1, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_fix_centroid(NULL, p, aps, 1, readings, 1, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_fix_centroid(c, NULL, aps, 1, readings, 1, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_fix_centroid(c, p, NULL, 1, readings, 1, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_fix_centroid(c, p, aps, 1, NULL, 1, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_fix_centroid(c, p, aps, 1, readings, 1, NULL), INSOLE_ERR_NULL);
}
END_TEST

/* A refusal leaves the fix as it was. */
START_TEST(values_without_sense)
{
    static const insole_real_t bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    insole_anchor_fix_t fix, untouched;
    memset(&fix, 0x5a, sizeof fix);
    untouched = fix;
    set_defaults();
    insole_rng_seed(&rng, 160u);
    place_random(4);
    listen(7.0, 9.0, 1.0, 0.1);
    const insole_ap_t good = aps[1];
    for (int i = 0; i < 16; i++) {
        aps[1] = good;
        insole_real_t *fields[] = {&aps[1].x_m, &aps[1].y_m, &aps[1].z_m, &aps[1].p0_dbm,
                                   &aps[1].exponent};
        *fields[i < 15 ? i % 5 : 4] = i < 15 ? bad[i / 5] : 0;
        ck_assert_int_eq(solve_rss(&fix), INSOLE_ERR_VALUE);
        ck_assert_int_eq(solve_centroid(&fix), INSOLE_ERR_VALUE);
    }
    count = 0;
    ck_assert_int_eq(solve_rss(&fix), INSOLE_ERR_STATE);
    ck_assert_int_eq(solve_centroid(&fix), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&fix, &untouched, sizeof fix);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("rss_fix");
    suite_add_loop(suite, "true signals, true place", true_signals_give_the_true_place, 2);
    suite_add(suite, "least cost", fix_from_signals_is_where_the_cost_is_least);
    suite_add(suite, "model beats the centroid", model_beats_the_centroid);
    suite_add(suite, "centroid by hand", centroid_by_hand);
    suite_add(suite, "one access point", one_access_point);
    suite_add(suite, "all on one spot", all_on_one_spot);
    suite_add(suite, "gates", gates_leave_out);
    suite_add_loop(suite, "turned and shifted", turned_and_shifted_alike, 3);
    suite_add(suite, "whatever comes in", whatever_comes_in);
    suite_add(suite, "gain is told apart", gain_is_told_apart);
    suite_add(suite, "stronger is nearer", stronger_is_nearer);
    suite_add_loop(suite, "recorded signal strengths", recorded_signal_strengths, 2);
    suite_add(suite, "settings out of range", settings_out_of_range);
    suite_add(suite, "null pointers", null_pointers);
    suite_add(suite, "values without sense", values_without_sense);
    return suite;
}
