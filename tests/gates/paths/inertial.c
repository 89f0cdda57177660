/* SPDX-License-Identifier: MIT
 * The inertial filter alone: prediction and zero-velocity correction. */
#include <insole/move/zupt_ekf.h>

extern volatile insole_imu_t sensor;

static insole_zupt_ekf_t foot;

int main(void)
{
    insole_real_t nis;
    (void)insole_zupt_ekf_init(&foot, &insole_zupt_ekf_defaults);
    (void)insole_zupt_ekf_align(&foot, sensor.accel_mps2, sensor.t_us);
    for (;;) {
        insole_imu_t imu = sensor;
        (void)insole_zupt_ekf_predict(&foot, &imu);
        (void)insole_zupt_ekf_correct(&foot, &nis);
    }
}
