/** @file carry_index.h  Which log was carried by whom, and where: the index of `train-carry`.
 *
 *  A CSV whose header names the columns file, person (or user) and position in any order; other
 *  columns are passed over. Files count from the folder of the index.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_CARRY_INDEX_H
#define INSOLE_HOST_CARRY_INDEX_H

#include <stddef.h>

#include "failure.h"

typedef struct {
    char *path, *person, *position;
    unsigned long line; /**< of the index */
} carry_log_t;

typedef struct {
    char *name; /**< of the index, for messages */
    carry_log_t *logs;
    size_t count, room;
} carry_index_t;

/** A refusal leaves nothing to free. */
bool carry_index_read(carry_index_t *index, const char *path, failure_t *failure);

void carry_index_free(carry_index_t *index);

#endif
