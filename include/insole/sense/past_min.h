/** @file past_min.h  The smallest value of the last while, kept in blocks of time.
 *
 *      static insole_past_min_t past;
 *      insole_past_min_init(&past, reach_us);
 *      on each sample:
 *          if (value <= insole_past_min(&past)) it is the smallest over the reach;
 *          insole_past_min_push(&past, t_us, value);
 *
 *  Stamps are the low halves of 64 bits; what is older than the reach is forgotten a block at a
 *  time.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_PAST_MIN_H
#define INSOLE_SENSE_PAST_MIN_H

#include "insole/base/real.h"
#include "insole/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_PAST_BLOCKS = 8 /**< one more than fill the reach */ };

typedef struct {
    uint32_t block_us;
    uint32_t began_us;                       /**< time at which the block being filled began */
    uint32_t at;                             /**< its index */
    insole_real_t least[INSOLE_PAST_BLOCKS]; /**< INSOLE_REAL_MAX: empty */
} insole_past_min_t;

/** @param reach_us  seven microseconds or more
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_past_min_init(insole_past_min_t *past, uint32_t reach_us);

/** INSOLE_REAL_MAX when there is nothing, or no `past`. */
insole_real_t insole_past_min(const insole_past_min_t *past);

/** The block being filled is over: the one of `t_us` begins. Done by insole_past_min_push. */
void insole_past_min_move_on(insole_past_min_t *past, uint32_t t_us);

/** @param t_us  not before that of the last push */
static inline void insole_past_min_push(insole_past_min_t *past, uint32_t t_us, insole_real_t value)
{
    if (t_us - past->began_us >= past->block_us) {
        insole_past_min_move_on(past, t_us);
    }
    if (value < past->least[past->at]) {
        past->least[past->at] = value;
    }
}

#ifdef __cplusplus
}
#endif

#endif
