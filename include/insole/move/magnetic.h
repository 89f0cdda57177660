/** @file magnetic.h  The earth's field as a second direction, behind a test for disturbance.
 *
 *  Source  [PhoneUKF] 5.2.1, eqs. (11)-(12).
 *  Frames  b: phone, with the magnetometer's axes.  n: that of the attitude.
 *
 *  Indoors a compass is often wrong by 20 to 30 degrees, and off by default. What can be seen of a
 *  disturbance is a change of strength and dip: the more of it, the less a reading counts, and
 *  beyond a gate it does not. What changes the azimuth alone can not be seen.
 *
 *      static insole_magnetic_t magnetic;
 *      insole_magnetic_init(&magnetic, &config);                   config.use = 1
 *      on each reading, after the sample that came before:
 *          insole_magnetic_push(&magnetic, &phone, insole_attitude_ukf, &mag);
 *
 *  The reference is the one that was told, or the mean of the first readings: then the field keeps
 *  the heading from drifting, and knows no north. When n is turned (insole_attitude_set_heading),
 *  it is to be told or learned again.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_MAGNETIC_H
#define INSOLE_MOVE_MAGNETIC_H

#include "insole/move/attitude.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_MAGNETIC_KEYS(KEY)                                                                 \
    KEY(CHOICE, use, 0, 0, 1, "off|on", "corrections of the attitude by the magnetic field")      \
    KEY(REAL, noise_ut_rts, 5.0, 0.01, 1000.0, "uT*sqrt(s)",                                      \
        "noise density of a field that looks undisturbed")                                        \
    KEY(REAL, soft_ut, 2.0, 0.0, 1000.0, "uT",                                                    \
        "deviation in strength and dip that doubles the variance; 0 = off")                       \
    KEY(REAL, gate_ut, 8.0, 0.01, 1000.0, "uT",                                                   \
        "deviation in strength and dip beyond which nothing is learned")                          \
    KEY(INT, readings, 25, 1, 10000, "",                                                          \
        "readings whose mean becomes the reference when none is told")
/* clang-format on */

typedef struct {
    INSOLE_MAGNETIC_KEYS(INSOLE_CONFIG_MEMBER)
} insole_magnetic_config_t;

extern const insole_magnetic_config_t insole_magnetic_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_magnetic_check(const insole_magnetic_config_t *config);

typedef struct {
    insole_magnetic_config_t config;
    bool has_time;
    uint64_t t_us;              /**< of the newest reading */
    insole_vec3_t field_ut;     /**< n, the reference */
    uint32_t learned;           /**< readings it is the mean of */
    bool told;                  /**< it was told, or its readings are complete */
    insole_real_t deviation_ut; /**< of the newest reading from the reference */
    uint32_t corrected, passed; /**< readings used, and not trusted */
    uint32_t refused;
} insole_magnetic_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_magnetic_init(insole_magnetic_t *magnetic,
                                     const insole_magnetic_config_t *config);

/** The undisturbed field in n; no length: to be learned anew.
 *  @return INSOLE_ERR_VALUE beyond 1e4 uT */
insole_status_t insole_magnetic_set_field(insole_magnetic_t *magnetic, insole_vec3_t field_ut);

/** Learns the reference, then corrects the attitude, if `use` is on.
 *  @return INSOLE_ERR_STATE before the attitude is level; INSOLE_ERR_TIME, also when the newest
 *          sample is more than its `gap_s` away; INSOLE_ERR_VALUE beyond 1e4 uT */
insole_status_t insole_magnetic_push(insole_magnetic_t *magnetic, insole_attitude_t *att,
                                     insole_attitude_method_t *method, const insole_mag_t *mag);

/** The push and its state, for a tracker: one that is given none links nothing of it. */
typedef struct {
    insole_status_t (*push)(insole_magnetic_t *magnetic, insole_attitude_t *att,
                            insole_attitude_method_t *method, const insole_mag_t *mag);
    insole_magnetic_t *state; /**< stays where it is */
} insole_magnetic_part_t;

/** Direction in n of the level part of a reading, counter-clockwise from +x: magnetic north, where
 *  nothing disturbs. Tests nothing.
 *  @return INSOLE_ERR_STATE before the start, or when less than 1 uT is level; INSOLE_ERR_VALUE */
insole_status_t insole_magnetic_azimuth(const insole_attitude_t *att, insole_vec3_t field_b_ut,
                                        insole_real_t *azimuth_rad);

#ifdef __cplusplus
}
#endif

#endif
