/** @file phone_compass.h  What a compass says of the offset between map and level frame.
 *
 *  Frames  n: level, that of the attitude.  m: map.  offset = heading in m less heading in n.
 *
 *  Indoors a compass is wrong by 20 to 30 degrees at any one place, but not by the same at the
 *  next. So it is never the heading: it speaks of the offset, which the gyro keeps, and its mean
 *  over a walk is worth far more than one reading.
 *
 *      static insole_phone_compass_t compass;
 *      insole_phone_compass_init(&compass, &insole_phone_compass_defaults);
 *      on each reading:
 *          insole_magnetic_azimuth(&attitude, mag.field_ut, &azimuth_rad);
 *          if (insole_phone_compass_push(&compass, mag.t_us, strength_ut, azimuth_rad))
 *              use(compass.block_rad, compass.mean_rad);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_PHONE_COMPASS_H
#define INSOLE_TRACK_PHONE_COMPASS_H

#include "insole/base/config.h"
#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_PHONE_COMPASS_KEYS(KEY)                                                            \
    KEY(CHOICE, use, 1, 0, 1, "off|on", "a magnetometer tells of the direction")                  \
    KEY(REAL, north_rad, 1.5708, -3.15, 3.15, "rad",                                              \
        "heading of magnetic north on the map: declination, and how the plan is turned")          \
    KEY(REAL, least_ut, 15.0, 0.0, 100.0, "uT", "a weaker field is not that of the earth")        \
    KEY(REAL, most_ut, 90.0, 20.0, 1000.0, "uT", "nor is a stronger one")                         \
    KEY(REAL, block_s, 2.0, 0.1, 60.0, "s", "readings are told as means over so long")            \
    KEY(REAL, sigma_block_rad, 0.79, 0.01, 3.2, "rad", "1-sigma of each such mean")               \
    KEY(REAL, sigma_mean_rad, 0.26, 0.01, 3.2, "rad", "1-sigma of the mean since the start")
/* clang-format on */

typedef struct {
    INSOLE_PHONE_COMPASS_KEYS(INSOLE_CONFIG_MEMBER)
} insole_phone_compass_config_t;

extern const insole_phone_compass_config_t insole_phone_compass_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_phone_compass_check(const insole_phone_compass_config_t *config);

/** What it says of the offset. */
typedef struct {
    bool is_known;
    insole_real_t block_rad, sigma_block_rad; /**< the last block */
    insole_real_t mean_rad, sigma_mean_rad;   /**< all readings */
} insole_phone_sight_t;

typedef struct {
    insole_phone_compass_config_t config;
    insole_turn_t block, all; /**< sums of unit vectors: of this block, of all */
    uint64_t block_us;        /**< where it began */
    uint32_t readings;        /**< in it */
    uint32_t used, passed;    /**< readings, since init */
    insole_real_t block_rad;  /**< offset by the last full block */
    insole_real_t mean_rad;   /**< offset by all readings; only when `used` > 0 */
} insole_phone_compass_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_phone_compass_init(insole_phone_compass_t *compass,
                                          const insole_phone_compass_config_t *config);

/** A time before the block in work begins that block anew.
 *  @param strength_ut  length of the field
 *  @param azimuth_rad  direction of its level part in n
 *  @return true when a block is full: `block_rad` is new */
bool insole_phone_compass_push(insole_phone_compass_t *compass, uint64_t t_us,
                               insole_real_t strength_ut, insole_real_t azimuth_rad);

insole_phone_sight_t insole_phone_compass_sight(const insole_phone_compass_t *compass);

/** Nothing is known of n any more. */
void insole_phone_compass_forget(insole_phone_compass_t *compass);

#ifdef __cplusplus
}
#endif

#endif
