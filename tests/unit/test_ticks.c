/* SPDX-License-Identifier: MIT */
#include "insole/base/ticks.h"

#include <string.h>

#include "near.h"
#include "sample.h"
#include "suite.h"

static const uint32_t RATES_HZ[] = {1u,        3u,         32768u,      1000000u,  999983u,
                                    84000000u, 168000000u, 4000000007u, UINT32_MAX};
enum { RATE_COUNT = sizeof RATES_HZ / sizeof RATES_HZ[0] };

static insole_ticks_t clock_of(uint32_t rate_hz, uint32_t counter)
{
    insole_ticks_t ticks;
    ck_assert_int_eq(insole_ticks_init(&ticks, rate_hz, counter), INSOLE_OK);
    return ticks;
}

/* floor(ticks 10^6 / rate), exact: whole seconds first, then what is left of a second. */
static uint64_t exact_us(uint64_t ticks, uint32_t rate_hz)
{
    return ticks / rate_hz * 1000000u + ticks % rate_hz * 1000000u / rate_hz;
}

static const char *const WRONG_TIME = "us, time differs from the exact one";

START_TEST(a_day_at_84_mhz_is_exact)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    uint64_t total = 0u, day = 84000000u * (uint64_t)86400u;
    uint32_t counter = 0xfff00000u, start = counter;
    insole_ticks_t ticks = clock_of(84000000u, counter);
    worst_t exact = {0.0, 0.0};
    while (total < day) {
        total += 800000u + insole_rng_bits(&rng) % 80000u; /* a sample each 10 ms, with jitter */
        counter = start + (uint32_t)total;
        uint64_t now_us = insole_ticks_now_us(&ticks, counter);
        worst_require(&exact, now_us == exact_us(total, 84000000u), (double)now_us);
    }
    ck_assert_uint_ge(insole_ticks_now_us(&ticks, counter), 86400u * (uint64_t)1000000u);
    ck_assert_uint_gt(total >> 32, 1600u); /* that many times the counter wrapped */
    ASSERT_WORST(exact, 0.0, WRONG_TIME);
}
END_TEST

/* Steps of every size up to a whole turn of the counter, at any rate. */
START_TEST(any_rate_and_any_step_are_exact)
{
    uint32_t rate_hz = RATES_HZ[_i], counter = 12345u;
    insole_rng_t rng;
    insole_rng_seed(&rng, 100u + (uint64_t)_i);
    insole_ticks_t ticks = clock_of(rate_hz, counter);
    uint64_t total = 0u;
    worst_t exact = {0.0, 0.0};
    for (int i = 0; i < 200000; i++) {
        uint32_t step = insole_rng_bits(&rng) >> (insole_rng_bits(&rng) % 32u);
        total += step;
        counter += step;
        uint64_t now_us = insole_ticks_now_us(&ticks, counter);
        worst_require(&exact, now_us == exact_us(total, rate_hz), (double)i);
    }
    ASSERT_WORST(exact, 0.0, WRONG_TIME);
}
END_TEST

/* The largest step at the largest remainder: what is added up must not leave 64 bits. */
START_TEST(longest_steps_do_not_overflow)
{
    uint32_t rate_hz = RATES_HZ[_i], counter = 0u;
    insole_ticks_t ticks = clock_of(rate_hz, counter);
    for (uint64_t turns = 1u; turns <= 1000u; turns++) {
        counter += UINT32_MAX;
        ck_assert_uint_eq(insole_ticks_now_us(&ticks, counter),
                          exact_us(turns * UINT32_MAX, rate_hz));
        ck_assert_uint_lt(ticks.remainder, rate_hz);
    }
}
END_TEST

START_TEST(single_ticks_add_up)
{
    insole_ticks_t ticks = clock_of(32768u, UINT32_MAX - 100u);
    uint32_t counter = UINT32_MAX - 100u;
    for (uint64_t count = 1u; count <= 100000u; count++) {
        counter++;
        uint64_t now_us = insole_ticks_now_us(&ticks, counter);
        if (count % 32768u == 0u) {
            ck_assert_uint_eq(now_us, count / 32768u * 1000000u);
        }
    }
    ck_assert_uint_eq(insole_ticks_now_us(&ticks, counter), 3051757u); /* 100000 / 32768 s */
}
END_TEST

START_TEST(a_counter_that_stands_gives_the_same_time)
{
    insole_ticks_t ticks = clock_of(3u, 7u);
    ck_assert_uint_eq(insole_ticks_now_us(&ticks, 7u), 0u);
    ck_assert_uint_eq(insole_ticks_now_us(&ticks, 8u), 333333u);
    insole_ticks_t before = ticks;
    ck_assert_uint_eq(insole_ticks_now_us(&ticks, 8u), 333333u);
    ck_assert_int_eq(memcmp(&before, &ticks, sizeof ticks), 0);
    ck_assert_uint_eq(insole_ticks_now_us(&ticks, 9u), 666666u);
    ck_assert_uint_eq(insole_ticks_now_us(&ticks, 10u), 1000000u);
}
END_TEST

/* Often or rarely asked, the time is the same. */
START_TEST(how_often_one_asks_does_not_matter)
{
    insole_ticks_t often = clock_of(999983u, 0u), rarely = often;
    for (uint32_t counter = 1u; counter <= 1000000u; counter++) {
        (void)insole_ticks_now_us(&often, counter);
    }
    ck_assert_uint_eq(insole_ticks_now_us(&often, 1000001u),
                      insole_ticks_now_us(&rarely, 1000001u));
    ck_assert_int_eq(memcmp(&often, &rarely, sizeof often), 0);
}
END_TEST

START_TEST(a_copied_clock_goes_on_alike)
{
    insole_ticks_t ticks = clock_of(168000000u, 99u);
    (void)insole_ticks_now_us(&ticks, 123456789u);
    insole_ticks_t saved = ticks;
    ck_assert_uint_eq(insole_ticks_now_us(&ticks, 5u), insole_ticks_now_us(&saved, 5u));
    ck_assert_int_eq(memcmp(&ticks, &saved, sizeof ticks), 0);
}
END_TEST

START_TEST(refusals_leave_the_clock_alone)
{
    insole_ticks_t ticks, before;
    memset(&ticks, 0x5a, sizeof ticks);
    before = ticks;
    ck_assert_int_eq(insole_ticks_init(NULL, 1000u, 0u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_ticks_init(&ticks, 0u, 5u), INSOLE_ERR_VALUE);
    ck_assert_int_eq(memcmp(&before, &ticks, sizeof ticks), 0);
    ck_assert_uint_eq(insole_ticks_now_us(NULL, 1u), 0u);
}
END_TEST

START_TEST(a_clock_never_set_up_stands_still)
{
    insole_ticks_t ticks, before;
    memset(&ticks, 0, sizeof ticks);
    before = ticks;
    ck_assert_uint_eq(insole_ticks_now_us(&ticks, 123u), 0u);
    ck_assert_int_eq(memcmp(&before, &ticks, sizeof ticks), 0);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("ticks");
    suite_add(suite, "a day at 84 MHz", a_day_at_84_mhz_is_exact);
    suite_add_loop(suite, "any rate, any step", any_rate_and_any_step_are_exact, RATE_COUNT);
    suite_add_loop(suite, "longest steps", longest_steps_do_not_overflow, RATE_COUNT);
    suite_add(suite, "single ticks", single_ticks_add_up);
    suite_add(suite, "standing counter", a_counter_that_stands_gives_the_same_time);
    suite_add(suite, "how often", how_often_one_asks_does_not_matter);
    suite_add(suite, "copied clock", a_copied_clock_goes_on_alike);
    suite_add(suite, "refusals", refusals_leave_the_clock_alone);
    suite_add(suite, "never set up", a_clock_never_set_up_stands_still);
    return suite;
}
