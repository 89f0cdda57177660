/** @file carry_windows.h  The windows of labelled logs, by the library's own features.
 *
 *  People differ in how strongly and how fast they walk more than they do in how a phone moves in a
 *  pocket. Hence each log is felt as it is and, for growing alone, as somebody else's: weaker,
 *  stronger, slower and faster. Windows at rest are left out.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_CARRY_WINDOWS_H
#define INSOLE_HOST_CARRY_WINDOWS_H

#include "carry_classes.h"
#include "carry_index.h"
#include "insole/sense/carry.h"

/** Seconds of a log that are drawn together: neighbours are no independent witnesses. */
#define CARRY_BLOCK_S 20

typedef struct {
    insole_carry_features_t features;
    uint32_t log;    /**< of all that were read */
    uint32_t block;  /**< running number over all logs */
    uint8_t variant; /**< 0: as it was felt */
} carry_row_t;

/** A log whose windows are there. */
typedef struct {
    int class_number;
    uint32_t group;  /**< of equal person and position */
    uint32_t person; /**< number in `persons` */
} carry_source_t;

typedef struct {
    carry_classes_t classes;
    id_table_t persons, groups;
    carry_source_t *logs;
    carry_row_t *rows;
    uint32_t *log_of_block;
    size_t log_count, row_count, block_count, log_room, row_room, block_room;
    size_t without_gyro;                    /**< rows */
    unsigned long still, refused, left_out; /**< windows at rest, samples, logs in no class */
} carry_windows_t;

/** @param classes  as in carry_classes_init */
bool carry_windows_init(carry_windows_t *windows, const char *classes, failure_t *failure);

/** Reads the logs of an index. @param is_varied  as somebody else's, too */
bool carry_windows_add(carry_windows_t *windows, const carry_index_t *index, bool is_varied,
                       const char *accel_unit, failure_t *failure);

void carry_windows_free(carry_windows_t *windows);

#endif
