/* SPDX-License-Identifier: MIT */
#include "insole/base/types.h"

#include "near.h"
#include "suite.h"

static const uint64_t NOW_US = UINT64_C(1790000000000000); /* a clock that counts since 1970 */

/* Spans on both sides of what half of a stamp holds, against double. */
START_TEST(spans_are_right_to_the_last_digit)
{
    static const uint64_t SPANS_US[] = {0u,
                                        1u,
                                        2500u,
                                        16777217u,
                                        UINT32_MAX,
                                        UINT64_C(4294967296),
                                        UINT64_C(4294967297),
                                        UINT64_C(86400000000),
                                        UINT64_C(31557600000000),
                                        UINT64_C(9007199254740993)};
    for (size_t i = 0; i < sizeof SPANS_US / sizeof SPANS_US[0]; i++) {
        double expected_s = (double)SPANS_US[i] * 1.0e-6;
        double tolerance_s = 1.5 * (double)INSOLE_REAL_EPSILON * expected_s;
        ASSERT_NEAR(insole_seconds(NOW_US, NOW_US + SPANS_US[i]), expected_s, tolerance_s, "s");
        ASSERT_NEAR(insole_seconds_of(SPANS_US[i]), expected_s, tolerance_s, "s");
    }
}
END_TEST

START_TEST(spans_never_fall)
{
    insole_real_t last_s = INSOLE_R(-1.0);
    for (uint64_t us = UINT64_C(4294966000); us < UINT64_C(4294968600); us += 13u) {
        insole_real_t s = insole_seconds(NOW_US, NOW_US + us);
        ck_assert_msg(s >= last_s, "%llu us", (unsigned long long)us);
        last_s = s;
    }
}
END_TEST

START_TEST(a_span_may_cross_the_wrap_of_the_clock)
{
    ASSERT_NEAR(insole_seconds(UINT64_MAX - 999999u, 1500000u), 2.5, 1e-6, "s");
}
END_TEST

START_TEST(microseconds_are_rounded)
{
    const struct {
        insole_real_t s;
        uint32_t us;
    } cases[] = {{INSOLE_R(0.0), 0u},         {INSOLE_R(0.4e-6), 0u},
                 {INSOLE_R(0.6e-6), 1u},      {INSOLE_R(0.0025), 2500u},
                 {INSOLE_R(0.25), 250000u},   {INSOLE_R(1.0), 1000000u},
                 {INSOLE_R(60.0), 60000000u}, {INSOLE_R(3600.0), 3600000000u}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ck_assert_uint_eq(insole_microseconds(cases[i].s), cases[i].us);
    }
}
END_TEST

START_TEST(seconds_come_back_as_the_microseconds_they_were)
{
    for (uint32_t us = 0u; us < 4000000u; us += 1237u) {
        ck_assert_uint_eq(insole_microseconds(insole_seconds(NOW_US, NOW_US + us)), us);
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("types");
    suite_add(suite, "spans", spans_are_right_to_the_last_digit);
    suite_add(suite, "spans never fall", spans_never_fall);
    suite_add(suite, "wrap of the clock", a_span_may_cross_the_wrap_of_the_clock);
    suite_add(suite, "microseconds", microseconds_are_rounded);
    suite_add(suite, "there and back", seconds_come_back_as_the_microseconds_they_were);
    return suite;
}
