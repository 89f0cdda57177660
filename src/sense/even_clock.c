/* SPDX-License-Identifier: MIT */
#include "insole/sense/even_clock.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

/* Gains of phase and period per sample. */
static const insole_real_t PHASE_GAIN = INSOLE_R(0.05);
static const insole_real_t PERIOD_GAIN = INSOLE_R(0.0006);

/* A shorter interval makes a burst: the stamp was read late, with its successor. */
static const insole_real_t BURST_INTERVAL_SHARE = INSOLE_R(0.75);
static const insole_real_t BURST_WEIGHT = INSOLE_R(0.01);

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

/* The clock ticks on by its period and is drawn towards the stamp that came. */
static void tick(insole_even_clock_t *clock, insole_real_t dt_us)
{
    insole_real_t error_us = dt_us - clock->period_us - clock->lead_us; /* raw less expected */
    bool too_soon = dt_us < BURST_INTERVAL_SHARE * clock->period_us;
    clock->burst_share += BURST_WEIGHT * ((too_soon ? ONE : ZERO) - clock->burst_share);
    if (insole_abs(error_us) > (insole_real_t)INSOLE_EVEN_CLOCK_REACH_US) {
        clock->lead_us = ZERO;
        return;
    }
    clock->lead_us = -(ONE - PHASE_GAIN) * error_us;
    clock->period_us += PERIOD_GAIN * error_us;
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
    tick(clock, (insole_real_t)dt_us);
    return INSOLE_OK;
}
