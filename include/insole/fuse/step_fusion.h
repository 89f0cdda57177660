/** @file step_fusion.h  Steps and fixes by radio made one position: a Kalman filter of two states.
 *
 *  Source  [PhoneEKF] 3.3, eqs. (31)-(33), (35), (38)-(40); [PhoneUKF] 6.2, eqs. (38)-(40), (42),
 *          (45)-(47); the filters with constant covariances of its 7.1.
 *  Frames  m: map.  n: level, the frame of the paces' headings; heading in m = heading in n +
 * offset. State   position and its covariance P, m.
 *
 *  What both papers share is here: a position that is seen as it is, and the gate. What they
 *  differ in is the method that finds mean and covariance of a pace's way: insole_step_ekf
 *  (step_ekf.h), insole_step_ukf (step_ukf.h), or NULL: the way as told, with a covariance of
 *  constant size (plain Kalman filter). Only the method that is named is linked.
 *
 *      static insole_step_fusion_t fusion;
 *      insole_step_fusion_init(&fusion, &insole_step_fusion_defaults);
 *      insole_step_fusion_start(&fusion, spot, cov_m2, offset_rad);
 *      on each step:
 *          insole_step_fusion_step(&fusion, insole_step_ekf, &pace);
 *      on each scan that gave a fix:
 *          insole_step_fusion_fix(&fusion, &fix);
 *      use(fusion.spot, fusion.P);
 *
 *  Rivals: `process = constant`, `measurement = constant` take the settings for what the papers
 *  adapt: "EKF (empirical)", "UKF (empirical)" and, with NULL, "KF (empirical)".
 *
 *  Gate: a fix whose normalised innovation squared is beyond `gate` counts less the farther it is
 *  off, or not at all. When `patience` of them come in a row the walker may have been carried off:
 *  that one and each further one first multiplies P by `widen`, until one passes. From a distance
 *  D that takes patience + log(D^2 / (gate P)) / log(widen) fixes.
 *
 *  The errors of steps count as independent; a heading that is wrong by the same amount all the
 *  way is not covered by the covariance, unless the paces tell a variance that is large enough.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_STEP_FUSION_H
#define INSOLE_FUSE_STEP_FUSION_H

#include "insole/base/config.h"
#include "insole/fuse/step_filter.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_STEP_FUSION_KEYS(KEY)                                                              \
    KEY(CHOICE, process, 0, 0, 1, "told|constant", "variances of length and heading of a pace")   \
    KEY(REAL, sigma_length_m, 0.1, 0.0, 10.0, "m", "constant: 1-sigma of the length")             \
    KEY(REAL, sigma_heading_rad, 0.2, 0.0, 3.2, "rad", "constant: 1-sigma of the heading")        \
    KEY(REAL, sigma_way_m, 0.2, 0.0, 10.0, "m",                                                   \
        "plain Kalman filter: 1-sigma of each coordinate of a pace's way")                        \
    KEY(CHOICE, measurement, 0, 0, 1, "told|constant", "covariance of a fix")                     \
    KEY(REAL, sigma_fix_m, 4.0, 0.001, 1000.0, "m", "constant: 1-sigma of each coordinate")       \
    KEY(REAL, gate, 9.0, 0.1, 1.0e9, "",                                                          \
        "normalised innovation squared beyond which a fix does not fit; 1e9 = off")               \
    KEY(CHOICE, gated, 0, 0, 1, "soften|pass",                                                    \
        "one that does not fit: its covariance times (nis / gate)^2, or it is passed over")       \
    KEY(INT, patience, 4, 1, 1000000, "", "so many in a row do not fit: P is widened")            \
    KEY(REAL, widen, 4.0, 1.1, 100.0, "", "factor on P for each fix from then on")
/* clang-format on */

typedef struct {
    INSOLE_STEP_FUSION_KEYS(INSOLE_CONFIG_MEMBER)
} insole_step_fusion_config_t;

extern const insole_step_fusion_config_t insole_step_fusion_defaults;

enum { INSOLE_STEP_TOLD = 0, INSOLE_STEP_CONSTANT = 1 };
enum { INSOLE_STEP_SOFTEN = 0, INSOLE_STEP_PASS = 1 };

/** The way of a pace: mean and covariance. */
typedef struct {
    insole_spot_t mean;
    insole_sym2_t Q;
} insole_step_way_t;

/** How a method finds the way of a pace that has passed insole_pace_check(). */
typedef insole_step_way_t insole_step_method_t(const insole_pace_t *pace);

typedef struct {
    insole_step_fusion_config_t config;
    bool started;
    bool has_fix;             /**< a fix has come since the start */
    insole_spot_t spot;       /**< m */
    insole_sym2_t P;          /**< m^2 */
    insole_real_t offset_rad; /**< from n to m */
    uint64_t fix_us;          /**< of the newest fix */
    insole_real_t nis;        /**< of the newest fix, before any gate */
    uint32_t gated_in_row;    /**< newest fixes that did not fit */
    uint32_t steps, fixes;    /**< taken, since the start */
    uint32_t gated, widened;  /**< fixes that did not fit, and those that widened P */
    uint32_t refused;
} insole_step_fusion_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_step_fusion_init(insole_step_fusion_t *fusion,
                                        const insole_step_fusion_config_t *config);

/** The position is known; also later, as a start anew.
 *  @param offset_rad  heading in m less heading in n; -1000 .. 1000
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE as insole_spot_fix_check() */
insole_status_t insole_step_fusion_start(insole_step_fusion_t *fusion, insole_spot_t spot,
                                         insole_sym2_t cov_m2, insole_real_t offset_rad);

/** @param method  NULL: the plain Kalman filter
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the start; INSOLE_ERR_VALUE as
 *          insole_pace_check(), or when the position would leave the numbers */
insole_status_t insole_step_fusion_step(insole_step_fusion_t *fusion, insole_step_method_t *method,
                                        const insole_pace_t *pace);

/** @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the start; INSOLE_ERR_TIME for a fix that is
 *          not newer than the one before; INSOLE_ERR_VALUE as insole_spot_fix_check(). A fix that
 *          the gate holds off is no refusal: `gated_in_row` tells. */
insole_status_t insole_step_fusion_fix(insole_step_fusion_t *fusion, const insole_spot_fix_t *fix);

/** What the tables of all methods share, over an `insole_step_fusion_t`. */
insole_status_t insole_step_fusion_begin_state(void *state,
                                               const insole_step_filter_begin_t *begin);
insole_status_t insole_step_fusion_fix_state(void *state, const insole_spot_fix_t *fix);
insole_status_t insole_step_fusion_answer_state(const void *state,
                                                insole_step_filter_answer_t *answer);

/** The plain Kalman filter for a tracker. */
extern const insole_step_filter_calls_t insole_step_kf_calls;

#ifdef __cplusplus
}
#endif

#endif
