/** @file rss_fix.h  Position from signal strengths of known access points.
 *
 *  Source  [TwoOrder] 4.3, table 2 and fig. 6a: positioning by the propagation model alone, which
 *          gives the start. The estimator is our own, the centroid its simple rival.
 *  Frames  m: map, metres.
 *
 *      insole_rss_fix_solve(&config, &propagation, aps, 16, scan.readings, scan.count, &fix);
 *      insole_rss_fix_centroid(&config, aps, 16, scan.readings, scan.count, &fix);
 *
 *  The most likely place by the propagation model, walls not being known, with the weighted
 * centroid as one more reading; what the receiver reads too strong is found with it. Strengths are
 * compared in dB, never in metres: their errors are alike near and far. One access point gives its
 * own place and a covariance as wide as the range it is heard at.
 *
 *  There is no memory here as in range_fix: what errs in signal strength errs for many seconds, and
 *  an earlier fix would only make the next one too sure of itself.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_RSS_FIX_H
#define INSOLE_PLACE_RSS_FIX_H

#include "insole/place/propagation.h"
#include "insole/place/robust_fit.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_RSS_FIX_KEYS(KEY)                                                                  \
    KEY(REAL, sigma_db, 9.0, 0.1, 50.0, "dB", "1-sigma of a reading where walls are not known")   \
    KEY(REAL, tail, 5.0, 0.1, 1000.0, "sigma", "a residual of this counts half; 1000 = squares")  \
    KEY(REAL, gain_sigma_db, 3.0, 0.001, 100.0, "dB",                                             \
        "1-sigma of what the receiver reads too strong; 0.001 = nothing")                         \
    KEY(REAL, rss_min_dbm, -95.0, -200.0, 0.0, "dBm", "a weaker reading is left out")             \
    KEY(REAL, centroid_power, 0.5, 0.0, 10.0, "",                                                 \
        "an access point's weight in the centroid: its power in mW to this")                      \
    KEY(REAL, centroid_sigma_m, 3.0, 0.1, 1000.0, "m", "1-sigma of a centroid of many")           \
    KEY(INT, iterations, 10, 1, 100, "", "at most")
/* clang-format on */

typedef struct {
    INSOLE_RSS_FIX_KEYS(INSOLE_CONFIG_MEMBER)
} insole_rss_fix_config_t;

extern const insole_rss_fix_config_t insole_rss_fix_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range; the other calls take
 *          settings that have passed */
insole_status_t insole_rss_fix_check(const insole_rss_fix_config_t *config);

/** Finds the position. Readings of unknown ids, not finite or too weak are passed over.
 *  @return INSOLE_ERR_STATE when no reading passes; INSOLE_ERR_VALUE for an access point in use
 * that makes no sense */
insole_status_t insole_rss_fix_solve(const insole_rss_fix_config_t *config,
                                     const insole_propagation_config_t *propagation,
                                     const insole_ap_t *aps, uint32_t ap_count,
                                     const insole_rss_t *readings, uint32_t count,
                                     insole_anchor_fix_t *fix);

/** The mean place of the access points heard, the stronger the more.
 *  @return as insole_rss_fix_solve */
insole_status_t insole_rss_fix_centroid(const insole_rss_fix_config_t *config,
                                        const insole_propagation_config_t *propagation,
                                        const insole_ap_t *aps, uint32_t ap_count,
                                        const insole_rss_t *readings, uint32_t count,
                                        insole_anchor_fix_t *fix);

#ifdef __cplusplus
}
#endif

#endif
