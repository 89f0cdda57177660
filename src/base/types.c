/* SPDX-License-Identifier: MIT */
#include "insole/base/types.h"

insole_real_t insole_seconds(uint64_t from_us, uint64_t to_us)
{
    uint64_t us = to_us - from_us; /* in halves, each of which a processor converts */
    insole_real_t most_us = (insole_real_t)(uint32_t)(us >> 32) * INSOLE_R(4294967296.0);
    return (most_us + (insole_real_t)(uint32_t)us) * INSOLE_R(1.0e-6);
}
