/* SPDX-License-Identifier: MIT */
#include "insole/sense/past_min.h"

#include <string.h>

#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

enum { REACH_US = 400000, BLOCK_US = REACH_US / (INSOLE_PAST_BLOCKS - 1), MOST = 4000 };

static insole_past_min_t past;
static uint64_t t_us[MOST];
static double value[MOST];

static void begin(void)
{
    memset(&past, 0x55, sizeof past);
    ck_assert_int_eq(insole_past_min_init(&past, REACH_US), INSOLE_OK);
}

/* Of the first `count` values those that are at most `age_us` older than the last. */
static double least_of(int count, uint64_t age_us)
{
    double least = (double)INSOLE_REAL_MAX;
    for (int i = count - 1; i >= 0 && t_us[count - 1] - t_us[i] <= age_us; i--) {
        least = fmin(least, value[i]);
    }
    return least;
}

/* All of the reach counts, and nothing that is a block older than that. */
static void check_against_all(uint64_t first_us, uint32_t gap_every, uint64_t gap_us)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    begin();
    uint64_t now_us = first_us;
    worst_t narrow = {0.0, 0.0}, wide = {0.0, 0.0};
    for (int i = 0; i < MOST; i++) {
        now_us += 1000u + insole_rng_bits(&rng) % 9000u;
        now_us += insole_rng_bits(&rng) % gap_every == 0u ? gap_us : 0u;
        t_us[i] = now_us;
        insole_real_t v = sample_between(&rng, INSOLE_R(0.0), INSOLE_R(100.0));
        value[i] = (double)v;
        insole_past_min_push(&past, (uint32_t)now_us, v);
        double least = (double)insole_past_min(&past);
        worst_require(&narrow, least <= least_of(i + 1, (INSOLE_PAST_BLOCKS - 1) * BLOCK_US), i);
        worst_require(&wide, least >= least_of(i + 1, INSOLE_PAST_BLOCKS * BLOCK_US), i);
    }
    ASSERT_ALL_HELD(narrow);
    ASSERT_ALL_HELD(wide);
}

START_TEST(the_least_of_the_reach)
{
    check_against_all(0u, 1000000u, 0u);
}
END_TEST

START_TEST(gaps_short_and_long)
{
    static const uint64_t GAPS_US[] = {20000u, 100000u, 350000u, 460000u, 1000000u, 600000000u};
    check_against_all(12345u, 50u, GAPS_US[_i]);
}
END_TEST

START_TEST(stamps_that_wrap)
{
    check_against_all(UINT64_C(4294967296) - 5000000u, 1000000u, 0u);
}
END_TEST

START_TEST(nothing_is_more_than_all)
{
    begin();
    ck_assert(insole_past_min(&past) == INSOLE_REAL_MAX);
    ck_assert(insole_past_min(NULL) == INSOLE_REAL_MAX);
    insole_past_min_push(&past, 5u, INSOLE_R(3.0));
    ck_assert(insole_past_min(&past) == INSOLE_R(3.0));
    insole_past_min_push(&past, 6u, INSOLE_R(4.0));
    ck_assert(insole_past_min(&past) == INSOLE_R(3.0));
    insole_past_min_move_on(&past, 100000000u); /* all of it is over */
    ck_assert(insole_past_min(&past) == INSOLE_REAL_MAX);
}
END_TEST

START_TEST(bad_calls_are_refused)
{
    begin();
    ck_assert_int_eq(insole_past_min_init(NULL, REACH_US), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(past, insole_past_min_init(&past, INSOLE_PAST_BLOCKS - 2), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(past, insole_past_min_init(&past, 0u), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_past_min_init(&past, INSOLE_PAST_BLOCKS - 1), INSOLE_OK);
    insole_past_min_move_on(NULL, 1u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("past_min");
    suite_add(suite, "least", the_least_of_the_reach);
    suite_add_loop(suite, "gaps", gaps_short_and_long, 6);
    suite_add(suite, "wrap", stamps_that_wrap);
    suite_add(suite, "empty", nothing_is_more_than_all);
    suite_add(suite, "refusals", bad_calls_are_refused);
    return suite;
}
