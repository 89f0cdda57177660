/** @file line_reader.h  Lines of a text file, one at a time, however the file was made.
 *
 *  Takes LF and CRLF, a last line without an end, and a UTF-8 byte order mark; refuses NUL bytes
 *  and lines of more than LINE_LIMIT characters with `name:line: ...`. A line is handed out as
 *  soon as its end has been read, so that a pipe can be followed live.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_LINE_READER_H
#define INSOLE_HOST_LINE_READER_H

#include <stdio.h>

#include "failure.h"

enum { LINE_LIMIT = 8191 };

/** What a reader answers. */
typedef enum { READ_ONE, READ_END, READ_FAILED } read_t;

typedef struct {
    FILE *file;
    char *name;               /**< for messages */
    unsigned long number;     /**< of the line in `text`, from 1 */
    unsigned long long bytes; /**< read so far */
    char text[LINE_LIMIT + 1];
} line_reader_t;

/** @param path a file, or `-` for standard input */
bool line_reader_open(line_reader_t *reader, const char *path, failure_t *failure);

/** Reads from a file that is already open, and closes it in the end. */
void line_reader_attach(line_reader_t *reader, FILE *file, const char *name);

/** The next line, without its end, in `reader->text`, which the caller may change. */
read_t line_reader_next(line_reader_t *reader, failure_t *failure);

/** Fails with `name:line: ` in front of the text. @return READ_FAILED, always */
read_t line_reader_fail(const line_reader_t *reader, failure_t *failure, const char *format, ...);

void line_reader_close(line_reader_t *reader);

#endif
