/** @file text.h  Reading text line by line and field by field.
 *
 *  `#` starts a comment; white space around a line and around a field does not matter.
 *
 *      static bool read_line(void *state, char *line, int number, sim_error_t *error) ...
 *      if (!sim_text_lines(stream, read_line, &state, &lines, &error)) ...
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_TEXT_H
#define INSOLE_SIM_TEXT_H

#include <stdio.h>

#include "sim/error.h"

/** Takes one line that is not empty; may write into it. */
typedef bool (*sim_text_reader_t)(void *state, char *line, int number, sim_error_t *error);

enum { SIM_TEXT_LONGEST = 4094 };

/** Gives all lines that are not empty to `read_line`, until it refuses one, which then is blamed.
 *  @param[out] lines  how many lines there were; after a refusal, up to the one that is to blame */
bool sim_text_lines(FILE *stream, sim_text_reader_t read_line, void *state, int *lines,
                    sim_error_t *error);

/** Cuts the comment and the white space around what is left. */
char *sim_text_trim(char *text);

/** Takes the text up to the next comma, trimmed; NULL when there is none left. */
char *sim_text_field(char **rest);

/** The number that the text is, if it is one from low to high; else a refusal that names it. */
bool sim_text_number(const char *text, const char *name, double low, double high, double *number,
                     sim_error_t *error);

#endif
