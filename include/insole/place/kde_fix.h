/** @file kde_fix.h  Position and its covariance from a scan and fingerprints, by kernels.
 *
 *  Source  [PhoneEKF] 3.2, eqs. 22-28; [PhoneUKF] 6.1, eqs. 32-37.
 *  Frames  m: map, metres.
 *
 *      static insole_kde_fix_t kde;
 *      insole_kde_fix_init(&kde, &insole_kde_fix_defaults);
 *      on each scan:
 *          insole_kde_fix_begin(&kde, &map, NULL, scan.readings, scan.count);
 *          while (insole_kde_fix_work(&kde, &map, 16)) {}
 *          insole_kde_fix_finish(&kde, &map, &fix);
 *
 *  Two kernels. `gauss` is the papers': a normal density over the differences in dB, where unheard
 *  counts as a very weak strength. `sorensen`, the default, holds the strengths, bent by a power so
 *  that the strong ones count, against each other by the share they have in common: what is heard
 *  on one side only is a difference, and crowds of weak access points cannot drown the near ones.
 *
 *  People who stand between, a hand on the antenna: a scan that was disturbed often fits one
 *  fingerprint far better than the others and none well, so that its covariance is small and wrong.
 *  `misfit = told` multiplies it by the mean square difference to the best fingerprint over that of
 *  the kernel, between 0.1 and 100: the noise that a scan shows counts, not the one expected.
 *
 *  A phone that reads all too strong or too weak: `offset = learn` finds its offset from the scans
 *  themselves, from one to the next, and takes it off.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_KDE_FIX_H
#define INSOLE_PLACE_KDE_FIX_H

#include "insole/base/config.h"
#include "insole/place/map_search.h"
#include "insole/place/radio_solver.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_KDE_FIX_KEYS(KEY)                                                                  \
    KEY(CHOICE, kernel, 0, 0, 1, "sorensen|gauss", "how a scan is held against a fingerprint")    \
    KEY(REAL, floor_dbm, -92.0, -127.0, -50.0, "dBm", "sorensen: a strength that counts nothing") \
    KEY(REAL, power, 1.5, 0.25, 4.0, "", "sorensen: of the strength above the floor")             \
    KEY(REAL, width, 0.02, 0.001, 1.0, "", "sorensen: distance that makes a weight e times less") \
    KEY(REAL, sigma_db, 30.0, 0.5, 1000.0, "dB", "gauss: width of the kernel")                    \
    KEY(REAL, unheard_dbm, -95.0, -127.0, -50.0, "dBm", "gauss: what unheard counts as")          \
    KEY(REAL, point_sigma_m, 3.0, 0.1, 100.0, "m", "1-sigma of the place of each fingerprint")    \
    KEY(REAL, widen, 2.0, 0.1, 100.0, "", "factor on the variance of the fingerprints' places")   \
    KEY(CHOICE, misfit, 0, 0, 1, "passed-over|told",                                              \
        "gauss: how badly a scan fits its best fingerprint is part of its covariance, or not")    \
    KEY(CHOICE, offset, 0, 0, 1, "none|learn", "what this phone reads too strong")                \
    KEY(REAL, offset_max_db, 15.0, 0.1, 60.0, "dB", "largest offset learned")                     \
    KEY(REAL, learn_weight, 0.05, 0.001, 1.0, "", "least weight of a new scan in the offset")     \
    KEY(INT, readings_min, 3, 1, 256, "", "readings a scan needs")                                \
    KEY(REAL, age_max_s, 3.5, 0.0, 60.0, "s", "an older reading is left out")
/* clang-format on */

typedef struct {
    INSOLE_KDE_FIX_KEYS(INSOLE_CONFIG_MEMBER)
} insole_kde_fix_config_t;

extern const insole_kde_fix_config_t insole_kde_fix_defaults;

enum { INSOLE_KDE_FIX_SORENSEN = 0, INSOLE_KDE_FIX_GAUSS = 1 };
enum { INSOLE_KDE_FIX_MISFIT_PASSED_OVER = 0, INSOLE_KDE_FIX_MISFIT_TOLD = 1 };

typedef struct {
    insole_kde_fix_config_t config;
    insole_real_t bent[INSOLE_RADIO_LEVELS]; /**< sorensen: a level's strength, bent by the power */
    insole_map_search_t search;              /**< the scan in work, offset taken off */
    insole_real_t heard_sum;                 /**< its bent sum, or its squares above unheard */
    insole_real_t offset_db;                 /**< this phone's, as learned */
    uint32_t learned;                        /**< scans that it was learned from */
} insole_kde_fix_t;

/** @return INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_kde_fix_init(insole_kde_fix_t *kde, const insole_kde_fix_config_t *config);

/** Takes a scan; one still in work is given up.
 *  @param map one that has passed insole_radio_map_check()
 *  @param area NULL: anywhere [PhoneEKF (28)] [PhoneUKF (37)]
 *  @return INSOLE_ERR_STATE when fewer than `readings_min` readings pass (heard.h);
 * INSOLE_ERR_VALUE for an area that makes no sense */
insole_status_t insole_kde_fix_begin(insole_kde_fix_t *kde, const insole_radio_map_t *map,
                                     const insole_trusted_area_t *area,
                                     const insole_rss_t *readings, uint32_t count);

/** Weighs the next `points` of the map that was begun with.
 *  @return whether more are left */
bool insole_kde_fix_work(insole_kde_fix_t *kde, const insole_radio_map_t *map, uint32_t points);

/** The position, once nothing is left; it also learns the offset.
 *  @return INSOLE_ERR_STATE when work is left, no scan was begun or no point lies in the area */
insole_status_t insole_kde_fix_finish(insole_kde_fix_t *kde, const insole_radio_map_t *map,
                                      insole_radio_fix_t *fix);

/** The three for a tracker, over an `insole_kde_fix_t`. */
extern const insole_radio_solver_calls_t insole_kde_fix_calls;

/** All three at once. */
insole_status_t insole_kde_fix_solve(insole_kde_fix_t *kde, const insole_radio_map_t *map,
                                     const insole_trusted_area_t *area,
                                     const insole_rss_t *readings, uint32_t count,
                                     insole_radio_fix_t *fix);

/** The papers' own width of the Gaussian kernel, by normal reference from the scatter of the whole
 *  map, [PhoneUKF (36)]: to be set as `sigma_db`. Long work (points x access points), for the desk.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for `unheard_dbm` not in -127 .. -50 */
insole_status_t insole_kde_fix_normal_reference(const insole_radio_map_t *map,
                                                insole_real_t unheard_dbm, insole_real_t *sigma_db);

#ifdef __cplusplus
}
#endif

#endif
