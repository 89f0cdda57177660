/* SPDX-License-Identifier: MIT */
#include "method.h"

#include <check.h>

#include "config_keys.h"
#include "suite.h"

static failure_t failure;

static const char *const expected[] = {"expected " METHOD_FOOT_NAMES,
                                       "expected " METHOD_PHONE_NAMES};

START_TEST(names_are_read_back)
{
    for (int i = 0; i < METHODS; i++) {
        method_t method = METHODS;
        tracker_t tracker = method_tracker((method_t)i);
        ck_assert_int_eq(tracker, i <= METHOD_PDR ? TRACKER_FOOT : TRACKER_PHONE);
        ck_assert(method_parse(tracker, method_name((method_t)i), &method, &failure));
        ck_assert_int_eq((int)method, i);
        ck_assert_ptr_nonnull(strstr(expected[tracker], method_name((method_t)i)));
        ck_assert_int_eq(method_is_first_order(method), i == METHOD_INS || i == METHOD_PDR);
    }
}
END_TEST

/* No two methods of one tracker share a name; `best` and `pdr` are names of both. */
START_TEST(names_differ)
{
    for (int i = 0; i < METHODS; i++) {
        for (int j = 0; j < i; j++) {
            bool is_same = strcmp(method_name((method_t)i), method_name((method_t)j)) == 0;
            ck_assert(!is_same || method_tracker((method_t)i) != method_tracker((method_t)j));
        }
    }
    ck_assert_str_eq(method_name(METHOD_PHONE_BEST), method_name(METHOD_BEST));
    ck_assert_str_eq(method_name(METHOD_PHONE_PDR), method_name(METHOD_PDR));
}
END_TEST

START_TEST(other_names_are_refused)
{
    static const char *const names[] = {"", "gps", "BEST", "best ", "two_order", "wifi_kde"};
    for (int tracker = TRACKER_FOOT; tracker <= TRACKER_PHONE; tracker++) {
        method_t method = METHOD_INS;
        ck_assert(!method_parse((tracker_t)tracker, names[_i], &method, &failure));
        ck_assert_int_eq(method, METHOD_INS);
        ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
        ck_assert_ptr_nonnull(strstr(failure.text, expected[tracker]));
        ck_assert_ptr_null(strstr(failure.text, "--tracker"));
    }
}
END_TEST

/* Who forgot to name the tracker is told so. */
START_TEST(methods_of_the_other_tracker_are_refused)
{
    method_t method = METHOD_INS;
    for (int i = 0; i < METHODS; i++) {
        const char *name = method_name((method_t)i);
        tracker_t other =
            method_tracker((method_t)i) == TRACKER_FOOT ? TRACKER_PHONE : TRACKER_FOOT;
        if (strcmp(name, "best") == 0 || strcmp(name, "pdr") == 0) {
            continue;
        }
        ck_assert(!method_parse(other, name, &method, &failure));
        ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
        ck_assert_ptr_nonnull(strstr(failure.text, expected[other]));
        ck_assert_int_eq(strstr(failure.text, "--tracker phone") != NULL, other == TRACKER_FOOT);
    }
    ck_assert_int_eq(method, METHOD_INS);
}
END_TEST

START_TEST(trackers_have_names)
{
    static const char *const bad[] = {"", "shoe", "Phone", "phone "};
    tracker_t tracker = TRACKER_FOOT;
    ck_assert(tracker_parse("phone", &tracker, &failure));
    ck_assert_int_eq(tracker, TRACKER_PHONE);
    ck_assert(tracker_parse("foot", &tracker, &failure));
    ck_assert_int_eq(tracker, TRACKER_FOOT);
    ck_assert_str_eq(tracker_name(TRACKER_FOOT), "foot");
    ck_assert_str_eq(tracker_name(TRACKER_PHONE), "phone");
    for (size_t i = 0u; i < sizeof bad / sizeof bad[0]; i++) {
        ck_assert(!tracker_parse(bad[i], &tracker, &failure));
        ck_assert_int_eq(tracker, TRACKER_FOOT);
        ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
        ck_assert_ptr_nonnull(strstr(failure.text, "expected foot or phone"));
    }
}
END_TEST

START_TEST(methods_tell_what_they_live_on)
{
    for (int i = 0; i < METHODS; i++) {
        bool alone = i == METHOD_WIFI || i == METHOD_WIFI_KDE || i == METHOD_WIFI_ML;
        ck_assert_int_eq(method_is_radio_alone((method_t)i), alone);
        ck_assert_int_eq(method_is_steps_alone((method_t)i),
                         i == METHOD_PHONE_PDR || i == METHOD_PDR_GYRO);
    }
}
END_TEST

START_TEST(settings_choose_where_no_option_does)
{
    settings_t settings;
    settings_init(&settings);
    ck_assert_int_eq(method_of(&settings, TRACKER_FOOT), METHOD_BEST);
    ck_assert(config_set(&settings, "foot_fusion.method", "wifi", &failure));
    ck_assert_int_eq(method_of(&settings, TRACKER_FOOT), METHOD_WIFI);
    ck_assert(config_set(&settings, "foot_fusion.method", "two-order", &failure));
    ck_assert_int_eq(method_of(&settings, TRACKER_FOOT), METHOD_TWO_ORDER);
    ck_assert_int_eq(method_of(&settings, TRACKER_PHONE), METHOD_PHONE_BEST);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("method");
    suite_add(suite, "names", names_are_read_back);
    suite_add(suite, "differ", names_differ);
    suite_add_loop(suite, "refused", other_names_are_refused, 6);
    suite_add(suite, "other tracker", methods_of_the_other_tracker_are_refused);
    suite_add(suite, "trackers", trackers_have_names);
    suite_add(suite, "parts", methods_tell_what_they_live_on);
    suite_add(suite, "settings", settings_choose_where_no_option_does);
    return suite;
}
