/* SPDX-License-Identifier: MIT */
#include "insole/base/config.h"

static bool is_in_range(const void *setting, const insole_config_range_t *range)
{
    insole_real_t value = range->is_whole ? (insole_real_t) * (const int32_t *)setting
                                          : *(const insole_real_t *)setting;
    return value >= range->low && value <= range->high;
}

INSOLE_COLD insole_status_t insole_config_check(const void *config,
                                                const insole_config_range_t *ranges, size_t count)
{
    if (!config || !ranges) {
        return INSOLE_ERR_NULL;
    }
    for (size_t i = 0u; i < count; i++) {
        if (!is_in_range((const char *)config + ranges[i].offset, &ranges[i])) {
            return INSOLE_ERR_VALUE;
        }
    }
    return INSOLE_OK;
}
