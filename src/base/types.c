/* SPDX-License-Identifier: MIT */
#include "insole/base/types.h"

insole_real_t insole_seconds(uint64_t from_us, uint64_t to_us)
{
    return insole_seconds_of(to_us - from_us);
}
