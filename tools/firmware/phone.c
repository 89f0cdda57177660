/* SPDX-License-Identifier: MIT
 * A phone held in front of its walker, with a radio map that `insole pack` has put into flash. */
#include "insole/fuse/step_ekf.h"
#include "insole/fuse/step_fusion.h"
#include "insole/move/attitude_ekf.h"
#include "insole/place/kde_fix.h"
#include "insole/track/phone_tracker.h"
#include "tracker.h"
#include "wire.h"

enum { SLICE = 16 };

extern const insole_radio_map_t site_map;

static struct {
    insole_step_fusion_t fusion;
    insole_kde_fix_t kde;
    insole_phone_tracker_t tracker;
} phone;

const uint8_t tracker_name = WIRE_PHONE;

bool tracker_begin(uint32_t seed)
{
    const insole_phone_parts_t parts = {.attitude = insole_attitude_ekf,
                                        .solver = {&insole_kde_fix_calls, &phone.kde},
                                        .filter = {&insole_step_ekf_calls, &phone.fusion}};
    (void)seed; /* nothing is drawn */
    return insole_step_fusion_init(&phone.fusion, &insole_step_fusion_defaults) == INSOLE_OK &&
           insole_kde_fix_init(&phone.kde, &insole_kde_fix_defaults) == INSOLE_OK &&
           insole_phone_tracker_init(&phone.tracker, &insole_phone_tracker_defaults, &parts,
                                     &site_map) == INSOLE_OK;
}

void tracker_imu(const insole_imu_t *imu)
{
    (void)insole_phone_tracker_imu(&phone.tracker, imu);
}

void tracker_mag(const insole_mag_t *mag)
{
    (void)insole_phone_tracker_mag(&phone.tracker, mag);
}

void tracker_start(const insole_start_t *start)
{
    (void)insole_phone_tracker_start(&phone.tracker, start);
}

void tracker_scan(uint64_t t_us, insole_rss_t *readings, uint32_t count)
{
    const insole_scan_t scan = {t_us, readings, count};
    (void)insole_phone_tracker_scan(&phone.tracker, &scan);
}

void tracker_ranges(const insole_range_t *ranges, uint32_t count)
{
    (void)ranges;
    (void)count;
}

bool tracker_next(insole_fix_t *fix)
{
    return insole_phone_tracker_next(&phone.tracker, fix) == INSOLE_OK;
}

bool tracker_work(void)
{
    return insole_phone_tracker_work(&phone.tracker, SLICE);
}

void tracker_finish(void)
{
    (void)insole_phone_tracker_finish(&phone.tracker);
}

void *tracker_state(size_t *size)
{
    *size = sizeof phone;
    return &phone;
}
