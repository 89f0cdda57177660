/* SPDX-License-Identifier: MIT */
#include "insole/sense/even_clock.h"

#include <string.h>

#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

static insole_even_clock_t evened;

static void begin(void)
{
    memset(&evened, 0x55, sizeof evened);
    ck_assert_int_eq(insole_even_clock_init(&evened), INSOLE_OK);
}

/* Intervals of the length given, until the period is known. */
static void learn(uint32_t dt_us)
{
    begin();
    for (int i = 0; i < INSOLE_EVEN_CLOCK_INTERVALS; i++) {
        ck_assert(!(evened.period_us > INSOLE_R(0.0)));
        ck_assert_int_eq(insole_even_clock_tick(&evened, dt_us), INSOLE_ERR_STATE);
    }
}

START_TEST(the_period_is_the_mean_of_the_first_intervals)
{
    begin();
    double sum_us = 0.0;
    for (uint32_t i = 0; i < INSOLE_EVEN_CLOCK_INTERVALS; i++) {
        sum_us += 4000.0 + 100.0 * i;
        ck_assert_int_eq(insole_even_clock_tick(&evened, 4000u + 100u * i), INSOLE_ERR_STATE);
    }
    ASSERT_NEAR(evened.period_us, sum_us / INSOLE_EVEN_CLOCK_INTERVALS, 1e-3, "us");
    ck_assert_int_eq(insole_even_clock_tick(&evened, 4950u), INSOLE_OK);
}
END_TEST

START_TEST(even_stamps_are_left_alone)
{
    learn(5000u);
    worst_t lead = {0.0, 0.0}, share = {0.0, 0.0};
    for (int i = 0; i < 1000; i++) {
        ck_assert_int_eq(insole_even_clock_tick(&evened, 5000u), INSOLE_OK);
        worst_note(&lead, fabs((double)evened.lead_us), i);
        worst_note(&share, (double)evened.burst_share, i);
    }
    ASSERT_WORST(lead, 0.0, "us");
    ASSERT_WORST(share, 0.0, "");
}
END_TEST

/* The same in double, of stamps instead of intervals: where the even clock stands. */
START_TEST(phase_and_period_follow_as_told)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    learn(5000u);
    double raw_us = 0.0, even_us = 0.0, period_us = 5000.0;
    worst_t phase = {0.0, 0.0}, period = {0.0, 0.0};
    for (int i = 0; i < 2000; i++) {
        uint32_t dt_us = 3000u + insole_rng_bits(&rng) % 4000u;
        raw_us += dt_us;
        double expected_us = even_us + period_us, error_us = raw_us - expected_us;
        even_us = expected_us + 0.05 * error_us;
        period_us += 0.0006 * error_us;
        ck_assert_int_eq(insole_even_clock_tick(&evened, dt_us), INSOLE_OK);
        if (fabs(error_us) > INSOLE_EVEN_CLOCK_REACH_US) {
            even_us = raw_us;
        }
        worst_note(&phase, fabs((double)evened.lead_us - (even_us - raw_us)), i);
        worst_note(&period, fabs((double)evened.period_us - period_us), i);
    }
    ASSERT_WORST(phase, 0.5, "us");
    ASSERT_WORST(period, 0.05, "us");
}
END_TEST

/* Four samples read at once: three intervals of next to nothing, one of nearly all. */
START_TEST(stamps_of_bursts_are_put_apart)
{
    begin();
    double raw_us = 0.0;
    worst_t off = {0.0, 0.0}, least = {0.0, 0.0};
    double last_us = 0.0;
    for (int i = 1; i < 4000; i++) {
        uint32_t dt_us = i % 4 == 0 ? 4u * 5000u - 3u * 100u : 100u;
        raw_us += dt_us;
        (void)insole_even_clock_tick(&evened, dt_us);
        double even_us = raw_us + (double)evened.lead_us;
        if (i > 2000) {
            worst_note(&off, fabs(even_us - last_us - 5000.0), i);
            worst_require(&least, even_us > last_us, i);
        }
        last_us = even_us;
    }
    ASSERT_WORST(off, 1000.0, "us");
    ASSERT_ALL_HELD(least);
    ASSERT_NEAR(evened.burst_share, 0.75, 0.02, "");
    ASSERT_NEAR(evened.period_us, 5000.0, 10.0, "us");
}
END_TEST

START_TEST(what_is_too_far_off_starts_it_anew)
{
    learn(5000u);
    ck_assert_int_eq(insole_even_clock_tick(&evened, 15000u), INSOLE_OK);
    ASSERT_NEAR(evened.lead_us, -9500.0, 1.0, "us");
    insole_real_t period_us = evened.period_us;
    ck_assert_int_eq(insole_even_clock_tick(&evened, 200000u), INSOLE_OK);
    ASSERT_NEAR(evened.lead_us, 0.0, 0.0, "us");
    ck_assert(evened.period_us == period_us);
}
END_TEST

START_TEST(it_starts_anew_when_told)
{
    learn(5000u);
    ck_assert_int_eq(insole_even_clock_tick(&evened, 9000u), INSOLE_OK);
    insole_even_clock_t before = evened;
    ck_assert(evened.lead_us < INSOLE_R(0.0));
    insole_even_clock_restart(&evened);
    before.lead_us = INSOLE_R(0.0);
    ck_assert_mem_eq(&evened, &before, sizeof before);
}
END_TEST

START_TEST(bad_calls_are_refused)
{
    ck_assert_int_eq(insole_even_clock_init(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_even_clock_tick(NULL, 1u), INSOLE_ERR_NULL);
    insole_even_clock_restart(NULL);
    begin();
    ASSERT_UNCHANGED(evened, insole_even_clock_tick(&evened, 0u), INSOLE_ERR_VALUE);
    learn(5000u);
    ASSERT_UNCHANGED(evened, insole_even_clock_tick(&evened, 0u), INSOLE_ERR_VALUE);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("even_clock");
    suite_add(suite, "period", the_period_is_the_mean_of_the_first_intervals);
    suite_add(suite, "even", even_stamps_are_left_alone);
    suite_add(suite, "follows", phase_and_period_follow_as_told);
    suite_add(suite, "bursts", stamps_of_bursts_are_put_apart);
    suite_add(suite, "far off", what_is_too_far_off_starts_it_anew);
    suite_add(suite, "restart", it_starts_anew_when_told);
    suite_add(suite, "refusals", bad_calls_are_refused);
    return suite;
}
