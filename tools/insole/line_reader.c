/* SPDX-License-Identifier: MIT */
#include "line_reader.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "platform.h"

void line_reader_attach(line_reader_t *reader, FILE *file, const char *name)
{
    reader->file = file;
    reader->name = memory_text(name);
    reader->number = 0u;
    reader->bytes = 0u;
    reader->text[0] = '\0';
}

bool line_reader_open(line_reader_t *reader, const char *path, failure_t *failure)
{
    reader->file = NULL;
    reader->name = NULL;
    if (strcmp(path, "-") == 0) {
        line_reader_attach(reader, stdin, "stdin");
        return true;
    }
    if (platform_is_folder(path)) {
        return failure_input(failure, "%s: is a folder: expected a file", path);
    }
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return failure_input(failure, "%s: cannot open: %s", path, strerror(errno));
    }
    line_reader_attach(reader, file, path);
    return true;
}

read_t line_reader_fail(const line_reader_t *reader, failure_t *failure, const char *format, ...)
{
    char what[500];
    va_list values;
    va_start(values, format);
    vsnprintf(what, sizeof what, format, values);
    va_end(values);
    failure_input(failure, "%s:%lu: %s", reader->name, reader->number, what);
    return READ_FAILED;
}

static void drop_mark_and_return(line_reader_t *reader, size_t length)
{
    if (length > 0u && reader->text[length - 1u] == '\r') {
        reader->text[--length] = '\0';
    }
    if (reader->number == 1u && strncmp(reader->text, "\xEF\xBB\xBF", 3u) == 0) {
        memmove(reader->text, reader->text + 3, length - 2u);
    }
}

static read_t end_of_file(line_reader_t *reader, failure_t *failure)
{
    if (ferror(reader->file)) {
        failure_input(failure, "%s: cannot read: %s", reader->name, strerror(errno));
        return READ_FAILED;
    }
    return READ_END;
}

read_t line_reader_next(line_reader_t *reader, failure_t *failure)
{
    size_t length = 0u;
    int c = getc(reader->file);
    if (c == EOF) {
        return end_of_file(reader, failure);
    }
    reader->number++;
    for (; c != EOF && c != '\n'; c = getc(reader->file)) {
        if (c == '\0') {
            return line_reader_fail(reader, failure, "NUL byte: expected plain text");
        }
        if (length == LINE_LIMIT) {
            return line_reader_fail(reader, failure, "line is longer than %d characters",
                                    LINE_LIMIT);
        }
        reader->text[length++] = (char)c;
    }
    reader->text[length] = '\0';
    reader->bytes += length + 1u;
    drop_mark_and_return(reader, length);
    return c == EOF && ferror(reader->file) ? end_of_file(reader, failure) : READ_ONE;
}

void line_reader_close(line_reader_t *reader)
{
    if (reader->file != NULL && reader->file != stdin) {
        fclose(reader->file);
    }
    free(reader->name);
    reader->file = NULL;
    reader->name = NULL;
}
