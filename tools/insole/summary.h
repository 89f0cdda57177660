/** @file summary.h  What came of a replay, for people and for programs.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SUMMARY_H
#define INSOLE_HOST_SUMMARY_H

#include "replay.h"
#include "score.h"

typedef struct {
    const char *tracker, *method;
    const replay_facts_t *facts;
    const score_t *score; /**< NULL: there was no truth */
    const site_t *site;   /**< NULL: nothing is known of the building */
} summary_t;

void summary_print(FILE *file, const summary_t *summary);

void summary_json(FILE *file, const summary_t *summary);

#endif
