/** @file record_line.h  Lines of the form `kind,t,...`.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_RECORD_LINE_H
#define INSOLE_HOST_RECORD_LINE_H

#include "fields.h"
#include "id_table.h"
#include "line_reader.h"
#include "record.h"

/** Is this the name of a kind of record? */
bool record_line_is_kind(const char *word);

/** Name of a kind as it stands in a log. */
const char *record_line_kind_name(record_kind_t kind);

/** Reads the time in a field. Fails with "t ... is not a time". */
bool record_line_time(const char *field, int64_t *t_us, const line_reader_t *line,
                      failure_t *failure);

/** Makes a record of a line's fields.
 *  @param line for messages: where the fields come from */
bool record_line_parse(fields_t *fields, id_table_t *ids, record_t *record,
                       const line_reader_t *line, failure_t *failure);

#endif
