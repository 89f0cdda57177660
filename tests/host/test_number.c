/* SPDX-License-Identifier: MIT */
#include "number.h"

#include <float.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "near.h"
#include "suite.h"

/* ---- reading ---------------------------------------------------------------------------- */

static const char *const good_numbers[] = {
    "0",       "-0",      "1",        "+7",      "12.",      ".5",       "-.25",      "3e2",
    "1E-3",    "1.5e+10", "00012.50", "9.80665", "0.1",      "1e22",     "123456789012345",
    "0.000001234567", "4.9e-10", "179769313486231e294", "-2.2250738585072014e-300"};

START_TEST(numbers_are_read_as_the_c_library_reads_them)
{
    double value = -1.0;
    double expected = strtod(good_numbers[_i], NULL);
    ck_assert_msg(number_parse(good_numbers[_i], &value), "%s", good_numbers[_i]);
    ASSERT_NEAR(value, expected, fabs(expected) * DBL_EPSILON, "");
}
END_TEST

START_TEST(short_decimals_are_read_exactly)
{
    char text[32];
    srand(1);
    for (int i = 0; i < 200000; i++) {
        double value = -1.0;
        snprintf(text, sizeof text, "%d.%0*d", rand() % 2000 - 1000, 1 + rand() % 9, rand() % 1000);
        ck_assert(number_parse(text, &value));
        ck_assert_msg(value == strtod(text, NULL), "%s", text);
    }
}
END_TEST

static const char *const bad_numbers[] = {"",     "-",     "+",    ".",    "e5",    "1e",   "1e+",
                                          "1,5",  "0x10",  "1 ",   " 1",   "1.2.3", "--1",  "1e999",
                                          "nan",  "inf",   "1f",   "1_0",  "one",   "1e5.0"};

START_TEST(what_is_no_number_is_refused)
{
    double value = 42.0;
    ck_assert_msg(!number_parse(bad_numbers[_i], &value), "%s", bad_numbers[_i]);
    ck_assert(value == 42.0);
}
END_TEST

static const char *const silent_sensors[] = {"", "nan", "NaN", "-nan", "inf", "-Inf", "+INFINITY"};

START_TEST(a_sensor_may_say_nothing)
{
    double value = 0.0;
    ck_assert_msg(number_parse_sensor(silent_sensors[_i], &value), "%s", silent_sensors[_i]);
    ck_assert(isnan(value));
}
END_TEST

START_TEST(a_sensor_may_not_say_just_anything)
{
    double value = 0.0;
    ck_assert(!number_parse_sensor("nano", &value));
    ck_assert(!number_parse_sensor("-", &value));
    ck_assert(!number_parse_sensor("in", &value));
    ck_assert(number_parse_sensor("-9.5", &value));
    ck_assert(value == -9.5);
}
END_TEST

/* ---- times ------------------------------------------------------------------------------ */

static const struct {
    const char *text;
    int64_t t_us;
} good_times[] = {{"0", 0},
                  {"-0.0", 0},
                  {"1.5", 1500000},
                  {"-1.5", -1500000},
                  {"0.000001", 1},
                  {"-0.000001", -1},
                  {".25", 250000},
                  {"12.", 12000000},
                  {"+3", 3000000},
                  {"0.1", 100000},
                  {"0.3", 300000},
                  {"16777217.000001", 16777217000001},
                  {"1700000000.123456", 1700000000123456},
                  {"0.0000005", 1},
                  {"0.00000049999", 0},
                  {"0.9999999", 1000000},
                  {"-0.9999995", -1000000},
                  {"2.9999994999", 2999999},
                  {"99999999999.999999", 99999999999999999}};

START_TEST(times_are_exact)
{
    int64_t t_us = -7;
    ck_assert_msg(number_parse_time(good_times[_i].text, &t_us), "%s", good_times[_i].text);
    ck_assert_int_eq(t_us, good_times[_i].t_us);
}
END_TEST

static const char *const bad_times[] = {"",   "-",     ".",    "nan",           "1e3", "1,5",
                                        "1s", "0x1",   "1.2.", "9999999999999", "inf", "- 1",
                                        "12:30", "1 ", "99999999999999999999999999"};

START_TEST(what_is_no_time_is_refused)
{
    int64_t t_us = 42;
    ck_assert_msg(!number_parse_time(bad_times[_i], &t_us), "%s", bad_times[_i]);
    ck_assert_int_eq(t_us, 42);
}
END_TEST

START_TEST(whole_numbers_keep_to_their_range)
{
    int64_t value = 42;
    ck_assert(number_parse_whole("-5", -5, 5, &value));
    ck_assert_int_eq(value, -5);
    ck_assert(!number_parse_whole("6", -5, 5, &value));
    ck_assert(!number_parse_whole("1.0", -5, 5, &value));
    ck_assert(!number_parse_whole("", -5, 5, &value));
    ck_assert(!number_parse_whole("99999999999999999999", 0, INT64_MAX, &value));
    ck_assert_int_eq(value, -5);
    ck_assert(number_parse_whole("9223372036854775799", 0, INT64_MAX, &value));
    ck_assert_int_eq(value, INT64_C(9223372036854775799));
}
END_TEST

/* ---- writing ---------------------------------------------------------------------------- */

static const struct {
    double value;
    int decimals;
    const char *text;
} fixed[] = {{0.0, 4, "0.0000"},
             {-0.00001, 4, "0.0000"},
             {-0.00006, 4, "-0.0001"},
             {1.00005, 4, "1.0001"},
             {-12.5, 0, "-13"},
             {3.0, 0, "3"},
             {123456.789, 2, "123456.79"},
             {0.05, 1, "0.1"},
             {-0.04, 1, "0.0"},
             {1e13, 6, "nan"},
             {1e300, 0, "nan"}};

START_TEST(fixed_decimals_are_written)
{
    char text[NUMBER_ROOM];
    ck_assert_str_eq(number_fixed(text, fixed[_i].value, fixed[_i].decimals), fixed[_i].text);
}
END_TEST

START_TEST(what_is_not_finite_is_written_as_nan)
{
    char text[NUMBER_ROOM];
    ck_assert_str_eq(number_fixed(text, NUMBER_UNKNOWN, 3), "nan");
    ck_assert_str_eq(number_fixed(text, (double)INFINITY, 3), "nan");
    ck_assert_str_eq(number_fixed(text, -(double)INFINITY, 3), "nan");
}
END_TEST

START_TEST(fixed_decimals_agree_with_printf)
{
    char ours[NUMBER_ROOM], theirs[64];
    srand(2);
    for (int i = 0; i < 200000; i++) {
        double value = (rand() % 2000001 - 1000000) / 977.0;
        int decimals = rand() % 7;
        snprintf(theirs, sizeof theirs, "%.*f", decimals, value);
        bool is_minus_zero = theirs[0] == '-' && strtod(theirs, NULL) == 0.0;
        ck_assert_str_eq(number_fixed(ours, value, decimals), theirs + (is_minus_zero ? 1 : 0));
    }
}
END_TEST

static const struct {
    double value;
    const char *text;
} shorts[] = {{0.0, "0"},       {0.02, "0.02"},     {40000.0, "40000"}, {1e6, "1000000"},
              {9.81, "9.81"},   {-0.5, "-0.5"},     {2e-4, "0.0002"},   {1.5e-9, "1.5e-09"},
              {1e9, "1000000000"}, {3e15, "3e+15"}, {1.0 / 3.0, "0.333333"}, {100.0, "100"},
              {0.00174533, "0.00174533"}, {-8.7e-4, "-0.00087"}};

START_TEST(short_numbers_are_as_long_as_needed)
{
    char text[NUMBER_ROOM];
    double back = 0.0;
    ck_assert_str_eq(number_short(text, shorts[_i].value), shorts[_i].text);
    ck_assert(number_parse(text, &back));
    ASSERT_NEAR(back, shorts[_i].value, 1e-5 * fabs(shorts[_i].value), "");
}
END_TEST

START_TEST(written_times_are_read_back)
{
    char text[NUMBER_ROOM];
    const int64_t times[] = {0, 1, -1, 999999, -1000000, 1700000000123456, -16777217000001};
    for (size_t i = 0u; i < sizeof times / sizeof times[0]; i++) {
        int64_t back = 7;
        ck_assert(number_parse_time(number_time(text, times[i]), &back));
        ck_assert_int_eq(back, times[i]);
    }
    ck_assert_str_eq(number_time(text, -1500000), "-1.500000");
}
END_TEST

/* Where such a locale is installed; elsewhere this shows nothing and says so. */
START_TEST(the_locale_does_not_matter)
{
    const char *const commas[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "ru_RU.UTF-8"};
    char text[NUMBER_ROOM];
    double value = 0.0;
    size_t i = 0u;
    while (i < 4u && setlocale(LC_ALL, commas[i]) == NULL) {
        i++;
    }
    if (i == 4u) {
        printf("no locale with a decimal comma is installed\n");
    }
    ck_assert(number_parse("1.5", &value));
    ck_assert(value == 1.5);
    ck_assert(!number_parse("1,5", &value));
    ck_assert_str_eq(number_fixed(text, 1.5, 2), "1.50");
    ck_assert_str_eq(number_short(text, 0.25), "0.25");
    setlocale(LC_ALL, "C");
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("number");
    suite_add_loop(suite, "numbers", numbers_are_read_as_the_c_library_reads_them,
                   ROWS(good_numbers));
    suite_add(suite, "short decimals", short_decimals_are_read_exactly);
    suite_add_loop(suite, "no numbers", what_is_no_number_is_refused, ROWS(bad_numbers));
    suite_add_loop(suite, "silent sensors", a_sensor_may_say_nothing, ROWS(silent_sensors));
    suite_add(suite, "sensor nonsense", a_sensor_may_not_say_just_anything);
    suite_add_loop(suite, "times", times_are_exact, ROWS(good_times));
    suite_add_loop(suite, "no times", what_is_no_time_is_refused, ROWS(bad_times));
    suite_add(suite, "whole numbers", whole_numbers_keep_to_their_range);
    suite_add_loop(suite, "fixed", fixed_decimals_are_written, ROWS(fixed));
    suite_add(suite, "not finite", what_is_not_finite_is_written_as_nan);
    suite_add(suite, "fixed as printf", fixed_decimals_agree_with_printf);
    suite_add_loop(suite, "short", short_numbers_are_as_long_as_needed, ROWS(shorts));
    suite_add(suite, "written times", written_times_are_read_back);
    suite_add(suite, "locale", the_locale_does_not_matter);
    return suite;
}
