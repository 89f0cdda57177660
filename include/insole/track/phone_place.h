/** @file phone_place.h  A start, told or found, and from then on a filter: where the walker is.
 *
 *  Frames  n: level, that of the attitude.  m: map. heading in m = heading in n + offset.
 *
 *  A start that tells place and direction: whoever sees the first steps tells what direction they
 *  have in n. One that tells the place alone: the compass tells the direction, or the fixes do
 * (auto_start.h). None: the fixes tell both; a filter that learns the offset begins with the first
 * fix when a compass knows it well enough, another one when auto_start is ready. None, and no fixes
 * to come: a filter that can looks for the place itself; else the walk begins at (0, 0), and n is
 * m.
 *
 *      insole_phone_place_init(&place, &insole_phone_place_defaults, &auto_start_config, &filter,
 *                              has_radio);
 *      insole_phone_place_tell(&place, &start);
 *      on the first peaks that may be steps:
 *                        if (insole_phone_place_wants_direction(&place, t_us))
 *                            insole_phone_place_direct(&place, t_us, direction_rad);
 *      on each step:     insole_phone_place_step(&place, t_us, &pace);
 *      on each scan:     insole_phone_place_fix(&place, &fix);
 *      on each block of the compass:
 *                        insole_phone_place_compass(&place);
 *      insole_phone_place_answer(&place, t_us, &answer);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_PHONE_PLACE_H
#define INSOLE_TRACK_PHONE_PLACE_H

#include "insole/base/config.h"
#include "insole/fuse/auto_start.h"
#include "insole/fuse/step_filter.h"
#include "insole/place/radio_map.h"
#include "insole/track/phone_aside.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_PHONE_PLACE_KEYS(KEY)                                                              \
    KEY(REAL, direct_sigma_rad, 0.5, 0.0, 4.0, "rad",                                             \
        "a filter that learns the direction starts with the first fix when it is known so well")  \
    KEY(REAL, bias_share, 0.5, 0.0, 100.0, "",                                                    \
        "1-sigma of what fixes share, of that which they tell of themselves, on the mean; no more "\
        "than the filter's own")                                                                  \
    KEY(REAL, sigma_walk_mps, 0.8, 0.0, 10.0, "m/s",                                              \
        "1-sigma of the velocity while samples are missing")                                      \
    KEY(REAL, sigma_gap_turn_rad_rts, 0.75, 0.0, 3.0, "rad/sqrt(s)",                              \
        "1-sigma of the unknown turn while they are")
/* clang-format on */

typedef struct {
    INSOLE_PHONE_PLACE_KEYS(INSOLE_CONFIG_MEMBER)
} insole_phone_place_config_t;

extern const insole_phone_place_config_t insole_phone_place_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_phone_place_check(const insole_phone_place_config_t *config);

typedef struct {
    insole_real_t mean_m2; /**< of the variances of each coordinate */
    uint32_t fixes;
} insole_phone_told_t;

typedef struct {
    insole_phone_place_config_t config;
    insole_step_filter_t filter;
    bool has_radio; /**< fixes will come */
    insole_auto_start_t auto_start;
    insole_phone_sight_t sight; /**< of the compass; the owner keeps it new */
    insole_start_t start;       /**< told */
    bool has_start;             /**< and not yet used */
    bool is_started;            /**< the filter */
    insole_phone_told_t told;   /**< by the fixes, of themselves */
    uint32_t starts;            /**< times the filter was started */
    uint32_t refused;           /**< by the filter: fixes and steps */
} insole_phone_place_t;

/** What is known of the place, and how. */
typedef enum {
    INSOLE_PHONE_NOWHERE = 0, /**< nothing: the place told is none, and has a variance that says so
                                   unless the walk is to begin there */
    INSOLE_PHONE_GUESSED = 1, /**< by fixes alone; the filter waits for a direction */
    INSOLE_PHONE_TOLD = 2,    /**< by a start; the filter waits for the first steps */
    INSOLE_PHONE_FILTERED = 3
} insole_phone_knowledge_t;

typedef struct {
    insole_phone_knowledge_t knowledge;
    insole_step_filter_answer_t at;
    bool knows_offset; /**< else `at.offset_rad` is not to be used: the told heading is the place's
                        */
} insole_phone_answer_t;

/** @param config_start  of auto_start
 *  @param circles       for its method of that name; NULL: it has none
 *  @param filter        its state has been set up, and stays where it is
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range or a filter that lacks
 *          one of start, step, fix, answer */
insole_status_t insole_phone_place_init(insole_phone_place_t *place,
                                        const insole_phone_place_config_t *config,
                                        const insole_auto_start_config_t *config_start,
                                        const insole_auto_start_circles_t *circles,
                                        const insole_step_filter_t *filter, bool has_radio);

/** A start that holds from its time on, in place of an earlier one.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE as insole_foot_tracker_start, and beyond 100 km */
insole_status_t insole_phone_place_tell(insole_phone_place_t *place, const insole_start_t *start);

/** Whether a start that told a direction waits for that of the first steps. */
bool insole_phone_place_wants_direction(const insole_phone_place_t *place, uint64_t t_us);

/** The first steps since the start go there.
 *  @param direction_rad  n
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE when nothing waits for it; or as the filter answers */
insole_status_t insole_phone_place_direct(insole_phone_place_t *place, uint64_t t_us,
                                          insole_real_t direction_rad);

/** A step that comes while a direction is wanted gives its own.
 *  @param t_us  end of the step
 *  @return INSOLE_ERR_NULL, or as the filter answers */
insole_status_t insole_phone_place_step(insole_phone_place_t *place, uint64_t t_us,
                                        const insole_pace_t *pace);

/** Between a start that was told and the steps it waits for, a fix is passed over.
 *  @return INSOLE_ERR_NULL, or as the filter or auto_start answers */
insole_status_t insole_phone_place_fix(insole_phone_place_t *place, const insole_spot_fix_t *fix);

/** A block of the compass is full: `place->sight` is new.
 *  @return INSOLE_ERR_NULL, or as the filter answers */
insole_status_t insole_phone_place_compass(insole_phone_place_t *place);

/** Steps go aside of where they were taken to go until now: the filter begins anew, turned
 *  (phone_aside.h), and a search as if nothing had been heard.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE as insole_phone_aside_turn() */
insole_status_t insole_phone_place_turn(insole_phone_place_t *place, uint64_t t_us,
                                        const insole_phone_aside_t *aside);

/** Nothing is known of so long a time: the filter is started anew where it is, less certain.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a time that is negative or not finite */
insole_status_t insole_phone_place_gap(insole_phone_place_t *place, uint64_t t_us,
                                       insole_real_t gap_s);

/** @return INSOLE_ERR_NULL */
insole_status_t insole_phone_place_answer(const insole_phone_place_t *place, uint64_t t_us,
                                          insole_phone_answer_t *answer);

/** Where the walker is believed to be, once there is a filter.
 *  @param sigmas, least_m  radius: so many 1-sigmas and so much more
 *  @return false, and the area untouched, when he may be anywhere */
bool insole_phone_place_area(const insole_phone_place_t *place, uint64_t t_us, insole_real_t sigmas,
                             insole_real_t least_m, insole_trusted_area_t *area);

#ifdef __cplusplus
}
#endif

#endif
