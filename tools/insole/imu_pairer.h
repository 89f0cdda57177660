/** @file imu_pairer.h  Accelerometer and gyroscope that come apart, joined to one stream.
 *
 *  Each turn rate gets the specific force interpolated at its time. When the accelerometer lags
 *  by more than PAIRER_WAIT_US, its last reading is held for PAIRER_HOLD_US, and after that the
 *  specific force is not-a-number, which the estimator counts as a sensor that says nothing. What
 * is made of a reading depends on nothing that is more than PAIRER_WAIT_US younger.
 *
 *      imu_pairer_push(&pairer, &acc_or_gyr);
 *      while (imu_pairer_take(&pairer, &imu)) ...
 *      imu_pairer_finish(&pairer);          then take what is left
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_IMU_PAIRER_H
#define INSOLE_HOST_IMU_PAIRER_H

#include <stdbool.h>

#include "insole/base/ring.h"
#include "record.h"

enum { PAIRER_WAIT_US = 30000, PAIRER_HOLD_US = 100000, PAIRER_ROOM = 256 };

typedef struct {
    record_t accel[2]; /**< the two newest, older first */
    int accel_count;   /**< how many of them are there */
    record_t gyro[PAIRER_ROOM];
    insole_ring_t waiting; /**< turn rates that have no specific force yet */
    int64_t newest_us;     /**< time of the newest turn rate */
    bool has_ended;
} imu_pairer_t;

void imu_pairer_init(imu_pairer_t *pairer);

/** Takes a RECORD_ACC or RECORD_GYR. */
void imu_pairer_push(imu_pairer_t *pairer, const record_t *record);

/** The next RECORD_IMU, if it is ready. */
bool imu_pairer_take(imu_pairer_t *pairer, record_t *imu);

/** No more will come: what waits is ready. */
void imu_pairer_finish(imu_pairer_t *pairer);

#endif
