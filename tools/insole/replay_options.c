/* SPDX-License-Identifier: MIT */
#include "replay_options.h"

#include <stdlib.h>
#include <string.h>

#include "config_keys.h"
#include "fields.h"
#include "memory.h"
#include "number.h"
#include "site_folder.h"

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

/* ---- second order ----------------------------------------------------------------------- */

static bool apply_use(const arguments_t *arguments, replay_request_t *request, failure_t *failure)
{
    static const struct {
        const char *text;
        bool no_rss, no_range;
    } choices[] = {{"rss,range", false, false},
                   {"range,rss", false, false},
                   {"rss", false, true},
                   {"range", true, false}};
    const char *use = options_value(arguments, "use");
    for (size_t i = 0u; use != NULL && i < sizeof choices / sizeof choices[0]; i++) {
        if (strcmp(use, choices[i].text) == 0) {
            request->no_rss = choices[i].no_rss;
            request->no_range = choices[i].no_range;
            return true;
        }
    }
    return use == NULL ||
           failure_usage(failure, "insole %s: --use %.40s: expected rss, range or rss,range",
                         arguments->command, use);
}

static bool apply_cloud(const arguments_t *arguments, replay_request_t *request, failure_t *failure)
{
    bool is_phone = request->tracker == TRACKER_PHONE; /* whose methods have numbers of their own */
    int64_t seed = 1, particles = is_phone ? 0 : REPLAY_PARTICLES;
    double lag_s = (double)request->settings.fusion.lag_s;
    if (!options_whole(arguments, "seed", 0, INT64_MAX, &seed, failure) ||
        !options_whole(arguments, "particles", 1, INSOLE_CLOUD_PARTICLES_MAX, &particles,
                       failure) ||
        !options_number(arguments, "lag", 0.0, 60.0, &lag_s, failure)) {
        return false;
    }
    request->seed = (uint64_t)seed;
    request->particles = (uint32_t)particles;
    request->settings.fusion.lag_s = (insole_real_t)lag_s;
    return true;
}

/* Fingerprints alone tell the foot tracker nothing. */
static bool is_of_use(const site_t *site, tracker_t tracker)
{
    return site->building.plan != NULL || site->building.ap_count > 0u || tracker == TRACKER_PHONE;
}

static void close_site(replay_request_t *request)
{
    if (request->site != NULL) {
        site_t *site = (site_t *)request->site;
        site_free(site);
        free(site);
    }
    request->site = NULL;
}

/* What is told counts; of what is not, the folders that are replayed may hold it. */
static bool open_site(const arguments_t *arguments, replay_request_t *request, failure_t *failure)
{
    site_folder_t found;
    if (!site_folder_find(&found, arguments, failure)) {
        return false;
    }
    bool is_good = true;
    if (found.plan != NULL || found.aps != NULL || found.radiomap != NULL) {
        site_t *site = memory_new(1u, sizeof *site);
        request->site = site;
        is_good = site_open(site, found.plan, found.aps, found.radiomap,
                            &request->settings.propagation, failure);
        if (is_good && !is_of_use(site, request->tracker)) {
            close_site(request);
        }
    }
    request->leaves_radiomap =
        options_has(arguments, "radiomap") && request->tracker == TRACKER_FOOT;
    site_folder_free(&found);
    return is_good;
}

static bool apply_method(const arguments_t *arguments, replay_request_t *request,
                         failure_t *failure)
{
    const char *method = options_value(arguments, "method");
    const char *name = options_value(arguments, "tracker");
    if (name != NULL && !tracker_parse(name, &request->tracker, failure)) {
        return false;
    }
    request->method = method_of(&request->settings, request->tracker);
    return method == NULL || method_parse(request->tracker, method, &request->method, failure);
}

/* ---- all together ----------------------------------------------------------------------- */

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
    return apply_settings(arguments, &request->settings, failure) &&
           apply_method(arguments, request, failure) && apply_start(arguments, request, failure) &&
           apply_use(arguments, request, failure) && apply_cloud(arguments, request, failure) &&
           open_site(arguments, request, failure);
}

/* Does the method leave the building aside, or has it none? */
static bool is_first_order(const replay_request_t *request)
{
    return method_is_first_order(request->method) ||
           (request->method == METHOD_BEST && request->site == NULL);
}

/* When methods are compared those that cannot wait do not. */
static bool check_lag(const arguments_t *arguments, const replay_request_t *request,
                      failure_t *failure)
{
    if (!options_has(arguments, "lag") || request->method == METHOD_TWO_ORDER) {
        return true;
    }
    if (request->method == METHOD_BEST) {
        return request->site != NULL ||
               failure_usage(failure,
                             "insole %s: --lag needs a building: --plan FILE, --aps FILE or both",
                             arguments->command);
    }
    return !options_has(arguments, "method") ||
           failure_usage(failure, "insole %s: --lag is for best and two-order, not for %s",
                         arguments->command, method_name(request->method));
}

static bool check_phone(const arguments_t *arguments, const replay_request_t *request,
                        failure_t *failure)
{
    static const char *const foreign[] = {"aps", "smooth", "lag"};
    bool has_map = request->site != NULL && site_has_radiomap(request->site);
    if (method_is_radio_alone(request->method) && !has_map) {
        return failure_usage(failure, "insole %s: --method %s needs fingerprints: --radiomap FILE",
                             arguments->command, method_name(request->method));
    }
    if (request->method == METHOD_ZEE &&
        (request->site == NULL || request->site->building.plan == NULL)) {
        return failure_usage(failure, "insole %s: --method zee needs walls: --plan FILE",
                             arguments->command);
    }
    for (size_t i = 0u; i < sizeof foreign / sizeof foreign[0]; i++) {
        if (options_has(arguments, foreign[i])) {
            return failure_usage(failure, "insole %s: --%s is for the foot tracker",
                                 arguments->command, foreign[i]);
        }
    }
    return true;
}

bool replay_options_check(const arguments_t *arguments, const replay_request_t *request,
                          failure_t *failure)
{
    if (request->tracker == TRACKER_PHONE) {
        return check_phone(arguments, request, failure);
    }
    bool has_aps = request->site != NULL && request->site->building.ap_count > 0u;
    if (request->method == METHOD_WIFI && !has_aps) {
        return failure_usage(failure, "insole %s: --method wifi needs access points: --aps FILE",
                             arguments->command);
    }
    if (request->is_smooth && !is_first_order(request)) {
        return failure_usage(failure,
                             "insole %s: --smooth is for ins and pdr: method %s with a building "
                             "looks back by --lag SECONDS",
                             arguments->command, method_name(request->method));
    }
    return check_lag(arguments, request, failure);
}

void replay_options_free(replay_request_t *request)
{
    close_site(request);
}
