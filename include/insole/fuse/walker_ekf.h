/** @file walker_ekf.h  Steps and fixes by radio made one position, with what is wrong with both.
 *
 *  Source  Our own.
 *  Frames  m: map.  n: level, the frame of the paces' headings; heading in m = heading in n +
 * offset.
 *  State   position, offset and scale of the paces, bias of the fixes (Gauss and Markov).
 *
 *      static insole_walker_ekf_t walker;
 *      insole_walker_ekf_init(&walker, &insole_walker_ekf_defaults);
 *      insole_walker_start_t start = {t_us, spot, cov_m2, offset_rad, var_offset_rad2, by_radio};
 *      insole_walker_ekf_start(&walker, &start);
 *      on each step:
 *          insole_walker_ekf_step(&walker, &pace);
 *      with a magnetometer, every two seconds:
 *          insole_walker_ekf_compass(&walker, compass_less_gyro_rad, sigma_rad);
 *      on each scan that gave a fix:
 *          insole_walker_ekf_fix(&walker, &fix);
 *      insole_walker_ekf_answer(&walker, &answer);
 *
 *  A fix is p - s Rot(offset) since + ahead_m u + b + noise: where the radio heard it, so far ahead
 *  in the direction u of the last pace that had a length, and wrong by the bias b.
 *
 *  Time  b has no part in steps, and what it has in common with the other states fades by the same
 *  factor whenever that is done. So it is done when a fix comes, by the time since the fix before
 *  (or the start): steps and compass need no time.
 *
 *  Direction  While the offset is known to half a radian, the filter is an extended one; with less
 *  it goes on in states in which it is linear (walker_state.h). So any start is safe, also one in a
 *  direction that nobody knows.
 *
 *  Variances of a pace  Along counts the larger of what the settings and what the pace tell. A told
 *  variance of the heading is split: what this pace and the one before both tell is the drift of
 *  frame n, whose rise goes to the offset when it is more than the setting; what this one tells
 *  beyond belongs to its own way alone. The level at the start is that of the offset, as started.
 *
 *  Gate  as step_fusion.h: R times (nis / gate)^2; from `patience` in a row on the covariance of
 *  the position is widened, and so is the offset's variance.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_WALKER_EKF_H
#define INSOLE_FUSE_WALKER_EKF_H

#include "insole/base/config.h"
#include "insole/fuse/step_news.h"
#include "insole/fuse/walker_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_WALKER_EKF_KEYS(KEY)                                                               \
    KEY(REAL, along, 0.3, 0.0, 2.0, "", "1-sigma of a pace along its way, share of its length")   \
    KEY(REAL, across_rad, 0.07, 0.0, 1.0, "rad", "1-sigma of a pace's own direction")             \
    KEY(REAL, turn_rad, 0.044, 0.0, 1.0, "rad", "wander of the offset per pace")                  \
    KEY(REAL, wander_scale, 0.005, 0.0, 0.1, "", "wander of the scale per pace")                  \
    KEY(REAL, sigma_scale, 0.12, 0.001, 1.0, "", "1-sigma of the scale at the start, and at most") \
    KEY(REAL, bias_m, 3.5, 0.0, 100.0, "m", "1-sigma of what fixes share; 0 = nothing")           \
    KEY(REAL, bias_s, 15.0, 0.1, 10000.0, "s", "how long that lasts")                             \
    KEY(REAL, ahead_m, 1.0, -10.0, 10.0, "m", "a fix lies so far ahead of the walker")            \
    KEY(REAL, gate, 9.0, 0.1, 1.0e9, "",                                                          \
        "normalised innovation squared beyond which a fix does not fit; 1e9 = off")               \
    KEY(INT, patience, 4, 1, 1000000, "", "so many in a row do not fit: P is widened")            \
    KEY(REAL, widen, 4.0, 1.1, 100.0, "", "factor on P for each fix from then on")
/* clang-format on */

typedef struct {
    INSOLE_WALKER_EKF_KEYS(INSOLE_CONFIG_MEMBER)
} insole_walker_ekf_config_t;

extern const insole_walker_ekf_config_t insole_walker_ekf_defaults;

typedef struct {
    uint64_t t_us;
    insole_spot_t spot;            /**< m */
    insole_sym2_t cov_m2;          /**< m; without the bias */
    insole_real_t offset_rad;      /**< -1000 .. 1000 */
    insole_real_t var_offset_rad2; /**< >= 0; pi^2 / 3 and more: not known */
    bool by_radio;                 /**< found from fixes, whose bias the position then has */
} insole_walker_start_t;

typedef struct {
    insole_walker_ekf_config_t config;
    bool started;
    bool by_radio; /**< is how the start was found */
    bool has_fix;  /**< a fix has come since the start */
    insole_walker_state_t state;
    insole_real_t bias_m;     /**< 1-sigma of what fixes share now; no more than the setting */
    insole_turn_t ahead;      /**< direction of the newest pace, n; zeros before the first */
    insole_real_t told_rad2;  /**< variance of heading that the newest pace told */
    insole_real_t drift_rad2; /**< and its part that the one before told, too */
    uint64_t bias_us;         /**< time of the bias: that of the newest fix, or of the start */
    insole_real_t nis;        /**< of the newest fix, before any gate */
    uint32_t gated_in_row;    /**< newest fixes that did not fit */
    uint32_t steps, fixes;    /**< taken, since the start */
    uint32_t gated, widened;  /**< fixes that did not fit, and those that widened P */
    uint32_t refused;
} insole_walker_ekf_t;

typedef struct {
    insole_spot_t spot; /**< m */
    insole_sym2_t cov_m2;
    insole_real_t offset_rad;       /**< from n to m, (-pi, pi] */
    insole_real_t var_offset_rad2;  /**< up to pi^2 / 3: not known */
    insole_real_t scale, var_scale; /**< of lengths */
} insole_walker_answer_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_walker_ekf_init(insole_walker_ekf_t *walker,
                                       const insole_walker_ekf_config_t *config);

/** Also later, as a start anew.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE as insole_spot_fix_check(), or for an offset that is
 *          none */
insole_status_t insole_walker_ekf_start(insole_walker_ekf_t *walker,
                                        const insole_walker_start_t *start);

/** @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the start; INSOLE_ERR_VALUE as
 *          insole_pace_check(), or when the position would leave the numbers */
insole_status_t insole_walker_ekf_step(insole_walker_ekf_t *walker, const insole_pace_t *pace);

/** @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the start; INSOLE_ERR_TIME for a fix that is
 *          not newer than the one before; INSOLE_ERR_VALUE as insole_spot_fix_check(). A fix that
 *          the gate holds off is no refusal: `gated_in_row` tells. */
insole_status_t insole_walker_ekf_fix(insole_walker_ekf_t *walker, const insole_spot_fix_t *fix);

/** From now on fixes share errors of this 1-sigma, or of the setting's when that is smaller: what
 *  they tell of themselves may show that a map is better than the setting takes it for.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for one that is negative or not finite */
insole_status_t insole_walker_ekf_bias(insole_walker_ekf_t *walker, insole_real_t sigma_m);

/** The offset was seen, with an error of its own.
 *  @param sigma_rad  1-sigma; pi / sqrt(3) and more: nothing is learned
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the start; INSOLE_ERR_VALUE for an offset
 * beyond 1000 rad or a sigma under 1e-3 */
insole_status_t insole_walker_ekf_compass(insole_walker_ekf_t *walker, insole_real_t offset_rad,
                                          insole_real_t sigma_rad);

/** What is known now.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE, the answer untouched, before the start */
insole_status_t insole_walker_ekf_answer(const insole_walker_ekf_t *walker,
                                         insole_walker_answer_t *answer);

#ifdef __cplusplus
}
#endif

#endif
