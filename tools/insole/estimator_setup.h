/** @file estimator_setup.h  What an estimator is made of, and what both kinds have in common.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_ESTIMATOR_SETUP_H
#define INSOLE_HOST_ESTIMATOR_SETUP_H

#include "insole/place/radio_map.h"
#include "insole/place/rss_field.h"

#include "method.h"
#include "record.h"
#include "track.h"

/** What a start that does not tell its own is taken for. */
#define START_SIGMA_M   0.3
#define START_SIGMA_RAD 0.09

#define RADIO_FRESH_US INT64_C(5000000)

/** Radio so far ahead of the IMU has a stamp that cannot be [us]. */
#define RADIO_AHEAD_US INT64_C(60000000)

typedef struct {
    const settings_t *settings; /**< stay where they are */
    method_t method;
    const insole_building_t *building; /**< its place is the caller's; NULL: nothing is known */
    const insole_radio_map_t *map;     /**< of fingerprints; NULL: there is none */
    uint32_t particles;
    uint64_t seed;
    bool is_smooth; /**< for the first order only */
} estimator_setup_t;

/** What became of the radio. */
typedef struct {
    unsigned long scans, ranges; /**< told; scans of several readings, single ranges */
    unsigned long worked_in;     /**< times that either was worked in */
    unsigned long wild;          /**< moments left out because of their stamps */
} radio_counts_t;

/** A start record as the library takes it. */
insole_start_t estimator_start(const record_t *record);

/** A reading of the IMU, corrected as the settings tell. */
insole_imu_t estimator_imu(const record_t *record, const settings_t *settings);

/** A fix on the log's clock. */
void estimator_row(const insole_fix_t *fix, track_row_t *row);

#endif
