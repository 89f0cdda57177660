/* SPDX-License-Identifier: MIT */
#include "imu_pairer.h"

#include <string.h>

#include "number.h"

void imu_pairer_init(imu_pairer_t *pairer)
{
    memset(pairer, 0, sizeof *pairer);
    pairer->waiting = insole_ring(PAIRER_ROOM);
}

void imu_pairer_push(imu_pairer_t *pairer, const record_t *record)
{
    if (record->kind == RECORD_GYR) {
        pairer->gyro[insole_ring_push(&pairer->waiting)] = *record;
        pairer->newest_us = record->t_us;
        return;
    }
    pairer->accel[0] = pairer->accel[1];
    pairer->accel[1] = *record;
    pairer->accel_count = pairer->accel_count < 2 ? pairer->accel_count + 1 : 2;
}

void imu_pairer_finish(imu_pairer_t *pairer)
{
    pairer->has_ended = true;
}

static bool is_bracketed(const imu_pairer_t *pairer, int64_t t_us)
{
    const record_t *accel = pairer->accel;
    return pairer->accel_count == 2 && accel[0].t_us <= t_us && t_us <= accel[1].t_us &&
           accel[0].t_us < accel[1].t_us && accel[1].t_us - accel[0].t_us <= PAIRER_HOLD_US;
}

/* Share of the newer accelerometer reading; not-a-number when neither is near enough. */
static double share_of_newer(const imu_pairer_t *pairer, int64_t t_us)
{
    const record_t *accel = pairer->accel;
    if (is_bracketed(pairer, t_us)) {
        return (double)(t_us - accel[0].t_us) / (double)(accel[1].t_us - accel[0].t_us);
    }
    bool is_near = pairer->accel_count > 0 && t_us - accel[1].t_us <= PAIRER_HOLD_US &&
                   accel[1].t_us - t_us <= PAIRER_WAIT_US;
    return is_near ? 1.0 : NUMBER_UNKNOWN;
}

static bool is_ready(const imu_pairer_t *pairer, int64_t t_us)
{
    bool has_newer_accel = pairer->accel_count > 0 && pairer->accel[1].t_us >= t_us;
    return has_newer_accel || pairer->has_ended || pairer->newest_us - t_us > PAIRER_WAIT_US ||
           insole_ring_count(&pairer->waiting) > PAIRER_ROOM / 2;
}

bool imu_pairer_take(imu_pairer_t *pairer, record_t *imu)
{
    if (insole_ring_count(&pairer->waiting) == 0u) {
        return false;
    }
    const record_t *gyro = &pairer->gyro[insole_ring_slot(&pairer->waiting, pairer->waiting.begin)];
    if (!is_ready(pairer, gyro->t_us)) {
        return false;
    }
    double share = share_of_newer(pairer, gyro->t_us);
    imu->kind = RECORD_IMU;
    imu->t_us = gyro->t_us;
    imu->id = 0u;
    for (int i = 0; i < 3; i++) {
        double older = share < 1.0 ? (1.0 - share) * pairer->accel[0].value[i] : 0.0;
        imu->value[i] = older + share * pairer->accel[1].value[i];
        imu->value[3 + i] = gyro->value[i];
    }
    insole_ring_pop(&pairer->waiting);
    return true;
}
