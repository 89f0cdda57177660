/** @file phone_gait.h  Where a step goes that a phone does not point: by the gait.
 *
 *  Source  [PhoneUKF] 5.3, 6.2.
 *  Frames  b: phone.  n: level, that of the attitude.
 *
 *  The gait tells the direction of each step (walk_heading.h). It is used step by step, or, the
 *  default, as a mean: the angle between where the phone points and where the gait goes stays the
 *  same while the phone is carried in the same way, so its mean over the last steps is far better
 *  than each, and turns are those of the phone. When the position changes, or the phone is tipped
 *  over, the mean begins anew. Step by step, the direction of one whose end is not certain counts
 *  as unknown: it may be the opposite one. Which position it is, carry.h tells, if it is there and
 *  the setting `faces` asks it; until it knows, the phone points ahead.
 *
 *      insole_phone_gait_init(&gait, &insole_phone_gait_defaults, &heading, &carry,
 *                             &insole_carry_table_forest);
 *      insole_phone_guide_t guide = {&insole_phone_gait_calls, &gait};
 *      insole_phone_walk_init(&walk, &insole_phone_walk_defaults, &guide);
 *
 *  A walk that names no guide links nothing of this.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_PHONE_GAIT_H
#define INSOLE_TRACK_PHONE_GAIT_H

#include "insole/move/walk_heading.h"
#include "insole/sense/carry.h"
#include "insole/track/phone_walk.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_PHONE_GAIT_KEYS(KEY)                                                               \
    KEY(CHOICE, faces, 2, 0, 2, "ahead|any|carried",                                              \
        "the phone points ahead, or lies in any way, or as its carrying position tells")          \
    KEY(CHOICE, gait, 0, 0, 1, "mean|step", "whose direction a step has that goes by the gait")   \
    KEY(REAL, gait_keep, 0.93, 0.0, 0.999, "", "kept from step to step of that mean")             \
    KEY(REAL, sigma_gait_rad, 0.1, 0.0, 3.0, "rad", "1-sigma of the best mean")                   \
    KEY(REAL, tipped_rad, 0.9, 0.1, 3.2, "rad", "a phone tipped over by so much is carried anew") \
    KEY(INT, aside_steps, 10, 1, 1000, "steps",                                                   \
        "a phone in the hand lies askew when so many steps go aside of where it points")          \
    KEY(REAL, aside_rad, 1.1, 0.1, 3.2, "rad", "aside: farther off; 3.2 = never")                 \
    KEY(INT, ahead_position, 0, -1, 7, "",                                                        \
        "carrying position in which a phone points ahead, by its number in the table; -1 = none") \
    KEY(REAL, length_ear, 1.08, 0.2, 5.0, "",                                                     \
        "in position 1, the ear, steps are so many times as long as step_length has them")        \
    KEY(REAL, length_swing, 1.17, 0.2, 5.0, "", "in position 2, a hand that swings")              \
    KEY(REAL, length_pocket, 1.07, 0.2, 5.0, "", "in position 3, a pocket")                       \
    KEY(REAL, rise_ear, 1.0, 0.0, 3.0, "", "times step.rise_share, in position 1")                \
    KEY(REAL, rise_swing, 0.45, 0.0, 3.0, "",                                                     \
        "in position 2: an arm that swings unevenly makes every other peak a low one")            \
    KEY(REAL, rise_pocket, 1.0, 0.0, 3.0, "", "in position 3")
/* clang-format on */

typedef struct {
    INSOLE_PHONE_GAIT_KEYS(INSOLE_CONFIG_MEMBER)
} insole_phone_gait_config_t;

extern const insole_phone_gait_config_t insole_phone_gait_defaults;

/** The angle from where the phone points to where its walker goes. */
typedef struct {
    insole_turn_t sum; /**< weighted by what each step knew of it; 0, 0: nothing is known */
    insole_vec3_t up;  /**< b, of unit length: as the phone lay while it was learned */
    uint32_t steps;    /**< that told it */
    bool is_aside;     /**< so many of them that it is far off */
} insole_phone_askew_t;

typedef struct {
    insole_phone_gait_config_t config;
    insole_walk_heading_t *heading;      /**< NULL: a step always goes where the phone points */
    insole_carry_t *carry;               /**< NULL: nobody knows the position */
    const insole_carry_forest_t *forest; /**< NULL: as without carry */
    insole_vec3_t up;                    /**< b, of unit length, smoothed */
    insole_phone_askew_t askew;
} insole_phone_gait_t;

extern const insole_phone_guide_calls_t insole_phone_gait_calls;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_phone_gait_check(const insole_phone_gait_config_t *config);

/** @param heading  a state that was set up, or NULL; so `carry`
 *  @return as insole_phone_gait_check(); INSOLE_ERR_DATA for a forest that is none */
insole_status_t insole_phone_gait_init(insole_phone_gait_t *gait,
                                       const insole_phone_gait_config_t *config,
                                       insole_walk_heading_t *heading, insole_carry_t *carry,
                                       const insole_carry_forest_t *forest);

#ifdef __cplusplus
}
#endif

#endif
