/* SPDX-License-Identifier: MIT */
#include "options.h"

#include <string.h>

#include "near.h"
#include "nearest.h"
#include "suite.h"

static const option_t options[] = {{"out", "FILE", ""},
                                   {"format", "FORMAT", ""},
                                   {"set", "KEY=VALUE", ""},
                                   {"start", "X,Y", ""},
                                   {"json", NULL, ""},
                                   {NULL, NULL, NULL}};

static arguments_t arguments;
static failure_t failure;

/* Words separated by blanks. */
static bool parse(const char *line)
{
    static char copy[256];
    static char *words[32];
    int count = 0;
    strcpy(copy, line);
    for (char *word = strtok(copy, " "); word != NULL; word = strtok(NULL, " ")) {
        words[count++] = word;
    }
    memset(&failure, 0, sizeof failure);
    return options_parse(&arguments, "cmd", options, count, words, &failure);
}

START_TEST(options_and_operands_may_be_mixed)
{
    ck_assert(parse("a.csv --out x.csv b.csv --json --format=tum -"));
    ck_assert_uint_eq(arguments.operand_count, 3u);
    ck_assert_str_eq(arguments.operands[0], "a.csv");
    ck_assert_str_eq(arguments.operands[1], "b.csv");
    ck_assert_str_eq(arguments.operands[2], "-");
    ck_assert_str_eq(options_value(&arguments, "out"), "x.csv");
    ck_assert_str_eq(options_value(&arguments, "format"), "tum");
    ck_assert(options_has(&arguments, "json"));
    ck_assert(!options_has(&arguments, "set"));
    ck_assert_ptr_null(options_value(&arguments, "set"));
    options_free(&arguments);
}
END_TEST

START_TEST(values_may_look_like_anything)
{
    ck_assert(parse("--start -1,-2 --out - --set a=b=c --out="));
    ck_assert_str_eq(options_value(&arguments, "start"), "-1,-2");
    ck_assert_str_eq(options_value(&arguments, "set"), "a=b=c");
    ck_assert_str_eq(options_value(&arguments, "out"), "");
    options_free(&arguments);
}
END_TEST

START_TEST(two_dashes_end_the_options)
{
    ck_assert(parse("--json -- --out -x"));
    ck_assert_uint_eq(arguments.operand_count, 2u);
    ck_assert_str_eq(arguments.operands[0], "--out");
    ck_assert_str_eq(arguments.operands[1], "-x");
    options_free(&arguments);
}
END_TEST

START_TEST(of_repeated_options_the_last_counts_and_all_are_kept)
{
    ck_assert(parse("--set a=1 --set b=2"));
    ck_assert_str_eq(options_value(&arguments, "set"), "b=2");
    ck_assert_uint_eq(arguments.given_count, 2u);
    ck_assert_str_eq(arguments.given[0].value, "a=1");
    options_free(&arguments);
}
END_TEST

static const struct {
    const char *line, *message;
} wrong[] = {
    {"--ouut x", "insole cmd: unknown option --ouut: did you mean --out?"},
    {"--foramt=tum", "insole cmd: unknown option --foramt=tum: did you mean --format?"},
    {"-json", "insole cmd: unknown option -json: did you mean --json?"},
    {"--quux", "insole cmd: unknown option --quux: `insole cmd --help` lists them"},
    {"-o x", "insole cmd: unknown option -o: `insole cmd --help` lists them"},
    {"--out", "insole cmd: --out needs a value: --out FILE"},
    {"--out --json", "insole cmd: --out needs a value: --out FILE"},
    {"--json=yes", "insole cmd: --json takes no value"},
};

START_TEST(wrong_options_are_told_with_a_hint)
{
    ck_assert(!parse(wrong[_i].line));
    ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
    ck_assert_str_eq(failure.text, wrong[_i].message);
    options_free(&arguments);
}
END_TEST

START_TEST(numbers_keep_to_their_range)
{
    double number = 7.0;
    ck_assert(parse("--out 2.5 --format x"));
    ck_assert(options_number(&arguments, "start", 0.0, 1.0, &number, &failure));
    ck_assert(number == 7.0);
    ck_assert(options_number(&arguments, "out", 0.0, 3.0, &number, &failure));
    ck_assert(number == 2.5);
    ck_assert(!options_number(&arguments, "out", 0.0, 1.0, &number, &failure));
    ck_assert_str_eq(failure.text, "insole cmd: --out 2.5: expected a number from 0 to 1");
    ck_assert(!options_number(&arguments, "format", 0.0, 1.0, &number, &failure));
    ck_assert_str_eq(failure.text, "insole cmd: --format x: expected a number from 0 to 1");
    ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
    options_free(&arguments);
}
END_TEST

/* ---- nearest ---------------------------------------------------------------------------- */

static const struct {
    const char *a, *b;
    size_t distance;
} distances[] = {{"", "", 0u},          {"a", "", 1u},          {"", "abc", 3u},
                 {"kitten", "sitting", 3u}, {"abc", "abc", 0u}, {"ab", "ba", 1u},
                 {"replay", "relpay", 1u},  {"score", "scores", 1u}, {"abcd", "wxyz", 4u}};

START_TEST(distances_count_letters)
{
    ck_assert_uint_eq(nearest_distance(distances[_i].a, distances[_i].b), distances[_i].distance);
    ck_assert_uint_eq(nearest_distance(distances[_i].b, distances[_i].a), distances[_i].distance);
}
END_TEST

START_TEST(long_words_do_no_harm)
{
    char word[1000];
    memset(word, 'a', sizeof word - 1u);
    word[sizeof word - 1u] = '\0';
    ck_assert_uint_eq(nearest_distance(word, word), 0u);
    ck_assert_uint_eq(nearest_distance(word, ""), 63u);
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("options");
    suite_add(suite, "mixed", options_and_operands_may_be_mixed);
    suite_add(suite, "values", values_may_look_like_anything);
    suite_add(suite, "two dashes", two_dashes_end_the_options);
    suite_add(suite, "repeated", of_repeated_options_the_last_counts_and_all_are_kept);
    suite_add_loop(suite, "wrong", wrong_options_are_told_with_a_hint, ROWS(wrong));
    suite_add(suite, "numbers", numbers_keep_to_their_range);
    suite_add_loop(suite, "distances", distances_count_letters, ROWS(distances));
    suite_add(suite, "long words", long_words_do_no_harm);
    return suite;
}
