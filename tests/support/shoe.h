/** @file shoe.h  Recordings of synthetic walks, and the tracker run over them.
 *
 *      record(&walk, 100.0, 0.0);
 *      run_all(&shoe, &insole_foot_tracker_defaults);
 *      fixes[0 .. fix_count)
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_SHOE_H
#define INSOLE_TESTS_SHOE_H

#include <string.h>

#include "fixes.h"
#include "insole/track/foot_tracker.h"
#include "near.h"
#include "walk_samples.h"

enum { SHOE_SAMPLES_MAX = 20000, LOOP_STRIDES = 69 };

static insole_imu_t samples[SHOE_SAMPLES_MAX];
static insole_fix_t fixes[SHOE_SAMPLES_MAX];
static uint32_t sample_count, fix_count;
static insole_foot_tracker_t shoe;
static uint64_t noise_seed = 11u;

/** 100 m, as one loop or straight on. */
static inline walk_t hundred_metres(bool loop)
{
    walk_t walk = WALK;
    walk.strides = LOOP_STRIDES;
    walk.turn_rad = loop ? 6.283185307179586 / LOOP_STRIDES : 0.0;
    return walk;
}

/** What the shoe's sensor tells from `begin_s` on. */
static inline void record(const walk_t *walk, double rate_hz, double begin_s)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, noise_seed);
    sample_count = 0u;
    for (double dt = 1.0 / rate_hz, t = begin_s + dt; t < walk_end_s(walk); t += dt) {
        ck_assert_uint_lt(sample_count, SHOE_SAMPLES_MAX);
        samples[sample_count++] = walk_sample(walk, t - dt, t, &rng);
    }
}

/** The same recording without what lies between. */
static inline void drop_out(double from_s, double to_s)
{
    uint32_t kept = 0u;
    for (uint32_t i = 0u; i < sample_count; i++) {
        double t_s = (double)samples[i].t_us * 1e-6;
        if (t_s < from_s || t_s >= to_s) {
            samples[kept++] = samples[i];
        }
    }
    sample_count = kept;
}

static inline void take_fixes(insole_foot_tracker_t *tracker)
{
    while (insole_foot_tracker_next(tracker, &fixes[fix_count]) == INSOLE_OK) {
        fix_count++;
    }
}

static inline void run(insole_foot_tracker_t *tracker, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        ck_assert(insole_foot_tracker_imu(tracker, &samples[i]) == INSOLE_OK);
        take_fixes(tracker);
    }
}

static inline void set_up(insole_foot_tracker_t *tracker,
                          const insole_foot_tracker_config_t *config)
{
    fix_count = 0u;
    ck_assert_int_eq(insole_foot_tracker_init(tracker, config), INSOLE_OK);
}

static inline void finish(insole_foot_tracker_t *tracker)
{
    ck_assert_int_eq(insole_foot_tracker_finish(tracker), INSOLE_OK);
    take_fixes(tracker);
}

static inline void run_all(insole_foot_tracker_t *tracker,
                           const insole_foot_tracker_config_t *config)
{
    set_up(tracker, config);
    run(tracker, 0u, sample_count);
    finish(tracker);
}

/** First fix at or after. */
static inline const insole_fix_t *fix_at(double t_s)
{
    uint32_t i = 0u;
    while (i + 1u < fix_count && (double)fixes[i].t_us * 1e-6 < t_s - 1e-6) {
        i++;
    }
    return &fixes[i];
}

#endif
