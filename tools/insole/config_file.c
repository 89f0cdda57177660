/* SPDX-License-Identifier: MIT */
#include "config_keys.h"

#include <string.h>

#include "fields.h"
#include "line_reader.h"

/* Cuts `key = value` in two. */
static bool split_pair(char *pair, char **name, char **value)
{
    char *equals = strchr(pair, '=');
    if (equals == NULL) {
        return false;
    }
    *equals = '\0';
    *name = fields_trim(pair);
    *value = fields_trim(equals + 1);
    return true;
}

bool config_set_pair(settings_t *settings, const char *pair, failure_t *failure)
{
    char copy[256];
    char *name, *value;
    if (strlen(pair) >= sizeof copy || !split_pair(strcpy(copy, pair), &name, &value)) {
        return failure_input(failure, "\"%.60s\": expected key=value", pair);
    }
    return config_set(settings, name, value, failure);
}

static read_t take_line(settings_t *settings, line_reader_t *reader, failure_t *failure)
{
    char *name, *value;
    reader->text[strcspn(reader->text, "#")] = '\0';
    if (*fields_trim(reader->text) == '\0') {
        return READ_ONE;
    }
    if (!split_pair(reader->text, &name, &value)) {
        return line_reader_fail(reader, failure, "\"%.60s\": expected key = value",
                                fields_trim(reader->text));
    }
    failure_t what;
    if (!config_set(settings, name, value, &what)) {
        return line_reader_fail(reader, failure, "%s", what.text);
    }
    return READ_ONE;
}

static bool read_lines(settings_t *settings, line_reader_t *reader, failure_t *failure)
{
    read_t answer = READ_ONE;
    while (answer == READ_ONE) {
        answer = line_reader_next(reader, failure);
        if (answer == READ_ONE) {
            answer = take_line(settings, reader, failure);
        }
    }
    return answer == READ_END;
}

bool config_read_file(settings_t *settings, FILE *file, const char *name, failure_t *failure)
{
    line_reader_t reader;
    line_reader_attach(&reader, file, name);
    bool is_good = read_lines(settings, &reader, failure);
    line_reader_close(&reader);
    return is_good;
}

bool config_read(settings_t *settings, const char *path, failure_t *failure)
{
    line_reader_t reader;
    bool is_good =
        line_reader_open(&reader, path, failure) && read_lines(settings, &reader, failure);
    line_reader_close(&reader);
    return is_good;
}
