/* SPDX-License-Identifier: MIT */
#include "method.h"

#include <check.h>

#include "config_keys.h"
#include "suite.h"

static failure_t failure;

START_TEST(names_are_read_back)
{
    for (int i = 0; i <= METHOD_PDR; i++) {
        method_t method = METHOD_PDR;
        ck_assert(method_parse(method_name((method_t)i), &method, &failure));
        ck_assert_int_eq((int)method, i);
        ck_assert_int_eq(method_is_first_order(method), i == METHOD_INS || i == METHOD_PDR);
    }
}
END_TEST

START_TEST(other_names_are_refused)
{
    static const char *const names[] = {"", "gps", "BEST", "best ", "two_order"};
    method_t method = METHOD_INS;
    ck_assert(!method_parse(names[_i], &method, &failure));
    ck_assert_int_eq(method, METHOD_INS);
    ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
    ck_assert_ptr_nonnull(strstr(failure.text, "expected " METHOD_NAMES));
}
END_TEST

START_TEST(settings_choose_where_no_option_does)
{
    settings_t settings;
    settings_init(&settings);
    ck_assert_int_eq(method_of(&settings), METHOD_BEST);
    ck_assert(config_set(&settings, "foot_fusion.method", "wifi", &failure));
    ck_assert_int_eq(method_of(&settings), METHOD_WIFI);
    ck_assert(config_set(&settings, "foot_fusion.method", "two-order", &failure));
    ck_assert_int_eq(method_of(&settings), METHOD_TWO_ORDER);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("method");
    suite_add(suite, "names", names_are_read_back);
    suite_add_loop(suite, "refused", other_names_are_refused, 5);
    suite_add(suite, "settings", settings_choose_where_no_option_does);
    return suite;
}
