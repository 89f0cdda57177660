/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdio.h>
#include <string.h>

#include "number.h"
#include "output.h"
#include "progress.h"
#include "radiomap_make.h"
#include "session.h"

static bool parse(const arguments_t *arguments, survey_rule_t *rule, radiomap_options_t *options,
                  failure_t *failure)
{
    double late_s = RADIOMAP_LATE_S, ahead_m = RADIOMAP_AHEAD_M;
    int64_t keep = UINT32_MAX;
    if (arguments->operand_count == 0u) {
        return failure_usage(failure, "insole radiomap: no survey: expected files or folders with "
                                      "rss and truth records");
    }
    if (!options_has(arguments, "out")) {
        return failure_usage(failure, "insole radiomap: no --out: expected --out FILE");
    }
    options->spacing_m = RADIOMAP_SPACING_M;
    options->has_bins = false;
    if (!options_number(arguments, "late", 0.0, 60.0, &late_s, failure) ||
        !options_number(arguments, "ahead", -10.0, 10.0, &ahead_m, failure) ||
        !options_number(arguments, "spacing", 0.05, 1000.0, &options->spacing_m, failure) ||
        !options_whole(arguments, "keep", 1, INSOLE_RADIO_APS_MAX, &keep, failure)) {
        return false;
    }
    options->keep = (uint32_t)keep;
    *rule = radiomap_rule(late_s, ahead_m);
    return true;
}

static bool read_sessions(const arguments_t *arguments, survey_t *survey, failure_t *failure)
{
    progress_t progress;
    bool is_good = true;
    progress_begin(&progress);
    for (size_t i = 0u; i < arguments->operand_count && is_good; i++) {
        is_good = survey_add(survey, arguments->operands[i], failure);
        progress_step(&progress, i + 1u, arguments->operand_count);
    }
    progress_end(&progress);
    return is_good;
}

static void print_counts(const survey_t *survey, unsigned long weird)
{
    const struct {
        unsigned long count;
        const char *why;
    } left[] = {{survey->outside, "outside the truth"},
                {survey->stale, "too old for their scan"},
                {survey->unheard, "without a number"},
                {weird, "not in -127 to 0 dBm"}};
    fprintf(stderr, "  %lu readings in %lu scans of %lu session%s\n",
            (unsigned long)survey->reading_count - weird, (unsigned long)survey->scan_count,
            (unsigned long)survey->sessions, survey->sessions == 1u ? "" : "s");
    for (size_t i = 0u; i < sizeof left / sizeof left[0]; i++) {
        if (left[i].count > 0u) {
            fprintf(stderr, "  left out: %lu readings %s\n", left[i].count, left[i].why);
        }
    }
}

static void print_summary(const radiomap_file_t *file, const survey_t *survey, unsigned long weird)
{
    char per_point[NUMBER_ROOM];
    uint32_t points = file->map.point_count, entries = file->map.first[points];
    fprintf(stderr, "radio map: %lu points, %lu access points, %lu entries, %s per point\n",
            (unsigned long)points, (unsigned long)file->ids.count, (unsigned long)entries,
            number_fixed(per_point, (double)entries / (double)points, 1));
    print_counts(survey, weird);
    fprintf(stderr, "  in flash it takes %lu bytes and the names of its access points\n",
            (unsigned long)radiomap_file_bytes(&file->map));
}

static bool write_file(const radiomap_file_t *file, const char *path, failure_t *failure)
{
    FILE *stream;
    if (!output_open(&stream, path, failure)) {
        return false;
    }
    radiomap_file_write(stream, file);
    return output_close(stream, path, failure);
}

/* A log must not be written over; the radio map of a folder that is surveyed is none. */
static bool check_out(const arguments_t *arguments, failure_t *failure)
{
    const char *out = options_value(arguments, "out");
    bool is_read = false;
    for (size_t i = 0u; i < arguments->operand_count && !is_read; i++) {
        session_t session;
        bool is_pipe = strcmp(arguments->operands[i], "-") == 0;
        if (!is_pipe) {
            bool is_open = session_open(&session, &arguments->operands[i], 1u, failure);
            is_read = is_open && session_reads(&session, out);
            session_close(&session);
            if (!is_open) {
                return false;
            }
        }
    }
    return !is_read ||
           failure_usage(failure, "insole radiomap: --out %s would overwrite what is read", out);
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    survey_t survey;
    radiomap_options_t options;
    radiomap_file_t file;
    unsigned long weird;
    memset(&survey, 0, sizeof survey);
    if (!parse(arguments, &survey.rule, &options, failure) || !check_out(arguments, failure)) {
        return false;
    }
    bool is_good = read_sessions(arguments, &survey, failure) &&
                   radiomap_make(&file, &survey, &options, &weird, failure);
    if (is_good) {
        is_good = write_file(&file, options_value(arguments, "out"), failure);
        if (is_good) {
            print_summary(&file, &survey, weird);
        }
        radiomap_file_free(&file);
    }
    survey_free(&survey);
    return is_good;
}

static const option_t options_of[] = {
    {"out", "FILE", "write the radio map there; - is standard output"},
    {"spacing", "METRES", "samples in a square of this side are one point (default 2.5)"},
    {"keep", "N", "of each point the N strongest access points; default: all"},
    {"late", "SECONDS",
     "radios listen later than their ages tell: a scan lies at t - age + late,\n"
     "but not after t (default 1; 0 for a radio that tells the truth)"},
    {"ahead", "METRES", "a scan speaks of a place so far ahead of the walker (default 0)"},
    {NULL, NULL, NULL}};

const command_t command_radiomap = {
    "radiomap",
    "SESSION... --out radiomap.csv",
    "what each place hears of each access point, from surveys",
    "A survey is a session with rss and truth records. Every SESSION (a file or a folder) stands\n"
    "for itself. A scan lies as a whole where its youngest reading was heard, by the truth; what\n"
    "is outside the truth is left out and counted, and so are readings older than 3.5 s beside\n"
    "the youngest of their scan.\n"
    "\n"
    "  insole radiomap survey1 survey2 --out radiomap.csv\n"
    "\n"
    "Whoever walks with the map should use the --late and --ahead that it was made with.\n",
    options_of,
    run};
