/* SPDX-License-Identifier: MIT */
#include "insole/place/map_search.h"

#include <stddef.h>

INSOLE_COLD insole_status_t insole_map_search_begin(insole_map_search_t *search,
                                                    const insole_radio_map_t *map,
                                                    const insole_trusted_area_t *area,
                                                    int32_t readings_min, insole_real_t age_max_s,
                                                    const insole_rss_t *readings, uint32_t count)
{
    if (!search || !map || !readings) {
        return INSOLE_ERR_NULL;
    }
    if (area && insole_trusted_area_check(area) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    uint32_t age_max_us = (uint32_t)(age_max_s * INSOLE_R(1e6));
    if (insole_heard_passing(map->ap_count, age_max_us, readings, count) < (uint32_t)readings_min) {
        return INSOLE_ERR_STATE;
    }
    insole_heard_gather(&search->heard, map->ap_count, age_max_us, readings, count);
    search->has_area = area != NULL;
    if (area) {
        search->area = *area;
    }
    search->mixture = insole_spot_mixture_empty();
    search->next = 0;
    search->end = map->point_count;
    search->in_work = true;
    return INSOLE_OK;
}

bool insole_map_search_has_more(const insole_map_search_t *search)
{
    return search && search->in_work && search->next < search->end;
}

bool insole_map_search_next(insole_map_search_t *search, const insole_radio_map_t *map,
                            uint32_t *budget, uint32_t *point)
{
    if (!insole_map_search_has_more(search) || search->end != map->point_count) {
        return false;
    }
    while (*budget > 0u && search->next < search->end) {
        uint32_t at = search->next++;
        (*budget)--;
        if (insole_radio_map_trusts(search->has_area ? &search->area : NULL, map->spots[at])) {
            *point = at;
            return true;
        }
    }
    return false;
}

insole_real_t insole_map_search_heard_db2(const insole_map_search_t *search,
                                          insole_real_t unheard_dbm)
{
    insole_real_t sum = INSOLE_R(0.0);
    for (uint32_t i = 0; i < search->heard.count; i++) {
        sum += insole_square(search->heard.dbm[i] - unheard_dbm);
    }
    return sum;
}

insole_real_t insole_map_search_distance_db2(const insole_map_search_t *search,
                                             const insole_radio_map_t *map, uint32_t point,
                                             insole_real_t unheard_dbm, insole_real_t heard_db2)
{
    insole_real_t squares = heard_db2; /* as if the point had heard nothing */
    uint32_t at = 0, end = map->first[point + 1u];
    for (uint32_t i = map->first[point]; i < end; i++) {
        insole_real_t mean_dbm = insole_radio_map_mean_dbm(map, i);
        if (insole_heard_seek(&search->heard, &at, map->aps[i])) {
            insole_real_t dbm = search->heard.dbm[at];
            squares += insole_square(dbm - mean_dbm) - insole_square(dbm - unheard_dbm);
        } else {
            squares += insole_square(mean_dbm - unheard_dbm);
        }
    }
    return squares;
}

void insole_map_search_add(insole_map_search_t *search, const insole_radio_map_t *map,
                           uint32_t point, insole_real_t log_weight)
{
    insole_spot_mixture_add(&search->mixture, point, map->spots[point], log_weight);
}

INSOLE_COLD insole_status_t insole_map_search_finish(insole_map_search_t *search,
                                                     const insole_radio_map_t *map)
{
    if (!search || !map) {
        return INSOLE_ERR_NULL;
    }
    if (!search->in_work || search->next < search->end || search->end != map->point_count ||
        search->mixture.count == 0u) {
        return INSOLE_ERR_STATE;
    }
    search->in_work = false;
    return INSOLE_OK;
}
