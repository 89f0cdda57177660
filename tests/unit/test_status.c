/* SPDX-License-Identifier: MIT */
#include "insole/base/status.h"

#include <string.h>

#include "suite.h"

static const insole_status_t ALL[] = {INSOLE_OK,       INSOLE_ERR_NULL,  INSOLE_ERR_VALUE,
                                      INSOLE_ERR_TIME, INSOLE_ERR_STATE, INSOLE_ERR_ROOM,
                                      INSOLE_ERR_DATA};
enum { COUNT = sizeof ALL / sizeof ALL[0] };

START_TEST(every_status_has_a_text_of_its_own)
{
    for (int i = 0; i < COUNT; i++) {
        const char *text = insole_status_text(ALL[i]);
        ck_assert_uint_gt(strlen(text), 0u);
        ck_assert_str_ne(text, "unknown status");
        for (int k = 0; k < i; k++) {
            ck_assert_str_ne(text, insole_status_text(ALL[k]));
        }
    }
}
END_TEST

/* Programs store these numbers: they stay. */
START_TEST(numbers_are_zero_and_down_from_there)
{
    for (int i = 0; i < COUNT; i++) {
        ck_assert_int_eq((int)ALL[i], -i);
    }
}
END_TEST

START_TEST(a_number_that_is_no_status_has_a_text_too)
{
    static const int UNKNOWN[] = {1, -COUNT, 100, -100};
    ck_assert_str_eq(insole_status_text((insole_status_t)UNKNOWN[_i]), "unknown status");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("status");
    suite_add(suite, "texts", every_status_has_a_text_of_its_own);
    suite_add(suite, "numbers", numbers_are_zero_and_down_from_there);
    suite_add_loop(suite, "unknown", a_number_that_is_no_status_has_a_text_too, 4);
    return suite;
}
