/* SPDX-License-Identifier: MIT */
#include "insole/base/ticks.h"

#include <stddef.h>

static const uint32_t US_PER_S = 1000000u;

insole_status_t insole_ticks_init(insole_ticks_t *ticks, uint32_t rate_hz, uint32_t counter)
{
    if (ticks == NULL) {
        return INSOLE_ERR_NULL;
    }
    if (rate_hz == 0u) {
        return INSOLE_ERR_VALUE;
    }
    ticks->rate_hz = rate_hz;
    ticks->last = counter;
    ticks->remainder = 0u;
    ticks->now_us = 0u;
    return INSOLE_OK;
}

uint64_t insole_ticks_now_us(insole_ticks_t *ticks, uint32_t counter)
{
    if (ticks == NULL || ticks->rate_hz == 0u) {
        return 0u;
    }
    /* below 2^32 (10^6 + 1), far from the end of 64 bits */
    uint64_t parts = (uint64_t)(uint32_t)(counter - ticks->last) * US_PER_S + ticks->remainder;
    uint64_t elapsed_us = parts / ticks->rate_hz;
    ticks->last = counter;
    ticks->remainder = (uint32_t)(parts - elapsed_us * ticks->rate_hz);
    ticks->now_us += elapsed_us;
    return ticks->now_us;
}
