/* SPDX-License-Identifier: MIT
 * What a stance's measurements speak for, across gaps, and that none is lost for the covariance
 * that waits. */
#include "foot_filter.h"
#include "shoe.h"
#include "suite.h"

/* A walk whose third stance lasts from 5.1 to 6.0 s. */
static walk_t slow_walk(void)
{
    walk_t walk = WALK;
    walk.strides = 6;
    walk.stance_s = 0.9;
    return walk;
}

static const struct {
    double from_s, to_s; /* without samples */
    uint32_t bridged, coasts;
} gaps[] = {{0.0, 0.0, 0u, 0u},   {5.3, 5.41, 1u, 0u},  {5.35, 5.46, 1u, 0u}, {5.4, 5.51, 1u, 0u},
            {5.45, 5.56, 1u, 0u}, {5.35, 5.7, 0u, 1u},  {6.2, 6.35, 1u, 0u},  {6.2, 6.75, 0u, 1u},
            {6.1, 7.4, 0u, 1u},   {5.43, 5.44, 0u, 0u}, {5.7, 6.3, 0u, 1u}};
static const double every_s[] = {0.0, 0.02, 0.2};
static const double rates_hz[] = {20.0, 50.0, 100.0, 200.0};

enum { GAPS = 11, EVERY = 3, RATES = 4 };

/* ---- what it speaks for ----------------------------------------------------------------- */

/* A tracker and what is expected of its measurements. */
typedef struct {
    insole_foot_counts_t before;
    uint64_t last_us;  /* sample */
    uint64_t known_us; /* since when nothing was measured of the velocity */
    uint32_t measured;
    worst_t due, sure;
} watch_t;

static void watch(watch_t *w, double gap_s, double every, const insole_fix_t *fix)
{
    const insole_zupt_ekf_t *ekf = &shoe.zupt_ekf;
    const insole_foot_counts_t *before = &w->before, now = shoe.counts;
    const double at_s = (double)fix->t_us * 1e-6, dt_s = at_s - (double)w->last_us * 1e-6;
    bool is_still = now.still > before->still, begins = now.stances > before->stances;
    bool is_aligned = now.realigned > before->realigned || !(ekf->dt_s > INSOLE_R(0.0));
    bool is_measured = now.corrections > before->corrections;
    if (begins) {
        w->known_us = w->last_us;
    }
    double speaks_s = at_s - (double)w->known_us * 1e-6;
    if (fix->state == INSOLE_FIX_TRACK && !is_aligned) {
        bool is_due = begins || dt_s > gap_s || speaks_s + 0.5 * dt_s >= every;
        worst_require(&w->due, is_measured == (is_still && is_due), at_s);
    }
    if (is_measured) {
        const double sigma = (double)shoe.zupt_ekf.config.sigma_zupt_mps;
        double variance = (double)ekf->trace.velocity_var_m2ps2;
        worst_note(&w->sure, fabs(variance * speaks_s / (sigma * sigma * 0.005) - 1.0), at_s);
        w->measured++;
    }
    if (is_measured || is_aligned) {
        w->known_us = fix->t_us;
    }
    w->before = now;
    w->last_us = fix->t_us;
}

/* At once where a stance begins and after a gap in it, else when it is due; each speaks for the
 * time since the last, or since the foot was found to stand after a gap. */
START_TEST(measurements_speak_for_the_time_that_nothing_was_measured)
{
    const int gap = _i % GAPS, often = _i / GAPS % EVERY, rate = _i / GAPS / EVERY;
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    walk_t walk = slow_walk();
    watch_t w;
    memset(&w, 0, sizeof w);
    config.correct_every_s = (insole_real_t)every_s[often];
    record(&walk, rates_hz[rate], 0.0);
    drop_out(gaps[gap].from_s, gaps[gap].to_s);
    set_up(&shoe, &config);
    for (uint32_t i = 0u; i < sample_count; i++) {
        insole_fix_t fix;
        ck_assert_int_eq(insole_foot_tracker_imu(&shoe, &samples[i]), INSOLE_OK);
        while (insole_foot_tracker_next(&shoe, &fix) == INSOLE_OK) {
            watch(&w, (double)config.screen.gap_s, (double)config.correct_every_s, &fix);
        }
    }
    ASSERT_ALL_HELD(w.due);
    ASSERT_WORST(w.sure, 2.0e-5, "(of the variance)");
    ck_assert_uint_ge(w.measured, 20u);
    ck_assert_uint_eq(shoe.counts.bridged, gaps[gap].bridged);
    ck_assert_uint_eq(shoe.counts.coasts, gaps[gap].coasts);
    ck_assert_uint_eq(shoe.zupt_ekf.refused, 0u);
}
END_TEST

/* ---- samples that the covariance has not seen ------------------------------------------- */

static insole_foot_tracker_config_t quiet_config(void)
{
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    config.zupt_ekf.sigma_accel_bias_mps2 = INSOLE_R(0.0); /* for which settling is exact */
    return config;
}

static void next_of_both(insole_foot_tracker_t *eager, worst_t *off, worst_t *way)
{
    insole_fix_t fix, other;
    while (insole_foot_tracker_next(&shoe, &fix) == INSOLE_OK) {
        ck_assert_int_eq(insole_foot_tracker_next(eager, &other), INSOLE_OK);
        ck_assert_int_eq(insole_zupt_ekf_settle(&eager->zupt_ekf), INSOLE_OK);
        insole_zupt_cov_t late = filter_cov(&shoe.zupt_ekf);
        dense_t a = dense_of(&late), b = dense_of(&eager->zupt_ekf.P);
        worst_note(off, dense_off(&a, &b, &b), (double)fix.t_us * 1e-6);
        insole_vec3_t d = insole_vec3_sub(fix.position_m, other.position_m);
        worst_note(way, (double)insole_vec3_norm(d), (double)fix.t_us * 1e-6);
    }
}

/* Whenever the covariance is brought up to now, by gaps and starts too: it is the same. */
START_TEST(it_does_not_matter_when_the_covariance_settles)
{
    static insole_foot_tracker_t eager;
    const int gap = _i % GAPS;
    insole_foot_tracker_config_t config = quiet_config();
    walk_t walk = slow_walk();
    insole_start_t start;
    worst_t off = {0.0, 0.0}, way = {0.0, 0.0};
    memset(&start, 0, sizeof start);
    start.t_us = 4700000u + 5000u * (uint64_t)(_i / GAPS); /* in a swing */
    start.sigma_m = INSOLE_R(0.1);
    record(&walk, 200.0, 0.0);
    drop_out(gaps[gap].from_s, gaps[gap].to_s);
    set_up(&shoe, &config);
    ck_assert_int_eq(insole_foot_tracker_start(&shoe, &start), INSOLE_OK);
    eager = shoe;
    for (uint32_t i = 0u; i < sample_count; i++) {
        ck_assert_int_eq(insole_foot_tracker_imu(&shoe, &samples[i]), INSOLE_OK);
        ck_assert_int_eq(insole_foot_tracker_imu(&eager, &samples[i]), INSOLE_OK);
        next_of_both(&eager, &off, &way);
    }
    ASSERT_WORST(off, 3000.0 * (double)INSOLE_REAL_EPSILON, "(of the 1-sigmas)");
    ASSERT_WORST(way, 3000.0 * (double)INSOLE_REAL_EPSILON, "m");
    ck_assert(!shoe.has_start);
}
END_TEST

/* Told in a swing, between two blocks, it is known there and then. */
START_TEST(a_start_is_where_errors_are_counted_from)
{
    walk_t walk = slow_walk();
    insole_start_t start = {4700000u + 5000u * (uint64_t)_i,
                            INSOLE_R(3.0),
                            INSOLE_R(-2.0),
                            true,
                            INSOLE_R(0.4),
                            INSOLE_R(0.1),
                            INSOLE_R(0.05)};
    record(&walk, 200.0, 0.0);
    set_up(&shoe, &insole_foot_tracker_defaults);
    ck_assert_int_eq(insole_foot_tracker_start(&shoe, &start), INSOLE_OK);
    for (uint32_t i = 0u; i < sample_count && (i == 0u || shoe.has_start); i++) {
        insole_fix_t fix;
        ck_assert_int_eq(insole_foot_tracker_imu(&shoe, &samples[i]), INSOLE_OK);
        (void)insole_foot_tracker_next(&shoe, &fix);
    }
    ck_assert(!shoe.has_start && !shoe.was_still);
    insole_zupt_cov_t P = filter_cov(&shoe.zupt_ekf);
    ck_assert(P.pp.xx == 0 && P.pp.xy == 0 && P.pp.yy == 0 && P.pp.zz == 0);
    ck_assert(P.pv.r0.x == 0 && P.pa.r1.z == 0 && P.pb.r2.y == 0 && P.aa.zz == 0);
    ck_assert(P.vv.xx > 0 && P.aa.xx > 0);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_tracker stances");
    suite_add_loop(suite, "what measurements speak for",
                   measurements_speak_for_the_time_that_nothing_was_measured, GAPS * EVERY * RATES);
    suite_add_loop(suite, "settling at any time", it_does_not_matter_when_the_covariance_settles,
                   GAPS * 8);
    suite_add_loop(suite, "start in a swing", a_start_is_where_errors_are_counted_from, 16);
    return suite;
}
