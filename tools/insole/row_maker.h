/** @file row_maker.h  Fixes in, rows at the due times out.
 *
 *  Row k is due at first + k / rate. Between two fixes no more than ROW_JOIN_US apart the position
 *  is interpolated; over a longer interval the fix before it holds, as state coast, for what is
 *  after a gap may not change what was written of it. ROW_HOLD_US into a gap the rows end until
 *  the next fix.
 *
 *      row_maker_init(&maker, 10.0);
 *      row_maker_push(&maker, &fix);
 *      while (row_maker_take(&maker, &row)) ...
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_ROW_MAKER_H
#define INSOLE_HOST_ROW_MAKER_H

#include "track.h"

/** With the 0.465 s that a tracker looks ahead this keeps rows 0.5 s old unchanged for good. */
#define ROW_JOIN_US INT64_C(35000)
#define ROW_HOLD_US INT64_C(600000000)

typedef struct {
    int64_t rate_mhz;           /**< thousandths of a row per second; 0: a row per fix */
    int64_t first_us;           /**< due time of row 0 */
    int64_t next;               /**< number of the next row */
    track_row_t before, newest; /**< the last two fixes */
    int held;                   /**< how many of them are there */
    bool is_taken;              /**< rate 0: the newest fix has been taken */
} row_maker_t;

/** @param rate_hz 0, or 0.001..1000 */
void row_maker_init(row_maker_t *maker, double rate_hz);

/** Row 0 is due at this time instead of at the first fix. */
void row_maker_begin(row_maker_t *maker, int64_t first_us);

/** Takes the next fix; one that does not come after the last is dropped. Take all rows before
 *  the next push. */
void row_maker_push(row_maker_t *maker, const track_row_t *fix);

bool row_maker_take(row_maker_t *maker, track_row_t *row);

#endif
