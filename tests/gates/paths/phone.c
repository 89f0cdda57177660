/* SPDX-License-Identifier: MIT
 * The path of a phone in the hand: attitude, steps, fixes by fingerprints, the filter of the two.
 */
#include <insole/fuse/step_ekf.h>
#include <insole/move/attitude_ekf.h>
#include <insole/place/kde_fix.h>
#include <insole/track/phone_tracker.h>

extern volatile insole_imu_t sensor;
extern volatile insole_mag_t compass;
extern const insole_radio_map_t map; /* 200 points, in flash */
extern const insole_scan_t heard;
extern volatile insole_spot_t shown;

static insole_step_fusion_t fusion;
static insole_kde_fix_t kde;
static insole_phone_tracker_t phone;

int main(void)
{
    static const insole_phone_parts_t parts = {.attitude = insole_attitude_ekf,
                                               .solver = {&insole_kde_fix_calls, &kde},
                                               .filter = {&insole_step_ekf_calls, &fusion}};
    insole_fix_t fix;
    (void)insole_step_fusion_init(&fusion, &insole_step_fusion_defaults);
    (void)insole_kde_fix_init(&kde, &insole_kde_fix_defaults);
    (void)insole_phone_tracker_init(&phone, &insole_phone_tracker_defaults, &parts, &map);
    for (;;) {
        insole_imu_t imu = sensor;
        insole_mag_t mag = compass;
        (void)insole_phone_tracker_imu(&phone, &imu);
        (void)insole_phone_tracker_mag(&phone, &mag);
        (void)insole_phone_tracker_scan(&phone, &heard);
        while (insole_phone_tracker_next(&phone, &fix) == INSOLE_OK) {
            shown.x_m = fix.position_m.x;
            shown.y_m = fix.position_m.y;
        }
        (void)insole_phone_tracker_work(&phone, 16u);
    }
}
