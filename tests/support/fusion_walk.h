/** @file fusion_walk.h  A shoe walks a bow of a round corridor, and hears what is heard there.
 *
 *      walk_round(seed);              samples, the building and its access points
 *      fusion_case_t c = usual_case();
 *      run_case(&c);                  fixes[0 .. fix_count)
 *      mean_error(from_s, to_s)
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_FUSION_WALK_H
#define INSOLE_TESTS_FUSION_WALK_H

#include <string.h>

#include "fixes.h"
#include "insole/track/foot_lag.h"
#include "near.h"
#include "radio.h"
#include "walk_samples.h"

enum {
    FUSION_SAMPLES = 6000,
    FUSION_SCANS = 64,
    FUSION_APS = 12,
    FUSION_PARTICLES = 300,
    FUSION_PAST = 12,
    FUSION_LATE = 1200,
    FUSION_ROUND = 60, /**< strides of the whole round */
    WHOLE = 1 << 30
};

#define FUSION_PI 3.14159265358979

/** One scan, and ranges of the same moment. */
typedef struct {
    uint64_t t_us;
    insole_rss_t readings[FUSION_APS];
    insole_range_t ranges[FUSION_APS];
} heard_t;

/** A run over the walk. */
typedef struct {
    insole_foot_fusion_config_t config;
    const insole_building_t *building;
    uint32_t particles, slice; /**< of work, after each sample; WHOLE: until all is done */
    uint32_t late;             /**< rows that may wait */
    uint64_t seed;
    bool scans, ranges, has_start;
    insole_start_t start;
} fusion_case_t;

static radio_t radio;
static insole_rng_t rng;
static walk_t walk;
static double walk_x_m, walk_y_m; /* where it begins, m */
static insole_imu_t samples[FUSION_SAMPLES];
static uint32_t sample_count;
static heard_t heard[FUSION_SCANS];
static uint32_t heard_count;

static insole_particle_t fusion_particles[FUSION_PARTICLES];
static insole_spot_t fusion_past[FUSION_PARTICLES * FUSION_PAST];
static insole_late_row_t fusion_late[FUSION_LATE];
static insole_foot_late_t waiting;
static insole_fusion_ranges_t fusion_ranges;
static insole_fusion_start_t fixes_of_start;
static insole_foot_fusion_t fusion;
static insole_fix_t fixes[FUSION_SAMPLES];
static uint32_t fix_count;

/** Where the shoe is, m. */
static inline insole_spot_t truth_at(double t_s)
{
    walk_pose_t pose = walk_pose(&walk, t_s);
    insole_spot_t s = {(insole_real_t)(walk_x_m + pose.sensor_m[0]),
                       (insole_real_t)(walk_y_m + pose.sensor_m[1])};
    return s;
}

/** A ring of points about the middle of the round. */
static inline void draw_ring(insole_line_kind_t kind, double radius_m)
{
    double half = 0.5 * walk.turn_rad, r = 0.5 * walk.length_m / sin(half);
    double x = walk_x_m - r * sin(walk.heading_rad), y = walk_y_m + r * cos(walk.heading_rad);
    double xy[2 * 48];
    for (int i = 0; i < 48; i++) {
        xy[2 * i] = x + radius_m * cos(FUSION_PI * i / 24.0);
        xy[2 * i + 1] = y + radius_m * sin(FUSION_PI * i / 24.0);
    }
    draw_line(&radio.drawing, kind, 4.0, xy, 48);
}

/** The corridor, 2.4 m wide, with access points all about. */
static inline void build_round(void)
{
    double r = 0.5 * walk.length_m / sin(0.5 * walk.turn_rad);
    insole_rng_seed(&rng, 77u);
    radio_scatter(&radio, &rng, FUSION_APS, walk_x_m - 30.0, walk_y_m - 20.0);
    draw_begin(&radio.drawing);
    draw_ring(INSOLE_LINE_OUTLINE, r + 1.2);
    draw_ring(INSOLE_LINE_HOLE, r - 1.2);
    ck_assert_int_eq(draw_build(&radio.drawing), INSOLE_OK);
    radio.building.plan = &radio.drawing.plan;
}

static inline void hear_at(double t_s)
{
    heard_t *h = &heard[heard_count++];
    insole_spot_t at = truth_at(t_s);
    walk_pose_t pose = walk_pose(&walk, t_s);
    h->t_us = (uint64_t)llround(1e6 * t_s);
    radio_listen(&radio, &rng, (double)at.x_m, (double)at.y_m, pose.yaw_rad, 3.0, FUSION_APS,
                 h->readings);
    for (uint32_t i = 0; i < FUSION_APS; i++) {
        double d = hypot((double)(radio.aps[i].x_m - at.x_m), (double)(radio.aps[i].y_m - at.y_m));
        double noise = 0.5 * (double)insole_rng_normal(&rng);
        insole_range_t range = {h->t_us, i,
                                (insole_real_t)(hypot(d, 2.5) + fmax(0.0, 1.75 + noise)), 0};
        h->ranges[i] = range;
    }
}

/** Two thirds of the round, at 100 Hz, with a scan a second. */
static inline void walk_round(uint64_t seed)
{
    insole_rng_t noise;
    insole_rng_seed(&noise, seed);
    walk = WALK;
    walk.strides = 2 * FUSION_ROUND / 3;
    walk.turn_rad = 2.0 * FUSION_PI / FUSION_ROUND;
    walk.heading_rad = 0.8;
    walk_x_m = 110.0;
    walk_y_m = 45.0;
    build_round();
    insole_rng_seed(&rng, seed + 1000u);
    sample_count = heard_count = 0u;
    for (double t = 0.01; t < walk_end_s(&walk); t += 0.01) {
        samples[sample_count++] = walk_sample(&walk, t - 0.01, t, &noise);
    }
    for (double t = 0.5; t < walk_end_s(&walk) - 0.5; t += 1.0) {
        hear_at(t);
    }
}

static inline insole_start_t start_at(double t_s, double dx_m, double dy_m, double sigma_m)
{
    insole_spot_t at = truth_at(t_s);
    walk_pose_t pose = walk_pose(&walk, t_s);
    insole_start_t start = {(uint64_t)llround(1e6 * t_s),
                            at.x_m + (insole_real_t)dx_m,
                            at.y_m + (insole_real_t)dy_m,
                            true,
                            (insole_real_t)(pose.yaw_rad + walk.turn_rad), /* of two strides */
                            (insole_real_t)sigma_m,
                            INSOLE_R(0.09)};
    return start;
}

/** Everything is known and told. */
static inline fusion_case_t usual_case(void)
{
    fusion_case_t c = {.config = insole_foot_fusion_defaults,
                       .building = &radio.building,
                       .particles = FUSION_PARTICLES,
                       .slice = WHOLE,
                       .late = FUSION_LATE,
                       .seed = 42u,
                       .scans = true,
                       .has_start = true};
    c.start = start_at(0.0, 0.0, 0.0, 0.3);
    return c;
}

/** With the ranges, too. */
static inline fusion_case_t told_everything(void)
{
    fusion_case_t c = usual_case();
    c.ranges = true;
    return c;
}

static inline insole_fusion_memory_t memory_of(const fusion_case_t *c)
{
    insole_fusion_memory_t memory = {fusion_particles,
                                     c->particles,
                                     fusion_past,
                                     FUSION_PAST,
                                     &fusion_ranges,
                                     {insole_fusion_start_hear, &fixes_of_start},
                                     &insole_step_weighing_calls};
    return memory;
}

static inline void set_up(const fusion_case_t *c)
{
    insole_fusion_memory_t memory = memory_of(c);
    fix_count = 0u;
    memset(fusion_past, 0, sizeof fusion_past);
    ck_assert_int_eq(insole_fusion_start_init(&fixes_of_start, c->config.start_fixes), INSOLE_OK);
    ck_assert_int_eq(insole_fusion_ranges_init(&fusion_ranges), INSOLE_OK);
    ck_assert_int_eq(insole_foot_late_init(&waiting, fusion_late, c->late), INSOLE_OK);
    ck_assert_int_eq(insole_foot_fusion_init(&fusion, &c->config, &memory, c->building, c->seed),
                     INSOLE_OK);
    if (c->has_start) {
        ck_assert_int_eq(insole_foot_fusion_start(&fusion, &c->start), INSOLE_OK);
    }
}

static inline void take_fixes(insole_foot_fusion_t *f)
{
    while (insole_foot_lag_next(&waiting, f, &fixes[fix_count]) == INSOLE_OK) {
        ck_assert_uint_lt(++fix_count, FUSION_SAMPLES);
    }
}

static inline void tell_radio(const fusion_case_t *c, insole_foot_fusion_t *f, uint64_t after_us,
                              uint64_t until_us)
{
    for (uint32_t i = 0u; i < heard_count; i++) {
        if (heard[i].t_us <= after_us || heard[i].t_us > until_us) {
            continue;
        }
        insole_scan_t scan = {heard[i].t_us, heard[i].readings, FUSION_APS};
        if (c->scans) {
            ck_assert_int_eq(insole_foot_fusion_scan(f, &scan), INSOLE_OK);
        }
        if (c->ranges) {
            ck_assert_int_eq(insole_foot_fusion_ranges(f, heard[i].ranges, FUSION_APS), INSOLE_OK);
        }
    }
}

static inline void work(const fusion_case_t *c, insole_foot_fusion_t *f)
{
    bool more = insole_foot_fusion_work(f, c->slice);
    ck_assert(!more || c->slice != WHOLE);
}

/** Samples from..to; each is followed by its rows and by a slice of work. */
static inline void run(const fusion_case_t *c, insole_foot_fusion_t *f, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        tell_radio(c, f, i > 0u ? samples[i - 1u].t_us : 0u, samples[i].t_us);
        ck_assert_int_eq(insole_foot_fusion_imu(f, &samples[i]), INSOLE_OK);
        take_fixes(f);
        work(c, f);
    }
}

static inline void finish(const fusion_case_t *c, insole_foot_fusion_t *f)
{
    uint32_t left = 1000000u;
    ck_assert_int_eq(insole_foot_fusion_finish(f), INSOLE_OK);
    for (take_fixes(f); f->working; take_fixes(f)) {
        (void)insole_foot_fusion_work(f, c->slice);
        ck_assert_uint_gt(left--, 0u);
    }
}

static inline void run_case(const fusion_case_t *c)
{
    set_up(c);
    run(c, &fusion, 0u, sample_count);
    finish(c, &fusion);
}

static inline double error_of(const insole_fix_t *row)
{
    insole_spot_t at = truth_at(1e-6 * (double)row->t_us);
    return hypot((double)(row->position_m.x - at.x_m), (double)(row->position_m.y - at.y_m));
}

static inline double mean_error(double from_s, double to_s)
{
    double sum = 0.0;
    uint32_t count = 0u;
    for (uint32_t i = 0u; i < fix_count; i++) {
        double t_s = 1e-6 * (double)fixes[i].t_us;
        if (t_s >= from_s && t_s < to_s) {
            sum += error_of(&fixes[i]);
            count++;
        }
    }
    ck_assert_uint_gt(count, 0u);
    return sum / count;
}

#endif
