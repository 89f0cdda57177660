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

#include "insole/track/foot_fusion.h"

typedef enum {
    EVENT_STANCE,     /**< only the times are told */
    EVENT_STRIDE,     /**< from a stance to the next */
    EVENT_START,      /**< the particles were drawn; of this and what follows only the time */
    EVENT_SCAN,       /**< signal strengths were worked in */
    EVENT_RANGES,     /**< ranges were, or that of the strongest access point [TwoOrder (39)] */
    EVENT_RESAMPLING, /**< of the particles */
    EVENT_REDRAW,     /**< a share of them was drawn where scans point */
    EVENT_RECOVERY,   /**< all had died */
    EVENT_KINDS
} event_kind_t;

typedef struct {
    int64_t begin_us, end_us;
    event_kind_t kind;
    double length_m;       /**< horizontal */
    double height_m;       /**< climbed */
    double heading_rad;    /**< direction, m */
    double turn_rad;       /**< of the foot */
    double model_length_m; /**< by [TwoOrder (33)] */
    double accel_min_mps2, accel_max_mps2;
} foot_event_t;

/** What the particles are told besides strides. */
typedef struct {
    bool has_scan, has_ranges;
} foot_news_t;

/** All zeros before the first fix. */
typedef struct {
    foot_event_t waiting[EVENT_KINDS];
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

bool foot_events_take(foot_events_t *events, foot_event_t *event);

/** `stance`, `stride`, ... */
const char *foot_event_name(event_kind_t kind);

#endif
