/* SPDX-License-Identifier: MIT */
#include "insole/place/range_fix.h"

#include "anchors.h"
#include "rtt.h"
#include "setting.h"
#include "suite.h"

static insole_range_fix_config_t config;

/* Squares, no common part, and ranges so sharp that nothing else counts. */
static void set_sharp(void)
{
    config = insole_range_fix_defaults;
    config.sigma_m = INSOLE_R(0.02);
    config.bias_m = 0;
    config.bias_sigma_m = INSOLE_R(0.001);
    config.tail_long = config.tail_short = 1000;
}

static void set_defaults(void)
{
    config = insole_range_fix_defaults;
}

static insole_status_t solve_ranges(const insole_anchor_fix_t *before, insole_anchor_fix_t *fix)
{
    return insole_range_fix_solve(&config, aps, APS_MAX, ranges, count, before, fix);
}

START_TEST(true_ranges_give_the_true_place)
{
    insole_rng_seed(&rng, 10u + (uint32_t)_i);
    set_sharp();
    for (int i = 0; i < 200; i++) {
        double x = uniform(3.0, 17.0), y = uniform(2.0, 13.0);
        insole_anchor_fix_t fix;
        place_random(3u + (uint32_t)_i);
        measure(x, y, 0.0, 0.0);
        ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
        ck_assert_uint_eq(fix.used, count);
        ASSERT_AT_MOST(miss(&fix, x, y), 0.02, "m");
        check_covariance(&fix.P);
    }
}
END_TEST

/* Noise as it was told: no bias, and the covariance says how far off the fixes are. */
START_TEST(covariance_is_honest)
{
    enum { N = 4000 };
    double nees = 0.0, sum_x = 0.0, sum_y = 0.0;
    insole_rng_seed(&rng, 20u);
    set_sharp();
    config.sigma_m = INSOLE_R(0.3);
    place_random(5);
    for (int i = 0; i < N; i++) {
        insole_anchor_fix_t fix;
        measure(8.0, 6.0, 0.0, 0.3);
        ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
        double dx = (double)fix.x_m - 8.0, dy = (double)fix.y_m - 6.0;
        double a = (double)fix.P.xx, b = (double)fix.P.xy, c = (double)fix.P.yy;
        nees += 0.5 * (c * dx * dx - 2.0 * b * dx * dy + a * dy * dy) / (a * c - b * b) / N;
        sum_x += dx / N;
        sum_y += dy / N;
    }
    ASSERT_NEAR(nees, 1.0, 0.06, "");
    ASSERT_NEAR(sum_x, 0.0, 0.02, "m");
    ASSERT_NEAR(sum_y, 0.0, 0.02, "m");
}
END_TEST

/* The sum that a fix from ranges should make least, in double precision. */
static double range_cost(double x, double y, double bias)
{
    double mean_x = 0.0, mean_y = 0.0, weight = 0.0, cost = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        double w = 1.0 / pow(fmax(1.0, (double)ranges[i].range_m), 2.0);
        mean_x += w * (double)aps[i].x_m;
        mean_y += w * (double)aps[i].y_m;
        weight += w;
        double r = (double)ranges[i].range_m - bias - sqrt(pow(distance(i, x, y), 2.0) + 0.04);
        double s2 = pow((double)config.sigma_m, 2.0) + pow((double)ranges[i].sigma_m, 2.0);
        double k2 = pow((double)(r > 0.0 ? config.tail_long : config.tail_short), 2.0);
        cost += 0.5 * k2 * log1p(r * r / (k2 * s2));
    }
    double dx = x - mean_x / weight, dy = y - mean_y / weight;
    double db = (bias - (double)config.bias_m) / (double)config.bias_sigma_m;
    return cost + 0.5 * (dx * dx + dy * dy) * weight / count + 0.5 * db * db;
}

START_TEST(fix_from_ranges_is_where_the_cost_is_least)
{
    insole_rng_seed(&rng, 30u);
    set_defaults();
    config.iterations = 100;
    for (int i = 0; i < 300; i++) {
        insole_anchor_fix_t fix;
        place_random(2u + insole_rng_bits(&rng) % 6u);
        measure(uniform(3.0, 17.0), uniform(2.0, 13.0), uniform(0.0, 3.0), 0.7);
        ranges[0].range_m += (insole_real_t)uniform(0.0, 8.0);
        ranges[1].sigma_m = (insole_real_t)uniform(-1.0, 3.0);
        ranges[1].sigma_m = insole_max(ranges[1].sigma_m, 0);
        ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
        check_is_least(range_cost, &fix);
    }
}
END_TEST

START_TEST(one_range_far_too_long)
{
    double robust = 0.0, squares = 0.0;
    insole_rng_seed(&rng, 40u);
    for (int i = 0; i < 200; i++) {
        double x = uniform(5.0, 15.0), y = uniform(4.0, 11.0);
        insole_anchor_fix_t fix;
        place_random(6);
        set_defaults();
        measure(x, y, (double)config.bias_m, 0.1);
        ranges[i % 6].range_m += 10;
        ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
        robust = fmax(robust, miss(&fix, x, y));
        config.tail_long = config.tail_short = 1000;
        ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
        squares += miss(&fix, x, y) / 200.0;
    }
    ASSERT_AT_MOST(robust, 1.0, "m");
    ASSERT_AT_LEAST(squares, 2.0, "m");
}
END_TEST

START_TEST(what_ranges_have_in_common_is_found)
{
    insole_anchor_fix_t fix;
    insole_rng_seed(&rng, 50u);
    set_sharp();
    config.bias_sigma_m = 5;
    place_random(6);
    measure(7.0, 9.0, 2.5, 0.0);
    ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
    ASSERT_NEAR(fix.common, 2.5, 0.02, "m");
    ASSERT_AT_MOST(miss(&fix, 7.0, 9.0), 0.03, "m");
}
END_TEST

START_TEST(heights_shorten_the_way_along_the_floor)
{
    insole_anchor_fix_t fix;
    insole_rng_seed(&rng, 60u);
    set_sharp();
    config.height_m = 1;
    place_random(4);
    measure(7.0, 9.0, 0.0, 0.0);
    for (uint32_t i = 0; i < count; i++) {
        aps[i].z_m = 4;
        ranges[i].range_m = insole_sqrt(insole_square(ranges[i].range_m) + 9);
    }
    ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
    ASSERT_AT_MOST(miss(&fix, 7.0, 9.0), 0.02, "m");
}
END_TEST

START_TEST(one_anchor)
{
    insole_anchor_fix_t fix;
    set_defaults();
    count = 1;
    place_ap(0, 3.0, 4.0);
    measure(3.0, 9.0, 0.0, 0.0);
    ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
    ASSERT_NEAR(fix.x_m, 3.0, 1e-5, "m");
    ASSERT_NEAR(fix.y_m, 4.0, 1e-5, "m");
    ASSERT_NEAR(insole_sqrt(fix.P.xx), 5.0, 0.01, "m");
    ASSERT_NEAR(insole_sqrt(fix.P.yy), 5.0, 0.01, "m");
}
END_TEST

/* Two anchors, or more on a line, cannot tell the two sides of it. */
START_TEST(collinear_anchors)
{
    insole_anchor_fix_t fix;
    set_defaults();
    config.bias_m = 0;
    count = 2u + (uint32_t)_i;
    for (uint32_t i = 0; i < count; i++) {
        place_ap(i, 10.0 * i / (count - 1.0), 2.0);
    }
    measure(4.0, 6.0, 0.0, 0.0);
    ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
    ASSERT_NEAR(fix.x_m, 4.0, 1.5, "m");
    ASSERT_NEAR(fix.y_m, 2.0, 1e-4, "m");
    ASSERT_AT_LEAST(insole_sqrt(fix.P.yy), 3.0, "m"); /* 4 m off, and says so */
    ASSERT_AT_MOST(insole_sqrt(fix.P.xx), 2.0, "m");
    check_covariance(&fix.P);
}
END_TEST

START_TEST(all_anchors_on_one_spot)
{
    insole_anchor_fix_t fix;
    set_defaults();
    count = 5;
    for (uint32_t i = 0; i < count; i++) {
        place_ap(i, -7.0, 5.0);
    }
    measure(-7.0, 5.0, 0.0, 0.0);
    ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
    ASSERT_AT_MOST(miss(&fix, -7.0, 5.0), 1e-4, "m");
    measure(-7.0, 11.0, 0.0, 0.0);
    ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
    ASSERT_AT_MOST(miss(&fix, -7.0, 5.0), 1e-4, "m");
    ASSERT_AT_LEAST(insole_sqrt(fix.P.xx), 5.0, "m");
    check_covariance(&fix.P);
}
END_TEST

START_TEST(gates_leave_out)
{
    insole_anchor_fix_t clean, gated;
    set_defaults();
    insole_rng_seed(&rng, 70u);
    place_random(4);
    measure(7.0, 9.0, 1.0, 0.3);
    ck_assert_int_eq(solve_ranges(NULL, &clean), INSOLE_OK);
    const insole_range_t bad[] = {{0, 4, (double)NAN, 0}, {0, 5, (double)INFINITY, 0},
                                  {0, 6, -1, 0},          {0, 7, 101, 0},
                                  {0, 0, 5, 11},          {0, 1, 5, (double)INFINITY},
                                  {0, APS_MAX, 5, 0},     {0, UINT32_MAX, 5, 0}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        insole_range_t mixed[5];
        memcpy(mixed, ranges, sizeof(insole_range_t) * 4);
        mixed[4] = mixed[1];
        mixed[1] = bad[i];
        ck_assert_int_eq(insole_range_fix_solve(&config, aps, APS_MAX, mixed, 5, NULL, &gated),
                         INSOLE_OK);
        ck_assert_uint_eq(gated.used, 4u);
        ASSERT_AT_MOST(miss(&gated, (double)clean.x_m, (double)clean.y_m), 2e-3, "m");
        ck_assert_int_eq(insole_range_fix_solve(&config, aps, APS_MAX, &bad[i], 1, NULL, &gated),
                         INSOLE_ERR_STATE);
    }
    ranges[2].sigma_m = (double)NAN; /* as if not told */
    ck_assert_int_eq(solve_ranges(NULL, &gated), INSOLE_OK);
    ASSERT_NEAR(miss(&gated, (double)clean.x_m, (double)clean.y_m), 0.0, 0.0, "m");
}
END_TEST

START_TEST(turned_and_shifted_alike)
{
    const frame_t *f = &frames[_i];
    insole_anchor_fix_t fix, moved;
    set_defaults();
    config.iterations = 60;
    insole_rng_seed(&rng, 80u);
    for (int i = 0; i < 100; i++) {
        double x = uniform(3.0, 17.0), y = uniform(2.0, 13.0);
        place_random(5);
        measure(x, y, 1.5, 0.5);
        ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
        move_aps(f);
        ck_assert_int_eq(solve_ranges(NULL, &moved), INSOLE_OK);
        check_moved(f, &fix, &moved);
    }
}
END_TEST

/* ---- memory ---- */

/* Someone walks around the hall; of the anchors some epochs have all, others one. */
START_TEST(memory_bridges_poor_epochs)
{
    double with = 0.0, without = 0.0;
    int n = 0;
    insole_anchor_fix_t fix, alone;
    insole_rng_seed(&rng, 90u);
    set_defaults();
    for (int i = 0; i < 600; i++) {
        double x = 10.0 + 6.0 * cos(0.04 * i), y = 7.5 + 5.0 * sin(0.04 * i); /* 1.1 m/s at 5 Hz */
        insole_rng_t kept = rng;
        insole_rng_seed(&rng, 90u);
        place_random(6);
        rng = kept;
        measure(x, y, 1.5, 0.8);
        count = i % 10 < 5 ? 6u : 1u + (uint32_t)(i % 2);
        ck_assert_int_eq(solve_ranges(NULL, &alone), INSOLE_OK);
        if (i > 0) {
            ck_assert_int_eq(insole_range_fix_age(&config, &fix, INSOLE_R(0.2)), INSOLE_OK);
        }
        ck_assert_int_eq(solve_ranges(i > 0 ? &fix : NULL, &fix), INSOLE_OK);
        check_covariance(&fix.P);
        with += miss(&fix, x, y);
        without += miss(&alone, x, y);
        n++;
    }
    ASSERT_AT_MOST(with / n, 0.9, "m");
    ASSERT_AT_LEAST(without / n, 2.0, "m");
}
END_TEST

/* A day in one place, then a leap: neither stuck nor lost. */
START_TEST(memory_neither_stalls_nor_drowns)
{
    insole_anchor_fix_t fix;
    insole_rng_seed(&rng, 100u);
    set_defaults();
    place_random(5);
    measure(7.0, 9.0, 1.5, 0.5);
    ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
    for (int i = 0; i < 86400; i++) {
        ck_assert_int_eq(insole_range_fix_age(&config, &fix, 1), INSOLE_OK);
        if (i % 8 == 0) {
            measure(7.0, 9.0, 1.5, 0.5);
        }
        ck_assert_int_eq(solve_ranges(&fix, &fix), INSOLE_OK);
    }
    ASSERT_AT_MOST(miss(&fix, 7.0, 9.0), 1.5, "m");
    ASSERT_AT_LEAST(insole_sqrt(fix.P.xx), 0.2, "m");
    for (int i = 0; i < 40; i++) {
        ck_assert_int_eq(insole_range_fix_age(&config, &fix, 1), INSOLE_OK);
        measure(15.0, 5.0, 1.5, 0.5);
        ck_assert_int_eq(solve_ranges(&fix, &fix), INSOLE_OK);
    }
    ASSERT_AT_MOST(miss(&fix, 15.0, 5.0), 1.5, "m");
}
END_TEST

START_TEST(ageing)
{
    insole_anchor_fix_t fix = {1, 2, 3, {1, INSOLE_R(0.5), 0, 2, 0, INSOLE_R(0.25)}, 4};
    set_defaults();
    ck_assert_int_eq(insole_range_fix_age(&config, &fix, INSOLE_R(0.5)), INSOLE_OK);
    ASSERT_NEAR(fix.P.xx, 1.0 + 0.5 * 1.69 * 0.5, 1e-6, "m2"); /* under a second: in proportion */
    ASSERT_NEAR(fix.P.yy, 2.0 + 0.5 * 1.69 * 0.5, 1e-6, "m2");
    ASSERT_NEAR(fix.P.zz, 0.25 + 0.01 * 0.5, 1e-6, "m2");
    ck_assert_int_eq(insole_range_fix_age(&config, &fix, 10), INSOLE_OK);
    ASSERT_NEAR(fix.P.xx, 1.4225 + 0.5 * 169.0, 1e-4, "m2"); /* then by the way that can be gone */
    ASSERT_NEAR(fix.P.xy, 0.5, 0.0, "m2");
    ASSERT_NEAR(fix.x_m + fix.y_m + fix.common, 6.0, 0.0, "m");
    for (int i = 0; i < 100; i++) {
        ck_assert_int_eq(insole_range_fix_age(&config, &fix, INSOLE_R(1e30)), INSOLE_OK);
        check_covariance(&fix.P);
    }
    insole_rng_seed(&rng, 110u);
    place_random(4); /* after any time the fix is as good as none, and does not stand in the way */
    measure(7.0, 9.0, 1.75, 0.0);
    ck_assert_int_eq(solve_ranges(&fix, &fix), INSOLE_OK);
    ASSERT_AT_MOST(miss(&fix, 7.0, 9.0), 0.3, "m");
}
END_TEST

START_TEST(whatever_comes_in)
{
    insole_rng_seed(&rng, 150u);
    for (int i = 0; i < 20000; i++) {
        insole_anchor_fix_t fix;
        set_defaults();
        double wide = place_wildly();
        for (uint32_t k = 0; k < count; k++) {
            insole_range_t range = {0, k, (insole_real_t)(wide * uniform(0.0, 2.0)),
                                    (insole_real_t)uniform(-1.0, 5.0)};
            ranges[k] = range;
        }
        config.sigma_m = (insole_real_t)pow(10.0, uniform(-2.0, 2.0));
        config.bias_sigma_m = (insole_real_t)pow(10.0, uniform(-3.0, 2.0));
        insole_status_t status = solve_ranges(NULL, &fix);
        ck_assert(status == INSOLE_OK || status == INSOLE_ERR_STATE);
        if (status == INSOLE_OK) {
            ck_assert(insole_is_finite(fix.x_m) && insole_is_finite(fix.y_m) &&
                      insole_is_finite(fix.common));
            check_covariance(&fix.P);
        }
    }
}
END_TEST

/* ---- symmetry ---- */

START_TEST(order_does_not_matter)
{
    insole_rng_seed(&rng, 170u);
    set_defaults();
    for (int i = 0; i < 200; i++) {
        insole_anchor_fix_t fix, turned;
        place_random(6);
        measure(uniform(3.0, 17.0), uniform(2.0, 13.0), 1.5, 1.0);
        ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
        for (uint32_t k = 0; k < 3; k++) {
            insole_range_t range = ranges[k];
            ranges[k] = ranges[5u - k];
            ranges[5u - k] = range;
        }
        ck_assert_int_eq(solve_ranges(NULL, &turned), INSOLE_OK);
        ASSERT_AT_MOST(miss(&turned, (double)fix.x_m, (double)fix.y_m), 3e-3, "m");
        ASSERT_NEAR(turned.P.xx, fix.P.xx, 5e-3 * (double)fix.P.xx, "m2");
    }
}
END_TEST

/* What comes in two parts, with memory of the first, tells as much as what comes at once. */
START_TEST(in_parts_or_at_once)
{
    insole_rng_seed(&rng, 180u);
    set_sharp();
    for (int i = 0; i < 200; i++) {
        insole_anchor_fix_t once, parts;
        place_random(8);
        measure(uniform(5.0, 15.0), uniform(4.0, 11.0), 0.0, 0.02);
        ck_assert_int_eq(solve_ranges(NULL, &once), INSOLE_OK);
        ck_assert_int_eq(insole_range_fix_solve(&config, aps, APS_MAX, ranges, 4, NULL, &parts),
                         INSOLE_OK);
        ck_assert_int_eq(
            insole_range_fix_solve(&config, aps, APS_MAX, ranges + 4, 4, &parts, &parts),
            INSOLE_OK);
        ASSERT_AT_MOST(miss(&parts, (double)once.x_m, (double)once.y_m), 2e-3, "m");
        ASSERT_NEAR(parts.P.xx, once.P.xx, 0.05 * (double)once.P.xx, "m2");
        ASSERT_NEAR(parts.P.yy, once.P.yy, 0.05 * (double)once.P.yy, "m2");
    }
}
END_TEST

/* More of the same makes surer, never less sure. */
START_TEST(more_ranges_make_surer)
{
    insole_rng_seed(&rng, 190u);
    set_sharp();
    place_random(8);
    measure(9.0, 8.0, 0.0, 0.0);
    insole_anchor_fix_t fix;
    double before = HUGE_VAL;
    for (count = 1; count <= APS_MAX; count++) {
        ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_OK);
        double trace = (double)fix.P.xx + (double)fix.P.yy;
        ASSERT_AT_MOST(trace, before * 1.001, "m2");
        before = trace;
    }
}
END_TEST

/* ---- recordings ---- */

static rtt_scene_t scene;

/* Solves an epoch; a fix whose ranges all fail the gates stays what it was. */
static bool solve_epoch(const rtt_epoch_t *e, bool recalls, double dt_s, insole_anchor_fix_t *fix)
{
    if (recalls) {
        ck_assert_int_eq(insole_range_fix_age(&config, fix, (insole_real_t)dt_s), INSOLE_OK);
    }
    insole_status_t status = insole_range_fix_solve(&config, scene.aps, RTT_APS, e->ranges,
                                                    e->range_count, recalls ? fix : NULL, fix);
    ck_assert(status == INSOLE_OK || status == INSOLE_ERR_STATE);
    return recalls || status == INSOLE_OK;
}

/* Mean error over the epochs of at least `least` ranges. */
static double mean_error(bool with_memory, uint32_t least)
{
    insole_anchor_fix_t fix;
    double sum = 0.0;
    uint32_t n = 0;
    bool has_fix = false;
    for (uint32_t i = 0; i < scene.count; i++) {
        const rtt_epoch_t *e = &scene.epochs[i];
        bool recalls = with_memory && has_fix && !e->begins;
        has_fix = solve_epoch(e, recalls, recalls ? e->t_s - e[-1].t_s : 0.0, &fix);
        if (has_fix && e->range_count >= least) {
            sum += miss(&fix, e->x_m, e->y_m);
            n++;
        }
    }
    ck_assert_uint_gt(n, 9000u);
    return sum / n;
}

/* One set of settings in two buildings, whatever each of them does to radio. */
START_TEST(recorded_round_trip_times)
{
    static const double limits_m[2][2] = {{1.0, 0.85}, {0.9, 0.75}};
    set_defaults();
    if (rtt_load(&scene, _i)) {
        ASSERT_AT_MOST(mean_error(false, 3), limits_m[_i][0], "m");
        ASSERT_AT_MOST(mean_error(true, 1), limits_m[_i][1], "m");
        config.bias_m = 0; /* nothing known of the radio's delay: found on the way */
        config.bias_sigma_m = 3;
        ASSERT_AT_MOST(mean_error(true, 1), 1.35, "m");
    }
}
END_TEST

/* ---- bad input ---- */

static insole_status_t judge(void)
{
    return insole_range_fix_check(&config);
}

START_TEST(settings_out_of_range)
{
    ck_assert_int_eq(insole_range_fix_check(NULL), INSOLE_ERR_NULL);
    set_defaults();
    INSOLE_RANGE_FIX_KEYS(SETTING_HAS_ENDS)
}
END_TEST

START_TEST(null_pointers)
{
    insole_anchor_fix_t fix;
    const insole_range_fix_config_t *c = &config;
    set_defaults();
    ck_assert_int_eq(insole_range_fix_solve(NULL, aps, 1, ranges, 1, NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_range_fix_solve(c, NULL, 1, ranges, 1, NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_range_fix_solve(c, aps, 1, NULL, 1, NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_range_fix_solve(c, aps, 1, ranges, 1, NULL, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_range_fix_age(NULL, &fix, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_range_fix_age(c, NULL, 1), INSOLE_ERR_NULL);
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
    measure(7.0, 9.0, 1.0, 0.1);
    const insole_ap_t good = aps[1];
    for (int i = 0; i < 9; i++) {
        aps[1] = good;
        *(i % 3 == 0 ? &aps[1].x_m : i % 3 == 1 ? &aps[1].y_m : &aps[1].z_m) = bad[i / 3];
        ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_ERR_VALUE);
    }
    aps[1] = good;
    aps[1].p0_dbm = (double)NAN; /* of no use here */
    insole_anchor_fix_t before[4];
    ck_assert_int_eq(solve_ranges(NULL, &before[0]), INSOLE_OK);
    before[1] = before[2] = before[3] = before[0];
    before[0].x_m = (double)NAN;
    before[1].common = (double)INFINITY;
    before[2].P.xx = -1;
    before[3].P.xy = (double)NAN;
    for (int i = 0; i < 4; i++) {
        ck_assert_int_eq(solve_ranges(&before[i], &fix), INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_range_fix_age(&config, &fix, -1), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_range_fix_age(&config, &fix, (double)NAN), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_range_fix_age(&config, &fix, (double)INFINITY), INSOLE_ERR_VALUE);
    count = 0;
    ck_assert_int_eq(solve_ranges(NULL, &fix), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&fix, &untouched, sizeof fix);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("range_fix");
    suite_add_loop(suite, "true ranges, true place", true_ranges_give_the_true_place, 6);
    suite_add(suite, "covariance is honest", covariance_is_honest);
    suite_add(suite, "least cost from ranges", fix_from_ranges_is_where_the_cost_is_least);
    suite_add(suite, "one range far too long", one_range_far_too_long);
    suite_add(suite, "common part of ranges", what_ranges_have_in_common_is_found);
    suite_add(suite, "heights", heights_shorten_the_way_along_the_floor);
    suite_add(suite, "one anchor", one_anchor);
    suite_add_loop(suite, "collinear anchors", collinear_anchors, APS_MAX - 1);
    suite_add(suite, "all anchors on one spot", all_anchors_on_one_spot);
    suite_add(suite, "gates", gates_leave_out);
    suite_add_loop(suite, "turned and shifted", turned_and_shifted_alike, 3);
    suite_add(suite, "memory bridges poor epochs", memory_bridges_poor_epochs);
    suite_add(suite, "memory for a day", memory_neither_stalls_nor_drowns);
    suite_add(suite, "ageing", ageing);
    suite_add(suite, "whatever comes in", whatever_comes_in);
    suite_add(suite, "order does not matter", order_does_not_matter);
    suite_add(suite, "in parts or at once", in_parts_or_at_once);
    suite_add(suite, "more ranges make surer", more_ranges_make_surer);
    suite_add_loop(suite, "recorded round-trip times", recorded_round_trip_times, 2);
    suite_add(suite, "settings out of range", settings_out_of_range);
    suite_add(suite, "null pointers", null_pointers);
    suite_add(suite, "values without sense", values_without_sense);
    return suite;
}
