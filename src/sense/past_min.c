/* SPDX-License-Identifier: MIT */
#include "insole/sense/past_min.h"

#include <string.h>

insole_status_t insole_past_min_init(insole_past_min_t *past, uint32_t reach_us)
{
    if (!past) {
        return INSOLE_ERR_NULL;
    }
    if (reach_us < INSOLE_PAST_BLOCKS - 1u) {
        return INSOLE_ERR_VALUE;
    }
    memset(past, 0, sizeof *past);
    past->block_us = reach_us / (INSOLE_PAST_BLOCKS - 1u);
    for (uint32_t i = 0u; i < INSOLE_PAST_BLOCKS; i++) {
        past->least[i] = INSOLE_REAL_MAX;
    }
    return INSOLE_OK;
}

insole_real_t insole_past_min(const insole_past_min_t *past)
{
    insole_real_t least = INSOLE_REAL_MAX;
    for (uint32_t i = 0u; past && i < INSOLE_PAST_BLOCKS; i++) {
        least = insole_min(least, past->least[i]);
    }
    return least;
}

void insole_past_min_move_on(insole_past_min_t *past, uint32_t t_us)
{
    if (!past) {
        return;
    }
    for (uint32_t i = 0u; i < INSOLE_PAST_BLOCKS && t_us - past->began_us >= past->block_us; i++) {
        past->began_us += past->block_us;
        past->at = (past->at + 1u) % INSOLE_PAST_BLOCKS;
        past->least[past->at] = INSOLE_REAL_MAX;
    }
    if (t_us - past->began_us >= past->block_us) {
        past->began_us = t_us; /* after a gap */
    }
}
