/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdio.h>
#include <string.h>

#include "number.h"
#include "platform.h"
#include "plot.h"
#include "score.h"
#include "track_reader.h"

/* A picture on its way. */
typedef struct {
    const arguments_t *arguments;
    track_t tracks[PLOT_COLOURS], truth;
    site_t site;
    bool has_site;
} drawing_t;

/* Places alone are read: a row is drawn as one that can be trusted. */
static bool read_tracks(drawing_t *drawing, failure_t *failure)
{
    const arguments_t *arguments = drawing->arguments;
    for (size_t i = 0u; i < arguments->operand_count; i++) {
        track_t *track = &drawing->tracks[i];
        if (!track_read(track, arguments->operands[i], failure)) {
            return false;
        }
        for (size_t k = 0u; k < track->count; k++) {
            track->rows[k].state = INSOLE_FIX_TRACK;
        }
    }
    const char *truth = options_value(arguments, "truth");
    return truth == NULL || track_read(&drawing->truth, truth, failure);
}

static bool open_site(drawing_t *drawing, failure_t *failure)
{
    const char *plan = options_value(drawing->arguments, "plan");
    const char *aps = options_value(drawing->arguments, "aps");
    drawing->has_site =
        (plan != NULL || aps != NULL) &&
        site_open(&drawing->site, plan, aps, NULL, &insole_propagation_defaults, failure);
    return drawing->has_site || (plan == NULL && aps == NULL);
}

static void describe(const drawing_t *drawing, char *text, size_t room)
{
    char length[NUMBER_ROOM], rms[NUMBER_ROOM], end[NUMBER_ROOM];
    const track_t *track = &drawing->tracks[0];
    score_t score;
    text[0] = '\0';
    if (drawing->arguments->operand_count > 1u) {
        return;
    }
    if (drawing->truth.count == 0u) {
        snprintf(text, room, "%lu rows, %s m", (unsigned long)track->count,
                 number_fixed(length, track_length(track, 0.5), 1));
        return;
    }
    score_compute(track, &drawing->truth, ALIGN_NONE, &score);
    snprintf(text, room, "%lu rows; rms %s m, end %s m", (unsigned long)track->count,
             number_fixed(rms, score.rms_m, 2), number_fixed(end, score.end_2d_m, 2));
}

static bool draw(const drawing_t *drawing, failure_t *failure)
{
    const arguments_t *arguments = drawing->arguments;
    const char *names[PLOT_COLOURS] = {NULL};
    char subtitle[160];
    for (size_t i = 0u; i < arguments->operand_count; i++) {
        names[i] = platform_base_name(arguments->operands[i]);
    }
    describe(drawing, subtitle, sizeof subtitle);
    const plot_t plot = {.title = names[0],
                         .subtitle = subtitle,
                         .tracks = drawing->tracks,
                         .names = names,
                         .track_count = arguments->operand_count,
                         .truth = drawing->truth.count > 0u ? &drawing->truth : NULL,
                         .site = drawing->has_site ? &drawing->site : NULL};
    return plot_write(&plot, options_value(arguments, "out"), failure);
}

static bool check(const arguments_t *arguments, failure_t *failure)
{
    const char *out = options_value(arguments, "out");
    if (arguments->operand_count == 0u || arguments->operand_count > PLOT_COLOURS) {
        return failure_usage(failure, "insole draw: expected one to %d tracks", PLOT_COLOURS);
    }
    if (out == NULL) {
        return failure_usage(failure, "insole draw: no --out: expected --out FILE");
    }
    const char *const read[] = {options_value(arguments, "truth"), options_value(arguments, "plan"),
                                options_value(arguments, "aps")};
    bool is_read = false;
    for (size_t i = 0u; i < sizeof read / sizeof read[0]; i++) {
        is_read = is_read || (read[i] != NULL && platform_is_same_file(read[i], out));
    }
    for (size_t i = 0u; i < arguments->operand_count; i++) {
        is_read = is_read || platform_is_same_file(arguments->operands[i], out);
    }
    return !is_read ||
           failure_usage(failure, "insole draw: --out %s would overwrite what is read", out);
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    static drawing_t drawing;
    if (!check(arguments, failure)) {
        return false;
    }
    memset(&drawing, 0, sizeof drawing);
    drawing.arguments = arguments;
    bool is_good =
        read_tracks(&drawing, failure) && open_site(&drawing, failure) && draw(&drawing, failure);
    for (size_t i = 0u; i < PLOT_COLOURS; i++) {
        track_free(&drawing.tracks[i]);
    }
    track_free(&drawing.truth);
    if (drawing.has_site) {
        site_free(&drawing.site);
    }
    return is_good;
}

static const option_t options[] = {{"truth", "FILE", "draw this beside them"},
                                   {"plan", "FILE", "the floor plan that lies under them"},
                                   {"aps", "FILE", "access points on it"},
                                   {"out", "FILE", "write SVG there; - is standard output"},
                                   {NULL, NULL, NULL}};

const command_t command_draw = {
    "draw",
    "TRACK... --out FILE.svg",
    "a picture of tracks, wherever they come from",
    "A track is a table with a header that names t,x,y: what `replay --out` writes, or what a "
    "device\n"
    "of tools/firmware says.\n"
    "\n"
    "  insole draw device.csv --truth truth.csv --plan plan.csv --out device.svg\n",
    options,
    run};
