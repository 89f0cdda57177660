/* SPDX-License-Identifier: MIT */
#include "sim/error.h"

#include <string.h>

#include "suite.h"

START_TEST(it_says_what_is_wrong)
{
    sim_error_t error;
    ck_assert(!sim_fail(&error, "speed %g m/s, expected %d to %d", 7.5, 1, 4));
    ck_assert_str_eq(error.text, "speed 7.5 m/s, expected 1 to 4");
    ck_assert_int_eq(error.line, 0);
}
END_TEST

START_TEST(it_blames_a_line)
{
    sim_error_t error;
    sim_fail(&error, "bad");
    ck_assert(!sim_fail_on_line(&error, 12));
    ck_assert_int_eq(error.line, 12);
    ck_assert_str_eq(error.text, "bad");
    sim_fail(&error, "worse");
    ck_assert_int_eq(error.line, 0);
}
END_TEST

START_TEST(long_texts_are_cut)
{
    sim_error_t error;
    char longer[2 * sizeof error.text];
    memset(longer, 'x', sizeof longer);
    longer[sizeof longer - 1] = '\0';
    sim_fail(&error, "%s", longer);
    ck_assert_uint_eq(strlen(error.text), sizeof error.text - 1);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/error");
    suite_add(suite, "text", it_says_what_is_wrong);
    suite_add(suite, "line", it_blames_a_line);
    suite_add(suite, "length", long_texts_are_cut);
    return suite;
}
