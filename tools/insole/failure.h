/** @file failure.h  What went wrong, in words, and with which code the program ends.
 *
 *  Every part of the program that can fail takes a `failure_t *`, tells it the reason and returns
 *  false; only main prints it.
 *
 *      return failure_input(failure, "%s: cannot read", path);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_FAILURE_H
#define INSOLE_HOST_FAILURE_H

#include <stdbool.h>

/** How the program ends. */
enum { EXIT_DONE = 0, EXIT_BAD_INPUT = 1, EXIT_WRONG_USAGE = 2 };

typedef struct {
    int exit_code; /**< EXIT_DONE while nothing went wrong */
    char text[600];
} failure_t;

/** Bad input (exit 1). Control characters in the text become '?'. @return false, always */
bool failure_input(failure_t *failure, const char *format, ...);

/** Wrong usage (exit 2). @return false, always */
bool failure_usage(failure_t *failure, const char *format, ...);

/** Adds to the text of a failure. @return false, always */
bool failure_add(failure_t *failure, const char *format, ...);

/** Prints the text to stderr where there is one. @return the exit code */
int failure_report(const failure_t *failure);

#endif
