/** @file log_reader.h  The records of one log file, in the order of its lines.
 *
 *  The first line that is not a comment decides: a kind of record (record_line.h) or a header
 *  with a time column (table.h). A malformed line fails with `file:line: ...`.
 *
 *      log_reader_open(&reader, "walk.csv", &ids, &failure);
 *      while (log_reader_next(&reader, &record, &failure) == READ_ONE) ...
 *      log_reader_close(&reader);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_LOG_READER_H
#define INSOLE_HOST_LOG_READER_H

#include "id_table.h"
#include "line_reader.h"
#include "record.h"
#include "table.h"

typedef struct {
    line_reader_t lines;
    id_table_t *ids;
    bool is_decided, is_table;
    table_t table;
    record_t row[TABLE_RECORDS]; /**< records of the last row that have not been asked for yet */
    int row_count, row_taken;
} log_reader_t;

/** @param path a file, or `-` for standard input
 *  @param ids  takes the names of access points; shared by all logs of a session */
bool log_reader_open(log_reader_t *reader, const char *path, id_table_t *ids, failure_t *failure);

/** Reads from a file that is already open, and closes it in the end. */
void log_reader_attach(log_reader_t *reader, FILE *file, const char *name, id_table_t *ids);

read_t log_reader_next(log_reader_t *reader, record_t *record, failure_t *failure);

void log_reader_close(log_reader_t *reader);

#endif
