/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_place.h"

#include <stddef.h>

#include "near.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"

#define PI 3.14159265358979323846

/* A filter that keeps the last of each call and answers as it is told. */
typedef struct {
    insole_status_t starts, steps, fixes, sights; /* what it answers */
    uint32_t started, stepped, fixed, seen;       /* calls */
    insole_step_filter_begin_t begin;
    uint64_t step_us;
    insole_pace_t pace;
    insole_spot_fix_t fix;
    insole_real_t sight_rad, sight_sigma_rad;
    insole_step_filter_answer_t at;
    insole_status_t biases;
    uint32_t told;
    insole_real_t bias_m;
} fake_t;

static insole_status_t fake_start(void *state, const insole_step_filter_begin_t *begin)
{
    fake_t *fake = state;
    fake->started++;
    fake->begin = *begin;
    if (fake->starts == INSOLE_OK) {
        fake->at.spot = begin->spot;
        fake->at.cov_m2 = begin->cov_m2;
        fake->at.offset_rad = begin->offset_rad;
        fake->at.var_offset_rad2 = begin->var_offset_rad2;
        fake->at.scale = INSOLE_R(1.0);
    }
    return fake->starts;
}

static insole_status_t fake_step(void *state, uint64_t t_us, const insole_pace_t *pace)
{
    fake_t *fake = state;
    fake->stepped++;
    fake->step_us = t_us;
    fake->pace = *pace;
    return fake->steps;
}

static insole_status_t fake_fix(void *state, const insole_spot_fix_t *fix)
{
    fake_t *fake = state;
    fake->fixed++;
    fake->fix = *fix;
    return fake->fixes;
}

static insole_status_t fake_compass(void *state, insole_real_t offset_rad, insole_real_t sigma_rad)
{
    fake_t *fake = state;
    fake->seen++;
    fake->sight_rad = offset_rad;
    fake->sight_sigma_rad = sigma_rad;
    return fake->sights;
}

static insole_status_t fake_answer(const void *state, insole_step_filter_answer_t *answer)
{
    const fake_t *fake = state;
    if (fake->started == 0u) {
        return INSOLE_ERR_STATE;
    }
    *answer = fake->at;
    return INSOLE_OK;
}

static const insole_step_filter_calls_t plain_calls = {
    .start = fake_start, .step = fake_step, .fix = fake_fix, .answer = fake_answer};
static const insole_step_filter_calls_t learning_calls = {.start = fake_start,
                                                          .step = fake_step,
                                                          .fix = fake_fix,
                                                          .compass = fake_compass,
                                                          .answer = fake_answer};

static insole_status_t fake_bias(void *state, insole_real_t sigma_m)
{
    fake_t *fake = state;
    fake->told++;
    fake->bias_m = sigma_m;
    return fake->biases;
}

static const insole_step_filter_calls_t erring_calls = {.start = fake_start,
                                                        .step = fake_step,
                                                        .fix = fake_fix,
                                                        .bias = fake_bias,
                                                        .compass = fake_compass,
                                                        .answer = fake_answer};

/* Those of the library, but that a fix speaks of where the walker is. */
static insole_auto_start_config_t start_settings;

static fake_t fake;
static insole_phone_place_t place;

static const insole_step_filter_t plain = {&plain_calls, &fake};
static const insole_step_filter_t learning = {&learning_calls, &fake};
static const insole_step_filter_t erring = {&erring_calls, &fake};

static void set_up(const insole_step_filter_t *filter, bool has_radio)
{
    const fake_t blank = {.starts = INSOLE_OK};
    fake = blank;
    ck_assert_int_eq(insole_phone_place_init(&place, &insole_phone_place_defaults, &start_settings,
                                             NULL, filter, has_radio),
                     INSOLE_OK);
}

static insole_start_t start_at(double t_s, double x_m, double y_m)
{
    insole_start_t start = {.t_us = (uint64_t)llround(1e6 * t_s),
                            .x_m = (insole_real_t)x_m,
                            .y_m = (insole_real_t)y_m,
                            .sigma_m = INSOLE_R(0.5)};
    return start;
}

static insole_start_t directed(double t_s, double x_m, double y_m, double heading_rad)
{
    insole_start_t start = start_at(t_s, x_m, y_m);
    start.has_heading = true;
    start.heading_rad = (insole_real_t)heading_rad;
    start.sigma_rad = INSOLE_R(0.1);
    return start;
}

static void tell(insole_start_t start)
{
    ck_assert_int_eq(insole_phone_place_tell(&place, &start), INSOLE_OK);
}

static insole_pace_t pace_to(double heading_rad)
{
    insole_pace_t pace = {INSOLE_R(0.7), (insole_real_t)heading_rad, INSOLE_R(0.01),
                          INSOLE_R(0.01)};
    return pace;
}

static insole_status_t step(double t_s, double heading_rad)
{
    insole_pace_t pace = pace_to(heading_rad);
    return insole_phone_place_step(&place, (uint64_t)llround(1e6 * t_s), &pace);
}

static insole_status_t hear(double t_s, double x_m, double y_m)
{
    insole_spot_fix_t fix = {(uint64_t)llround(1e6 * t_s),
                             {(insole_real_t)x_m, (insole_real_t)y_m},
                             insole_sym2_circle(INSOLE_R(4.0)),
                             {INSOLE_R(0.0), INSOLE_R(0.0)}};
    return insole_phone_place_fix(&place, &fix);
}

static void see(double block_rad, double mean_rad, double sigma_mean_rad)
{
    insole_phone_sight_t sight = {true, (insole_real_t)block_rad, INSOLE_R(0.8),
                                  (insole_real_t)mean_rad, (insole_real_t)sigma_mean_rad};
    place.sight = sight;
}

static insole_phone_answer_t answer_at(double t_s)
{
    insole_phone_answer_t answer;
    ck_assert_int_eq(insole_phone_place_answer(&place, (uint64_t)llround(1e6 * t_s), &answer),
                     INSOLE_OK);
    return answer;
}

#define ASSERT_BEGAN(t_s, x, y, offset, var_offset)                                                \
    do {                                                                                           \
        ck_assert(fake.begin.t_us == (uint64_t)llround(1e6 * (t_s)));                              \
        ASSERT_NEAR(fake.begin.spot.x_m, x, 1e-5, "m");                                            \
        ASSERT_NEAR(fake.begin.spot.y_m, y, 1e-5, "m");                                            \
        ASSERT_NEAR(remainder((double)fake.begin.offset_rad - (offset), 2.0 * PI), 0.0, 1e-5,      \
                    "rad");                                                                        \
        ASSERT_NEAR(fake.begin.var_offset_rad2, var_offset, 1e-5, "rad^2");                        \
    } while (0)

/* ---- a start that tells place and direction ---------------------------------------------- */

START_TEST(the_first_step_gives_its_direction)
{
    set_up(_i % 2 == 0 ? &plain : &learning, _i / 2 == 1);
    tell(directed(1.0, 3.0, -4.0, 3.0));
    ck_assert_int_eq(step(2.0, -2.5), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 1u);
    ASSERT_BEGAN(2.0, 3.0, -4.0, 3.0 + 2.5, 0.01);
    ASSERT_NEAR(fake.begin.cov_m2.xx, 0.25, 1e-6, "m^2");
    ASSERT_NEAR(fake.begin.cov_m2.yy, 0.25, 1e-6, "m^2");
    ck_assert(!fake.begin.from_radio && fake.begin.cov_m2.xy == INSOLE_R(0.0));
    ck_assert_uint_eq(fake.stepped, 1u);
    ck_assert(fake.step_us == 2000000u && fake.pace.heading_rad == INSOLE_R(-2.5));
    ck_assert_int_eq(step(2.5, -2.0), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 1u);
    ck_assert_uint_eq(fake.stepped, 2u);
    ck_assert_uint_eq(place.starts, 1u);
}
END_TEST

START_TEST(peaks_that_may_be_steps_give_it_sooner)
{
    set_up(&plain, true);
    ck_assert(!insole_phone_place_wants_direction(&place, 1500000u));
    tell(directed(1.0, 3.0, -4.0, 0.5));
    ck_assert(!insole_phone_place_wants_direction(&place, 999999u));
    ck_assert(insole_phone_place_wants_direction(&place, 1000000u));
    ck_assert_int_eq(insole_phone_place_direct(&place, 1500000u, INSOLE_R(0.2)), INSOLE_OK);
    ASSERT_BEGAN(1.5, 3.0, -4.0, 0.3, 0.01);
    ck_assert(!insole_phone_place_wants_direction(&place, 1600000u));
    ck_assert_int_eq(step(2.0, 2.0), INSOLE_OK); /* only a step now */
    ck_assert_uint_eq(fake.started, 1u);
    ck_assert_uint_eq(fake.stepped, 1u);
}
END_TEST

START_TEST(direction_without_need_is_refused)
{
    set_up(&plain, true);
    ASSERT_UNCHANGED(place, insole_phone_place_direct(&place, 1u, INSOLE_R(0.0)), INSOLE_ERR_STATE);
    tell(start_at(0.0, 1.0, 1.0)); /* tells no direction */
    ASSERT_UNCHANGED(place, insole_phone_place_direct(&place, 1u, INSOLE_R(0.0)), INSOLE_ERR_STATE);
    tell(directed(9.0, 1.0, 1.0, 0.0)); /* holds later */
    ASSERT_UNCHANGED(place, insole_phone_place_direct(&place, 8999999u, INSOLE_R(0.0)),
                     INSOLE_ERR_STATE);
    ck_assert_uint_eq(fake.started, 0u);
}
END_TEST

START_TEST(a_start_that_is_vague_about_direction_tells_no_more_than_nothing)
{
    insole_start_t start = directed(0.0, 1.0, 1.0, 0.0);
    start.sigma_rad = INSOLE_R(50.0);
    start.sigma_m = INSOLE_R(0.0); /* and one that is too sure of its place */
    set_up(&plain, false);
    tell(start);
    ck_assert_int_eq(step(1.0, 0.0), INSOLE_OK);
    ASSERT_NEAR(fake.begin.var_offset_rad2, PI * PI / 3.0, 1e-5, "rad^2");
    ASSERT_NEAR(fake.begin.cov_m2.xx, 1e-6, 1e-9, "m^2");
}
END_TEST

/* Before its time it is as if nothing had been told; then it replaces what was. */
START_TEST(a_start_told_ahead_waits_for_its_time)
{
    set_up(&plain, false);
    tell(directed(5.0, 30.0, 40.0, 1.0));
    ck_assert_int_eq(step(4.0, 0.0), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 0u);
    ck_assert_int_eq(answer_at(4.9).knowledge, INSOLE_PHONE_NOWHERE);
    ck_assert_int_eq(answer_at(5.0).knowledge, INSOLE_PHONE_TOLD);
    ck_assert_int_eq(step(5.5, 0.2), INSOLE_OK);
    ASSERT_BEGAN(5.5, 30.0, 40.0, 0.8, 0.01);
}
END_TEST

START_TEST(a_later_start_replaces_the_earlier)
{
    set_up(&plain, false);
    tell(directed(1.0, 3.0, -4.0, 0.5));
    tell(directed(1.0, 8.0, 9.0, 0.5));
    ck_assert_int_eq(step(2.0, 0.5), INSOLE_OK);
    ASSERT_BEGAN(2.0, 8.0, 9.0, 0.0, 0.01);
    tell(directed(10.0, -5.0, 0.0, 2.0));
    ck_assert_int_eq(step(9.0, 0.5), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 1u);
    ck_assert_int_eq(answer_at(9.5).knowledge, INSOLE_PHONE_FILTERED);
    ck_assert_int_eq(answer_at(10.0).knowledge, INSOLE_PHONE_TOLD);
    ck_assert_int_eq(step(10.5, 0.5), INSOLE_OK);
    ASSERT_BEGAN(10.5, -5.0, 0.0, 1.5, 0.01);
    ck_assert_uint_eq(place.starts, 2u);
    ck_assert_int_eq(answer_at(10.5).knowledge, INSOLE_PHONE_FILTERED);
}
END_TEST

START_TEST(told_it_answers_the_place_that_was_told)
{
    set_up(&plain, true);
    tell(directed(1.0, 3.0, -4.0, 0.5));
    insole_phone_answer_t answer = answer_at(1.5);
    ck_assert_int_eq(answer.knowledge, INSOLE_PHONE_TOLD);
    ck_assert(!answer.knows_offset);
    ASSERT_NEAR(answer.at.spot.x_m, 3.0, 0.0, "m");
    ASSERT_NEAR(answer.at.spot.y_m, -4.0, 0.0, "m");
    ASSERT_NEAR(answer.at.cov_m2.xx, 0.25, 1e-6, "m^2");
    ASSERT_NEAR(answer.at.var_offset_rad2, 0.01, 1e-6, "rad^2");
    ASSERT_NEAR(answer.at.scale, 1.0, 0.0, "");
    tell(start_at(1.0, 5.0, 6.0));
    ck_assert(!answer_at(1.5).knows_offset);
    ASSERT_NEAR(answer_at(1.5).at.var_offset_rad2, PI * PI / 3.0, 1e-5, "rad^2");
    see(0.1, 0.7, 0.2);
    answer = answer_at(1.5);
    ck_assert(answer.knows_offset);
    ASSERT_NEAR(answer.at.offset_rad, 0.7, 1e-6, "rad");
}
END_TEST

START_TEST(between_a_start_and_its_steps_fixes_are_passed_over)
{
    set_up(_i == 0 ? &plain : &learning, true);
    tell(_i < 2 ? directed(1.0, 3.0, -4.0, 0.5) : start_at(1.0, 3.0, -4.0));
    insole_phone_place_t before = place;
    ck_assert_int_eq(hear(1.5, 20.0, 20.0), INSOLE_OK);
    ck_assert_int_eq(hear(2.5, 20.0, 20.0), INSOLE_OK);
    ck_assert_mem_eq(&place, &before, sizeof place);
    ck_assert_uint_eq(fake.fixed + fake.started, 0u);
}
END_TEST

/* ---- a start that tells the place alone -------------------------------------------------- */

START_TEST(the_compass_tells_the_direction)
{
    set_up(_i % 2 == 0 ? &plain : &learning, _i / 2 == 1);
    tell(start_at(1.0, 3.0, -4.0));
    see(2.0, -0.8, 0.26);
    ck_assert_int_eq(step(2.0, 1.0), INSOLE_OK);
    ASSERT_BEGAN(2.0, 3.0, -4.0, -0.8, 0.26 * 0.26);
    ck_assert_uint_eq(fake.stepped, 1u);
}
END_TEST

START_TEST(a_filter_that_learns_starts_without_a_direction)
{
    set_up(&learning, _i == 1);
    tell(start_at(1.0, 3.0, -4.0));
    ck_assert_int_eq(step(2.0, 1.0), INSOLE_OK);
    ASSERT_BEGAN(2.0, 3.0, -4.0, 0.0, PI * PI / 3.0);
    ck_assert(!fake.begin.from_radio);
}
END_TEST

START_TEST(without_radio_nobody_will_tell_so_it_starts_at_once)
{
    set_up(&plain, false);
    tell(start_at(1.0, 3.0, -4.0));
    ck_assert_int_eq(step(2.0, 1.0), INSOLE_OK);
    ASSERT_BEGAN(2.0, 3.0, -4.0, 0.0, PI * PI / 3.0);
}
END_TEST

/* A filter that takes the direction for known waits for it: a walk east in n goes north in m. */
START_TEST(fixes_tell_the_direction_from_the_place_that_was_told)
{
    uint32_t before = 0u;
    set_up(&plain, true);
    tell(start_at(1.0, 10.0, 10.0));
    for (int i = 1; i <= 80 && fake.started == 0u; i++) {
        ck_assert_int_eq(step(1.0 + 0.5 * i, 0.0), INSOLE_OK);
        if (i % 4 == 0) {
            ck_assert_int_eq(hear(1.05 + 0.5 * i, 10.0, 10.0 + 0.7 * i), INSOLE_OK);
        }
        before += fake.started == 0u ? 1u : 0u;
    }
    ck_assert_uint_eq(fake.started, 1u);
    ck_assert_uint_ge(before, 8u);
    ck_assert(fake.begin.from_radio);
    ASSERT_NEAR(fake.begin.offset_rad, PI / 2.0, 0.15, "rad");
    ASSERT_NEAR(fake.begin.spot.x_m, 10.0, 1.5, "m");
    ASSERT_NEAR(fake.begin.spot.y_m, 10.0 + 0.7 * (before + 1u), 1.5, "m");
    ck_assert_uint_eq(fake.stepped, 0u);
    ck_assert_int_eq(step(60.0, 0.0), INSOLE_OK);
    ck_assert_uint_eq(fake.stepped, 1u);
}
END_TEST

/* Until then the place is guessed, from where it was told on. */
START_TEST(while_the_direction_is_sought_the_place_is_guessed)
{
    set_up(&plain, true);
    tell(start_at(1.0, 10.0, 10.0));
    ck_assert_int_eq(step(1.5, 0.0), INSOLE_OK);
    insole_phone_answer_t answer = answer_at(1.6);
    ck_assert_int_eq(answer.knowledge, INSOLE_PHONE_GUESSED);
    ASSERT_NEAR(hypot((double)answer.at.spot.x_m - 10.0, (double)answer.at.spot.y_m - 10.0), 0.7,
                0.01, "m");
    ASSERT_AT_LEAST(answer.at.var_offset_rad2, 3.0, "rad^2");
}
END_TEST

/* ---- no start ---------------------------------------------------------------------------- */

START_TEST(without_start_and_radio_it_begins_at_the_origin)
{
    set_up(_i == 0 ? &plain : &learning, false);
    ck_assert_int_eq(answer_at(0.5).knowledge, INSOLE_PHONE_NOWHERE);
    ck_assert_int_eq(step(2.0, 1.0), INSOLE_OK);
    ASSERT_BEGAN(2.0, 0.0, 0.0, 0.0, 0.0);
    ASSERT_NEAR(fake.begin.cov_m2.xx, 1e-6, 1e-9, "m^2");
    ck_assert_uint_eq(fake.stepped, 1u);
    ck_assert_int_eq(step(2.5, 1.0), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 1u);
    ck_assert_int_eq(answer_at(3.0).knowledge, INSOLE_PHONE_FILTERED);
}
END_TEST

/* A start that comes afterwards moves the walk to where it tells. */
static insole_status_t fake_search(void *state, uint64_t t_us)
{
    fake_t *f = state;
    f->started++;
    f->begin.t_us = t_us;
    f->begin.spot = insole_spot(7, 8);
    f->at.spot = f->begin.spot;
    return f->starts;
}

/* One that looks for the place itself is not told that it is at the origin; when it cannot, it is.
 */
START_TEST(a_filter_that_searches_is_told_no_origin)
{
    insole_step_filter_calls_t calls = learning_calls;
    const insole_step_filter_t searching = {&calls, &fake};
    calls.start_anywhere = fake_search;
    set_up(&searching, false);
    ck_assert_int_eq(step(2.0, 0.3), INSOLE_OK);
    ck_assert(place.is_started);
    ck_assert_uint_eq(place.starts, 1u);
    ck_assert_uint_eq(fake.started, 1u);
    ck_assert_uint_eq(fake.stepped, 1u);
    ASSERT_NEAR(fake.begin.spot.x_m, 7.0, 0.0, "m");
    set_up(&searching, false);
    fake.starts = INSOLE_ERR_STATE;
    (void)step(2.0, 0.3);
    ck_assert(!place.is_started);
    ck_assert_uint_eq(fake.started, 2u);
    ASSERT_NEAR(fake.begin.spot.x_m, 0.0, 0.0, "m");
}
END_TEST

/* A start, or fixes to come, go before a search. */
START_TEST(who_is_told_does_not_search)
{
    insole_step_filter_calls_t calls = learning_calls;
    const insole_step_filter_t searching = {&calls, &fake};
    calls.start_anywhere = fake_search;
    set_up(&searching, _i == 0);
    if (_i == 1) {
        tell(directed(1.0, 3.0, 4.0, 0.0));
    }
    (void)step(2.0, 0.3);
    ck_assert_uint_eq(fake.started, _i == 0 ? 0u : 1u);
    ck_assert(_i == 0 || (double)fake.begin.spot.x_m < 3.5);
}
END_TEST

START_TEST(a_start_told_after_the_origin_counts)
{
    set_up(&plain, false);
    ck_assert_int_eq(step(2.0, 1.0), INSOLE_OK);
    tell(directed(3.0, 7.0, 8.0, 1.5));
    ck_assert_int_eq(step(3.5, 1.0), INSOLE_OK);
    ASSERT_BEGAN(3.5, 7.0, 8.0, 0.5, 0.01);
}
END_TEST

START_TEST(with_radio_steps_wait_for_fixes)
{
    set_up(&plain, true);
    for (int i = 0; i < 10; i++) {
        ck_assert_int_eq(step(1.0 + 0.5 * i, 0.0), INSOLE_OK);
    }
    ck_assert_uint_eq(fake.started + fake.stepped, 0u);
    ck_assert_int_eq(answer_at(7.0).knowledge, INSOLE_PHONE_NOWHERE);
    ck_assert_int_eq(hear(7.5, 20.0, 30.0), INSOLE_OK);
    insole_phone_answer_t answer = answer_at(8.0);
    ck_assert_int_eq(answer.knowledge, INSOLE_PHONE_GUESSED);
    ASSERT_NEAR(answer.at.spot.x_m, 20.0, 1e-4, "m");
    ASSERT_NEAR(answer.at.spot.y_m, 30.0, 1e-4, "m");
    ck_assert_uint_eq(fake.started, 0u);
}
END_TEST

/* In n the walk goes along a circle, in m the same is turned by `offset` and stands elsewhere. */
static double walk_until_start(double offset)
{
    double x = 0.0, y = 0.0;
    for (int i = 1; i <= 200 && fake.started == 0u; i++) {
        double heading = 0.04 * i, c = cos(offset), s = sin(offset);
        ck_assert_int_eq(step(0.5 * i, heading), INSOLE_OK);
        x += 0.7 * cos(heading);
        y += 0.7 * sin(heading);
        if (i % 5 == 0) {
            ck_assert_int_eq(hear(0.1 + 0.5 * i, 50.0 + c * x - s * y, -20.0 + s * x + c * y),
                             INSOLE_OK);
        }
    }
    ck_assert_uint_eq(fake.started, 1u);
    return hypot((double)fake.begin.spot.x_m - (50.0 + cos(offset) * x - sin(offset) * y),
                 (double)fake.begin.spot.y_m - (-20.0 + sin(offset) * x + cos(offset) * y));
}

START_TEST(fixes_alone_tell_place_and_direction)
{
    const double offsets[] = {0.0, 1.0, PI - 0.01, -PI / 2.0, -3.0};
    set_up(&plain, true);
    double off_m = walk_until_start(offsets[_i]);
    ck_assert(fake.begin.from_radio);
    ASSERT_AT_MOST(off_m, 0.05, "m"); /* the fixes do not err */
    ASSERT_NEAR(remainder((double)fake.begin.offset_rad - offsets[_i], 2.0 * PI), 0.0, 0.01, "rad");
    ASSERT_AT_MOST(fake.begin.var_offset_rad2, 0.25 + 1e-6, "rad^2");
    ASSERT_AT_LEAST(fake.begin.var_offset_rad2, 0.001, "rad^2");
}
END_TEST

START_TEST(a_compass_known_well_lets_a_learning_filter_start_with_the_first_fix)
{
    set_up(&learning, true);
    see(0.1, 0.4, 0.3);
    ck_assert_int_eq(step(1.0, 0.0), INSOLE_OK);
    ck_assert_int_eq(hear(2.0, 20.0, 30.0), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 1u);
    ck_assert(fake.begin.from_radio);
    ASSERT_NEAR(fake.begin.offset_rad, 0.4, 1e-4, "rad");
    ASSERT_NEAR(fake.begin.spot.x_m, 20.0, 1e-3, "m");
    ASSERT_AT_LEAST(fake.begin.var_offset_rad2, 0.08, "rad^2");
    ASSERT_AT_MOST(fake.begin.var_offset_rad2, 0.25, "rad^2");
}
END_TEST

/* Of the start's covariance the filter is told what the next fixes err by, too: the bias, that of
 * the only fix, no more than the setting. */
START_TEST(the_filter_knows_what_start_and_fixes_share)
{
    set_up(&erring, true);
    see(0.1, 0.4, 0.3);
    insole_spot_fix_t fix = {2000000u, {20, 30}, {8, 1, 24}, {0, 0}};
    fix.cov_m2 = _i == 0 ? fix.cov_m2 : insole_sym2_circle(100);
    ck_assert_int_eq(insole_phone_place_fix(&place, &fix), INSOLE_OK);
    double told_m = _i == 0 ? 0.5 * 4.0 : 0.5 * 10.0, bias_m = fmin(told_m, 3.5);
    ASSERT_NEAR(fake.bias_m, told_m, 1e-5, "m");
    ck_assert(fake.begin.from_radio);
    ASSERT_NEAR(fake.begin.shared_m2, bias_m * bias_m, 1e-4, "m^2");
    ASSERT_AT_LEAST(fake.begin.cov_m2.xx, bias_m * bias_m + 8.0, "m^2");
}
END_TEST

/* Half of the mean of what they tell, from the first to the last; what is no fix tells nothing. */
START_TEST(what_fixes_tell_is_averaged)
{
    set_up(&erring, true);
    see(0.1, 0.4, 0.3);
    double sum = 0.0;
    for (uint32_t k = 1u; k <= 6u; k++) {
        insole_real_t xx = (insole_real_t)(3u * k), yy = INSOLE_R(5.0);
        insole_spot_fix_t fix = {k * 1000000u, {20, 30}, {xx, 1, yy}, {0, 0}}, bad = fix;
        bad.cov_m2.xx = -1;
        sum += 0.5 * (double)(xx + yy);
        (void)insole_phone_place_fix(&place, &fix);
        ASSERT_NEAR(fake.bias_m, 0.5 * sqrt(sum / k), 1e-5, "m");
        (void)insole_phone_place_fix(&place, &bad);
        ck_assert_uint_eq(fake.told, k);
    }
    uint32_t refused = place.refused;
    fake.biases = INSOLE_ERR_VALUE;
    ck_assert_int_eq(hear(9.0, 1.0, 1.0), INSOLE_OK);
    ck_assert_uint_eq(place.refused, refused + 1u);
}
END_TEST

START_TEST(otherwise_it_waits)
{
    set_up(_i == 0 ? &plain : &learning, true);
    if (_i != 1) {
        see(0.1, 0.4, _i == 0 ? 0.3 : 1.5); /* not good enough; or of no use to the filter */
    }
    ck_assert_int_eq(hear(2.0, 20.0, 30.0), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 0u);
    ck_assert_int_eq(answer_at(2.0).knowledge, INSOLE_PHONE_GUESSED);
}
END_TEST

/* ---- once started ------------------------------------------------------------------------ */

static void set_up_started(const insole_step_filter_t *filter)
{
    set_up(filter, true);
    tell(directed(1.0, 3.0, -4.0, 0.5));
    ck_assert_int_eq(step(2.0, 0.0), INSOLE_OK);
}

START_TEST(fixes_go_to_the_filter)
{
    set_up_started(&plain);
    ck_assert_int_eq(hear(3.0, 5.0, 6.0), INSOLE_OK);
    ck_assert_uint_eq(fake.fixed, 1u);
    ck_assert(fake.fix.t_us == 3000000u);
    ASSERT_NEAR(fake.fix.spot.x_m, 5.0, 0.0, "m");
    ASSERT_NEAR(fake.fix.cov_m2.yy, 4.0, 0.0, "m^2");
}
END_TEST

START_TEST(a_new_block_of_the_compass_goes_to_a_filter_that_learns)
{
    set_up_started(_i == 0 ? &plain : &learning);
    ck_assert_int_eq(insole_phone_place_compass(&place), INSOLE_OK); /* nothing is known yet */
    ck_assert_uint_eq(fake.seen, 0u);
    see(0.9, 0.4, 0.3);
    ck_assert_int_eq(insole_phone_place_compass(&place), INSOLE_OK);
    ck_assert_uint_eq(fake.seen, _i == 0 ? 0u : 1u);
    if (_i == 1) {
        ASSERT_NEAR(fake.sight_rad, 0.9, 1e-6, "rad");
        ASSERT_NEAR(fake.sight_sigma_rad, 0.8, 1e-6, "rad");
    }
}
END_TEST

START_TEST(before_the_start_the_filter_hears_of_no_compass)
{
    set_up(&learning, true);
    see(0.9, 0.4, 0.3);
    ASSERT_UNCHANGED(place, insole_phone_place_compass(&place), INSOLE_OK);
    ck_assert_uint_eq(fake.seen, 0u);
}
END_TEST

START_TEST(what_the_filter_refuses_is_counted_and_told)
{
    set_up_started(&learning);
    see(0.9, 0.4, 0.3);
    ck_assert_int_eq(hear(2.5, 5.0, 6.0), INSOLE_OK);
    insole_phone_place_t before = place;
    fake.steps = INSOLE_ERR_VALUE;
    fake.fixes = INSOLE_ERR_TIME;
    fake.sights = INSOLE_ERR_STATE;
    ck_assert_int_eq(step(3.0, 0.0), INSOLE_ERR_VALUE);
    ck_assert_int_eq(hear(3.0, 5.0, 6.0), INSOLE_ERR_TIME);
    ck_assert_int_eq(insole_phone_place_compass(&place), INSOLE_ERR_STATE);
    before.refused += 3u;
    ck_assert_mem_eq(&place, &before, sizeof place);
}
END_TEST

START_TEST(a_start_that_the_filter_refuses_starts_nothing)
{
    set_up(&plain, false);
    fake.starts = INSOLE_ERR_VALUE;
    tell(directed(1.0, 3.0, -4.0, 0.5));
    (void)step(2.0, 0.0);
    ck_assert(!place.is_started);
    ck_assert_uint_eq(place.starts, 0u);
    ck_assert_uint_ge(place.refused, 1u);
    ck_assert_uint_eq(fake.stepped, 0u);
    ck_assert_int_ne(answer_at(3.0).knowledge, INSOLE_PHONE_FILTERED);
}
END_TEST

/* Radius: so many of the longer axis, and so much more. */
START_TEST(the_area_lies_about_the_walker_that_a_filter_knows)
{
    insole_trusted_area_t area = {{INSOLE_R(7.0), INSOLE_R(7.0)}, INSOLE_R(7.0)};
    insole_trusted_area_t before = area;
    set_up(&plain, true);
    ck_assert(!insole_phone_place_area(&place, 1u, INSOLE_R(3.0), INSOLE_R(10.0), &area));
    ck_assert_int_eq(hear(1.0, 5.0, 6.0), INSOLE_OK); /* a guess is not enough */
    ck_assert(!insole_phone_place_area(&place, 1u, INSOLE_R(3.0), INSOLE_R(10.0), &area));
    ck_assert_mem_eq(&area, &before, sizeof area);
    set_up_started(&plain);
    fake.at.spot = insole_spot(INSOLE_R(11.0), INSOLE_R(12.0));
    fake.at.cov_m2 = insole_sym2(INSOLE_R(5.0), INSOLE_R(2.0), INSOLE_R(2.0)); /* 6 and 1 */
    ck_assert(insole_phone_place_area(&place, 3000000u, INSOLE_R(3.0), INSOLE_R(10.0), &area));
    ASSERT_NEAR(area.centre.x_m, 11.0, 0.0, "m");
    ASSERT_NEAR(area.centre.y_m, 12.0, 0.0, "m");
    ASSERT_NEAR(area.radius_m, 10.0 + 3.0 * sqrt(6.0), 1e-4, "m");
    ck_assert(!insole_phone_place_area(&place, 1u, INSOLE_R(3.0), INSOLE_R(10.0), NULL));
    ck_assert(!insole_phone_place_area(NULL, 1u, INSOLE_R(3.0), INSOLE_R(10.0), &area));
}
END_TEST

/* ---- gaps -------------------------------------------------------------------------------- */

START_TEST(after_a_gap_it_is_less_certain_where_it_was)
{
    double gap_s = 0.5 + 2.5 * _i, way = 0.8 * gap_s;
    set_up_started(&plain);
    fake.at.spot = insole_spot(INSOLE_R(11.0), INSOLE_R(12.0));
    fake.at.cov_m2 = insole_sym2(INSOLE_R(4.0), INSOLE_R(1.0), INSOLE_R(9.0));
    fake.at.offset_rad = INSOLE_R(0.3);
    fake.at.var_offset_rad2 = INSOLE_R(0.02);
    ck_assert_int_eq(insole_phone_place_gap(&place, 20000000u, (insole_real_t)gap_s), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 2u);
    ASSERT_BEGAN(20.0, 11.0, 12.0, 0.3, fmin(0.02 + 0.75 * 0.75 * gap_s, PI * PI / 3.0));
    ASSERT_NEAR(fake.begin.cov_m2.xx, 4.0 + way * way, 1e-3, "m^2");
    ASSERT_NEAR(fake.begin.cov_m2.xy, 1.0, 1e-6, "m^2");
    ASSERT_NEAR(fake.begin.cov_m2.yy, 9.0 + way * way, 1e-3, "m^2");
    ck_assert(!fake.begin.from_radio);
}
END_TEST

START_TEST(gaps_as_long_as_they_may_be_leave_a_covariance)
{
    const double gaps_s[] = {1.0e6, 1.0e13, 1.0e20, 3.0e38};
    set_up_started(&plain);
    ck_assert_int_eq(insole_phone_place_gap(&place, 20000000u, (insole_real_t)gaps_s[_i]),
                     INSOLE_OK);
    ck_assert(insole_sym2_is_between(fake.begin.cov_m2, INSOLE_R(6.0e11), INSOLE_SPOT_MOST_M2));
    ASSERT_NEAR(fake.begin.var_offset_rad2, PI * PI / 3.0, 1e-5, "rad^2");
}
END_TEST

START_TEST(before_the_start_a_gap_hides_nothing)
{
    set_up(&plain, true);
    ASSERT_UNCHANGED(place, insole_phone_place_gap(&place, 5000000u, INSOLE_R(3.0)), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 0u);
}
END_TEST

START_TEST(gaps_that_are_none_are_refused)
{
    const insole_real_t bad[] = {INSOLE_R(-0.1), (insole_real_t)NAN, (insole_real_t)INFINITY};
    set_up_started(&plain);
    ASSERT_UNCHANGED(place, insole_phone_place_gap(&place, 5000000u, bad[_i]), INSOLE_ERR_VALUE);
    ck_assert_uint_eq(fake.started, 1u);
}
END_TEST

/* ---- turns ------------------------------------------------------------------------------- */

static void set_up_to_turn(void)
{
    set_up_started(&plain);
    fake.at.spot = insole_spot(INSOLE_R(11.0), INSOLE_R(12.0));
    fake.at.cov_m2 = insole_sym2(INSOLE_R(4.0), INSOLE_R(1.0), INSOLE_R(9.0));
    fake.at.offset_rad = INSOLE_R(0.3);
    fake.at.var_offset_rad2 = INSOLE_R(0.02);
}

static insole_status_t turn(double askew_rad, double x_m, double y_m)
{
    insole_phone_aside_t aside = {
        (insole_real_t)askew_rad, {(insole_real_t)x_m, (insole_real_t)y_m}, true};
    return insole_phone_place_turn(&place, 20000000u, &aside);
}

/* The heading that was told made the offset: what was walked is right. */
START_TEST(an_offset_that_steps_made_holds_the_angle)
{
    const double askew_rad = _i == 0 ? 1.5 : -2.0;
    set_up_to_turn();
    if (_i == 1) {
        see(0.0, 0.2 - askew_rad, 0.2);
    }
    ck_assert_int_eq(turn(askew_rad, 4.0, 1.0), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 2u);
    ASSERT_BEGAN(20.0, 11.0, 12.0, 0.3 - askew_rad, 0.02);
    ASSERT_NEAR(fake.begin.cov_m2.xx, 4.0, 1e-6, "m^2");
    ck_assert(!fake.begin.from_radio);
}
END_TEST

/* The compass made it: what was walked went astray. */
START_TEST(a_way_that_went_astray_is_walked_anew)
{
    const double askew_rad = _i == 0 ? 1.5 : -2.0;
    set_up_to_turn();
    see(0.0, 0.4, 0.2);
    ck_assert_int_eq(turn(askew_rad, 4.0, 1.0), INSOLE_OK);
    double c = cos(0.3), s = sin(0.3), ca = cos(0.3 + askew_rad), sa = sin(0.3 + askew_rad);
    double x = (4.0 * ca - sa) - (4.0 * c - s), y = (4.0 * sa + ca) - (4.0 * s + c);
    ASSERT_BEGAN(20.0, 11.0 + x, 12.0 + y, 0.3, 0.02);
    ASSERT_NEAR(fake.begin.cov_m2.xx, 4.0 + 0.09 * (x * x + y * y), 1e-4, "m^2");
    ASSERT_NEAR(fake.begin.cov_m2.xy, 1.0, 1e-6, "m^2");
    ASSERT_NEAR(fake.begin.cov_m2.yy, 9.0 + 0.09 * (x * x + y * y), 1e-4, "m^2");
}
END_TEST

START_TEST(a_search_begins_anew)
{
    set_up(&plain, true);
    insole_auto_start_t fresh = place.auto_start;
    ck_assert_int_eq(step(1.0, 0.2), INSOLE_OK);
    ck_assert_int_eq(hear(2.0, 5.0, 6.0), INSOLE_OK);
    ck_assert(memcmp(&fresh, &place.auto_start, sizeof fresh) != 0);
    ck_assert_int_eq(turn(1.0, 4.0, 1.0), INSOLE_OK);
    ck_assert_uint_eq(fake.started, 0u);
    ck_assert_mem_eq(&fresh, &place.auto_start, sizeof fresh);
}
END_TEST

START_TEST(turns_that_are_none_are_refused)
{
    set_up_to_turn();
    ASSERT_UNCHANGED(place, turn((double)NAN, 1.0, 1.0), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(place, turn(1.0, (double)INFINITY, 1.0), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(place, turn(1.0, 1.0, (double)NAN), INSOLE_ERR_VALUE);
    insole_phone_aside_t aside = {INSOLE_R(1.0), {0, 0}, true};
    ck_assert_int_eq(insole_phone_place_turn(NULL, 1u, &aside), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(place, insole_phone_place_turn(&place, 1u, NULL), INSOLE_ERR_NULL);
    ck_assert_uint_eq(fake.started, 1u);
}
END_TEST

/* ---- bad input --------------------------------------------------------------------------- */

START_TEST(starts_that_are_none_are_refused)
{
    const struct {
        size_t member;
        double value;
    } rows[] = {{offsetof(insole_start_t, x_m), (double)NAN},
                {offsetof(insole_start_t, x_m), 1.1e5},
                {offsetof(insole_start_t, y_m), (double)INFINITY},
                {offsetof(insole_start_t, y_m), -1.1e5},
                {offsetof(insole_start_t, heading_rad), (double)NAN},
                {offsetof(insole_start_t, heading_rad), 1.0e9},
                {offsetof(insole_start_t, sigma_m), -0.1},
                {offsetof(insole_start_t, sigma_m), (double)NAN},
                {offsetof(insole_start_t, sigma_rad), -0.1},
                {offsetof(insole_start_t, sigma_rad), (double)INFINITY}};
    insole_start_t start = directed(1.0, 3.0, -4.0, 0.5);
    insole_real_t value = (insole_real_t)rows[_i].value;
    set_up(&plain, true);
    memcpy((char *)&start + rows[_i].member, &value, sizeof value);
    ASSERT_UNCHANGED(place, insole_phone_place_tell(&place, &start), INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(a_heading_that_is_not_told_may_be_anything)
{
    insole_start_t start = start_at(1.0, 3.0, -4.0);
    start.heading_rad = (insole_real_t)NAN;
    start.sigma_rad = (insole_real_t)NAN;
    set_up(&plain, false);
    tell(start);
    ck_assert_int_eq(step(2.0, 1.0), INSOLE_OK);
    ASSERT_BEGAN(2.0, 3.0, -4.0, 0.0, PI * PI / 3.0);
}
END_TEST

START_TEST(filters_that_lack_a_part_are_refused)
{
    insole_step_filter_calls_t calls = learning_calls;
    insole_step_filter_t lacking = {_i == 5 ? NULL : &calls, _i == 4 ? NULL : &fake};
    set_up(&plain, true);
    calls.start = _i == 0 ? NULL : fake_start;
    calls.step = _i == 1 ? NULL : fake_step;
    calls.fix = _i == 2 ? NULL : fake_fix;
    calls.answer = _i == 3 ? NULL : fake_answer;
    ASSERT_UNCHANGED(place,
                     insole_phone_place_init(&place, &insole_phone_place_defaults, &start_settings,
                                             NULL, &lacking, true),
                     INSOLE_ERR_VALUE);
}
END_TEST

static insole_phone_place_config_t config;

static insole_status_t judge(void)
{
    insole_phone_place_t tried;
    return insole_phone_place_init(&tried, &config, &start_settings, NULL, &plain, true);
}

START_TEST(every_setting_has_its_range)
{
    insole_auto_start_config_t start = start_settings;
    config = insole_phone_place_defaults;
    ck_assert_int_eq(judge(), INSOLE_OK);
    INSOLE_PHONE_PLACE_KEYS(SETTING_HAS_ENDS)
    set_up(&plain, true);
    start.method = INSOLE_AUTO_START_CIRCLES;
    ASSERT_UNCHANGED(
        place,
        insole_phone_place_init(&place, &insole_phone_place_defaults, &start, NULL, &plain, true),
        INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_phone_place_init(&place, &insole_phone_place_defaults, &start,
                                             &insole_auto_start_circles, &plain, true),
                     INSOLE_OK);
    start = start_settings;
    start.fixes = 0;
    ASSERT_UNCHANGED(
        place,
        insole_phone_place_init(&place, &insole_phone_place_defaults, &start, NULL, &plain, true),
        INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(bad_paces_and_fixes_before_the_start_are_counted)
{
    insole_pace_t pace = pace_to((double)NAN);
    insole_spot_fix_t fix = {1000000u, {INSOLE_R(0.0), (insole_real_t)NAN}, {1, 0, 1}, {0, 0}};
    set_up(&plain, true);
    ck_assert_int_eq(insole_phone_place_step(&place, 1000000u, &pace), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_phone_place_fix(&place, &fix), INSOLE_ERR_VALUE);
    ck_assert_uint_eq(place.refused, 2u);
    ck_assert_int_eq(answer_at(2.0).knowledge, INSOLE_PHONE_NOWHERE);
}
END_TEST

START_TEST(null_is_refused)
{
    const insole_phone_place_config_t *defaults = &insole_phone_place_defaults;
    const insole_auto_start_config_t *starts = &start_settings;
    insole_pace_t pace = pace_to(0.0);
    insole_phone_answer_t answer;
    insole_spot_fix_t fix = {1u, {0, 0}, {1, 0, 1}, {0, 0}};
    insole_start_t start = start_at(0.0, 0.0, 0.0);
    set_up_started(&plain);
    ck_assert_int_eq(insole_phone_place_init(NULL, defaults, starts, NULL, &plain, true),
                     INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(place, insole_phone_place_init(&place, NULL, starts, NULL, &plain, true),
                     INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(place, insole_phone_place_init(&place, defaults, NULL, NULL, &plain, true),
                     INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(place, insole_phone_place_init(&place, defaults, starts, NULL, NULL, true),
                     INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(place, insole_phone_place_tell(&place, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(place, insole_phone_place_step(&place, 1u, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(place, insole_phone_place_fix(&place, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(place, insole_phone_place_answer(&place, 1u, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_place_tell(NULL, &start), INSOLE_ERR_NULL);
    ck_assert(!insole_phone_place_wants_direction(NULL, 1u));
    ck_assert_int_eq(insole_phone_place_direct(NULL, 1u, INSOLE_R(0.0)), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_place_step(NULL, 1u, &pace), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_place_fix(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_place_compass(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_place_gap(NULL, 1u, INSOLE_R(1.0)), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_place_answer(NULL, 1u, &answer), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_place");
    start_settings = insole_auto_start_defaults;
    start_settings.ahead_m = 0;
    suite_add_loop(suite, "shared", the_filter_knows_what_start_and_fixes_share, 2);
    suite_add(suite, "told", what_fixes_tell_is_averaged);
    suite_add_loop(suite, "first step", the_first_step_gives_its_direction, 4);
    suite_add(suite, "first peaks", peaks_that_may_be_steps_give_it_sooner);
    suite_add(suite, "direction not wanted", direction_without_need_is_refused);
    suite_add(suite, "vague start",
              a_start_that_is_vague_about_direction_tells_no_more_than_nothing);
    suite_add(suite, "told ahead", a_start_told_ahead_waits_for_its_time);
    suite_add(suite, "told again", a_later_start_replaces_the_earlier);
    suite_add(suite, "told", told_it_answers_the_place_that_was_told);
    suite_add_loop(suite, "fixes meanwhile", between_a_start_and_its_steps_fixes_are_passed_over,
                   3);
    suite_add_loop(suite, "place and compass", the_compass_tells_the_direction, 4);
    suite_add_loop(suite, "place, learning", a_filter_that_learns_starts_without_a_direction, 2);
    suite_add(suite, "place, no radio", without_radio_nobody_will_tell_so_it_starts_at_once);
    suite_add(suite, "place and fixes", fixes_tell_the_direction_from_the_place_that_was_told);
    suite_add(suite, "guessed", while_the_direction_is_sought_the_place_is_guessed);
    suite_add_loop(suite, "origin", without_start_and_radio_it_begins_at_the_origin, 2);
    suite_add(suite, "search", a_filter_that_searches_is_told_no_origin);
    suite_add_loop(suite, "no search", who_is_told_does_not_search, 2);
    suite_add(suite, "start after the origin", a_start_told_after_the_origin_counts);
    suite_add(suite, "steps wait", with_radio_steps_wait_for_fixes);
    suite_add_loop(suite, "fixes alone", fixes_alone_tell_place_and_direction, 5);
    suite_add(suite, "first fix",
              a_compass_known_well_lets_a_learning_filter_start_with_the_first_fix);
    suite_add_loop(suite, "not with the first fix", otherwise_it_waits, 3);
    suite_add(suite, "fixes", fixes_go_to_the_filter);
    suite_add_loop(suite, "compass", a_new_block_of_the_compass_goes_to_a_filter_that_learns, 2);
    suite_add(suite, "compass too soon", before_the_start_the_filter_hears_of_no_compass);
    suite_add(suite, "area", the_area_lies_about_the_walker_that_a_filter_knows);
    suite_add(suite, "refused by the filter", what_the_filter_refuses_is_counted_and_told);
    suite_add(suite, "start refused", a_start_that_the_filter_refuses_starts_nothing);
    suite_add_loop(suite, "gap", after_a_gap_it_is_less_certain_where_it_was, 4);
    suite_add_loop(suite, "endless gap", gaps_as_long_as_they_may_be_leave_a_covariance, 4);
    suite_add(suite, "gap too soon", before_the_start_a_gap_hides_nothing);
    suite_add_loop(suite, "bad gap", gaps_that_are_none_are_refused, 3);
    suite_add_loop(suite, "turn of the offset", an_offset_that_steps_made_holds_the_angle, 2);
    suite_add_loop(suite, "turn of the way", a_way_that_went_astray_is_walked_anew, 2);
    suite_add(suite, "turn in a search", a_search_begins_anew);
    suite_add(suite, "bad turns", turns_that_are_none_are_refused);
    suite_add_loop(suite, "bad starts", starts_that_are_none_are_refused, 10);
    suite_add(suite, "heading not told", a_heading_that_is_not_told_may_be_anything);
    suite_add_loop(suite, "lacking filter", filters_that_lack_a_part_are_refused, 6);
    suite_add(suite, "settings", every_setting_has_its_range);
    suite_add(suite, "bad news before the start", bad_paces_and_fixes_before_the_start_are_counted);
    suite_add(suite, "NULL", null_is_refused);
    return suite;
}
