/* SPDX-License-Identifier: MIT */
#include "fields.h"

#include <stddef.h>
#include <string.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

char *fields_trim(char *text)
{
    while (is_blank(*text)) {
        text++;
    }
    size_t length = strlen(text);
    while (length > 0u && is_blank(text[length - 1u])) {
        text[--length] = '\0';
    }
    return text;
}

char *fields_next(char **rest)
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
    return fields_trim(field);
}

void fields_split(fields_t *fields, char *line)
{
    fields->count = 0;
    if (fields_is_blank_line(line)) {
        return;
    }
    while (line != NULL) {
        if (fields->count == FIELDS_MAX) {
            fields->count++;
            return;
        }
        fields->at[fields->count++] = fields_next(&line);
    }
}

void fields_drop_comment(fields_t *fields, int id_field)
{
    for (int i = 0; i < fields->count && i < FIELDS_MAX; i++) {
        char *sign = i == id_field ? NULL : strchr(fields->at[i], '#');
        if (sign != NULL) {
            *sign = '\0';
            fields->at[i] = fields_trim(fields->at[i]);
            fields->count = i + 1;
        }
    }
}

bool fields_is_blank_line(const char *line)
{
    while (is_blank(*line)) {
        line++;
    }
    return *line == '\0' || *line == '#';
}
