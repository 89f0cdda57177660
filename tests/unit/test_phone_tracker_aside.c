/* SPDX-License-Identifier: MIT
 * The whole tracker with a phone that is held across, or turned in the hand. */
#include "insole/track/phone_tracker.h"

#include "hand_walk.h"
#include "stroll.h"
#include "suite.h"

/* A step of the stroll. */
#define STEP_M (0.55 * 1.3)

/* One step more or less at either end of a walk, and half of one that is under way. */
#define STEPS_OFF_M (1.5 * STEP_M)

#define STAND_S     3.0
#define NEVER_S     1.0e9
#define HAND_TURN_S 1.0

static rig_t rig;

/* Time counts from the first step. */
typedef struct {
    double aside_rad[3]; /* where the phone points beside the way, to the left */
    double from_s[3];    /* of each: then the hand begins to turn the phone from the one before */
    double walk_s, corner_s, corner_rad;
    double raised_rad[3]; /* beside the usual */
    double hard_s;        /* until then the steps are those of another carrying position */
} grip_t;

static const double START_X_M = 5.0, START_Y_M = 5.0, START_RAD = 0.5;

/* One of the two angles at a time. */
static double angle_at(const grip_t *grip, const double rad[3], double t_s)
{
    double sum = rad[0];
    for (int i = 1; i < 3; i++) {
        double share = fmin(fmax((t_s - grip->from_s[i]) / HAND_TURN_S, 0.0), 1.0);
        sum += (rad[i] - rad[i - 1]) * share * share * (3.0 - 2.0 * share);
    }
    return sum;
}

static bool is_walking(const grip_t *grip, double t_s)
{
    return t_s > 0.0 && t_s < grip->walk_s;
}

static stroll_t stroll_at(const grip_t *grip, double t_s)
{
    double aside_rad = angle_at(grip, grip->aside_rad, t_s);
    double raised_rad = 0.5 + angle_at(grip, grip->raised_rad, t_s);
    stroll_t s = stroll_in(STROLL_HAND, stroll_held(aside_rad, raised_rad));
    s.heading_rad = START_RAD;
    s.turn_begin_s = grip->corner_s;
    s.turn_end_s = grip->corner_s + 1.0;
    s.turn_rad = grip->corner_rad;
    s.bounce_m = t_s < grip->hard_s ? 0.035 : s.bounce_m;
    if (!is_walking(grip, t_s)) {
        s.bounce_m = s.sway_m = 0.0;
    }
    return s;
}

/* What the phone feels of an interval at whose end it is at `t_s`; noises of good sensors. */
static insole_imu_t feel(phone_t *p, const stroll_t *s, double t_s, double dt_s)
{
    d3_t accel;
    d33_t before = p->R;
    stroll_moment(s, t_s, &p->R, &accel);
    d3_t turn = d33_apply(d33_transpose(p->R), turn_between(before, p->R));
    d3_t gyro = d3_add(d3_scale(turn, 1.0 / dt_s), 0.01, phone_noise(p, 1.0));
    d3_t force = d3_add(stroll_force(p->R, accel), 0.05, phone_noise(p, 1.0));
    p->t_us += 1000000u / HAND_RATE_HZ;
    insole_imu_t imu = {p->t_us, real_of(force), real_of(gyro)};
    return imu;
}

/* Fills the samples, readings of the compass, and truth of hand_walk.h. */
static void walk_gripping(const grip_t *grip)
{
    const double dt_s = 1.0 / HAND_RATE_HZ;
    stroll_t s = stroll_at(grip, -STAND_S);
    phone_t p = phone(d33_mul(turn_z(START_RAD), s.mounting), 5u);
    double x_m = START_X_M, y_m = START_Y_M;
    sample_count = mag_count = scan_count = 0u;
    for (double t_s = -STAND_S + dt_s; t_s < grip->walk_s + STAND_S; t_s += dt_s) {
        s = stroll_at(grip, t_s);
        double rad = stroll_heading(&s, t_s - 0.5 * dt_s);
        double way_m = is_walking(grip, t_s) ? s.speed_mps * dt_s : 0.0;
        x_m += way_m * cos(rad);
        y_m += way_m * sin(rad);
        insole_imu_t imu = feel(&p, &s, t_s, dt_s);
        note_sample(&p, imu, x_m, y_m, rad);
    }
}

static uint32_t sample_at(double t_s)
{
    return (uint32_t)lround((t_s + STAND_S) * HAND_RATE_HZ) - 1u;
}

static rig_case_t case_of(const grip_t *grip)
{
    hand_t hand = {.x_m = START_X_M, .y_m = START_Y_M, .heading_rad = START_RAD};
    walk_gripping(grip);
    rig_case_t c = usual_case(&hand);
    c.forest = &HAND_FOREST;
    c.config.walk.step_length.constant_m = (insole_real_t)STEP_M;
    return c;
}

/* Found by fixes, from scans that scatter so much. */
static rig_case_t searching_case(const grip_t *grip, double sigma_db)
{
    rig_case_t c = case_of(grip);
    hear_on_the_way(1.0, sigma_db);
    c.has_start = false;
    c.hears = true;
    return c;
}

/* ---- what is seen of a run ---------------------------------------------------------------- */

/* When the carrying position was told; when it was that the phone points aside, and the offset
 * then and at the sample before. */
typedef struct {
    uint32_t placed, noticed; /* fixes */
    double offset_before_rad, offset_rad;
} notice_t;

static double offset_now(void)
{
    insole_phone_answer_t known;
    ck_assert_int_eq(insole_phone_place_answer(&rig.phone.place, rig.phone.t_us, &known),
                     INSOLE_OK);
    return (double)known.at.offset_rad;
}

static notice_t run_watching(const rig_case_t *c)
{
    notice_t seen = {0u, 0u, 0.0, 0.0};
    set_up(&rig, c);
    for (uint32_t i = 0u; i < sample_count; i++) {
        double offset_rad = offset_now();
        run(&rig, c, i, i + 1u);
        if (seen.placed == 0u && rig.phone.walk.lie.position == HAND_GENTLE) {
            seen.placed = fix_count - 1u;
        }
        if (seen.noticed == 0u && rig.phone.walk.lie.is_aside) {
            seen.noticed = fix_count - 1u;
            seen.offset_before_rad = offset_rad;
            seen.offset_rad = offset_now();
        }
    }
    finish(&rig);
    ck_assert_uint_gt(seen.noticed, 0u);
    return seen;
}

static double apart(double a_rad, double b_rad)
{
    return fabs(remainder(a_rad - b_rad, 2.0 * HAND_PI));
}

/* Where the phone says that its walker goes, less where he does, at the worst of two times. */
static double worst_heading(double from_s, double to_s)
{
    double most = 0.0;
    for (uint32_t i = sample_at(from_s); i < sample_at(to_s); i++) {
        most = fmax(most, apart((double)fixes[i].heading_rad, truth_rad[i]));
    }
    return most;
}

/* By how much the way from one time to another is wrong, wherever it began. */
static double way_error(double from_s, double to_s)
{
    uint32_t a = sample_at(from_s), b = sample_at(to_s);
    double x_m = (double)(fixes[b].position_m.x - fixes[a].position_m.x);
    double y_m = (double)(fixes[b].position_m.y - fixes[a].position_m.y);
    return hypot(x_m - truth_x_m[b] + truth_x_m[a], y_m - truth_y_m[b] + truth_y_m[a]);
}

/* ---- from the start ----------------------------------------------------------------------- */

static const double ASIDES_RAD[] = {1.57, -1.57, 1.3, -2.1};
enum { ASIDES = 4 };

/* For so long, and about a corner long after the phone has been noticed. */
static grip_t held(double aside_rad)
{
    const grip_t grip = {
        {aside_rad, aside_rad, aside_rad}, {0.0, NEVER_S, NEVER_S}, 30.0, 20.0, -1.2, {0.0}, 0.0};
    return grip;
}

/* Yaw of n counts from where the phone points: what it means on the map is plain. */
static double true_offset(double aside_rad)
{
    return START_RAD + aside_rad;
}

/* The first steps give the offset, and it holds the angle: until that is known, and from then on,
 * the way is right. A compass says the same. */
START_TEST(a_direction_that_was_told_is_kept)
{
    const double aside_rad = ASIDES_RAD[_i % ASIDES];
    grip_t grip = held(aside_rad);
    rig_case_t c = case_of(&grip);
    c.sees = _i >= ASIDES;
    notice_t seen = run_watching(&c);
    ck_assert_uint_lt(seen.noticed, sample_at(15.0));
    ck_assert_uint_eq(rig.phone.place.starts, 2u);
    ASSERT_NEAR(apart(seen.offset_before_rad, START_RAD), 0.0, 0.05, "rad");
    ASSERT_NEAR(apart(seen.offset_rad, true_offset(aside_rad)), 0.0, 0.1, "rad");
    ASSERT_AT_MOST(worst_error(0u, fix_count), 2.0 * STEP_M, "m");
    ASSERT_AT_MOST(error_at_end(), STEPS_OFF_M, "m");
    ASSERT_AT_MOST(worst_heading(0.0, 18.0), 0.1, "rad");
    ASSERT_AT_MOST(worst_heading(24.0, 32.0), 0.1, "rad");
}
END_TEST

/* The compass gives the offset, and the way goes aside until that is known: then the steps since
 * the carrying position was told are walked anew, those of before are not. */
START_TEST(a_compass_is_kept_and_the_way_is_walked_anew)
{
    const double aside_rad = ASIDES_RAD[_i % ASIDES], chord = 2.0 * sin(0.5 * fabs(aside_rad));
    grip_t grip = held(aside_rad);
    rig_case_t c = case_of(&grip);
    c.start.has_heading = false;
    c.sees = true;
    c.filter = _i < ASIDES ? &insole_step_ekf_calls : &insole_step_kf_calls;
    notice_t seen = run_watching(&c);
    ck_assert_uint_eq(rig.phone.place.starts, 2u);
    ASSERT_NEAR(apart(seen.offset_before_rad, true_offset(aside_rad)), 0.0, 0.05, "rad");
    ASSERT_NEAR(apart(seen.offset_rad, true_offset(aside_rad)), 0.0, 0.05, "rad");
    double placed_m = 0.01 * 1.3 * (double)(seen.placed - sample_at(0.0));
    double noticed_m = 0.01 * 1.3 * (double)(seen.noticed - sample_at(0.0));
    ASSERT_NEAR(error_of(seen.noticed - 1u), chord * noticed_m, STEPS_OFF_M * chord, "m");
    ASSERT_NEAR(error_at_end(), chord * placed_m, STEPS_OFF_M * chord, "m");
    ASSERT_AT_MOST(way_error(15.0, 31.0), 2.0 * STEPS_OFF_M, "m");
    ASSERT_AT_MOST(worst_heading(24.0, 32.0), 0.1, "rad");
}
END_TEST

/* ---- later -------------------------------------------------------------------------------- */

/* Nobody but the gait can tell it from a walker's turn, so it takes some 30 steps; but a phone that
 * had pointed ahead had an offset that was right, and from then on the way is right again. */
START_TEST(held_across_later_the_offset_is_kept)
{
    const double aside_rad = ASIDES_RAD[_i % ASIDES];
    grip_t grip = {
        {0.0, aside_rad, aside_rad}, {0.0, 25.0, NEVER_S}, 70.0, NEVER_S, 0.0, {0.0}, 0.0};
    rig_case_t c = case_of(&grip);
    c.sees = _i >= ASIDES;
    c.start.has_heading = _i < 2 * ASIDES;
    notice_t seen = run_watching(&c);
    ck_assert_uint_eq(rig.phone.place.starts, 2u);
    ck_assert_uint_gt(seen.noticed, sample_at(25.0));
    ck_assert_uint_lt(seen.noticed, sample_at(50.0));
    ck_assert(rig.phone.walk.lie.is_aside);
    ASSERT_NEAR(apart(seen.offset_before_rad, START_RAD), 0.0, 0.05, "rad");
    ASSERT_NEAR(apart(seen.offset_rad, seen.offset_before_rad), 0.0, 1e-5, "rad");
    ASSERT_AT_MOST(error_of(sample_at(24.9)), STEPS_OFF_M, "m");
    ASSERT_AT_MOST(error_of(seen.noticed), 0.75 * error_of(seen.noticed - 1u), "m");
    ASSERT_AT_MOST(way_error(60.0, 72.0), 2.0 * STEPS_OFF_M, "m");
    ASSERT_AT_MOST(worst_heading(60.0, 70.0), 0.15, "rad");
}
END_TEST

/* ---- and back ----------------------------------------------------------------------------- */

/* Whether it was across from the start, where the offset was turned, or later, where it was kept.
 */
START_TEST(back_again_it_points_ahead_with_the_same_offset)
{
    const double aside_rad = ASIDES_RAD[_i % ASIDES], first_rad = _i < ASIDES ? 0.0 : aside_rad;
    grip_t grip = {{first_rad, aside_rad, 0.0}, {0.0, 25.0, 60.0}, 100.0, NEVER_S, 0.0, {0.0}, 0.0};
    rig_case_t c = case_of(&grip);
    notice_t seen = run_watching(&c);
    ck_assert(!rig.phone.walk.lie.is_aside && !rig.phone.walk.lie.is_askew);
    ck_assert_uint_eq(rig.phone.place.starts, 2u);
    ASSERT_NEAR(apart(seen.offset_rad, true_offset(first_rad)), 0.0, 0.1, "rad");
    ASSERT_NEAR(apart(offset_now(), seen.offset_rad), 0.0, 1e-5, "rad");
    ASSERT_AT_MOST(way_error(85.0, 102.0), 2.0 * STEPS_OFF_M, "m");
    ASSERT_AT_MOST(worst_heading(85.0, 100.0), 0.1, "rad");
}
END_TEST

/* ---- an offset that was right ------------------------------------------------------------- */

/* Tipped over and held across on the other side: what had turned the offset is forgotten, and the
 * second time it is kept. */
START_TEST(an_offset_is_turned_only_once)
{
    const double aside_rad = ASIDES_RAD[_i];
    grip_t grip = {{aside_rad, -aside_rad, -aside_rad},
                   {0.0, 20.0, NEVER_S},
                   60.0,
                   NEVER_S,
                   0.0,
                   {0.0, -1.5, -1.5},
                   0.0};
    rig_case_t c = case_of(&grip);
    notice_t seen = run_watching(&c);
    ck_assert(rig.phone.walk.lie.is_aside);
    ck_assert_uint_eq(rig.phone.place.starts, 3u);
    ASSERT_NEAR(apart(seen.offset_rad, true_offset(aside_rad)), 0.0, 0.1, "rad");
    ASSERT_NEAR(apart(offset_now(), seen.offset_rad), 0.0, 1e-5, "rad");
    ASSERT_AT_MOST(way_error(45.0, 62.0), 2.0 * STEPS_OFF_M, "m");
}
END_TEST

/* A start that was told while the gait directed the steps did not trust the pointing. */
START_TEST(an_offset_of_steps_by_the_gait_is_kept)
{
    const double aside_rad = ASIDES_RAD[_i];
    grip_t grip = held(aside_rad);
    grip.walk_s = 60.0;
    grip.corner_rad = 0.0;
    grip.hard_s = 20.0;
    rig_case_t c = case_of(&grip);
    uint32_t at = sample_at(15.0);
    c.start.t_us = samples[at].t_us;
    c.start.x_m = (insole_real_t)truth_x_m[at];
    c.start.y_m = (insole_real_t)truth_y_m[at];
    notice_t seen = run_watching(&c);
    ck_assert_uint_gt(seen.noticed, seen.placed);
    ck_assert_uint_gt(seen.placed, sample_at(20.0));
    ASSERT_NEAR(apart(seen.offset_rad, true_offset(aside_rad)), 0.0, 0.1, "rad");
    ASSERT_NEAR(apart(seen.offset_before_rad, seen.offset_rad), 0.0, 1e-5, "rad");
    ASSERT_AT_MOST(worst_error(at, sample_at(20.0)), 2.0 * STEPS_OFF_M, "m");
    ASSERT_AT_MOST(error_at_end(), 2.0 * STEPS_OFF_M, "m");
}
END_TEST

START_TEST(what_lay_in_the_memory_before_is_not_trusted)
{
    grip_t grip = held(1.57);
    rig_case_t c = case_of(&grip);
    set_up(&rig, &c);
    insole_phone_parts_t parts = rig.phone.parts;
    memset(&rig.phone, 1, sizeof rig.phone);
    ck_assert_int_eq(insole_phone_tracker_init(&rig.phone, &c.config, &parts, NULL), INSOLE_OK);
    ck_assert(!rig.phone.trusts_pointing && rig.phone.starts == 0u);
}
END_TEST

/* ---- started by fixes --------------------------------------------------------------------- */

static void expect_found(double aside_rad)
{
    ck_assert(rig.phone.walk.lie.is_aside);
    ck_assert_int_eq(fixes[fix_count - 1u].state, INSOLE_FIX_TRACK);
    ASSERT_NEAR(apart(offset_now(), true_offset(aside_rad)), 0.0, 0.15, "rad");
    ASSERT_AT_MOST(worst_error(sample_at(18.0), fix_count), 4.0, "m");
    ASSERT_AT_MOST(worst_heading(24.0, 32.0), 0.15, "rad");
}

/* Fixes that are not yet sure of the direction: what they told of it was of another one. */
START_TEST(a_search_begins_anew)
{
    const insole_step_filter_calls_t *filters[] = {&insole_step_ekf_calls, &insole_step_kf_calls,
                                                   &insole_ml_shift_calls};
    const double aside_rad = ASIDES_RAD[_i % ASIDES];
    grip_t grip = held(aside_rad);
    rig_case_t c = searching_case(&grip, 3.0);
    c.filter = filters[_i / ASIDES];
    notice_t seen = run_watching(&c);
    ck_assert_uint_eq(rig.phone.place.starts, 1u);
    ck_assert_int_eq(fixes[seen.noticed].state, INSOLE_FIX_SEARCH);
    expect_found(aside_rad);
}
END_TEST

/* Fixes have shown the way before, and the offset that they found holds the angle. */
START_TEST(an_offset_that_fixes_found_is_turned)
{
    const double aside_rad = ASIDES_RAD[_i];
    grip_t grip = held(aside_rad);
    rig_case_t c = searching_case(&grip, 1.0);
    c.config.auto_start.refine_rad = INSOLE_R(3.2); /* after five fixes */
    notice_t seen = run_watching(&c);
    ck_assert_uint_eq(rig.phone.place.starts, 2u);
    ASSERT_NEAR(apart(seen.offset_before_rad, START_RAD), 0.0, 0.4, "rad");
    expect_found(aside_rad);
}
END_TEST

/* The first fix is directed by the compass: the way since went aside. */
START_TEST(a_start_by_fixes_and_compass_is_walked_anew)
{
    const double aside_rad = ASIDES_RAD[_i];
    grip_t grip = held(aside_rad);
    rig_case_t c = searching_case(&grip, 3.0);
    c.sees = true;
    notice_t seen = run_watching(&c);
    ck_assert_uint_eq(rig.phone.place.starts, 2u);
    ASSERT_AT_MOST(error_of(seen.noticed), 0.5 * error_of(seen.noticed - 1u), "m");
    expect_found(aside_rad);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_tracker_aside");
    suite_add_loop(suite, "told", a_direction_that_was_told_is_kept, 2 * ASIDES);
    suite_add_loop(suite, "compass", a_compass_is_kept_and_the_way_is_walked_anew, 2 * ASIDES);
    suite_add_loop(suite, "later", held_across_later_the_offset_is_kept, 3 * ASIDES);
    suite_add_loop(suite, "back", back_again_it_points_ahead_with_the_same_offset, 2 * ASIDES);
    suite_add_loop(suite, "once", an_offset_is_turned_only_once, ASIDES);
    suite_add_loop(suite, "by the gait", an_offset_of_steps_by_the_gait_is_kept, ASIDES);
    suite_add(suite, "memory", what_lay_in_the_memory_before_is_not_trusted);
    suite_add_loop(suite, "search", a_search_begins_anew, 3 * ASIDES);
    suite_add_loop(suite, "found", an_offset_that_fixes_found_is_turned, ASIDES);
    suite_add_loop(suite, "found with a compass", a_start_by_fixes_and_compass_is_walked_anew,
                   ASIDES);
    return suite;
}
