/** @file range_fix.h  Position from ranges to known anchors.
 *
 *  Source  our own; beside the position by signal strength alone of [TwoOrder] 4.3, fig. 6a.
 *  Frames  m: map, metres.
 *
 *      insole_range_fix_solve(&config, anchors, 6, ranges, 5, NULL, &fix);    from one epoch
 *      ...                                                                    or with memory:
 *      insole_range_fix_age(&config, &fix, dt_s);
 *      insole_range_fix_solve(&config, anchors, 6, ranges, 5, &fix, &fix);
 *
 *  Robust least squares over x, y and what all ranges are too long by. The centroid of the anchors,
 *  weighted by nearness and spread as wide as the ranges are, counts as one more reading, and so
 *  does an earlier fix. Hence one anchor gives its own place and a wide covariance, two or
 * collinear ones leave the direction across open, and no number of ranges is too small but none.
 *
 *  A range can be far too long, since a wall makes radio go around, but hardly too short: the
 * weight falls soon with a positive residual, later with a negative one.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_RANGE_FIX_H
#define INSOLE_PLACE_RANGE_FIX_H

#include "insole/place/propagation.h"
#include "insole/place/robust_fit.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_RANGE_FIX_KEYS(KEY)                                                                \
    KEY(REAL, sigma_m, 1.0, 0.01, 100.0, "m",                                                     \
        "1-sigma of a range, beside what the radio tells")                                        \
    KEY(REAL, bias_m, 1.75, -100.0, 100.0, "m",                                                   \
        "all ranges are too long by this; 1.75 suits round-trip times of telephones, 0 UWB")      \
    KEY(REAL, bias_sigma_m, 0.5, 0.001, 100.0, "m",                                               \
        "1-sigma of bias_m: it is estimated with the position; 0.001 = taken as it is")           \
    KEY(REAL, tail_long, 0.5, 0.1, 1000.0, "sigma",                                               \
        "a range longer than expected by this counts half; 1000 = squares")                       \
    KEY(REAL, tail_short, 2.0, 0.1, 1000.0, "sigma", "the same for a range that is shorter")      \
    KEY(REAL, loosen, 4.0, 1.0, 100.0, "", "the tails begin wider by this factor; 1 = not")       \
    KEY(REAL, range_max_m, 100.0, 1.0, 100000.0, "m", "a longer range is left out")               \
    KEY(REAL, told_max_m, 10.0, 0.01, 100000.0, "m",                                              \
        "a range whose radio tells a larger sigma is left out")                                   \
    KEY(REAL, height_m, 0.0, -10.0, 10.0, "m", "height of the receiver above the floor")          \
    KEY(REAL, walk_mps, 1.3, 0.0, 20.0, "m/s", "how fast memory fades: speed of a walker")        \
    KEY(REAL, drift_m, 0.1, 0.0, 10.0, "m/sqrt(s)", "random walk of what ranges have in common")  \
    KEY(INT, iterations, 10, 1, 100, "", "at most")
/* clang-format on */

typedef struct {
    INSOLE_RANGE_FIX_KEYS(INSOLE_CONFIG_MEMBER)
} insole_range_fix_config_t;

extern const insole_range_fix_config_t insole_range_fix_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range; the other calls take
 *          settings that have passed */
insole_status_t insole_range_fix_check(const insole_range_fix_config_t *config);

/** Finds the position. Ranges of unknown ids, not finite, negative or beyond the gates are passed
 *  over.
 *  @param before  an earlier fix from ranges, aged; NULL: none; may be `fix`
 *  @return INSOLE_ERR_STATE when no range passes; INSOLE_ERR_VALUE for an anchor in use or a
 *          `before` that makes no sense */
insole_status_t insole_range_fix_solve(const insole_range_fix_config_t *config,
                                       const insole_ap_t *aps, uint32_t ap_count,
                                       const insole_range_t *ranges, uint32_t count,
                                       const insole_anchor_fix_t *before, insole_anchor_fix_t *fix);

/** Lets a fix fade: who walks is somewhere else `dt_s` later.
 *  @return INSOLE_ERR_VALUE for a time that is not finite or negative */
insole_status_t insole_range_fix_age(const insole_range_fix_config_t *config,
                                     insole_anchor_fix_t *fix, insole_real_t dt_s);

#ifdef __cplusplus
}
#endif

#endif
