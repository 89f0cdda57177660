/* SPDX-License-Identifier: MIT */
#include "scoring.h"

#include <string.h>

#include "track_reader.h"

bool scoring_begin(scoring_t *scoring, const arguments_t *arguments, failure_t *failure)
{
    const char *align = options_value(arguments, "align");
    const char *truth = options_value(arguments, "truth");
    memset(scoring, 0, sizeof *scoring);
    scoring->is_told = align != NULL;
    return (align == NULL || score_alignment_parse(align, &scoring->alignment, failure)) &&
           (truth == NULL || track_read(&scoring->truth, truth, failure));
}

static alignment_t free_what_is_unknown(const replay_facts_t *facts)
{
    if (!facts->knows_place) {
        return ALIGN_SE2;
    }
    return facts->knows_heading ? ALIGN_NONE : ALIGN_YAW;
}

bool scoring_score(scoring_t *scoring, replay_facts_t *facts, const track_t *rows, score_t *score)
{
    if (scoring->truth.count == 0u) {
        track_t none = {NULL, 0u, 0u};
        scoring->truth = facts->truth;
        facts->truth = none;
        track_sort(&scoring->truth);
    }
    if (scoring->truth.count == 0u) {
        return false;
    }
    score_compute(rows, &scoring->truth,
                  scoring->is_told ? scoring->alignment : free_what_is_unknown(facts), score);
    return true;
}

track_t scoring_drawn(const replay_facts_t *facts, const track_t *rows, const score_t *score)
{
    track_t drawn = {NULL, 0u, 0u};
    for (size_t i = 0u; i < rows->count; i++) {
        track_row_t row = rows->rows[i];
        if (!facts->knows_place || row.t_us >= facts->start_us) {
            if (score != NULL) {
                score_move(&score->motion, &row);
            }
            track_add(&drawn, &row);
        }
    }
    return drawn;
}

void scoring_free(scoring_t *scoring)
{
    track_free(&scoring->truth);
}
