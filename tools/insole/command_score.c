/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdio.h>
#include <string.h>

#include "output.h"
#include "score_print.h"
#include "track_reader.h"

static bool print_score(const arguments_t *arguments, const score_t *score, failure_t *failure)
{
    json_t json;
    if (options_has(arguments, "json")) {
        json_begin(&json, stdout);
        score_json(&json, NULL, score);
    } else {
        score_print(stdout, score);
    }
    return output_flush(stdout, "-", failure);
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    const char *align = options_value(arguments, "align");
    alignment_t alignment = ALIGN_NONE;
    track_t track, truth;
    score_t score;
    if (arguments->operand_count != 2u) {
        return failure_usage(failure, "insole score: expected two files, TRACK and TRUTH");
    }
    if (align != NULL && !score_alignment_parse(align, &alignment, failure)) {
        return false;
    }
    memset(&track, 0, sizeof track);
    memset(&truth, 0, sizeof truth);
    bool is_good = track_read(&track, arguments->operands[0], failure) &&
                   track_read(&truth, arguments->operands[1], failure);
    if (is_good) {
        score_compute(&track, &truth, alignment, &score);
        is_good = print_score(arguments, &score, failure);
    }
    track_free(&track);
    track_free(&truth);
    return is_good;
}

static const option_t options[] = {
    {"align", "HOW",
     "none (default), yaw (the track turned about its start) or se2 (turned and\n"
     "shifted), by least squares"},
    {"json", NULL, "as JSON"},
    {NULL, NULL, NULL}};

const command_t command_score = {
    "score",
    "TRACK TRUTH",
    "how far a track is from the truth",
    "Both are tables with a header that names t,x,y and perhaps z; TRACK is what `replay --out`\n"
    "writes. The track is interpolated at the times of the truth; a point of truth where the\n"
    "track has a hole of more than 2 s, or has ended more than 0.5 s before, counts 30 m.\n"
    "Where the track leaps (more than 20 m/s), the row after the leap counts.\n"
    "A truth of two points is a loop or a walk between them: its end error is what counts.\n"
    "\n"
    "  insole score track.csv walk.truth.csv --align se2\n",
    options,
    run};
