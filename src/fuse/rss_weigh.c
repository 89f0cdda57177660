/* SPDX-License-Identifier: MIT */
#include "insole/fuse/rss_weigh.h"

#include <stddef.h>

/* Two scans at one place differ by more: nearer than this counts as this. */
#define LEAST_DB2 INSOLE_R(1.0)

#define UNHEARD_MIN_DBM INSOLE_R(-127.0)
#define AGE_MAX_S       INSOLE_R(3.5)

insole_status_t insole_rss_weigh_begin(insole_rss_weigh_t *rss, const insole_radio_map_t *map,
                                       insole_real_t *log_weights, uint32_t room,
                                       insole_real_t unheard_dbm, const insole_rss_t *readings,
                                       uint32_t count)
{
    if (!rss || !map || !log_weights || !readings) {
        return INSOLE_ERR_NULL;
    }
    if (!(unheard_dbm >= UNHEARD_MIN_DBM && unheard_dbm <= INSOLE_R(0.0))) {
        return INSOLE_ERR_VALUE;
    }
    if (room < map->point_count) {
        return INSOLE_ERR_ROOM;
    }
    if (map->point_count == 0u) {
        return INSOLE_ERR_STATE;
    }
    insole_status_t status =
        insole_map_search_begin(&rss->search, map, NULL, 1, AGE_MAX_S, readings, count);
    if (status == INSOLE_OK) {
        rss->unheard_dbm = unheard_dbm;
        rss->heard_db2 = insole_map_search_heard_db2(&rss->search, unheard_dbm);
        rss->log_weights = log_weights;
        rss->map = map;
    }
    return status;
}

bool insole_rss_weigh_work(insole_rss_weigh_t *rss, uint32_t points)
{
    uint32_t point;
    if (!rss || !rss->map) {
        return false;
    }
    while (insole_map_search_next(&rss->search, rss->map, &points, &point)) {
        insole_real_t squares = insole_map_search_distance_db2(&rss->search, rss->map, point,
                                                               rss->unheard_dbm, rss->heard_db2);
        rss->log_weights[point] = INSOLE_R(-0.5) * insole_log(insole_max(squares, LEAST_DB2));
    }
    return insole_map_search_has_more(&rss->search);
}

bool insole_rss_weigh_is_ready(const insole_rss_weigh_t *rss)
{
    return rss && rss->map && rss->search.in_work && !insole_map_search_has_more(&rss->search);
}

static uint32_t nearest_to(const insole_radio_map_t *map, insole_spot_t spot)
{
    uint32_t nearest = 0u;
    insole_real_t least_m2 = INSOLE_REAL_MAX;
    for (uint32_t i = 0u; i < map->point_count; i++) {
        insole_spot_t way = insole_spot_sub(map->spots[i], spot);
        insole_real_t m2 = insole_spot_dot(way, way);
        if (m2 < least_m2) {
            least_m2 = m2;
            nearest = i;
        }
    }
    return nearest;
}

insole_real_t insole_rss_weigh_at(const insole_rss_weigh_t *rss, insole_spot_t spot)
{
    return insole_rss_weigh_is_ready(rss) ? rss->log_weights[nearest_to(rss->map, spot)]
                                          : INSOLE_R(0.0);
}
