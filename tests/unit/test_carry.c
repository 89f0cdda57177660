/* SPDX-License-Identifier: MIT */
#include "insole/sense/carry.h"

#include "carry_walk.h"
#include "near.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"

enum { POINT_US = INSOLE_CARRY_GRID_US, WEAK = 0, STRONG = 1, SWUNG = 2 };

/* Positions that a variance tells: three trees agree far from 7 m^2/s^4 and two to one near it; a
 * fourth and a fifth know a swing by the level part. */
static const insole_carry_node_t NODES[] = {
    {INSOLE_R(6.0), 0, INSOLE_CARRY_LEAF(WEAK), INSOLE_CARRY_LEAF(STRONG)},
    {INSOLE_R(7.0), 0, INSOLE_CARRY_LEAF(WEAK), INSOLE_CARRY_LEAF(STRONG)},
    {INSOLE_R(8.0), 0, INSOLE_CARRY_LEAF(WEAK), INSOLE_CARRY_LEAF(STRONG)},
    {INSOLE_R(4.0), 6, 1, INSOLE_CARRY_LEAF(SWUNG)},
    {INSOLE_R(7.0), 0, INSOLE_CARRY_LEAF(WEAK), INSOLE_CARRY_LEAF(STRONG)}};
static const uint16_t ROOTS[] = {0, 1, 2, 3, 5};
static const char *const NAMES[] = {"weak", "strong", "swung"};
static const insole_carry_forest_t FOREST = {NODES, ROOTS, NAMES, 4, 3};

static const carry_gait_t WEAK_GAIT = {1.0, 1.5, 0.2, 0.1, 0.3, 0.0};
static const carry_gait_t STRONG_GAIT = {1.0, 6.0, 0.2, 0.1, 0.3, 0.0};
static const carry_gait_t REST = {1.0, 0.05, 0.0, 0.0, 0.3, 0.0};

static insole_carry_t carry;
static insole_carry_news_t news;
static uint64_t now_us;

static void begin(const insole_carry_config_t *config)
{
    now_us = 1000000u;
    ck_assert_int_eq(insole_carry_init(&carry, config), INSOLE_OK);
}

/* Three windows in a row tell a position. */
static void begin_three(void)
{
    insole_carry_config_t three = insole_carry_defaults;
    three.switch_windows = 3;
    begin(&three);
}

/* Walks for a second. @return what the window that it ends says */
static insole_status_t walk_one_second(const carry_gait_t *gait)
{
    for (int i = 0; i < INSOLE_CARRY_HALF; i++) {
        d3_t f = carry_force(gait, (double)now_us * 1e-6);
        insole_vec3_t accel =
            insole_vec3((insole_real_t)f.x, (insole_real_t)f.y, (insole_real_t)f.z);
        ck_assert(insole_carry_push(&carry, now_us, accel, NULL, NULL) == INSOLE_OK);
        now_us += POINT_US;
    }
    return insole_carry_next(&carry, &FOREST, &news);
}

static void expect(const carry_gait_t *gait, int32_t winner, int32_t told)
{
    ck_assert_int_eq(walk_one_second(gait), INSOLE_OK);
    ck_assert_int_eq(news.votes.winner, winner);
    ck_assert_int_eq(news.told, told);
    ck_assert_uint_eq(news.t_us, now_us - POINT_US);
}

static void settle(const carry_gait_t *gait, int32_t told)
{
    for (int i = 0; i < 5; i++) {
        walk_one_second(gait);
    }
    ck_assert_int_eq(news.told, told);
}

START_TEST(a_position_must_win_before_it_is_told)
{
    insole_carry_config_t config = insole_carry_defaults;
    config.switch_windows = _i;
    begin(&config);
    ck_assert_int_eq(walk_one_second(&WEAK_GAIT), INSOLE_ERR_STATE);
    for (int won = 1; won <= 6; won++) {
        expect(&WEAK_GAIT, WEAK, won >= _i ? WEAK : INSOLE_CARRY_NONE);
    }
    walk_one_second(&STRONG_GAIT); /* half of each */
    int told = news.told, first = news.votes.winner == STRONG ? 1 : 0;
    ck_assert_int_eq(told, first >= _i ? STRONG : WEAK);
    for (int won = first + 1; won <= first + 6; won++) {
        expect(&STRONG_GAIT, STRONG, won >= _i ? STRONG : WEAK);
    }
}
END_TEST

START_TEST(a_short_change_is_not_told)
{
    begin_three();
    settle(&WEAK_GAIT, WEAK);
    for (int n = 0; n < 5; n++) {
        walk_one_second(&STRONG_GAIT);
        ck_assert_int_eq(news.told, WEAK);
        walk_one_second(&WEAK_GAIT);
        ck_assert_int_eq(news.told, WEAK);
        expect(&WEAK_GAIT, WEAK, WEAK);
    }
}
END_TEST

/* 7.2 m^2/s^4 are strong for three trees of four, which is enough or not. */
START_TEST(a_window_is_won_by_a_share)
{
    static const double SHARES[] = {0.0, 0.5, 0.75, 0.76, 1.0};
    static const carry_gait_t BETWEEN = {1.0, 3.62, 0.2, 0.1, 0.3, 0.0};
    insole_carry_config_t config = insole_carry_defaults;
    config.min_share = (insole_real_t)SHARES[_i];
    begin(&config);
    walk_one_second(&BETWEEN);
    for (int i = 0; i < 5; i++) {
        ck_assert_int_eq(walk_one_second(&BETWEEN), INSOLE_OK);
        ASSERT_NEAR(news.votes.share[STRONG], 0.75, 0.0, "");
        ck_assert_int_eq(news.votes.winner, STRONG);
    }
    ck_assert_int_eq(news.told, _i < 3 ? STRONG : INSOLE_CARRY_NONE);
}
END_TEST

START_TEST(rest_keeps_the_position)
{
    begin_three();
    settle(&STRONG_GAIT, STRONG);
    walk_one_second(&REST);
    for (int i = 0; i < 10; i++) {
        expect(&REST, INSOLE_CARRY_NONE, STRONG);
        for (int k = 0; k < INSOLE_CARRY_CLASSES; k++) {
            ASSERT_NEAR(news.votes.share[k], 0.0, 0.0, "");
        }
    }
    insole_carry_config_t config = insole_carry_defaults;
    config.switch_windows = 3;
    config.still_mps2 = 0; /* off */
    begin(&config);
    walk_one_second(&REST);
    expect(&REST, WEAK, INSOLE_CARRY_NONE);
}
END_TEST

/* A pose that the table never saw: something of the table is told, and nothing breaks. */
START_TEST(a_pose_never_seen_is_taken_for_another)
{
    static const carry_gait_t JUGGLED = {0.41, 60.0, 80.0, 95.0, 0.3, 0.0};
    begin_three();
    walk_one_second(&JUGGLED);
    for (int i = 0; i < 10; i++) {
        ck_assert_int_eq(walk_one_second(&JUGGLED), INSOLE_OK);
        ck_assert(news.votes.winner >= 0 && news.votes.winner < 3);
    }
    ck_assert(news.told >= 0 && news.told < 3);
}
END_TEST

START_TEST(a_gap_keeps_the_position)
{
    begin_three();
    settle(&STRONG_GAIT, STRONG);
    now_us += 3600000000u;
    ck_assert_int_eq(walk_one_second(&WEAK_GAIT), INSOLE_ERR_STATE);
    expect(&WEAK_GAIT, WEAK, STRONG);
    expect(&WEAK_GAIT, WEAK, STRONG);
    expect(&WEAK_GAIT, WEAK, WEAK);
}
END_TEST

START_TEST(a_damaged_table_is_refused)
{
    static const insole_carry_node_t LOOP[] = {{0, 0, 0, 0}};
    static const uint16_t ONE_TREE[] = {0, 1};
    static const insole_carry_forest_t DAMAGED = {LOOP, ONE_TREE, NAMES, 1, 3};
    begin_three();
    settle(&STRONG_GAIT, STRONG);
    for (int i = 0; i < INSOLE_CARRY_HALF; i++) {
        insole_vec3_t accel = insole_vec3(0, 0, (insole_real_t)(9 + 5 * (i % 3)));
        insole_carry_push(&carry, now_us, accel, NULL, NULL);
        now_us += POINT_US;
    }
    ASSERT_UNCHANGED(carry, insole_carry_next(&carry, &DAMAGED, &news), INSOLE_ERR_DATA);
    ASSERT_UNCHANGED(carry, insole_carry_next(&carry, NULL, &news), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(carry, insole_carry_next(&carry, &FOREST, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_carry_next(&carry, &FOREST, &news), INSOLE_OK);
    ASSERT_UNCHANGED(carry, insole_carry_next(&carry, &FOREST, &news), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_carry_next(NULL, &FOREST, &news), INSOLE_ERR_NULL);
}
END_TEST

/* The window is gone then, and the position stays. */
START_TEST(a_table_about_turns_needs_a_gyroscope)
{
    static const insole_carry_node_t TURNS[] = {
        {INSOLE_R(0.1), INSOLE_CARRY_TURN, INSOLE_CARRY_LEAF(0), INSOLE_CARRY_LEAF(1)}};
    static const uint16_t ONE_TREE[] = {0, 1};
    static const insole_carry_forest_t TABLE = {TURNS, ONE_TREE, NAMES, 1, 2};
    begin_three();
    settle(&STRONG_GAIT, STRONG);
    walk_one_second(&STRONG_GAIT);
    for (int i = 0; i < INSOLE_CARRY_HALF; i++) {
        d3_t f = carry_force(&STRONG_GAIT, (double)now_us * 1e-6);
        insole_vec3_t accel = insole_vec3(0, 0, (insole_real_t)f.z);
        ck_assert(insole_carry_push(&carry, now_us, accel, NULL, NULL) == INSOLE_OK);
        now_us += POINT_US;
    }
    ck_assert_int_eq(insole_carry_next(&carry, &TABLE, &news), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_carry_next(&carry, &FOREST, &news), INSOLE_ERR_STATE);
    ck_assert_int_eq(carry.told, STRONG);
    for (int i = 0; i < 6 * INSOLE_CARRY_HALF; i++) {
        d3_t f = carry_force(&STRONG_GAIT, (double)now_us * 1e-6);
        insole_vec3_t accel = insole_vec3(0, 0, (insole_real_t)f.z);
        insole_vec3_t gyro = insole_vec3((insole_real_t)sin(5e-6 * (double)now_us), 0, 0);
        ck_assert(insole_carry_push(&carry, now_us, accel, &gyro, NULL) == INSOLE_OK);
        now_us += POINT_US;
        insole_status_t status = insole_carry_next(&carry, &TABLE, &news);
        ck_assert(status == INSOLE_OK || status == INSOLE_ERR_STATE);
    }
    ck_assert_int_eq(news.votes.winner, 1);
    ck_assert_int_eq(news.told, 1);
}
END_TEST

START_TEST(bad_samples_are_refused)
{
    insole_vec3_t good = insole_vec3(0, 0, 9), bad = insole_vec3(0, (insole_real_t)NAN, 9);
    begin_three();
    settle(&STRONG_GAIT, STRONG);
    ck_assert_int_eq(insole_carry_push(NULL, now_us, good, NULL, NULL), INSOLE_ERR_NULL);
    ASSERT_REFUSED(carry, carry.window.refused, insole_carry_push(&carry, now_us, bad, NULL, NULL),
                   INSOLE_ERR_VALUE);
    ASSERT_REFUSED(carry, carry.window.refused, insole_carry_push(&carry, now_us, good, NULL, &bad),
                   INSOLE_ERR_VALUE);
    ASSERT_REFUSED(carry, carry.window.refused,
                   insole_carry_push(&carry, now_us - POINT_US, good, NULL, NULL), INSOLE_ERR_TIME);
}
END_TEST

static insole_carry_config_t config;

static insole_status_t judge(void)
{
    insole_carry_t other;
    return insole_carry_init(&other, &config);
}

START_TEST(settings_have_ends)
{
    config = insole_carry_defaults;
    INSOLE_CARRY_KEYS(SETTING_HAS_ENDS)
    begin(&config);
    ck_assert_int_eq(insole_carry_init(NULL, &config), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(carry, insole_carry_init(&carry, NULL), INSOLE_ERR_NULL);
    config.switch_windows = 0;
    ASSERT_UNCHANGED(carry, insole_carry_init(&carry, &config), INSOLE_ERR_VALUE);
    insole_carry_features_t features = {0};
    ck_assert(insole_carry_is_still(&insole_carry_defaults, &features));
    ck_assert(!insole_carry_is_still(NULL, &features));
    ck_assert(!insole_carry_is_still(&insole_carry_defaults, NULL));
}
END_TEST

START_TEST(a_copy_goes_on_alike)
{
    begin_three();
    settle(&WEAK_GAIT, WEAK);
    walk_one_second(&STRONG_GAIT);
    insole_carry_t saved = carry;
    uint64_t saved_us = now_us;
    int32_t told[6];
    for (int i = 0; i < 6; i++) {
        walk_one_second(&STRONG_GAIT);
        told[i] = news.told;
    }
    carry = saved;
    now_us = saved_us;
    for (int i = 0; i < 6; i++) {
        expect(&STRONG_GAIT, STRONG, told[i]);
    }
    ck_assert_int_eq(told[0], WEAK);
    ck_assert_int_eq(told[5], STRONG);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("carry");
    TCase *wins = tcase_create("wins");
    tcase_add_loop_test(wins, a_position_must_win_before_it_is_told, 1, 6);
    suite_add_tcase(suite, wins);
    suite_add(suite, "short change", a_short_change_is_not_told);
    suite_add_loop(suite, "share", a_window_is_won_by_a_share, 5);
    suite_add(suite, "rest", rest_keeps_the_position);
    suite_add(suite, "never seen", a_pose_never_seen_is_taken_for_another);
    suite_add(suite, "gap", a_gap_keeps_the_position);
    suite_add(suite, "damage", a_damaged_table_is_refused);
    suite_add(suite, "gyroscope", a_table_about_turns_needs_a_gyroscope);
    suite_add(suite, "samples", bad_samples_are_refused);
    suite_add(suite, "settings", settings_have_ends);
    suite_add(suite, "copy", a_copy_goes_on_alike);
    return suite;
}
