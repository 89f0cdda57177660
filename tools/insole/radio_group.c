/* SPDX-License-Identifier: MIT */
#include "radio_group.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "memory.h"

bool radio_group_is_empty(const radio_group_t *group)
{
    return group->rss_count + group->range_count == 0u;
}

bool radio_group_ends(const radio_group_t *group, const record_t *record)
{
    return !radio_group_is_empty(group) && record->t_us != group->t_us;
}

static uint32_t to_age_us(double age_s)
{
    double age_us = isnan(age_s) ? 0.0 : 1e6 * age_s;
    return age_us < (double)UINT32_MAX ? (uint32_t)age_us : UINT32_MAX;
}

/* Ages stay relative to the youngest reading so far. */
static void add_rss(radio_group_t *group, const record_t *record)
{
    uint32_t age_us = to_age_us(record->value[1]);
    uint32_t youngest_us =
        group->rss_count == 0u || age_us < group->age_us ? age_us : group->age_us;
    for (size_t i = 0u; i < group->rss_count; i++) {
        group->rss[i].age_us += group->age_us - youngest_us;
    }
    group->age_us = youngest_us;
    group->rss =
        memory_room(group->rss, &group->rss_room, group->rss_count + 1u, sizeof *group->rss);
    insole_rss_t reading = {record->id, to_real(record->value[0]), age_us - youngest_us};
    group->rss[group->rss_count++] = reading;
}

static void add_range(radio_group_t *group, const record_t *record)
{
    double sigma_m = record->value[1];
    insole_range_t range = {0u, record->id, to_real(record->value[0]),
                            isnan(sigma_m) ? INSOLE_R(0.0) : to_real(sigma_m)};
    group->range = memory_room(group->range, &group->range_room, group->range_count + 1u,
                               sizeof *group->range);
    group->range[group->range_count++] = range;
}

void radio_group_add(radio_group_t *group, const record_t *record)
{
    group->t_us = record->t_us;
    if (record->kind == RECORD_RSS) {
        add_rss(group, record);
    } else {
        add_range(group, record);
    }
}

void radio_group_clear(radio_group_t *group)
{
    group->rss_count = group->range_count = 0u;
    group->age_us = 0u;
}

void radio_group_free(radio_group_t *group)
{
    free(group->rss);
    free(group->range);
    memset(group, 0, sizeof *group);
}
