/* SPDX-License-Identifier: MIT */
#include "path_fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "arrow.h"
#include "memory.h"
#include "normal_tail.h"

enum { ITERATIONS = 40, SCALE_ITERATIONS = 20 };

static const double done = 1e-3; /* change of a value, in standard errors: no more to come */

/* What is known before anything was heard: hardly more than the order of magnitude. */
static const double known_sigma[PATH_UNKNOWNS] = {20.0, 1.5, 1.0, 10.0, 10.0};
static const double fixed_sigma = 1e-4;

/* Deviations of access points begin with these spreads, and keep them as if this many access
 * points more had shown them. */
static const double usual_spread[PATH_OWN] = {2.5, 0.15};
static const double usual_aps = 2.0;

static const double smallest_sigma_db = 0.1;

/* Sums over the readings of one square. */
typedef struct {
    size_t all, heard;
    double sum_db, squares_db2;
} square_t;

/* What a reading asks of the model. */
typedef struct {
    double value, weight;
} pull_t;

void path_fit_begin(path_fit_t *fit, const path_survey_t *survey)
{
    memset(fit, 0, sizeof *fit);
    fit->survey = *survey;
    fit->most_db = 1000.0;
    fit->sigma_db = fit->rms_db = fit->common_sigma_db = 8.0;
    fit->alike = 0.5;
    fit->lost_share = 0.05;
    fit->aps = memory_new(survey->ap_count, sizeof *fit->aps);
    fit->weight = memory_new(survey->count, sizeof *fit->weight);
    fit->expected_dbm = memory_new(survey->count, sizeof *fit->expected_dbm);
    memcpy(fit->value, survey->start, sizeof fit->value);
    memcpy(fit->spread, usual_spread, sizeof fit->spread);
    for (size_t a = 0u; a < survey->ap_count; a++) {
        memcpy(fit->aps[a].own, survey->start, sizeof fit->aps[a].own);
    }
    for (size_t i = 0u; i < survey->count; i++) {
        fit->aps[survey->readings[i].ap].heard += isnan(survey->readings[i].dbm) ? 0u : 1u;
    }
}

static double wall_db(const path_fit_t *fit, const path_reading_t *reading)
{
    return fit->value[PATH_TOLD] * reading->told_db + fit->value[PATH_WALL] * reading->walls;
}

double path_fit_expect(const path_fit_t *fit, const path_reading_t *reading, bool is_own)
{
    const double *own = is_own ? fit->aps[reading->ap].own : fit->value;
    return own[PATH_P0] - own[PATH_EXPONENT] * reading->log_m -
           fmin(wall_db(fit, reading), fit->most_db) - fit->value[PATH_BODY] * reading->body_share -
           fit->survey.multipath_db; /* [TwoOrder (10)] */
}

static void expect_all(path_fit_t *fit)
{
    for (size_t i = 0u; i < fit->survey.count; i++) {
        fit->expected_dbm[i] = path_fit_expect(fit, &fit->survey.readings[i], true);
    }
}

/* Not-a-number for a reading that is missing. */
static double residual_of(const path_fit_t *fit, size_t i)
{
    return fit->survey.readings[i].dbm - fit->expected_dbm[i];
}

/* Weight of a residual under Student's distribution. */
static double tail_weight(const path_fit_t *fit, double residual_db, double sigma_db)
{
    double u = residual_db / sigma_db, dof = fit->survey.tail_dof;
    return (dof + 1.0) / (dof + u * u);
}

/* ---- a reading that is missing ---------------------------------------------------------- */

/* How many sigmas the floor is above what is expected. */
static double floor_sigmas(const path_fit_t *fit, size_t i)
{
    return (fit->survey.floor_dbm - fit->expected_dbm[i]) / fit->rms_db;
}

/* Chance that the floor is why it is missing, and not bad luck. */
static double chance_of_floor(const path_fit_t *fit, double z)
{
    double by_floor = (1.0 - fit->lost_share) * normal_below(z);
    return by_floor / (by_floor + fit->lost_share);
}

/* What lies so far below the floor that it counts less than this tells nothing by being missing. */
static const double least_weight = 1e-6;

/* Newton's step for the chance to be below the floor, as a reading: where it should have been, and
 * how much it counts. */
static pull_t pull_of_missing(const path_fit_t *fit, size_t i)
{
    double z = floor_sigmas(fit, i), h = normal_hazard(z), bend = fmax(0.0, h * (h + z));
    pull_t pull = {0.0, chance_of_floor(fit, z) * bend / (fit->rms_db * fit->rms_db)};
    pull.value = bend > 1e-9 ? -fit->rms_db / (h + z) : 0.0;
    return pull;
}

/* ---- what the residuals tell ------------------------------------------------------------ */

static void weigh_squares(path_fit_t *fit, const square_t *squares)
{
    for (size_t i = 0u; i < fit->survey.count; i++) {
        double all = (double)squares[fit->survey.readings[i].square].all;
        fit->weight[i] = 1.0 / (1.0 + (all - 1.0) * fit->alike);
    }
}

static square_t *count_squares(const path_survey_t *survey)
{
    square_t *squares = memory_new(survey->square_count, sizeof *squares);
    for (size_t i = 0u; i < survey->count; i++) {
        squares[survey->readings[i].square].all++;
    }
    return squares;
}

/* Analysis of variance: what is left within the squares, of all. Residuals are drawn in as their
 * weights are. */
static double share_alike(const path_fit_t *fit, square_t *squares)
{
    double within = 0.0, all = 0.0, degrees = 0.0, heard = 0.0;
    for (size_t s = 0u; s < fit->survey.square_count; s++) {
        squares[s].heard = 0u;
        squares[s].sum_db = squares[s].squares_db2 = 0.0;
    }
    for (size_t i = 0u; i < fit->survey.count; i++) {
        const path_reading_t *reading = &fit->survey.readings[i];
        if (!isnan(reading->dbm)) {
            double residual = residual_of(fit, i);
            double drawn = residual * sqrt(tail_weight(fit, residual, fit->sigma_db));
            square_t *square = &squares[reading->square];
            square->heard++;
            square->sum_db += drawn;
            square->squares_db2 += drawn * drawn;
        }
    }
    for (size_t s = 0u; s < fit->survey.square_count; s++) {
        double n = (double)squares[s].heard;
        all += squares[s].squares_db2;
        heard += n;
        within +=
            n > 1.0 ? squares[s].squares_db2 - squares[s].sum_db * squares[s].sum_db / n : 0.0;
        degrees += n > 1.0 ? n - 1.0 : 0.0;
    }
    if (degrees < 1.0 || !(all > 0.0)) {
        return fit->alike;
    }
    return fmax(0.0, fmin(1.0 - within / degrees / (all / heard), 0.99));
}

/* One step of the most likely scale. */
static double next_scale(const path_fit_t *fit, double sigma_db, bool is_own)
{
    double sum = 0.0, heard = 0.0;
    for (size_t i = 0u; i < fit->survey.count; i++) {
        const path_reading_t *reading = &fit->survey.readings[i];
        if (!isnan(reading->dbm)) {
            double residual =
                is_own ? residual_of(fit, i) : reading->dbm - path_fit_expect(fit, reading, false);
            sum += tail_weight(fit, residual, sigma_db) * residual * residual;
            heard += 1.0;
        }
    }
    return fmax(sqrt(sum / fmax(heard, 1.0)), smallest_sigma_db);
}

/* Root mean square, residuals of more than three sigmas drawn in. */
static double drawn_rms(const path_fit_t *fit)
{
    double sum = 0.0, heard = 0.0;
    for (size_t i = 0u; i < fit->survey.count; i++) {
        const path_reading_t *reading = &fit->survey.readings[i];
        if (!isnan(reading->dbm)) {
            double drawn = fmin(fabs(residual_of(fit, i)), 4.0 * fit->sigma_db);
            sum += drawn * drawn;
            heard += 1.0;
        }
    }
    return fmax(sqrt(sum / fmax(heard, 1.0)), smallest_sigma_db);
}

static double share_lost(const path_fit_t *fit)
{
    double lost = 1.0, due = 20.0; /* one of twenty before anything was heard */
    for (size_t i = 0u; i < fit->survey.count; i++) {
        const path_reading_t *reading = &fit->survey.readings[i];
        double z = floor_sigmas(fit, i), luck = 1.0 - chance_of_floor(fit, z);
        bool is_missing = isnan(reading->dbm);
        lost += is_missing ? luck : 0.0;
        due += is_missing ? luck : 1.0;
    }
    return lost / due;
}

static void learn_noise(path_fit_t *fit, square_t *squares)
{
    fit->sigma_db = next_scale(fit, fit->sigma_db, true);
    fit->rms_db = drawn_rms(fit);
    if (!fit->keeps_weights) {
        fit->alike = share_alike(fit, squares);
        fit->lost_share = share_lost(fit);
    }
    weigh_squares(fit, squares);
}

/* ---- one iteration ---------------------------------------------------------------------- */

static void add_reading(const path_fit_t *fit, arrow_t *arrow, size_t i)
{
    const path_reading_t *reading = &fit->survey.readings[i];
    bool is_least = wall_db(fit, reading) <= fit->most_db;
    const double common[ARROW_COMMON] = {1.0, -reading->log_m, is_least ? -reading->told_db : 0.0,
                                         is_least ? -reading->walls : 0.0, -reading->body_share};
    pull_t pull;
    if (isnan(reading->dbm)) {
        pull = pull_of_missing(fit, i);
    } else {
        pull.value = residual_of(fit, i);
        pull.weight = tail_weight(fit, pull.value, fit->sigma_db) / (fit->sigma_db * fit->sigma_db);
    }
    if (pull.weight < least_weight) {
        return;
    }
    pull.value += fit->expected_dbm[i] + fit->survey.multipath_db + (is_least ? 0.0 : fit->most_db);
    arrow_add(arrow, reading->ap, common, common, pull.value, fit->weight[i] * pull.weight);
}

static void add_known(const path_fit_t *fit, arrow_t *arrow)
{
    for (int k = 0; k < PATH_UNKNOWNS; k++) {
        arrow_prior(arrow, k, fit->is_fixed[k] ? fit->value[k] : fit->survey.start[k],
                    fit->is_fixed[k] ? fixed_sigma : known_sigma[k]);
    }
    for (size_t a = 0u; a < fit->survey.ap_count; a++) {
        for (int k = 0; k < PATH_OWN; k++) {
            arrow_group_prior(arrow, a, k, fit->is_fixed[k] ? fixed_sigma : fit->spread[k]);
        }
    }
}

/* Least squares count a reading's variance as its weight tells; under another distribution than
 * weights come from, estimates scatter by this much more (its root), [Huber]. */
static double scatter_factor(const path_fit_t *fit)
{
    double dof = fit->survey.tail_dof, squared = 0.0, slope = 0.0, weight = 0.0, all = 0.0;
    for (size_t i = 0u; i < fit->survey.count; i++) {
        if (!isnan(fit->survey.readings[i].dbm)) {
            double u = residual_of(fit, i) / fit->sigma_db;
            double w = (dof + 1.0) / (dof + u * u), g = fit->weight[i];
            squared += g * w * w * u * u;
            slope += g * w * (dof - u * u) / (dof + u * u);
            weight += g * w;
            all += g;
        }
    }
    return all > 0.0 && slope > 0.1 * all ? squared * weight / (slope * slope) : 1.0;
}

/* How much values differ from access point to access point, given how well each is known. */
static void learn_spread(path_fit_t *fit, const arrow_t *arrow)
{
    for (int k = 0; k < PATH_OWN; k++) {
        double sum = usual_aps * usual_spread[k] * usual_spread[k], aps = usual_aps;
        for (size_t a = 0u; a < fit->survey.ap_count; a++) {
            const arrow_group_t *group = &arrow->groups[a];
            bool counts = fit->aps[a].heard > 0u;
            sum += counts ? group->x[k] * group->x[k] + group->variance[k] : 0.0;
            aps += counts ? 1.0 : 0.0;
        }
        fit->spread[k] = fit->is_fixed[k] ? fit->spread[k] : sqrt(sum / aps);
    }
}

/* Takes over the solution. @return the largest change of a common value in standard errors */
static double take(path_fit_t *fit, const arrow_t *arrow)
{
    double change = 0.0, factor = scatter_factor(fit);
    for (int k = 0; k < PATH_UNKNOWNS; k++) {
        double error = sqrt(arrow->P[k][k]);
        change = fmax(change, fabs(arrow->x[k] - fit->value[k]) / error);
        fit->value[k] = arrow->x[k];
        fit->error[k] = sqrt(fmax(arrow->P[k][k] * factor, arrow->variance[k]));
    }
    fit->value[PATH_TOLD] = fmax(0.0, fit->value[PATH_TOLD]);
    fit->value[PATH_WALL] = fmax(0.0, fit->value[PATH_WALL]);
    for (size_t a = 0u; a < fit->survey.ap_count; a++) {
        for (int k = 0; k < PATH_OWN; k++) {
            fit->aps[a].own[k] = fit->value[k] + arrow->groups[a].x[k];
            fit->aps[a].error[k] = sqrt(fmax(0.0, arrow->groups[a].sum_variance[k]) * factor);
        }
    }
    return change;
}

static double iterate(path_fit_t *fit, square_t *squares)
{
    arrow_t arrow;
    double change = 0.0;
    expect_all(fit);
    learn_noise(fit, squares);
    arrow_begin(&arrow, fit->survey.ap_count);
    add_known(fit, &arrow);
    for (size_t i = 0u; i < fit->survey.count; i++) {
        add_reading(fit, &arrow, i);
    }
    if (arrow_solve(&arrow)) {
        change = take(fit, &arrow);
        learn_spread(fit, &arrow);
    }
    arrow_free(&arrow);
    return change;
}

/* ---- in the end ------------------------------------------------------------------------- */

static double log_likelihood(const path_fit_t *fit)
{
    double sum = 0.0, dof = fit->survey.tail_dof;
    for (size_t i = 0u; i < fit->survey.count; i++) {
        const path_reading_t *reading = &fit->survey.readings[i];
        double u = residual_of(fit, i) / fit->sigma_db;
        double below = normal_below(floor_sigmas(fit, i));
        sum += fit->weight[i] *
               (isnan(reading->dbm)
                    ? log(fit->lost_share + (1.0 - fit->lost_share) * below)
                    : -log(fit->sigma_db) - 0.5 * (dof + 1.0) * log(1.0 + u * u / dof));
    }
    return sum;
}

static void describe_aps(path_fit_t *fit)
{
    for (size_t a = 0u; a < fit->survey.ap_count; a++) {
        fit->aps[a].mean_db = fit->aps[a].sigma_db = 0.0;
    }
    for (size_t i = 0u; i < fit->survey.count; i++) {
        const path_reading_t *reading = &fit->survey.readings[i];
        path_ap_t *ap = &fit->aps[reading->ap];
        double residual = isnan(reading->dbm) ? 0.0 : residual_of(fit, i);
        ap->mean_db += residual;
        ap->sigma_db += residual * residual;
    }
    for (size_t a = 0u; a < fit->survey.ap_count; a++) {
        path_ap_t *ap = &fit->aps[a];
        double heard = fmax(1.0, (double)ap->heard);
        ap->mean_db /= heard;
        ap->sigma_db = sqrt(fmax(0.0, ap->sigma_db / heard - ap->mean_db * ap->mean_db));
    }
}

void path_fit_run(path_fit_t *fit)
{
    square_t *squares = count_squares(&fit->survey);
    double change = 1.0;
    for (int i = 0; i < ITERATIONS && change > done; i++) {
        change = iterate(fit, squares);
    }
    expect_all(fit);
    learn_noise(fit, squares);
    for (int i = 0; i < SCALE_ITERATIONS; i++) {
        fit->sigma_db = next_scale(fit, fit->sigma_db, true);
        fit->common_sigma_db = next_scale(fit, fit->common_sigma_db, false);
    }
    fit->log_likelihood = log_likelihood(fit);
    describe_aps(fit);
    free(squares);
}

void path_fit_free(path_fit_t *fit)
{
    free(fit->aps);
    free(fit->weight);
    free(fit->expected_dbm);
    memset(fit, 0, sizeof *fit);
}
