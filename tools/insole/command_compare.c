/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fields.h"
#include "memory.h"
#include "number.h"
#include "output.h"
#include "platform.h"
#include "plot.h"
#include "replay_options.h"
#include "score_print.h"
#include "scoring.h"

enum { METHODS_MAX = 16 };

/* One method's replay. */
typedef struct {
    const char *method;
    replay_facts_t facts;
    bool has_score;
    score_t score;
} trial_t;

typedef struct {
    const arguments_t *arguments;
    replay_request_t request;
    scoring_t scoring;
    char *names; /* of --methods, cut at the commas */
    fields_t methods;
    trial_t trials[METHODS_MAX];
    track_t tracks[METHODS_MAX];
    int count; /* trials made */
} contest_t;

static bool keep_row(void *context, const track_row_t *row, failure_t *failure)
{
    (void)failure;
    track_add(context, row);
    return true;
}

static bool run_trial(contest_t *contest, const char *method, failure_t *failure)
{
    trial_t *trial = &contest->trials[contest->count];
    track_t *track = &contest->tracks[contest->count];
    replay_request_t request = contest->request;
    replay_sink_t sink = {track, NULL, keep_row, NULL};
    contest->count++;
    trial->method = method;
    if (!method_parse(request.tracker, method, &request.method, failure) ||
        !replay_options_check(contest->arguments, &request, failure) ||
        !replay_run(&request, &sink, &trial->facts, failure)) {
        return false;
    }
    trial->has_score = scoring_score(&contest->scoring, &trial->facts, track, &trial->score);
    return true;
}

static bool parse(contest_t *contest, failure_t *failure)
{
    const char *methods = options_value(contest->arguments, "methods");
    if (methods == NULL) {
        return failure_usage(failure, "insole compare: expected --methods A,B");
    }
    contest->names = memory_text(methods);
    fields_split(&contest->methods, contest->names);
    if (contest->methods.count < 1 || contest->methods.count > METHODS_MAX) {
        return failure_usage(failure, "insole compare: --methods %.60s: expected 1 to %d names",
                             methods, METHODS_MAX);
    }
    return replay_options_parse(contest->arguments, &contest->request, failure) &&
           options_number(contest->arguments, "rate", 0.0, 1000.0, &contest->request.rate_hz,
                          failure) &&
           scoring_begin(&contest->scoring, contest->arguments, failure);
}

/* ---- results ---------------------------------------------------------------------------- */

static void print_cell(double value)
{
    char number[NUMBER_ROOM];
    printf(" %8s", isnan(value) ? "-" : number_fixed(number, value, 3));
}

static void print_trial(const trial_t *trial)
{
    const score_t *score = &trial->score;
    printf("%-12s %7lu", trial->method, trial->facts.strides);
    print_cell(trial->facts.walked_m);
    if (trial->has_score) {
        print_cell(score->mean_m);
        print_cell(score->rms_m);
        print_cell(score->p50_m);
        print_cell(score->p95_m);
        print_cell(score->max_m);
        print_cell(score->end_2d_m);
        print_cell(score->end_percent);
        print_cell(score->z_rms_m);
    }
    putchar('\n');
}

static void print_table(const contest_t *contest)
{
    printf("%-12s %7s %8s", "method",
           contest->request.tracker == TRACKER_PHONE ? "steps" : "strides", "walked m");
    if (contest->trials[0].has_score) {
        printf(" %8s %8s %8s %8s %8s %8s %8s %8s", "mean m", "rms m", "50 % m", "95 % m", "max m",
               "end m", "end %", "z rms m");
    }
    putchar('\n');
    for (int i = 0; i < contest->count; i++) {
        print_trial(&contest->trials[i]);
    }
}

static void print_json(const contest_t *contest)
{
    json_t json;
    json_begin(&json, stdout);
    json_array(&json, NULL);
    for (int i = 0; i < contest->count; i++) {
        const trial_t *trial = &contest->trials[i];
        json_object(&json, NULL);
        json_text(&json, "method", trial->method);
        json_whole(&json, "strides", (long long)trial->facts.strides);
        json_number(&json, "distance_m", trial->facts.walked_m, 4);
        if (trial->has_score) {
            score_json(&json, "score", &trial->score);
        }
        json_end(&json);
    }
    json_end(&json);
}

static bool draw(const contest_t *contest, failure_t *failure)
{
    const char *path = options_value(contest->arguments, "plot");
    const char *names[METHODS_MAX];
    track_t drawn[METHODS_MAX];
    bool has_truth = contest->trials[0].has_score;
    if (path == NULL) {
        return true;
    }
    for (int i = 0; i < contest->count; i++) {
        const trial_t *trial = &contest->trials[i];
        names[i] = trial->method;
        drawn[i] = scoring_drawn(&trial->facts, &contest->tracks[i],
                                 trial->has_score ? &trial->score : NULL);
    }
    plot_t plot = {.title = platform_base_name(contest->arguments->operands[0]),
                   .subtitle =
                       has_truth ? score_alignment_text(contest->trials[0].score.alignment) : "",
                   .tracks = drawn,
                   .names = names,
                   .track_count = (size_t)contest->count,
                   .truth = has_truth ? &contest->scoring.truth : NULL,
                   .site = contest->trials[0].facts.knows_place ? contest->request.site : NULL};
    bool is_good = plot_write(&plot, path, failure);
    for (int i = 0; i < contest->count; i++) {
        track_free(&drawn[i]);
    }
    return is_good;
}

static bool report(contest_t *contest, failure_t *failure)
{
    if (!draw(contest, failure)) {
        return false;
    }
    if (options_has(contest->arguments, "json")) {
        print_json(contest);
    } else {
        print_table(contest);
    }
    return output_flush(stdout, "-", failure);
}

static void free_contest(contest_t *contest)
{
    for (int i = 0; i < contest->count; i++) {
        track_free(&contest->tracks[i]);
        replay_facts_free(&contest->trials[i].facts);
    }
    scoring_free(&contest->scoring);
    replay_options_free(&contest->request);
    free(contest->names);
    free(contest);
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    contest_t *contest = memory_new(1u, sizeof *contest);
    contest->arguments = arguments;
    bool is_good = parse(contest, failure);
    for (int i = 0; is_good && i < contest->methods.count; i++) {
        is_good = run_trial(contest, contest->methods.at[i], failure);
    }
    is_good = is_good && report(contest, failure);
    free_contest(contest);
    return is_good;
}

static const option_t options[] = {
    {"methods", "A,B,...",
     "the methods to compare: " METHOD_FOOT_NAMES ";\n"
     "with --tracker phone:\n" METHOD_PHONE_PAPERS ",\n" METHOD_PHONE_OTHERS},
    REPLAY_OPTIONS,
    {"rate", "HZ", "rows of the tracks per second (default 10); 0: one per reading"},
    {"plot", "FILE", "draw all tracks, and the truth if there is one, as SVG"},
    {"json", NULL, "as JSON"},
    {NULL, NULL, NULL}};

const command_t command_compare = {
    "compare",
    "LOG... --methods A,B,...",
    "several methods on the same log: one table, one picture",
    "Every method sees the same readings and settings. With a truth the table has its errors.\n"
    "\n"
    "  insole compare folder --methods ins,two-order,best\n"
    "  insole compare walk.csv --methods ins,pdr --truth walk.truth.csv --plot both.svg\n",
    options,
    run};
