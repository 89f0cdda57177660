/* SPDX-License-Identifier: MIT */
#include "insole/place/rss_fix.h"

#include <stddef.h>

#include "insole/base/fastmath.h"

#define ZERO         INSOLE_R(0.0)
#define HALF         INSOLE_R(0.5)
#define ONE          INSOLE_R(1.0)
#define DB_PER_NEPER INSOLE_R(4.3429448190325183) /* 10 lg x = 4.34 ln x */

const insole_rss_fix_config_t insole_rss_fix_defaults = {
    INSOLE_RSS_FIX_KEYS(INSOLE_CONFIG_DEFAULT)};

insole_status_t insole_rss_fix_check(const insole_rss_fix_config_t *config)
{
    typedef insole_rss_fix_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_RSS_FIX_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

typedef struct {
    const insole_rss_fix_config_t *config;
    const insole_propagation_config_t *propagation;
    const insole_ap_t *aps;
    uint32_t ap_count;
    const insole_rss_t *readings;
    uint32_t count;
    uint32_t used;
    insole_real_t strongest_dbm;
    insole_real_t x_m, y_m; /* local origin, so that far coordinates lose nothing */
} problem_t;

/* The access point of a reading; NULL when the reading does not pass the gates. */
static const insole_ap_t *ap_of(const problem_t *problem, uint32_t i)
{
    const insole_rss_t *reading = &problem->readings[i];
    bool passes = reading->id < problem->ap_count && insole_is_finite(reading->rss_dbm) &&
                  reading->rss_dbm >= problem->config->rss_min_dbm;
    return passes ? &problem->aps[reading->id] : NULL;
}

/* Counts what passes the gates, finds the strongest and puts the origin at it. */
static insole_status_t screen(problem_t *problem)
{
    problem->used = 0;
    problem->strongest_dbm = -INSOLE_REAL_MAX;
    for (uint32_t i = 0; i < problem->count; i++) {
        const insole_ap_t *ap = ap_of(problem, i);
        if (!ap) {
            continue;
        }
        if (!insole_ap_has_place(ap) || !insole_ap_has_model(ap)) {
            return INSOLE_ERR_VALUE;
        }
        problem->used++;
        if (problem->readings[i].rss_dbm > problem->strongest_dbm) {
            problem->strongest_dbm = problem->readings[i].rss_dbm;
            problem->x_m = ap->x_m;
            problem->y_m = ap->y_m;
        }
    }
    return problem->used > 0u ? INSOLE_OK : INSOLE_ERR_STATE;
}

static insole_status_t open_problem(problem_t *problem, const insole_anchor_fix_t *fix)
{
    if (!problem->config || !problem->propagation || !problem->aps || !problem->readings || !fix) {
        return INSOLE_ERR_NULL;
    }
    return screen(problem);
}

/* 1 / m^2: the nearer an access point sounds, the more. */
static insole_real_t nearness(const problem_t *problem, uint32_t i, const insole_ap_t *ap)
{
    insole_rss_range_t range = {ONE, ONE};
    insole_propagation_range(problem->propagation, ap, problem->readings[i].rss_dbm, ZERO, HALF,
                             &range);
    return ONE / insole_square(insole_max(ONE, range.range_m));
}

/* The weighted centroid of the access points; of few, it is no better known than their ranges. */
static insole_known_t centroid(const problem_t *problem)
{
    const insole_rss_fix_config_t *config = problem->config;
    insole_vec3_t sum = insole_vec3_zero();
    insole_real_t weight = ZERO, near = ZERO;
    for (uint32_t i = 0; i < problem->count; i++) {
        const insole_ap_t *ap = ap_of(problem, i);
        if (ap) {
            insole_real_t below_db = problem->strongest_dbm - problem->readings[i].rss_dbm;
            insole_real_t w = insole_exp(-config->centroid_power * below_db / DB_PER_NEPER);
            insole_vec3_t place = insole_vec3(ap->x_m - problem->x_m, ap->y_m - problem->y_m, ZERO);
            sum = insole_vec3_add_scaled(sum, w, place);
            weight += w;
            near += nearness(problem, i, ap);
        }
    }
    insole_real_t variance_m2 =
        insole_square(config->centroid_sigma_m) + ONE / ((insole_real_t)problem->used * near);
    insole_known_t known = {insole_vec3_scale(sum, ONE / weight),
                            insole_sym3_diagonal(ONE / variance_m2, ONE / variance_m2,
                                                 ONE / insole_square(config->gain_sigma_db))};
    return known;
}

static insole_robust_reading_t linearise(const problem_t *problem, uint32_t i, insole_vec3_t x)
{
    const insole_ap_t *ap = &problem->aps[problem->readings[i].id];
    insole_ap_t near = *ap; /* relative to the origin */
    near.x_m -= problem->x_m;
    near.y_m -= problem->y_m;
    insole_expected_rss_t expected = {ONE, ZERO};
    insole_propagation_expect(problem->propagation, &near, x.x, x.y, ZERO, HALF, &expected);
    insole_real_t slope = ZERO;
    if (expected.distance_m > problem->propagation->distance_min_m) {
        slope = -DB_PER_NEPER * ap->exponent / insole_square(expected.distance_m);
    }
    insole_robust_reading_t reading;
    reading.J = insole_vec3(slope * (x.x - near.x_m), slope * (x.y - near.y_m), ONE);
    reading.residual = problem->readings[i].rss_dbm - expected.rss_dbm - x.z;
    reading.sigma = problem->config->sigma_db;
    reading.tail = problem->config->tail;
    reading.bend = ZERO;
    return reading;
}

static bool iterate(const problem_t *problem, const insole_known_t *known, insole_vec3_t *x,
                    insole_sym3_t *P)
{
    insole_vec3_t step = insole_vec3_zero();
    *x = known->mean;
    for (int32_t k = 0; k < problem->config->iterations; k++) {
        insole_robust_fit_t fit = insole_robust_fit_begin(known, *x);
        for (uint32_t i = 0; i < problem->count; i++) {
            if (ap_of(problem, i)) {
                insole_robust_reading_t reading = linearise(problem, i, *x);
                insole_robust_fit_add(&fit, &reading, ONE);
            }
        }
        if (!insole_robust_fit_step(&fit, &step, P)) {
            return false;
        }
        *x = insole_vec3_add(*x, step);
        if (insole_vec3_max_abs(step) < INSOLE_ROBUST_FIT_DONE_M) {
            break;
        }
    }
    return insole_vec3_is_finite(*x);
}

static insole_anchor_fix_t fix_at(const problem_t *problem, insole_vec3_t x, insole_sym3_t P)
{
    insole_anchor_fix_t fix = {problem->x_m + x.x, problem->y_m + x.y, x.z, P, problem->used};
    return fix;
}

INSOLE_COLD insole_status_t insole_rss_fix_solve(const insole_rss_fix_config_t *config,
                                                 const insole_propagation_config_t *propagation,
                                                 const insole_ap_t *aps, uint32_t ap_count,
                                                 const insole_rss_t *readings, uint32_t count,
                                                 insole_anchor_fix_t *fix)
{
    problem_t problem = {config, propagation, aps, ap_count, readings, count, 0u, ZERO, ZERO, ZERO};
    insole_status_t status = open_problem(&problem, fix);
    if (status != INSOLE_OK) {
        return status;
    }
    insole_known_t known = centroid(&problem);
    insole_vec3_t x;
    insole_sym3_t P;
    if (!iterate(&problem, &known, &x, &P)) {
        return INSOLE_ERR_VALUE;
    }
    *fix = fix_at(&problem, x, P);
    return INSOLE_OK;
}

insole_status_t insole_rss_fix_centroid(const insole_rss_fix_config_t *config,
                                        const insole_propagation_config_t *propagation,
                                        const insole_ap_t *aps, uint32_t ap_count,
                                        const insole_rss_t *readings, uint32_t count,
                                        insole_anchor_fix_t *fix)
{
    problem_t problem = {config, propagation, aps, ap_count, readings, count, 0u, ZERO, ZERO, ZERO};
    insole_status_t status = open_problem(&problem, fix);
    if (status != INSOLE_OK) {
        return status;
    }
    insole_known_t known = centroid(&problem);
    insole_sym3_t P;
    if (!insole_sym3_inverse(known.information, &P) || !insole_vec3_is_finite(known.mean)) {
        return INSOLE_ERR_VALUE;
    }
    *fix = fix_at(&problem, known.mean, P);
    return INSOLE_OK;
}
