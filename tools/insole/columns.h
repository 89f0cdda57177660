/** @file columns.h  Files whose header names the columns, with one thing a line and its id in it.
 *
 *  Columns come in any order. aps.csv and radiomap.csv are such files.
 *
 *      columns_open(&columns, &layout, path, &failure);
 *      while (columns_next(&columns, &failure) == READ_ONE) {
 *          if (!columns_number(&columns, X, &x, &failure)) ...
 *      }
 *      columns_close(&columns);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_COLUMNS_H
#define INSOLE_HOST_COLUMNS_H

#include "fields.h"
#include "line_reader.h"

enum { COLUMNS_MAX = 8, COLUMNS_TEXT = 128, COLUMNS_ID_LENGTH = 63 };

typedef struct {
    const char *name;
    double low, high; /**< of its numbers; the column of the id has none */
} column_t;

/** What a file can have. Columns are counted from 0. */
typedef struct {
    const column_t *columns;
    int count;  /**< <= COLUMNS_MAX */
    int needed; /**< the first ones must be there, with something in every row */
    int id;     /**< one of those; it may hold anything but a comma */
} columns_layout_t;

typedef struct {
    const columns_layout_t *layout;
    line_reader_t lines;
    fields_t fields;     /**< of the row */
    int at[COLUMNS_MAX]; /**< field of each column; -1: the file does not have it */
    int field_count;     /**< 0 before the header */
} columns_t;

/** @param path a file, or `-` for standard input */
bool columns_open(columns_t *columns, const columns_layout_t *layout, const char *path,
                  failure_t *failure);

/** Reads from a file that is already open, and closes it in the end. */
void columns_attach(columns_t *columns, const columns_layout_t *layout, FILE *file,
                    const char *name);

/** The next row, as many fields long as the header. */
read_t columns_next(columns_t *columns, failure_t *failure);

bool columns_has(const columns_t *columns, int column);

/** What the row tells of a column, within its range; where it tells nothing of one that need not
 *  be there `*number` stays as it is. */
bool columns_number(const columns_t *columns, int column, double *number, failure_t *failure);

/** @return the row's id, of 1 to COLUMNS_ID_LENGTH characters; NULL: failed */
const char *columns_id(const columns_t *columns, failure_t *failure);

/** The first `count` names, separated by commas. @return text */
const char *columns_text(const columns_layout_t *layout, int count, char text[COLUMNS_TEXT]);

void columns_close(columns_t *columns);

#endif
