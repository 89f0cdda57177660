/* SPDX-License-Identifier: MIT */
#include "insole/sense/even_clock.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)

insole_status_t insole_even_clock_init(insole_even_clock_t *clock)
{
    if (!clock) {
        return INSOLE_ERR_NULL;
    }
    memset(clock, 0, sizeof *clock);
    return INSOLE_OK;
}

void insole_even_clock_restart(insole_even_clock_t *clock)
{
    if (clock) {
        clock->lead_us = ZERO;
    }
}

static void learn_period(insole_even_clock_t *clock, uint32_t dt_us)
{
    clock->span_us += dt_us;
    if (++clock->intervals == INSOLE_EVEN_CLOCK_INTERVALS) {
        clock->period_us =
            (insole_real_t)clock->span_us / (insole_real_t)INSOLE_EVEN_CLOCK_INTERVALS;
    }
}

insole_status_t insole_even_clock_tick(insole_even_clock_t *clock, uint32_t dt_us)
{
    if (!clock) {
        return INSOLE_ERR_NULL;
    }
    if (dt_us == 0u) {
        return INSOLE_ERR_VALUE;
    }
    if (!(clock->period_us > ZERO)) {
        learn_period(clock, dt_us);
        return INSOLE_ERR_STATE;
    }
    insole_even_clock_go_on(clock, dt_us);
    return INSOLE_OK;
}
