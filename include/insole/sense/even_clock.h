/** @file even_clock.h  A sensor's own clock, followed through the jitter of the stamps.
 *
 *  Stamps that tell when a burst was read, and not when its samples were taken, lie before or
 * behind the ticks of an even clock. It learns its period from the first intervals and is then
 * drawn a little towards every stamp.
 *
 *      static insole_even_clock_t clock;
 *      insole_even_clock_init(&clock);
 *      on each interval between two stamps:
 *          if (insole_even_clock_tick(&clock, dt_us) == INSOLE_OK && clock.burst_share > share)
 *              t_us += (int32_t)clock.lead_us;
 *      where samples are missing:
 *          insole_even_clock_restart(&clock);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_EVEN_CLOCK_H
#define INSOLE_SENSE_EVEN_CLOCK_H

#include "insole/base/real.h"
#include "insole/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    INSOLE_EVEN_CLOCK_INTERVALS = 20,  /**< from which the period is learned */
    INSOLE_EVEN_CLOCK_REACH_US = 30000 /**< of the lead; a stamp farther off starts it anew */
};

typedef struct {
    insole_real_t period_us;     /**< 0 until known */
    insole_real_t lead_us;       /**< of the even stamp over the raw one */
    insole_real_t burst_share;   /**< running share of stamps that follow too soon */
    uint32_t intervals, span_us; /**< the first ones, from which the period is found */
} insole_even_clock_t;

/** @return INSOLE_ERR_NULL */
insole_status_t insole_even_clock_init(insole_even_clock_t *clock);

/** @param dt_us  since the stamp before, > 0
 *  @return INSOLE_ERR_STATE while the period is being learned; INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_even_clock_tick(insole_even_clock_t *clock, uint32_t dt_us);

/** The same for a clock that knows its period, for dt_us > 0. Nothing is checked. */
static inline void insole_even_clock_go_on(insole_even_clock_t *clock, uint32_t dt_us)
{
    const insole_real_t phase_gain = INSOLE_R(0.05),
                        period_gain = INSOLE_R(0.0006); /* per sample */
    const insole_real_t burst_interval_share = INSOLE_R(0.75), burst_weight = INSOLE_R(0.01);
    insole_real_t dt = (insole_real_t)dt_us, period = clock->period_us, none = INSOLE_R(0.0);
    insole_real_t error_us = dt - period - clock->lead_us; /* raw less expected */
    insole_real_t too_soon = dt < burst_interval_share * period ? INSOLE_R(1.0) : none;
    clock->burst_share += burst_weight * (too_soon - clock->burst_share);
    if (insole_abs(error_us) > (insole_real_t)INSOLE_EVEN_CLOCK_REACH_US) {
        clock->lead_us = none;
        return;
    }
    clock->lead_us = -(INSOLE_R(1.0) - phase_gain) * error_us;
    clock->period_us = period + period_gain * error_us;
}

/** The next stamp is right. */
void insole_even_clock_restart(insole_even_clock_t *clock);

#ifdef __cplusplus
}
#endif

#endif
