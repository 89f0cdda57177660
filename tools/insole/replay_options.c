/* SPDX-License-Identifier: MIT */
#include "replay_options.h"

#include <string.h>

#include "config_keys.h"
#include "fields.h"
#include "number.h"

static bool apply_settings(const arguments_t *arguments, settings_t *settings, failure_t *failure)
{
    const char *path = options_value(arguments, "config");
    failure_t what;
    if (path != NULL && !config_read(settings, path, failure)) {
        return false;
    }
    for (size_t i = 0u; i < arguments->given_count; i++) {
        const given_t *given = &arguments->given[i];
        if (strcmp(given->option->name, "set") == 0 &&
            !config_set_pair(settings, given->value, &what)) {
            return failure_usage(failure, "insole %s: --set %s", arguments->command, what.text);
        }
    }
    return true;
}

static bool parse_start(const char *text, record_t *start)
{
    char copy[128];
    fields_t fields;
    if (strlen(text) >= sizeof copy) {
        return false;
    }
    fields_split(&fields, strcpy(copy, text));
    start->kind = RECORD_START;
    start->id = 0u;
    for (int i = 0; i < RECORD_VALUES; i++) {
        start->value[i] = NUMBER_UNKNOWN;
    }
    return (fields.count == 2 || fields.count == 3) &&
           number_parse(fields.at[0], &start->value[0]) &&
           number_parse(fields.at[1], &start->value[1]) &&
           (fields.count == 2 || number_parse(fields.at[2], &start->value[2]));
}

static bool apply_start(const arguments_t *arguments, replay_request_t *request, failure_t *failure)
{
    const char *start = options_value(arguments, "start");
    request->no_start = options_has(arguments, "no-start");
    request->has_start = start != NULL;
    if (start != NULL && !parse_start(start, &request->start)) {
        return failure_usage(failure,
                             "insole %s: --start %.40s: expected x,y or x,y,heading in m and rad",
                             arguments->command, start);
    }
    if (request->has_start && request->no_start) {
        return failure_usage(failure, "insole %s: --start and --no-start contradict each other",
                             arguments->command);
    }
    return true;
}

static bool check_tracker(const arguments_t *arguments, failure_t *failure)
{
    const char *tracker = options_value(arguments, "tracker");
    if (tracker != NULL && strcmp(tracker, "foot") != 0) {
        return failure_usage(failure, "insole %s: --tracker %.40s: expected foot",
                             arguments->command, tracker);
    }
    return true;
}

bool replay_options_parse(const arguments_t *arguments, replay_request_t *request,
                          failure_t *failure)
{
    memset(request, 0, sizeof *request);
    request->logs = arguments->operands;
    request->log_count = arguments->operand_count;
    request->accel_unit = options_value(arguments, "accel-unit");
    request->gyro_unit = options_value(arguments, "gyro-unit");
    request->rate_hz = 10.0;
    request->is_smooth = options_has(arguments, "smooth");
    settings_init(&request->settings);
    if (request->log_count == 0u) {
        return failure_usage(failure,
                             "insole %s: no log: expected files, folders or - for standard input",
                             arguments->command);
    }
    return check_tracker(arguments, failure) &&
           apply_settings(arguments, &request->settings, failure) &&
           apply_start(arguments, request, failure);
}

bool replay_options_method(replay_request_t *request, const char *method, failure_t *failure)
{
    failure_t what;
    if (!config_set(&request->settings, "foot_tracker.method", method, &what)) {
        return failure_usage(failure, "insole: --method: %s", what.text);
    }
    return true;
}
