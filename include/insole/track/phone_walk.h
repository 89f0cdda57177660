/** @file phone_walk.h  From samples of a phone to steps with a length and a direction.
 *
 *  Source  [PhoneEKF] 3.1; [PhoneUKF] 5.3, 6.2.
 *  Frames  b: phone.  n: level, that of the attitude.
 *
 *  In the hand a step goes where the phone points (heading.h). In any other position a guide tells
 *  where: the gait (phone_gait.h). Lengths of steps and what is taken for one follow the position
 *  then, too. Without a guide the phone points ahead.
 *
 *      insole_phone_walk_init(&walk, &insole_phone_walk_defaults, &guide);
 *      on each sample, after the attitude:
 *          insole_phone_walk_push(&walk, &attitude, &imu);
 *          while (insole_phone_walk_next(&walk, &footfall, &pace) == INSOLE_OK) use(&pace);
 *      in idle time:  insole_phone_walk_work(&walk);
 *
 *  The first steps of a walk are told late; their way is shown before in `shown`.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_PHONE_WALK_H
#define INSOLE_TRACK_PHONE_WALK_H

#include "insole/fuse/step_news.h"
#include "insole/move/attitude.h"
#include "insole/move/step_length.h"
#include "insole/sense/step.h"
#include "insole/track/phone_way.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_PHONE_WALK_KEYS(KEY)                                                               \
    KEY(REAL, sigma_length_share, 0.15, 0.0, 1.0, "",                                             \
        "1-sigma of a step's length, as a share of it")                                           \
    KEY(REAL, sigma_ahead_rad, 0.07, 0.0, 1.0, "rad",                                             \
        "1-sigma between where the phone points and where a step goes")                           \
    KEY(INT, shown_steps, 2, 1, 9, "steps",                                                       \
        "so many peaks in a row are shown before it is sure that this is a walk; 9 = never")
/* clang-format on */

typedef struct {
    INSOLE_PHONE_WALK_KEYS(INSOLE_CONFIG_MEMBER)
    insole_step_config_t step;
    insole_step_length_config_t step_length;
} insole_phone_walk_config_t;

extern const insole_phone_walk_config_t insole_phone_walk_defaults;

/** No position: no one knows it. */
enum { INSOLE_PHONE_NO_POSITION = -1 };

/** How the phone lies on its walker, as far as somebody knows. */
typedef struct {
    bool is_askew;              /**< steps go by what is here; else where the phone points */
    bool is_aside;              /**< so although phones point ahead in this position */
    bool is_ahead;              /**< many steps have gone where it points, lying as it does */
    bool is_known;              /**< there is a direction, if so */
    insole_real_t askew_rad;    /**< from where the phone points to where its walker goes */
    insole_turn_t askew;        /**< that angle */
    uint64_t since_us;          /**< begin of the first step that told it */
    insole_real_t var_rad2;     /**< of it */
    int32_t position;           /**< or INSOLE_PHONE_NO_POSITION */
    insole_real_t length, rise; /**< times that of a phone in the hand, of a step */
} insole_phone_lie_t;

typedef struct insole_phone_walk insole_phone_walk_t;

/** What a walk asks of whatever tells where a step goes that a phone does not point. All may change
 *  `walk->lie`, and nothing else of it. */
typedef struct {
    void (*begin)(void *state, insole_phone_walk_t *walk);
    /** A sample; `walk->t_us` is that of the sample before. */
    void (*push)(void *state, insole_phone_walk_t *walk, const insole_attitude_t *attitude,
                 const insole_imu_t *imu);
    /** A step that is told. @return true: it has set the direction of `pace` itself */
    bool (*step)(void *state, insole_phone_walk_t *walk, const insole_footfall_t *footfall,
                 insole_pace_t *pace);
    /** @return false when there was nothing to do */
    bool (*work)(void *state, insole_phone_walk_t *walk);
} insole_phone_guide_calls_t;

typedef struct {
    const insole_phone_guide_calls_t *calls; /**< NULL: a step goes where the phone points */
    void *state;                             /**< stays where it is */
} insole_phone_guide_t;

struct insole_phone_walk {
    insole_phone_walk_config_t config;
    insole_phone_guide_t guide;
    insole_step_counter_t steps;
    insole_phone_way_t way; /**< the last steps, n */
    insole_turn_t ahead;    /**< n, where the phone points */
    insole_real_t yaw_rad2; /**< variance of that */
    insole_phone_lie_t lie;
    uint64_t t_us;
    insole_spot_t shown;   /**< n, way of the steps that are shown and not yet told */
    uint64_t shown_end_us; /**< end of the newest of them, and how many they are */
    uint32_t shown_count;
};

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_phone_walk_check(const insole_phone_walk_config_t *config);

/** @param guide  its state must have been set up; NULL: a step goes where the phone points
 *  @return as insole_phone_walk_check() */
insole_status_t insole_phone_walk_init(insole_phone_walk_t *walk,
                                       const insole_phone_walk_config_t *config,
                                       const insole_phone_guide_t *guide);

/** A sample, after `attitude` has taken it.
 *  @return INSOLE_ERR_NULL; else as insole_step_push() */
insole_status_t insole_phone_walk_push(insole_phone_walk_t *walk, const insole_attitude_t *attitude,
                                       const insole_imu_t *imu);

/** The next step that is told.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_STATE when there is none */
insole_status_t insole_phone_walk_next(insole_phone_walk_t *walk, insole_footfall_t *footfall,
                                       insole_pace_t *pace);

/** What the guide has to do between samples. @return true when it had */
bool insole_phone_walk_work(insole_phone_walk_t *walk);

/** Whether the way that is shown has a direction: by a guide it has none before the first step
 *  is told. */
bool insole_phone_walk_is_directed(const insole_phone_walk_t *walk);

/** Where the walker goes, as far as a phone can tell while no step is made, n. */
insole_turn_t insole_phone_walk_ahead(const insole_phone_walk_t *walk);

/** The way from a time to the last step that was told, n: backwards when that is shown, not told.
 */
insole_spot_t insole_phone_walk_since(const insole_phone_walk_t *walk, uint64_t t_us);

#ifdef __cplusplus
}
#endif

#endif
