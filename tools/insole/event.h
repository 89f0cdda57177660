/** @file event.h  Something that happened on the way, as `--events` tells it.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_EVENT_H
#define INSOLE_HOST_EVENT_H

#include <stdint.h>

typedef enum {
    EVENT_STANCE,     /**< only the times are told */
    EVENT_STRIDE,     /**< from a stance to the next */
    EVENT_STEP,       /**< of a walker with a phone: times, length and heading */
    EVENT_START,      /**< of particles or a filter; of this and what follows only the time */
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
} event_t;

/** `stance`, `stride`, ... */
const char *event_name(event_kind_t kind);

#endif
