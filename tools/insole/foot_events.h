/** @file foot_events.h  What happened to the foot and to the cloud, found by watching the tracker.
 *
 *      foot_news_t news = foot_events_news(&fusion, starts);      the particles have not worked
 *      foot_events_watch(&events, &fusion, news, t_us);           now they have
 *      while (foot_events_take(&events, &event)) ...
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_FOOT_EVENTS_H
#define INSOLE_HOST_FOOT_EVENTS_H

#include "event.h"
#include "insole/track/foot_fusion.h"

/** What the particles are told besides strides. */
typedef struct {
    bool has_scan, has_ranges;
} foot_news_t;

/** All zeros before the first fix. */
typedef struct {
    event_t waiting[EVENT_KINDS];
    int count, taken;
    int64_t fix_us, stance_begin_us;
    bool is_still;
    uint64_t stride_us;              /**< end of the last stride */
    uint32_t starts;                 /**< of the particles, so far */
    insole_particle_counts_t before; /**< as of the last fix */
} foot_events_t;

/** What the particles have been handed with the fix just made, as seen before they work.
 *  @param starts  number of starts before that fix */
foot_news_t foot_events_news(const insole_foot_fusion_t *fusion, uint32_t starts);

/** The tracker has made a fix, and the particles have done their work.
 *  @param fusion  of methods of the first order only its `foot` is looked at */
void foot_events_watch(foot_events_t *events, const insole_foot_fusion_t *fusion, foot_news_t news,
                       int64_t t_us);

bool foot_events_take(foot_events_t *events, event_t *event);

#endif
