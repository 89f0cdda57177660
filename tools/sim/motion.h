/** @file motion.h  What an ideal sensor feels on a body that moves: specific force and turn rate.
 *
 *  The body tells its pose at any time; a fine grid (at least 2000 Hz) of poses is differentiated
 *  by five-point central differences, and the results are averaged over the time between two
 *  samples, as a sensor's own filter does. Nothing is integrated, so no estimator's formula is
 *  used to test that estimator.
 *
 *  Frames: b sensor, n level with z up. Specific force: +g upwards at rest.
 *
 *      sim_body_t body = {pose_of_my_sensor, &my_state};
 *      sim_motion_stream_t stream = sim_motion_stream(body, 200.0, 9.81);
 *      for (;;) {
 *          sim_motion_t m = sim_motion_next(&stream);    0 s, 0.005 s, 0.010 s ...
 *      }
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_MOTION_H
#define INSOLE_SIM_MOTION_H

#include "sim/algebra.h"

/** A sensor whose pose is known at any time; at least twice continuously differentiable. */
typedef struct {
    sim_pose_t (*pose)(const void *state, double t_s);
    const void *state;
} sim_body_t;

typedef struct {
    double t_s;
    sim_pose_t pose;       /**< at t */
    sim_vec3_t force_mps2; /**< b; at t, or mean since the sample before */
    sim_vec3_t rate_radps; /**< b; the same */
} sim_motion_t;

/** At one time, by differences of `step_s`. */
sim_motion_t sim_motion_at(const sim_body_t *body, double t_s, double step_s, double gravity_mps2);

typedef struct {
    sim_body_t body;
    double rate_hz, gravity_mps2;
    long parts;           /**< of the grid in a sample */
    long next;            /**< number of the grid point that comes into the window next */
    sim_pose_t window[5]; /**< poses around the last grid point that was given out */
    sim_motion_t last;
} sim_motion_stream_t;

/** The first sample is at t = 0. */
sim_motion_stream_t sim_motion_stream(sim_body_t body, double rate_hz, double gravity_mps2);

/** Mean of force and rate since the sample before; pose at the sample. */
sim_motion_t sim_motion_next_mean(sim_motion_stream_t *stream);

/** Force, rate and pose at the sample. */
sim_motion_t sim_motion_next_point(sim_motion_stream_t *stream);

#endif
