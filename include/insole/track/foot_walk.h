/** @file foot_walk.h  How the walk goes, as its strides tell: direction, velocity, dead reckoning.
 *
 *  Source  [TwoOrder] 3.2: strides of length (33) in the direction of the inertial strides.
 *  Frames  n: local level.
 *
 *      static insole_foot_walk_t walk;
 *      insole_foot_walk_init(&walk);
 *      on each stride:        insole_foot_walk_stride(&walk, &stride, now_us);
 *      when samples cease:    insole_foot_walk_cease(&walk, last_us);
 *      until they come again: insole_foot_walk_on(&walk, from_us, to_us, &way_m);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FOOT_WALK_H
#define INSOLE_TRACK_FOOT_WALK_H

#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_vec3_t velocity_mps; /**< over the last stride, level */
    insole_real_t turn_radps;   /**< turn rate over it */
    insole_real_t heading_rad;  /**< direction of it */
    uint64_t stride_us;         /**< when it was told */
    bool has_stride;
    insole_vec3_t place_m;  /**< sum of the model's strides, and of the ways without samples */
    insole_real_t place_m2; /**< variance of the former, per axis */
    uint64_t ceased_us;     /**< last sample before a gap */
} insole_foot_walk_t;

/** At rest in the origin. @return INSOLE_ERR_NULL */
insole_status_t insole_foot_walk_init(insole_foot_walk_t *walk);

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a stride that is not finite, INSOLE_ERR_TIME for
 *          one that ends before it begins */
insole_status_t insole_foot_walk_stride(insole_foot_walk_t *walk, const insole_stride_t *stride,
                                        uint64_t t_us);

/** Samples have ceased. Whoever made no stride just before is taken to stand. */
insole_status_t insole_foot_walk_cease(insole_foot_walk_t *walk, uint64_t t_us);

/** Walks on without samples as the last stride went, but not for ever. @param[out] way_m  n
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_TIME unless ceased_us <= from_us < to_us */
insole_status_t insole_foot_walk_on(insole_foot_walk_t *walk, uint64_t from_us, uint64_t to_us,
                                    insole_vec3_t *way_m);

/** The turn to be expected over `time_s` without samples [rad]; 0 for NULL. */
insole_real_t insole_foot_walk_bow(const insole_foot_walk_t *walk, insole_real_t time_s);

#ifdef __cplusplus
}
#endif

#endif
