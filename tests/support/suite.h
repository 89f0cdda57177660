/** @file suite.h  Every test_<stem>.c defines one suite; suite_main.c runs it.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_SUITE_H
#define INSOLE_TESTS_SUITE_H

#include <check.h>

/** The suite of this executable. */
Suite *insole_suite(void);

/** Adds one behaviour: a test case that holds one test. */
static inline void suite_add(Suite *suite, const char *behaviour, const TTest *test)
{
    TCase *tcase = tcase_create(behaviour);
    tcase_set_timeout(tcase, 120.0);
    tcase_add_test(tcase, test);
    suite_add_tcase(suite, tcase);
}

/** Adds one behaviour that is checked for each row 0 <= _i < rows of a table. */
static inline void suite_add_loop(Suite *suite, const char *behaviour, const TTest *test, int rows)
{
    TCase *tcase = tcase_create(behaviour);
    tcase_set_timeout(tcase, 120.0);
    tcase_add_loop_test(tcase, test, 0, rows);
    suite_add_tcase(suite, tcase);
}

#endif
