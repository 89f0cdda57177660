/* SPDX-License-Identifier: MIT */
#include "carry_index.h"

#include <stdlib.h>
#include <string.h>

#include "fields.h"
#include "line_reader.h"
#include "memory.h"
#include "platform.h"

#define HEADER "file,person,position"

enum { FILE_NAME, PERSON, POSITION, COLUMNS, LONGEST_NAME = 40 };

typedef struct {
    carry_index_t *index;
    line_reader_t lines;
    fields_t fields;
    failure_t *failure;
    char *folder;
    int at[COLUMNS];
    int field_count; /* 0 before the header */
} reader_t;

static int column_of(const char *name)
{
    static const char *const names[] = {"file", "person", "position", "user"};
    for (int i = 0; i < 4; i++) {
        if (strcmp(names[i], name) == 0) {
            return i < COLUMNS ? i : PERSON;
        }
    }
    return -1;
}

static bool read_header(reader_t *reader)
{
    for (int i = 0; i < COLUMNS; i++) {
        reader->at[i] = -1;
    }
    for (int i = 0; i < reader->fields.count && i < FIELDS_MAX; i++) {
        int column = column_of(reader->fields.at[i]);
        if (column >= 0 && reader->at[column] >= 0) {
            line_reader_fail(&reader->lines, reader->failure,
                             "column %s comes twice: expected each once", reader->fields.at[i]);
            return false;
        }
        if (column >= 0) {
            reader->at[column] = i;
        }
    }
    for (int i = 0; i < COLUMNS; i++) {
        if (reader->at[i] < 0) {
            line_reader_fail(&reader->lines, reader->failure,
                             "header is not of an index: expected the columns " HEADER);
            return false;
        }
    }
    reader->field_count = reader->fields.count;
    return true;
}

static bool check_row(reader_t *reader)
{
    if (reader->fields.count != reader->field_count) {
        line_reader_fail(&reader->lines, reader->failure,
                         "row has %d fields: expected %d as in the header", reader->fields.count,
                         reader->field_count);
        return false;
    }
    for (int i = 0; i < COLUMNS; i++) {
        const char *text = reader->fields.at[reader->at[i]];
        if (*text == '\0' || (i != FILE_NAME && strlen(text) > LONGEST_NAME)) {
            line_reader_fail(&reader->lines, reader->failure,
                             "field %d is empty or too long: expected " HEADER
                             ", names of at most %d characters",
                             reader->at[i] + 1, LONGEST_NAME);
            return false;
        }
    }
    return true;
}

static bool read_row(reader_t *reader)
{
    carry_index_t *index = reader->index;
    if (!check_row(reader)) {
        return false;
    }
    const char *file = reader->fields.at[reader->at[FILE_NAME]];
    index->logs = memory_room(index->logs, &index->room, index->count + 1u, sizeof *index->logs);
    carry_log_t *log = &index->logs[index->count++];
    log->path = *file == '/' || *reader->folder == '\0' ? memory_text(file)
                                                        : platform_join(reader->folder, file);
    log->person = memory_text(reader->fields.at[reader->at[PERSON]]);
    log->position = memory_text(reader->fields.at[reader->at[POSITION]]);
    log->line = reader->lines.number;
    return true;
}

static bool read_lines(reader_t *reader)
{
    read_t answer;
    while ((answer = line_reader_next(&reader->lines, reader->failure)) == READ_ONE) {
        fields_split(&reader->fields, reader->lines.text);
        fields_drop_comment(&reader->fields, -1);
        if (reader->fields.count > 0 &&
            !(reader->field_count == 0 ? read_header(reader) : read_row(reader))) {
            return false;
        }
    }
    if (answer == READ_END && reader->index->count == 0u) {
        return failure_input(reader->failure,
                             "%s: no logs: expected a header, " HEADER ", and a row for each log",
                             reader->lines.name);
    }
    return answer == READ_END;
}

/* The part of a path before the name of the file. */
static char *folder_of(const char *path)
{
    char *folder = memory_text(path);
    folder[platform_base_name(path) - path] = '\0';
    size_t length = strlen(folder);
    if (length > 1u) {
        folder[length - 1u] = '\0';
    }
    return folder;
}

bool carry_index_read(carry_index_t *index, const char *path, failure_t *failure)
{
    reader_t *reader = memory_new(1u, sizeof *reader);
    memset(index, 0, sizeof *index);
    reader->index = index;
    reader->failure = failure;
    reader->folder = folder_of(path);
    index->name = memory_text(path);
    bool is_open = line_reader_open(&reader->lines, path, failure);
    bool is_good = is_open && read_lines(reader);
    if (is_open) {
        line_reader_close(&reader->lines);
    }
    if (!is_good) {
        carry_index_free(index);
    }
    free(reader->folder);
    free(reader);
    return is_good;
}

void carry_index_free(carry_index_t *index)
{
    for (size_t i = 0u; i < index->count; i++) {
        free(index->logs[i].path);
        free(index->logs[i].person);
        free(index->logs[i].position);
    }
    free(index->logs);
    free(index->name);
    memset(index, 0, sizeof *index);
}
