/* SPDX-License-Identifier: MIT */
#include "insole/base/divide.h"

#include "insole/base/rng.h"
#include "suite.h"

static const uint32_t DIVISORS[] = {1u,       2u,       3u,       7u,        255u,
                                    256u,     50000u,   65535u,   65536u,    100000u,
                                    1000000u, 3600000u, 8388608u, 16777215u, 16777216u};

enum { DIVISOR_COUNT = sizeof DIVISORS / sizeof DIVISORS[0] };

/* By what a quotient is, not by another division. */
static void expect_quotient(uint64_t number, uint32_t by)
{
    uint64_t quotient = insole_divide(number, by);
    uint64_t product = quotient * by;
    ck_assert_msg(quotient <= UINT64_MAX / by && product <= number && number - product < by,
                  "%llu / %u is not %llu", (unsigned long long)number, by,
                  (unsigned long long)quotient);
}

START_TEST(ends_are_divided)
{
    uint32_t by = DIVISORS[_i];
    const uint64_t numbers[] = {0u,
                                1u,
                                by - 1u,
                                by,
                                by + 1u,
                                2u * (uint64_t)by - 1u,
                                UINT32_MAX,
                                1ull << 32,
                                UINT64_MAX - by,
                                UINT64_MAX - 1u,
                                UINT64_MAX};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        expect_quotient(numbers[i], by);
    }
}
END_TEST

START_TEST(any_number_is_divided)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, (uint64_t)_i);
    for (int i = 0; i < 20000; i++) {
        uint64_t number = (uint64_t)insole_rng_bits(&rng) << 32 | insole_rng_bits(&rng);
        expect_quotient(number >> (i % 64), DIVISORS[_i]);
    }
}
END_TEST

START_TEST(by_hand)
{
    ck_assert_uint_eq(insole_divide(1700000000123456u, 100000u), 17000000001u);
    ck_assert_uint_eq(insole_divide(99999u, 100000u), 0u);
    ck_assert_uint_eq(insole_divide(UINT64_MAX, 1u), UINT64_MAX);
    ck_assert_uint_eq(insole_divide(UINT64_MAX, 16777216u), 1099511627775u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("divide");
    suite_add_loop(suite, "ends", ends_are_divided, DIVISOR_COUNT);
    suite_add_loop(suite, "any number", any_number_is_divided, DIVISOR_COUNT);
    suite_add(suite, "by hand", by_hand);
    return suite;
}
