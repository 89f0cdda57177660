/* SPDX-License-Identifier: MIT */
#include "sim/error.h"

#include <stdarg.h>
#include <stdio.h>

bool sim_fail(sim_error_t *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    error->file[0] = '\0';
    error->line = 0;
    return false;
}

bool sim_fail_on_line(sim_error_t *error, int line)
{
    error->line = line;
    return false;
}

bool sim_fail_in_file(sim_error_t *error, const char *file)
{
    snprintf(error->file, sizeof error->file, "%s", file);
    return false;
}
