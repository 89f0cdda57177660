/** @file ticks.h  A free-running 32-bit counter of any rate, unwrapped to microseconds.
 *
 *  Exact for as long as anyone walks: the fraction of a microsecond is carried, not rounded away.
 *  Must be asked at least once per wrap of the counter (e.g. every 25 s at 168 MHz).
 *
 *      insole_ticks_t clock;
 *      insole_ticks_init(&clock, 84000000u, TIM2->CNT);
 *      imu.t_us = insole_ticks_now_us(&clock, TIM2->CNT);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_TICKS_H
#define INSOLE_BASE_TICKS_H

#include <stdint.h>

#include "insole/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint32_t rate_hz;
    uint32_t last;      /**< counter value of the last call */
    uint32_t remainder; /**< numerator of the part of a microsecond not yet given out */
    uint64_t now_us;
} insole_ticks_t;

/** @return INSOLE_ERR_VALUE when `rate_hz` is 0 */
insole_status_t insole_ticks_init(insole_ticks_t *ticks, uint32_t rate_hz, uint32_t counter);

/** Whole microseconds since init; a counter that went "back" has wrapped once.
 *  @return 0 for NULL and for a clock that was never set up (all zero) */
uint64_t insole_ticks_now_us(insole_ticks_t *ticks, uint32_t counter);

#ifdef __cplusplus
}
#endif

#endif
