/* SPDX-License-Identifier: MIT */
#include "log_reader.h"

#include "record_line.h"

static void begin(log_reader_t *reader, id_table_t *ids)
{
    reader->ids = ids;
    reader->is_decided = false;
    reader->is_table = false;
    reader->row_count = 0;
    reader->row_taken = 0;
}

bool log_reader_open(log_reader_t *reader, const char *path, id_table_t *ids, failure_t *failure)
{
    begin(reader, ids);
    return line_reader_open(&reader->lines, path, failure);
}

void log_reader_attach(log_reader_t *reader, FILE *file, const char *name, id_table_t *ids)
{
    begin(reader, ids);
    line_reader_attach(&reader->lines, file, name);
}

/* The first line with content: a header (true) or a record (false)? */
static bool take_header(log_reader_t *reader, fields_t *fields, read_t *answer, failure_t *failure)
{
    reader->is_decided = true;
    if (record_line_is_kind(fields->at[0])) {
        return false;
    }
    if (!table_is_header(fields)) {
        *answer = line_reader_fail(&reader->lines, failure,
                                   "\"%.40s\" begins neither a record nor a header: expected "
                                   "imu,t,ax,ay,az,gx,gy,gz or a header such as "
                                   "t,ax,ay,az,gx,gy,gz",
                                   fields->at[0]);
        return true;
    }
    reader->is_table = true;
    bool is_good = table_parse_header(&reader->table, fields, &reader->lines, failure);
    *answer = is_good ? READ_ONE : READ_FAILED;
    return true;
}

/* Makes records of a line that has content. */
static read_t take_line(log_reader_t *reader, fields_t *fields, failure_t *failure)
{
    read_t answer = READ_ONE;
    if (!reader->is_decided && take_header(reader, fields, &answer, failure)) {
        return answer;
    }
    bool is_good;
    if (reader->is_table) {
        is_good = table_parse_row(&reader->table, fields, reader->row, &reader->row_count,
                                  &reader->lines, failure);
    } else {
        reader->row_count = 1;
        is_good = record_line_parse(fields, reader->ids, reader->row, &reader->lines, failure);
    }
    return is_good ? READ_ONE : READ_FAILED;
}

read_t log_reader_next(log_reader_t *reader, record_t *record, failure_t *failure)
{
    fields_t fields;
    while (reader->row_taken == reader->row_count) {
        read_t answer = line_reader_next(&reader->lines, failure);
        if (answer != READ_ONE) {
            return answer;
        }
        reader->row_count = 0;
        reader->row_taken = 0;
        fields_split(&fields, reader->lines.text);
        if (fields.count > 0 && take_line(reader, &fields, failure) == READ_FAILED) {
            reader->row_count = 0;
            return READ_FAILED;
        }
    }
    *record = reader->row[reader->row_taken++];
    return READ_ONE;
}

void log_reader_close(log_reader_t *reader)
{
    line_reader_close(&reader->lines);
}
