/** @file options.h  The command line: which command, which options, which operands.
 *
 *  `--name value` and `--name=value` mean the same; `--` ends the options; `-` is an operand.
 *
 *      if (options_parse(&arguments, command, argc, argv, &failure)) run(&arguments);
 *      options_free(&arguments);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_OPTIONS_H
#define INSOLE_HOST_OPTIONS_H

#include <stddef.h>
#include <stdint.h>

#include "failure.h"

/** An option of a command. */
typedef struct {
    const char *name;  /**< without the dashes */
    const char *value; /**< what its value is called in the help; NULL: it takes none */
    const char *text;  /**< help */
} option_t;

typedef struct {
    const option_t *option;
    const char *value;
} given_t;

typedef struct {
    const char *command;
    given_t *given; /**< options in the order given */
    size_t given_count;
    const char **operands;
    size_t operand_count;
} arguments_t;

/** @param options ends with a NULL name
 *  @param argv    the words after the command */
bool options_parse(arguments_t *arguments, const char *command, const option_t *options, int argc,
                   char *const *argv, failure_t *failure);

/** Was the option given? */
bool options_has(const arguments_t *arguments, const char *name);

/** Value of the option, the last when it was given more than once; NULL: it was not. */
const char *options_value(const arguments_t *arguments, const char *name);

/** Value of a number within low..high; `*number` keeps what it is when the option is not given. */
bool options_number(const arguments_t *arguments, const char *name, double low, double high,
                    double *number, failure_t *failure);

/** The same for a whole number. */
bool options_whole(const arguments_t *arguments, const char *name, int64_t low, int64_t high,
                   int64_t *number, failure_t *failure);

void options_free(arguments_t *arguments);

#endif
