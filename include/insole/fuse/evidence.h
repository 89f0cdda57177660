/** @file evidence.h  What is told of the walker at one moment: a stride, a position, ranges, a
 * scan; by a phone a fix by fingerprints, what its compass says, or a scan held against a map.
 *
 *  Source  [TwoOrder] 3.2 (34), (38)-(39), (41); [PhoneEKF] 4.1.
 *  Frames  m: map.  n: level; `turn` goes from n to m.
 *
 *      insole_evidence_clear(&news);
 *      insole_evidence_stride(&news, length_m, heading_rad, turn_rad);
 *      insole_evidence_scan(&news, readings, count, since);
 *      insole_particle_filter_begin(&filter, &building, &news);
 *
 *  A way walked `since` is that from where something was measured to the end of the stride told
 *  with it; when none is told, to where the last one ended, hence backwards.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_EVIDENCE_H
#define INSOLE_FUSE_EVIDENCE_H

#include "insole/fuse/rss_weigh.h"
#include "insole/fuse/step_news.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_EVIDENCE_RANGES = 8 /**< that can be told at a time */ };

/** A distance to a known place. */
typedef struct {
    insole_spot_t from;
    insole_spot_t since;   /**< n: way walked since it was measured; m when turned */
    insole_real_t range_m; /**< >= 0 */
    insole_real_t sigma_m; /**< sigma_2 of (39), > 0 */
    insole_real_t dof;     /**< degrees of freedom of its tail; 0: normal, as in (39) */
} insole_evidence_range_t;

typedef struct {
    bool has_stride, has_position, has_scan, has_compass;
    insole_real_t length_m;                        /**< of the stride, s_k of (32) */
    insole_real_t heading_rad;                     /**< n: its direction, psi_k of (32) */
    insole_real_t turn_rad;                        /**< of the heading from the stride before */
    insole_real_t var_length_m2, var_heading_rad2; /**< beside what the settings say */

    insole_spot_t position;
    insole_real_t sigma_m; /**< sigma_1 of (34), > 0 */

    uint32_t ranges;
    insole_evidence_range_t range[INSOLE_EVIDENCE_RANGES];

    const insole_rss_t *readings; /**< the caller's */
    uint32_t reading_count;
    insole_spot_t since; /**< way walked since the scan */

    const insole_spot_fix_t *fix;  /**< the caller's; NULL: none */
    const insole_rss_weigh_t *rss; /**< the caller's; NULL: none */
    insole_spot_t rss_since;       /**< n: way walked since that was heard */
    insole_real_t compass_rad;     /**< offset from n to m */
    insole_real_t sigma_compass_rad;
} insole_evidence_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE when anything told is not as the calls below let in */
insole_status_t insole_evidence_check(const insole_evidence_t *evidence);

/** Nothing is told. */
void insole_evidence_clear(insole_evidence_t *evidence);

/** @param length_m  0 .. 100
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for what is not finite or out of range */
insole_status_t insole_evidence_stride(insole_evidence_t *evidence, insole_real_t length_m,
                                       insole_real_t heading_rad, insole_real_t turn_rad);

/** How far the stride may be off, beside what the settings say.
 *  @param var_length_m2     0 .. 100
 *  @param var_heading_rad2  0 .. 10
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for what is not finite or out of range */
insole_status_t insole_evidence_scatter(insole_evidence_t *evidence, insole_real_t var_length_m2,
                                        insole_real_t var_heading_rad2);

/** The position by the first order, m.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for what is not finite or a sigma under a micrometre
 */
insole_status_t insole_evidence_position(insole_evidence_t *evidence, insole_spot_t position,
                                         insole_real_t sigma_m);

/** One range more.
 *  @return INSOLE_ERR_VALUE as above and for a negative range; INSOLE_ERR_ROOM for more than
 *          INSOLE_EVIDENCE_RANGES */
insole_status_t insole_evidence_range(insole_evidence_t *evidence,
                                      const insole_evidence_range_t *range);

/** All access points heard. The readings are looked at when the evidence is handed on.
 *  @param since  n
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a way that is not finite */
insole_status_t insole_evidence_scan(insole_evidence_t *evidence, const insole_rss_t *readings,
                                     uint32_t count, insole_spot_t since);

/** A fix by fingerprints. It is looked at when the evidence is handed on. Each particle turns
 *  `since` by its own offset.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE as insole_spot_fix_check() */
insole_status_t insole_evidence_fix(insole_evidence_t *evidence, const insole_spot_fix_t *fix);

/** The offset from directions in n to directions in m, as a compass sees it.
 *  @param sigma_rad  0.001 .. 100
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for what is not finite or out of range */
insole_status_t insole_evidence_compass(insole_evidence_t *evidence, insole_real_t offset_rad,
                                        insole_real_t sigma_rad);

/** A scan that was held against a radio map, for particles to be weighed by. It must stay as it is
 *  until all that is told here is worked in.
 *  @param since  n
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for a way that is not finite; INSOLE_ERR_STATE when
 *          not all is compared */
insole_status_t insole_evidence_rss(insole_evidence_t *evidence, const insole_rss_weigh_t *rss,
                                    insole_spot_t since);

/** Turns the ways walked since from n to m, but those that each particle turns; once. What is the
 *  caller's is let go of. */
void insole_evidence_turn(insole_evidence_t *evidence, insole_turn_t turn);

/** Logarithm of the product of the weights by position and ranges of a particle at (x, y), up to a
 *  number common to all. */
insole_real_t insole_evidence_log_weight(const insole_evidence_t *evidence, insole_real_t x_m,
                                         insole_real_t y_m);

#ifdef __cplusplus
}
#endif

#endif
