/* SPDX-License-Identifier: MIT */
#include "columns.h"

#include <stdio.h>
#include <string.h>

#include "nearest.h"
#include "number.h"

static void begin(columns_t *columns, const columns_layout_t *layout)
{
    memset(columns, 0, sizeof *columns);
    columns->layout = layout;
}

bool columns_open(columns_t *columns, const columns_layout_t *layout, const char *path,
                  failure_t *failure)
{
    begin(columns, layout);
    return line_reader_open(&columns->lines, path, failure);
}

void columns_attach(columns_t *columns, const columns_layout_t *layout, FILE *file,
                    const char *name)
{
    begin(columns, layout);
    line_reader_attach(&columns->lines, file, name);
}

const char *columns_text(const columns_layout_t *layout, int count, char text[COLUMNS_TEXT])
{
    text[0] = '\0';
    for (int i = 0; i < count; i++) {
        size_t length = strlen(text);
        snprintf(text + length, COLUMNS_TEXT - length, "%s%s", i > 0 ? "," : "",
                 layout->columns[i].name);
    }
    return text;
}

/* ---- header ----------------------------------------------------------------------------- */

/* The one that may have been meant is told; of one letter any could be. */
static bool refuse_column(const columns_t *columns, const char *name, failure_t *failure)
{
    const columns_layout_t *layout = columns->layout;
    char text[COLUMNS_TEXT];
    nearest_t nearest;
    nearest_begin(&nearest, name);
    for (int i = 0; i < layout->count; i++) {
        if (layout->columns[i].name[1] != '\0') {
            nearest_offer(&nearest, layout->columns[i].name);
        }
    }
    line_reader_fail(&columns->lines, failure, "unknown column \"%.40s\": expected some of %s",
                     name, columns_text(layout, layout->count, text));
    return nearest.best != NULL && failure_add(failure, " (%s?)", nearest.best);
}

static bool place_column(columns_t *columns, int field, failure_t *failure)
{
    const char *name = columns->fields.at[field];
    int column = 0;
    while (column < columns->layout->count &&
           strcmp(columns->layout->columns[column].name, name) != 0) {
        column++;
    }
    if (column == columns->layout->count) {
        return refuse_column(columns, name, failure);
    }
    if (columns->at[column] >= 0) {
        line_reader_fail(&columns->lines, failure, "column %s comes twice: expected each once",
                         name);
        return false;
    }
    columns->at[column] = field;
    return true;
}

static bool check_needed(const columns_t *columns, failure_t *failure)
{
    const columns_layout_t *layout = columns->layout;
    char all[COLUMNS_TEXT], needed[COLUMNS_TEXT];
    for (int i = 0; i < layout->needed; i++) {
        if (columns->at[i] < 0) {
            line_reader_fail(&columns->lines, failure,
                             "header has no column %s: expected %s, of which %s must be there",
                             layout->columns[i].name, columns_text(layout, layout->count, all),
                             columns_text(layout, layout->needed, needed));
            return false;
        }
    }
    return true;
}

static bool read_header(columns_t *columns, failure_t *failure)
{
    fields_drop_comment(&columns->fields, -1);
    columns->field_count = columns->fields.count;
    for (int i = 0; i < COLUMNS_MAX; i++) {
        columns->at[i] = -1;
    }
    for (int i = 0; i < columns->field_count && i < FIELDS_MAX; i++) {
        if (!place_column(columns, i, failure)) {
            return false;
        }
    }
    return check_needed(columns, failure);
}

/* ---- rows ------------------------------------------------------------------------------- */

static read_t check_row(columns_t *columns, failure_t *failure)
{
    fields_drop_comment(&columns->fields, columns->at[columns->layout->id]);
    if (columns->fields.count == columns->field_count) {
        return READ_ONE;
    }
    return line_reader_fail(&columns->lines, failure,
                            "row has %d fields: expected %d as in the header",
                            columns->fields.count, columns->field_count);
}

read_t columns_next(columns_t *columns, failure_t *failure)
{
    read_t answer;
    while ((answer = line_reader_next(&columns->lines, failure)) == READ_ONE) {
        fields_split(&columns->fields, columns->lines.text);
        if (columns->fields.count > 0 && columns->field_count > 0) {
            return check_row(columns, failure);
        }
        if (columns->fields.count > 0 && !read_header(columns, failure)) {
            return READ_FAILED;
        }
    }
    return answer;
}

bool columns_has(const columns_t *columns, int column)
{
    return columns->field_count > 0 && columns->at[column] >= 0;
}

bool columns_number(const columns_t *columns, int column, double *number, failure_t *failure)
{
    const column_t *what = &columns->layout->columns[column];
    char low[NUMBER_ROOM], high[NUMBER_ROOM];
    const char *text = columns->at[column] < 0 ? "" : columns->fields.at[columns->at[column]];
    if (*text == '\0' && column >= columns->layout->needed) {
        return true;
    }
    if (!number_parse(text, number)) {
        line_reader_fail(&columns->lines, failure, "%s \"%.40s\" is not a number", what->name,
                         text);
        return false;
    }
    if (*number < what->low || *number > what->high) {
        line_reader_fail(&columns->lines, failure, "%s %.40s is out of range: expected %s to %s",
                         what->name, text, number_short(low, what->low),
                         number_short(high, what->high));
        return false;
    }
    return true;
}

const char *columns_id(const columns_t *columns, failure_t *failure)
{
    const char *id = columns->fields.at[columns->at[columns->layout->id]];
    size_t length = strlen(id);
    if (length == 0u || length > COLUMNS_ID_LENGTH) {
        line_reader_fail(&columns->lines, failure, "id of %u characters: expected 1 to %d",
                         (unsigned)length, COLUMNS_ID_LENGTH);
        return NULL;
    }
    return id;
}

void columns_close(columns_t *columns)
{
    line_reader_close(&columns->lines);
}
