/** @file radio_survey.h  Builds a radio map from what was heard where, one sample at a time.
 *
 *  Source  [PhoneEKF] 3.2 and 4.1, the offline phase; [WifiShift] II.A.
 *  Frames  m: map, metres.
 *
 *  Firmware whose map lies packed in flash does not need this part.
 *
 *      static insole_survey_point_t points[1000];
 *      static insole_survey_record_t records[200000];
 *      insole_radio_survey_t survey;
 *      insole_radio_survey_init(&survey, 2.0f, points, 1000, records, 200000);
 *      for each reading: insole_radio_survey_add(&survey, spot, ap, dbm);
 *      insole_radio_survey_freeze(&survey, UINT32_MAX, &memory, &map);
 *
 *  Samples are gathered in squares of the plan; a point lies at the mean place of its samples.
 *  A whole scan should be added at one place. How often a point was visited is how often it heard
 *  the access point that it heard most often: what it heard less often was silent in between.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_RADIO_SURVEY_H
#define INSOLE_PLACE_RADIO_SURVEY_H

#include "insole/place/radio_map.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A square of the plan with samples. */
typedef struct {
    int32_t column, row;
    insole_spot_t spot; /**< mean place of its samples */
    uint32_t samples;
    uint32_t visits; /**< of its access points the largest count */
} insole_survey_point_t;

/** What is known of one access point at one place. */
typedef struct {
    insole_real_t mean_dbm, std_db;
    uint32_t count;                   /**< > 0 */
    uint32_t bins[INSOLE_RADIO_BINS]; /**< histogram; their sum is `count` */
} insole_survey_stat_t;

/** The same in the survey; a slot of a hash table. */
typedef struct {
    uint32_t point;
    uint32_t ap;
    insole_survey_stat_t stat; /**< count 0: a free slot */
} insole_survey_record_t;

typedef struct {
    insole_real_t spacing_m; /**< side of the squares */
    insole_survey_point_t *points;
    uint32_t point_count, point_room;
    insole_survey_record_t *records;
    uint32_t record_count, record_room;
    uint32_t last;     /**< point of the last sample: the next is often there too */
    uint32_t ap_count; /**< one more than the highest number */
} insole_radio_survey_t;

/** The caller's memory for a frozen map; spread to bins may each be NULL: left out of the map. */
typedef struct {
    insole_spot_t *spots; /**< `point_room` */
    uint32_t *first;      /**< `point_room` + 1 */
    uint8_t *visits;      /**< `point_room` */
    uint32_t point_room;
    uint16_t *aps;   /**< `entry_room` */
    uint8_t *below;  /**< `entry_room` */
    uint8_t *spread; /**< `entry_room` */
    uint8_t *counts; /**< `entry_room` */
    uint8_t *bins;   /**< `entry_room` x INSOLE_RADIO_BINS */
    uint32_t entry_room;
} insole_radio_map_memory_t;

/** @param spacing_m 0.05 .. 1000; small: every surveyed place is a point of its own
 *  @return INSOLE_ERR_VALUE for a spacing out of range or no room */
insole_status_t insole_radio_survey_init(insole_radio_survey_t *survey, insole_real_t spacing_m,
                                         insole_survey_point_t *points, uint32_t point_room,
                                         insole_survey_record_t *records, uint32_t record_room);

/** One reading at a place.
 *  @return INSOLE_ERR_VALUE for a place beyond 100 km, an access point not below
 *          INSOLE_RADIO_APS_MAX or a strength not in -127 .. 0 dBm; INSOLE_ERR_ROOM */
insole_status_t insole_radio_survey_add(insole_radio_survey_t *survey, insole_spot_t spot,
                                        uint32_t ap, insole_real_t dbm);

/** What another survey has gathered, as if its samples had been added one by one.
 *  @return as insole_radio_survey_add; INSOLE_ERR_VALUE also for a spread not in 0 .. 127 dB, a
 *          count of 0 or beyond a million, or bins that do not sum to it */
insole_status_t insole_radio_survey_merge(insole_radio_survey_t *survey, insole_spot_t spot,
                                          uint32_t ap, const insole_survey_stat_t *stat);

/** Adds all of another survey. What fits is added even when something is refused.
 *  @return the first refusal */
insole_status_t insole_radio_survey_join(insole_radio_survey_t *survey,
                                         const insole_radio_survey_t *other);

/** The map so far; the survey can go on. `memory` is written to even when refused, `map` is not.
 *  @param keep of each point only so many access points, the strongest; UINT32_MAX: all
 *  @return INSOLE_ERR_ROOM; INSOLE_ERR_STATE without a sample; INSOLE_ERR_VALUE for keep = 0 */
insole_status_t insole_radio_survey_freeze(const insole_radio_survey_t *survey, uint32_t keep,
                                           const insole_radio_map_memory_t *memory,
                                           insole_radio_map_t *map);

#ifdef __cplusplus
}
#endif

#endif
