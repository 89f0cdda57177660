/** @file report.h  One page of a replay to keep or to send: picture, error and uncertainty over
 *         time, and the summary in words. A single HTML file that needs no other.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPORT_H
#define INSOLE_HOST_REPORT_H

#include "plot.h"
#include "summary.h"

typedef struct {
    const plot_t *plot; /**< of one track, as the score moved it */
    const summary_t *summary;
} report_t;

/** @param path a file, or `-` for standard output */
bool report_write(const report_t *report, const char *path, failure_t *failure);

#endif
