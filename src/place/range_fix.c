/* SPDX-License-Identifier: MIT */
#include "insole/place/range_fix.h"

#include <stddef.h>

#define ZERO     INSOLE_R(0.0)
#define HALF     INSOLE_R(0.5)
#define ONE      INSOLE_R(1.0)
#define NEAR2_M2 INSOLE_R(0.04) /* blunts the tip of the cone of ranges */
#define FADED    INSOLE_R(1e8)  /* a variance that says nothing */

const insole_range_fix_config_t insole_range_fix_defaults = {
    INSOLE_RANGE_FIX_KEYS(INSOLE_CONFIG_DEFAULT)};

insole_status_t insole_range_fix_check(const insole_range_fix_config_t *config)
{
    typedef insole_range_fix_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_RANGE_FIX_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

typedef struct {
    const insole_range_fix_config_t *config;
    const insole_ap_t *aps;
    uint32_t ap_count;
    const insole_range_t *ranges;
    uint32_t count;
    insole_real_t x_m, y_m; /* local origin, so that far coordinates lose nothing */
} problem_t;

/* The anchor of a range; NULL when the range does not pass the gates. */
static const insole_ap_t *anchor_of(const problem_t *problem, uint32_t i)
{
    const insole_range_fix_config_t *config = problem->config;
    const insole_range_t *range = &problem->ranges[i];
    bool passes = range->id < problem->ap_count && range->range_m >= ZERO &&
                  range->range_m <= config->range_max_m && !(range->sigma_m > config->told_max_m);
    return passes ? &problem->aps[range->id] : NULL;
}

/* Counts what passes the gates and puts the origin at the first anchor that does. */
static insole_status_t screen(problem_t *problem, uint32_t *used)
{
    *used = 0;
    for (uint32_t i = 0; i < problem->count; i++) {
        const insole_ap_t *anchor = anchor_of(problem, i);
        if (!anchor) {
            continue;
        }
        if (!insole_ap_has_place(anchor)) {
            return INSOLE_ERR_VALUE;
        }
        if ((*used)++ == 0u) {
            problem->x_m = anchor->x_m;
            problem->y_m = anchor->y_m;
        }
    }
    return *used > 0u ? INSOLE_OK : INSOLE_ERR_STATE;
}

/* The centroid of the anchors, weighted by the inverse squares of the ranges and spread as wide as
 * they are. */
static insole_known_t guess(const problem_t *problem, uint32_t used)
{
    insole_vec3_t sum = insole_vec3_zero();
    insole_real_t weight = ZERO;
    for (uint32_t i = 0; i < problem->count; i++) {
        const insole_ap_t *anchor = anchor_of(problem, i);
        if (anchor) {
            insole_vec3_t place =
                insole_vec3(anchor->x_m - problem->x_m, anchor->y_m - problem->y_m, ZERO);
            insole_real_t w = ONE / insole_square(insole_max(ONE, problem->ranges[i].range_m));
            sum = insole_vec3_add_scaled(sum, w, place);
            weight += w;
        }
    }
    insole_real_t share = ONE / weight, information = weight / (insole_real_t)used;
    insole_known_t known = {
        insole_vec3(share * sum.x, share * sum.y, problem->config->bias_m),
        insole_sym3_diagonal(information, information,
                             ONE / insole_square(problem->config->bias_sigma_m))};
    return known;
}

static bool recall(const problem_t *problem, const insole_anchor_fix_t *before,
                   insole_known_t *known)
{
    insole_vec3_t mean =
        insole_vec3(before->x_m - problem->x_m, before->y_m - problem->y_m, before->common);
    return insole_robust_fit_recall(known, mean, before->P);
}

static insole_robust_reading_t linearise(const problem_t *problem, uint32_t i, insole_vec3_t x)
{
    const insole_range_fix_config_t *config = problem->config;
    const insole_range_t *range = &problem->ranges[i];
    const insole_ap_t *anchor = &problem->aps[range->id];
    insole_vec3_t way =
        insole_vec3(problem->x_m - anchor->x_m + x.x, problem->y_m - anchor->y_m + x.y,
                    config->height_m - anchor->z_m);
    insole_real_t d = insole_sqrt(insole_vec3_norm2(way) + NEAR2_M2);
    insole_real_t told_m = range->sigma_m > ZERO ? range->sigma_m : ZERO;
    insole_robust_reading_t reading;
    reading.J = insole_vec3(way.x / d, way.y / d, ONE);
    reading.residual = range->range_m - d - x.z;
    reading.sigma = insole_sqrt(insole_square(config->sigma_m) + insole_square(told_m));
    reading.tail = reading.residual > ZERO ? config->tail_long : config->tail_short;
    reading.bend = ONE / d;
    return reading;
}

static bool iterate(const problem_t *problem, const insole_known_t *known, insole_vec3_t *x,
                    insole_sym3_t *P)
{
    int32_t iterations = problem->config->iterations;
    insole_vec3_t step = insole_vec3_zero();
    *x = known->mean;
    for (int32_t k = 0; k < iterations; k++) {
        insole_real_t loosen = insole_robust_fit_loosening(problem->config->loosen, k, iterations);
        insole_robust_fit_t fit = insole_robust_fit_begin(known, *x);
        for (uint32_t i = 0; i < problem->count; i++) {
            if (anchor_of(problem, i)) {
                insole_robust_reading_t reading = linearise(problem, i, *x);
                insole_robust_fit_add(&fit, &reading, loosen);
            }
        }
        if (!insole_robust_fit_step(&fit, &step, P)) {
            return false;
        }
        *x = insole_vec3_add(*x, step);
        if (loosen <= ONE && insole_vec3_max_abs(step) < INSOLE_ROBUST_FIT_DONE_M) {
            break;
        }
    }
    return insole_vec3_is_finite(*x);
}

INSOLE_COLD insole_status_t insole_range_fix_solve(const insole_range_fix_config_t *config,
                                                   const insole_ap_t *aps, uint32_t ap_count,
                                                   const insole_range_t *ranges, uint32_t count,
                                                   const insole_anchor_fix_t *before,
                                                   insole_anchor_fix_t *fix)
{
    if (!config || !aps || !ranges || !fix) {
        return INSOLE_ERR_NULL;
    }
    problem_t problem = {config, aps, ap_count, ranges, count, ZERO, ZERO};
    uint32_t used;
    insole_status_t status = screen(&problem, &used);
    if (status != INSOLE_OK) {
        return status;
    }
    insole_known_t known = guess(&problem, used);
    insole_vec3_t x;
    insole_sym3_t P;
    if ((before && !recall(&problem, before, &known)) || !iterate(&problem, &known, &x, &P)) {
        return INSOLE_ERR_VALUE;
    }
    insole_anchor_fix_t found = {problem.x_m + x.x, problem.y_m + x.y, x.z, P, used};
    *fix = found;
    return INSOLE_OK;
}

/* A variance grows, but not beyond what still can be inverted. */
static void fade(insole_real_t *variance, insole_real_t by)
{
    if (*variance < FADED) {
        *variance = insole_min(*variance + by, FADED);
    }
}

INSOLE_COLD insole_status_t insole_range_fix_age(const insole_range_fix_config_t *config,
                                                 insole_anchor_fix_t *fix, insole_real_t dt_s)
{
    if (!config || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (!(dt_s >= ZERO && insole_is_finite(dt_s))) {
        return INSOLE_ERR_VALUE;
    }
    insole_real_t walked_m2 = HALF * insole_square(config->walk_mps) * dt_s * insole_max(ONE, dt_s);
    fade(&fix->P.xx, walked_m2);
    fade(&fix->P.yy, walked_m2);
    fade(&fix->P.zz, insole_square(config->drift_m) * dt_s);
    return INSOLE_OK;
}
