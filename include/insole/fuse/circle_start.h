/** @file circle_start.h  Start and direction from circles about fixes: as the paper prints it.
 *
 *  Source  [WifiShift] III.A, eq. (1).
 *  Frames  m: map.  n: level, the frame of the ways; heading in m = heading in n + offset.
 *
 *      insole_circle_pair_t pairs[5] = {{spot_of_the_first_fix, {0, 0}}, ...};
 *      begin = insole_circle_start_place(pairs, 5);
 *      offset_rad = insole_circle_start_direction(pairs, 5, begin);
 *
 *  Who has walked l metres since the start is on a circle of that radius about it, and the start on
 *  the same circle about the fix. The start is where the sum of the distances to all circles is
 *  least. Where many places are as good as each other (two circles that do not meet) it is the one
 *  with the least squares. The direction is that in which the walk, turned about the start, lies
 *  nearest to the regression line of the fixes: total least squares, since a walk along y has no
 *  slope, and of the line's two directions the one in which the fixes went.
 *
 *  auto_start.h takes it as one of its methods.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_CIRCLE_START_H
#define INSOLE_FUSE_CIRCLE_START_H

#include "insole/base/sym2.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_CIRCLE_START_MOST = 8 /**< pairs */ };

/** A fix, and how it was reached. */
typedef struct {
    insole_spot_t radio; /**< L_w, m */
    insole_spot_t way;   /**< n, walked from the start to where it was heard */
} insole_circle_pair_t;

/** Where the total distance to the circles is least, [WifiShift (1)].
 *  @param pairs  of finite numbers within 100 km; those beyond INSOLE_CIRCLE_START_MOST are left
 *                out; none, or NULL: the origin */
insole_spot_t insole_circle_start_place(const insole_circle_pair_t *pairs, uint32_t count);

/** The offset that brings the walk nearest to the line of the fixes, in (-pi, pi]; 0 where nothing
 *  tells it (nobody walked, all fixes are equal). */
insole_real_t insole_circle_start_direction(const insole_circle_pair_t *pairs, uint32_t count,
                                            insole_spot_t begin);

/** Total distance from a place to the circles. */
insole_real_t insole_circle_start_distance(const insole_circle_pair_t *pairs, uint32_t count,
                                           insole_spot_t place);

#ifdef __cplusplus
}
#endif

#endif
