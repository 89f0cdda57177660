/* SPDX-License-Identifier: MIT
 * The inertial filter alone: prediction and zero-velocity correction. */
#include <insole/move/zupt_ekf.h>

extern volatile insole_imu_t sensor;
extern volatile insole_spot_t shown;

static insole_zupt_ekf_t foot;

int main(void)
{
    insole_imu_t imu = sensor;
    (void)insole_zupt_ekf_init(&foot, &insole_zupt_ekf_defaults);
    (void)insole_zupt_ekf_align(&foot, imu.accel_mps2, INSOLE_R(0.01), INSOLE_R(0.0), imu.t_us);
    for (;;) {
        imu = sensor;
        (void)insole_zupt_ekf_predict(&foot, &imu, 0u);
        (void)insole_zupt_ekf_correct(&foot, foot.dt_s, NULL);
        shown.x_m = foot.p_m.x;
        shown.y_m = foot.p_m.y;
    }
}
