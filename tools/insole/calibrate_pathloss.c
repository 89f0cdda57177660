/* SPDX-License-Identifier: MIT */
#include "calibrate.h"

#include <math.h>
#include <string.h>

#include "output.h"
#include "path_report.h"

enum { FEWEST_READINGS = 20 };

/* A survey that goes no farther stands at one place. */
static const double shortest_survey_m = 2.0;

static bool read_sessions(survey_t *survey, const char *const *sessions, size_t count,
                          failure_t *failure)
{
    for (size_t i = 0u; i < count; i++) {
        if (!survey_add(survey, sessions[i], failure)) {
            return false;
        }
    }
    return true;
}

static bool check_survey(const path_readings_t *path, failure_t *failure)
{
    path_place_t low = path->places[0], high = low;
    for (size_t i = 0u; i < path->count; i++) {
        low.x_m = fmin(low.x_m, path->places[i].x_m);
        low.y_m = fmin(low.y_m, path->places[i].y_m);
        high.x_m = fmax(high.x_m, path->places[i].x_m);
        high.y_m = fmax(high.y_m, path->places[i].y_m);
    }
    if (hypot(high.x_m - low.x_m, high.y_m - low.y_m) < shortest_survey_m) {
        return failure_input(failure,
                             "insole calibrate pathloss: the survey stands at one place: expected "
                             "places near to and far from the access points");
    }
    if (path->heard < FEWEST_READINGS) {
        return failure_input(failure,
                             "insole calibrate pathloss: only %lu readings of known access "
                             "points: expected %d or more",
                             path->heard, FEWEST_READINGS);
    }
    return true;
}

static bool write_aps(const char *path, const path_model_t *model, const path_readings_t *readings,
                      failure_t *failure)
{
    FILE *file;
    if (path == NULL) {
        return true;
    }
    if (!output_open(&file, path, failure)) {
        return false;
    }
    path_report_aps(file, model, readings);
    return output_close(file, path, failure);
}

static bool fit(const survey_t *survey, const path_site_t *site, const char *out, FILE *file,
                failure_t *failure)
{
    static path_readings_t path; /* its site points into itself */
    path_model_t model;
    if (!path_readings_make(&path, survey, site, failure)) {
        return false;
    }
    bool is_good = check_survey(&path, failure);
    if (is_good && out != NULL && site_is_file(&path.site, out)) {
        is_good = failure_usage(
            failure, "insole calibrate pathloss: --out %s would overwrite what is read", out);
    }
    if (is_good) {
        path_model_fit(&model, &path);
        path_report(file, &model, &path, survey, out != NULL);
        is_good = write_aps(out, &model, &path, failure);
        path_model_free(&model);
    }
    path_readings_free(&path);
    return is_good;
}

bool calibrate_pathloss(const arguments_t *arguments, const char *const *sessions, size_t count,
                        FILE *file, failure_t *failure)
{
    path_site_t site = {options_value(arguments, "plan"), options_value(arguments, "aps"), 0.0};
    survey_t survey;
    if (site.aps == NULL) {
        return failure_usage(failure, "insole calibrate pathloss: no access points: expected --aps "
                                      "FILE, and --plan FILE where there are walls");
    }
    if (!options_number(arguments, "height", -10.0, 10.0, &site.height_m, failure)) {
        return false;
    }
    memset(&survey, 0, sizeof survey);
    bool is_good = read_sessions(&survey, sessions, count, failure) &&
                   fit(&survey, &site, options_value(arguments, "out"), file, failure);
    survey_free(&survey);
    return is_good;
}
