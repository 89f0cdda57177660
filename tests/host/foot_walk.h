/** @file foot_walk.h  A foot that walks as formulas say: what its sensor reads is known exactly.
 *
 *  It stands `rest_s`, makes `strides` strides of `length_m`, each a swing of SWING_S and a stance
 *  of STANCE_S, turns by `turn_rad` in each swing, and stands `rest_s` again. Along the swing
 *  the way goes as s(u) = 10 u^3 - 15 u^4 + 6 u^5, the height as 64 h u^3 (1 - u)^3.
 *
 *  A swing that hardly turns looks like a stance in its middle, where nothing accelerates: a
 *  `turn_rad` of 0.1 and more keeps that from being taken for rest.
 *
 *  Sensor axes: x along the foot, z up.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HOST_FOOT_WALK_H
#define INSOLE_TESTS_HOST_FOOT_WALK_H

#include <math.h>
#include <stdio.h>

#define SWING_S    0.6
#define STANCE_S   0.5
#define LIFT_M     0.1
#define GRAVITY_MPS2 9.81

typedef struct {
    double rest_s, length_m, turn_rad, rate_hz;
    int strides;
    double begin_s; /**< time of the first reading */
} foot_walk_t;

typedef struct {
    double x_m, y_m, z_m, yaw_rad;
    double accel_mps2[3], gyro_radps[3]; /**< as the sensor reads them */
} foot_pose_t;

static inline double foot_walk_duration(const foot_walk_t *walk)
{
    return 2.0 * walk->rest_s + walk->strides * (SWING_S + STANCE_S);
}

/** Pose `t_s` after the first reading. */
static inline foot_pose_t foot_walk_pose(const foot_walk_t *walk, double t_s)
{
    foot_pose_t pose = {0.0, 0.0, 0.0, 0.0, {0.0, 0.0, GRAVITY_MPS2}, {0.0, 0.0, 0.0}};
    double heading = 0.0, in_walk = t_s - walk->rest_s;
    int stride = in_walk < 0.0 ? -1 : (int)(in_walk / (SWING_S + STANCE_S));
    for (int i = 0; i < stride && i < walk->strides; i++) {
        pose.x_m += walk->length_m * cos(heading);
        pose.y_m += walk->length_m * sin(heading);
        heading += walk->turn_rad;
    }
    double u = (in_walk - stride * (SWING_S + STANCE_S)) / SWING_S;
    pose.yaw_rad = heading;
    if (stride < 0 || stride >= walk->strides) {
        return pose;
    }
    u = u > 1.0 ? 1.0 : u;
    double s = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
    double ds = 30.0 * u * u * (1.0 - u) * (1.0 - u) / SWING_S;
    double dds = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / (SWING_S * SWING_S);
    double v = u * (1.0 - u);
    double lift = 64.0 * LIFT_M * (6.0 * v * (1.0 - 2.0 * u) * (1.0 - 2.0 * u) - 6.0 * v * v);
    pose.x_m += walk->length_m * s * cos(heading);
    pose.y_m += walk->length_m * s * sin(heading);
    pose.z_m = 64.0 * LIFT_M * v * v * v;
    pose.yaw_rad = heading + walk->turn_rad * s;
    double turned = walk->turn_rad * s; /* of the sensor against the direction of the swing */
    pose.accel_mps2[0] = walk->length_m * dds * cos(turned);
    pose.accel_mps2[1] = -walk->length_m * dds * sin(turned);
    pose.accel_mps2[2] = GRAVITY_MPS2 + lift / (SWING_S * SWING_S);
    pose.gyro_radps[2] = walk->turn_rad * ds;
    return pose;
}

/** Writes the log as `imu` records; readings are those in the middle of each interval. */
static inline void foot_walk_write(const foot_walk_t *walk, FILE *file)
{
    int count = (int)(foot_walk_duration(walk) * walk->rate_hz);
    for (int i = 0; i <= count; i++) {
        double t_s = i / walk->rate_hz;
        foot_pose_t pose = foot_walk_pose(walk, t_s - 0.5 / walk->rate_hz);
        fprintf(file, "imu,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", walk->begin_s + t_s,
                pose.accel_mps2[0], pose.accel_mps2[1], pose.accel_mps2[2], pose.gyro_radps[0],
                pose.gyro_radps[1], pose.gyro_radps[2]);
    }
}

/** Writes the truth as a table t,x,y,z at 10 Hz. */
static inline void foot_walk_write_truth(const foot_walk_t *walk, FILE *file)
{
    fputs("t,x,y,z\n", file);
    for (int i = 0; i <= (int)(10.0 * foot_walk_duration(walk)); i++) {
        foot_pose_t pose = foot_walk_pose(walk, 0.1 * i);
        fprintf(file, "%.6f,%.6f,%.6f,%.6f\n", walk->begin_s + 0.1 * i, pose.x_m, pose.y_m,
                pose.z_m);
    }
}

#endif
