/** @file foot_smooth.h  The fixes of a foot tracker, seen from afterwards.
 *
 *  foot_tracker -> zupt_smooth -> the same fixes in the same order, better
 *
 *  Frames  m: as the tracker's fixes. What a start tells of the direction of the first two strides
 *          counts for all that follows it, not only for what follows them.
 *
 *      static insole_zupt_node_t nodes[4096];
 *      static insole_foot_past_t fixes[4096];
 *      static insole_foot_smooth_t past;
 *      insole_foot_smooth_init(&past, nodes, fixes, 4096);
 *      for each fix of insole_foot_tracker_next(&shoe, &fix):
 *          if (insole_foot_smooth_push(&past, &shoe, &fix) == INSOLE_ERR_ROOM) {
 *              insole_foot_smooth_run(&past, 2048);
 *              while (insole_foot_smooth_take(&past, &smoothed) == INSOLE_OK) use(&smoothed);
 *              insole_foot_smooth_push(&past, &shoe, &fix);
 *          }
 *      at the end: run(&past, 0) and take the rest.
 *
 *  Every fix that goes in comes out once. Those that no filter has made (before alignment, strides
 *  of the method pdr) come out as they were.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FOOT_SMOOTH_H
#define INSOLE_TRACK_FOOT_SMOOTH_H

#include "insole/move/zupt_smooth.h"
#include "insole/track/foot_tracker.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A fix that waits. */
typedef struct {
    insole_fix_t fix;
    insole_foot_anchor_t anchor; /**< as it was then */
    bool has_node;               /**< the filter's state of this moment is in the history */
} insole_foot_past_t;

typedef struct {
    insole_zupt_smooth_t history;
    insole_foot_past_t *fixes; /**< the caller's */
    insole_ring_t ring;
    uint32_t ready;              /**< running number after the newest fix that may be taken */
    insole_foot_anchor_t anchor; /**< newest */
} insole_foot_smooth_t;

/** An empty history in memory of the caller's, which must live as long as it.
 *  @param count  of both arrays; a power of two, 2 or more
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_foot_smooth_init(insole_foot_smooth_t *smooth, insole_zupt_node_t *nodes,
                                        insole_foot_past_t *fixes, uint32_t count);

/** Remembers a fix and the state that the tracker was in when it made it: call it before the next
 *  insole_foot_tracker_next.
 *  @return INSOLE_ERR_ROOM when all memory is in use */
insole_status_t insole_foot_smooth_push(insole_foot_smooth_t *smooth,
                                        const insole_foot_tracker_t *tracker,
                                        const insole_fix_t *fix);

/** Smooths all that is remembered and makes all but the newest `keep` fixes ready to be taken. */
insole_status_t insole_foot_smooth_run(insole_foot_smooth_t *smooth, uint32_t keep);

/** Takes the oldest fix: position and its variances are smoothed, the heading is the tracker's.
 *  @return INSOLE_ERR_STATE when none is ready */
insole_status_t insole_foot_smooth_take(insole_foot_smooth_t *smooth, insole_fix_t *fix);

#ifdef __cplusplus
}
#endif

#endif
