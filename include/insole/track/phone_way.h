/** @file phone_way.h  The way a walker with a phone has gone, step by step, and when.
 *
 *  Frames  n: level, that of the attitude.
 *
 *  Steps become known late: the first of a walk wait until there is a rhythm. So the direction of
 *  each sample is kept for a while, and a step has the mean of its own time. And a scan speaks of
 *  the place where it was heard, so the way of the last steps is kept, too.
 *
 *      static insole_phone_way_t way;
 *      insole_phone_way_init(&way);
 *      on each sample:     insole_phone_way_face(&way, t_us, heading.ahead);
 *      on each footfall:   insole_phone_way_direction(&way, &footfall, &direction_rad);
 *                          insole_phone_way_go(&way, &footfall, displacement);
 *      on each scan:       since = insole_phone_way_since(&way, heard_us);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_PHONE_WAY_H
#define INSOLE_TRACK_PHONE_WAY_H

#include "insole/base/ring.h"
#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    INSOLE_PHONE_WAY_SLOTS = 64,       /**< directions that are kept */
    INSOLE_PHONE_WAY_SLOT_US = 100000, /**< each is the mean over so long */
    INSOLE_PHONE_WAY_STEPS = 16        /**< steps that are kept */
};

/** One step. */
typedef struct {
    uint64_t begin_us, end_us;
    insole_spot_t way; /**< n */
} insole_phone_way_step_t;

typedef struct {
    insole_turn_t ahead[INSOLE_PHONE_WAY_SLOTS]; /**< sums of unit vectors; 0, 0: none came */
    uint64_t slot;                               /**< number of the newest, counted from time 0 */
    uint64_t first_slot;
    insole_ring_t ring;
    insole_phone_way_step_t steps[INSOLE_PHONE_WAY_STEPS];
} insole_phone_way_t;

/** @return INSOLE_ERR_NULL */
insole_status_t insole_phone_way_init(insole_phone_way_t *way);

/** The direction of one moment, n. A time before the newest counts as that.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for what is not finite or longer than 2 */
insole_status_t insole_phone_way_face(insole_phone_way_t *way, uint64_t t_us, insole_turn_t ahead);

/** Mean direction over the time of a footfall; of the nearest kept one when that is too long ago.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_STATE before there is any */
insole_status_t insole_phone_way_direction(const insole_phone_way_t *way,
                                           const insole_footfall_t *footfall,
                                           insole_real_t *direction_rad);

/** One step was made.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_TIME when it does not end after it began;
 *          INSOLE_ERR_VALUE for a way that is not finite */
insole_status_t insole_phone_way_go(insole_phone_way_t *way, const insole_footfall_t *footfall,
                                    insole_spot_t displacement);

/** How much of a step lies before a time: 0 .. 1. */
insole_real_t insole_phone_way_share(const insole_footfall_t *footfall, uint64_t t_us);

/** The way of the steps kept that was walked after a time, n; steps count evenly. */
insole_spot_t insole_phone_way_since(const insole_phone_way_t *way, uint64_t t_us);

/** Whether all steps since that time are kept. */
bool insole_phone_way_reaches(const insole_phone_way_t *way, uint64_t t_us);

#ifdef __cplusplus
}
#endif

#endif
