/* SPDX-License-Identifier: MIT */
#include "insole/base/config.h"

#include <stddef.h>
#include <string.h>

#include "near.h"
#include "suite.h"

/* A config as a module would list it. */
#define LAMP_KEYS(KEY)                                                                             \
    KEY(REAL, glow_s, 0.2, 0.05, 2.0, "s", "how long it glows")                                    \
    KEY(INT, blinks, 3, -4, 70000, "", "how often it blinks")                                      \
    KEY(CHOICE, colour, 1, 0, 2, "red|green|blue", "which light")                                  \
    KEY(REAL, drift, -1.5, -2.0, -1.0, "", "below zero all over")

typedef struct {
    LAMP_KEYS(INSOLE_CONFIG_MEMBER)
} lamp_config_t;

static const lamp_config_t LAMP_DEFAULTS = {LAMP_KEYS(INSOLE_CONFIG_DEFAULT)};

typedef lamp_config_t config_t;
static const insole_config_range_t RANGES[] = {LAMP_KEYS(INSOLE_CONFIG_RANGE)};
enum { KEYS = sizeof RANGES / sizeof RANGES[0] };

/* The settings stay as they are, whatever is said of them. */
static bool lamp_in_range(const lamp_config_t *config)
{
    const lamp_config_t before = *config;
    insole_status_t status = insole_config_check(config, RANGES, KEYS);
    ck_assert_mem_eq(config, &before, sizeof before);
    ck_assert(status == INSOLE_OK || status == INSOLE_ERR_VALUE);
    return status == INSOLE_OK;
}

START_TEST(the_struct_has_the_listed_members_in_order)
{
    ck_assert_uint_eq(sizeof((lamp_config_t *)0)->glow_s, sizeof(insole_real_t));
    ck_assert_uint_eq(sizeof((lamp_config_t *)0)->blinks, sizeof(int32_t));
    ck_assert_uint_eq(sizeof((lamp_config_t *)0)->colour, sizeof(int32_t));
    ck_assert_uint_eq(offsetof(lamp_config_t, glow_s), 0u);
    ck_assert_uint_lt(offsetof(lamp_config_t, blinks), offsetof(lamp_config_t, colour));
    ck_assert_uint_lt(offsetof(lamp_config_t, colour), offsetof(lamp_config_t, drift));
}
END_TEST

START_TEST(the_defaults_are_the_listed_ones)
{
    ASSERT_NEAR(LAMP_DEFAULTS.glow_s, INSOLE_R(0.2), 0.0, "s");
    ck_assert_int_eq(LAMP_DEFAULTS.blinks, 3);
    ck_assert_int_eq(LAMP_DEFAULTS.colour, 1);
    ASSERT_NEAR(LAMP_DEFAULTS.drift, INSOLE_R(-1.5), 0.0, "");
    ck_assert(lamp_in_range(&LAMP_DEFAULTS));
}
END_TEST

START_TEST(the_table_tells_where_each_is_and_what_it_may_be)
{
    const insole_config_range_t expected[] = {
        {INSOLE_R(0.05), INSOLE_R(2.0), (uint16_t)offsetof(lamp_config_t, glow_s), false},
        {INSOLE_R(-4.0), INSOLE_R(70000.0), (uint16_t)offsetof(lamp_config_t, blinks), true},
        {INSOLE_R(0.0), INSOLE_R(2.0), (uint16_t)offsetof(lamp_config_t, colour), true},
        {INSOLE_R(-2.0), INSOLE_R(-1.0), (uint16_t)offsetof(lamp_config_t, drift), false},
    };
    ck_assert_int_eq(KEYS, 4);
    for (int i = 0; i < KEYS; i++) {
        ASSERT_NEAR(RANGES[i].low, expected[i].low, 0.0, "");
        ASSERT_NEAR(RANGES[i].high, expected[i].high, 0.0, "");
        ck_assert_uint_eq(RANGES[i].offset, expected[i].offset);
        ck_assert_int_eq(RANGES[i].is_whole, expected[i].is_whole);
    }
}
END_TEST

START_TEST(real_settings_have_closed_ranges)
{
    const insole_real_t low = INSOLE_R(0.05), high = INSOLE_R(2.0);
    const struct {
        insole_real_t value;
        bool good;
    } cases[] = {
        {low, true},
        {high, true},
        {INSOLE_R(1.0), true},
        {low * (INSOLE_R(1.0) - INSOLE_REAL_EPSILON), false},
        {high * (INSOLE_R(1.0) + INSOLE_REAL_EPSILON), false},
        {INSOLE_R(0.0), false},
        {INSOLE_R(-1.0), false},
        {(insole_real_t)INFINITY, false},
        {-(insole_real_t)INFINITY, false},
        {(insole_real_t)NAN, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        lamp_config_t config = LAMP_DEFAULTS;
        config.glow_s = cases[i].value;
        ck_assert_msg(lamp_in_range(&config) == cases[i].good, "case %zu", i);
    }
}
END_TEST

START_TEST(whole_numbers_have_closed_ranges)
{
    static const struct {
        int32_t value;
        bool good;
    } CASES[] = {{-4, true},     {70000, true},      {-5, false},
                 {70001, false}, {INT32_MIN, false}, {INT32_MAX, false}};
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        lamp_config_t config = LAMP_DEFAULTS;
        config.blinks = CASES[i].value;
        ck_assert_msg(lamp_in_range(&config) == CASES[i].good, "case %zu", i);
    }
}
END_TEST

/* A real holds the ends of a whole number, yet not its every value: no neighbour slips through. */
START_TEST(the_largest_whole_ends_are_exact)
{
    typedef struct {
        int32_t count;
    } tally_t;
    const int32_t most = (1 << 24) - 1;
    const insole_config_range_t range = {-(insole_real_t)most, (insole_real_t)most, 0u, true};
    for (int32_t off = -3; off <= 3; off++) {
        tally_t high = {most + off}, low = {-most - off};
        insole_status_t expected = off <= 0 ? INSOLE_OK : INSOLE_ERR_VALUE;
        ck_assert_msg(insole_config_check(&high, &range, 1u) == expected, "most + %d", off);
        ck_assert_msg(insole_config_check(&low, &range, 1u) == expected, "least - %d", off);
    }
}
END_TEST

START_TEST(nothing_is_refused)
{
    ck_assert_int_eq(insole_config_check(NULL, RANGES, KEYS), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_config_check(&LAMP_DEFAULTS, NULL, KEYS), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(as_many_rows_count_as_are_told)
{
    lamp_config_t config = LAMP_DEFAULTS;
    config.colour = 3;
    ck_assert_int_eq(insole_config_check(&config, RANGES, 0u), INSOLE_OK);
    ck_assert_int_eq(insole_config_check(&config, RANGES, 2u), INSOLE_OK);
    ck_assert_int_eq(insole_config_check(&config, RANGES, 3u), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_config_check(&config, RANGES + 3, 1u), INSOLE_OK);
}
END_TEST

/* One member out of range is enough, whichever it is; all members count. */
START_TEST(every_member_is_checked)
{
    for (int colour = -1; colour <= 3; colour++) {
        lamp_config_t config = LAMP_DEFAULTS;
        config.colour = colour;
        ck_assert_int_eq(lamp_in_range(&config), colour >= 0 && colour <= 2);
    }
    lamp_config_t config = LAMP_DEFAULTS;
    config.drift = INSOLE_R(-0.5);
    ck_assert(!lamp_in_range(&config));
    config.drift = INSOLE_R(-2.0);
    ck_assert(lamp_in_range(&config));
}
END_TEST

/* A module may build other tables from its list: here the names of the keys. */
START_TEST(the_list_serves_for_more)
{
#define NAME_OF(kind, name, value, low, high, unit, text) #kind " " #name " [" unit "] " text,
    static const char *const NAMES[] = {LAMP_KEYS(NAME_OF)};
#undef NAME_OF
    ck_assert_uint_eq(sizeof NAMES / sizeof NAMES[0], 4u);
    ck_assert_str_eq(NAMES[0], "REAL glow_s [s] how long it glows");
    ck_assert_str_eq(NAMES[2], "CHOICE colour [red|green|blue] which light");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("config");
    suite_add(suite, "members", the_struct_has_the_listed_members_in_order);
    suite_add(suite, "defaults", the_defaults_are_the_listed_ones);
    suite_add(suite, "real ranges", real_settings_have_closed_ranges);
    suite_add(suite, "whole ranges", whole_numbers_have_closed_ranges);
    suite_add(suite, "table", the_table_tells_where_each_is_and_what_it_may_be);
    suite_add(suite, "largest whole ends", the_largest_whole_ends_are_exact);
    suite_add(suite, "NULL", nothing_is_refused);
    suite_add(suite, "count", as_many_rows_count_as_are_told);
    suite_add(suite, "every member", every_member_is_checked);
    suite_add(suite, "other tables", the_list_serves_for_more);
    return suite;
}
