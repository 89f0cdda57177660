/* SPDX-License-Identifier: MIT */
#include "foot_events.h"

#include <math.h>
#include <string.h>

#include "convert.h"

static event_t *add(foot_events_t *events, event_kind_t kind, int64_t begin_us, int64_t end_us)
{
    event_t *event = &events->waiting[events->count++];
    memset(event, 0, sizeof *event);
    event->kind = kind;
    event->begin_us = begin_us;
    event->end_us = end_us;
    return event;
}

/* A stance has ended when the foot no longer stands as it did at the fix before. */
static void watch_stance(foot_events_t *events, bool is_still, int64_t t_us)
{
    if (is_still && !events->is_still) {
        events->stance_begin_us = t_us;
    }
    if (!is_still && events->is_still) {
        (void)add(events, EVENT_STANCE, events->stance_begin_us, events->fix_us);
    }
    events->is_still = is_still;
}

/* From directions in n to directions in m. */
static double turn_to_map(const insole_foot_fusion_t *fusion)
{
    return (double)(fusion->particles.has_fix ? fusion->particles.fix.offset_rad
                                              : fusion->foot.anchor.yaw_rad);
}

static void watch_stride(foot_events_t *events, const insole_foot_fusion_t *fusion)
{
    const insole_stride_t *stride = &fusion->foot.stride;
    if (stride->end_us == events->stride_us) {
        return;
    }
    events->stride_us = stride->end_us;
    event_t *event =
        add(events, EVENT_STRIDE, to_log_us(stride->begin_us), to_log_us(stride->end_us));
    event->length_m = (double)stride->length_m;
    event->height_m = (double)stride->displacement_m.z;
    event->heading_rad =
        remainder((double)stride->heading_rad + turn_to_map(fusion), 6.283185307179586);
    event->turn_rad = (double)stride->turn_rad;
    event->model_length_m = (double)stride->model_length_m;
    event->accel_min_mps2 = (double)stride->accel_min_mps2;
    event->accel_max_mps2 = (double)stride->accel_max_mps2;
}

static void watch_cloud(foot_events_t *events, const insole_foot_fusion_t *fusion, foot_news_t news,
                        int64_t t_us)
{
    const insole_particle_counts_t *now = &fusion->particles.counts, *before = &events->before;
    const bool happened[EVENT_KINDS] = {[EVENT_START] = fusion->counts.starts != events->starts,
                                        [EVENT_SCAN] = news.has_scan,
                                        [EVENT_RANGES] = news.has_ranges,
                                        [EVENT_RESAMPLING] = now->resampled != before->resampled,
                                        [EVENT_REDRAW] = now->redrawn != before->redrawn,
                                        [EVENT_RECOVERY] = now->recovered != before->recovered};
    for (int kind = EVENT_START; kind < EVENT_KINDS; kind++) {
        if (happened[kind]) {
            (void)add(events, (event_kind_t)kind, t_us, t_us);
        }
    }
    events->starts = fusion->counts.starts;
    events->before = *now;
}

/* Work that is not the drawing of a start begins with news. */
foot_news_t foot_events_news(const insole_foot_fusion_t *fusion, uint32_t starts)
{
    bool begun = fusion->working && fusion->counts.starts == starts;
    const insole_evidence_t *told = &fusion->particles.weighing.news;
    foot_news_t news = {begun && told->has_scan, begun && told->ranges > 0u};
    return news;
}

void foot_events_watch(foot_events_t *events, const insole_foot_fusion_t *fusion, foot_news_t news,
                       int64_t t_us)
{
    events->count = events->taken = 0;
    watch_stance(events, fusion->foot.was_still, t_us);
    watch_stride(events, fusion);
    watch_cloud(events, fusion, news, t_us);
    events->fix_us = t_us;
}

bool foot_events_take(foot_events_t *events, event_t *event)
{
    if (events->taken == events->count) {
        return false;
    }
    *event = events->waiting[events->taken++];
    return true;
}
