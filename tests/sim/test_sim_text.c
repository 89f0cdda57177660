/* SPDX-License-Identifier: MIT */
#include "sim/text.h"

#include <stdlib.h>
#include <string.h>

#include "buildings.h"
#include "near.h"
#include "suite.h"

static const struct {
    const char *text, *left;
} trims[] = {{"a b", "a b"}, {"  a \t\r\n", "a"}, {"", ""},
             {" \n", ""},    {"#a", ""},          {"a # b # c", "a"}};

START_TEST(trimming_leaves_what_counts)
{
    for (size_t i = 0; i < sizeof trims / sizeof trims[0]; i++) {
        char text[40];
        strcpy(text, trims[i].text);
        ck_assert_str_eq(sim_text_trim(text), trims[i].left);
    }
}
END_TEST

START_TEST(fields_come_one_after_the_other)
{
    char text[] = "a, b c ,,d";
    char *rest = text;
    ck_assert_str_eq(sim_text_field(&rest), "a");
    ck_assert_str_eq(sim_text_field(&rest), "b c");
    ck_assert_str_eq(sim_text_field(&rest), "");
    ck_assert_str_eq(sim_text_field(&rest), "d");
    ck_assert_ptr_null(sim_text_field(&rest));
    ck_assert_ptr_null(sim_text_field(&rest));
}
END_TEST

static const struct {
    const char *text;
    bool good;
    double number;
} numbers[] = {{"1", true, 1.0},     {"-2", true, -2.0},  {"3", true, 3.0},   {"0.5e0", true, 0.5},
               {"-2.1", false, 0.0}, {"3.1", false, 0.0}, {"", false, 0.0},   {"x", false, 0.0},
               {"1x", false, 0.0},   {"nan", false, 0.0}, {"inf", false, 0.0}};

START_TEST(numbers_are_taken_in_their_range)
{
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        double number = 77.0;
        sim_error_t error;
        bool good = sim_text_number(numbers[i].text, "it", -2.0, 3.0, &number, &error);
        ck_assert_msg(good == numbers[i].good, "%s", numbers[i].text);
        ck_assert(number == (good ? numbers[i].number : 77.0));
        ck_assert(good || strstr(error.text, "expected a number from -2 to 3") != NULL);
    }
}
END_TEST

typedef struct {
    int calls, last;
    char seen[100];
} collector_t;

static bool collect(void *state, char *line, int number, sim_error_t *error)
{
    collector_t *collector = state;
    collector->calls++;
    collector->last = number;
    strcat(strcat(collector->seen, line), "|");
    return strcmp(line, "stop") != 0 || sim_fail(error, "stopped");
}

START_TEST(lines_are_numbered_and_empty_ones_left_out)
{
    collector_t c = {0, 0, ""};
    sim_error_t error;
    int lines;
    FILE *stream = stream_of("\n one\n# no\r\ntwo # yes\n\nthree");
    ck_assert(sim_text_lines(stream, collect, &c, &lines, &error));
    fclose(stream);
    ck_assert_str_eq(c.seen, "one|two|three|");
    ck_assert_int_eq(c.last, 6);
    ck_assert_int_eq(lines, 6);
}
END_TEST

START_TEST(a_refused_line_ends_the_reading_and_is_blamed)
{
    collector_t c = {0, 0, ""};
    sim_error_t error;
    int lines;
    FILE *stream = stream_of("one\n\nstop\ntwo\n");
    ck_assert(!sim_text_lines(stream, collect, &c, &lines, &error));
    fclose(stream);
    ck_assert_int_eq(c.calls, 2);
    ck_assert_int_eq(error.line, 3);
    ck_assert_str_eq(error.text, "stopped");
}
END_TEST

START_TEST(too_long_lines_are_refused)
{
    char *text = malloc(SIM_TEXT_LONGEST + 3);
    ck_assert_ptr_nonnull(text);
    for (int longer = 0; longer < 2; longer++) {
        collector_t c = {0, 0, ""};
        sim_error_t error;
        int lines;
        size_t size = SIM_TEXT_LONGEST + (size_t)longer;
        memset(text, ' ', size);
        memcpy(text + size, "\n", 2);
        FILE *stream = stream_of(text);
        ck_assert_int_eq(sim_text_lines(stream, collect, &c, &lines, &error), !longer);
        fclose(stream);
        ck_assert(!longer || (error.line == 1 && strstr(error.text, "too long") != NULL));
    }
    free(text);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/text");
    suite_add(suite, "trim", trimming_leaves_what_counts);
    suite_add(suite, "fields", fields_come_one_after_the_other);
    suite_add(suite, "numbers", numbers_are_taken_in_their_range);
    suite_add(suite, "lines", lines_are_numbered_and_empty_ones_left_out);
    suite_add(suite, "blame", a_refused_line_ends_the_reading_and_is_blamed);
    suite_add(suite, "long lines", too_long_lines_are_refused);
    return suite;
}
