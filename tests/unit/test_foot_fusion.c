/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_fusion.h"

#include "fusion_walk.h"
#include "suite.h"

/* Where the walker is found to be. */

enum { SEEDS = 3 };

static double end_s(void)
{
    return 1e-6 * (double)fixes[fix_count - 1u].t_us;
}

/* Over the last ten seconds, averaged over walks. */
static double end_error(fusion_case_t (*make)(void))
{
    double sum = 0.0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        walk_round(seed);
        fusion_case_t c = make();
        run_case(&c);
        ck_assert_uint_eq(fix_count, sample_count);
        sum += mean_error(end_s() - 10.0, HUGE_VAL) / SEEDS;
    }
    return sum;
}

/* Of the fixes that say all is well, those that are farther off than that. */
static uint32_t lies_after(double from_s, double limit_m)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < fix_count; i++) {
        count += fixes[i].state == INSOLE_FIX_TRACK && error_of(&fixes[i]) > limit_m &&
                         1e-6 * (double)fixes[i].t_us > from_s
                     ? 1u
                     : 0u;
    }
    return count;
}

static uint32_t lies(double limit_m)
{
    return lies_after(0.0, limit_m);
}

static uint32_t count_state(insole_fix_state_t state)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < fix_count; i++) {
        count += fixes[i].state == state ? 1u : 0u;
    }
    return count;
}

/* ---- starts ---- */

START_TEST(an_exact_start_is_kept)
{
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        walk_round(seed);
        fusion_case_t c = usual_case();
        run_case(&c);
        ASSERT_AT_MOST(mean_error(0.0, HUGE_VAL), 0.3, "m");
        ck_assert_uint_eq(lies(2.0), 0);
        ck_assert_uint_ge(count_state(INSOLE_FIX_TRACK), fix_count / 4u);
        for (uint32_t i = 100; i < 300; i++) { /* standing where he was told to be */
            ck_assert_int_eq(fixes[i].state, INSOLE_FIX_TRACK);
        }
        ck_assert_uint_eq(fusion.counts.starts, 1);
        ck_assert_uint_eq(fusion.counts.refused, 0);
        ck_assert_uint_ge(fusion.particles.counts.scans, 35);
    }
}
END_TEST

static fusion_case_t no_heading(void)
{
    fusion_case_t c = usual_case();
    c.start.has_heading = false;
    return c;
}

static fusion_case_t no_start(void)
{
    fusion_case_t c = usual_case();
    c.has_start = false;
    return c;
}

static fusion_case_t wrong_but_honest(void)
{
    fusion_case_t c = usual_case();
    c.start = start_at(0.0, 5.0, -5.0, 5.0);
    return c;
}

static fusion_case_t wrong_and_sure(void)
{
    fusion_case_t c = usual_case();
    c.start = start_at(0.0, 5.0, -5.0, 0.3);
    return c;
}

static fusion_case_t with_ranges(void)
{
    fusion_case_t c = usual_case();
    c.ranges = true;
    c.scans = false;
    c.has_start = false;
    return c;
}

static fusion_case_t walls_alone(void)
{
    fusion_case_t c = usual_case();
    c.scans = false;
    c.start.sigma_rad = INSOLE_R(0.3);
    c.start.heading_rad += INSOLE_R(0.25);
    return c;
}

static const struct {
    const char *what;
    fusion_case_t (*make)(void);
} hard_cases[] = {{"no heading", no_heading},           {"no start", no_start},
                  {"wrong, told so", wrong_but_honest}, {"wrong, and sure", wrong_and_sure},
                  {"ranges alone", with_ranges},        {"walls alone", walls_alone}};

START_TEST(little_known_it_is_found)
{
    ASSERT_AT_MOST(end_error(hard_cases[_i].make), 1.2, "m");
}
END_TEST

/* From the first scan on its place is told, as one that is searched for; the direction is found on
 * the way. */
START_TEST(without_a_start_it_searches)
{
    walk_round(1u);
    fusion_case_t c = no_start();
    c.slice = _i == 0 ? WHOLE : 60; /* also while the cloud is being drawn */
    run_case(&c);
    uint32_t early = 0, i = 0;
    for (; i < fix_count && fixes[i].state == INSOLE_FIX_ALIGN; i++) {
    }
    for (; i < fix_count && fixes[i].t_us < 10000000u; i++) {
        if (fixes[i].t_us > 1500000u) {
            ck_assert_int_eq(fixes[i].state, INSOLE_FIX_SEARCH);
            early += error_of(&fixes[i]) > 10.0 ? 1u : 0u;
        }
    }
    ck_assert_uint_eq(early, 0);
    ck_assert_uint_eq(lies(3.0), 0);
    ck_assert_uint_eq(fusion.counts.starts, 1);
}
END_TEST

/* Whatever the start, who says that all is well is not far off; a start that lies is believed until
 * some scans have said otherwise. */
START_TEST(the_state_is_honest)
{
    uint32_t wrong = 0, told = 0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        walk_round(seed);
        fusion_case_t c = hard_cases[_i].make();
        run_case(&c);
        wrong += lies_after(hard_cases[_i].make == wrong_and_sure ? 12.0 : 0.0, 3.0);
        told += count_state(INSOLE_FIX_TRACK);
    }
    ck_assert_msg(wrong <= 0.02 * told, "%s: %u of %u", hard_cases[_i].what, wrong, told);
}
END_TEST

/* ---- taken elsewhere ---- */

static const struct {
    bool scans, plan;
    double lag_s;
} worlds[] = {{false, false, 0.0},
              {false, false, 4.0},
              {true, false, 0.0},
              {true, true, 0.0},
              {true, true, 4.0}};

/* A start record in the middle of the walk, where nobody would have thought: from its time on it
 * holds, and what was thought before is forgotten. */
START_TEST(a_second_start_is_believed)
{
    walk_round(1u);
    if (!worlds[_i].plan) {
        radio.building.plan = NULL;
    }
    fusion_case_t c = usual_case();
    c.scans = worlds[_i].scans;
    c.config.lag_s = (insole_real_t)worlds[_i].lag_s;
    insole_start_t here = start_at(24.0, 0.0, 0.0, 0.3);
    c.start = start_at(0.0, -16.0, 12.0, 0.3);
    set_up(&c);
    run(&c, &fusion, 0u, 2399u);
    ck_assert_int_eq(insole_foot_fusion_start(&fusion, &here), INSOLE_OK);
    run(&c, &fusion, 2399u, sample_count);
    finish(&c, &fusion);
    if (!c.scans) {
        ASSERT_AT_LEAST(mean_error(20.0, 23.5), 15.0, "m");
    }
    ASSERT_AT_MOST(mean_error(24.0, 27.0), 0.7, "m");
    ASSERT_AT_MOST(mean_error(27.0, HUGE_VAL), 1.0, "m");
    ck_assert_uint_eq(fusion.counts.starts, 2);
}
END_TEST

/* Told ahead: until then all is as if nobody had told, radio finds its own start. */
START_TEST(a_start_told_ahead_waits_for_its_time)
{
    static insole_fix_t untold[FUSION_SAMPLES];
    walk_round(1u);
    fusion_case_t c = no_start();
    c.scans = _i == 1;
    run_case(&c);
    memcpy(untold, fixes, sizeof untold);
    c.has_start = true;
    c.start = start_at(15.0, 0.0, 0.0, 0.3);
    run_case(&c);
    for (uint32_t i = 0; i < fix_count && fixes[i].t_us < 14990000u; i++) {
        ck_assert(is_same_fix(&fixes[i], &untold[i]));
        ck_assert(c.scans || fixes[i].state != INSOLE_FIX_TRACK);
    }
    ASSERT_AT_MOST(mean_error(15.0, HUGE_VAL), 0.7, "m");
    ck_assert_uint_eq(lies(2.0), 0);
    ck_assert_uint_eq(fusion.counts.starts, c.scans ? 2 : 1);
}
END_TEST

/* ---- plans ---- */

/* The corridor is drawn beside where it is: all die again and again, and it goes on. */
START_TEST(when_all_have_died_it_goes_on)
{
    walk_round(1u);
    draw_move(&radio.drawing, 0.0, 5.0, 3.0);
    ck_assert_int_eq(draw_build(&radio.drawing), INSOLE_OK);
    fusion_case_t c = usual_case();
    run_case(&c);
    ck_assert_uint_ge(fusion.particles.counts.recovered, 1);
    ck_assert_uint_eq(fix_count, sample_count);
    for (uint32_t i = 0; i < fix_count; i++) {
        ck_assert(is_sane_fix(&fixes[i]));
    }
    ASSERT_AT_MOST(mean_error(0.0, HUGE_VAL), 9.0, "m"); /* it was drawn 6 m away */
}
END_TEST

/* An outline far around: it says nothing, and takes nothing away. */
START_TEST(a_plan_without_walls_near_by)
{
    walk_round(1u);
    draw_begin(&radio.drawing);
    draw_box(&radio.drawing, INSOLE_LINE_OUTLINE, 4.0, 0.0, -60.0, 220.0, 150.0);
    ck_assert_int_eq(draw_build(&radio.drawing), INSOLE_OK);
    fusion_case_t c = usual_case();
    run_case(&c);
    ASSERT_AT_MOST(mean_error(0.0, HUGE_VAL), 1.0, "m");
    ck_assert_uint_eq(fusion.particles.counts.recovered, 0);
}
END_TEST

static const uint32_t few[] = {1, 2, 5};

START_TEST(few_particles_do)
{
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.particles = few[_i];
    run_case(&c);
    ck_assert_uint_eq(fix_count, sample_count);
    for (uint32_t i = 0; i < fix_count; i++) {
        ck_assert(is_sane_fix(&fixes[i]));
    }
    ASSERT_AT_MOST(mean_error(0.0, HUGE_VAL), 6.0, "m");
}
END_TEST

/* ---- methods ---- */

/* Bit for bit the first order, whatever is told of radio. */
START_TEST(without_a_building_it_is_the_first_order)
{
    static insole_foot_tracker_t shoe;
    insole_fix_t fix;
    uint32_t same = 0;
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.building = NULL;
    c.scans = false;
    c.has_start = _i == 1;
    run_case(&c);
    ck_assert_int_eq(insole_foot_tracker_init(&shoe, &c.config.foot), INSOLE_OK);
    if (c.has_start) {
        ck_assert_int_eq(insole_foot_tracker_start(&shoe, &c.start), INSOLE_OK);
    }
    for (uint32_t i = 0; i <= sample_count; i++) {
        ck_assert_int_eq(i < sample_count ? insole_foot_tracker_imu(&shoe, &samples[i])
                                          : insole_foot_tracker_finish(&shoe),
                         INSOLE_OK);
        while (insole_foot_tracker_next(&shoe, &fix) == INSOLE_OK) {
            ck_assert(is_same_fix(&fix, &fixes[same]));
            same++;
        }
    }
    ck_assert_uint_eq(same, fix_count);
    insole_scan_t scan = {1, heard[0].readings, FUSION_APS};
    ck_assert_int_eq(insole_foot_fusion_scan(&fusion, &scan), INSOLE_ERR_STATE);
}
END_TEST

/* A fix for each scan, at once, of its time and of nothing else. */
START_TEST(radio_alone_answers_at_once)
{
    insole_fix_t fix, other;
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.config.method = INSOLE_FUSION_WIFI;
    set_up(&c);
    ck_assert_int_eq(insole_foot_fusion_imu(&fusion, &samples[0]), INSOLE_OK);
    for (uint32_t i = 0; i < heard_count; i++) {
        insole_anchor_fix_t direct;
        insole_scan_t scan = {heard[i].t_us, heard[i].readings, FUSION_APS};
        ck_assert_int_eq(insole_foot_fusion_next(&fusion, &fix), INSOLE_ERR_STATE);
        ck_assert_int_eq(insole_foot_fusion_scan(&fusion, &scan), INSOLE_OK);
        ck_assert_int_eq(insole_foot_fusion_scan(&fusion, &scan), INSOLE_ERR_STATE);
        ck_assert_int_eq(insole_foot_fusion_ranges(&fusion, heard[i].ranges, 3), INSOLE_ERR_STATE);
        ck_assert_int_eq(insole_foot_fusion_next(&fusion, &fix), INSOLE_OK);
        ck_assert_int_eq(insole_foot_fusion_next(&fusion, &other), INSOLE_ERR_STATE);
        insole_rss_fix_solve(&c.config.rss_fix, &radio.propagation, radio.aps, FUSION_APS,
                             heard[i].readings, FUSION_APS, &direct);
        ck_assert(is_sane_fix(&fix) && fix.t_us == heard[i].t_us);
        ASSERT_NEAR(fix.position_m.x, direct.x_m, 0.01, "m"); /* in another order */
        ASSERT_NEAR(fix.position_m.y, direct.y_m, 0.01, "m");
        ASSERT_NEAR(fix.var_x_m2, direct.P.xx, 0.01 * (double)direct.P.xx, "m2");
    }
    ck_assert_uint_eq(fusion.counts.refused, 2u * heard_count);
    ck_assert(!insole_foot_fusion_work(&fusion, WHOLE));
    ck_assert_int_eq(insole_foot_fusion_ranges(&fusion, heard[0].ranges, FUSION_APS), INSOLE_OK);
    ck_assert_int_eq(insole_foot_fusion_next(&fusion, &fix), INSOLE_OK);
    ASSERT_AT_MOST(error_of(&fix), 3.0, "m");
}
END_TEST

/* The stage as printed has its own settings, holds to the inertial position, and needs near access
 * points to leave it. */
START_TEST(two_orders_as_printed)
{
    walk_round(2u);
    fusion_case_t c = usual_case();
    c.config.method = INSOLE_FUSION_TWO_ORDER;
    c.config.sigma_inertial_m = INSOLE_R(0.7);
    set_up(&c);
    ck_assert_mem_eq(&fusion.particles.config, &insole_particle_filter_two_order,
                     sizeof fusion.particles.config);
    run(&c, &fusion, 0u, sample_count / 2u);
    for (uint32_t i = sample_count / 2u; !fusion.news.has_stride || i < sample_count / 2u + 1u;
         i++) {
        run(&c, &fusion, i, i + 1u);
    }
    ck_assert(fusion.news.has_position && !fusion.news.has_scan);
    ASSERT_NEAR(fusion.news.sigma_m, 0.7, 1e-6, "m");
    run_case(&c);
    ASSERT_AT_MOST(mean_error(0.0, HUGE_VAL), 0.6, "m");
    ck_assert_uint_eq(fusion.particles.counts.scans, 0);
    c.config.two_order.sigma_length_m = INSOLE_R(0.2);
    c.config.particles.sigma_length_m = INSOLE_R(0.3);
    set_up(&c);
    ASSERT_NEAR(fusion.particles.config.sigma_length_m, 0.2, 1e-6, "m");
}
END_TEST

/* ---- told later ---- */

/* The same fixes, later and better, on nearly every walk: where little was known at first, the way
 * there is known by what came after. */
START_TEST(later_it_is_known_better)
{
    enum { WALKS = 8 };
    double at_once = 0.0, later = 0.0;
    uint32_t better = 0;
    for (uint64_t seed = 1; seed <= WALKS; seed++) {
        walk_round(seed);
        fusion_case_t c = _i == 0 ? no_heading() : wrong_but_honest();
        run_case(&c);
        uint32_t count = fix_count;
        double then = mean_error(6.0, HUGE_VAL);
        c.config.lag_s = 5;
        run_case(&c);
        double now = mean_error(6.0, HUGE_VAL);
        better += now < then ? 1u : 0u;
        at_once += then;
        later += now;
        ck_assert_uint_eq(fix_count, count);
        for (uint32_t i = 0; i < fix_count; i++) {
            ck_assert(fixes[i].t_us == samples[i].t_us);
        }
    }
    ASSERT_AT_MOST(later, at_once, "m");
    ck_assert_uint_ge(better, WALKS - 1);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_fusion");
    int hard = sizeof hard_cases / sizeof hard_cases[0];
    suite_add(suite, "exact start", an_exact_start_is_kept);
    suite_add_loop(suite, "little known", little_known_it_is_found, hard);
    suite_add_loop(suite, "no start", without_a_start_it_searches, 2);
    suite_add_loop(suite, "honest", the_state_is_honest, hard);
    suite_add_loop(suite, "second start", a_second_start_is_believed,
                   sizeof worlds / sizeof worlds[0]);
    suite_add_loop(suite, "told ahead", a_start_told_ahead_waits_for_its_time, 2);
    suite_add(suite, "all dead", when_all_have_died_it_goes_on);
    suite_add(suite, "no walls", a_plan_without_walls_near_by);
    suite_add_loop(suite, "few", few_particles_do, sizeof few / sizeof few[0]);
    suite_add_loop(suite, "no building", without_a_building_it_is_the_first_order, 2);
    suite_add(suite, "radio alone", radio_alone_answers_at_once);
    suite_add(suite, "two orders", two_orders_as_printed);
    suite_add_loop(suite, "later", later_it_is_known_better, 2);
    return suite;
}
