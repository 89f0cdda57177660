/** @file radio_map.h  Fingerprints: what each place hears of each access point.
 *
 *  Source  [PhoneEKF] 3.2 and [PhoneUKF] 6.1, training pairs and trusted area; [WifiShift] II.A.
 *  Frames  m: map, x east, y north, metres.
 *
 *  A map is a view of constant tables, in flash or in the memory of a survey (radio_survey.h). What
 *  a point was told about an access point is an entry; the entries of a point lie together, in
 *  ascending order of their access points. An access point without an entry was not heard there.
 *
 *      static const insole_radio_map_t map = {600, 2428, spots, first, visits,
 *                                             aps, below, spread, counts, NULL};
 *      insole_radio_map_check(&map);
 *      if (insole_radio_map_find(&map, point, ap, &entry))
 *          mean = insole_radio_map_mean_dbm(&map, entry);
 *
 *  An entry takes 3 bytes, 5 with spread and count, 13 with a histogram. Means are kept to 0.5 dB
 *  (off by 0.25 at most), spreads to 1/8 dB: far below what a reading scatters.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_RADIO_MAP_H
#define INSOLE_PLACE_RADIO_MAP_H

#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    INSOLE_RADIO_APS_MAX = 65535, /**< numbers of access points are below this */
    INSOLE_RADIO_LEVELS = 256,    /**< values that a mean can have: 0, -0.5 .. -127.5 dBm */
    INSOLE_RADIO_BINS = 8         /**< of a histogram, 8 dB each: below -84, .. , from -36 dBm on */
};

/** Constant tables and their sizes. */
typedef struct {
    uint32_t point_count;
    uint32_t ap_count;          /**< one more than the highest number of an access point */
    const insole_spot_t *spots; /**< per point: where it is */
    const uint32_t *first;      /**< per point and one more: its first entry; ends at the next's */
    const uint8_t *visits;      /**< per point: scans made there; NULL: not known */
    const uint16_t *aps;        /**< per entry: the access point */
    const uint8_t *below;       /**< per entry: mean, in half dB below 0 dBm */
    const uint8_t *spread;      /**< per entry: standard deviation in 1/8 dB; NULL: not known */
    const uint8_t *counts;      /**< per entry: scans that heard it, <= visits; NULL: not known */
    const uint8_t *bins;        /**< per entry: INSOLE_RADIO_BINS counts; NULL: no histograms */
} insole_radio_map_t;

/** Where a fingerprint is believed: not farther than this from where the walker was. */
typedef struct {
    insole_spot_t centre;
    insole_real_t radius_m; /**< > 0 */
} insole_trusted_area_t;

/** To be called once for tables that come from elsewhere; all other calls take what has passed.
 *  @return INSOLE_ERR_DATA when the tables contradict each other or a place is not finite */
insole_status_t insole_radio_map_check(const insole_radio_map_t *map);

/** Looks for what a point knows of an access point.
 *  @return false, and `entry` untouched, when it never heard it or there is no such point */
bool insole_radio_map_find(const insole_radio_map_t *map, uint32_t point, uint32_t ap,
                           uint32_t *entry);

/** Is the point inside? NULL trusts the whole map. [PhoneEKF (28)] [PhoneUKF (37)] */
bool insole_radio_map_trusts(const insole_trusted_area_t *area, insole_spot_t spot);

/** @return INSOLE_ERR_VALUE when the centre is not finite or the radius not above 0 */
insole_status_t insole_trusted_area_check(const insole_trusted_area_t *area);

/** The radius that the covariance of the last position asks for: `sigmas` of its longer axis and
 *  the way that the walker may have gone since.
 *  @return INSOLE_ERR_VALUE for what is not finite, below 0, or no covariance */
insole_status_t insole_trusted_area_around(insole_spot_t last, insole_real_t var_x_m2,
                                           insole_real_t cov_xy_m2, insole_real_t var_y_m2,
                                           insole_real_t sigmas, insole_real_t way_m,
                                           insole_trusted_area_t *area);

/** A strength as a mean is kept: 0 dBm and more give 0, -127.5 dBm and less give 255. */
static inline uint8_t insole_radio_level(insole_real_t dbm)
{
    insole_real_t half_db = INSOLE_R(0.5) - INSOLE_R(2.0) * dbm;
    return (uint8_t)insole_max(INSOLE_R(0.0), insole_min(half_db, INSOLE_R(255.0)));
}

static inline insole_real_t insole_radio_level_dbm(uint32_t level)
{
    return INSOLE_R(-0.5) * (insole_real_t)level;
}

/** The bin of the histogram that a strength falls into. */
static inline uint32_t insole_radio_bin(insole_real_t dbm)
{
    insole_real_t bin = (dbm + INSOLE_R(92.0)) * INSOLE_R(0.125);
    return (uint32_t)insole_max(INSOLE_R(0.0), insole_min(bin, INSOLE_R(7.0)));
}

static inline insole_real_t insole_radio_map_mean_dbm(const insole_radio_map_t *map, uint32_t entry)
{
    return insole_radio_level_dbm(map->below[entry]);
}

/** 0 where the map does not know. */
static inline insole_real_t insole_radio_map_std_db(const insole_radio_map_t *map, uint32_t entry)
{
    return map->spread ? INSOLE_R(0.125) * (insole_real_t)map->spread[entry] : INSOLE_R(0.0);
}

/** 1 where the map does not know. */
static inline uint32_t insole_radio_map_heard(const insole_radio_map_t *map, uint32_t entry)
{
    return map->counts ? map->counts[entry] : 1u;
}

#ifdef __cplusplus
}
#endif

#endif
