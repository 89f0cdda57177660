/** @file event_writer.h  What happened, as a CSV table.
 *
 *      event,begin,end,length,height,heading,turn,model_length
 *
 *  The event is stance, stride, start, scan, ranges, resampling, redraw or recovery. Seconds,
 * metres, radians; of all but strides only the times are told.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_EVENT_WRITER_H
#define INSOLE_HOST_EVENT_WRITER_H

#include <stdio.h>

#include "estimator.h"
#include "failure.h"

void event_writer_head(FILE *file);

void event_writer_row(FILE *file, const event_t *event);

#endif
