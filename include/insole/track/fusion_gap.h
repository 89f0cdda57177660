/** @file fusion_gap.h  What the particles have to be told of a gap in the shoe's readings.
 *
 *  While readings are missing the first order loses the way by so much, and says so; a cloud of
 *  particles, which only knows of strides, does not. From the first sample after the gap until the
 *  particles have been drawn anew it is open: what is lost is added to what the cloud says.
 *
 *  Frames  m: map.
 *
 *      static insole_fusion_gap_t gap;
 *      on each fix of the foot:
 *          (void)insole_fusion_gap_follow(&gap, &foot, &fix);
 *          if (gap.is_crossed) {
 *              draw the particles anew, wider by insole_fusion_gap_lost(&gap);
 *              insole_fusion_gap_close(&gap);
 *          }
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FUSION_GAP_H
#define INSOLE_TRACK_FUSION_GAP_H

#include "insole/track/foot_tracker.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What the first order does not know, of each coordinate and of the turn from n to m. */
typedef struct {
    insole_real_t m2, rad2;
} insole_fusion_unknown_t;

/** All zero in the beginning. */
typedef struct {
    bool is_open;
    bool is_crossed;                     /**< the foot has stood since */
    uint64_t crossed_us;                 /**< since when */
    insole_fusion_unknown_t before, now; /**< at the last sample before it; at the newest */
} insole_fusion_gap_t;

/** The foot has gone on by a sample.
 *  @param fix  of the first order, m
 *  @return true while it is open; false for NULL too */
bool insole_fusion_gap_follow(insole_fusion_gap_t *gap, const insole_foot_tracker_t *foot,
                              const insole_fix_t *fix);

/** What has been lost in an open gap, >= 0; none in another. */
insole_fusion_unknown_t insole_fusion_gap_lost(const insole_fusion_gap_t *gap);

/** Adds what has been lost to a fix by the cloud that does not know of it. */
void insole_fusion_gap_widen(const insole_fusion_gap_t *gap, insole_fix_t *fix);

/** The cloud knows: from here on nothing is lost. */
void insole_fusion_gap_close(insole_fusion_gap_t *gap);

/** Whether the cloud is behind its walker: a gap is open, or more strides wait than may. */
static inline bool insole_fusion_gap_lags(const insole_fusion_gap_t *gap, uint32_t waiting,
                                          uint32_t most)
{
    return gap->is_open || waiting > most;
}

#ifdef __cplusplus
}
#endif

#endif
