/** @file stride.h  Strides of the foot: from one stance to the next.
 *
 *  Source  [TwoOrder] 3.2, eq. (33), for the length from the vertical acceleration.
 *  Frames  n: local level, z up.
 *
 *      static insole_stride_counter_t strides;
 *      insole_stride_init(&strides, &insole_stride_defaults);
 *      on each sample, after the filter:
 *          if (insole_stride_push(&strides, &state, &stride) == INSOLE_OK) use(&stride);
 *
 *  A stride ends when its last stance has lasted `settle_s`, or is over. Displacements chain: their
 *  sum is the way the filter went. Several stances on the same spot are one.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_STRIDE_H
#define INSOLE_MOVE_STRIDE_H

#include "insole/base/config.h"
#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_STRIDE_KEYS(KEY)                                                                   \
    KEY(REAL, min_length_m, 0.15, 0.0, 2.0, "m",                                                  \
        "a shorter way from stance to stance is no stride")                                       \
    KEY(REAL, settle_s, 0.1, 0.0, 1.0, "s",                                                       \
        "a stance this long ends the stride before it is over")                                   \
    KEY(REAL, k_stride, 0.0, 0.0, 5.0, "m/(m/s^2)^(1/4)",                                         \
        "K of (33), from calibrate stride; 0 = learned on the way from the filter's strides")     \
    KEY(REAL, first_k_stride, 0.55, 0.1, 5.0, "m/(m/s^2)^(1/4)",                                  \
        "K before the first stride has been seen")                                                \
    KEY(REAL, learn_weight, 0.1, 0.0, 1.0, "", "weight of a new stride in the learned K")
/* clang-format on */

typedef struct {
    INSOLE_STRIDE_KEYS(INSOLE_CONFIG_MEMBER)
} insole_stride_config_t;

extern const insole_stride_config_t insole_stride_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_stride_check(const insole_stride_config_t *config);

/** What the counter looks at. */
typedef struct {
    uint64_t t_us;
    insole_vec3_t position_m;          /**< n */
    insole_real_t yaw_rad;             /**< of the foot; looked at while it is still */
    insole_real_t vertical_force_mps2; /**< specific force along n-frame z */
    bool still;
} insole_stride_input_t;

typedef struct {
    insole_stride_config_t config;
    uint64_t t_us; /**< of the newest sample */
    bool has_time, has_origin, was_still, settled;
    insole_vec3_t origin_m; /**< where the stride in progress began */
    insole_real_t origin_yaw_rad;
    uint64_t left_us;           /**< last still sample of the stance it began with */
    uint64_t arrived_us;        /**< first still sample of the present stance */
    insole_stride_input_t last; /**< newest still sample */
    insole_real_t force_min_mps2, force_max_mps2;
    insole_real_t k;  /**< K of (33) in use */
    uint32_t learned; /**< strides that K was learned from */
    uint32_t count;   /**< strides so far */
    uint32_t refused;
} insole_stride_counter_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_stride_init(insole_stride_counter_t *counter,
                                   const insole_stride_config_t *config);

/** @param[out] stride  written only when a stride has ended
 *  @return INSOLE_OK: a stride has ended; INSOLE_ERR_STATE: not yet; INSOLE_ERR_VALUE: not finite;
 *          INSOLE_ERR_TIME */
insole_status_t insole_stride_push(insole_stride_counter_t *counter,
                                   const insole_stride_input_t *input, insole_stride_t *stride);

/** The foot goes on as it did, in its swing or on a stance that has settled: of what most samples
 *  tell the counter needs little. @return false, nothing noted: this sample is to be pushed */
static inline bool insole_stride_go_on(insole_stride_counter_t *counter, uint64_t t_us,
                                       insole_real_t vertical_force_mps2, bool still)
{
    insole_stride_counter_t *c = counter;
    if (still != c->was_still || (still && !c->settled)) {
        return false;
    }
    if (still) {
        c->last.t_us = t_us;
    } else {
        c->force_min_mps2 = insole_min(vertical_force_mps2, c->force_min_mps2);
        c->force_max_mps2 = insole_max(vertical_force_mps2, c->force_max_mps2);
    }
    return true;
}

/** The ground moved under the counter (a new origin, a gap): the stride in progress is dropped. */
void insole_stride_restart(insole_stride_counter_t *counter);

#ifdef __cplusplus
}
#endif

#endif
