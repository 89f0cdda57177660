/** @file track.h  Rows of a track: positions at times, in memory.
 *
 *  Truth is held in the same rows: of a row of truth only time and place mean anything.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_TRACK_H
#define INSOLE_HOST_TRACK_H

#include <stdbool.h>
#include <stddef.h>

#include "insole/base/types.h"
#include "record.h"

/** A fix on the log's clock. */
typedef struct {
    int64_t t_us;
    double x_m, y_m, z_m; /**< z not-a-number: not known */
    double heading_rad;
    double var_x_m2, cov_xy_m2, var_y_m2, var_z_m2, var_heading_rad2;
    insole_fix_state_t state;
} track_row_t;

/** An empty track is all zeros. */
typedef struct {
    track_row_t *rows;
    size_t count, room;
} track_t;

void track_add(track_t *track, const track_row_t *row);

/** Adds the place in a TRUTH or TRACK record. */
void track_add_record(track_t *track, const record_t *record);

/** Puts the rows in order of time. */
void track_sort(track_t *track);

/** Where a sorted track is at a time, interpolated. @return false before its begin, after its end
 */
bool track_place(const track_t *track, int64_t t_us, double *x_m, double *y_m);

void track_free(track_t *track);

/** Length of the way in the plane, in legs of at least `leg_m`: the jitter of a standing
 *  measurement is not walked. */
double track_length(const track_t *track, double leg_m);

/** `align`, `search`, `track`, `coast` or `lost`. */
const char *track_state_name(insole_fix_state_t state);

#endif
