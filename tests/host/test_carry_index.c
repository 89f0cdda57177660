/* SPDX-License-Identifier: MIT
 * What train-carry reads: the index of the logs, their positions, and the logs. */
#include "carry_index.h"

#include <math.h>

#include "carry_windows.h"
#include "confusion.h"
#include "files.h"
#include "near.h"
#include "suite.h"

static failure_t failure;
static carry_index_t carry_index;
static carry_windows_t windows;

static void unload(void)
{
    carry_windows_free(&windows);
    carry_index_free(&carry_index);
}

/* ---- positions and classes -------------------------------------------------------------- */

START_TEST(positions_are_put_together)
{
    static const char *const POSITIONS[] = {"inhand", "hand", "purse", "swing", "armband"};
    static const int EXPECTED[] = {0, 0, 1, 2, CARRY_LEFT_OUT};
    carry_classes_t classes;
    int number;
    ck_assert(carry_classes_init(&classes, "hand=hand+inhand, bag=purse ,swing", &failure));
    for (int i = 0; i < 5; i++) {
        ck_assert(carry_classes_of(&classes, POSITIONS[i], &number, &failure));
        ck_assert_int_eq(number, EXPECTED[i]);
    }
    ck_assert_uint_eq(classes.names.count, 3u);
    carry_classes_free(&classes);
    ck_assert(carry_classes_init(&classes, NULL, &failure));
    for (int i = 0; i < 5; i++) {
        ck_assert(carry_classes_of(&classes, POSITIONS[i], &number, &failure));
        ck_assert_int_eq(number, i);
    }
    carry_classes_free(&classes);
}
END_TEST

START_TEST(bad_classes_are_refused)
{
    static const char *const BAD[] = {"",
                                      "=hand",
                                      "hand=",
                                      "a=b+",
                                      "a,a",
                                      "a=b,c=b",
                                      "a=b,a=c",
                                      "a+b,b",
                                      "a=b=c,b=c",
                                      "a,,b",
                                      "a,b,c,d,e,f,g,h,i"};
    carry_classes_t classes;
    bool is_refused = !carry_classes_init(&classes, BAD[_i], &failure);
    if (!is_refused) {
        carry_classes_free(&classes);
    }
    ck_assert_msg(is_refused, "\"%s\" is taken", BAD[_i]);
}
END_TEST

/* ---- bad input -------------------------------------------------------------------------- */

static const struct {
    const char *index, *complaint;
} bad_indexes[] = {
    {"", "no logs"},
    {"file,person,position\n", "no logs"},
    {"file,person\n", "bad.csv:1: header is not of an index"},
    {"file,person,user,position\n", "bad.csv:1: column user comes twice"},
    {"file,person,position\nwalk.csv,me\n", "bad.csv:2: row has 2 fields: expected 3"},
    {"file,person,position\n# all\nwalk.csv,me,\n", "bad.csv:3: field 3 is empty"},
    {"file,person,position\n,me,hand\n", "bad.csv:2: field 1 is empty"},
};

START_TEST(bad_indexes_are_refused)
{
    const char *path = scratch_file("bad.csv", bad_indexes[_i].index);
    ck_assert(!carry_index_read(&carry_index, path, &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_msg(strstr(failure.text, bad_indexes[_i].complaint) != NULL, "%s", failure.text);
    ck_assert(!carry_index_read(&carry_index, scratch("absent.csv"), &failure));
}
END_TEST

static const struct {
    const char *log, *complaint;
} bad_logs[] = {
    {NULL, "log.csv"},
    {"t,ax,ay,az\n0,0,0,x\n", "log.csv:2:"},
    {"t,gx,gy,gz\n0,0,0,1\n", "has no walk of 2 s with an accelerometer"},
    {"t,ax,ay,az\n0,0,0,9.8\n1,0,0,9.8\n", "one.csv:2:"},
};

START_TEST(bad_logs_are_refused)
{
    const char *index = scratch_file("one.csv", "file,person,position\nlog.csv,me,hand\n");
    remove(scratch("log.csv"));
    if (bad_logs[_i].log != NULL) {
        scratch_file("log.csv", bad_logs[_i].log);
    }
    ck_assert(carry_windows_init(&windows, NULL, &failure));
    ck_assert(carry_index_read(&carry_index, index, &failure));
    ck_assert(!carry_windows_add(&windows, &carry_index, true, NULL, &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_msg(strstr(failure.text, bad_logs[_i].complaint) != NULL, "%s", failure.text);
    ck_assert_msg(strstr(failure.text, "one.csv:2") != NULL, "%s", failure.text);
    unload();
}
END_TEST

/* Sensor trouble in a good log is left out and counted; a rest is, too. */
START_TEST(trouble_is_counted)
{
    FILE *file = fopen(scratch("trouble.csv"), "wb");
    fputs("t,ax,ay,az\n", file);
    for (int i = 0; i < 3000; i++) {
        double a = i < 1500 ? 3.0 * sin(0.25 * i) : 0.0;
        fprintf(file, i == 700 ? "%.2f,nan,0,%.3f\n" : "%.2f,0,0,%.3f\n", i == 800 ? 1.0 : i * 0.02,
                9.81 + a);
    }
    fclose(file);
    const char *path = scratch_file("troubles.csv", "file,user,position\ntrouble.csv,me,hand\n");
    ck_assert(carry_windows_init(&windows, NULL, &failure));
    ck_assert(carry_index_read(&carry_index, path, &failure));
    ck_assert(carry_windows_add(&windows, &carry_index, false, NULL, &failure));
    ck_assert_uint_eq(windows.refused, 2u);
    ck_assert_uint_ge(windows.still, 28u);
    ck_assert_uint_ge(windows.row_count, 28u);
    ck_assert_uint_eq(windows.still + windows.row_count, 3000 / 50 - 1);
    ck_assert_uint_eq(windows.block_count, 2u);
    unload();
}
END_TEST
START_TEST(a_confusion_by_hand)
{
    static const char *const NAMES[] = {"hand", "pocket"};
    confusion_t confusion = {{{3, 1}, {2, 4}}};
    ASSERT_NEAR(confusion_accuracy(&confusion), 0.7, 1e-12, "");
    ck_assert_uint_eq(confusion_total(&confusion), 10u);
    FILE *file = tmpfile();
    confusion_print(file, &confusion, NAMES, 2);
    const char *text = text_of(file);
    ck_assert_ptr_nonnull(strstr(text, "75.0 %"));
    ck_assert_ptr_nonnull(strstr(text, "66.7 %"));
    ck_assert_ptr_nonnull(strstr(text, "all: 70.0 % of 10 windows"));
    memset(&confusion, 0, sizeof confusion);
    ASSERT_NEAR(confusion_accuracy(&confusion), 0.0, 0.0, "");
}
END_TEST
Suite *insole_suite(void)
{
    Suite *suite = suite_create("carry_index");
    suite_add(suite, "classes", positions_are_put_together);
    suite_add_loop(suite, "bad classes", bad_classes_are_refused, 11);
    suite_add_loop(suite, "bad indexes", bad_indexes_are_refused, 7);
    suite_add_loop(suite, "bad logs", bad_logs_are_refused, 4);
    suite_add(suite, "trouble", trouble_is_counted);
    suite_add(suite, "confusion", a_confusion_by_hand);
    return suite;
}
