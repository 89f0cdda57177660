/* SPDX-License-Identifier: MIT */
#include "insole/place/kde_fix.h"

#include <stddef.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)
#define TWO  INSOLE_R(2.0)

/* Only what is well above the weakest that a radio hears tells of the offset: near that limit a
 * reading is there only when it happens to be strong. Twice the mean of both sides, dBm. */
#define STRONG_SUM_DBM INSOLE_R(-150.0)

static const insole_real_t LEAST_MISFIT = INSOLE_R(0.1), MOST_MISFIT = INSOLE_R(100.0);

const insole_kde_fix_config_t insole_kde_fix_defaults = {
    INSOLE_KDE_FIX_KEYS(INSOLE_CONFIG_DEFAULT)};

/* The strength above the floor, as a share of the floor, to the power. */
static insole_real_t bend(const insole_kde_fix_config_t *config, uint32_t level)
{
    insole_real_t share = ONE - insole_radio_level_dbm(level) / config->floor_dbm;
    return share > ZERO ? insole_exp(config->power * insole_log(share)) : ZERO;
}

static insole_status_t check(const insole_kde_fix_config_t *config)
{
    typedef insole_kde_fix_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_KDE_FIX_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_kde_fix_init(insole_kde_fix_t *kde,
                                                const insole_kde_fix_config_t *config)
{
    if (!kde || !config) {
        return INSOLE_ERR_NULL;
    }
    if (check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    *kde = (insole_kde_fix_t){.config = *config};
    for (uint32_t level = 0; level < (uint32_t)INSOLE_RADIO_LEVELS; level++) {
        kde->bent[level] = bend(config, level);
    }
    return INSOLE_OK;
}

/* ---- the scan ---- */

static void take_offset_off(insole_kde_fix_t *kde)
{
    const insole_kde_fix_config_t *config = &kde->config;
    insole_heard_t *heard = &kde->search.heard;
    insole_real_t sum = ZERO;
    for (uint32_t i = 0; i < heard->count; i++) {
        heard->dbm[i] -= kde->offset_db;
        sum += kde->bent[insole_radio_level(heard->dbm[i])];
    }
    kde->heard_sum = config->kernel == INSOLE_KDE_FIX_GAUSS
                         ? insole_map_search_heard_db2(&kde->search, config->unheard_dbm)
                         : sum;
}

INSOLE_COLD insole_status_t insole_kde_fix_begin(insole_kde_fix_t *kde,
                                                 const insole_radio_map_t *map,
                                                 const insole_trusted_area_t *area,
                                                 const insole_rss_t *readings, uint32_t count)
{
    if (!kde) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_map_search_begin(
        &kde->search, map, area, kde->config.readings_min, kde->config.age_max_s, readings, count);
    if (status == INSOLE_OK) {
        take_offset_off(kde);
    }
    return status;
}

/* ---- the kernels: logarithm of the weight of a point ---- */

/* What scan and point have in common, as a share of what both have. */
static insole_real_t log_of_sorensen(const insole_kde_fix_t *kde, const insole_radio_map_t *map,
                                     uint32_t point)
{
    insole_real_t sum = kde->heard_sum, common = ZERO;
    uint32_t at = 0, end = map->first[point + 1u];
    for (uint32_t i = map->first[point]; i < end; i++) {
        insole_real_t mapped = kde->bent[map->below[i]];
        sum += mapped;
        if (insole_heard_seek(&kde->search.heard, &at, map->aps[i])) {
            common += insole_min(mapped, kde->bent[insole_radio_level(kde->search.heard.dbm[at])]);
        }
    }
    insole_real_t distance = sum > ZERO ? ONE - TWO * common / sum : ONE;
    return -distance / kde->config.width;
}

static insole_real_t log_of_gauss(const insole_kde_fix_t *kde, const insole_radio_map_t *map,
                                  uint32_t point)
{
    insole_real_t squares = insole_map_search_distance_db2(&kde->search, map, point,
                                                           kde->config.unheard_dbm, kde->heard_sum);
    return -HALF * squares /
           insole_square(kde->config.sigma_db); /* [PhoneEKF (24)] [PhoneUKF (34)] */
}

bool insole_kde_fix_work(insole_kde_fix_t *kde, const insole_radio_map_t *map, uint32_t points)
{
    if (!kde || !map) {
        return false;
    }
    uint32_t point;
    bool gauss = kde->config.kernel == INSOLE_KDE_FIX_GAUSS;
    while (insole_map_search_next(&kde->search, map, &points, &point)) {
        insole_real_t log_weight =
            gauss ? log_of_gauss(kde, map, point) : log_of_sorensen(kde, map, point);
        insole_map_search_add(&kde->search, map, point, log_weight);
    }
    return insole_map_search_has_more(&kde->search);
}

/* ---- the answer ---- */

/* Mean of what the scan reads stronger than the point that fits best. */
static bool strength_over(const insole_kde_fix_t *kde, const insole_radio_map_t *map,
                          insole_real_t *over_db)
{
    insole_real_t sum = ZERO, count = ZERO;
    uint32_t point = kde->search.mixture.likeliest, at = 0, end = map->first[point + 1u];
    for (uint32_t i = map->first[point]; i < end; i++) {
        insole_real_t mean_dbm = insole_radio_map_mean_dbm(map, i);
        if (insole_heard_seek(&kde->search.heard, &at, map->aps[i]) &&
            kde->search.heard.dbm[at] + mean_dbm > STRONG_SUM_DBM) {
            sum += kde->search.heard.dbm[at] - mean_dbm;
            count += ONE;
        }
    }
    *over_db = count > ZERO ? sum / count : ZERO;
    return count > ZERO;
}

static void learn_offset(insole_kde_fix_t *kde, const insole_radio_map_t *map)
{
    insole_real_t over_db;
    if (!strength_over(kde, map, &over_db)) {
        return;
    }
    kde->learned += kde->learned < UINT32_MAX ? 1u : 0u;
    insole_real_t weight = insole_max(kde->config.learn_weight, ONE / (insole_real_t)kde->learned);
    insole_real_t most_db = kde->config.offset_max_db;
    kde->offset_db = insole_max(-most_db, insole_min(kde->offset_db + weight * over_db, most_db));
}

/* Mean square difference to the point that fits best, in widths of the kernel. */
static insole_real_t misfit_of(const insole_kde_fix_t *kde)
{
    insole_real_t squares = -TWO * kde->search.mixture.log_top;
    insole_real_t mean = squares / (insole_real_t)kde->search.heard.count;
    return insole_min(insole_max(mean, LEAST_MISFIT), MOST_MISFIT);
}

static void tell_misfit(const insole_kde_fix_t *kde, insole_radio_fix_t *fix)
{
    const insole_kde_fix_config_t *c = &kde->config;
    if (c->misfit == INSOLE_KDE_FIX_MISFIT_TOLD && c->kernel == INSOLE_KDE_FIX_GAUSS) {
        insole_real_t factor = misfit_of(kde);
        fix->var_x_m2 *= factor;
        fix->cov_xy_m2 *= factor;
        fix->var_y_m2 *= factor;
    }
}

INSOLE_COLD insole_status_t insole_kde_fix_finish(insole_kde_fix_t *kde,
                                                  const insole_radio_map_t *map,
                                                  insole_radio_fix_t *fix)
{
    if (!kde || !fix) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_map_search_finish(&kde->search, map);
    if (status != INSOLE_OK) {
        return status;
    }
    /* weights over their sum, [PhoneEKF (25)] [PhoneUKF (35)]; mean and covariance: its moments */
    insole_spot_mixture_cov(&kde->search.mixture, kde->search.mixture.mean,
                            kde->config.point_sigma_m, kde->config.widen, fix);
    tell_misfit(kde, fix);
    fix->readings = kde->search.heard.count;
    if (kde->config.offset != 0) {
        learn_offset(kde, map);
    }
    return INSOLE_OK;
}

insole_status_t insole_kde_fix_solve(insole_kde_fix_t *kde, const insole_radio_map_t *map,
                                     const insole_trusted_area_t *area,
                                     const insole_rss_t *readings, uint32_t count,
                                     insole_radio_fix_t *fix)
{
    if (!fix) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_kde_fix_begin(kde, map, area, readings, count);
    if (status != INSOLE_OK) {
        return status;
    }
    insole_kde_fix_work(kde, map, UINT32_MAX);
    return insole_kde_fix_finish(kde, map, fix);
}

/* ---- the papers' width ---- */

/* Variance over all points of one access point's means. */
static insole_real_t variance_of_ap(const insole_radio_map_t *map, uint32_t ap,
                                    insole_real_t unheard_dbm)
{
    insole_real_t mean = ZERO, squares = ZERO;
    for (uint32_t point = 0; point < map->point_count; point++) {
        uint32_t entry;
        insole_real_t over_db = ZERO; /* above unheard */
        if (insole_radio_map_find(map, point, ap, &entry)) {
            over_db = insole_radio_map_mean_dbm(map, entry) - unheard_dbm;
        }
        insole_real_t off = over_db - mean;
        mean += off / (insole_real_t)(point + 1u);
        squares += off * (over_db - mean);
    }
    return squares / (insole_real_t)map->point_count;
}

insole_status_t insole_kde_fix_normal_reference(const insole_radio_map_t *map,
                                                insole_real_t unheard_dbm, insole_real_t *sigma_db)
{
    if (!map || !sigma_db) {
        return INSOLE_ERR_NULL;
    }
    if (!(unheard_dbm >= INSOLE_R(-127.0) && unheard_dbm <= INSOLE_R(-50.0))) {
        return INSOLE_ERR_VALUE;
    }
    insole_real_t sum = ZERO, d = ZERO, n = (insole_real_t)map->point_count;
    for (uint32_t ap = 0; ap < map->ap_count; ap++) {
        sum += variance_of_ap(map, ap, unheard_dbm);
        d += ONE;
    }
    if (!(d > ZERO)) {
        return INSOLE_ERR_VALUE;
    }
    insole_real_t shrink =
        insole_exp(-insole_log((d + TWO) * n / INSOLE_R(4.0)) / (d + INSOLE_R(4.0)));
    *sigma_db = shrink * insole_sqrt(sum / d); /* [PhoneUKF (36)], d + 2: slip in print */
    return INSOLE_OK;
}

/* ---- for a tracker ---------------------------------------------------------------------- */

static insole_status_t begin_state(void *state, const insole_radio_map_t *map,
                                   const insole_trusted_area_t *area, const insole_rss_t *readings,
                                   uint32_t count)
{
    return insole_kde_fix_begin(state, map, area, readings, count);
}

static bool work_state(void *state, const insole_radio_map_t *map, uint32_t points)
{
    return insole_kde_fix_work(state, map, points);
}

static insole_status_t finish_state(void *state, const insole_radio_map_t *map,
                                    insole_radio_fix_t *fix)
{
    return insole_kde_fix_finish(state, map, fix);
}

const insole_radio_solver_calls_t insole_kde_fix_calls = {begin_state, work_state, finish_state};
