/** @file carry.h  Where a walker carries the phone: in the hand, in a pocket, at the ear, ...
 *
 *  Source  [PhoneUKF] 4: orientation-free features over windows of 2 s, a random forest. That a new
 *          position must win several windows, and that windows at rest tell nothing, is our own.
 *  Frames  b: any.
 *
 *      static insole_carry_t carry;
 *      insole_carry_init(&carry, &insole_carry_defaults);
 *      on each sample, 20 to 400 Hz:
 *          insole_carry_push(&carry, t_us, accel_mps2, &gyro_radps, NULL);
 *          if (insole_carry_next(&carry, &forest, &news) == INSOLE_OK && news.told >= 0)
 *              use(forest.names[news.told]);                 once a second, as the walk goes on
 *
 *  Positions are the classes of the table (carry_forest.h), which knows their names; a position
 * that it never learned is taken for one of its own. A push costs the same always; the work of a
 * window is done in `next`, which may come up to a second later. The table is looked at in each
 * `next` anew; all calls between two `init` should give the same.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_CARRY_H
#define INSOLE_SENSE_CARRY_H

#include "insole/base/config.h"
#include "insole/sense/carry_forest.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_CARRY_KEYS(KEY)                                                                    \
    KEY(REAL, gravity_s, 0.5, 0.05, 100.0, "s",                                                   \
        "low-pass that finds gravity; forests are grown on the default")                          \
    KEY(REAL, still_mps2, 0.5, 0.0, 10.0, "m/s^2",                                                \
        "a window where |a| scatters less is at rest and tells nothing; 0 = off")                 \
    KEY(INT, switch_windows, 5, 1, 60, "",                                                        \
        "a new position is told when it has won so many windows in a row; 1 = at once")           \
    KEY(REAL, min_share, 0.5, 0.0, 1.0, "",                                                       \
        "a window is won with at least this share of the trees; 0 = any")
/* clang-format on */

typedef struct {
    INSOLE_CARRY_KEYS(INSOLE_CONFIG_MEMBER)
} insole_carry_config_t;

extern const insole_carry_config_t insole_carry_defaults;

/** No position: `told` before the first is found, `winner` of a window at rest. */
enum { INSOLE_CARRY_NONE = -1 };

typedef struct {
    insole_carry_config_t config;
    insole_carry_window_t window;
    int32_t told;      /**< position that holds, or INSOLE_CARRY_NONE */
    int32_t candidate; /**< that won the last windows, or INSOLE_CARRY_NONE */
    int32_t wins;      /**< windows in a row that it won */
} insole_carry_t;

/** What a window brought. */
typedef struct {
    uint64_t t_us;              /**< end of the window */
    insole_carry_votes_t votes; /**< all 0 and winner INSOLE_CARRY_NONE when it is at rest */
    int32_t told;               /**< position that holds, or INSOLE_CARRY_NONE */
} insole_carry_news_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_carry_init(insole_carry_t *carry, const insole_carry_config_t *config);

/** Takes a sample: insole_carry_window_push. Refusals are counted in `carry->window.refused`. */
insole_status_t insole_carry_push(insole_carry_t *carry, uint64_t t_us, insole_vec3_t accel_mps2,
                                  const insole_vec3_t *gyro_radps, const insole_vec3_t *up);

/** What the newest window says, once.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE when there is none, or one without the gyroscope that
 *          the table asks about: it is gone then; INSOLE_ERR_DATA for a damaged table: the window
 *          then still waits */
insole_status_t insole_carry_next(insole_carry_t *carry, const insole_carry_forest_t *forest,
                                  insole_carry_news_t *news);

/** Does the phone rest in this window? Forests are neither grown on nor asked about such. */
bool insole_carry_is_still(const insole_carry_config_t *config,
                           const insole_carry_features_t *features);

#ifdef __cplusplus
}
#endif

#endif
