/** @file record.h  One record of a log, whichever kind of file it came from.
 *
 *  Values stand in the order of the record's columns; what was not given is not-a-number:
 *
 *      START  x y heading sigma_m sigma_rad          IMU    ax ay az gx gy gz
 *      ACC    ax ay az          GYR  gx gy gz        MAG    mx my mz
 *      RSS    dbm age           RANGE metres sigma   TRUTH  x y z      TRACK  x y z
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_RECORD_H
#define INSOLE_HOST_RECORD_H

#include <stdint.h>

/** In the order in which records of the same time are to be handed on. */
typedef enum {
    RECORD_START,
    RECORD_IMU,
    RECORD_ACC,
    RECORD_GYR,
    RECORD_MAG,
    RECORD_RSS,
    RECORD_RANGE,
    RECORD_TRUTH,
    RECORD_TRACK, /**< a row of what `replay` writes: no log, but read by `score` */
    RECORD_KINDS
} record_kind_t;

enum { RECORD_VALUES = 6 };

typedef struct {
    record_kind_t kind;
    int64_t t_us; /**< on the log's own clock */
    uint32_t id;  /**< RSS and RANGE: number in the id table */
    double value[RECORD_VALUES];
} record_t;

#endif
