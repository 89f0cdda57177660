/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_way.h"

#include "insole/base/rng.h"
#include "near.h"
#include "refusal.h"
#include "suite.h"

#define PI 3.14159265358979323846

static insole_phone_way_t way;

static insole_turn_t turn_of(double rad)
{
    insole_turn_t turn = {(insole_real_t)cos(rad), (insole_real_t)sin(rad)};
    return turn;
}

static void face(uint64_t t_us, double rad)
{
    ck_assert_int_eq(insole_phone_way_face(&way, t_us, turn_of(rad)), INSOLE_OK);
}

static insole_footfall_t footfall(uint64_t begin_us, uint64_t end_us)
{
    insole_footfall_t f = {.begin_us = begin_us, .end_us = end_us};
    return f;
}

static double direction(uint64_t begin_us, uint64_t end_us)
{
    insole_footfall_t f = footfall(begin_us, end_us);
    insole_real_t rad;
    ck_assert_int_eq(insole_phone_way_direction(&way, &f, &rad), INSOLE_OK);
    return (double)rad;
}

/* A turn at a constant rate, a sample every `dt_us`. */
static void turn_about(double rad, double radps, uint64_t from_us, uint64_t to_us, uint64_t dt_us)
{
    for (uint64_t t = from_us; t < to_us; t += dt_us) {
        face(t, rad + radps * 1e-6 * (double)(t - from_us));
    }
}

static void setup_test(void)
{
    ck_assert_int_eq(insole_phone_way_init(&way), INSOLE_OK);
}

/* ---- directions ------------------------------------------------------------------------- */

START_TEST(a_steady_direction_is_told_as_it_is)
{
    double rad = -3.1 + 0.31 * _i;
    setup_test();
    turn_about(rad, 0.0, 5000000u, 7000000u, 10000u);
    ASSERT_NEAR(remainder(direction(6000000u, 6500000u) - rad, 2.0 * PI), 0.0, 1e-5, "rad");
}
END_TEST

/* Mean over the slots that the step touches, by plain double sums over the samples. */
START_TEST(direction_is_the_mean_over_the_time_of_the_step)
{
    uint64_t begin_us = 6123456u + 70000u * (uint64_t)_i, end_us = begin_us + 523000u;
    double c = 0.0, s = 0.0;
    setup_test();
    turn_about(0.3, 0.7, 5000000u, 8000000u, 10000u);
    for (uint64_t t = 5000000u; t < 8000000u; t += 10000u) {
        if (t / 100000u >= begin_us / 100000u && t / 100000u <= end_us / 100000u) {
            c += cos(0.3 + 0.7 * 1e-6 * (double)(t - 5000000u));
            s += sin(0.3 + 0.7 * 1e-6 * (double)(t - 5000000u));
        }
    }
    double rad = direction(begin_us, end_us);
    ASSERT_NEAR(rad, atan2(s, c), 1e-5, "rad");
    ASSERT_NEAR(rad, 0.3 + 0.7 * (1e-6 * (double)(begin_us + end_us) / 2.0 - 5.0), 0.7 * 0.06,
                "rad");
}
END_TEST

/* Half the samples lie on either side of +-pi: the mean of the numbers would be 0. */
START_TEST(mean_of_directions_about_the_back_is_the_back)
{
    setup_test();
    for (uint64_t t = 1000000u; t < 2000000u; t += 10000u) {
        face(t, (t / 10000u) % 2u == 0u ? PI - 0.2 : -PI + 0.2);
    }
    ASSERT_NEAR(fabs(direction(1200000u, 1800000u)), PI, 1e-5, "rad");
    setup_test();
    turn_about(PI - 0.5, 1.0, 1000000u, 2000000u, 10000u); /* crosses pi on the way */
    double rad = direction(1400000u, 1899999u);
    ASSERT_NEAR(remainder(rad - (PI + 0.145), 2.0 * PI), 0.0, 1e-4, "rad");
}
END_TEST

/* The first steps of a walk are told up to 6 s after they were made. */
START_TEST(steps_told_late_have_the_direction_of_their_time)
{
    const uint64_t late_us[] = {0u, 500000u, 3000000u, 5500000u, 6000000u};
    uint64_t now_us = 20000000u;
    double expected = 1e-6 * (double)(now_us - late_us[_i]) * 0.2 - 4.0;
    setup_test();
    turn_about(-4.0, 0.2, 0u, now_us, 5000u);
    double rad = direction(now_us - late_us[_i] - 250000u, now_us - late_us[_i] - 150001u);
    ASSERT_NEAR(remainder(rad - (expected - 0.2 * 0.2), 2.0 * PI), 0.0, 0.2 * 0.06, "rad");
}
END_TEST

START_TEST(what_is_too_long_ago_has_the_oldest_direction_kept)
{
    setup_test();
    turn_about(0.0, 0.1, 1000000u, 21000000u, 10000u); /* newest slot ends at 21.0 s */
    double oldest = direction(14600000u, 14699999u), older = direction(2000000u, 2500000u);
    ASSERT_NEAR(older, oldest, 0.0, "rad");
    ASSERT_NEAR(oldest, 0.1 * 13.65, 0.1 * 0.06, "rad"); /* 64 slots of 0.1 s */
}
END_TEST

START_TEST(what_is_still_to_come_has_the_newest_direction)
{
    setup_test();
    turn_about(0.0, 1.0, 1000000u, 2000000u, 10000u);
    ASSERT_NEAR(direction(5000000u, 6000000u), 0.945, 1e-4, "rad");
    ASSERT_NEAR(direction(1950000u, UINT64_MAX), 0.945, 1e-4, "rad");
}
END_TEST

START_TEST(before_the_first_sample_there_is_none_after_it_there_is)
{
    insole_footfall_t f = footfall(0u, 500000u);
    insole_real_t rad = INSOLE_R(7.0);
    setup_test();
    ASSERT_UNCHANGED(way, insole_phone_way_direction(&way, &f, &rad), INSOLE_ERR_STATE);
    ck_assert(rad == INSOLE_R(7.0));
    face(40000000u, -1.25);
    ASSERT_NEAR(direction(0u, 500000u), -1.25, 1e-6, "rad");
    ASSERT_NEAR(direction(39000000u, 40000000u), -1.25, 1e-6, "rad");
}
END_TEST

/* Slots without samples count nothing; a step wholly among them has the last before it. */
START_TEST(times_without_samples_take_the_direction_before)
{
    setup_test();
    turn_about(0.5, 0.0, 1000000u, 2000000u, 10000u);
    turn_about(-2.0, 0.0, 4000000u, 5000000u, 10000u);
    ASSERT_NEAR(direction(2500000u, 3000000u), 0.5, 1e-5, "rad");
    ASSERT_NEAR(direction(2500000u, 4050000u), -2.0, 1e-5, "rad");
    ASSERT_NEAR(direction(1950000u, 3500000u), 0.5, 1e-5, "rad");
}
END_TEST

START_TEST(after_a_gap_longer_than_what_is_kept_nothing_old_is_left)
{
    setup_test();
    turn_about(0.5, 0.0, 1000000u, 9000000u, 10000u);
    face(60000000u, 2.0);
    ASSERT_NEAR(direction(1500000u, 2000000u), 2.0, 1e-6, "rad");
    ASSERT_NEAR(direction(59000000u, 60000000u), 2.0, 1e-6, "rad");
}
END_TEST

/* A stamp before the newest counts as the newest; the ring does not go back. */
START_TEST(time_that_stands_or_goes_back_fills_the_newest_slot)
{
    setup_test();
    face(8000000u, 0.2);
    for (int i = 0; i < 50; i++) {
        face(8000000u, 0.2);
        face(3000000u, 0.6);
    }
    ASSERT_NEAR(direction(7900000u, 8000000u),
                atan2(51.0 * sin(0.2) + 50.0 * sin(0.6), 51.0 * cos(0.2) + 50.0 * cos(0.6)), 1e-5,
                "rad");
    face(8100000u, 1.0);
    ASSERT_NEAR(direction(8100000u, 8150000u), 1.0, 1e-6, "rad");
}
END_TEST

START_TEST(directions_that_cancel_still_give_a_number)
{
    setup_test();
    face(1000000u, 0.7);
    for (int i = 0; i < 20; i++) {
        face(1200000u + 10000u * (uint64_t)(i / 2), i % 2 == 0 ? 1.0 : 1.0 - PI);
    }
    ASSERT_NEAR(direction(1200000u, 1299999u), 0.7, 1e-5, "rad"); /* the one before */
    setup_test();
    insole_turn_t none = {INSOLE_R(0.0), INSOLE_R(0.0)};
    ck_assert_int_eq(insole_phone_way_face(&way, 1000000u, none), INSOLE_OK);
    ck_assert(isfinite(direction(0u, 1000000u)));
}
END_TEST

START_TEST(a_step_that_ends_before_it_begins_has_the_direction_of_its_end)
{
    setup_test();
    turn_about(0.0, 1.0, 1000000u, 3000000u, 10000u);
    ASSERT_NEAR(direction(2700000u, 2000000u), direction(2000000u, 2000000u), 0.0, "rad");
}
END_TEST

/* Against an oracle that keeps every sample, for a walk of random turns and random gaps. */
START_TEST(random_walks_agree_with_sums_over_all_samples)
{
    enum { MOST = 4000 };
    static uint64_t t_us[MOST];
    static double rad[MOST];
    insole_rng_t rng;
    worst_t worst = {0.0, 0.0};
    int count = 0;
    insole_rng_seed(&rng, 11u + (uint64_t)_i);
    setup_test();
    uint64_t t = 3000000000u;
    for (double now = 0.0; count < MOST; count++) {
        t += insole_rng_bits(&rng) % 400u == 0u ? 700000u : 10000u;
        now += 0.05 * (double)insole_rng_normal(&rng);
        t_us[count] = t;
        rad[count] = now;
        face(t, now);
        if (count < 100 || insole_rng_bits(&rng) % 10u != 0u) {
            continue;
        }
        uint64_t begin = t - insole_rng_bits(&rng) % 5500000u, end = begin + 500000u;
        double c = 0.0, s = 0.0;
        for (int i = 0; i <= count; i++) {
            if (t_us[i] / 100000u >= begin / 100000u && t_us[i] / 100000u <= end / 100000u) {
                c += cos(rad[i]);
                s += sin(rad[i]);
            }
        }
        if (hypot(c, s) > 1.0) {
            worst_note(&worst, fabs(remainder(direction(begin, end) - atan2(s, c), 2.0 * PI)),
                       (double)count);
        }
    }
    ck_assert(worst.at > 0.0);
    ASSERT_WORST(worst, 2e-5, "rad");
}
END_TEST

/* ---- steps ------------------------------------------------------------------------------ */

static void go(uint64_t begin_us, uint64_t end_us, double x_m, double y_m)
{
    insole_footfall_t f = footfall(begin_us, end_us);
    ck_assert_int_eq(
        insole_phone_way_go(&way, &f, insole_spot((insole_real_t)x_m, (insole_real_t)y_m)),
        INSOLE_OK);
}

START_TEST(way_since_a_time_is_the_steps_after_it)
{
    setup_test();
    go(1000000u, 1500000u, 0.7, 0.0);
    go(1500000u, 2000000u, 0.0, 0.6);
    go(2100000u, 2600000u, -0.5, 0.1);
    insole_spot_t all = insole_phone_way_since(&way, 0u);
    insole_spot_t last = insole_phone_way_since(&way, 2050000u);
    insole_spot_t none = insole_phone_way_since(&way, 2600000u);
    ASSERT_NEAR(all.x_m, 0.2, 1e-6, "m");
    ASSERT_NEAR(all.y_m, 0.7, 1e-6, "m");
    ASSERT_NEAR(last.x_m, -0.5, 1e-6, "m");
    ASSERT_NEAR(last.y_m, 0.1, 1e-6, "m");
    ck_assert(none.x_m == INSOLE_R(0.0) && none.y_m == INSOLE_R(0.0));
}
END_TEST

START_TEST(a_step_counts_evenly_over_its_time)
{
    uint64_t t_us = 1000000u + 50000u * (uint64_t)_i;
    double left = 1.0 - fmin(1.0, 0.1 * _i);
    insole_footfall_t f = footfall(1000000u, 1500000u);
    setup_test();
    go(1000000u, 1500000u, 0.8, -0.4);
    insole_spot_t since = insole_phone_way_since(&way, t_us);
    ASSERT_NEAR(since.x_m, 0.8 * left, 1e-6, "m");
    ASSERT_NEAR(since.y_m, -0.4 * left, 1e-6, "m");
    ASSERT_NEAR(insole_phone_way_share(&f, t_us), 1.0 - left, 1e-6, "");
}
END_TEST

START_TEST(share_stays_within_zero_and_one)
{
    insole_footfall_t f = footfall(1000000u, 1500000u), empty = footfall(1000000u, 1000000u);
    ck_assert(insole_phone_way_share(&f, 0u) == INSOLE_R(0.0));
    ck_assert(insole_phone_way_share(&f, 1000000u) == INSOLE_R(0.0));
    ck_assert(insole_phone_way_share(&f, 1500000u) == INSOLE_R(1.0));
    ck_assert(insole_phone_way_share(&f, UINT64_MAX) == INSOLE_R(1.0));
    ck_assert(insole_phone_way_share(&empty, 1000000u) == INSOLE_R(0.0));
    ck_assert(insole_phone_way_share(&empty, 1000001u) == INSOLE_R(1.0));
}
END_TEST

/* 16 are kept: of 40 steps the last 16, whatever time is asked for. */
START_TEST(of_many_steps_the_last_sixteen_are_kept)
{
    setup_test();
    for (uint64_t i = 0u; i < 40u; i++) {
        go(500000u * i, 500000u * (i + 1u), (double)i, 1.0);
    }
    insole_spot_t all = insole_phone_way_since(&way, 0u);
    insole_spot_t half = insole_phone_way_since(&way, 500000u * 32u);
    ASSERT_NEAR(all.y_m, 16.0, 1e-5, "m");
    ASSERT_NEAR(all.x_m, (24.0 + 39.0) * 8.0, 1e-3, "m");
    ASSERT_NEAR(half.y_m, 8.0, 1e-5, "m");
    ASSERT_NEAR(half.x_m, (32.0 + 39.0) * 4.0, 1e-3, "m");
}
END_TEST

START_TEST(it_reaches_as_far_as_its_oldest_step)
{
    setup_test();
    ck_assert(insole_phone_way_reaches(&way, 0u));
    for (uint64_t i = 1u; i <= 15u; i++) {
        go(500000u * i, 500000u * (i + 1u), 0.7, 0.0);
        ck_assert(insole_phone_way_reaches(&way, 0u)); /* none has been forgotten */
    }
    for (uint64_t i = 16u; i <= 40u; i++) {
        go(500000u * i, 500000u * (i + 1u), 0.7, 0.0);
        ck_assert(insole_phone_way_reaches(&way, 500000u * (i - 15u)));
        ck_assert(!insole_phone_way_reaches(&way, 500000u * (i - 15u) - 1u));
    }
}
END_TEST

START_TEST(the_way_shrinks_steadily_as_the_time_goes_on)
{
    worst_t order = {0.0, 0.0};
    double before = 1e9;
    setup_test();
    for (uint64_t i = 0u; i < 12u; i++) {
        go(480000u * i, 480000u * (i + 1u), 0.7, 0.0);
    }
    for (uint64_t t = 0u; t < 6000000u; t += 7000u) {
        double x = (double)insole_phone_way_since(&way, t).x_m;
        worst_require(&order, x <= before + 1e-5, 1e-6 * (double)t);
        worst_note(&order, fmax(0.0, fabs(x - 0.7 * fmax(0.0, 12.0 - (double)t / 480000.0)) - 1e-5),
                   1e-6 * (double)t);
        before = x;
    }
    ASSERT_ALL_HELD(order);
}
END_TEST

/* ---- bad input -------------------------------------------------------------------------- */

static void fill(void)
{
    setup_test();
    turn_about(0.4, 0.1, 1000000u, 3000000u, 10000u);
    go(1000000u, 1500000u, 0.7, 0.1);
}

START_TEST(directions_that_are_none_are_refused)
{
    const insole_real_t bad[] = {(insole_real_t)NAN, (insole_real_t)INFINITY,
                                 -(insole_real_t)INFINITY, INSOLE_R(2.1), INSOLE_REAL_MAX};
    insole_turn_t by_cos = {bad[_i], INSOLE_R(0.0)}, by_sin = {INSOLE_R(0.0), bad[_i]};
    fill();
    ASSERT_UNCHANGED(way, insole_phone_way_face(&way, 3100000u, by_cos), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(way, insole_phone_way_face(&way, 3100000u, by_sin), INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(steps_that_are_none_are_refused)
{
    insole_footfall_t good = footfall(1500000u, 2000000u), still = footfall(1500000u, 1500000u);
    insole_footfall_t back = footfall(1500000u, 1000000u);
    insole_spot_t ahead = insole_spot(INSOLE_R(0.7), INSOLE_R(0.0));
    fill();
    ASSERT_UNCHANGED(way, insole_phone_way_go(&way, &still, ahead), INSOLE_ERR_TIME);
    ASSERT_UNCHANGED(way, insole_phone_way_go(&way, &back, ahead), INSOLE_ERR_TIME);
    ahead.x_m = (insole_real_t)NAN;
    ASSERT_UNCHANGED(way, insole_phone_way_go(&way, &good, ahead), INSOLE_ERR_VALUE);
    ahead = insole_spot(INSOLE_R(0.0), -(insole_real_t)INFINITY);
    ASSERT_UNCHANGED(way, insole_phone_way_go(&way, &good, ahead), INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(null_is_refused)
{
    insole_footfall_t f = footfall(1000000u, 1500000u);
    insole_real_t rad;
    insole_spot_t ahead = insole_spot(INSOLE_R(0.7), INSOLE_R(0.0));
    fill();
    ck_assert_int_eq(insole_phone_way_init(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_way_face(NULL, 1u, turn_of(0.0)), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_way_direction(NULL, &f, &rad), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_way_go(NULL, &f, ahead), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(way, insole_phone_way_direction(&way, NULL, &rad), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(way, insole_phone_way_direction(&way, &f, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(way, insole_phone_way_go(&way, NULL, ahead), INSOLE_ERR_NULL);
}
END_TEST

/* Any stamps and directions: what is told stays a direction. */
START_TEST(random_stamps_never_break_it)
{
    insole_rng_t rng;
    worst_t sane = {0.0, 0.0};
    insole_rng_seed(&rng, 5u);
    setup_test();
    for (int i = 0; i < 20000; i++) {
        uint64_t high = insole_rng_bits(&rng), low = insole_rng_bits(&rng);
        uint64_t t = insole_rng_bits(&rng) % 100u == 0u ? high << 32 | low : low;
        insole_turn_t turn = turn_of(2.0 * PI * (double)low / 4294967296.0);
        insole_footfall_t f = footfall(t - high % 1000000u, t);
        insole_real_t rad;
        (void)insole_phone_way_face(&way, t, turn);
        (void)insole_phone_way_go(&way, &f, insole_spot(turn.cos, turn.sin));
        (void)insole_phone_way_direction(&way, &f, &rad);
        worst_require(&sane, fabs((double)rad) <= 3.15, i);
        worst_require(&sane, insole_spot_is_finite(insole_phone_way_since(&way, high)), i);
    }
    ASSERT_ALL_HELD(sane);
}
END_TEST

/* 25 h in samples of 10 ms would take long: slots are what counts, one sample in each. */
START_TEST(long_runs_keep_their_directions)
{
    worst_t worst = {0.0, 0.0};
    setup_test();
    for (uint64_t i = 0u; i < 900000u; i++) {
        double rad = remainder(0.001 * (double)i, 2.0 * PI);
        (void)insole_phone_way_face(&way, 100000u * i, turn_of(rad));
        if (i % 10000u == 9999u) {
            double told = direction(100000u * (i - 20u), 100000u * (i - 16u));
            worst_note(&worst, fabs(remainder(told - 0.001 * (double)(i - 18u), 2.0 * PI)),
                       (double)i);
        }
    }
    ASSERT_WORST(worst, 1e-5, "rad");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_way");
    suite_add_loop(suite, "steady direction", a_steady_direction_is_told_as_it_is, 20);
    suite_add_loop(suite, "mean direction", direction_is_the_mean_over_the_time_of_the_step, 8);
    suite_add(suite, "about the back", mean_of_directions_about_the_back_is_the_back);
    suite_add_loop(suite, "told late", steps_told_late_have_the_direction_of_their_time, 5);
    suite_add(suite, "too long ago", what_is_too_long_ago_has_the_oldest_direction_kept);
    suite_add(suite, "still to come", what_is_still_to_come_has_the_newest_direction);
    suite_add(suite, "first sample", before_the_first_sample_there_is_none_after_it_there_is);
    suite_add(suite, "without samples", times_without_samples_take_the_direction_before);
    suite_add(suite, "long gap", after_a_gap_longer_than_what_is_kept_nothing_old_is_left);
    suite_add(suite, "time stands", time_that_stands_or_goes_back_fills_the_newest_slot);
    suite_add(suite, "they cancel", directions_that_cancel_still_give_a_number);
    suite_add(suite, "step backwards",
              a_step_that_ends_before_it_begins_has_the_direction_of_its_end);
    suite_add_loop(suite, "all samples", random_walks_agree_with_sums_over_all_samples, 3);
    suite_add(suite, "way since", way_since_a_time_is_the_steps_after_it);
    suite_add_loop(suite, "evenly", a_step_counts_evenly_over_its_time, 12);
    suite_add(suite, "share", share_stays_within_zero_and_one);
    suite_add(suite, "sixteen steps", of_many_steps_the_last_sixteen_are_kept);
    suite_add(suite, "reaches", it_reaches_as_far_as_its_oldest_step);
    suite_add(suite, "way shrinks", the_way_shrinks_steadily_as_the_time_goes_on);
    suite_add_loop(suite, "bad directions", directions_that_are_none_are_refused, 5);
    suite_add(suite, "bad steps", steps_that_are_none_are_refused);
    suite_add(suite, "NULL", null_is_refused);
    suite_add(suite, "random stamps", random_stamps_never_break_it);
    suite_add(suite, "long run", long_runs_keep_their_directions);
    return suite;
}
