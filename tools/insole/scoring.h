/** @file scoring.h  Against which truth a replay is scored, and how it is brought there.
 *
 *  The truth is read before the replay, so that a mistake in it shows at once, and is put beside
 *  the track after it: there is no way from here to the tracker.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SCORING_H
#define INSOLE_HOST_SCORING_H

#include "options.h"
#include "replay.h"
#include "score.h"

typedef struct {
    bool is_told; /**< the alignment is; else it frees what no start tells */
    alignment_t alignment;
    track_t truth; /**< of --truth, else empty until the logs have been read */
} scoring_t;

/** Reads --align and --truth. */
bool scoring_begin(scoring_t *scoring, const arguments_t *arguments, failure_t *failure);

/** Scores the rows against --truth, or else against the truth in the logs.
 *  @return false when there is no truth */
bool scoring_score(scoring_t *scoring, replay_facts_t *facts, const track_t *rows, score_t *score);

/** The rows as they belong into a picture: without those before the start, which are not on the
 *  map, and moved as `score` did (NULL: not at all). To be freed by track_free. */
track_t scoring_drawn(const replay_facts_t *facts, const track_t *rows, const score_t *score);

void scoring_free(scoring_t *scoring);

#endif
