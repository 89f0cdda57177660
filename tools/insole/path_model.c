/* SPDX-License-Identifier: MIT */
#include "path_model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "number.h"
#include "statistics.h"

/* A larger standard error is no knowledge. */
static const double worst_error[PATH_UNKNOWNS] = {5.0, 0.5, 0.3, 2.0, 2.5};
static const char *const unit_of[PATH_UNKNOWNS] = {" dB", "", "", " dB", " dB"};

static const double limits_db[] = {4.0,  6.0,  8.0,  10.0, 12.0, 14.0,  16.0,
                                   18.0, 22.0, 26.0, 30.0, 40.0, 1000.0};
enum { LIMITS = sizeof limits_db / sizeof limits_db[0], FEW_READINGS = 10 };

/* Differences of log likelihoods: 99 % and 95 % of one degree of freedom. */
static const double clearly = 3.3, nearly = 1.9;

/* ---- what can be known ------------------------------------------------------------------ */

static void give_up(path_model_t *model, path_unknown_t k, const char *reason)
{
    model->fit.is_fixed[k] = true;
    model->fit.value[k] = model->fit.survey.start[k];
    snprintf(model->reason[k], PATH_REASON_ROOM, "%s", reason);
}

/* What needs no fit to be seen. */
static void give_up_at_sight(path_model_t *model, const path_readings_t *path)
{
    const char *no_wall =
        path->site.building.plan == NULL ? "there is no plan" : "no reading came through a wall";
    if (!(path->told_db > 0.0)) {
        give_up(model, PATH_TOLD,
                path->through > 0u ? "the plan tells the loss of no wall on the way" : no_wall);
    }
    if (!(path->untold_walls > 0.0)) {
        give_up(model, PATH_WALL,
                path->through > 0u ? "the plan tells the loss of every wall on the way" : no_wall);
    }
    if (path->with_heading == 0u) {
        give_up(model, PATH_BODY, "the truth stands still: the walker's direction is not known");
    }
}

/* The value that is known worst; PATH_UNKNOWNS: all are known well enough. */
static path_unknown_t find_worst(const path_model_t *model)
{
    path_unknown_t worst = PATH_UNKNOWNS;
    double most = 1.0;
    for (int k = 0; k < PATH_UNKNOWNS; k++) {
        double share = model->fit.error[k] / worst_error[k];
        if (!model->fit.is_fixed[k] && k != PATH_P0 && share > most) {
            most = share;
            worst = (path_unknown_t)k;
        }
    }
    return worst;
}

static void fit_what_is_seen(path_model_t *model)
{
    path_unknown_t worst;
    path_fit_run(&model->fit);
    while ((worst = find_worst(model)) != PATH_UNKNOWNS) {
        char reason[PATH_REASON_ROOM], number[NUMBER_ROOM];
        snprintf(reason, sizeof reason, "its standard error would be %s%s",
                 number_fixed(number, model->fit.error[worst], 2), unit_of[worst]);
        give_up(model, worst, reason);
        path_fit_run(&model->fit);
    }
}

/* ---- the largest loss of all walls ------------------------------------------------------ */

static double likelihood_of_limit(path_fit_t *fit, double most_db)
{
    fit->most_db = most_db;
    path_fit_run(fit);
    return fit->log_likelihood;
}

static void fit_most(path_model_t *model, double usual_db)
{
    double likelihood[LIMITS];
    size_t best = 0u;
    model->fit.keeps_weights = true;
    double usual = likelihood_of_limit(&model->fit, usual_db);
    for (size_t i = 0u; i < LIMITS; i++) {
        likelihood[i] = likelihood_of_limit(&model->fit, limits_db[i]);
        best = likelihood[i] > likelihood[best] ? i : best;
    }
    model->sees_most = likelihood[best] > usual + clearly;
    model->most_low_db = model->most_high_db = limits_db[best];
    for (size_t i = LIMITS; i-- > 0u;) {
        bool is_near = likelihood[i] > likelihood[best] - nearly;
        model->most_low_db = is_near ? limits_db[i] : model->most_low_db;
        model->most_high_db =
            is_near ? fmax(model->most_high_db, limits_db[i]) : model->most_high_db;
    }
    model->fit.keeps_weights = false;
    likelihood_of_limit(&model->fit, model->sees_most ? limits_db[best] : usual_db);
}

/* ---- the whole -------------------------------------------------------------------------- */

static double typical_sigma(const path_fit_t *fit)
{
    double *sigmas = memory_new(fit->survey.ap_count, sizeof *sigmas);
    size_t count = 0u;
    for (size_t a = 0u; a < fit->survey.ap_count; a++) {
        if (fit->aps[a].heard >= FEW_READINGS) {
            sigmas[count++] = fit->aps[a].sigma_db;
        }
    }
    double typical = statistics_percentile(sigmas, count, 50.0);
    free(sigmas);
    return count > 0u ? typical : fit->rms_db;
}

void path_model_fit(path_model_t *model, const path_readings_t *path)
{
    const insole_propagation_config_t *usual = &insole_propagation_defaults;
    const path_survey_t survey = {path->readings,
                                  path->count,
                                  path->ap_count,
                                  path->squares.count,
                                  path->floor_dbm,
                                  (double)usual->multipath_db,
                                  (double)usual->tail_dof,
                                  {(double)usual->p0_dbm, (double)usual->exponent, 1.0,
                                   (double)usual->wall_db, (double)usual->body_db}};
    memset(model, 0, sizeof *model);
    path_fit_begin(&model->fit, &survey);
    model->fit.most_db = (double)usual->walls_max_db;
    give_up_at_sight(model, path);
    fit_what_is_seen(model);
    if (!model->fit.is_fixed[PATH_TOLD] || !model->fit.is_fixed[PATH_WALL]) {
        fit_most(model, (double)usual->walls_max_db);
    }
    model->typical_sigma_db = typical_sigma(&model->fit);
}

void path_model_free(path_model_t *model)
{
    path_fit_free(&model->fit);
    memset(model, 0, sizeof *model);
}

/* ---- access points that do not fit ------------------------------------------------------ */

static const double absurd_factor = 1.5, absurd_db = 1.5, lowest_exponent = 0.8,
                    highest_exponent = 5.0;

bool path_model_is_absurd(const path_model_t *model, size_t ap)
{
    const path_ap_t *a = &model->fit.aps[ap];
    return a->heard >= FEW_READINGS &&
           (a->sigma_db > absurd_factor * model->typical_sigma_db + absurd_db ||
            a->own[PATH_EXPONENT] < lowest_exponent || a->own[PATH_EXPONENT] > highest_exponent);
}

enum { MOST_PLACES = 2500, MOST_READINGS = 300 };

static const double margin_m = 10.0, better_share = 0.7;

/* Readings of one access point, thinned out. */
typedef struct {
    const path_model_t *model;
    const path_readings_t *path;
    survey_reading_t heard[MOST_READINGS];
    size_t count;
    insole_ap_t ap;
} suspect_t;

static void gather(suspect_t *suspect, size_t ap)
{
    const path_readings_t *path = suspect->path;
    size_t stride = suspect->model->fit.aps[ap].heard / MOST_READINGS + 1u, seen = 0u;
    for (size_t i = 0u; i < path->count; i++) {
        const path_reading_t *reading = &path->readings[i];
        if (reading->ap == ap && !isnan(reading->dbm) && seen++ % stride == 0u) {
            const survey_reading_t heard = {
                0u, reading->dbm, path->places[i].x_m, path->places[i].y_m, 0.0, 0.0};
            suspect->heard[suspect->count++] = heard;
        }
    }
}

/* Mean absolute residual about the median, with the common values: p0 is free, the body unknown. */
static double error_at(suspect_t *suspect, double x_m, double y_m)
{
    double residual[MOST_READINGS], error = 0.0;
    suspect->ap.x_m = (insole_real_t)x_m;
    suspect->ap.y_m = (insole_real_t)y_m;
    for (size_t i = 0u; i < suspect->count; i++) {
        path_reading_t reading = path_readings_at(suspect->path, &suspect->ap, &suspect->heard[i]);
        residual[i] = reading.dbm - path_fit_expect(&suspect->model->fit, &reading, false);
    }
    double median = statistics_percentile(residual, suspect->count, 50.0);
    for (size_t i = 0u; i < suspect->count; i++) {
        error += fabs(residual[i] - median);
    }
    return error / (double)suspect->count;
}

static void search(suspect_t *suspect, const path_place_t *low, const path_place_t *high,
                   path_elsewhere_t *best)
{
    double width_m = high->x_m - low->x_m, height_m = high->y_m - low->y_m;
    double step_m = fmax(1.0, sqrt(width_m * height_m / MOST_PLACES));
    for (int i = 0; i * step_m <= width_m; i++) {
        for (int j = 0; j * step_m <= height_m; j++) {
            double x_m = low->x_m + i * step_m, y_m = low->y_m + j * step_m;
            double error_db = error_at(suspect, x_m, y_m);
            if (error_db < best->error_db) {
                best->error_db = error_db;
                best->x_m = x_m;
                best->y_m = y_m;
            }
        }
    }
}

path_elsewhere_t path_model_elsewhere(const path_model_t *model, const path_readings_t *path,
                                      size_t ap)
{
    static suspect_t suspect;
    memset(&suspect, 0, sizeof suspect);
    suspect.model = model;
    suspect.path = path;
    suspect.ap = path->site.ap_file.aps[ap];
    gather(&suspect, ap);
    path_place_t low = path->places[0], high = low;
    for (size_t i = 0u; i < path->count; i++) {
        low.x_m = fmin(low.x_m, path->places[i].x_m);
        low.y_m = fmin(low.y_m, path->places[i].y_m);
        high.x_m = fmax(high.x_m, path->places[i].x_m);
        high.y_m = fmax(high.y_m, path->places[i].y_m);
    }
    const path_place_t from = {low.x_m - margin_m, low.y_m - margin_m};
    const path_place_t to = {high.x_m + margin_m, high.y_m + margin_m};
    double told_db = error_at(&suspect, (double)suspect.ap.x_m, (double)suspect.ap.y_m);
    path_elsewhere_t best = {false, (double)suspect.ap.x_m, (double)suspect.ap.y_m, told_db,
                             told_db};
    search(&suspect, &from, &to, &best);
    best.is_better = best.error_db < better_share * told_db;
    return best;
}
