/** @file insole.h  Insole: where a walking person is, without GPS. Umbrella header.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_INSOLE_H
#define INSOLE_INSOLE_H

#define INSOLE_VERSION_MAJOR 0
#define INSOLE_VERSION_MINOR 1
#define INSOLE_VERSION_PATCH 0
#define INSOLE_VERSION       "0.1.0"

#include "insole/base/config.h"
#include "insole/base/fastmath.h"
#include "insole/base/mat.h"
#include "insole/base/quat.h"
#include "insole/base/real.h"
#include "insole/base/ring.h"
#include "insole/base/rng.h"
#include "insole/base/snapshot.h"
#include "insole/base/status.h"
#include "insole/base/ticks.h"
#include "insole/base/types.h"
#include "insole/base/unscented.h"
#include "insole/base/vec3.h"
#include "insole/fuse/cloud_source.h"
#include "insole/fuse/evidence.h"
#include "insole/fuse/particle_cloud.h"
#include "insole/fuse/particle_filter.h"
#include "insole/fuse/weighing.h"
#include "insole/move/attitude.h"
#include "insole/move/attitude_ekf.h"
#include "insole/move/attitude_ukf.h"
#include "insole/move/heading.h"
#include "insole/move/magnetic.h"
#include "insole/move/step_length.h"
#include "insole/move/stride.h"
#include "insole/move/zupt_cov.h"
#include "insole/move/zupt_ekf.h"
#include "insole/move/zupt_smooth.h"
#include "insole/place/floor_plan.h"
#include "insole/place/floor_plan_build.h"
#include "insole/place/heard.h"
#include "insole/place/kde_fix.h"
#include "insole/place/map_search.h"
#include "insole/place/ml_fix.h"
#include "insole/place/propagation.h"
#include "insole/place/radio_map.h"
#include "insole/place/radio_survey.h"
#include "insole/place/range_fix.h"
#include "insole/place/robust_fit.h"
#include "insole/place/rss_field.h"
#include "insole/place/rss_fix.h"
#include "insole/place/spot_mixture.h"
#include "insole/place/wall_losses.h"
#include "insole/sense/gyro_clip.h"
#include "insole/sense/rhythm.h"
#include "insole/sense/screen.h"
#include "insole/sense/step.h"
#include "insole/sense/still_bias.h"
#include "insole/sense/still_window.h"
#include "insole/sense/zero_velocity.h"
#include "insole/track/foot_anchor.h"
#include "insole/track/foot_config.h"
#include "insole/track/foot_smooth.h"
#include "insole/track/foot_tracker.h"
#include "insole/track/foot_walk.h"

#endif
