/** @file settings.h  Everything that can be set in a scenario: `group.name = value`.
 *
 *  One list per group, in the manner of base/config.h: from it come the struct, the defaults, the
 *  check of the ranges and the table of maps/README.md. REAL is a double here, CHOICE an int32_t
 *  whose unit column names its values 0, 1, ... Amounts called "1-sigma" are drawn once per
 *  sensor and axis from the seed.
 *
 *      sim_settings_t settings = sim_settings_defaults;
 *      if (!sim_settings_set(&settings, "imu.rate_hz", "100", &error)) ...
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_SETTINGS_H
#define INSOLE_SIM_SETTINGS_H

#include <stddef.h>
#include <stdint.h>

#include "sim/error.h"

/** How the walker goes: speeds, steps and their variation. */
#define SIM_WALK_KEYS(KEY)                                                                         \
    KEY(REAL, lead_in_s, 3.0, 0.0, 3600.0, "s", "standing before the first step")                  \
    KEY(REAL, lead_out_s, 2.0, 0.0, 3600.0, "s", "standing after the last step")                   \
    KEY(REAL, step_length_m, 0.66, 0.3, 1.2, "m",                                                  \
        "step length at 1 m/s; it grows with the square root of the speed")                        \
    KEY(REAL, run_above_mps, 1.9, 0.5, 10.0, "m/s", "faster steps are run; 10 = never")            \
    KEY(REAL, run_rate_hz, 2.6, 1.5, 4.0, "1/s", "steps per second when running")                  \
    KEY(REAL, accel_mps2, 1.2, 0.2, 5.0, "m/s^2", "how quickly the walker speeds up and slows")    \
    KEY(REAL, turn_radius_m, 0.6, 0.1, 10.0, "m", "radius of the arc round a corner")              \
    KEY(REAL, corner_mps2, 1.8, 0.2, 10.0, "m/s^2",                                                \
        "sideways acceleration allowed on that arc; it slows the walker")                          \
    KEY(REAL, spot_turn_rad, 1.0, 0.2, 1.6, "rad", "largest turn of a foot in a turn on the spot") \
    KEY(REAL, spot_step_s, 0.6, 0.3, 2.0, "s", "duration of each step of it")                      \
    KEY(REAL, riser_m, 0.17, 0.05, 0.3, "m", "height of a stair, before rounding to whole stairs") \
    KEY(REAL, length_spread, 0.02, 0.0, 0.2, "1", "variation of step length, 1-sigma, relative")   \
    KEY(REAL, time_spread, 0.02, 0.0, 0.2, "1", "variation of step duration, 1-sigma, relative")   \
    KEY(REAL, place_spread_m, 0.01, 0.0, 0.1, "m", "sideways variation of the footfalls, 1-sigma") \
    KEY(REAL, toe_spread_rad, 0.03, 0.0, 0.3, "rad", "variation of the foot's yaw, 1-sigma")       \
    KEY(REAL, gravity_mps2, 9.81, 9.7, 9.9, "m/s^2", "local gravity")

/** How the foot moves. Angles are those of a stride of 1.4 m; shorter strides have smaller ones. */
#define SIM_GAIT_KEYS(KEY)                                                                         \
    KEY(CHOICE, foot, 0, 0, 1, "right|left", "the foot that carries the sensor")                   \
    KEY(REAL, width_m, 0.12, 0.0, 0.4, "m", "distance of the lines of the two feet")               \
    KEY(REAL, toe_out_rad, 0.10, -0.5, 0.5, "rad", "how far the toes point outwards")              \
    KEY(REAL, heel_m, 0.05, 0.01, 0.2, "m", "heel edge behind the foot's origin")                  \
    KEY(REAL, ball_m, 0.15, 0.01, 0.3, "m", "ball edge ahead of it")                               \
    KEY(REAL, soft_rad, 0.07, 0.02, 0.5, "rad",                                                    \
        "the sole rolls from heel to ball between +- this pitch")                                  \
    KEY(REAL, stance_share, 0.55, 0.5, 0.8, "1", "share of the foot on the ground at 1.2 m/s")     \
    KEY(REAL, run_stance_share, 0.36, 0.2, 0.5, "1", "the same, running at 2.5 m/s")               \
    KEY(REAL, toe_off_rad, 1.12, 0.0, 1.5, "rad", "largest pitch toe down, walking")               \
    KEY(REAL, run_toe_off_rad, 0.95, 0.0, 1.5, "rad", "pitch toe down after toe-off, running")     \
    KEY(REAL, run_fold_rad, 0.40, 0.0, 1.5, "rad", "further pitch while the leg folds, running")   \
    KEY(REAL, strike_rad, 0.45, 0.0, 1.0, "rad", "largest pitch toe up, walking")                  \
    KEY(REAL, run_strike_rad, 0.40, 0.0, 1.0, "rad", "largest pitch toe up, running")              \
    KEY(REAL, flat_roll_rad, 0.085, 0.0, 0.3, "rad",                                               \
        "pitch rolled over in stance; 0 = a flat foot")                                            \
    KEY(REAL, clearance_m, 0.04, 0.0, 0.3, "m", "lift of the swinging foot")                       \
    KEY(REAL, run_clearance_m, 0.06, 0.0, 0.5, "m", "the same, running")                           \
    KEY(REAL, side_swing_m, 0.03, -0.2, 0.2, "m", "sideways bow of the swing, outwards")           \
    KEY(REAL, swing_roll_rad, 0.22, 0.0, 0.6, "rad", "roll of the foot in swing")                  \
    KEY(REAL, swing_yaw_rad, 0.20, 0.0, 0.6, "rad", "yaw of the foot in swing")                    \
    KEY(REAL, wobble_rad, 0.0015, 0.0, 0.05, "rad", "trembling of a walking foot, rms; 0 = off")   \
    KEY(REAL, still_rad, 0.00005, 0.0, 0.01, "rad", "trembling of a standing foot, rms; 0 = off")  \
    KEY(REAL, settle_mps, 0.7, 0.0, 1.5, "m/s",                                                    \
        "speed of a walking foot against the ground when it strikes; 0 = off")                     \
    KEY(REAL, run_settle_mps, 1.0, 0.0, 2.0, "m/s", "the same, running")                           \
    KEY(REAL, settle_s, 0.022, 0.01, 0.05, "s", "time constant of the settling after it")          \
    KEY(REAL, shock_mps2, 70.0, 0.0, 300.0, "m/s^2",                                               \
        "ringing after heel strike, walking; 0 = off")                                             \
    KEY(REAL, run_shock_mps2, 70.0, 0.0, 500.0, "m/s^2", "the same, running")                      \
    KEY(REAL, shock_radps, 3.0, 0.0, 30.0, "rad/s", "ringing of the pitch rate, walking; 0 = off") \
    KEY(REAL, shock_hz, 9.0, 3.0, 50.0, "Hz", "its frequency; its double rings as well")           \
    KEY(REAL, shock_decay_s, 0.04, 0.005, 0.1, "s", "its time constant")                           \
    KEY(REAL, spread, 0.08, 0.0, 0.3, "1", "variation of all these from stride to stride, 1-sigma")

/** Where the sensor sits on the foot, and how it is turned: foot from sensor is
 *  Rz(yaw) Ry(pitch) Rx(roll); foot axes are forward, left, up. */
#define SIM_MOUNT_KEYS(KEY)                                                                        \
    KEY(REAL, x_m, 0.06, -0.5, 0.5, "m", "sensor ahead of the foot's origin")                      \
    KEY(REAL, y_m, 0.0, -0.5, 0.5, "m", "sensor to the left of it")                                \
    KEY(REAL, z_m, 0.08, -0.5, 0.5, "m", "sensor above the sole")                                  \
    KEY(REAL, roll_rad, 0.1, -3.2, 3.2, "rad", "turn about the sensor's x axis")                   \
    KEY(REAL, pitch_rad, 0.5, -1.6, 1.6, "rad", "then about y; positive lowers the x axis")        \
    KEY(REAL, yaw_rad, 0.2, -3.2, 3.2, "rad", "then about z; positive turns x to the left")

/** The sensor. `matched` leaves white noise alone, `ideal` nothing at all. */
#define SIM_IMU_KEYS(KEY)                                                                          \
    KEY(CHOICE, model, 0, 0, 2, "full|matched|ideal", "which errors the sensor has")               \
    KEY(REAL, rate_hz, 200.0, 50.0, 1000.0, "Hz", "samples per second")                            \
    KEY(CHOICE, sampling, 0, 0, 1, "average|point",                                                \
        "a sample is the mean since the one before, or the value at its stamp")                    \
    KEY(REAL, accel_noise_mps2_rthz, 0.00098, 0.0, 0.1, "m/s^2/sqrt(Hz)",                          \
        "accelerometer noise: 1-sigma of a mean over 1 s; 100 ug/sqrt(Hz)")                        \
    KEY(REAL, gyro_noise_radps_rthz, 0.000122, 0.0, 0.01, "rad/s/sqrt(Hz)",                        \
        "gyroscope noise: 1-sigma of a mean over 1 s; 0.007 deg/s/sqrt(Hz)")                       \
    KEY(REAL, accel_bias_mps2, 0.05, 0.0, 2.0, "m/s^2", "turn-on bias, 1-sigma")                   \
    KEY(REAL, gyro_bias_radps, 0.0052, 0.0, 0.5, "rad/s", "turn-on bias, 1-sigma; 0.3 deg/s")      \
    KEY(REAL, accel_drift_mps2, 0.0004, 0.0, 1.0, "m/s^2",                                         \
        "wandering part of the bias (Gauss-Markov), 1-sigma")                                      \
    KEY(REAL, gyro_drift_radps, 0.000024, 0.0, 0.1, "rad/s", "the same; 5 deg/h")                  \
    KEY(REAL, drift_time_s, 200.0, 0.1, 100000.0, "s", "correlation time of that wandering")       \
    KEY(REAL, accel_walk_mps2_rts, 0.0, 0.0, 0.1, "m/s^2/sqrt(s)", "random walk of the bias")      \
    KEY(REAL, gyro_walk_radps_rts, 0.0, 0.0, 0.01, "rad/s/sqrt(s)", "random walk of the bias")     \
    KEY(REAL, accel_scale, 0.002, 0.0, 0.1, "1", "scale error of each axis, 1-sigma")              \
    KEY(REAL, gyro_scale, 0.003, 0.0, 0.1, "1", "scale error of each axis, 1-sigma")               \
    KEY(REAL, accel_skew_rad, 0.002, 0.0, 0.1, "rad", "misalignment, 1-sigma of each cross term")  \
    KEY(REAL, gyro_skew_rad, 0.002, 0.0, 0.1, "rad", "misalignment, 1-sigma of each cross term")   \
    KEY(REAL, gyro_g_radps_per_mps2, 0.00009, 0.0, 0.01, "rad/s/(m/s^2)",                          \
        "gyroscope's sensitivity to acceleration, 1-sigma of each term; 0.05 deg/s/g")             \
    KEY(REAL, warm_up_k, 5.0, -60.0, 60.0, "K", "temperature gained after switching on")           \
    KEY(REAL, warm_up_s, 300.0, 1.0, 100000.0, "s", "time constant of that")                       \
    KEY(REAL, accel_per_k_mps2, 0.001, 0.0, 0.1, "m/s^2/K", "bias per degree, 1-sigma")            \
    KEY(REAL, gyro_per_k_radps, 0.00009, 0.0, 0.01, "rad/s/K", "bias per degree, 1-sigma")         \
    KEY(REAL, accel_range_mps2, 156.9, 10.0, 4000.0, "m/s^2", "range; 16 g")                       \
    KEY(REAL, gyro_range_radps, 34.9, 1.0, 200.0, "rad/s", "range; 2000 deg/s")                    \
    KEY(CHOICE, clip, 0, 0, 1, "hard|soft", "at the range, or bending from 90 % of it on")         \
    KEY(REAL, accel_step_mps2, 0.0048, 0.0, 1.0, "m/s^2", "smallest step of a reading; 0 = off")   \
    KEY(REAL, gyro_step_radps, 0.001065, 0.0, 0.1, "rad/s", "smallest step of a reading; 0 = off") \
    KEY(REAL, stamp_jitter_s, 0.0, 0.0, 0.1, "s",                                                  \
        "error of the stamps, 1-sigma; stamps still grow")                                         \
    KEY(REAL, dropouts_hz, 0.0, 0.0, 10.0, "1/s", "how often samples get lost; 0 = never")         \
    KEY(REAL, dropout_s, 0.02, 0.0, 10.0, "s", "mean duration of such a gap")

/** Who walks with the phone, and how the trunk moves over the feet. Drawn once per seed. */
#define SIM_PERSON_KEYS(KEY)                                                                       \
    KEY(REAL, leg_m, 0.9, 0.6, 1.2, "m", "height of the hips over the soles")                      \
    KEY(REAL, leg_spread, 0.05, 0.0, 0.2, "1",                                                     \
        "variation from person to person, 1-sigma, relative; steps grow with the leg")             \
    KEY(REAL, step_spread, 0.08, 0.0, 0.2, "1",                                                    \
        "variation of step length beside that of the leg, 1-sigma, relative")                      \
    KEY(REAL, bounce, 0.6, 0.0, 1.5, "1",                                                          \
        "share that knees and ankles leave of the rise and fall over stiff legs")                  \
    KEY(REAL, bounce_spread, 0.15, 0.0, 0.4, "1", "variation of that, 1-sigma, relative")          \
    KEY(REAL, surge, 0.5, 0.0, 1.0, "1",                                                           \
        "share of the energy of rise and fall that comes from the speed ahead")                    \
    KEY(REAL, handover, 0.45, 0.1, 0.5, "1",                                                       \
        "share of a step before and after a strike in which the weight changes feet")              \
    KEY(REAL, sway_m, 0.018, 0.0, 0.1, "m", "shift of the trunk over the foot that carries it")    \
    KEY(REAL, lean_rad, 0.02, 0.0, 0.2, "rad", "sideways lean of the trunk with it")               \
    KEY(REAL, nod_rad, 0.012, 0.0, 0.2, "rad", "pitch of the trunk within a step")                 \
    KEY(REAL, twist_rad, 0.05, 0.0, 0.3, "rad", "turn of the shoulders against the legs")          \
    KEY(REAL, strike_mps2, 5.0, 0.0, 50.0, "m/s^2", "ringing of the trunk after heel strike")      \
    KEY(REAL, strike_hz, 7.0, 3.0, 50.0, "Hz", "its frequency; its double rings as well")          \
    KEY(REAL, strike_decay_s, 0.05, 0.005, 0.1, "s", "its time constant")                          \
    KEY(REAL, spread, 0.15, 0.0, 0.3, "1", "variation from step to step, 1-sigma, relative")

/** The phone, how it is carried and how it is held there. Axes of the phone: x to the right, y to
 *  the top edge, z out of the screen. */
#define SIM_PHONE_KEYS(KEY)                                                                        \
    KEY(REAL, rate_hz, 50.0, 50.0, 1000.0, "Hz", "samples per second, in place of imu.rate_hz")    \
    KEY(CHOICE, pose, 0, 0, 3, "hand|ear|swing|pocket", "how it is carried at the start")          \
    KEY(CHOICE, side, 0, 0, 1, "right|left", "arm or leg that carries it")                         \
    KEY(CHOICE, mounting, 0, 0, 2, "told|pocket|random",                                           \
        "the turn below; or any turn, drawn by seed, in a pocket or everywhere")                   \
    KEY(REAL, roll_rad, 0.0, -3.2, 3.2, "rad", "further turn of the phone about its x axis")       \
    KEY(REAL, pitch_rad, 0.0, -1.6, 1.6, "rad", "then about y")                                    \
    KEY(REAL, yaw_rad, 0.0, -3.2, 3.2, "rad", "then about z")                                      \
    KEY(REAL, tilt_rad, 0.6, -0.5, 1.5, "rad", "in the hand: top edge raised by this")             \
    KEY(REAL, hold_rad, 0.08, 0.0, 1.0, "rad", "error of the hold, 1-sigma of each angle")         \
    KEY(REAL, wander_rad, 0.04, 0.0, 0.5, "rad", "slow changes of the hold, rms")                  \
    KEY(REAL, tremor_rad, 0.002, 0.0, 0.1, "rad", "trembling, rms; also of a standing walker")     \
    KEY(REAL, rock, 0.7, 0.0, 3.0, "1",                                                            \
        "in the hand: how far the forearm swings along with the bounce")                           \
    KEY(REAL, rock_spread, 0.3, 0.0, 0.6, "1",                                                     \
        "variation of that from person to person, 1-sigma, relative")                              \
    KEY(REAL, rock_lag_s, 0.03, 0.0, 0.2, "s", "by which the forearm is late")                     \
    KEY(REAL, swing_rad, 0.32, 0.0, 1.0, "rad", "swing of the arm to each side, step of 0.7 m")    \
    KEY(REAL, lift_rad, 0.25, 0.0, 1.0, "rad", "how far the thigh is lifted in its swing")         \
    KEY(REAL, thigh_mps2, 38.0, 0.0, 100.0, "m/s^2",                                               \
        "ringing in a pocket after the strike of that foot")                                       \
    KEY(REAL, fidgets_hz, 0.12, 0.0, 2.0, "1/s", "how often a standing walker turns it about")     \
    KEY(REAL, fidget_rad, 0.4, 0.0, 1.0, "rad", "how far, 1-sigma of each angle")                  \
    KEY(REAL, change_every_s, 0.0, 0.0, 36000.0, "s",                                              \
        "mean time from one way to carry it to the next, drawn by seed; 0 = never")                \
    KEY(REAL, change_s, 1.0, 0.3, 5.0, "s", "duration of such a change")

/** The phone's magnetometer and the field it is in. */
#define SIM_MAGNET_KEYS(KEY)                                                                       \
    KEY(CHOICE, model, 0, 0, 2, "full|ideal|off",                                                  \
        "which errors the magnetometer has; the field is the same")                                \
    KEY(REAL, rate_hz, 50.0, 1.0, 200.0, "Hz", "readings per second")                              \
    KEY(REAL, field_ut, 46.0, 0.0, 80.0, "uT", "strength of the earth's field")                    \
    KEY(REAL, dip_rad, 0.9, -1.58, 1.58, "rad", "by which it points down")                         \
    KEY(REAL, declination_rad, 0.05, -3.2, 3.2, "rad", "by which it points east of y")             \
    KEY(REAL, steel_m2, 15.0, 0.5, 10000.0, "m^2", "floor per piece of steel in the building")     \
    KEY(REAL, steel_am2, 60.0, 0.0, 2000.0, "A m^2", "moment of a piece, 1-sigma of each axis")    \
    KEY(REAL, hard_ut, 3.0, 0.0, 100.0, "uT", "offset that calibration left, 1-sigma")             \
    KEY(REAL, soft, 0.02, 0.0, 0.2, "1", "error of scale and axes, 1-sigma of each term")          \
    KEY(REAL, noise_ut, 0.6, 0.0, 10.0, "uT", "noise of a reading, 1-sigma")                       \
    KEY(REAL, step_ut, 0.15, 0.0, 10.0, "uT", "smallest step of a reading; 0 = off")

/** The radio that hears access points, and the building it hears them in. */
#define SIM_RADIO_KEYS(KEY)                                                                        \
    KEY(CHOICE, model, 0, 0, 2, "full|matched|off",                                                \
        "how signals are made; matched: white noise is the only error")                            \
    KEY(REAL, building, 1.0, 0.0, 1e9, "1",                                                        \
        "number of the building; 0 = another one for each seed")                                   \
    KEY(REAL, period_s, 1.0, 0.05, 3600.0, "s", "time from scan to scan")                          \
    KEY(REAL, readings, 1.0, 1.0, 20.0, "1",                                                       \
        "so many readings, evenly over the period, are averaged in a scan; whole")                 \
    KEY(REAL, jitter_s, 0.05, 0.0, 1.0, "s", "variation of the times of the scans, 1-sigma")       \
    KEY(REAL, missed_share, 0.02, 0.0, 1.0, "1", "scans that never come")                          \
    KEY(REAL, late_share, 0.05, 0.0, 1.0, "1", "scans that reach the log late")                    \
    KEY(REAL, late_s, 0.4, 0.01, 60.0, "s", "mean age of those")                                   \
    KEY(CHOICE, age, 1, 0, 1, "silent|told", "whether a late scan tells its age")                  \
    KEY(CHOICE, place, 0, 0, 1, "sensor|body", "what carries the radio")                           \
    KEY(REAL, height_m, 1.1, 0.0, 3.0, "m", "height on the body over the soles")                   \
    KEY(REAL, p0_dbm, -40.0, -90.0, 20.0, "dBm",                                                   \
        "received at 1 m, where the file of the access points does not tell")                      \
    KEY(REAL, exponent, 2.0, 1.0, 6.0, "1", "path loss exponent, where it does not tell")          \
    KEY(REAL, ap_height_m, 2.5, -100.0, 1000.0, "m",                                               \
        "z of an access point, where it does not tell")                                            \
    KEY(CHOICE, near, 1, 0, 1, "told|surveyed",                                                    \
        "near_dbm in the written aps.csv: as told, or the true mean at 1.5 m")                     \
    KEY(REAL, p0_spread_db, 2.5, 0.0, 30.0, "dB", "error of what the file tells, 1-sigma")         \
    KEY(REAL, exponent_spread, 0.15, 0.0, 1.0, "1", "the same of the exponent")                    \
    KEY(REAL, wall_db, 6.0, 0.0, 100.0, "dB", "loss of a wall, where the plan does not tell")      \
    KEY(REAL, wall_spread, 0.25, 0.0, 1.0, "1", "error of what the plan tells, 1-sigma, relative") \
    KEY(REAL, wall_keep, 0.8, 0.0, 1.0, "1",                                                       \
        "a further wall takes this share of what the one before took")                             \
    KEY(REAL, shadow_db, 3.5, 0.0, 20.0, "dB",                                                     \
        "shadowing, 1-sigma; each access point has its own")                                       \
    KEY(REAL, shadow_m, 4.0, 0.3, 100.0, "m", "distance at which its correlation is 1/e")          \
    KEY(REAL, rice_db, 7.0, -20.0, 60.0, "dB",                                                     \
        "fast fading: power of the direct path over the scattered")                                \
    KEY(REAL, body_db, 6.8, 0.0, 40.0, "dB", "loss straight behind the walker; 0 ahead")           \
    KEY(REAL, crowd_db, 0.0, 0.0, 30.0, "dB",                                                      \
        "loss by people who walk in between: nobody half of the time, else half a normal "         \
        "distribution of this 1-sigma")                                                            \
    KEY(REAL, crowd_s, 2.0, 0.05, 1000.0, "s", "correlation time of that")                         \
    KEY(REAL, offset_db, 2.0, 0.0, 20.0, "dB", "error of the receiver, 1-sigma")                   \
    KEY(REAL, step_db, 1.0, 0.0, 10.0, "dB", "smallest step of a reading; 0 = off")                \
    KEY(REAL, floor_dbm, -92.0, -200.0, 0.0, "dBm",                                                \
        "half of the signals of this strength are heard")                                          \
    KEY(REAL, floor_soft_db, 1.5, 0.01, 20.0, "dB",                                                \
        "softness of that: of those twice this below, 12 % are")                                   \
    KEY(REAL, lost_share, 0.02, 0.0, 1.0, "1", "signals that get lost in a scan")                  \
    KEY(REAL, noise_db, 4.0, 0.0, 30.0, "dB", "1-sigma of the noise of a matched model")

/** Ways of seeded errands. */
#define SIM_ERRANDS_KEYS(KEY)                                                                      \
    KEY(REAL, speed_mps, 1.3, 0.4, 1.8, "m/s", "mean speed")                                       \
    KEY(REAL, speed_spread, 0.1, 0.0, 0.3, "1",                                                    \
        "variation from errand to errand, 1-sigma, relative")                                      \
    KEY(REAL, pause_s, 4.0, 0.0, 600.0, "s", "mean time at each goal; from none to twice as long") \
    KEY(REAL, shortest_m, 6.0, 0.0, 1000.0, "m", "a goal is at least this far")                    \
    KEY(REAL, clearance_m, 0.45, 0.2, 2.0, "m", "distance kept from walls")

/** Stops at the reference points of a survey. */
#define SIM_SURVEY_KEYS(KEY)                                                                       \
    KEY(REAL, pause_s, 4.0, 0.5, 600.0, "s", "time at each point in each direction")               \
    KEY(REAL, directions, 1.0, 1.0, 8.0, "1",                                                      \
        "so many directions are looked in at each point, evenly spread; whole")

/** What is written. */
#define SIM_LOG_KEYS(KEY)                                                                          \
    KEY(CHOICE, sensor, 0, 0, 1, "shoe|phone", "whose samples the log holds")                      \
    KEY(CHOICE, start, 1, 0, 1, "none|known", "whether the log tells where the walk begins")       \
    KEY(REAL, start_sigma_m, 0.0, 0.0, 100.0, "m", "error of that, 1-sigma of each coordinate")    \
    KEY(REAL, start_sigma_rad, 0.0, 0.0, 3.0, "rad", "error of its heading, 1-sigma")              \
    KEY(CHOICE, imu, 1, 0, 1, "none|all", "whether the log holds the sensor's samples")            \
    KEY(CHOICE, truth, 0, 0, 1, "sensor|body", "whose place the truth is")                         \
    KEY(REAL, truth_hz, 50.0, 0.0, 1000.0, "Hz", "rows of the truth; 0 = one per sensor sample")

typedef double sim_key_type_REAL;
typedef int32_t sim_key_type_CHOICE;
#define SIM_KEY_MEMBER(kind, name, value, low, high, unit, text) sim_key_type_##kind name;

typedef struct {
    SIM_WALK_KEYS(SIM_KEY_MEMBER)
} sim_walk_settings_t;
typedef struct {
    SIM_GAIT_KEYS(SIM_KEY_MEMBER)
} sim_gait_settings_t;
typedef struct {
    SIM_MOUNT_KEYS(SIM_KEY_MEMBER)
} sim_mount_settings_t;
typedef struct {
    SIM_IMU_KEYS(SIM_KEY_MEMBER)
} sim_imu_settings_t;
typedef struct {
    SIM_PERSON_KEYS(SIM_KEY_MEMBER)
} sim_person_settings_t;
typedef struct {
    SIM_PHONE_KEYS(SIM_KEY_MEMBER)
} sim_phone_settings_t;
typedef struct {
    SIM_MAGNET_KEYS(SIM_KEY_MEMBER)
} sim_magnet_settings_t;
typedef struct {
    SIM_RADIO_KEYS(SIM_KEY_MEMBER)
} sim_radio_settings_t;
typedef struct {
    SIM_ERRANDS_KEYS(SIM_KEY_MEMBER)
} sim_errands_settings_t;
typedef struct {
    SIM_SURVEY_KEYS(SIM_KEY_MEMBER)
} sim_survey_settings_t;
typedef struct {
    SIM_LOG_KEYS(SIM_KEY_MEMBER)
} sim_log_settings_t;

enum { SIM_FOOT_RIGHT, SIM_FOOT_LEFT };
enum { SIM_MODEL_FULL, SIM_MODEL_MATCHED, SIM_MODEL_IDEAL };
enum { SIM_SAMPLING_AVERAGE, SIM_SAMPLING_POINT };
enum { SIM_CLIP_HARD, SIM_CLIP_SOFT };
enum { SIM_SENSOR_SHOE, SIM_SENSOR_PHONE };
enum { SIM_POSE_HAND, SIM_POSE_EAR, SIM_POSE_SWING, SIM_POSE_POCKET, SIM_POSES };
enum { SIM_MOUNTING_TOLD, SIM_MOUNTING_POCKET, SIM_MOUNTING_RANDOM };
enum { SIM_MAGNET_FULL, SIM_MAGNET_IDEAL, SIM_MAGNET_OFF };
enum { SIM_IMU_NONE, SIM_IMU_ALL };
enum { SIM_TRUTH_OF_SENSOR, SIM_TRUTH_OF_BODY };
enum { SIM_START_NONE, SIM_START_KNOWN };
enum { SIM_RADIO_FULL, SIM_RADIO_MATCHED, SIM_RADIO_OFF };
enum { SIM_AGE_SILENT, SIM_AGE_TOLD };
enum { SIM_CARRIED_BY_SENSOR, SIM_CARRIED_BY_BODY };
enum { SIM_NEAR_TOLD, SIM_NEAR_SURVEYED };

typedef struct {
    sim_walk_settings_t walk;
    sim_gait_settings_t gait;
    sim_mount_settings_t mount;
    sim_imu_settings_t imu;
    sim_person_settings_t person;
    sim_phone_settings_t phone;
    sim_magnet_settings_t magnet;
    sim_radio_settings_t radio;
    sim_errands_settings_t errands;
    sim_survey_settings_t survey;
    sim_log_settings_t log;
} sim_settings_t;

extern const sim_settings_t sim_settings_defaults;

/** One key, as data. */
typedef struct {
    const char *group, *name;
    bool is_choice;
    size_t offset; /**< of its member in sim_settings_t */
    double value, low, high;
    const char *unit; /**< of a choice: the names of its values, separated by `|` */
    const char *text;
} sim_key_t;

/** Key of that number, in the order of the lists; NULL past the end. */
const sim_key_t *sim_key_at(size_t number);

enum { SIM_KEY_ROW_BYTES = 256 };

/** The key as a row of the table in maps/README.md: key, default, range, unit, meaning. */
void sim_key_row(const sim_key_t *key, char row[SIM_KEY_ROW_BYTES]);

/** Sets one member from text, by its `group.name`. A refusal says what was expected and leaves
 *  the settings as they were. */
bool sim_settings_set(sim_settings_t *settings, const char *key, const char *value,
                      sim_error_t *error);

#endif
