/* SPDX-License-Identifier: MIT */
#include "step_fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "arrow.h"
#include "memory.h"
#include "number.h"

enum { FEWEST_SESSIONS = 5, SEGMENTS_PER_COEFFICIENT = 4 };

/* As good as nothing is known before. */
static const double prior_sigma = 1e3;

/* Standard error, as a share of what the setting can be, of what has not been told. */
static const double open_share = 0.25;

/* A segment scatters at least so much for the root of a metre, however well it happens to fit:
 * coefficients that the walks do not tell apart come out at once with it [m^(1/2)]. */
static const double least_scatter = 0.05;

#define ROW(kind, key, value, low, high, unit, text) {#key, low, high},
static const struct {
    const char *key;
    double low, high;
} ranges[] = {INSOLE_STEP_LENGTH_KEYS(ROW)};

const step_model_t step_models[INSOLE_STEP_LENGTH_CONSTANT + 1] = {
    {"root", 1, {STEP_ROOT}, {"root_scale"}},
    {"linear",
     3,
     {STEP_HZ, STEP_VARIANCE, STEP_ONE},
     {"linear_alpha", "linear_beta", "linear_gamma"}},
    {"mixed", 3, {STEP_ONE, STEP_HZ, STEP_SQUARE_ROOT}, {"mixed_a", "mixed_b", "mixed_c"}},
    {"constant", 1, {STEP_ONE}, {"constant_m"}}};

double step_fit_length(const step_fit_t *fit, const step_model_t *model,
                       const step_segment_t *segment)
{
    double length_m = 0.0;
    for (int k = 0; k < model->count; k++) {
        length_m += fit->value[k] * segment->sum[model->feature[k]];
    }
    return length_m;
}

static bool is_by_session(const step_walks_t *walks)
{
    return walks->sessions >= FEWEST_SESSIONS;
}

static void add_segments(arrow_t *arrow, const step_model_t *model, const step_walks_t *walks)
{
    const double own[ARROW_OWN] = {0.0, 0.0};
    for (size_t i = 0u; i < walks->count; i++) {
        const step_segment_t *segment = &walks->segments[i];
        double common[ARROW_COMMON] = {0.0};
        for (int k = 0; k < model->count; k++) {
            common[k] = segment->sum[model->feature[k]];
        }
        arrow_add(arrow, is_by_session(walks) ? segment->session : i, common, own,
                  segment->distance_m, 1.0 / fmax(segment->distance_m, 1.0));
    }
}

/* Unknowns that the model does not have, and those of groups, are known to be 0. */
static void set_priors(arrow_t *arrow, int count)
{
    for (int k = 0; k < ARROW_COMMON; k++) {
        arrow_prior(arrow, k, 0.0, k < count ? prior_sigma : 1.0);
    }
    for (size_t g = 0u; g < arrow->count; g++) {
        for (int k = 0; k < ARROW_OWN; k++) {
            arrow_group_prior(arrow, g, k, 1.0);
        }
    }
}

static bool is_setting(const char *key, double value, double error)
{
    for (size_t i = 0u; i < sizeof ranges / sizeof ranges[0]; i++) {
        if (strcmp(ranges[i].key, key) == 0) {
            return value >= ranges[i].low && value <= ranges[i].high &&
                   !(error > open_share * (ranges[i].high - ranges[i].low));
        }
    }
    return false;
}

/* Takes a coefficient from the solution. @return whether the walks tell it */
static bool take(step_fit_t *fit, const step_model_t *model, const arrow_t *arrow, int k)
{
    double least_error = least_scatter * sqrt(arrow->P[k][k]);
    fit->value[k] = arrow->x[k];
    fit->error[k] = arrow->count > 1u ? sqrt(arrow->variance[k]) : NUMBER_UNKNOWN;
    return is_setting(model->key[k], fit->value[k], fmax(fit->error[k], least_error));
}

static bool solve(step_fit_t *fit, const step_model_t *model, const step_walks_t *walks)
{
    arrow_t arrow;
    arrow_begin(&arrow, is_by_session(walks) ? walks->sessions : walks->count);
    set_priors(&arrow, model->count);
    add_segments(&arrow, model, walks);
    bool is_solved = arrow_solve(&arrow);
    for (int k = 0; k < model->count && is_solved; k++) {
        is_solved = take(fit, model, &arrow, k);
    }
    arrow_free(&arrow);
    return is_solved;
}

static void measure(step_fit_t *fit, const step_model_t *model, const step_walks_t *walks)
{
    double *off_m = memory_new(walks->sessions, sizeof *off_m);
    double *way_m = memory_new(walks->sessions, sizeof *way_m);
    double squares = 0.0, shares = 0.0;
    size_t known = 0u;
    for (size_t i = 0u; i < walks->count; i++) {
        const step_segment_t *segment = &walks->segments[i];
        double error_m = step_fit_length(fit, model, segment) - segment->distance_m;
        squares += error_m * error_m;
        off_m[segment->session] += error_m;
        way_m[segment->session] += segment->distance_m;
    }
    for (size_t i = 0u; i < walks->sessions; i++) {
        shares += way_m[i] > 0.0 ? fabs(off_m[i]) / way_m[i] : 0.0;
        known += way_m[i] > 0.0 ? 1u : 0u;
    }
    fit->segment_m = sqrt(squares / (double)walks->count);
    fit->session_share = shares / (double)known;
    free(off_m);
    free(way_m);
}

void step_fit(step_fit_t *fit, const step_model_t *model, const step_walks_t *walks)
{
    memset(fit, 0, sizeof *fit);
    size_t fewest =
        model->count > 1 ? (size_t)model->count * SEGMENTS_PER_COEFFICIENT : (size_t)model->count;
    fit->is_told = walks->count >= fewest && solve(fit, model, walks);
    if (fit->is_told) {
        measure(fit, model, walks);
    }
}
