/* SPDX-License-Identifier: MIT
 * The whole path of the shoe: detector, inertial filter, strides, 500 particles, plan and radio. */
#include <insole/track/foot_fusion.h>

extern volatile insole_imu_t sensor;
extern const insole_building_t building;
extern const insole_scan_t heard;
extern volatile insole_spot_t shown;

static insole_foot_fusion_t shoe;
static insole_particle_t particles[500];

int main(void)
{
    static const insole_fusion_memory_t memory = {.particles = particles, .count = 500};
    insole_fix_t fix;
    (void)insole_foot_fusion_init(&shoe, &insole_foot_fusion_defaults, &memory, &building, 1u);
    for (;;) {
        insole_imu_t imu = sensor;
        (void)insole_foot_fusion_imu(&shoe, &imu);
        (void)insole_foot_fusion_scan(&shoe, &heard);
        while (insole_foot_fusion_next(&shoe, &fix) == INSOLE_OK) {
            shown.x_m = fix.position_m.x;
            shown.y_m = fix.position_m.y;
        }
        (void)insole_foot_fusion_work(&shoe, 50u);
    }
}
