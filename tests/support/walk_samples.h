/** @file walk_samples.h  A small walk in double precision, known exactly at every moment.
 *
 *  One foot: a rest, strides that are all alike, a rest. In a stance the foot rolls over a line on
 *  the ground, `roll_height_m` below the sensor, at a constant rate; in a swing contact point and
 *  attitude move by polynomials that join with two derivatives. Samples are means over an interval,
 *  by quadrature.
 *
 *  Frames  n: x ahead at the start, z up.  Foot: x ahead, z up.  b: the foot turned by `mounting`.
 *
 *      walk_t walk = WALK;
 *      walk.strides = 20;
 *      for (t = dt; t < walk_end_s(&walk); t += dt) imu = walk_sample(&walk, t - dt, t, NULL);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_WALK_SAMPLES_H
#define INSOLE_TESTS_WALK_SAMPLES_H

#include "insole/base/rng.h"
#include "insole/base/types.h"

typedef struct {
    int strides;
    double rest_s;        /**< before and after the walk */
    double stance_s;      /**< between two swings */
    double swing_s;       /**< */
    double length_m;      /**< of a stride, level */
    double climb_m;       /**< of a stride */
    double turn_rad;      /**< of the foot per stride */
    double lift_m;        /**< of the foot in the swing */
    double roll_radps;    /**< rate of rolling in the stance */
    double toe_down_rad;  /**< pitch early in the swing */
    double toe_up_rad;    /**< pitch late in the swing */
    double roll_height_m; /**< of the sensor over the line it rolls on */
    double heading_rad;   /**< of the foot at the start */
    double mounting[4];   /**< unit quaternion, b to foot */
    double gravity_mps2;
    double accel_bias_mps2[3], gyro_bias_radps[3]; /**< b */
    double accel_noise_mps2, gyro_noise_radps;     /**< 1-sigma of a sample */
} walk_t;

/** A walk at 1.4 m/s, a run, stairs, and a slow crawl. */
extern const walk_t WALK, RUN, STAIRS, CRAWL;

typedef struct {
    double contact_m[3]; /**< point of the rolling line, n */
    double sensor_m[3];  /**< n */
    double foot[3][3];   /**< foot to n */
    double pitch_rad, yaw_rad;
    bool stance; /**< the contact point stands still */
} walk_pose_t;

double walk_end_s(const walk_t *walk);

walk_pose_t walk_pose(const walk_t *walk, double t_s);

/** Turn rate of the sensor and its specific force at a moment, b; no bias, no noise. */
void walk_rates(const walk_t *walk, double t_s, double accel_mps2[3], double gyro_radps[3]);

/** What the sensor tells at `to_s` of the time since `from_s`; stamped `to_s`.
 *  @param rng  for the noise; NULL: none */
insole_imu_t walk_sample(const walk_t *walk, double from_s, double to_s, insole_rng_t *rng);

#endif
