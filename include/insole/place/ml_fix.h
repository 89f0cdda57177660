/** @file ml_fix.h  The most likely fingerprint of a scan.
 *
 *  Source  [WifiShift] II.A.
 *  Frames  m: map, metres.
 *
 *      static insole_ml_fix_t ml;
 *      insole_ml_fix_init(&ml, &insole_ml_fix_defaults);
 *      on each scan:
 *          insole_ml_fix_begin(&ml, &map, NULL, scan.readings, scan.count);
 *          while (insole_ml_fix_work(&ml, &map, 16)) {}
 *          insole_ml_fix_finish(&ml, &map, &fix);
 *
 *  Each access point has at each point a density over strengths: `gauss` from mean and spread, or
 *  `histogram` from the counts of the bins. Both lean on a normal prior that counts as
 * `prior_count` scans, so that one lucky scan makes no sharp density. What is not heard counts as
 * -95 dBm, in the survey as in the scan. Everything is computed in the log domain, against a place
 * that hears nothing.
 *
 *  Access points do not err one by one: only the share `independent` of what they tell goes into
 * the covariance. `answer = likeliest` is the paper's point, `mean` that of all points by
 * likelihood.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_ML_FIX_H
#define INSOLE_PLACE_ML_FIX_H

#include "insole/base/config.h"
#include "insole/place/map_search.h"
#include "insole/place/radio_solver.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_ML_FIX_KEYS(KEY)                                                                   \
    KEY(CHOICE, density, 0, 0, 1, "gauss|histogram", "of the strengths at a point")               \
    KEY(CHOICE, answer, 0, 0, 1, "likeliest|mean", "the point that fits best, or the mean of all") \
    KEY(REAL, unheard_dbm, -95.0, -127.0, -50.0, "dBm", "what unheard counts as")                 \
    KEY(REAL, sigma_db, 12.0, 0.5, 50.0, "dB", "1-sigma of strengths, before the survey")          \
    KEY(REAL, prior_count, 4.0, 0.01, 1000.0, "", "scans of the survey that this counts as")      \
    KEY(REAL, independent, 0.1, 0.001, 1.0, "", "share of independent access points")            \
    KEY(REAL, point_sigma_m, 3.0, 0.1, 100.0, "m", "1-sigma of the place of each fingerprint")    \
    KEY(REAL, widen, 2.0, 0.1, 100.0, "", "factor on the variance of the fingerprints' places")   \
    KEY(INT, readings_min, 3, 1, 256, "", "readings a scan needs")                                \
    KEY(REAL, age_max_s, 3.5, 0.0, 60.0, "s", "an older reading is left out")
/* clang-format on */

typedef struct {
    INSOLE_ML_FIX_KEYS(INSOLE_CONFIG_MEMBER)
} insole_ml_fix_config_t;

extern const insole_ml_fix_config_t insole_ml_fix_defaults;

enum { INSOLE_ML_FIX_GAUSS = 0, INSOLE_ML_FIX_HISTOGRAM = 1 };
enum { INSOLE_ML_FIX_LIKELIEST = 0, INSOLE_ML_FIX_MEAN = 1 };

typedef struct {
    insole_ml_fix_config_t config;
    insole_real_t bell[INSOLE_RADIO_LEVELS]; /**< histogram: the prior density, by half dB off its
                                                mean, over that at the mean */
    insole_map_search_t search;              /**< the scan in work */
    insole_real_t log_blank; /**< logarithm of its likelihood where nothing is heard */
} insole_ml_fix_t;

/** @return INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_ml_fix_init(insole_ml_fix_t *ml, const insole_ml_fix_config_t *config);

/** Takes a scan; one still in work is given up.
 *  @param map one that has passed insole_radio_map_check()
 *  @param area NULL: anywhere
 *  @return INSOLE_ERR_STATE when fewer than `readings_min` readings pass (heard.h), or histograms
 *          are asked of a map without; INSOLE_ERR_VALUE for an area that makes no sense */
insole_status_t insole_ml_fix_begin(insole_ml_fix_t *ml, const insole_radio_map_t *map,
                                    const insole_trusted_area_t *area, const insole_rss_t *readings,
                                    uint32_t count);

/** Weighs the next `points` of the map that was begun with.
 *  @return whether more are left */
bool insole_ml_fix_work(insole_ml_fix_t *ml, const insole_radio_map_t *map, uint32_t points);

/** The position, once nothing is left.
 *  @return INSOLE_ERR_STATE when work is left, no scan was begun or no point lies in the area */
insole_status_t insole_ml_fix_finish(insole_ml_fix_t *ml, const insole_radio_map_t *map,
                                     insole_radio_fix_t *fix);

/** The three for a tracker, over an `insole_ml_fix_t`. */
extern const insole_radio_solver_calls_t insole_ml_fix_calls;

/** All three at once. */
insole_status_t insole_ml_fix_solve(insole_ml_fix_t *ml, const insole_radio_map_t *map,
                                    const insole_trusted_area_t *area, const insole_rss_t *readings,
                                    uint32_t count, insole_radio_fix_t *fix);

#ifdef __cplusplus
}
#endif

#endif
