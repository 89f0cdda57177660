/** @file radiomap_file.h  Fingerprints of a building: radiomap.csv.
 *
 *  A header names the columns x, y, id, mean_dbm, std_dbm, count in any order, then comes one
 * access point at one point a line. std_dbm and count may be missing. Rows whose places are equal
 * to the millimetre belong to one point, wherever they stand in the file; a point was visited as
 * often as it heard the access point that it heard most often.
 *
 *      if (radiomap_file_read(&file, "radiomap.csv", &failure)) ...
 *          insole_kde_fix_begin(&kde, &file.map, NULL, readings, count);
 *      radiomap_file_free(&file);
 *
 *  Access points have their numbers in the order of their names, points in that of the file. What
 *  is written is rounded as the map is: mm, 0.5 dB, 1/8 dB; what is read from it is the map that
 * was written, bit for bit, but for histograms, which the file does not hold.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_RADIOMAP_FILE_H
#define INSOLE_HOST_RADIOMAP_FILE_H

#include <stdio.h>

#include "failure.h"
#include "id_table.h"
#include "insole/place/radio_survey.h"

/** What radiomap_file_number answers for an access point that is not in the map. */
#define RADIOMAP_FILE_UNKNOWN UINT32_MAX

enum { RADIOMAP_FILE_POINTS = 1000000, RADIOMAP_FILE_ENTRIES = 50000000 };

typedef struct {
    char *name;                       /**< of the file, for messages; NULL: made, not read */
    id_table_t ids;                   /**< names of the access points by their number */
    insole_radio_map_memory_t memory; /**< what the map looks at */
    insole_radio_map_t map;           /**< it has passed insole_radio_map_check() */
} radiomap_file_t;

/** @param path a file, or `-` for standard input. A refusal leaves nothing to free. */
bool radiomap_file_read(radiomap_file_t *file, const char *path, failure_t *failure);

/** Reads from a file that is already open, and closes it. */
bool radiomap_file_take(radiomap_file_t *file, FILE *stream, const char *name, failure_t *failure);

/** Number in the map of the access point that the id table of a log calls number `id`. */
uint32_t radiomap_file_number(const radiomap_file_t *file, const id_table_t *ids, uint32_t id);

/** Writes what radiomap_file_take reads. */
void radiomap_file_write(FILE *stream, const radiomap_file_t *file);

/** Room for a map: of its tables those that need not be there, spread, counts and visits, only
 * where wanted; no histograms. */
void radiomap_file_make_room(insole_radio_map_memory_t *memory, uint32_t points, uint32_t entries,
                             bool has_spread, bool has_counts);

/** Bytes of the map's tables, as they would lie in flash. */
size_t radiomap_file_bytes(const insole_radio_map_t *map);

/** The names of an id table in alphabetical order, as a new table.
 *  @param[out] numbers  in the new one, by number in the old one; of as many as there are */
void radiomap_file_sort_ids(const id_table_t *ids, id_table_t *sorted, uint32_t *numbers);

void radiomap_file_free(radiomap_file_t *file);

#endif
