/** @file carry_table.h  The forest that comes with the library: hand, ear, swinging hand, pocket.
 *
 *  Source  [PhoneUKF] 4: these positions; grown by `insole train-carry` on simulated walkers with
 *          accelerometer and gyroscope (tests/reference/carry_forest.py, which grows it again).
 *
 *      insole_phone_gait_init(&gait, &heading, &carry, &insole_carry_table_forest);
 *
 *  It asks about the turn rate: windows without a gyroscope are refused. Whoever walks with the
 *  phone in another place should grow a forest of their own.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_CARRY_TABLE_H
#define INSOLE_SENSE_CARRY_TABLE_H

#include "insole/sense/carry_forest.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Its classes. */
enum {
    INSOLE_CARRY_HAND,   /**< before the chest, looked at */
    INSOLE_CARRY_EAR,    /**< in a call */
    INSOLE_CARRY_SWING,  /**< in the hand of an arm that swings */
    INSOLE_CARRY_POCKET, /**< of the trousers */
    INSOLE_CARRY_POSITIONS
};

extern const insole_carry_forest_t insole_carry_table_forest;

#ifdef __cplusplus
}
#endif

#endif
