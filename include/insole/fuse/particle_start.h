/** @file particle_start.h  Where a cloud begins: what is known of place and direction.
 *
 *  Frames  n: level, of the strides.  m: map.
 *
 *      insole_particle_start_t start = {x_m, y_m, 0.3, offset_rad, 0.09};
 *      if (insole_particle_start_check(&start) == INSOLE_OK)
 *          insole_cloud_source_t source = insole_particle_start_source(&start, sigma_scale);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_PARTICLE_START_H
#define INSOLE_FUSE_PARTICLE_START_H

#include "insole/fuse/cloud_source.h"
#include "insole/fuse/step_news.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is known at the start. */
typedef struct {
    insole_real_t x_m, y_m;
    insole_real_t sigma_m;          /**< of each coordinate, 0 .. 10 km */
    insole_real_t offset_rad;       /**< from directions in n to directions in m */
    insole_real_t sigma_offset_rad; /**< >= 0; pi or more: not known */
} insole_particle_start_t;

/** The same, as a covariance or radio tells it. */
typedef struct {
    insole_spot_fix_t at; /**< `since` is not looked at */
    bool by_radio;        /**< `at` is a fix by fingerprints, with the bias that they have */
    insole_real_t offset_rad, sigma_offset_rad;
} insole_particle_origin_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for what is not finite or out of range */
insole_status_t insole_particle_start_check(const insole_particle_start_t *start);

/** @return as above; also as insole_spot_fix_check() */
insole_status_t insole_particle_origin_check(const insole_particle_origin_t *origin);

/** What particles are drawn from.
 *  @param sigma_scale  of a stride's true length over its measured one */
insole_cloud_source_t insole_particle_start_source(const insole_particle_start_t *start,
                                                   insole_real_t sigma_scale);

/** @param sigma_bias_m  of the bias of fixes, counts when radio tells */
insole_cloud_source_t insole_particle_origin_source(const insole_particle_origin_t *origin,
                                                    insole_real_t sigma_bias_m,
                                                    insole_real_t sigma_scale);

#ifdef __cplusplus
}
#endif

#endif
