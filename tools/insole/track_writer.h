/** @file track_writer.h  A track as text: csv, tum or geojson.
 *
 *  csv      t,x,y,z,heading,var_x,cov_xy,var_y,var_z,var_heading,state
 *  tum      t x y z qx qy qz qw, for tools that compare trajectories
 *  geojson  one LineString in metres, written when the track is complete
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_TRACK_WRITER_H
#define INSOLE_HOST_TRACK_WRITER_H

#include <stdio.h>

#include "failure.h"
#include "track.h"

typedef enum { TRACK_CSV, TRACK_TUM, TRACK_GEOJSON } track_format_t;

typedef struct {
    FILE *file; /**< NULL: nothing is to be written */
    const char *path;
    track_format_t format;
    bool is_live; /**< each row leaves at once */
    track_t rows; /**< geojson: kept until the end */
} track_writer_t;

/** @param name csv, tum or geojson */
bool track_format_parse(const char *name, track_format_t *format, failure_t *failure);

/** @param path a file, `-` for standard output, or NULL for nothing */
bool track_writer_open(track_writer_t *writer, const char *path, track_format_t format,
                       bool is_live, failure_t *failure);

bool track_writer_row(track_writer_t *writer, const track_row_t *row, failure_t *failure);

/** Writes what is still to be written. */
bool track_writer_close(track_writer_t *writer, failure_t *failure);

#endif
