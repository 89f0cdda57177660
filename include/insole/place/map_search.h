/** @file map_search.h  One scan held against a radio map, a few points at a time.
 *
 *  Source  [PhoneEKF] 3.2 and [PhoneUKF] 6.1: the sums over fingerprints; the trusted area.
 *
 *  What kde_fix and ml_fix share: each brings its own weight of a point.
 *
 *      insole_map_search_begin(&search, &map, NULL, 3, 3.5f, scan.readings, scan.count);
 *      while (insole_map_search_next(&search, &map, &budget, &point))
 *          insole_map_search_add(&search, &map, point, log_weight);
 *      when not insole_map_search_has_more(&search):
 *          insole_map_search_finish(&search, &map);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_MAP_SEARCH_H
#define INSOLE_PLACE_MAP_SEARCH_H

#include "insole/place/heard.h"
#include "insole/place/radio_map.h"
#include "insole/place/spot_mixture.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_heard_t heard; /**< the scan in work */
    insole_trusted_area_t area;
    bool has_area;
    bool in_work;
    uint32_t next, end; /**< points of the map that nobody has looked at yet */
    insole_spot_mixture_t mixture;
} insole_map_search_t;

/** Takes a scan; one still in work is given up.
 *  @param map one that has passed insole_radio_map_check()
 *  @param area NULL: anywhere
 *  @return INSOLE_ERR_STATE when fewer than `readings_min` readings pass (heard.h);
 * INSOLE_ERR_VALUE for an area that makes no sense */
insole_status_t insole_map_search_begin(insole_map_search_t *search, const insole_radio_map_t *map,
                                        const insole_trusted_area_t *area, int32_t readings_min,
                                        insole_real_t age_max_s, const insole_rss_t *readings,
                                        uint32_t count);

/** The next point of the trusted area.
 *  @param[in,out] budget points that may be looked at; inside the area or not
 *  @return false when the budget or the map is at its end, or it is not the map begun with */
bool insole_map_search_next(insole_map_search_t *search, const insole_radio_map_t *map,
                            uint32_t *budget, uint32_t *point);

bool insole_map_search_has_more(const insole_map_search_t *search);

/** Squares of what the scan heard above `unheard_dbm`, for the next. */
insole_real_t insole_map_search_heard_db2(const insole_map_search_t *search,
                                          insole_real_t unheard_dbm);

/** Squared differences in dB over all that the scan or the point has heard; what one of them has
 *  not heard counts as `unheard_dbm`.
 *  @param heard_db2  of insole_map_search_heard_db2() */
insole_real_t insole_map_search_distance_db2(const insole_map_search_t *search,
                                             const insole_radio_map_t *map, uint32_t point,
                                             insole_real_t unheard_dbm, insole_real_t heard_db2);

void insole_map_search_add(insole_map_search_t *search, const insole_radio_map_t *map,
                           uint32_t point, insole_real_t log_weight);

/** Ends the search: the mixture holds the answer.
 *  @return INSOLE_ERR_STATE when points are left, none lay in the area or no scan was begun */
insole_status_t insole_map_search_finish(insole_map_search_t *search,
                                         const insole_radio_map_t *map);

#ifdef __cplusplus
}
#endif

#endif
