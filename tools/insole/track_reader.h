/** @file track_reader.h  A whole track or truth file, for scoring and drawing.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_TRACK_READER_H
#define INSOLE_HOST_TRACK_READER_H

#include "failure.h"
#include "track.h"

/** Reads every place in a file: rows with x,y or `truth` records; others are passed over.
 *  Fails when there is none, or when their time goes back. */
bool track_read(track_t *track, const char *path, failure_t *failure);

#endif
