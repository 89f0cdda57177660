/** @file cloud_source.h  A normal summary of a cloud: where it is, goes, and is drawn from.
 *
 *  Frames  n: level, of the strides.  m: map.
 *
 *      insole_cloud_source_t source = insole_cloud_source(&fix, sigma_scale);
 *      insole_cloud_source_walk(&source, &stride);
 *      insole_cloud_source_widen(&source, sigma_m, sigma_rad);
 *      for each particle:
 *          insole_cloud_source_draw(&source, &particle, &plan, &rng);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_CLOUD_SOURCE_H
#define INSOLE_FUSE_CLOUD_SOURCE_H

#include "insole/base/sym2.h"
#include "insole/fuse/particle_cloud.h"
#include "insole/place/floor_plan.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_real_t x_m, y_m;
    insole_real_t var_x_m2, cov_xy_m2, var_y_m2;
    insole_real_t offset_rad;       /**< from directions in n to directions in m */
    insole_real_t sigma_offset_rad; /**< pi or more: any direction */
    insole_real_t scale, sigma_scale;
    insole_real_t even; /**< 1: drawn evenly over the upright rectangle of these variances; 0:
                           normal; a number, so that there is no padding to differ in */
} insole_cloud_source_t;

/** The summary of a cloud whose particles are to have such a scatter of scale. */
insole_cloud_source_t insole_cloud_source(const insole_cloud_fix_t *fix, insole_real_t sigma_scale);

/** All of a plan, in any direction: what is known before anything is.
 *  @param plan  not NULL */
insole_cloud_source_t insole_cloud_source_everywhere(const insole_floor_plan_t *plan,
                                                     insole_real_t sigma_scale);

/** Moves it there, with this covariance of its place; offset and scale stay. */
void insole_cloud_source_put(insole_cloud_source_t *source, insole_spot_t spot,
                             insole_sym2_t cov_m2);

/** The turn from ways in n to ways in m: the shorter the less its direction is known, so that the
 *  way it gives is the mean of all. */
insole_turn_t insole_cloud_source_turn(const insole_cloud_source_t *source);

/** Goes where the stride takes the cloud, and grows by what is not known of it. */
void insole_cloud_source_walk(insole_cloud_source_t *source, const insole_cloud_stride_t *stride);

/** Adds to what is not known. */
void insole_cloud_source_widen(insole_cloud_source_t *source, insole_real_t sigma_m,
                               insole_real_t sigma_rad);

/** How wide it is beside such 1-sigmas, > 0: 0 far narrower, 1/2 as wide, 1 far wider. */
insole_real_t insole_cloud_source_width(const insole_cloud_source_t *source, insole_real_t sigma_m,
                                        insole_real_t sigma_rad);

/** Takes in a share (0 .. 1) of another: mean and covariance of place become those of the mixture;
 *  offset and scale stay. */
void insole_cloud_source_mix(insole_cloud_source_t *source, const insole_cloud_source_t *other,
                             insole_real_t share);

/** Draws one particle of weight 1. With a plan it is dead unless it is found in the walkable area
 *  within a few attempts.
 *  @param plan  NULL: it may be anywhere */
void insole_cloud_source_draw(const insole_cloud_source_t *source, insole_particle_t *particle,
                              const insole_floor_plan_t *plan, insole_rng_t *rng);

/** How far copies are moved aside at most. */
typedef struct {
    insole_real_t x_m, y_m, offset_rad;
} insole_cloud_aside_t;

/** @param share  1-sigma of the moves, as a share of the source's */
insole_cloud_aside_t insole_cloud_source_aside(const insole_cloud_source_t *source,
                                               insole_real_t share);

/** Moves a copy aside, evenly to either side: copies that stay together tell no more than one. Its
 *  place stays when a wall stands in the way.
 *  @param plan  NULL: no walls */
void insole_cloud_source_spread(const insole_cloud_aside_t *aside, insole_particle_t *particle,
                                const insole_floor_plan_t *plan, insole_rng_t *rng);

#ifdef __cplusplus
}
#endif

#endif
