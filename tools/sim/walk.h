/** @file walk.h  A simulated walk with a sensor on the foot or in a phone, sample by sample.
 *
 *      sim_walk_t *walk = sim_walk_open(&scenario, seed, &error);       NULL: error tells why
 *      sim_sample_t sample;
 *      while (sim_walk_next(walk, &sample)) {
 *          if (sample.given) insole_foot_tracker_imu(&tracker, &sample.imu);
 *      }
 *      sim_walk_close(walk);
 *
 *  Equal scenarios and seeds give equal samples on a machine.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_WALK_H
#define INSOLE_SIM_WALK_H

#include "sim/gait.h"
#include "sim/imu_model.h"
#include "sim/motion.h"
#include "sim/phone.h"
#include "sim/scenario.h"

typedef struct {
    sim_motion_t truth; /**< of the sensor: time, pose, and what an ideal sensor reads */
    sim_vec3_t foot_m;  /**< the foot's origin, on the sole */
    bool flat;          /**< the foot is on the ground and neither lands nor pushes off */
    bool given;         /**< false when the sensor lost this sample */
    insole_imu_t imu;   /**< what the sensor reads, if given */
} sim_sample_t;

typedef struct sim_walk sim_walk_t;

/** @return NULL when the orders cannot be walked or memory is short */
sim_walk_t *sim_walk_open(const sim_scenario_t *scenario, uint64_t seed, sim_error_t *error);

/** The next sample, the first at t = 0; false when the walk is over. */
bool sim_walk_next(sim_walk_t *walk, sim_sample_t *sample);

double sim_walk_duration(const sim_walk_t *walk);      /**< s */
double sim_walk_distance(const sim_walk_t *walk);      /**< m, along the path, level */
const sim_imu_t *sim_walk_imu(const sim_walk_t *walk); /**< the sensor with its errors */
const sim_gait_t *sim_walk_gait(const sim_walk_t *walk);
const sim_steps_t *sim_walk_steps(const sim_walk_t *walk);

/** NULL when the sensor is the shoe's. */
const sim_phone_t *sim_walk_phone(const sim_walk_t *walk);

/** The sensor as a body, for the motion at any time. */
sim_body_t sim_walk_body(const sim_walk_t *walk);

/** Direction of the foot's first two strides that lead somewhere.
 *  @return false when there are no such strides */
bool sim_walk_start_heading(const sim_walk_t *walk, double *heading_rad);

void sim_walk_close(sim_walk_t *walk);

#endif
