/* SPDX-License-Identifier: MIT */
#include "walk_samples.h"

#include <math.h>
#include <string.h>

#define SENSOR                                                                                     \
    .roll_height_m = 0.09, .mounting = {1.0, 0.0, 0.0, 0.0}, .gravity_mps2 = 9.81,                 \
    .accel_noise_mps2 = 0.03, .gyro_noise_radps = 0.003

const walk_t WALK = {.strides = 10,
                     .rest_s = 3.0,
                     .stance_s = 0.45,
                     .swing_s = 0.6,
                     .length_m = 1.45,
                     .lift_m = 0.08,
                     .roll_radps = 0.15,
                     .toe_down_rad = 0.9,
                     .toe_up_rad = 0.35,
                     SENSOR};
const walk_t RUN = {.strides = 10,
                    .rest_s = 3.0,
                    .stance_s = 0.16,
                    .swing_s = 0.54,
                    .length_m = 2.2,
                    .lift_m = 0.2,
                    .roll_radps = 1.2,
                    .toe_down_rad = 1.4,
                    .toe_up_rad = 0.3,
                    SENSOR};
const walk_t STAIRS = {.strides = 10,
                       .rest_s = 3.0,
                       .stance_s = 0.5,
                       .swing_s = 0.6,
                       .length_m = 0.56,
                       .climb_m = 0.34,
                       .lift_m = 0.1,
                       .roll_radps = 0.1,
                       .toe_down_rad = 0.8,
                       .toe_up_rad = 0.3,
                       SENSOR};
const walk_t CRAWL = {.strides = 10,
                      .rest_s = 3.0,
                      .stance_s = 0.9,
                      .swing_s = 0.6,
                      .length_m = 0.5,
                      .lift_m = 0.02,
                      .roll_radps = 0.5,
                      .toe_down_rad = 0.3,
                      .toe_up_rad = 0.1,
                      SENSOR};

enum { QUADRATURE = 4 };
static const double NODE[QUADRATURE] = {-0.8611363115940526, -0.3399810435848563,
                                        0.3399810435848563, 0.8611363115940526};
static const double WEIGHT[QUADRATURE] = {0.1739274225687269, 0.3260725774312731,
                                          0.3260725774312731, 0.1739274225687269};

double walk_end_s(const walk_t *walk)
{
    return 2.0 * walk->rest_s + walk->strides * (walk->swing_s + walk->stance_s) - walk->stance_s;
}

/* Where in the walk: completed strides, and the share of the swing that is done (1: stance). */
typedef struct {
    int strides;
    double swing;    /* 0 to 1; 1 in a stance */
    double stance_s; /* time since the middle of the stance */
    bool resting;
} phase_t;

static phase_t phase_at(const walk_t *walk, double t_s)
{
    double period_s = walk->swing_s + walk->stance_s, since_s = t_s - walk->rest_s;
    int index = (int)floor(since_s / period_s);
    double into_s = since_s - index * period_s;
    bool swinging = into_s < walk->swing_s;
    if (index < 0 || walk->strides == 0) {
        return (phase_t){0, 1.0, 0.0, true};
    }
    if (index >= walk->strides || (index == walk->strides - 1 && !swinging)) {
        return (phase_t){walk->strides, 1.0, 0.0, true};
    }
    if (swinging) {
        return (phase_t){index, into_s / walk->swing_s, 0.0, false};
    }
    return (phase_t){index + 1, 1.0, into_s - walk->swing_s - 0.5 * walk->stance_s, false};
}

/* 0 to 1 with two derivatives zero at both ends. */
static double ease(double u)
{
    return u * u * u * (10.0 + u * (6.0 * u - 15.0));
}

/* A bump of height 1 with its top at p / (p + q). */
static double bump(double u, int p, int q)
{
    double top = (double)p / (p + q);
    return pow(u / top, p) * pow((1.0 - u) / (1.0 - top), q);
}

/* Quintic from value a, slope da to b, db per unit of u; curvature zero at both ends. */
static double join(double u, double a, double da, double b, double db)
{
    double straight = a + da * u, e = ease(u);
    double v = u - 1.0, back = b + db * v;
    return straight * (1.0 - e) + back * e;
}

static double pitch_at(const walk_t *walk, const phase_t *ph)
{
    if (ph->resting) {
        return 0.0;
    }
    if (ph->swing >= 1.0) {
        return walk->roll_radps * ph->stance_s;
    }
    bool first = ph->strides == 0, last = ph->strides == walk->strides - 1;
    double edge = 0.5 * walk->roll_radps * walk->stance_s;
    double slope = walk->roll_radps * walk->swing_s;
    double plain = join(ph->swing, first ? 0.0 : edge, first ? 0.0 : slope, last ? 0.0 : -edge,
                        last ? 0.0 : slope);
    return plain + walk->toe_down_rad * bump(ph->swing, 3, 6) -
           walk->toe_up_rad * bump(ph->swing, 6, 3);
}

/* Contact point after `strides` whole ones, and on the way of the next. */
static void contact_at(const walk_t *walk, const phase_t *ph, double at_m[3])
{
    double u = ph->swing < 1.0 ? ease(ph->swing) : 0.0, n = ph->strides,
           half = 0.5 * walk->turn_rad;
    double chord = fabs(half) > 1.0e-9 ? sin(n * half) / sin(half) : n; /* of n strides in a bow */
    double mean = walk->heading_rad + n * half, next = walk->heading_rad + (2.0 * n + 1.0) * half;
    at_m[0] = walk->length_m * (chord * cos(mean) + u * cos(next));
    at_m[1] = walk->length_m * (chord * sin(mean) + u * sin(next));
    at_m[2] = walk->climb_m * (n + u);
    at_m[2] += ph->swing < 1.0 ? walk->lift_m * bump(ph->swing, 4, 4) : 0.0;
}

walk_pose_t walk_pose(const walk_t *walk, double t_s)
{
    walk_pose_t pose;
    phase_t ph = phase_at(walk, t_s);
    double turned = ph.strides + (ph.swing < 1.0 ? ease(ph.swing) : 0.0);
    pose.pitch_rad = pitch_at(walk, &ph);
    pose.yaw_rad = walk->heading_rad + turned * walk->turn_rad;
    pose.stance = ph.swing >= 1.0;
    contact_at(walk, &ph, pose.contact_m);
    double c = cos(pose.yaw_rad), s = sin(pose.yaw_rad);
    double cp = cos(pose.pitch_rad), sp = sin(pose.pitch_rad);
    double foot[3][3] = {{c * cp, -s, c * sp}, {s * cp, c, s * sp}, {-sp, 0.0, cp}};
    memcpy(pose.foot, foot, sizeof foot);
    for (int i = 0; i < 3; i++) {
        pose.sensor_m[i] = pose.contact_m[i] + walk->roll_height_m * foot[i][2];
    }
    return pose;
}

/* From foot to b. */
static void mount(const walk_t *walk, const double in[3], double out[3])
{
    double w = walk->mounting[0], x = -walk->mounting[1], y = -walk->mounting[2],
           z = -walk->mounting[3];
    double t[3] = {2.0 * (y * in[2] - z * in[1]), 2.0 * (z * in[0] - x * in[2]),
                   2.0 * (x * in[1] - y * in[0])};
    out[0] = in[0] + w * t[0] + y * t[2] - z * t[1];
    out[1] = in[1] + w * t[1] + z * t[0] - x * t[2];
    out[2] = in[2] + w * t[2] + x * t[1] - y * t[0];
}

void walk_rates(const walk_t *walk, double t_s, double accel_mps2[3], double gyro_radps[3])
{
    const double h = 1.0e-4;
    walk_pose_t before = walk_pose(walk, t_s - h), now = walk_pose(walk, t_s),
                after = walk_pose(walk, t_s + h);
    double force_n[3], force[3];
    for (int i = 0; i < 3; i++) {
        double rise = after.sensor_m[i] - now.sensor_m[i],
               fall = now.sensor_m[i] - before.sensor_m[i];
        force_n[i] = (rise - fall) / (h * h) + (i == 2 ? walk->gravity_mps2 : 0.0);
    }
    for (int i = 0; i < 3; i++) {
        force[i] =
            now.foot[0][i] * force_n[0] + now.foot[1][i] * force_n[1] + now.foot[2][i] * force_n[2];
    }
    double yaw_rate = (after.yaw_rad - before.yaw_rad) / (2.0 * h);
    double pitch_rate = (after.pitch_rad - before.pitch_rad) / (2.0 * h);
    double rate[3] = {-yaw_rate * sin(now.pitch_rad), pitch_rate, yaw_rate * cos(now.pitch_rad)};
    mount(walk, force, accel_mps2);
    mount(walk, rate, gyro_radps);
}

static insole_vec3_t measured(const double mean[3], const double bias[3], double noise,
                              insole_rng_t *rng)
{
    double told[3];
    for (int i = 0; i < 3; i++) {
        told[i] = mean[i] + bias[i] + (rng ? noise * (double)insole_rng_normal(rng) : 0.0);
    }
    return insole_vec3((insole_real_t)told[0], (insole_real_t)told[1], (insole_real_t)told[2]);
}

insole_imu_t walk_sample(const walk_t *walk, double from_s, double to_s, insole_rng_t *rng)
{
    double accel[3] = {0.0, 0.0, 0.0}, gyro[3] = {0.0, 0.0, 0.0}, a[3], w[3];
    for (int k = 0; k < QUADRATURE; k++) {
        walk_rates(walk, 0.5 * (from_s + to_s) + 0.5 * (to_s - from_s) * NODE[k], a, w);
        for (int i = 0; i < 3; i++) {
            accel[i] += WEIGHT[k] * a[i];
            gyro[i] += WEIGHT[k] * w[i];
        }
    }
    insole_imu_t imu;
    imu.t_us = (uint64_t)llround(to_s * 1.0e6);
    imu.accel_mps2 = measured(accel, walk->accel_bias_mps2, walk->accel_noise_mps2, rng);
    imu.gyro_radps = measured(gyro, walk->gyro_bias_radps, walk->gyro_noise_radps, rng);
    return imu;
}
