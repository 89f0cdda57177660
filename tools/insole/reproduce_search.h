/** @file reproduce_search.h  The settings of some rows that do best, by a grid.
 *
 *  Every row with axes is tried with all combinations of their values, on the same walks; what
 *  counts is the mean error. To be run on other seeds than those of the table.
 *
 *      reproduce_search_t search;
 *      reproduce_search_begin(&search, &reproduction);
 *      if (reproduce_search_run(&search, &failure)) reproduce_search_print(&search, stdout);
 *      reproduce_search_free(&search);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPRODUCE_SEARCH_H
#define INSOLE_HOST_REPRODUCE_SEARCH_H

#include "reproduce.h"

typedef struct {
    reproduction_t *reproduction;   /**< that was begun and not measured */
    double *sums_m[REPRODUCE_ROWS]; /**< of the errors, per combination; NULL: a row without axes */
    size_t error_count;
} reproduce_search_t;

bool reproduce_search_has_axes(const reproduce_paper_t *paper);

void reproduce_search_begin(reproduce_search_t *search, reproduction_t *reproduction);

bool reproduce_search_run(reproduce_search_t *search, failure_t *failure);

/** Combinations of a row's values. */
int reproduce_search_count(const reproduce_row_t *row);

/** Number of a row's combination with the least mean error; of equal ones the first. */
int reproduce_search_best(const reproduce_search_t *search, int row);

/** A combination as `key=value key=value`. @return to be freed with free() */
char *reproduce_search_settings(const reproduce_row_t *row, int combination);

void reproduce_search_print(const reproduce_search_t *search, FILE *file);

void reproduce_search_free(reproduce_search_t *search);

#endif
