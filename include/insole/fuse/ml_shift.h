/** @file ml_shift.h  Paces shifted to where the last fixes by radio make them most likely.
 *
 *  Source  [WifiShift] III.B, eqs. (2)-(4).
 *  Frames  m: map.  n: level, the frame of the paces' headings; heading in m = heading in n +
 * offset.
 *
 *      static insole_ml_shift_t ml;
 *      insole_ml_shift_init(&ml, &insole_ml_shift_defaults);
 *      insole_ml_shift_start(&ml, spot, cov_m2, offset_rad);
 *      on each step:
 *          insole_ml_shift_step(&ml, &pace);
 *      on each scan that gave a fix:
 *          insole_ml_shift_fix(&ml, &fix);
 *      use(ml.spot, ml.P);
 *
 *  The window holds the last fixes L_w and where the paces were, L_p, when they were heard. The
 *  shift makes the product of the densities of all L_w (sigma*) and L_p (sigma) about L_p + shift
 *  largest. A product of normal densities needs no search: the shift is the mean of L_w - L_p,
 *  weighted by what is known of each, times sigma^2 / (sigma^2 + sigma*^2).
 *
 *  sigma* is that of the distances from fix to fix, as printed, or as each fix tells, or constant.
 *  sigma is printed as "based on the variance of strides": `strides` takes that of the lengths of
 *  all paces since the oldest fix of the window, which leaves out headings and corrects next to
 *  nothing. `innovations`, the default, takes what sigma* leaves over of the distances between L_w
 *  and L_p.
 *
 *  The paper has no covariance. P is a bound that holds however the errors of fixes and paces hang
 *  together: with the shift's share g, sigma_new <= (1 - g) sigma_old + g sigma_fix.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_ML_SHIFT_H
#define INSOLE_FUSE_ML_SHIFT_H

#include "insole/base/config.h"
#include "insole/fuse/step_filter.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_ML_SHIFT_MOST = 16 /**< fixes of the window */ };

/* clang-format off */
#define INSOLE_ML_SHIFT_KEYS(KEY)                                                                 \
    KEY(INT, window, 4, 1, 16, "fixes", "epsilon: so many of the last fixes count")               \
    KEY(CHOICE, pdr, 0, 0, 2, "innovations|strides|constant", "where sigma of (2) comes from")    \
    KEY(REAL, sigma_pdr_m, 1.5, 0.001, 1000.0, "m", "sigma, when constant or not yet learned")    \
    KEY(CHOICE, radio, 0, 0, 2, "distances|told|constant", "where sigma* of (2) comes from")      \
    KEY(REAL, sigma_radio_m, 4.0, 0.001, 1000.0, "m", "sigma*, when constant or not yet learned") \
    KEY(REAL, prior_count, 4.0, 0.01, 1000.0, "fixes", "so many the settings count as") \
    KEY(INT, memory, 64, 2, 10000, "fixes", "over so many it is learned")                         \
    KEY(REAL, least_m, 0.1, 0.001, 10.0, "m", "no learned sigma is smaller")
/* clang-format on */

typedef struct {
    INSOLE_ML_SHIFT_KEYS(INSOLE_CONFIG_MEMBER)
} insole_ml_shift_config_t;

extern const insole_ml_shift_config_t insole_ml_shift_defaults;

enum {
    INSOLE_ML_SHIFT_INNOVATIONS = 0,
    INSOLE_ML_SHIFT_STRIDES = 1,
    INSOLE_ML_SHIFT_FIXED_PDR = 2
};
enum { INSOLE_ML_SHIFT_DISTANCES = 0, INSOLE_ML_SHIFT_TOLD = 1, INSOLE_ML_SHIFT_FIXED_RADIO = 2 };

/** Mean and variance of the last numbers. */
typedef struct {
    uint32_t count; /**< up to the memory */
    insole_real_t mean, variance;
} insole_ml_shift_scatter_t;

/** A fix of the window. */
typedef struct {
    insole_spot_t radio;  /**< L_w, m */
    insole_spot_t pdr;    /**< L_p, m, with all shifts since */
    insole_sym2_t cov_m2; /**< of the fix, as told */
    uint32_t step;        /**< steps taken before it */
} insole_ml_shift_pair_t;

typedef struct {
    insole_ml_shift_config_t config;
    bool started;
    insole_spot_t spot;                     /**< m */
    insole_sym2_t P;                        /**< m^2, a circle */
    insole_real_t offset_rad;               /**< from n to m */
    insole_spot_t shift;                    /**< by the newest fix */
    insole_real_t var_pdr_m2, var_radio_m2; /**< sigma^2 and sigma*^2 of that; told: of that fix */
    uint64_t fix_us;                        /**< of the newest fix */
    uint32_t count, next;                   /**< pairs of the window; slot of the next one */
    insole_ml_shift_pair_t pair[INSOLE_ML_SHIFT_MOST];
    insole_ml_shift_scatter_t lengths;     /**< of paces */
    insole_ml_shift_scatter_t distances;   /**< from fix to fix */
    insole_ml_shift_scatter_t innovations; /**< half the squares of L_w - L_p */
    uint32_t steps, fixes;                 /**< taken, since the start */
    uint32_t refused;
} insole_ml_shift_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_ml_shift_init(insole_ml_shift_t *ml, const insole_ml_shift_config_t *config);

/** The position is known; also later, as a start anew. What was learned of the scatters stays.
 *  @param offset_rad  heading in m less heading in n; -1000 .. 1000
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE as insole_spot_fix_check() */
insole_status_t insole_ml_shift_start(insole_ml_shift_t *ml, insole_spot_t spot,
                                      insole_sym2_t cov_m2, insole_real_t offset_rad);

/** @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the start; INSOLE_ERR_VALUE as
 *          insole_pace_check(), or when the position would leave the numbers */
insole_status_t insole_ml_shift_step(insole_ml_shift_t *ml, const insole_pace_t *pace);

/** @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the start; INSOLE_ERR_TIME for a fix that is
 *          not newer than the one before; INSOLE_ERR_VALUE as insole_spot_fix_check() */
insole_status_t insole_ml_shift_fix(insole_ml_shift_t *ml, const insole_spot_fix_t *fix);

/** For a tracker; the state is an `insole_ml_shift_t`. */
extern const insole_step_filter_calls_t insole_ml_shift_calls;

#ifdef __cplusplus
}
#endif

#endif
