/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdio.h>
#include <string.h>

#include "event_writer.h"
#include "number.h"
#include "output.h"
#include "platform.h"
#include "plot.h"
#include "replay_options.h"
#include "report.h"
#include "scoring.h"
#include "summary.h"
#include "track_writer.h"

/* A replay with all that it writes while it runs and keeps for the end. */
typedef struct {
    const arguments_t *arguments;
    replay_request_t request;
    replay_facts_t facts;
    scoring_t scoring;
    track_format_t format;
    track_writer_t writer;
    FILE *events;
    bool is_live;    /* a pipe is being followed: each row leaves at once */
    bool keeps_rows; /* for the score and the plot */
    track_t rows;
} job_t;

/* ---- while it runs ---------------------------------------------------------------------- */

static bool take_row(void *context, const track_row_t *row, failure_t *failure)
{
    job_t *job = context;
    if (job->keeps_rows) {
        track_add(&job->rows, row);
    }
    return track_writer_row(&job->writer, row, failure);
}

static bool take_event(void *context, const event_t *event, failure_t *failure)
{
    job_t *job = context;
    if (job->events == NULL) {
        return true;
    }
    event_writer_row(job->events, event);
    return !job->is_live ||
           output_flush(job->events, options_value(job->arguments, "events"), failure);
}

/* ---- before it -------------------------------------------------------------------------- */

/* What is written must not be what is read. */
static bool is_input(const job_t *job, const session_t *session, const char *path)
{
    const char *truth = options_value(job->arguments, "truth");
    const char *config = options_value(job->arguments, "config");
    const site_t *site = job->request.site;
    return session_reads(session, path) || (site != NULL && site_is_file(site, path)) ||
           (truth != NULL && platform_is_same_file(truth, path)) ||
           (config != NULL && platform_is_same_file(config, path));
}

static bool check_outputs(const job_t *job, const session_t *session, failure_t *failure)
{
    static const char *const names[] = {"out", "events", "plot", "report"};
    const char *command = job->arguments->command;
    int to_stdout = options_has(job->arguments, "json") ? 1 : 0;
    for (int i = 0; i < 4; i++) {
        const char *path = options_value(job->arguments, names[i]);
        to_stdout += path != NULL && strcmp(path, "-") == 0 ? 1 : 0;
        if (path != NULL && is_input(job, session, path)) {
            return failure_usage(failure, "insole %s: --%s %s would overwrite what is read",
                                 command, names[i], path);
        }
    }
    if (to_stdout > 1) {
        return failure_usage(failure,
                             "insole %s: only one of --out -, --events -, --plot -, --report - and "
                             "--json can have the standard output",
                             command);
    }
    return true;
}

static bool reads_stdin(const arguments_t *arguments)
{
    for (size_t i = 0u; i < arguments->operand_count; i++) {
        if (strcmp(arguments->operands[i], "-") == 0) {
            return true;
        }
    }
    return false;
}

static bool parse(job_t *job, failure_t *failure)
{
    const arguments_t *arguments = job->arguments;
    const char *format = options_value(arguments, "format");
    job->is_live = reads_stdin(arguments);
    job->keeps_rows = !job->is_live || options_has(arguments, "plot") ||
                      options_has(arguments, "report") || options_has(arguments, "truth");
    return replay_options_parse(arguments, &job->request, failure) &&
           options_number(arguments, "rate", 0.0, 1000.0, &job->request.rate_hz, failure) &&
           replay_options_check(arguments, &job->request, failure) &&
           (format == NULL || track_format_parse(format, &job->format, failure)) &&
           scoring_begin(&job->scoring, arguments, failure);
}

/* The logs are there: a misspelt name of one has not cost an older track. */
static bool open_files(void *context, const session_t *session, failure_t *failure)
{
    job_t *job = context;
    const arguments_t *arguments = job->arguments;
    if (!check_outputs(job, session, failure) ||
        !track_writer_open(&job->writer, options_value(arguments, "out"), job->format, job->is_live,
                           failure) ||
        !output_open(&job->events, options_value(arguments, "events"), failure)) {
        return false;
    }
    if (job->events != NULL) {
        event_writer_head(job->events);
    }
    return true;
}

/* ---- after it --------------------------------------------------------------------------- */

/* Closes both files whatever happened; the first failure counts. */
static bool close_files(job_t *job, bool is_good, failure_t *failure)
{
    failure_t ignored;
    bool is_closed = track_writer_close(&job->writer, is_good ? failure : &ignored);
    is_good = is_good && is_closed;
    is_closed = output_close(job->events, options_value(job->arguments, "events"),
                             is_good ? failure : &ignored);
    return is_good && is_closed;
}

static void describe(const summary_t *summary, char *text, size_t room)
{
    char walked[NUMBER_ROOM], rms[NUMBER_ROOM], end[NUMBER_ROOM];
    const score_t *score = summary->score;
    int length = snprintf(
        text, room, "%s tracker, method %s, %s m in %lu %s", summary->tracker, summary->method,
        number_fixed(walked, summary->facts->walked_m, 1), summary->facts->strides,
        method_tracker(summary->facts->method) == TRACKER_PHONE ? "steps" : "strides");
    if (score != NULL && length > 0 && (size_t)length < room) {
        snprintf(text + length, room - (size_t)length, "; track %s: rms %s m, end %s m",
                 score_alignment_text(score->alignment), number_fixed(rms, score->rms_m, 2),
                 number_fixed(end, score->end_2d_m, 2));
    }
}

static bool draw(const job_t *job, const summary_t *summary, failure_t *failure)
{
    const char *path = options_value(job->arguments, "plot");
    const char *page = options_value(job->arguments, "report");
    const char *name = "track";
    char subtitle[200];
    if (path == NULL && page == NULL) {
        return true;
    }
    track_t rows = scoring_drawn(&job->facts, &job->rows, summary->score);
    describe(summary, subtitle, sizeof subtitle);
    plot_t plot = {.title = platform_base_name(job->arguments->operands[0]),
                   .subtitle = subtitle,
                   .tracks = &rows,
                   .names = &name,
                   .track_count = 1u,
                   .truth = summary->score != NULL ? &job->scoring.truth : NULL,
                   .site = job->facts.knows_place ? job->request.site : NULL,
                   .cloud = &job->facts.fusion.cloud};
    const report_t report = {&plot, summary};
    bool is_good = (path == NULL || plot_write(&plot, path, failure)) &&
                   (page == NULL || report_write(&report, page, failure));
    track_free(&rows);
    return is_good;
}

static bool conclude(job_t *job, failure_t *failure)
{
    score_t score;
    summary_t summary = {tracker_name(job->request.tracker), method_name(job->request.method),
                         &job->facts, NULL, job->request.site};
    if (job->keeps_rows && scoring_score(&job->scoring, &job->facts, &job->rows, &score)) {
        summary.score = &score;
    }
    if (!draw(job, &summary, failure)) {
        return false;
    }
    if (!options_has(job->arguments, "json")) {
        summary_print(stderr, &summary);
        return true;
    }
    summary_json(stdout, &summary);
    return output_flush(stdout, "-", failure);
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    job_t job;
    memset(&job, 0, sizeof job);
    job.arguments = arguments;
    const replay_sink_t sink = {&job, open_files, take_row, take_event};
    bool is_good = parse(&job, failure) && replay_run(&job.request, &sink, &job.facts, failure);
    is_good = close_files(&job, is_good, failure);
    is_good = is_good && conclude(&job, failure);
    track_free(&job.rows);
    scoring_free(&job.scoring);
    replay_facts_free(&job.facts);
    replay_options_free(&job.request);
    return is_good;
}

static const option_t options[] = {
    {"method", "METHOD",
     "best: whatever is given is used as well as we know how (default);\n"
     "two-order: the second stage of [TwoOrder] as printed;\n"
     "wifi: radio alone, which needs no IMU;\n"
     "ins: inertial navigation with zero-velocity updates, nothing else;\n"
     "pdr: strides of modelled length in the inertial direction.\n"
     "With --tracker phone\n"
     "best: six states, or particles where a plan is known (default);\n"
     "pdr, pdr-gyro: steps alone, level by gravity and gyro or by the gyro;\n"
     "wifi-kde, wifi-ml: fingerprints alone, by kernels or the likeliest;\n"
     "ekf, ukf: steps and fixes by the filters of [PhoneEKF], [PhoneUKF];\n"
     "kf-const, ekf-const, ukf-const: their rivals with constant covariances;\n"
     "ml-shift: that of [WifiShift];\n"
     "pf, pf-kde: particles weighed by strengths, by fixes;\n"
     "wpf: by the likeliest fingerprint, and walls kill; zee: by walls alone"},
    REPLAY_OPTIONS,
    {"rate", "HZ", "rows of the track per second (default 10); 0: one per reading"},
    {"smooth", NULL, "ins, pdr: what comes after a moment counts for it too; rows come late"},
    {"out", "FILE", "write the track; - is standard output. Without --out none is written"},
    {"format", "FORMAT", "of the track: csv (default), tum or geojson"},
    {"events", "FILE", "write stances, strides, scans worked in, resamplings, ... as CSV"},
    {"plot", "FILE", "draw the track, and the truth if there is one, as SVG"},
    {"report", "FILE", "write one HTML page: picture, error and uncertainty over time, summary"},
    {"json", NULL, "summary as JSON on standard output instead of text on stderr"},
    {NULL, NULL, NULL}};

const command_t command_replay = {
    "replay",
    "LOG...",
    "compute the track of a walk from its log",
    "The logs together are one session on one clock: files, folders (all their .csv files), or -\n"
    "for standard input, which is followed as it grows: each row is printed as soon as it is\n"
    "known, about half a second after its reading. `insole help files` tells the formats.\n"
    "\n"
    "  insole replay walk.csv --plot walk.svg\n"
    "  insole replay walk.csv radio.csv --plan plan.csv --aps aps.csv --plot walk.svg\n"
    "  insole replay walk.csv --truth walk.truth.csv --out track.csv\n"
    "  insole replay - --out - < /dev/ttyUSB0\n",
    options,
    run};
