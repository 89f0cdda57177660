/** @file foot_anchor.h  How the frame of the inertial filter lies on the map.
 *
 *  One point whose place is known in both frames, and the turn from one to the other. The turn
 *  comes from the heading of a start: the direction of the first two strides.
 *
 *  Frames  n: local level, as the filter happened to begin.  m: map.
 *
 *      static insole_foot_anchor_t anchor;
 *      insole_foot_anchor_init(&anchor, drift_radps, t_us);
 *      insole_foot_anchor_start(&anchor, &start, position_n_m, t_us);
 *      on each fix, which comes in n:
 *          insole_foot_anchor_follow(&anchor, fix.position_m, stride_ended);
 *          insole_foot_anchor_to_map(&anchor, &fix);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FOOT_ANCHOR_H
#define INSOLE_TRACK_FOOT_ANCHOR_H

#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Position in m = turn about the anchor in n, then to the anchor in m. */
typedef struct {
    insole_vec3_t anchor_n_m, anchor_m_m;
    insole_real_t yaw_rad;     /**< from n to m */
    insole_turn_t turn;        /**< by the same angle */
    insole_real_t var_m2;      /**< of the anchor's place, each axis */
    insole_real_t var_rad2;    /**< of the turn, at t_us */
    insole_real_t drift_radps; /**< 1-sigma by which n may turn since */
    insole_real_t heading_rad; /**< told by the start record */
    uint32_t strides_left;     /**< until the told heading is compared for the last time */
    uint64_t t_us;
} insole_foot_anchor_t;

/** n and m are the same, and known to be.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a drift that is negative or not finite */
insole_status_t insole_foot_anchor_init(insole_foot_anchor_t *anchor, insole_real_t drift_radps,
                                        uint64_t t_us);

/** The walker, at `position_n_m` now, is at the start. Its height stays what it was on the map.
 *  Without a heading the turn stays as it is.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for a start that is not finite, more than 1e6 m or
 *          100 rad away, or has a sigma that is negative or as large */
insole_status_t insole_foot_anchor_start(insole_foot_anchor_t *anchor, const insole_start_t *start,
                                         insole_vec3_t position_n_m, uint64_t t_us);

/** INSOLE_OK for a start that insole_foot_anchor_start would take. */
insole_status_t insole_foot_anchor_check(const insole_start_t *start);

/** The walker has come to `position_n_m`: until the second stride has ended the way since the start
 *  points where the start said. */
insole_status_t insole_foot_anchor_follow(insole_foot_anchor_t *anchor, insole_vec3_t position_n_m,
                                          bool stride_ended);

/** A new anchor at a place known as well as `fix_m` says, after which n has turned by an unknown
 *  angle of variance `turn_rad2`. */
insole_status_t insole_foot_anchor_renew(insole_foot_anchor_t *anchor, const insole_fix_t *fix_m,
                                         insole_vec3_t position_n_m, insole_real_t turn_rad2);

/** As insole_foot_anchor_put. Nothing is checked. */
void insole_foot_anchor_place(const insole_foot_anchor_t *anchor, const insole_vec3_t *position_n_m,
                              const insole_sym3_t *cov_n_m2, insole_fix_t *fix);

/** A fix on the map of a place in n. Time, heading (n) and its variance are in `fix` already; its
 *  state stays. @return INSOLE_ERR_NULL */
static inline insole_status_t insole_foot_anchor_put(const insole_foot_anchor_t *anchor,
                                                     const insole_vec3_t *position_n_m,
                                                     const insole_sym3_t *cov_n_m2,
                                                     insole_fix_t *fix)
{
    if (!anchor || !position_n_m || !cov_n_m2 || !fix) {
        return INSOLE_ERR_NULL;
    }
    insole_foot_anchor_place(anchor, position_n_m, cov_n_m2, fix);
    return INSOLE_OK;
}

/** The same for a fix that is in n as a whole. */
insole_status_t insole_foot_anchor_to_map(const insole_foot_anchor_t *anchor, insole_fix_t *fix);

#ifdef __cplusplus
}
#endif

#endif
