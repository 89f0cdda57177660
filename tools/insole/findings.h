/** @file findings.h  What was found wrong in the files of a site, in the order of their lines.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_FINDINGS_H
#define INSOLE_HOST_FINDINGS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef enum { FINDING_WARNING, FINDING_ERROR } finding_weight_t;

/** The file that is meant. */
typedef enum { FINDING_PLAN, FINDING_APS } finding_file_t;

typedef struct {
    finding_weight_t weight;
    finding_file_t file;
    unsigned long line; /**< 0: it is about all of the file */
    size_t order;       /**< in which it was found */
    char text[240];
} finding_t;

/** None is all zeros. */
typedef struct {
    finding_t *items;
    size_t count, room;
    size_t errors; /**< of them */
} findings_t;

void findings_add(findings_t *findings, finding_weight_t weight, finding_file_t file,
                  unsigned long line, const char *format, ...);

/** The plan before the access points, each by its lines. */
void findings_sort(findings_t *findings);

/** One line each: `plan.csv:12: error: what is wrong`. */
void findings_print(const findings_t *findings, FILE *file, const char *plan_name,
                    const char *aps_name);

void findings_free(findings_t *findings);

#endif
