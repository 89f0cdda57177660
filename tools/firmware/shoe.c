/* SPDX-License-Identifier: MIT
 * An IMU on the shoe, in a building that `insole pack` has put into flash. */
#include "insole/track/foot_fusion.h"
#include "tracker.h"
#include "wire.h"

enum { PARTICLES = 500, SLICE = 50 };

extern const insole_floor_plan_t site_plan;
extern const insole_ap_t site_aps[];
extern const uint32_t site_ap_count;

static struct {
    insole_building_t building;
    insole_foot_fusion_t fusion;
    insole_fusion_ranges_t ranges;
    insole_particle_t particles[PARTICLES];
} shoe;

const uint8_t tracker_name = WIRE_FOOT;

bool tracker_begin(uint32_t seed)
{
    const insole_fusion_memory_t memory = {
        .particles = shoe.particles, .count = PARTICLES, .ranges = &shoe.ranges};
    const insole_building_t building = {&insole_propagation_defaults, site_aps, site_ap_count,
                                        &site_plan, &insole_foot_fusion_defaults.rss_fix};
    shoe.building = building;
    (void)insole_fusion_ranges_init(&shoe.ranges);
    return insole_foot_fusion_init(&shoe.fusion, &insole_foot_fusion_defaults, &memory,
                                   &shoe.building, seed) == INSOLE_OK;
}

void tracker_imu(const insole_imu_t *imu)
{
    (void)insole_foot_fusion_imu(&shoe.fusion, imu);
}

void tracker_mag(const insole_mag_t *mag)
{
    (void)mag; /* steel in shoes and floors */
}

void tracker_start(const insole_start_t *start)
{
    (void)insole_foot_fusion_start(&shoe.fusion, start);
}

/* A scan counts as heard when its youngest reading was. */
void tracker_scan(uint64_t t_us, insole_rss_t *readings, uint32_t count)
{
    uint32_t youngest_us = UINT32_MAX;
    for (uint32_t i = 0u; i < count; i++) {
        youngest_us = readings[i].age_us < youngest_us ? readings[i].age_us : youngest_us;
    }
    for (uint32_t i = 0u; i < count; i++) {
        readings[i].age_us -= youngest_us;
    }
    const insole_scan_t scan = {t_us > youngest_us ? t_us - youngest_us : 0u, readings, count};
    (void)insole_foot_fusion_scan(&shoe.fusion, &scan);
}

void tracker_ranges(const insole_range_t *ranges, uint32_t count)
{
    (void)insole_foot_fusion_ranges(&shoe.fusion, ranges, count);
}

bool tracker_next(insole_fix_t *fix)
{
    return insole_foot_fusion_next(&shoe.fusion, fix) == INSOLE_OK;
}

bool tracker_work(void)
{
    return insole_foot_fusion_work(&shoe.fusion, SLICE);
}

void tracker_finish(void)
{
    (void)insole_foot_fusion_finish(&shoe.fusion);
}

void *tracker_state(size_t *size)
{
    *size = sizeof shoe;
    return &shoe;
}
