/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_walk.h"

#include "hand_walk.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"

enum { MOST_STEPS = 100 };

static insole_phone_walk_config_t config;
static insole_phone_walk_t walk;
static insole_attitude_t attitude;
static insole_footfall_t footfalls[MOST_STEPS];
static insole_pace_t paces[MOST_STEPS];
static uint32_t step_count;

static insole_status_t judge(void)
{
    return insole_phone_walk_check(&config);
}

static void set_up_walk(void)
{
    config = insole_phone_walk_defaults;
    config.step_length.model = INSOLE_STEP_LENGTH_CONSTANT;
    config.step_length.constant_m = (insole_real_t)HAND_STEP_M;
    step_count = 0u;
    ck_assert_int_eq(insole_attitude_init(&attitude, &insole_attitude_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_phone_walk_init(&walk, &config, NULL), INSOLE_OK);
}

/* Samples from..to; what is told is kept. */
static void push(uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        (void)insole_attitude_push(&attitude, insole_attitude_ekf, &samples[i], 0u);
        (void)insole_phone_walk_push(&walk, &attitude, &samples[i]);
        while (insole_phone_walk_next(&walk, &footfalls[step_count], &paces[step_count]) ==
               INSOLE_OK) {
            ck_assert_uint_lt(++step_count, MOST_STEPS);
        }
    }
}

START_TEST(every_setting_has_its_range)
{
    config = insole_phone_walk_defaults;
    ck_assert_int_eq(judge(), INSOLE_OK);
    INSOLE_PHONE_WALK_KEYS(SETTING_HAS_ENDS)
    config.step.first_steps = 9;
    ck_assert_int_eq(judge(), INSOLE_ERR_VALUE);
    config = insole_phone_walk_defaults;
    config.step_length.max_m = INSOLE_R(-1.0);
    ck_assert_int_eq(judge(), INSOLE_ERR_VALUE);
}
END_TEST

/* n is the level frame in which the phone points along x at the start. */
START_TEST(steps_have_the_direction_of_the_phone_at_their_time)
{
    worst_t off = {0.0, 0.0};
    walk_legs(&usual_hand, L_SHAPE, 5);
    set_up_walk();
    push(0u, sample_count);
    ck_assert_uint_ge(step_count, 55u);
    ck_assert_uint_le(step_count, 57u);
    for (uint32_t i = 0u; i < step_count; i++) {
        uint64_t middle_us = (footfalls[i].begin_us + footfalls[i].end_us) / 2u;
        double t_s = 1e-6 * (double)(middle_us - samples[0].t_us);
        double turned = 1.5707963 * fmin(fmax(t_s - 20.0, 0.0), 1.0);
        worst_note(&off, fabs(remainder((double)paces[i].heading_rad - turned, 2.0 * HAND_PI)), i);
        ASSERT_NEAR(paces[i].length_m, HAND_STEP_M, 1e-6, "m");
        ASSERT_NEAR(paces[i].var_length_m2, pow(0.15 * HAND_STEP_M, 2.0), 1e-5, "m^2");
        ASSERT_AT_LEAST(paces[i].var_heading_rad2, 0.07 * 0.07 - 1e-6, "rad^2");
    }
    ASSERT_WORST(off, 0.12, "rad"); /* slots of 0.1 s within a turn of 1.57 rad/s */
}
END_TEST

/* What is shown right before the first steps are told is their way, but for the newest. */
START_TEST(what_is_shown_becomes_what_is_told)
{
    insole_spot_t shown = {INSOLE_R(0.0), INSOLE_R(0.0)}, told = shown;
    walk_legs(&usual_hand, STRAIGHT, 3);
    set_up_walk();
    for (uint32_t i = 0u; step_count == 0u; i++) {
        ck_assert_uint_lt(i, sample_count);
        shown = walk.shown;
        push(i, i + 1u);
    }
    for (uint32_t i = 0u; i < step_count; i++) {
        told = insole_spot_add(told, insole_pace_way(&paces[i], INSOLE_R(0.0)));
    }
    insole_spot_t apart = insole_spot_sub(told, shown);
    ck_assert_uint_ge(step_count, 4u);
    ASSERT_AT_MOST(insole_spot_norm(apart), 1.02 * HAND_STEP_M, "m");
    ASSERT_AT_LEAST(insole_spot_norm(shown), 2.9 * HAND_STEP_M, "m");
    ASSERT_NEAR(walk.shown.x_m, 0.0, 0.0, "m");
    insole_spot_t since = insole_phone_walk_since(&walk, 0u);
    ASSERT_NEAR(since.x_m, told.x_m, 1e-4, "m");
    ASSERT_NEAR(since.y_m, told.y_m, 1e-4, "m");
}
END_TEST

/* From a time within the steps that are shown, the last one told lies behind. */
START_TEST(since_goes_backwards_over_what_is_only_shown)
{
    walk_legs(&usual_hand, STRAIGHT, 3);
    set_up_walk();
    for (uint32_t i = 0u; walk.steps.held < 3u; i++) {
        ck_assert_uint_lt(i, sample_count);
        push(i, i + 1u);
    }
    insole_spot_t since = insole_phone_walk_since(&walk, UINT64_MAX);
    ASSERT_NEAR(since.x_m, -(double)walk.shown.x_m, 1e-6, "m");
    ASSERT_NEAR(since.y_m, -(double)walk.shown.y_m, 1e-6, "m");
    ASSERT_AT_LEAST(walk.shown.x_m, 2.9 * HAND_STEP_M, "m");
    since = insole_phone_walk_since(&walk, 0u);
    ASSERT_NEAR(insole_spot_norm(since), 0.0, 1e-6, "m");
}
END_TEST

START_TEST(without_a_guide_it_points_ahead)
{
    walk_legs(&usual_hand, STRAIGHT, 3);
    set_up_walk();
    push(0u, 1000u);
    insole_turn_t ahead = insole_phone_walk_ahead(&walk);
    ck_assert(ahead.cos == walk.ahead.cos && ahead.sin == walk.ahead.sin);
    ck_assert_int_eq(walk.lie.position, INSOLE_PHONE_NO_POSITION);
    ck_assert(!insole_phone_walk_work(&walk));
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    insole_footfall_t footfall;
    insole_pace_t pace;
    walk_legs(&usual_hand, STRAIGHT, 3);
    set_up_walk();
    push(0u, 700u);
    insole_imu_t bad = samples[700];
    ck_assert_int_eq(insole_phone_walk_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_walk_init(NULL, &config, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_walk_push(NULL, &attitude, &bad), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_walk_next(NULL, &footfall, &pace), INSOLE_ERR_NULL);
    ck_assert(!insole_phone_walk_work(NULL));
    ASSERT_UNCHANGED(walk, insole_phone_walk_init(&walk, NULL, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(walk, insole_phone_walk_push(&walk, NULL, &bad), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(walk, insole_phone_walk_push(&walk, &attitude, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(walk, insole_phone_walk_next(&walk, NULL, &pace), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(walk, insole_phone_walk_next(&walk, &footfall, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(walk, insole_phone_walk_next(&walk, &footfall, &pace), INSOLE_ERR_STATE);
    config.sigma_ahead_rad = (insole_real_t)NAN;
    ASSERT_UNCHANGED(walk, insole_phone_walk_init(&walk, &config, NULL), INSOLE_ERR_VALUE);
    bad.accel_mps2.x = (insole_real_t)NAN;
    ck_assert_int_eq(insole_phone_walk_push(&walk, &attitude, &bad), INSOLE_ERR_VALUE);
}
END_TEST

/* ---- the guide: what it is asked, and what becomes of its answers -------------------------- */

typedef struct {
    uint32_t begun, samples, steps, works;
    uint64_t before_us; /* what the walk held for the time of the sample before */
    bool tells, has_work;
} fake_t;

static fake_t fake;

static void fake_begin(void *state, insole_phone_walk_t *w)
{
    ((fake_t *)state)->begun++;
    w->lie.is_askew = true;
}

static void fake_push(void *state, insole_phone_walk_t *w, const insole_attitude_t *att,
                      const insole_imu_t *imu)
{
    fake_t *f = state;
    ck_assert_uint_eq(att->t_us, imu->t_us);
    ck_assert(f->samples == 0u || w->t_us == f->before_us);
    f->before_us = imu->t_us;
    f->samples++;
}

static bool fake_step(void *state, insole_phone_walk_t *w, const insole_footfall_t *footfall,
                      insole_pace_t *pace)
{
    fake_t *f = state;
    ck_assert_uint_lt(footfall->begin_us, footfall->end_us);
    f->steps++;
    w->lie.is_known = true;
    w->lie.askew_rad = INSOLE_R(0.5);
    w->lie.askew = insole_turn(INSOLE_R(0.5));
    w->lie.var_rad2 = INSOLE_R(0.25);
    if (f->tells) {
        pace->heading_rad = INSOLE_R(-1.25);
        pace->var_heading_rad2 = INSOLE_R(0.125);
    }
    return f->tells;
}

static bool fake_work(void *state, insole_phone_walk_t *w)
{
    fake_t *f = state;
    f->works++;
    w->lie.length = INSOLE_R(1.5);
    w->lie.rise = INSOLE_R(0.5);
    return f->has_work;
}

static const insole_phone_guide_calls_t FAKE_CALLS = {fake_begin, fake_push, fake_step, fake_work};

/* Walks with a guide; 1 s of rest, then steps. */
static void walk_guided(bool tells)
{
    const insole_phone_guide_t guide = {&FAKE_CALLS, &fake};
    walk_legs(&usual_hand, STRAIGHT, 3);
    set_up_walk();
    fake = (fake_t){.tells = tells};
    ck_assert_int_eq(insole_phone_walk_init(&walk, &config, &guide), INSOLE_OK);
    ck_assert(!insole_phone_walk_is_directed(&walk));
    push(0u, sample_count);
}

START_TEST(a_guide_is_asked_about_each_sample_and_step)
{
    walk_guided(_i == 1);
    ck_assert_uint_eq(fake.begun, 1u);
    ck_assert_uint_ge(fake.samples + 10u, sample_count); /* but before the attitude is known */
    ck_assert_uint_ge(step_count, 10u);
    ck_assert_uint_eq(fake.steps, step_count);
    ck_assert(insole_phone_walk_is_directed(&walk));
}
END_TEST

START_TEST(steps_go_where_the_guide_says)
{
    walk_guided(false);
    for (uint32_t i = 0u; i < step_count; i++) {
        ASSERT_NEAR(paces[i].heading_rad, 0.5, 0.12, "rad");
        ASSERT_NEAR(paces[i].var_heading_rad2, (double)walk.yaw_rad2 + 0.25, 0.01, "rad^2");
    }
    insole_turn_t points = walk.ahead, goes = insole_phone_walk_ahead(&walk);
    double turned =
        atan2((double)goes.sin, (double)goes.cos) - atan2((double)points.sin, (double)points.cos);
    ASSERT_NEAR(remainder(turned, 2.0 * HAND_PI), 0.5, 1e-5, "rad");
}
END_TEST

START_TEST(a_guide_may_tell_the_direction_of_a_step_itself)
{
    walk_guided(true);
    for (uint32_t i = 0u; i < step_count; i++) {
        ASSERT_NEAR(paces[i].heading_rad, -1.25, 0.0, "rad");
        ASSERT_NEAR(paces[i].var_heading_rad2, 0.125, 0.0, "rad^2");
    }
}
END_TEST

START_TEST(steps_are_as_the_guide_says_after_its_work)
{
    walk_guided(false);
    insole_real_t rise = config.step.rise_share;
    ck_assert(!insole_phone_walk_work(&walk));
    ASSERT_NEAR(walk.steps.config.rise_share, (double)rise, 0.0, "");
    fake.has_work = true;
    ck_assert(insole_phone_walk_work(&walk));
    ck_assert_uint_eq(fake.works, 2u);
    ASSERT_NEAR(walk.steps.config.rise_share, 0.5 * (double)rise, 1e-7, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_walk");
    suite_add(suite, "settings", every_setting_has_its_range);
    suite_add(suite, "direction", steps_have_the_direction_of_the_phone_at_their_time);
    suite_add(suite, "shown and told", what_is_shown_becomes_what_is_told);
    suite_add(suite, "since", since_goes_backwards_over_what_is_only_shown);
    suite_add(suite, "points ahead", without_a_guide_it_points_ahead);
    suite_add(suite, "bad arguments", bad_arguments_are_refused);
    suite_add_loop(suite, "guide", a_guide_is_asked_about_each_sample_and_step, 2);
    suite_add(suite, "guided", steps_go_where_the_guide_says);
    suite_add(suite, "guide tells", a_guide_may_tell_the_direction_of_a_step_itself);
    suite_add(suite, "guide works", steps_are_as_the_guide_says_after_its_work);
    return suite;
}
