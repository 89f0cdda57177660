/** @file gait.h  The movement of one foot: stance, push-off, swing, landing.
 *
 *  On the ground the sole rolls from heel to ball (sole.h); the pitch is a sum of smooth
 *  transitions: rise of the heel and push-off to the largest pitch toe down, in a run the folding
 * of the leg, the swing to the largest pitch toe up, the landing, and a slow roll in stance. In the
 *  air the foot's origin and the height of its ball follow quintics that take over position,
 *  velocity and acceleration of the rolling on both sides, lifted for clearance. So everything
 * is twice continuously differentiable; on top come a fast ringing after each heel strike and a
 * trembling.
 *
 *  Frames: foot axes forward, left, up; outer frame m or n, z up. Origin: on the sole, `heel_m`
 *  ahead of the heel.
 *
 *      sim_gait_t gait;                                  made by strides.h
 *      sim_pose_t foot = sim_gait_pose(&gait, t_s);      any t, in any order
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_GAIT_H
#define INSOLE_SIM_GAIT_H

#include "sim/algebra.h"
#include "sim/smooth.h"
#include "sim/sole.h"
#include "sim/steps.h"

/** One change of pitch, toe up positive. */
typedef struct {
    double begin_s, length_s, rise, fall, change_rad;
} sim_transition_t;

enum { SIM_RISE, SIM_PUSH, SIM_FOLD, SIM_SWING, SIM_LAND, SIM_ROLL, SIM_TRANSITIONS };

/** What a heel strike leaves: the rest of the way to the footfall, which dies away with the
 *  velocity at the strike, and a ringing of displacement and pitch. */
typedef struct {
    sim_vec3_t settle_mps;
    double settle_s;
    sim_vec3_t shake_m;
    double pitch_rad, wave_radps, decay_s;
} sim_shock_t;

/** From one footfall to the next of the same foot, and the stance after it. */
typedef struct {
    double lift_s, strike_s;
    sim_place_t from, to;
    double pitch_before_rad;
    sim_transition_t pitch[SIM_TRANSITIONS];
    sim_quintic_t x, y; /**< of the origin in the air; time since lift */
    sim_quintic_t ball; /**< height of the ball of the foot in the air */
    double clearance_m, side_m;
    double roll_rad, yaw_rad, roll_phase_rad, yaw_phase_rad;
    sim_shock_t shock;
} sim_stride_t;

enum { SIM_TREMBLE_WAVES = 3 };

/** A sum of sines of amplitude 1 rms. */
typedef struct {
    double wave_radps[SIM_TREMBLE_WAVES], phase_rad[SIM_TREMBLE_WAVES];
} sim_tremble_t;

typedef struct {
    sim_list_t strides; /**< of sim_stride_t */
    sim_place_t home;   /**< of the foot before the first stride */
    sim_sole_t sole;
    double ball_m;
    sim_tremble_t roll, pitch, yaw;
    double wobble_rad, still_rad;
} sim_gait_t;

/** Pose of the foot at any time. */
sim_pose_t sim_gait_pose(const sim_gait_t *gait, double t_s);

/** Pitch without ringing and trembling, toe up positive. */
double sim_gait_pitch(const sim_gait_t *gait, double t_s);

/** True while the foot is on the ground and neither lands nor pushes off. */
bool sim_gait_is_flat(const sim_gait_t *gait, double t_s);

/** Origin of a foot that has rolled to this pitch at a place. */
sim_vec3_t sim_gait_rolled(const sim_gait_t *gait, const sim_place_t *place, double pitch_rad);

#endif
