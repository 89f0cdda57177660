/** @file rss_weigh.h  Particles weighed by how little the nearest fingerprint differs from a scan.
 *
 *  Source  [PhoneEKF] 4.1: the rival, a particle filter whose weights are the inverse of the
 *          Euclidean distance between the strengths heard and those of the radio map.
 *  Frames  m: map.
 *
 *      static insole_real_t log_weights[POINTS];
 *      static insole_rss_weigh_t rss;
 *      insole_rss_weigh_begin(&rss, &map, log_weights, POINTS, -95, scan.readings, scan.count);
 *      while (insole_rss_weigh_work(&rss, 16)) {}
 *      for each particle:
 *          log_weight += insole_rss_weigh_at(&rss, place_then);
 *
 *  The nearest fingerprint is looked for among all: so many distances for each particle and scan.
 *  What one side has not heard counts as `unheard_dbm`.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_RSS_WEIGH_H
#define INSOLE_FUSE_RSS_WEIGH_H

#include "insole/place/map_search.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_map_search_t search; /**< the scan in work */
    insole_real_t unheard_dbm;
    insole_real_t heard_db2;    /**< squares of the scan above unheard */
    insole_real_t *log_weights; /**< the caller's, one per point */
    const insole_radio_map_t *map;
} insole_rss_weigh_t;

/** Takes a scan; one still in work is given up.
 *  @param map          one that has passed insole_radio_map_check(); stays where it is as long as
 *                      particles are weighed
 *  @param log_weights  `room` of them, at least as many as the map has points
 *  @param unheard_dbm  -127 .. 0
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_ROOM, INSOLE_ERR_VALUE; INSOLE_ERR_STATE when no reading
 *          passes (heard.h), or the map has no points */
insole_status_t insole_rss_weigh_begin(insole_rss_weigh_t *rss, const insole_radio_map_t *map,
                                       insole_real_t *log_weights, uint32_t room,
                                       insole_real_t unheard_dbm, const insole_rss_t *readings,
                                       uint32_t count);

/** Compares the next `points` of the map.
 *  @return whether more are left */
bool insole_rss_weigh_work(insole_rss_weigh_t *rss, uint32_t points);

/** Whether a scan was taken and all is compared. */
bool insole_rss_weigh_is_ready(const insole_rss_weigh_t *rss);

/** Logarithm of the weight of a particle that was at `spot` when the scan was heard: of the
 *  fingerprint nearest to it. 0 before all is compared. */
insole_real_t insole_rss_weigh_at(const insole_rss_weigh_t *rss, insole_spot_t spot);

#ifdef __cplusplus
}
#endif

#endif
