/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_tracker.h"

#include "hand_walk.h"
#include "suite.h"

static rig_t rig;

/* One step more or less at either end of a walk, and half of one that is under way. */
#define STEPS_OFF_M (1.5 * HAND_STEP_M)

static void check_all_sane(void)
{
    worst_t sane = {0.0, 0.0};
    for (uint32_t i = 0u; i < fix_count; i++) {
        worst_require(&sane, is_sane_fix(&fixes[i]), i);
        worst_require(&sane, fixes[i].t_us == samples[i].t_us, i);
    }
    ASSERT_ALL_HELD(sane);
}

/* ---- steps alone --------------------------------------------------------------------------- */

/* Directions all round, the phone held level, upright, and leaning to either side. */
static hand_t hand_of(int row)
{
    const double pitch[] = {0.0, 0.3, 0.9, 0.6}, roll[] = {0.0, 0.4, -0.3, 0.1};
    hand_t hand = usual_hand;
    hand.heading_rad = -3.0 + 0.75 * row;
    hand.pitch_rad = pitch[row % 4];
    hand.roll_rad = roll[row % 4];
    hand.seed = 20u + (uint64_t)row;
    return hand;
}

START_TEST(a_straight_walk_ends_where_it_should)
{
    hand_t hand = hand_of(_i);
    walk_legs(&hand, STRAIGHT, 3);
    rig_case_t c = usual_case(&hand);
    run_case(&rig, &c);
    check_all_sane();
    ASSERT_AT_MOST(error_at_end(), STEPS_OFF_M, "m");
    ASSERT_AT_MOST(worst_error(800u, fix_count), STEPS_OFF_M, "m");
    ASSERT_NEAR(rig.phone.counts.steps, 40.0, 1.0, "steps");
    ASSERT_NEAR(
        remainder((double)fixes[fix_count - 1u].heading_rad - hand.heading_rad, 2.0 * HAND_PI), 0.0,
        0.05, "rad");
}
END_TEST

START_TEST(a_walk_about_a_corner_ends_where_it_should)
{
    hand_t hand = hand_of(_i);
    walk_legs(&hand, L_SHAPE, 5);
    rig_case_t c = usual_case(&hand);
    run_case(&rig, &c);
    check_all_sane();
    ASSERT_AT_MOST(error_at_end(), STEPS_OFF_M, "m");
    ASSERT_NEAR(rig.phone.counts.steps, 56.0, 1.0, "steps");
    ASSERT_NEAR(remainder((double)fixes[fix_count - 1u].heading_rad - truth_rad[sample_count - 1u],
                          2.0 * HAND_PI),
                0.0, 0.05, "rad");
}
END_TEST

/* C1 range^(1/C), the range by the gains of both filters at two steps a second. */
START_TEST(lengths_by_the_root_follow_the_bounce)
{
    const double shakes[] = {1.5, 2.5, 4.0};
    hand_t hand = usual_hand;
    hand.shake_mps2 = shakes[_i];
    hand.accel_noise = 0.0;
    walk_legs(&hand, STRAIGHT, 3);
    rig_case_t c = usual_case(&hand);
    c.config.walk.step_length = insole_step_length_defaults;
    run_case(&rig, &c);
    double low = 1.0 / sqrt(1.0 + pow(2.0 / 2.2, 4.0)), high = 2.0 / hypot(2.0, 0.5);
    double length_m = 0.412 * pow(2.0 * shakes[_i] * low * high, 0.25);
    double way_m = hypot((double)fixes[fix_count - 1u].position_m.x - hand.x_m,
                         (double)fixes[fix_count - 1u].position_m.y - hand.y_m);
    ASSERT_NEAR(way_m / rig.phone.counts.steps, length_m, 0.04 * length_m, "m");
}
END_TEST

START_TEST(every_filter_walks_alike_on_steps_alone)
{
    const insole_step_filter_calls_t *filters[] = {&insole_step_ekf_calls, &insole_step_kf_calls,
                                                   &insole_ml_shift_calls};
    walk_legs(&usual_hand, L_SHAPE, 5);
    rig_case_t c = usual_case(&usual_hand);
    c.filter = filters[_i];
    run_case(&rig, &c);
    check_all_sane();
    ASSERT_AT_MOST(error_at_end(), STEPS_OFF_M, "m");
}
END_TEST

START_TEST(the_gyro_alone_holds_the_heading_of_a_short_walk)
{
    hand_t hand = usual_hand;
    hand.gyro_noise = 0.0005;
    walk_legs(&hand, L_SHAPE, 5);
    rig_case_t c = usual_case(&hand);
    c.attitude = NULL;
    run_case(&rig, &c);
    ASSERT_AT_MOST(error_at_end(), STEPS_OFF_M, "m");
}
END_TEST

START_TEST(uncertainty_grows_with_the_steps)
{
    worst_t grows = {0.0, 0.0};
    walk_legs(&usual_hand, STRAIGHT, 3);
    rig_case_t c = usual_case(&usual_hand);
    run_case(&rig, &c);
    double before = 0.0;
    for (uint32_t i = 0u; i < fix_count; i++) {
        double var = (double)(fixes[i].var_x_m2 + fixes[i].var_y_m2);
        worst_require(&grows, var >= before, i);
        before = var;
    }
    ASSERT_ALL_HELD(grows);
    ASSERT_NEAR(fixes[0].var_x_m2, 0.09, 1e-5, "m^2");
    ASSERT_AT_LEAST(before, 0.18 + 40.0 * pow(0.15 * HAND_STEP_M, 2.0), "m^2");
    ASSERT_AT_MOST(before, 3.0, "m^2");
}
END_TEST

/* ---- the first steps ----------------------------------------------------------------------- */

/* Two peaks are shown at once; from then on no fix is more than a step from the one before, when
 * the steps are told neither. */
START_TEST(telling_the_first_steps_moves_the_position_by_no_more_than_a_step)
{
    hand_t hand = hand_of(_i);
    uint32_t shown = 0u;
    walk_legs(&hand, L_SHAPE, 5);
    rig_case_t c = usual_case(&hand);
    run_case(&rig, &c);
    while (shown < fix_count && fixes[shown].position_m.x == fixes[0].position_m.x) {
        shown++;
    }
    ck_assert_uint_gt(shown, 300u);
    ck_assert_uint_lt(shown, 450u); /* 1.5 s after the first step began */
    ASSERT_WORST(longest_jump(0u, shown + 1u), 2.02 * HAND_STEP_M, "m");
    ASSERT_WORST(longest_jump(shown, fix_count), 1.02 * HAND_STEP_M, "m");
}
END_TEST

START_TEST(not_shown_the_first_steps_come_later_and_all_at_once)
{
    uint32_t moved = 0u;
    walk_legs(&usual_hand, STRAIGHT, 3);
    rig_case_t c = usual_case(&usual_hand);
    c.config.walk.shown_steps = 9;
    run_case(&rig, &c);
    while (moved < fix_count && fixes[moved].position_m.x == fixes[0].position_m.x) {
        moved++;
    }
    ck_assert_uint_gt(moved, 450u);
    ASSERT_AT_LEAST(longest_jump(0u, moved + 1u).off, 3.0 * HAND_STEP_M, "m");
    ASSERT_AT_MOST(error_at_end(), STEPS_OFF_M, "m");
}
END_TEST

/* Two jolts are no walk, however often: what is shown of them goes when the next ones come. */
START_TEST(peaks_that_prove_to_be_no_steps_do_not_add_up)
{
    leg_t jolts[20];
    for (int i = 0; i < 20; i++) {
        leg_t still = {3.0, false, 0.0}, jolt = {1.1, true, 0.0};
        jolts[i] = i % 2 == 0 ? still : jolt;
    }
    walk_legs(&usual_hand, jolts, 20);
    rig_case_t c = usual_case(&usual_hand);
    run_case(&rig, &c);
    ck_assert_uint_eq(rig.phone.counts.steps, 0u);
    worst_t off = {0.0, 0.0};
    for (uint32_t i = 0u; i < fix_count; i++) {
        worst_note(&off,
                   hypot((double)fixes[i].position_m.x - usual_hand.x_m,
                         (double)fixes[i].position_m.y - usual_hand.y_m),
                   0.01 * i);
    }
    ASSERT_WORST(off, 3.02 * HAND_STEP_M, "m");
    ASSERT_AT_LEAST(off.off, HAND_STEP_M, "m");
}
END_TEST

/* ---- starts -------------------------------------------------------------------------------- */

START_TEST(before_the_walk_a_told_start_is_where_it_is)
{
    walk_legs(&usual_hand, STRAIGHT, 3);
    rig_case_t c = usual_case(&usual_hand);
    run_case(&rig, &c);
    for (uint32_t i = 0u; i < 300u; i += 50u) {
        ASSERT_NEAR(fixes[i].position_m.x, usual_hand.x_m, 1e-5, "m");
        ASSERT_NEAR(fixes[i].position_m.y, usual_hand.y_m, 1e-5, "m");
        ASSERT_NEAR(fixes[i].heading_rad, usual_hand.heading_rad, 0.02, "rad");
        ck_assert_int_eq(fixes[i].state, INSOLE_FIX_TRACK);
    }
}
END_TEST

START_TEST(without_start_and_radio_the_walk_begins_at_the_origin)
{
    hand_t hand = usual_hand;
    hand.x_m = hand.y_m = hand.heading_rad = 0.0;
    walk_legs(&hand, L_SHAPE, 5);
    rig_case_t c = usual_case(&hand);
    c.has_start = false;
    run_case(&rig, &c);
    check_all_sane();
    ck_assert_int_eq(fixes[0].state, INSOLE_FIX_SEARCH);
    ck_assert_int_eq(fixes[fix_count - 1u].state, INSOLE_FIX_TRACK);
    ASSERT_AT_MOST(error_at_end(), STEPS_OFF_M, "m");
}
END_TEST

/* n points anywhere; the place was told, the compass tells the direction. */
START_TEST(the_compass_directs_a_walk_whose_place_was_told)
{
    hand_t hand = hand_of(_i);
    walk_legs(&hand, L_SHAPE, 5);
    rig_case_t c = usual_case(&hand);
    c.start.has_heading = false;
    c.sees = true;
    run_case(&rig, &c);
    check_all_sane();
    ck_assert_uint_eq(rig.phone.counts.magnetic, mag_count - 1u); /* the first: no attitude yet */
    ck_assert_uint_eq(rig.phone.counts.refused, 1u);
    ASSERT_AT_MOST(error_at_end(), STEPS_OFF_M, "m");
}
END_TEST

/* The gyro creeps by 0.03 rad/s once somebody walks. Told to, the tracker holds the heading by the
 * field, as far behind as a Kalman filter of these noises is, 20 uT of it level; else it turns with
 * the gyro. */
START_TEST(the_field_holds_the_heading_if_it_may)
{
    const double creep_radps = 0.03;
    double off_rad[2];
    for (int use = 0; use < 2; use++) {
        walk_legs(&usual_hand, STRAIGHT, 3);
        for (uint32_t i = 200u; i < sample_count; i++) {
            samples[i].gyro_radps.z += (insole_real_t)creep_radps;
        }
        rig_case_t c = usual_case(&usual_hand);
        c.magnetic.use = use;
        c.config.compass.use = 0;
        c.sees = true;
        run_case(&rig, &c);
        check_all_sane();
        off_rad[use] = fabs(
            remainder((double)fixes[fix_count - 1u].heading_rad - (double)fixes[200].heading_rad,
                      6.283185307179586));
        ck_assert_uint_eq(rig.magnetic.corrected > 100u, use == 1);
    }
    double crept_s = 1e-6 * (double)(samples[sample_count - 1u].t_us - samples[200].t_us);
    ck_assert_double_gt(off_rad[0], 0.5 * creep_radps * crept_s);
    double lag_s = (double)insole_magnetic_defaults.noise_ut_rts / 20.0 /
                   (double)insole_attitude_defaults.gyro_noise_rad_rts;
    ck_assert_double_lt(off_rad[1], 1.1 * creep_radps * lag_s);
}
END_TEST

START_TEST(fixes_alone_start_a_walk)
{
    const insole_step_filter_calls_t *filters[] = {&insole_step_ekf_calls, &insole_step_kf_calls,
                                                   &insole_ml_shift_calls};
    uint32_t first = 0u;
    walk_legs(&usual_hand, L_SHAPE, 5);
    hear_on_the_way(1.0, 3.0);
    rig_case_t c = usual_case(&usual_hand);
    c.filter = filters[_i];
    c.has_start = false;
    c.hears = true;
    run_case(&rig, &c);
    check_all_sane();
    while (first < fix_count && fixes[first].state != INSOLE_FIX_TRACK) {
        first++;
    }
    ck_assert_uint_gt(first, 500u);
    ck_assert_uint_lt(first, 2500u);
    ck_assert_double_gt((double)fixes[10].var_x_m2, 1.0e9); /* nobody has heard anything yet */
    ck_assert_uint_eq(rig.phone.place.starts, 1u);
    ck_assert_uint_eq(rig.phone.radio.fixes, scan_count);
    ASSERT_AT_MOST(worst_error(first, fix_count), 4.0, "m");
    ASSERT_AT_MOST(error_at_end(), 2.5, "m");
}
END_TEST

/* A start of which the place is wrong is mended by fixes, as far as its sigma admits. */
START_TEST(fixes_mend_a_start_that_is_off)
{
    walk_legs(&usual_hand, L_SHAPE, 5);
    hear_on_the_way(2.0, 3.0);
    rig_case_t c = usual_case(&usual_hand);
    c.start.x_m += INSOLE_R(5.0);
    c.start.sigma_m = INSOLE_R(5.0);
    run_case(&rig, &c);
    double alone = error_at_end();
    c.hears = true;
    run_case(&rig, &c);
    ASSERT_AT_LEAST(alone, 4.0, "m");
    ASSERT_AT_MOST(error_at_end(), 2.5, "m");
}
END_TEST

/* ---- radio alone --------------------------------------------------------------------------- */

START_TEST(radio_alone_holds_its_last_fix)
{
    walk_legs(&usual_hand, L_SHAPE, 5);
    hear_on_the_way(1.0, 3.0);
    rig_case_t c = usual_case(&usual_hand);
    c.filter = NULL;
    c.has_start = false;
    c.hears = true;
    scan_count = 20u; /* then silence */
    run_case(&rig, &c);
    check_all_sane();
    ck_assert_int_eq(fixes[0].state, INSOLE_FIX_SEARCH);
    ck_assert_int_eq(fixes[100].state, INSOLE_FIX_TRACK);
    ck_assert_int_eq(fixes[1950u + 490u].state, INSOLE_FIX_TRACK);
    ck_assert_int_eq(fixes[1950u + 510u].state, INSOLE_FIX_COAST);
    ASSERT_AT_MOST(worst_error(100u, 1950u), 8.0, "m");
    ck_assert(fixes[fix_count - 1u].position_m.x == rig.phone.radio.fix.spot.x_m);
    ck_assert(fixes[fix_count - 1u].var_y_m2 == rig.phone.radio.fix.var_y_m2);
}
END_TEST

/* ---- gaps and states ----------------------------------------------------------------------- */

/* Samples from..to are missing. */
static void run_without(const rig_case_t *c, uint32_t from, uint32_t to)
{
    set_up(&rig, c);
    run(&rig, c, 0u, from);
    run(&rig, c, to, sample_count);
    finish(&rig);
    ck_assert_uint_eq(fix_count, sample_count - (to - from));
}

START_TEST(a_gap_coasts_and_costs_certainty)
{
    walk_legs(&usual_hand, STRAIGHT, 3);
    rig_case_t c = usual_case(&usual_hand);
    run_without(&c, 1500u, 1700u);
    const insole_fix_t *before = &fixes[1499], *after = &fixes[1500];
    ck_assert_int_eq(before->state, INSOLE_FIX_TRACK);
    ck_assert_int_eq(after->state, INSOLE_FIX_COAST);
    ASSERT_NEAR(after->var_x_m2 - before->var_x_m2, pow(0.8 * 2.01, 2.0), 0.05, "m^2");
    ASSERT_NEAR(after->var_y_m2 - before->var_y_m2, pow(0.8 * 2.01, 2.0), 0.05, "m^2");
    ASSERT_AT_MOST(longest_jump(1498u, 1502u).off, 1.1 * HAND_STEP_M, "m");
    ck_assert_int_eq(fixes[fix_count - 1u].state, INSOLE_FIX_TRACK);
    ck_assert_uint_eq(rig.phone.counts.gaps, 1u);
    ck_assert_uint_eq(rig.phone.place.starts, 2u);
    double x = (double)fixes[fix_count - 1u].position_m.x - truth_x_m[sample_count - 1u];
    double y = (double)fixes[fix_count - 1u].position_m.y - truth_y_m[sample_count - 1u];
    ASSERT_AT_MOST(hypot(x, y), STEPS_OFF_M + 2.0 * 2.0 * HAND_STEP_M, "m"); /* 4 steps unseen */
}
END_TEST

START_TEST(a_short_gap_is_none)
{
    walk_legs(&usual_hand, STRAIGHT, 3);
    rig_case_t c = usual_case(&usual_hand);
    run_without(&c, 1500u, 1545u);
    ck_assert_uint_eq(rig.phone.counts.gaps, 0u);
    ck_assert_int_eq(fixes[1500].state, INSOLE_FIX_TRACK);
}
END_TEST

/* What a compass told before a gap speaks of a frame that may have turned meanwhile. */
START_TEST(after_a_gap_the_compass_of_before_is_no_longer_believed)
{
    walk_legs(&usual_hand, STRAIGHT, 3);
    rig_case_t c = usual_case(&usual_hand);
    c.sees = true;
    c.has_start = false;
    set_up(&rig, &c);
    run(&rig, &c, 0u, 200u);
    ck_assert(rig.phone.place.sight.is_known);
    c.sees = false;
    run(&rig, &c, 600u, 602u);
    ck_assert_uint_eq(rig.phone.counts.gaps, 1u);
    ck_assert(!rig.phone.place.sight.is_known);
}
END_TEST

START_TEST(states_follow_what_is_known)
{
    uint32_t changes = 0u;
    insole_fix_state_t seen[8];
    walk_legs(&usual_hand, STRAIGHT, 3);
    for (uint32_t i = 0u; i < 50u; i++) { /* falls freely: there is no vertical to see */
        samples[i].accel_mps2 = insole_vec3(INSOLE_R(0.1), INSOLE_R(0.0), INSOLE_R(0.0));
    }
    rig_case_t c = usual_case(&usual_hand);
    c.start.t_us = samples[150].t_us;
    c.config.search_sigma_m = INSOLE_R(0.6);
    c.config.lost_sigma_m = INSOLE_R(0.8);
    run_without(&c, 900u, 980u);
    for (uint32_t i = 0u; i < fix_count; i++) {
        if (changes == 0u || fixes[i].state != seen[changes - 1u]) {
            ck_assert_uint_lt(changes, 8u);
            seen[changes++] = fixes[i].state;
        }
    }
    const insole_fix_state_t expected[] = {INSOLE_FIX_ALIGN, INSOLE_FIX_SEARCH, INSOLE_FIX_TRACK,
                                           INSOLE_FIX_LOST};
    ck_assert_uint_eq(changes, 4u);
    ck_assert_mem_eq(seen, expected, sizeof expected);
}
END_TEST

START_TEST(a_gap_shows_coast_until_the_next_step)
{
    uint32_t i = 1500u;
    walk_legs(&usual_hand, STRAIGHT, 3);
    rig_case_t c = usual_case(&usual_hand);
    run_without(&c, 1500u, 1600u);
    while (i < fix_count && fixes[i].state == INSOLE_FIX_COAST) {
        i++;
    }
    ck_assert_uint_gt(i, 1550u);
    ck_assert_uint_lt(i, 1900u);
    for (; i < fix_count; i++) {
        ck_assert(fixes[i].state == INSOLE_FIX_TRACK);
    }
}
END_TEST

/* ---- scans --------------------------------------------------------------------------------- */

/* A scan heard three seconds ago places the walker where he was then, and is moved on. */
START_TEST(late_scans_speak_of_where_they_were_heard)
{
    walk_legs(&usual_hand, STRAIGHT, 3);
    hear_on_the_way(1.0, 1.0);
    for (uint32_t i = 0u; i < scan_count; i++) {
        scans[i].t_us += 3000000u;
        for (uint32_t j = 0u; j < scans[i].count; j++) {
            scans[i].readings[j].age_us = 3000000u;
        }
    }
    rig_case_t c = usual_case(&usual_hand);
    c.config.radio_late_s = INSOLE_R(0.0);
    c.hears = true;
    run_case(&rig, &c);
    double told = worst_error(1500u, 2300u);
    for (uint32_t i = 0u; i < scan_count; i++) {
        for (uint32_t j = 0u; j < scans[i].count; j++) {
            scans[i].readings[j].age_us = 0u;
        }
    }
    run_case(&rig, &c);
    ASSERT_AT_MOST(told, 1.5, "m");
    ASSERT_AT_LEAST(worst_error(1500u, 2300u), told + 0.3, "m");
}
END_TEST

START_TEST(the_trusted_area_lies_about_the_walker)
{
    walk_legs(&usual_hand, L_SHAPE, 5);
    hear_on_the_way(2.0, 3.0);
    rig_case_t c = usual_case(&usual_hand);
    c.hears = true;
    c.config.trust_sigmas = INSOLE_R(3.0);
    run_case(&rig, &c);
    check_all_sane();
    ASSERT_AT_MOST(error_at_end(), 2.5, "m");
    c.start.x_m = INSOLE_R(900.0); /* far from all fingerprints: none is near enough */
    run_case(&rig, &c);
    ck_assert_uint_gt(rig.phone.radio.unplaced, 5u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_tracker");
    suite_add_loop(suite, "straight", a_straight_walk_ends_where_it_should, 8);
    suite_add_loop(suite, "corner", a_walk_about_a_corner_ends_where_it_should, 8);
    suite_add_loop(suite, "root", lengths_by_the_root_follow_the_bounce, 3);
    suite_add_loop(suite, "filters", every_filter_walks_alike_on_steps_alone, 3);
    suite_add(suite, "gyro alone", the_gyro_alone_holds_the_heading_of_a_short_walk);
    suite_add(suite, "uncertainty", uncertainty_grows_with_the_steps);
    suite_add_loop(suite, "first steps",
                   telling_the_first_steps_moves_the_position_by_no_more_than_a_step, 8);
    suite_add(suite, "not shown", not_shown_the_first_steps_come_later_and_all_at_once);
    suite_add(suite, "no steps", peaks_that_prove_to_be_no_steps_do_not_add_up);
    suite_add(suite, "told start", before_the_walk_a_told_start_is_where_it_is);
    suite_add(suite, "origin", without_start_and_radio_the_walk_begins_at_the_origin);
    suite_add_loop(suite, "compass", the_compass_directs_a_walk_whose_place_was_told, 8);
    suite_add(suite, "field", the_field_holds_the_heading_if_it_may);
    suite_add_loop(suite, "automatic start", fixes_alone_start_a_walk, 3);
    suite_add(suite, "start that is off", fixes_mend_a_start_that_is_off);
    suite_add(suite, "radio alone", radio_alone_holds_its_last_fix);
    suite_add(suite, "gap", a_gap_coasts_and_costs_certainty);
    suite_add(suite, "short gap", a_short_gap_is_none);
    suite_add(suite, "gap and compass", after_a_gap_the_compass_of_before_is_no_longer_believed);
    suite_add(suite, "states", states_follow_what_is_known);
    suite_add(suite, "coast", a_gap_shows_coast_until_the_next_step);
    suite_add(suite, "late scans", late_scans_speak_of_where_they_were_heard);
    suite_add(suite, "trusted area", the_trusted_area_lies_about_the_walker);
    return suite;
}
