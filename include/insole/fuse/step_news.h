/** @file step_news.h  What a phone tells of its walker: a pace, and a fix by radio.
 *
 *  Source  [PhoneEKF] 3.3; [PhoneUKF] 6.2; [WifiShift] III.
 *  Frames  m: map.  n: level; its heading may differ from that of m by an offset.
 *
 *      insole_pace_t pace;
 *      insole_pace_of_step(&step, var_length_m2, &pace);
 *      insole_spot_fix_t fix = {scan.t_us, spot, cov_m2, way_walked_since};
 *
 *  A fix speaks of the place where the radio heard what it was made of. The way walked since then
 *  is told with it, in n, and whoever takes the fix moves it on by that way.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_STEP_NEWS_H
#define INSOLE_FUSE_STEP_NEWS_H

#include "insole/base/sym2.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Limits of what is taken, and of what is answered. */
#define INSOLE_PACE_MOST_M     INSOLE_R(10.0)   /**< length of a pace */
#define INSOLE_SPOT_MOST_M     INSOLE_R(1.0e5)  /**< coordinate of a fix, way walked since */
#define INSOLE_SPOT_LEAST_M2   INSOLE_R(1.0e-6) /**< variance of a coordinate */
#define INSOLE_SPOT_MOST_M2    INSOLE_R(1.0e12)
#define INSOLE_HEADING_MOST_R2 (INSOLE_PI * INSOLE_PI / INSOLE_R(3.0)) /**< nothing is known */

/** A step, or a stride, as a way on the floor. */
typedef struct {
    insole_real_t length_m;         /**< 0 .. 10 */
    insole_real_t heading_rad;      /**< direction walked, n */
    insole_real_t var_length_m2;    /**< 0 .. 100 */
    insole_real_t var_heading_rad2; /**< >= 0; pi^2 / 3 and more: not known */
} insole_pace_t;

/** A position from radio, and how far it can be trusted. */
typedef struct {
    uint64_t t_us;
    insole_spot_t spot;   /**< m, where it was heard */
    insole_sym2_t cov_m2; /**< m */
    insole_spot_t since;  /**< n, way walked since it was heard */
} insole_spot_fix_t;

/** @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for what is not finite or out of range */
insole_status_t insole_pace_check(const insole_pace_t *pace);

/** @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for coordinates beyond 100 km or not finite, and for a
 *          covariance that is none, or has a variance not in 1e-6 .. 1e12 m^2 */
insole_status_t insole_spot_fix_check(const insole_spot_fix_t *fix);

/** Whether a fusion can start with this: the same limits, and an offset within 1000 rad. */
bool insole_spot_is_start(insole_spot_t spot, insole_sym2_t cov_m2, insole_real_t offset_rad);

/** Whether a position that is answered still has centimetres: within 1000 km. */
static inline bool insole_spot_is_in_reach(insole_spot_t spot)
{
    return insole_abs(spot.x_m) <= INSOLE_R(1.0e6) && insole_abs(spot.y_m) <= INSOLE_R(1.0e6);
}

/** A covariance kept within the limits above. */
static inline insole_sym2_t insole_spot_cov(insole_sym2_t P)
{
    return insole_sym2_bound(P, INSOLE_SPOT_LEAST_M2, INSOLE_SPOT_MOST_M2);
}

/** The way of a pace, turned by `offset_rad` from n to m. */
insole_spot_t insole_pace_way(const insole_pace_t *pace, insole_real_t offset_rad);

/** A pace in the direction in which the phone points, whose variance follows from that of the
 *  attitude.
 *  @param pace  untouched when refused
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE when the pace would not pass insole_pace_check() */
insole_status_t insole_pace_of_step(const insole_step_t *step, insole_real_t var_length_m2,
                                    insole_pace_t *pace);

#ifdef __cplusplus
}
#endif

#endif
