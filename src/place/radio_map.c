/* SPDX-License-Identifier: MIT */
#include "insole/place/radio_map.h"

#include <stddef.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)

static bool has_tables(const insole_radio_map_t *map)
{
    return map->spots && map->first && map->aps && map->below;
}

/* Entries of one point: ascending access points, heard no more often than the point was visited. */
static bool is_point_sound(const insole_radio_map_t *map, uint32_t point)
{
    uint32_t end = map->first[point + 1u];
    for (uint32_t i = map->first[point]; i < end; i++) {
        bool ascends = i == map->first[point] || map->aps[i] > map->aps[i - 1u];
        bool counted = !map->counts || map->counts[i] > 0u;
        bool within = !map->counts || !map->visits || map->counts[i] <= map->visits[point];
        if (!ascends || !counted || !within || map->aps[i] >= map->ap_count) {
            return false;
        }
    }
    return insole_spot_is_finite(map->spots[point]);
}

insole_status_t insole_radio_map_check(const insole_radio_map_t *map)
{
    if (!map || !has_tables(map)) {
        return INSOLE_ERR_NULL;
    }
    if (map->point_count == 0u || map->ap_count > (uint32_t)INSOLE_RADIO_APS_MAX ||
        map->first[0] != 0u) {
        return INSOLE_ERR_DATA;
    }
    for (uint32_t i = 0; i < map->point_count; i++) {
        if (map->first[i + 1u] < map->first[i] || !is_point_sound(map, i)) {
            return INSOLE_ERR_DATA;
        }
    }
    return INSOLE_OK;
}

bool insole_radio_map_find(const insole_radio_map_t *map, uint32_t point, uint32_t ap,
                           uint32_t *entry)
{
    if (!map || !entry || point >= map->point_count) {
        return false;
    }
    uint32_t low = map->first[point], end = map->first[point + 1u], high = end;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2u;
        if (map->aps[middle] < ap) {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    if (low == end || map->aps[low] != ap) {
        return false;
    }
    *entry = low;
    return true;
}

bool insole_radio_map_trusts(const insole_trusted_area_t *area, insole_spot_t spot)
{
    if (!area) {
        return true;
    }
    insole_real_t x_m = spot.x_m - area->centre.x_m, y_m = spot.y_m - area->centre.y_m;
    return insole_sqrt(x_m * x_m + y_m * y_m) <=
           area->radius_m; /* [PhoneEKF (28)] [PhoneUKF (37)] */
}

insole_status_t insole_trusted_area_check(const insole_trusted_area_t *area)
{
    if (!area) {
        return INSOLE_ERR_NULL;
    }
    bool sound = insole_spot_is_finite(area->centre) && insole_is_finite(area->radius_m) &&
                 area->radius_m > ZERO;
    return sound ? INSOLE_OK : INSOLE_ERR_VALUE;
}

insole_status_t insole_trusted_area_around(insole_spot_t last, insole_real_t var_x_m2,
                                           insole_real_t cov_xy_m2, insole_real_t var_y_m2,
                                           insole_real_t sigmas, insole_real_t way_m,
                                           insole_trusted_area_t *area)
{
    if (!area) {
        return INSOLE_ERR_NULL;
    }
    insole_real_t half_sum = HALF * (var_x_m2 + var_y_m2);
    insole_real_t half_gap = HALF * (var_x_m2 - var_y_m2);
    insole_real_t tilt = insole_sqrt(half_gap * half_gap + cov_xy_m2 * cov_xy_m2);
    insole_trusted_area_t asked = {last, sigmas * insole_sqrt(half_sum + tilt) + way_m};
    bool covariance =
        var_x_m2 >= ZERO && var_y_m2 >= ZERO && cov_xy_m2 * cov_xy_m2 <= var_x_m2 * var_y_m2;
    insole_status_t status = insole_trusted_area_check(&asked);
    if (status != INSOLE_OK || !covariance || !(sigmas >= ZERO) || !(way_m >= ZERO)) {
        return INSOLE_ERR_VALUE;
    }
    *area = asked;
    return INSOLE_OK;
}
