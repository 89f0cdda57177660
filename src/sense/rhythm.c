/* SPDX-License-Identifier: MIT */
#include "insole/sense/rhythm.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

static const insole_real_t LARGEST = INSOLE_R(1.0e6); /* its square, summed, is finite */

insole_status_t insole_rhythm_init(insole_rhythm_t *rhythm)
{
    if (!rhythm) {
        return INSOLE_ERR_NULL;
    }
    memset(rhythm, 0, sizeof *rhythm);
    return INSOLE_OK;
}

static void begin(insole_rhythm_t *rhythm, uint64_t t_us)
{
    for (uint32_t i = 0u; i < INSOLE_RHYTHM_PAST; i++) {
        rhythm->past[i] = ZERO;
    }
    rhythm->grid_us = t_us;
    rhythm->has_time = true;
}

/* Grid points up to the new sample, on the line from the last sample to it. */
static void fill_grid(insole_rhythm_t *rhythm, uint64_t t_us, insole_real_t value)
{
    insole_real_t slope = (value - rhythm->newest) / (insole_real_t)(uint32_t)(t_us - rhythm->t_us);
    while (t_us - rhythm->grid_us >= INSOLE_RHYTHM_GRID_US) {
        rhythm->grid_us += INSOLE_RHYTHM_GRID_US;
        rhythm->past[rhythm->end++ % INSOLE_RHYTHM_PAST] =
            value - slope * (insole_real_t)(uint32_t)(t_us - rhythm->grid_us);
    }
}

insole_status_t insole_rhythm_push(insole_rhythm_t *rhythm, uint64_t t_us, insole_real_t value)
{
    if (!rhythm) {
        return INSOLE_ERR_NULL;
    }
    if (!(insole_abs(value) <= LARGEST)) {
        rhythm->refused++;
        return INSOLE_ERR_VALUE;
    }
    if (rhythm->has_time && t_us <= rhythm->t_us) {
        rhythm->refused++;
        return INSOLE_ERR_TIME;
    }
    if (!rhythm->has_time || t_us - rhythm->t_us > INSOLE_RHYTHM_GAP_US) {
        begin(rhythm, t_us);
    } else {
        fill_grid(rhythm, t_us, value);
    }
    rhythm->t_us = t_us;
    rhythm->newest = value;
    return INSOLE_OK;
}

/* Of the newest window and the one `lag` grid points before it. */
static insole_real_t likeness_at(const insole_rhythm_t *rhythm, uint32_t lag)
{
    insole_real_t product = ZERO, power = ZERO;
    for (uint32_t i = 1u; i <= INSOLE_RHYTHM_WINDOW; i++) {
        insole_real_t a = rhythm->past[(rhythm->end - i) % INSOLE_RHYTHM_PAST];
        insole_real_t b = rhythm->past[(rhythm->end - i - lag) % INSOLE_RHYTHM_PAST];
        product += a * b;
        power += a * a + b * b;
    }
    return power > ZERO ? insole_min(INSOLE_R(2.0) * product / power, ONE) : ZERO;
}

INSOLE_COLD insole_status_t insole_rhythm_likeness(const insole_rhythm_t *rhythm, uint64_t lag_us,
                                                   insole_real_t *likeness)
{
    if (!rhythm || !likeness) {
        return INSOLE_ERR_NULL;
    }
    if (lag_us < INSOLE_RHYTHM_FIRST_US || lag_us > INSOLE_RHYTHM_LAST_US) {
        return INSOLE_ERR_VALUE;
    }
    uint32_t lag = (uint32_t)lag_us / INSOLE_RHYTHM_GRID_US;
    *likeness = insole_max(likeness_at(rhythm, lag), likeness_at(rhythm, lag + 1u));
    return INSOLE_OK;
}
