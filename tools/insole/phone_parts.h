/** @file phone_parts.h  What the phone tracker is made of, by the name of the method.
 *
 *      phone_parts_init(&parts, &setup);
 *      insole_phone_tracker_init(&tracker, &parts.config, &parts.library, parts.map);
 *      phone_parts_free(&parts);
 *
 *  The library's own forest tells where the phone is carried, which the settings may make use of.
 *  `best` is a cloud of particles where a plan is known, and else the filter of six states. `zee`
 *  begins with the first fix, whatever direction it gives; without a radio map, all over the plan.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PHONE_PARTS_H
#define INSOLE_HOST_PHONE_PARTS_H

#include "insole/fuse/ml_shift.h"
#include "insole/fuse/step_cloud.h"
#include "insole/fuse/step_fusion.h"
#include "insole/fuse/walker_filter.h"
#include "insole/place/kde_fix.h"
#include "insole/place/ml_fix.h"
#include "insole/track/phone_gait.h"
#include "insole/track/phone_tracker.h"

#include "estimator_setup.h"
#include "phone_rival.h"

/** Particles where nobody tells: the papers' rivals have more, most that which may be anywhere. */
enum { PHONE_PARTICLES = 500, PHONE_RIVAL_PARTICLES = 1000, PHONE_ZEE_PARTICLES = 10000 };

/** States of all parts; those in use are pointed at. It stays where it is. */
typedef struct {
    insole_phone_tracker_config_t config;
    insole_phone_parts_t library;
    const insole_radio_map_t *map; /**< NULL: the method has no use for it, or there is none */
    insole_magnetic_t magnetic;
    insole_walk_heading_t walk_heading;
    insole_carry_t carry;
    insole_phone_gait_t gait;
    insole_step_fusion_t step_fusion;
    insole_ml_shift_t ml_shift;
    insole_walker_ekf_t walker_ekf;
    insole_step_cloud_t step_cloud;
    insole_cloud_t memory; /**< lent to it; no particles: the method has none */
    phone_rival_t rival;
    insole_kde_fix_t kde_fix;
    insole_ml_fix_t ml_fix;
} phone_parts_t;

/** @return false when the library does not take the settings */
bool phone_parts_init(phone_parts_t *parts, const estimator_setup_t *setup);

void phone_parts_free(phone_parts_t *parts);

#endif
