/* SPDX-License-Identifier: MIT
 * A stroll with a phone that points aside of the way. */
#include "insole/track/phone_gait.h"

#include "insole/move/heading.h"
#include "insole/sense/carry_table.h"

#include "hand_walk.h"
#include "refusal.h"
#include "setting.h"
#include "stroll.h"
#include "suite.h"

enum { MOST_STEPS = 100, STROLL_RATE_HZ = 100, GENTLE = HAND_GENTLE, HARD = HAND_HARD };

#define ASIDE_RAD 1.2217304764 /* 70 degrees to the left */

static insole_phone_walk_config_t config;
static insole_phone_gait_config_t gait_config;
static insole_phone_walk_t walk;
static insole_attitude_t attitude;
static insole_footfall_t footfalls[MOST_STEPS];
static insole_pace_t paces[MOST_STEPS];
static uint32_t step_count;
static stroll_t stroll;
static insole_walk_heading_t heading, other_heading;
static insole_walked_t walked[MOST_STEPS]; /* what the other one told of each step */
static insole_carry_t carry;
static insole_phone_gait_t gait;
static const insole_phone_guide_t guide = {&insole_phone_gait_calls, &gait};
static uint32_t strolled, windows;

static const double GENTLE_BOUNCE_M = 0.02, HARD_BOUNCE_M = 0.035;

static void begin_stroll(bool has_carry)
{
    stroll = stroll_in(STROLL_HAND, stroll_held(ASIDE_RAD, 0.3));
    stroll.heading_rad = 0.8;
    strolled = step_count = windows = 0u;
    ck_assert_int_eq(insole_walk_heading_init(&heading, &insole_walk_heading_defaults), INSOLE_OK);
    other_heading = heading;
    ck_assert_int_eq(insole_carry_init(&carry, &insole_carry_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_phone_gait_init(&gait, &gait_config, &heading,
                                            has_carry ? &carry : NULL, &HAND_FOREST),
                     INSOLE_OK);
    ck_assert_int_eq(insole_phone_walk_init(&walk, &config, &guide), INSOLE_OK);
}

static void set_up_stroll(int32_t faces)
{
    config = insole_phone_walk_defaults;
    config.step_length.model = INSOLE_STEP_LENGTH_CONSTANT;
    config.step_length.constant_m = (insole_real_t)HAND_STEP_M;
    gait_config = insole_phone_gait_defaults;
    gait_config.faces = faces;
    gait_config.gait = 0;
    gait_config.aside_rad = INSOLE_R(3.2);
    ck_assert_int_eq(insole_attitude_init(&attitude, &insole_attitude_defaults), INSOLE_OK);
    attitude.aligned = true;
}

static void take_steps(void)
{
    while (insole_phone_walk_next(&walk, &footfalls[step_count], &paces[step_count]) == INSOLE_OK) {
        (void)insole_walk_heading_step(&other_heading, &footfalls[step_count], &walked[step_count]);
        ck_assert_uint_lt(++step_count, MOST_STEPS);
    }
}

/* One sample; the attitude is the true one. @return whether a window of carry was looked at */
static bool stroll_once(void)
{
    d33_t R;
    d3_t accel;
    stroll_moment(&stroll, (double)strolled / STROLL_RATE_HZ, &R, &accel);
    insole_imu_t imu = {1000000u + strolled * (1000000u / STROLL_RATE_HZ),
                        real_of(stroll_force(R, accel)),
                        {0, 0, 0}};
    strolled++;
    attitude.q = quat_of(R);
    insole_sym3_t P = insole_attitude_covariance(&attitude);
    (void)insole_walk_heading_push(&other_heading, attitude.q, &P, imu.accel_mps2, imu.t_us);
    if (insole_phone_walk_push(&walk, &attitude, &imu) != INSOLE_OK) {
        ck_abort_msg("sample %u is not taken", strolled);
    }
    take_steps();
    bool looked = insole_phone_walk_work(&walk);
    windows += looked ? 1u : 0u;
    return looked;
}

static void stroll_on(double seconds)
{
    for (int i = 0; i < (int)lround(seconds * STROLL_RATE_HZ); i++) {
        (void)stroll_once();
    }
}

/* Until that position is told. */
static void stroll_until(int32_t position)
{
    for (int i = 0; walk.lie.position != position; i++) {
        ck_assert_int_lt(i, 10 * STROLL_RATE_HZ);
        (void)stroll_once();
    }
}

static double middle_s(uint32_t step)
{
    return 0.5e-6 * (double)(footfalls[step].begin_us + footfalls[step].end_us) - 1.0;
}

/* Told direction of a step less the true one. */
static double off_rad(uint32_t step)
{
    return remainder((double)paces[step].heading_rad - stroll_heading(&stroll, middle_s(step)),
                     2.0 * HAND_PI);
}

/* The mean over steps from..to lies by `expected` beside the way. */
static void expect_off(uint32_t from, uint32_t to, double expected, double tolerance)
{
    double x = 0.0, y = 0.0;
    ck_assert_uint_ge(to, from + 5u);
    for (uint32_t i = from; i < to; i++) {
        x += cos(off_rad(i) - expected);
        y += sin(off_rad(i) - expected);
    }
    ASSERT_NEAR(atan2(y, x), 0.0, tolerance, "rad");
    ASSERT_AT_LEAST(hypot(x, y) / (to - from), 0.97, ""); /* they agree */
}

static double known(void)
{
    return hypot((double)gait.askew.sum.cos, (double)gait.askew.sum.sin);
}

START_TEST(a_phone_in_any_way_goes_by_the_mean_of_the_gait)
{
    set_up_stroll(1);
    begin_stroll(false);
    stroll.turn_begin_s = 15.0;
    stroll.turn_end_s = 16.0;
    stroll.turn_rad = 1.8;
    stroll_on(1.0);
    ck_assert(!insole_phone_walk_is_directed(&walk));
    stroll_on(13.0);
    uint32_t before = step_count;
    stroll_on(12.0);
    ck_assert(insole_phone_walk_is_directed(&walk));
    expect_off(0u, before, 0.0, 0.2);
    expect_off(before, step_count, 0.0, 0.2);
    for (uint32_t i = 0u; i < step_count; i++) {
        ASSERT_AT_LEAST(paces[i].var_heading_rad2, 0.1 * 0.1 - 1e-6, "rad^2");
    }
    ASSERT_AT_MOST(paces[step_count - 1u].var_heading_rad2, 0.7 * (double)paces[0].var_heading_rad2,
                   "rad^2");
    insole_turn_t ahead = insole_phone_walk_ahead(&walk);
    ASSERT_NEAR(remainder(atan2((double)ahead.sin, (double)ahead.cos) - 2.6, 2.0 * HAND_PI), 0.0,
                0.2, "rad");
    ASSERT_NEAR(hypot((double)ahead.cos, (double)ahead.sin), 1.0, 1e-5, "");
}
END_TEST

/* A turn of the phone about the vertical is that of the walker: nothing is learned anew. */
START_TEST(turns_are_those_of_the_phone)
{
    set_up_stroll(1);
    begin_stroll(false);
    stroll_on(15.0);
    double before = known();
    stroll.turn_begin_s = 15.0;
    stroll.turn_end_s = 17.0;
    stroll.turn_rad = -2.5;
    uint32_t first = step_count;
    stroll_on(8.0);
    expect_off(first, step_count, 0.0, 0.2);
    ASSERT_AT_LEAST(known(), 0.5 * before, "1/rad^2");
}
END_TEST

START_TEST(by_the_step_it_has_the_direction_that_the_gait_told)
{
    uint32_t apart = 0u, uncertain = 0u;
    set_up_stroll(1);
    gait_config.gait = 1;
    begin_stroll(false);
    stroll_on(20.0);
    ck_assert_uint_ge(step_count, 30u);
    for (uint32_t i = 0u; i < step_count; i++) {
        insole_real_t known = walked[i].variance_rad2, unknown = INSOLE_HEADING_MOST_R2;
        apart += paces[i].heading_rad != walked[i].direction_rad;
        apart += paces[i].var_heading_rad2 != (walked[i].is_certain ? known : unknown);
        uncertain += walked[i].is_certain ? 0u : 1u;
    }
    ck_assert_uint_eq(apart, 0u);
    ck_assert(uncertain >= 1u && uncertain <= 5u); /* the first ones */
    expect_off(0u, step_count, 0.0, 0.2);
}
END_TEST

START_TEST(a_phone_that_faces_ahead_has_its_own_direction)
{
    set_up_stroll(0);
    gait_config.gait = _i;
    begin_stroll(false);
    stroll_on(15.0);
    expect_off(0u, step_count, ASIDE_RAD, 1e-3);
    ASSERT_NEAR(paces[step_count - 1u].var_heading_rad2, 0.07 * 0.07, 1e-6, "rad^2");
    ck_assert(insole_phone_walk_is_directed(&walk));
    insole_turn_t ahead = insole_phone_walk_ahead(&walk);
    ck_assert(ahead.cos == walk.ahead.cos && ahead.sin == walk.ahead.sin);
    ASSERT_AT_LEAST(known(), 1.0, "1/rad^2"); /* it has listened to the gait */
}
END_TEST

/* Then nobody knows where a step goes, and that is told. */
START_TEST(too_weak_a_gait_leaves_the_direction_unknown)
{
    insole_walk_heading_config_t deaf = insole_walk_heading_defaults;
    set_up_stroll(1);
    begin_stroll(false);
    deaf.least_mps2 = INSOLE_R(10.0);
    ck_assert_int_eq(insole_walk_heading_init(&heading, &deaf), INSOLE_OK);
    stroll_on(10.0);
    expect_off(0u, step_count, ASIDE_RAD, 1e-3);
    ASSERT_NEAR(paces[step_count - 1u].var_heading_rad2, INSOLE_HEADING_MOST_R2, 1e-5, "rad^2");
    ck_assert(!insole_phone_walk_is_directed(&walk));
}
END_TEST

/* It is tipped over by so much, from the pitch of 0.3 rad. */
typedef struct {
    double tipped_rad, by_rad;
    bool forgets;
} tip_t;

static const tip_t tips[] = {
    {0.9, 1.5, true}, {0.9, 0.7, false}, {2.0, 2.6, true}, {2.0, 1.5, false}, {3.2, 2.6, false}};

/* And points elsewhere after that. */
START_TEST(a_phone_tipped_over_is_learned_anew)
{
    const tip_t *tip = &tips[_i];
    const double then_rad = ASIDE_RAD - 1.0;
    bool forgot = false;
    set_up_stroll(1);
    gait_config.tipped_rad = (insole_real_t)tip->tipped_rad;
    begin_stroll(false);
    stroll_on(15.0);
    ASSERT_AT_LEAST(known(), 1.0, "1/rad^2");
    stroll.mounting = stroll_held(then_rad, 0.3 + tip->by_rad);
    for (int i = 0; i < 4 * STROLL_RATE_HZ; i++) {
        (void)stroll_once();
        forgot = forgot || known() <= 0.0;
    }
    ck_assert_int_eq(forgot, tip->forgets);
    if (tip->forgets && tip->by_rad < 2.0) {
        uint32_t first = step_count;
        stroll_on(6.0);
        expect_off(first, step_count, 0.0, 0.2);
    }
}
END_TEST

/* It points nearly back: the first step is taken as it comes, though its end is not certain yet. */
START_TEST(the_first_step_has_a_direction_however_the_phone_points)
{
    set_up_stroll(1);
    begin_stroll(false);
    stroll.mounting = stroll_held(2.8, 0.3);
    stroll_on(8.0);
    ck_assert(!walked[0].is_certain);
    expect_off(0u, step_count, 0.0, 0.2);
    ASSERT_NEAR(off_rad(0u), 0.0, 0.2, "rad");
}
END_TEST

/* Turned in its pocket, flat as it lies: a walker would turn so, and it takes until the steps
 * before are forgotten to see that none did. */
START_TEST(a_phone_turned_round_is_learned_anew)
{
    set_up_stroll(1);
    begin_stroll(false);
    stroll_on(15.0);
    stroll.mounting = stroll_held(ASIDE_RAD - 2.6, 0.3);
    stroll_on(8.0);
    uint32_t first = step_count;
    stroll_on(6.0);
    expect_off(first, step_count, 0.0, 0.2);
}
END_TEST

/* ---- by the position ---------------------------------------------------------------------- */

START_TEST(the_position_tells_whether_the_gait_is_asked)
{
    set_up_stroll(2);
    begin_stroll(true);
    stroll.bounce_m = GENTLE_BOUNCE_M;
    ck_assert_int_eq(walk.lie.position, INSOLE_CARRY_NONE);
    stroll_until(GENTLE);
    stroll_on(8.0);
    expect_off(0u, step_count, ASIDE_RAD, 1e-3);
    ASSERT_AT_LEAST(known(), 1.0, "1/rad^2");
    stroll.bounce_m = HARD_BOUNCE_M;
    stroll_until(HARD);
    ASSERT_NEAR(known(), 0.0, 0.0, "1/rad^2");
    ck_assert(!insole_phone_walk_is_directed(&walk));
    uint32_t hard = step_count;
    stroll_on(8.0);
    ck_assert(insole_phone_walk_is_directed(&walk));
    expect_off(hard, step_count, 0.0, 0.2);
    stroll.bounce_m = GENTLE_BOUNCE_M;
    stroll_until(GENTLE);
    ASSERT_NEAR(known(), 0.0, 0.0, "1/rad^2");
    uint32_t gentle = step_count;
    stroll_on(6.0);
    expect_off(gentle, step_count, ASIDE_RAD, 1e-3);
}
END_TEST

static void stroll_in_hand(double aside_rad, int32_t aside_steps)
{
    set_up_stroll(2);
    gait_config.aside_rad = INSOLE_R(0.8);
    gait_config.aside_steps = aside_steps;
    begin_stroll(true);
    stroll.mounting = stroll_held(aside_rad, 0.3);
    stroll.bounce_m = GENTLE_BOUNCE_M;
    stroll_until(GENTLE);
}

/* Not before so many steps, counted from where the position was told. */
START_TEST(a_phone_held_across_in_the_hand_is_noticed)
{
    const int32_t aside_steps = _i == 0 ? 7 : 12;
    stroll_in_hand(_i < 2 ? ASIDE_RAD : -ASIDE_RAD, aside_steps);
    uint32_t begin = step_count, now = begin;
    uint64_t begin_us = walk.t_us;
    for (int i = 0; i < 10 * STROLL_RATE_HZ; i++) {
        (void)stroll_once();
        now = walk.lie.is_aside ? now : step_count;
    }
    ck_assert(walk.lie.is_aside && walk.lie.is_askew && !walk.lie.is_ahead);
    ck_assert_int_ge((int32_t)(now - begin), aside_steps - 1);
    ck_assert_int_le((int32_t)(now - begin), aside_steps + 4); /* the end is to be certain, too */
    ck_assert(walk.lie.since_us + 1000000u > begin_us && walk.lie.since_us < walk.t_us);
    expect_off(begin, begin + (uint32_t)aside_steps - 1u, _i < 2 ? ASIDE_RAD : -ASIDE_RAD, 1e-3);
    expect_off(now + 1u, step_count, 0.0, 0.2);
}
END_TEST

START_TEST(a_phone_that_points_nearly_ahead_points_ahead)
{
    const double aside_rad = _i == 0 ? 0.2 : -0.6;
    stroll_in_hand(aside_rad, 3);
    stroll_on(12.0);
    ck_assert(!walk.lie.is_aside && !walk.lie.is_askew);
    expect_off(0u, step_count, aside_rad, 1e-3);
    ck_assert_int_eq(walk.lie.is_ahead, fabs(aside_rad) < 0.4); /* half of what is aside */
}
END_TEST

START_TEST(held_across_in_another_way_it_points_ahead_again)
{
    stroll_in_hand(ASIDE_RAD, 5);
    stroll_on(8.0);
    ck_assert(walk.lie.is_aside);
    stroll.mounting = stroll_held(0.0, 1.7);
    bool forgot = false;
    for (int i = 0; i < 3 * STROLL_RATE_HZ; i++) {
        (void)stroll_once();
        forgot = forgot || !walk.lie.is_aside;
    }
    ck_assert(forgot);
    stroll_on(8.0);
    ck_assert(!walk.lie.is_aside);
}
END_TEST

START_TEST(until_a_position_is_told_the_phone_points_ahead)
{
    set_up_stroll(2);
    begin_stroll(true);
    stroll.bounce_m = HARD_BOUNCE_M;
    stroll_until(HARD);
    uint32_t told = step_count;
    stroll_on(6.0);
    ck_assert_uint_ge(told, 5u);
    expect_off(0u, told, ASIDE_RAD, 1e-3);
    expect_off(told, step_count, 0.0, 0.2);
}
END_TEST

/* Whoever says how it lies is not asked where it is carried. */
START_TEST(what_is_told_counts_more_than_the_position)
{
    set_up_stroll(_i / 2);
    begin_stroll(true);
    stroll.bounce_m = _i % 2 == HARD ? HARD_BOUNCE_M : GENTLE_BOUNCE_M;
    stroll_until(_i % 2);
    stroll_on(5.0);
    expect_off(0u, step_count, gait_config.faces == 0 ? ASIDE_RAD : 0.0, _i < 2 ? 1e-3 : 0.2);
}
END_TEST

/* Position 1 of the table has settings of its own, if positions are asked. */
START_TEST(steps_follow_the_position)
{
    bool is_asked = _i == 2;
    set_up_stroll(_i);
    config.step_length = insole_step_length_defaults;
    gait_config.length_ear = INSOLE_R(1.5);
    gait_config.rise_ear = INSOLE_R(0.5);
    begin_stroll(true);
    stroll.bounce_m = HARD_BOUNCE_M;
    stroll_until(HARD);
    ASSERT_NEAR(walk.steps.config.rise_share, (is_asked ? 0.5 : 1.0) * 0.33, 1e-6, "");
    uint32_t told = step_count;
    stroll_on(5.0);
    ck_assert_uint_ge(step_count, told + 5u);
    for (uint32_t i = 0u; i < step_count; i++) {
        insole_real_t plain;
        ck_assert_int_eq(insole_step_length(&config.step_length, &footfalls[i], &plain), INSOLE_OK);
        double times = is_asked && i >= told ? 1.5 : 1.0;
        ASSERT_NEAR(paces[i].length_m, times * (double)plain, 1e-5, "m");
        ASSERT_NEAR(paces[i].var_length_m2, pow(0.15 * times * (double)plain, 2.0), 1e-5, "m^2");
    }
    stroll.bounce_m = GENTLE_BOUNCE_M;
    stroll_until(GENTLE);
    ASSERT_NEAR(walk.steps.config.rise_share, 0.33, 1e-6, "");
}
END_TEST

/* GENTLE and HARD in turn: with none that points ahead, and with the other one. */
START_TEST(which_position_points_ahead_is_a_setting)
{
    set_up_stroll(2);
    gait_config.ahead_position = _i < 2 ? -1 : HARD;
    begin_stroll(true);
    int32_t position = _i % 2;
    stroll.bounce_m = position == HARD ? HARD_BOUNCE_M : GENTLE_BOUNCE_M;
    stroll_until(position);
    uint32_t told = step_count;
    stroll_on(6.0);
    expect_off(told, step_count, position == gait_config.ahead_position ? ASIDE_RAD : 0.0, 0.2);
}
END_TEST

/* Windows are full after 2 s, 3 s, and so on. */
START_TEST(work_is_done_once_for_each_window)
{
    set_up_stroll(2);
    begin_stroll(true);
    for (int i = 0; i < 1000; i++) {
        if (stroll_once()) {
            ck_assert(!insole_phone_walk_work(&walk));
        }
    }
    ck_assert_uint_ge(windows, 8u);
    ck_assert_uint_le(windows, 9u);
    gait.forest = NULL;
    stroll_on(3.0);
    ck_assert_uint_le(windows, 9u);
}
END_TEST

/* A position without a gait to ask: the phone points ahead. */
START_TEST(without_a_gait_the_position_changes_nothing)
{
    set_up_stroll(1);
    begin_stroll(true);
    ck_assert_int_eq(insole_phone_gait_init(&gait, &gait_config, NULL, &carry, &HAND_FOREST),
                     INSOLE_OK);
    ck_assert_int_eq(insole_phone_walk_init(&walk, &config, &guide), INSOLE_OK);
    stroll.bounce_m = HARD_BOUNCE_M;
    stroll_until(HARD);
    stroll_on(3.0);
    expect_off(0u, step_count, ASIDE_RAD, 1e-3);
    ck_assert(insole_phone_walk_is_directed(&walk));
}
END_TEST

START_TEST(a_damaged_forest_is_refused)
{
    static const insole_carry_node_t LOOP[] = {{0, 0, 0, 0}};
    static const insole_carry_forest_t DAMAGED = {LOOP, HAND_ROOTS, HAND_NAMES, 1, 2};
    set_up_stroll(2);
    begin_stroll(true);
    stroll_on(3.0);
    ASSERT_UNCHANGED(gait, insole_phone_gait_init(&gait, &gait_config, &heading, &carry, &DAMAGED),
                     INSOLE_ERR_DATA);
    ck_assert_int_eq(insole_phone_gait_init(NULL, &gait_config, &heading, &carry, &HAND_FOREST),
                     INSOLE_ERR_NULL);
    /* one that is damaged later tells nothing, and the window waits */
    gait.forest = &DAMAGED;
    carry.window.is_new = true;
    ck_assert(!insole_phone_walk_work(&walk));
    ck_assert(carry.window.is_new);
    gait.forest = &HAND_FOREST;
    ck_assert(insole_phone_walk_work(&walk));
}
END_TEST

static insole_status_t judge(void)
{
    insole_phone_gait_t tried;
    return insole_phone_gait_init(&tried, &gait_config, NULL, NULL, NULL);
}

START_TEST(every_setting_has_its_range)
{
    insole_phone_gait_config_t *part = &gait_config;
    gait_config = insole_phone_gait_defaults;
    ck_assert_int_eq(judge(), INSOLE_OK);
    INSOLE_PHONE_GAIT_KEYS(SETTING_OF_PART_HAS_ENDS)
    ck_assert_int_eq(insole_phone_gait_check(NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(gait, insole_phone_gait_init(&gait, NULL, NULL, NULL, NULL), INSOLE_ERR_NULL);
    gait_config.gait_keep = (insole_real_t)NAN;
    ASSERT_UNCHANGED(gait, insole_phone_gait_init(&gait, &gait_config, NULL, NULL, NULL),
                     INSOLE_ERR_VALUE);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_gait");
    suite_add(suite, "settings", every_setting_has_its_range);
    suite_add(suite, "mean of the gait", a_phone_in_any_way_goes_by_the_mean_of_the_gait);
    suite_add(suite, "turns", turns_are_those_of_the_phone);
    suite_add(suite, "by the step", by_the_step_it_has_the_direction_that_the_gait_told);
    suite_add_loop(suite, "faces ahead", a_phone_that_faces_ahead_has_its_own_direction, 2);
    suite_add(suite, "weak gait", too_weak_a_gait_leaves_the_direction_unknown);
    suite_add_loop(suite, "tipped", a_phone_tipped_over_is_learned_anew,
                   (int)(sizeof tips / sizeof tips[0]));
    suite_add(suite, "first step", the_first_step_has_a_direction_however_the_phone_points);
    suite_add(suite, "turned round", a_phone_turned_round_is_learned_anew);
    suite_add_loop(suite, "across", a_phone_held_across_in_the_hand_is_noticed, 3);
    suite_add_loop(suite, "nearly ahead", a_phone_that_points_nearly_ahead_points_ahead, 2);
    suite_add(suite, "across no more", held_across_in_another_way_it_points_ahead_again);
    suite_add(suite, "position", the_position_tells_whether_the_gait_is_asked);
    suite_add(suite, "no position yet", until_a_position_is_told_the_phone_points_ahead);
    suite_add_loop(suite, "told", what_is_told_counts_more_than_the_position, 4);
    suite_add_loop(suite, "steps follow", steps_follow_the_position, 3);
    suite_add_loop(suite, "ahead position", which_position_points_ahead_is_a_setting, 4);
    suite_add(suite, "work", work_is_done_once_for_each_window);
    suite_add(suite, "no gait", without_a_gait_the_position_changes_nothing);
    suite_add(suite, "damaged forest", a_damaged_forest_is_refused);
    return suite;
}
