/* SPDX-License-Identifier: MIT */
#include "insole/base/slot.h"

#include <stddef.h>

#include "insole/base/rng.h"
#include "suite.h"

static const uint32_t LENGTHS_US[] = {1u, 2u, 3u, 999u, 20000u, 50000u, 62500u, 65535u, 65536u};
enum { LENGTHS = sizeof LENGTHS_US / sizeof LENGTHS_US[0] };

static void expect(uint64_t t_us, uint32_t slot_us)
{
    uint64_t slot = insole_slot_of(t_us, slot_us);
    ck_assert_msg(slot == t_us / slot_us, "%llu / %u: %llu", (unsigned long long)t_us, slot_us,
                  (unsigned long long)slot);
}

START_TEST(borders_of_slots_are_exact)
{
    static const uint64_t SLOTS[] = {1u, 2u, 65535u, 65536u, 85899345u, UINT64_C(281474976710655)};
    for (size_t i = 0; i < sizeof SLOTS / sizeof SLOTS[0]; i++) {
        uint64_t border_us = SLOTS[i] * LENGTHS_US[_i];
        expect(border_us - 1u, LENGTHS_US[_i]);
        expect(border_us, LENGTHS_US[_i]);
        expect(border_us + 1u, LENGTHS_US[_i]);
    }
}
END_TEST

START_TEST(the_ends_of_the_clock_are_exact)
{
    static const uint64_t STAMPS_US[] = {0u,
                                         1u,
                                         UINT16_MAX,
                                         UINT32_MAX,
                                         UINT64_C(4294967296),
                                         UINT64_C(1790000000000000),
                                         (uint64_t)INT64_MAX,
                                         UINT64_MAX};
    for (size_t i = 0; i < sizeof STAMPS_US / sizeof STAMPS_US[0]; i++) {
        expect(STAMPS_US[i], LENGTHS_US[_i]);
    }
}
END_TEST

START_TEST(any_stamp_and_length_is_as_divided)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 11u);
    for (int i = 0; i < 20000; i++) {
        uint64_t t_us = (uint64_t)insole_rng_bits(&rng) << 32 | insole_rng_bits(&rng);
        expect(t_us >> (insole_rng_bits(&rng) % 64u), 1u + insole_rng_bits(&rng) % 65536u);
    }
}
END_TEST

START_TEST(a_length_out_of_range_has_no_slots)
{
    ck_assert_uint_eq(insole_slot_of(1000000u, 0u), 0u);
    ck_assert_uint_eq(insole_slot_of(1000000u, 65537u), 0u);
    ck_assert_uint_eq(insole_slot_of(1000000u, UINT32_MAX), 0u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("slot");
    suite_add_loop(suite, "borders", borders_of_slots_are_exact, LENGTHS);
    suite_add_loop(suite, "ends of the clock", the_ends_of_the_clock_are_exact, LENGTHS);
    suite_add(suite, "any", any_stamp_and_length_is_as_divided);
    suite_add(suite, "out of range", a_length_out_of_range_has_no_slots);
    return suite;
}
