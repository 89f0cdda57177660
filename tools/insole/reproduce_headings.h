/** @file reproduce_headings.h  How well the direction of each step is found: figures 3 and 4 of
 *  [PhoneUKF].
 *
 *  The true direction leads from where the walker is at the beginning of a step that was found to
 *  where they are at its end.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPRODUCE_HEADINGS_H
#define INSOLE_HOST_REPRODUCE_HEADINGS_H

#include "reproduce.h"

/** A way to find directions, and which share of its errors the paper has within 15 degrees. */
typedef struct {
    reproduce_row_t row;
    double printed_percent; /**< 0: not printed */
} reproduce_heading_row_t;

/** Its errors on all walks. */
typedef struct {
    double *errors_deg; /**< not below 0 */
    size_t count, room;
} reproduce_heading_errors_t;

typedef struct {
    const reproduce_heading_row_t *rows;
    int row_count;
    reproduce_heading_errors_t errors[REPRODUCE_ROWS];
} reproduce_headings_t;

/** Of the present walk. */
bool reproduce_headings_walk(reproduce_headings_t *headings, const reproduction_t *reproduction,
                             failure_t *failure);

/** Share of the errors up to a limit, in percent; not-a-number: there are none. */
double reproduce_headings_within(const reproduce_headings_t *headings, int row, double limit_deg);

void reproduce_headings_print(const reproduce_headings_t *headings, FILE *file);

void reproduce_headings_json(const reproduce_headings_t *headings, json_t *json);

bool reproduce_headings_draw(const reproduce_headings_t *headings,
                             const reproduction_t *reproduction, failure_t *failure);

void reproduce_headings_free(reproduce_headings_t *headings);

#endif
