/** @file ap_file.h  Where the access points are and how strong they are: aps.csv.
 *
 *  A header names the columns id, x, y, z, p0_dbm, exponent, near_dbm in any order, then comes one
 *  access point a line. Only id, x and y must be there; what is left out or empty is what
 *  insole_propagation_ap makes of the rest, z is AP_FILE_HEIGHT_M.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_AP_FILE_H
#define INSOLE_HOST_AP_FILE_H

#include <stdio.h>

#include "failure.h"
#include "id_table.h"
#include "insole/place/propagation.h"

/** z of an access point that does not tell [m]: a ceiling. */
#define AP_FILE_HEIGHT_M 2.5

/** What ap_file_number answers for an access point that is not in the file. */
#define AP_FILE_UNKNOWN UINT32_MAX

typedef struct {
    char *name;           /**< of the file, for messages */
    id_table_t ids;       /**< names of the access points by their index */
    insole_ap_t *aps;     /**< by index */
    unsigned long *lines; /**< of the file, by index */
    size_t count, ap_room, line_room;
} ap_file_t;

/** @param path a file, or `-` for standard input. A refusal leaves nothing to free.
 *  @param propagation settings that have passed their check */
bool ap_file_read(ap_file_t *aps, const char *path, const insole_propagation_config_t *propagation,
                  failure_t *failure);

/** Reads from a file that is already open, and closes it. */
bool ap_file_take(ap_file_t *aps, FILE *file, const char *name,
                  const insole_propagation_config_t *propagation, failure_t *failure);

/** Index of the access point that the id table of a log calls number `id`: ids have numbers in the
 *  order in which a log first names them, access points in that of their file. */
uint32_t ap_file_number(const ap_file_t *aps, const id_table_t *ids, uint32_t id);

/** Writes them as a file that ap_file_take reads, names and values by index. */
void ap_file_write(FILE *file, const id_table_t *ids, const insole_ap_t *aps);

void ap_file_free(ap_file_t *aps);

#endif
