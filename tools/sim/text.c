/* SPDX-License-Identifier: MIT */
#include "sim/text.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

char *sim_text_trim(char *text)
{
    text[strcspn(text, "#")] = '\0';
    while (isspace((unsigned char)*text)) {
        text++;
    }
    size_t length = strlen(text);
    while (length > 0 && isspace((unsigned char)text[length - 1])) {
        length--;
    }
    text[length] = '\0';
    return text;
}

char *sim_text_field(char **rest)
{
    char *field = *rest;
    if (field == NULL) {
        return NULL;
    }
    char *comma = strchr(field, ',');
    *rest = comma == NULL ? NULL : comma + 1;
    if (comma != NULL) {
        *comma = '\0';
    }
    return sim_text_trim(field);
}

bool sim_text_number(const char *text, const char *name, double low, double high, double *number,
                     sim_error_t *error)
{
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end != '\0' || !(value >= low && value <= high)) {
        return sim_fail(error, "%s is '%.60s', expected a number from %g to %g", name, text, low,
                        high);
    }
    *number = value;
    return true;
}

bool sim_text_lines(FILE *stream, sim_text_reader_t read_line, void *state, int *lines,
                    sim_error_t *error)
{
    char line[SIM_TEXT_LONGEST + 2];
    *lines = 0;
    while (fgets(line, sizeof line, stream) != NULL) {
        ++*lines;
        if (strchr(line, '\n') == NULL && !feof(stream)) {
            sim_fail(error, "the line is too long, expected at most %d characters",
                     SIM_TEXT_LONGEST);
            return sim_fail_on_line(error, *lines);
        }
        char *text = sim_text_trim(line);
        if (*text != '\0' && !read_line(state, text, *lines, error)) {
            return sim_fail_on_line(error, *lines);
        }
    }
    return ferror(stream) == 0 || sim_fail(error, "cannot be read");
}
