/* SPDX-License-Identifier: MIT */
#include "failure.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* A log line quoted in a message must not steer the terminal it is printed on. */
static void make_printable(char *text)
{
    for (; *text != '\0'; text++) {
        if ((unsigned char)*text < 0x20u || *text == 0x7f) {
            *text = '?';
        }
    }
}

static bool fail(failure_t *failure, int exit_code, size_t begin, const char *format,
                 va_list values)
{
    failure->exit_code = exit_code;
    vsnprintf(failure->text + begin, sizeof failure->text - begin, format, values);
    make_printable(failure->text + begin);
    return false;
}

bool failure_input(failure_t *failure, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    fail(failure, EXIT_BAD_INPUT, 0u, format, values);
    va_end(values);
    return false;
}

bool failure_usage(failure_t *failure, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    fail(failure, EXIT_WRONG_USAGE, 0u, format, values);
    va_end(values);
    return false;
}

bool failure_add(failure_t *failure, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    fail(failure, failure->exit_code, strlen(failure->text), format, values);
    va_end(values);
    return false;
}

int failure_report(const failure_t *failure)
{
    if (failure->text[0] != '\0') {
        fflush(stdout);
        fprintf(stderr, "%s\n", failure->text);
    }
    return failure->exit_code;
}
