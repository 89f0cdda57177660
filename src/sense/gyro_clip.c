/* SPDX-License-Identifier: MIT */
#include "insole/sense/gyro_clip.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

/* No gyro for people has a wider range. */
static const insole_real_t WIDEST_RADPS = INSOLE_R(100.0);
static const insole_real_t LEAST_SHARE = INSOLE_R(0.5);

/* A peak counts from this size on; it is near its top above the one share of it and has fallen
 * below the other. Cut off is one that stays for so long, and so many times as long as it falls. */
static const insole_real_t PEAK_FROM_RADPS = INSOLE_R(7.0);
static const insole_real_t TOP_SHARE = INSOLE_R(0.97);
static const insole_real_t FOOT_SHARE = INSOLE_R(0.8);
static const insole_real_t LEAST_TOP_US = INSOLE_R(20000.0);
static const insole_real_t TOP_PER_FALL = INSOLE_R(3.0);

/* A top that some rate exceeds by this factor is none of the sensor's. */
static const insole_real_t DISPROOF = INSOLE_R(1.2);

/* Slower rates are no peak, tell nothing of the range and do not reach its end. */
static insole_real_t quiet_square(const insole_gyro_clip_t *clip)
{
    insole_real_t end = clip->share * clip->range_radps;
    return insole_square(end > ZERO ? insole_min(end, PEAK_FROM_RADPS) : PEAK_FROM_RADPS);
}

INSOLE_COLD insole_status_t insole_gyro_clip_init(insole_gyro_clip_t *clip,
                                                  insole_real_t range_radps, insole_real_t share)
{
    if (!clip) {
        return INSOLE_ERR_NULL;
    }
    if (!(range_radps >= ZERO && range_radps <= WIDEST_RADPS && share >= LEAST_SHARE &&
          share <= ONE)) {
        return INSOLE_ERR_VALUE;
    }
    memset(clip, 0, sizeof *clip);
    clip->told_radps = clip->range_radps = range_radps;
    clip->share = share;
    clip->quiet_radps2 = quiet_square(clip);
    return INSOLE_OK;
}

/* Share of an interval that lies above `level`, which is crossed on the way from `high` to `low`,
 * up or down. */
static insole_real_t share_above(insole_real_t level, insole_real_t high, insole_real_t low)
{
    insole_real_t span = high - low;
    return span > ZERO ? insole_min((high - level) / span, ONE) : ONE;
}

/* Time spent near the top and on the way down from it, up to the crossing of the foot. */
static void time_peak(insole_clip_peak_t *peak, insole_real_t size, insole_real_t dt_us)
{
    insole_real_t top = TOP_SHARE * peak->top_radps, foot = FOOT_SHARE * peak->top_radps;
    insole_real_t last = peak->last_radps;
    if (size >= top) {
        peak->top_us += dt_us + peak->fall_us;
        peak->fall_us = ZERO;
        return;
    }
    insole_real_t near_top = last >= top ? share_above(top, last, size) : ZERO;
    insole_real_t above_foot = size >= foot ? ONE : share_above(foot, last, size);
    peak->top_us += near_top * dt_us;
    peak->fall_us += (above_foot - near_top) * dt_us;
}

/* Follows one axis; true when the peak that it comes down from turns out to have been cut off. */
static bool was_cut_off(insole_clip_peak_t *peak, insole_real_t size, insole_real_t dt_us)
{
    bool cut = false;
    if (size > insole_max(peak->top_radps / TOP_SHARE, PEAK_FROM_RADPS)) {
        peak->top_radps = size;
        peak->top_us = dt_us * share_above(TOP_SHARE * size, size, peak->last_radps);
        peak->fall_us = ZERO;
    } else if (peak->top_radps > ZERO) {
        time_peak(peak, size, dt_us);
        if (size < FOOT_SHARE * peak->top_radps) {
            cut = peak->top_us >= LEAST_TOP_US && peak->top_us >= TOP_PER_FALL * peak->fall_us;
            peak->top_radps = ZERO;
        }
    }
    return cut;
}

/* The range is the largest top that was cut off and that no rate has gone far beyond. */
static void learn_range(insole_gyro_clip_t *clip, insole_real_t lasting, insole_real_t cut_off_at)
{
    if (lasting > clip->largest_radps || cut_off_at > clip->range_radps) {
        clip->largest_radps = insole_max(clip->largest_radps, lasting);
        clip->range_radps = insole_max(clip->range_radps, cut_off_at);
        if (DISPROOF * clip->range_radps < clip->largest_radps) {
            clip->range_radps = ZERO;
        }
    }
}

static bool is_clipped(insole_gyro_clip_t *clip, uint32_t axis, insole_real_t rate,
                       insole_real_t dt_us)
{
    insole_clip_peak_t *peak = &clip->peak[axis];
    insole_real_t size = insole_abs(rate), cut_off_at = ZERO;
    insole_real_t lasting = insole_min(size, peak->last_radps); /* one sample alone is a spike */
    if (size > PEAK_FROM_RADPS || peak->top_radps > ZERO) {
        insole_real_t top = peak->top_radps;
        cut_off_at = was_cut_off(peak, size, dt_us) ? top : ZERO;
    }
    peak->last_radps = size;
    if (!(clip->told_radps > ZERO)) {
        learn_range(clip, lasting, cut_off_at);
    }
    return clip->range_radps > ZERO && size >= clip->share * clip->range_radps;
}

static uint8_t follow(insole_gyro_clip_t *clip, insole_vec3_t gyro, insole_real_t dt_us)
{
    bool x = is_clipped(clip, 0u, gyro.x, dt_us);
    bool y = is_clipped(clip, 1u, gyro.y, dt_us);
    bool z = is_clipped(clip, 2u, gyro.z, dt_us);
    const insole_clip_peak_t *peak = clip->peak;
    bool in_peak = peak[0].top_radps > ZERO || peak[1].top_radps > ZERO || peak[2].top_radps > ZERO;
    clip->quiet_radps2 = in_peak ? ZERO : quiet_square(clip);
    return (uint8_t)((x ? 1u : 0u) | (y ? 2u : 0u) | (z ? 4u : 0u));
}

insole_status_t insole_gyro_clip_push(insole_gyro_clip_t *clip, insole_vec3_t gyro_radps,
                                      insole_real_t dt_us, uint8_t *axes)
{
    if (!clip || !axes) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_vec3_is_finite(gyro_radps) || !(dt_us >= ZERO && dt_us <= INSOLE_REAL_MAX)) {
        return INSOLE_ERR_VALUE;
    }
    if (!(dt_us > ZERO)) {
        static const insole_clip_peak_t none;
        clip->peak[0] = clip->peak[1] = clip->peak[2] = none;
        clip->quiet_radps2 = quiet_square(clip);
    }
    *axes = 0u;
    if (insole_gyro_clip_is_quiet(clip, &gyro_radps)) {
        insole_gyro_clip_remember(clip, &gyro_radps);
    } else {
        *axes = follow(clip, gyro_radps, dt_us);
    }
    return INSOLE_OK;
}
