/* SPDX-License-Identifier: MIT */
#include "options.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "nearest.h"
#include "number.h"

static const option_t *find_option(const option_t *options, const char *name, size_t length)
{
    for (; options->name != NULL; options++) {
        if (strlen(options->name) == length && strncmp(options->name, name, length) == 0) {
            return options;
        }
    }
    return NULL;
}

static bool refuse_option(const char *command, const option_t *options, const char *word,
                          failure_t *failure)
{
    nearest_t nearest;
    char name[64];
    size_t dashes = strspn(word, "-"), length = strcspn(word + dashes, "=");
    length = length < sizeof name ? length : sizeof name - 1u;
    memcpy(name, word + dashes, length);
    name[length] = '\0';
    nearest_begin(&nearest, name);
    for (; options->name != NULL; options++) {
        nearest_offer(&nearest, options->name);
    }
    failure_usage(failure, "insole %s: unknown option %.40s", command, word);
    if (nearest.best != NULL) {
        return failure_add(failure, ": did you mean --%s?", nearest.best);
    }
    return failure_add(failure, ": `insole %s --help` lists them", command);
}

/* An option and its value; `*next` moves on when the value is the next word. */
static bool take_option(arguments_t *arguments, const option_t *options, const char *word,
                        char *const **next, char *const *end, failure_t *failure)
{
    const char *equals = strchr(word, '=');
    const char *name = word + 2;
    size_t length = equals != NULL ? (size_t)(equals - name) : strlen(name);
    const option_t *option =
        strncmp(word, "--", 2u) == 0 ? find_option(options, name, length) : NULL;
    if (option == NULL) {
        return refuse_option(arguments->command, options, word, failure);
    }
    const char *value = equals != NULL ? equals + 1 : NULL;
    if (option->value == NULL && value != NULL) {
        return failure_usage(failure, "insole %s: --%s takes no value", arguments->command,
                             option->name);
    }
    if (option->value != NULL && value == NULL) {
        if (*next == end || strncmp(**next, "--", 2u) == 0) {
            return failure_usage(failure, "insole %s: --%s needs a value: --%s %s",
                                 arguments->command, option->name, option->name, option->value);
        }
        value = *(*next)++;
    }
    given_t given = {option, value};
    arguments->given[arguments->given_count++] = given;
    return true;
}

bool options_parse(arguments_t *arguments, const char *command, const option_t *options, int argc,
                   char *const *argv, failure_t *failure)
{
    char *const *end = argv + argc;
    bool has_options = true;
    arguments->command = command;
    arguments->given = memory_new((size_t)argc, sizeof *arguments->given);
    arguments->operands = memory_new((size_t)argc, sizeof *arguments->operands);
    arguments->given_count = 0u;
    arguments->operand_count = 0u;
    for (char *const *next = argv; next != end;) {
        const char *word = *next++;
        if (has_options && strcmp(word, "--") == 0) {
            has_options = false;
        } else if (!has_options || word[0] != '-' || word[1] == '\0') {
            arguments->operands[arguments->operand_count++] = word;
        } else if (!take_option(arguments, options, word, &next, end, failure)) {
            return false;
        }
    }
    return true;
}

const char *options_value(const arguments_t *arguments, const char *name)
{
    const char *value = NULL;
    for (size_t i = 0u; i < arguments->given_count; i++) {
        if (strcmp(arguments->given[i].option->name, name) == 0) {
            value = arguments->given[i].value;
        }
    }
    return value;
}

bool options_has(const arguments_t *arguments, const char *name)
{
    for (size_t i = 0u; i < arguments->given_count; i++) {
        if (strcmp(arguments->given[i].option->name, name) == 0) {
            return true;
        }
    }
    return false;
}

bool options_number(const arguments_t *arguments, const char *name, double low, double high,
                    double *number, failure_t *failure)
{
    const char *text = options_value(arguments, name);
    double value;
    char low_text[NUMBER_ROOM], high_text[NUMBER_ROOM];
    if (text == NULL) {
        return true;
    }
    if (!number_parse(text, &value) || value < low || value > high) {
        return failure_usage(failure, "insole %s: --%s %.40s: expected a number from %s to %s",
                             arguments->command, name, text, number_short(low_text, low),
                             number_short(high_text, high));
    }
    *number = value;
    return true;
}

bool options_whole(const arguments_t *arguments, const char *name, int64_t low, int64_t high,
                   int64_t *number, failure_t *failure)
{
    const char *text = options_value(arguments, name);
    if (text == NULL || number_parse_whole(text, low, high, number)) {
        return true;
    }
    return high == INT64_MAX
               ? failure_usage(failure, "insole %s: --%s %.40s: expected a whole number",
                               arguments->command, name, text)
               : failure_usage(failure,
                               "insole %s: --%s %.40s: expected a whole number from %lld to %lld",
                               arguments->command, name, text, (long long)low, (long long)high);
}

void options_free(arguments_t *arguments)
{
    free(arguments->given);
    free(arguments->operands);
}
