/** @file fields.h  A line cut at its commas.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_FIELDS_H
#define INSOLE_HOST_FIELDS_H

#include <stdbool.h>

/** More columns than this in a table are not looked at. */
enum { FIELDS_MAX = 512 };

typedef struct {
    char *at[FIELDS_MAX]; /**< blanks around each are gone */
    int count;            /**< 0 for an empty line; FIELDS_MAX + 1 when there were more */
} fields_t;

/** Cuts the first field off in place and moves `*rest` behind its comma, or to NULL after the last.
 *  @return the field without the blanks around it; NULL when `*rest` is NULL */
char *fields_next(char **rest);

/** Cuts the line in place. */
void fields_split(fields_t *fields, char *line);

/** Drops a comment: all from the first `#` on. An id may hold that sign: field `id_field` is
 *  passed over (-1: none is). */
void fields_drop_comment(fields_t *fields, int id_field);

/** The text without the blanks around it; cuts in place. */
char *fields_trim(char *text);

/** Is the line empty or nothing but a comment? */
bool fields_is_blank_line(const char *line);

#endif
