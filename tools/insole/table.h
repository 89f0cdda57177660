/** @file table.h  Logs, truths and tracks with a header line that names the columns.
 *
 *  `t` or `time`, and any of ax,ay,az  gx,gy,gz  mx,my,mz  x,y[,z], in any order and of any case;
 *  other columns are passed over. A table with acceleration or turn rate is a log and its x,y are
 *  passed over too; one with x,y alone is a truth, and with a column `state` a track.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_TABLE_H
#define INSOLE_HOST_TABLE_H

#include "fields.h"
#include "line_reader.h"
#include "record.h"

/** Most records in a row: IMU and MAG. */
enum { TABLE_RECORDS = 2 };

/** Columns are counted from 0; -1: not there. */
typedef struct {
    int columns;
    int t;
    int accel[3], gyro[3], mag[3], place[3];
    bool has_accel, has_gyro, has_mag, has_place, is_track;
} table_t;

/** Do these fields look like a header: is one of them `t` or `time`? */
bool table_is_header(const fields_t *fields);

bool table_parse_header(table_t *table, fields_t *fields, const line_reader_t *line,
                        failure_t *failure);

/** Makes records of a row. @param[out] count records made, 1..TABLE_RECORDS */
bool table_parse_row(const table_t *table, fields_t *fields, record_t records[TABLE_RECORDS],
                     int *count, const line_reader_t *line, failure_t *failure);

#endif
