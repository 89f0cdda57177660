/* SPDX-License-Identifier: MIT
 * fuse/: the particle filter in offices of equal density and different size, on a walk along a
 * corridor, into a room and back. All that a stride takes is counted, for all particles together.
 */
#include "bench.h"
#include "bench_office.h"

#define LEG_M INSOLE_R(1.2)

enum { PARTICLES = 500, STRIDES = 48, SLICE = 50 };

/* ---- a walk, and what is told of it ---- */

static insole_spot_t at, inertial;
static insole_real_t length_m, heading_rad, turn_rad;
static insole_particle_t particles[PARTICLES];
static const insole_cloud_t cloud = {particles, PARTICLES, NULL, 0, NULL};
static insole_particle_filter_t filter;

static void begin_walk(const insole_particle_filter_config_t *config)
{
    insole_particle_start_t start = {INSOLE_R(2.0), INSOLE_R(6.1), INSOLE_R(0.3), INSOLE_R(0.0),
                                     config->sigma_wander_rad * INSOLE_R(4.0)};
    at.x_m = inertial.x_m = start.x_m;
    at.y_m = inertial.y_m = start.y_m;
    heading_rad = INSOLE_R(0.0);
    bench_put_aps();
    insole_particle_filter_init(&filter, config, 1u);
    insole_particle_filter_start(&filter, &cloud, &start);
    while (insole_particle_filter_work(&filter, &cloud, &bench_building, SLICE)) {
    }
}

/* Ten strides along the corridor, two into a room, turn about, and all the way back. */
static insole_real_t way_of(uint32_t stride)
{
    static const insole_real_t quarters[4] = {INSOLE_R(0.0), INSOLE_R(1.0), INSOLE_R(-1.0),
                                              INSOLE_R(2.0)};
    uint32_t k = stride % 24u;
    return INSOLE_R(0.5) * INSOLE_PI * quarters[k < 10u ? 0u : k < 12u ? 1u : k < 14u ? 2u : 3u];
}

static void make_stride(uint32_t call)
{
    insole_real_t way_rad = way_of(call);
    insole_turn_t way = insole_turn(way_rad);
    insole_real_t measured_rad = way_rad + INSOLE_R(0.03) * insole_rng_normal(&bench_rng);
    length_m = LEG_M + INSOLE_R(0.02) * insole_rng_normal(&bench_rng);
    turn_rad = call == 0u ? INSOLE_R(0.0) : measured_rad - heading_rad;
    heading_rad = measured_rad;
    at.x_m += LEG_M * way.cos;
    at.y_m += LEG_M * way.sin;
    inertial.x_m = at.x_m + INSOLE_R(0.01) * (insole_real_t)call;
    inertial.y_m = at.y_m;
    bench_listen(at, way_rad);
}

/* ---- what is counted ---- */

static void work(const insole_evidence_t *news)
{
    insole_particle_filter_begin(&filter, &bench_building, news);
    while (insole_particle_filter_work(&filter, &cloud, &bench_building, SLICE)) {
    }
    bench_result[0] = filter.fix.x_m;
    bench_result[1] = filter.fix.y_m;
    bench_result[2] = filter.fix.offset_rad;
    bench_result[3] = filter.fix.scale;
    bench_result[4] = filter.fix.effective;
    bench_result[5] = (insole_real_t)filter.counts.recovered;
    bench_result[6] = (insole_real_t)filter.counts.resampled;
}

/* All that is heard, and nothing else. */
static void take_scan(void)
{
    static const insole_spot_t here = {0, 0};
    insole_evidence_t news;
    insole_evidence_clear(&news);
    insole_evidence_stride(&news, length_m, heading_rad, turn_rad);
    insole_evidence_scan(&news, bench_readings, BENCH_APS, here);
    work(&news);
}

static uint32_t strongest(void)
{
    uint32_t best = 0;
    for (uint32_t i = 1; i < BENCH_APS; i++) {
        best = bench_readings[i].rss_dbm > bench_readings[best].rss_dbm ? i : best;
    }
    return best;
}

/* The paper's second order: where the first one is, and how far the strongest access point. */
static void take_position_and_range(void)
{
    const insole_rss_t *reading = &bench_readings[strongest()];
    const insole_ap_t *ap = &bench_building.aps[reading->id];
    insole_rss_range_t heard = {INSOLE_R(1.0), INSOLE_R(1.0)};
    insole_evidence_t news;
    insole_evidence_clear(&news);
    insole_evidence_stride(&news, length_m, heading_rad, turn_rad);
    insole_evidence_position(&news, inertial, INSOLE_R(0.5));
    insole_propagation_range(&insole_propagation_defaults, ap, reading->rss_dbm, INSOLE_R(0.0),
                             INSOLE_R(0.5), &heard);
    insole_evidence_range_t range = {{ap->x_m, ap->y_m}, {0, 0}, heard.range_m, INSOLE_R(2.0), 0};
    insole_evidence_range(&news, &range);
    work(&news);
}

static void begin_small(void)
{
    bench_build_office(5u, 2u);
    begin_walk(&insole_particle_filter_defaults);
}

static void begin_usual(void)
{
    bench_build_office(7u, 13u);
    begin_walk(&insole_particle_filter_defaults);
}

static void begin_huge(void)
{
    bench_build_office(26u, 35u);
    begin_walk(&insole_particle_filter_defaults);
}

static void begin_small_two_order(void)
{
    bench_build_office(5u, 2u);
    begin_walk(&insole_particle_filter_two_order);
}

static void begin_usual_two_order(void)
{
    bench_build_office(7u, 13u);
    begin_walk(&insole_particle_filter_two_order);
}

static void begin_huge_two_order(void)
{
    bench_build_office(26u, 35u);
    begin_walk(&insole_particle_filter_two_order);
}

static void call_insole_particle_filter_100(uint32_t call)
{
    (void)call;
    take_scan();
}

static void call_insole_particle_filter_1000(uint32_t call)
{
    (void)call;
    take_scan();
}

static void call_insole_particle_filter_10000(uint32_t call)
{
    (void)call;
    take_scan();
}

static void call_insole_particle_filter_two_order_100(uint32_t call)
{
    (void)call;
    take_position_and_range();
}

static void call_insole_particle_filter_two_order_1000(uint32_t call)
{
    (void)call;
    take_position_and_range();
}

static void call_insole_particle_filter_two_order_10000(uint32_t call)
{
    (void)call;
    take_position_and_range();
}

static const bench_case_t cases[] = {
    {"insole_particle_filter_100", STRIDES, begin_small, make_stride,
     call_insole_particle_filter_100, NULL},
    {"insole_particle_filter_1000", STRIDES, begin_usual, make_stride,
     call_insole_particle_filter_1000, NULL},
    {"insole_particle_filter_10000", STRIDES, begin_huge, make_stride,
     call_insole_particle_filter_10000, NULL},
    {"insole_particle_filter_two_order_100", STRIDES, begin_small_two_order, make_stride,
     call_insole_particle_filter_two_order_100, NULL},
    {"insole_particle_filter_two_order_1000", STRIDES, begin_usual_two_order, make_stride,
     call_insole_particle_filter_two_order_1000, NULL},
    {"insole_particle_filter_two_order_10000", STRIDES, begin_huge_two_order, make_stride,
     call_insole_particle_filter_two_order_10000, NULL},
};

const bench_table_t bench_fuse = BENCH_TABLE(cases);
