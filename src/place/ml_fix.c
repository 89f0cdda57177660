/* SPDX-License-Identifier: MIT */
#include "insole/place/ml_fix.h"

#include <stddef.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

#define BIN_DB          INSOLE_R(8.0)
#define FIRST_MID_LEVEL 176 /* of the middle of the lowest bin, -88 dBm */
#define BIN_LEVELS      16
#define ROOT_2PI        INSOLE_R(2.5066282746310005)

const insole_ml_fix_config_t insole_ml_fix_defaults = {INSOLE_ML_FIX_KEYS(INSOLE_CONFIG_DEFAULT)};

/* The prior density so far off its mean, over that at the mean. */
static insole_real_t bell(const insole_ml_fix_config_t *config, insole_real_t off_db)
{
    return insole_exp(-HALF * insole_square(off_db / config->sigma_db));
}

static insole_status_t check(const insole_ml_fix_config_t *config)
{
    typedef insole_ml_fix_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_ML_FIX_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_ml_fix_init(insole_ml_fix_t *ml, const insole_ml_fix_config_t *config)
{
    if (!ml || !config) {
        return INSOLE_ERR_NULL;
    }
    if (check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    *ml = (insole_ml_fix_t){.config = *config};
    for (uint32_t half_db = 0; half_db < (uint32_t)INSOLE_RADIO_LEVELS; half_db++) {
        ml->bell[half_db] = bell(config, HALF * (insole_real_t)half_db);
    }
    return INSOLE_OK;
}

/* Logarithm of the prior density of a strength where the access point is not known, against that of
 * not being heard there. */
static insole_real_t log_of_stranger(const insole_ml_fix_t *ml, insole_real_t dbm)
{
    return -HALF * insole_square((dbm - ml->config.unheard_dbm) / ml->config.sigma_db);
}

static void sum_strangers(insole_ml_fix_t *ml)
{
    const insole_heard_t *heard = &ml->search.heard;
    ml->log_blank = ZERO;
    for (uint32_t i = 0; i < heard->count; i++) {
        ml->log_blank += log_of_stranger(ml, heard->dbm[i]);
    }
}

insole_status_t insole_ml_fix_begin(insole_ml_fix_t *ml, const insole_radio_map_t *map,
                                    const insole_trusted_area_t *area, const insole_rss_t *readings,
                                    uint32_t count)
{
    if (!ml || !map) {
        return INSOLE_ERR_NULL;
    }
    if (ml->config.density == INSOLE_ML_FIX_HISTOGRAM && !map->bins) {
        return INSOLE_ERR_STATE;
    }
    insole_status_t status = insole_map_search_begin(
        &ml->search, map, area, ml->config.readings_min, ml->config.age_max_s, readings, count);
    if (status == INSOLE_OK) {
        sum_strangers(ml);
    }
    return status;
}

/* ---- densities, as logarithms of their ratio to the prior density at its mean ---- */

static insole_real_t log_of_gauss(const insole_ml_fix_t *ml, const insole_radio_map_t *map,
                                  uint32_t entry, insole_real_t dbm)
{
    insole_real_t heard = (insole_real_t)insole_radio_map_heard(map, entry);
    insole_real_t prior = ml->config.prior_count, prior_db2 = insole_square(ml->config.sigma_db);
    insole_real_t known_db2 = insole_square(insole_radio_map_std_db(map, entry));
    insole_real_t variance_db2 = (heard * known_db2 + prior * prior_db2) / (heard + prior);
    insole_real_t off_db2 = insole_square(dbm - insole_radio_map_mean_dbm(map, entry));
    return -HALF * (off_db2 / variance_db2 + insole_log(variance_db2 / prior_db2));
}

/* Count of a bin, half of it spread to its neighbours; the one below the lowest is not heard. */
static insole_real_t smooth_count(const uint8_t *bins, insole_real_t silent, uint32_t bin)
{
    insole_real_t below = bin > 0u ? (insole_real_t)bins[bin - 1u] : silent;
    insole_real_t above =
        bin + 1u < (uint32_t)INSOLE_RADIO_BINS ? (insole_real_t)bins[bin + 1u] : ZERO;
    return HALF * (insole_real_t)bins[bin] + INSOLE_R(0.25) * (below + above);
}

static insole_real_t bell_of_bin(const insole_ml_fix_t *ml, uint8_t mean_level, uint32_t bin)
{
    int32_t off = (int32_t)mean_level + BIN_LEVELS * (int32_t)bin - FIRST_MID_LEVEL;
    return ml->bell[off < 0 ? -off : off];
}

/* `heard`: false for the share of scans that did not hear it. */
static insole_real_t log_of_histogram(const insole_ml_fix_t *ml, const insole_radio_map_t *map,
                                      uint32_t point, uint32_t entry, bool heard, insole_real_t dbm)
{
    const uint8_t *bins = &map->bins[(size_t)entry * INSOLE_RADIO_BINS];
    uint32_t count = insole_radio_map_heard(map, entry), bin = insole_radio_bin(dbm);
    uint32_t visits = map->visits ? map->visits[point] : count;
    insole_real_t silent = (insole_real_t)(visits - count), prior = ml->config.prior_count;
    insole_real_t seen = heard ? smooth_count(bins, silent, bin)
                               : HALF * silent + INSOLE_R(0.25) * (insole_real_t)bins[0];
    insole_real_t width = BIN_DB / (ROOT_2PI * ml->config.sigma_db);
    insole_real_t density =
        heard ? bell_of_bin(ml, map->below[entry], bin)
              : bell(&ml->config, insole_radio_map_mean_dbm(map, entry) - ml->config.unheard_dbm);
    insole_real_t expected = prior * width * density;
    insole_real_t share = (seen + expected) / ((insole_real_t)visits + prior);
    return insole_log(insole_max(share / width, INSOLE_R(1e-30)));
}

/* Logarithm of the product of all densities, against a place that hears nothing. */
static insole_real_t log_of_point(const insole_ml_fix_t *ml, const insole_radio_map_t *map,
                                  uint32_t point)
{
    insole_real_t sum = ml->log_blank;
    uint32_t at = 0, end = map->first[point + 1u];
    for (uint32_t i = map->first[point]; i < end; i++) {
        bool heard = insole_heard_seek(&ml->search.heard, &at, map->aps[i]);
        insole_real_t dbm = heard ? ml->search.heard.dbm[at] : ml->config.unheard_dbm;
        sum += ml->config.density == INSOLE_ML_FIX_GAUSS
                   ? log_of_gauss(ml, map, i, dbm)
                   : log_of_histogram(ml, map, point, i, heard, dbm);
        sum -= log_of_stranger(ml, dbm);
    }
    return sum;
}

bool insole_ml_fix_work(insole_ml_fix_t *ml, const insole_radio_map_t *map, uint32_t points)
{
    if (!ml || !map) {
        return false;
    }
    uint32_t point;
    while (insole_map_search_next(&ml->search, map, &points, &point)) {
        insole_real_t log_weight = ml->config.independent * log_of_point(ml, map, point);
        insole_map_search_add(&ml->search, map, point, log_weight);
    }
    return insole_map_search_has_more(&ml->search);
}

insole_status_t insole_ml_fix_finish(insole_ml_fix_t *ml, const insole_radio_map_t *map,
                                     insole_radio_fix_t *fix)
{
    if (!ml || !fix) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_map_search_finish(&ml->search, map);
    if (status != INSOLE_OK) {
        return status;
    }
    const insole_spot_mixture_t *mixture = &ml->search.mixture;
    bool likeliest = ml->config.answer == INSOLE_ML_FIX_LIKELIEST;
    insole_spot_mixture_cov(mixture, likeliest ? mixture->top : mixture->mean,
                            ml->config.point_sigma_m, ml->config.widen, fix);
    fix->log_weight /= ml->config.independent;
    fix->readings = ml->search.heard.count;
    return INSOLE_OK;
}

insole_status_t insole_ml_fix_solve(insole_ml_fix_t *ml, const insole_radio_map_t *map,
                                    const insole_trusted_area_t *area, const insole_rss_t *readings,
                                    uint32_t count, insole_radio_fix_t *fix)
{
    if (!fix) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_ml_fix_begin(ml, map, area, readings, count);
    if (status != INSOLE_OK) {
        return status;
    }
    insole_ml_fix_work(ml, map, UINT32_MAX);
    return insole_ml_fix_finish(ml, map, fix);
}

/* ---- for a tracker ---------------------------------------------------------------------- */

static insole_status_t begin_state(void *state, const insole_radio_map_t *map,
                                   const insole_trusted_area_t *area, const insole_rss_t *readings,
                                   uint32_t count)
{
    return insole_ml_fix_begin(state, map, area, readings, count);
}

static bool work_state(void *state, const insole_radio_map_t *map, uint32_t points)
{
    return insole_ml_fix_work(state, map, points);
}

static insole_status_t finish_state(void *state, const insole_radio_map_t *map,
                                    insole_radio_fix_t *fix)
{
    return insole_ml_fix_finish(state, map, fix);
}

const insole_radio_solver_calls_t insole_ml_fix_calls = {begin_state, work_state, finish_state};
