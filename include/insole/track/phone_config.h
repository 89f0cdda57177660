/** @file phone_config.h  All settings of the phone tracker, its own and those of its parts.
 *
 *      insole_phone_tracker_config_t config = insole_phone_tracker_defaults;
 *      config.walk.step_length.root_scale = INSOLE_R(0.43);
 *      insole_phone_tracker_init(&phone, &config, &parts, &map);
 *
 *  The filter and the solver of fixes are set up by their own calls and are not among them.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_PHONE_CONFIG_H
#define INSOLE_TRACK_PHONE_CONFIG_H

#include "insole/move/attitude.h"
#include "insole/sense/screen.h"
#include "insole/sense/still_bias.h"
#include "insole/track/phone_compass.h"
#include "insole/track/phone_place.h"
#include "insole/track/phone_walk.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_PHONE_TRACKER_KEYS(KEY)                                                            \
    KEY(REAL, radio_late_s, 1.0, 0.0, 10.0, "s",                                                  \
        "a reading is later than its age tells, at most so much; as when the map was made")       \
    KEY(REAL, sigma_fix_m, 0.0, 0.0, 100.0, "m",                                                  \
        "1-sigma that a fix by radio has beside what it tells of itself")                         \
    KEY(REAL, trust_sigmas, 0.0, 0.0, 100.0, "",                                                  \
        "fingerprints farther than so many 1-sigmas are not looked at; 0 = all are")              \
    KEY(REAL, trust_least_m, 10.0, 0.1, 1000.0, "m", "nearer ones are in any case")               \
    KEY(REAL, radio_fresh_s, 5.0, 0.1, 1000.0, "s", "radio alone: a fix holds so long")           \
    KEY(REAL, gap_s, 0.5, 0.1, 10.0, "s", "a longer time without samples may hide steps")         \
    KEY(REAL, search_sigma_m, 15.0, 0.1, 1.0e6, "m",                                              \
        "a position with a larger 1-sigma is still searching")                                    \
    KEY(REAL, lost_sigma_m, 60.0, 0.1, 1.0e6, "m", "one with a larger 1-sigma is lost")
/* clang-format on */

typedef struct {
    INSOLE_PHONE_TRACKER_KEYS(INSOLE_CONFIG_MEMBER)
    insole_screen_config_t screen;
    insole_still_bias_config_t still_bias;
    insole_attitude_config_t attitude;
    insole_phone_walk_config_t walk;
    insole_phone_compass_config_t compass;
    insole_auto_start_config_t auto_start;
    insole_phone_place_config_t place;
} insole_phone_tracker_config_t;

/** The tracker's own, which it keeps; its parts keep theirs. */
typedef struct {
    INSOLE_PHONE_TRACKER_KEYS(INSOLE_CONFIG_MEMBER)
} insole_phone_tracker_own_t;

extern const insole_phone_tracker_config_t insole_phone_tracker_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_phone_config_check(const insole_phone_tracker_config_t *config);

#ifdef __cplusplus
}
#endif

#endif
