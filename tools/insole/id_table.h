/** @file id_table.h  Names of access points and anchors as small numbers, in order of appearance.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_ID_TABLE_H
#define INSOLE_HOST_ID_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    char **names;    /**< by number */
    size_t count;    /**< names known */
    size_t room;     /**< names that fit */
    uint32_t *slots; /**< hash table of numbers + 1; 0 is a free slot */
    size_t slot_count;
} id_table_t;

/** An empty table is all zeros. */
void id_table_init(id_table_t *table);

/** The number of a name, given to it when it is new. */
uint32_t id_table_number(id_table_t *table, const char *name);

/** The number of a name that is known already. @return false for one that is not */
bool id_table_find(const id_table_t *table, const char *name, uint32_t *number);

void id_table_free(id_table_t *table);

#endif
