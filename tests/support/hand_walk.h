/** @file hand_walk.h  Somebody walks with a phone in the hand, and the phone tracker follows.
 *
 *      walk_legs(&usual_hand, L_SHAPE, 5);        samples, readings of the compass, scans, truth
 *      rig_case_t c = usual_case();
 *      run_case(&rig, &c);                        fixes[0 .. fix_count)
 *      error_at_end()
 *
 *  Two steps a second, the phone's y axis ahead. Bounce, turns, field and truth are computed in
 *  double and know nothing of the library.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HAND_WALK_H
#define INSOLE_TESTS_HAND_WALK_H

#include "fingerprints.h"
#include "fixes.h"
#include "insole/fuse/ml_shift.h"
#include "insole/fuse/step_ekf.h"
#include "insole/fuse/step_fusion.h"
#include "insole/move/attitude_ekf.h"
#include "insole/place/kde_fix.h"
#include "insole/track/phone_gait.h"
#include "insole/track/phone_tracker.h"
#include "near.h"
#include "phone.h"

enum {
    HAND_SAMPLES = 16000,
    HAND_SCANS = 100,
    HAND_HEARD = 200,
    HAND_APS = 200,
    HAND_RATE_HZ = 100,
    HAND_MAG_EVERY = 4 /**< samples for a reading of the compass */
};

#define HAND_PI     3.14159265358979323846
#define HAND_STEP_M 0.7

/** A part of a walk: so long, on foot or standing, and turning by so much. */
typedef struct {
    double seconds;
    bool walks;
    double turn_rad;
} leg_t;

/** Who walks, from where. */
typedef struct {
    double x_m, y_m, heading_rad;
    double pitch_rad, roll_rad; /**< how the phone is held */
    double shake_mps2;
    double gyro_noise, accel_noise;
    uint64_t seed;
} hand_t;

static const hand_t usual_hand = {8.0, 8.0, 0.4, 0.6, 0.1, 2.5, 0.002, 0.02, 1u};

/** A quarter turn to the left after 24 m. */
static const leg_t L_SHAPE[5] = {{3.0, false, 0.0},
                                 {17.0, true, 0.0},
                                 {1.0, true, 1.5707963},
                                 {10.0, true, 0.0},
                                 {3.0, false, 0}};
static const leg_t STRAIGHT[3] = {{3.0, false, 0.0}, {20.0, true, 0.0}, {3.0, false, 0.0}};

enum { HAND_GENTLE, HAND_HARD };

/** One tree of one node: what shakes more is not in the hand. */
static const insole_carry_node_t HAND_NODES[] = {
    {INSOLE_R(6.0), 0, INSOLE_CARRY_LEAF(HAND_GENTLE), INSOLE_CARRY_LEAF(HAND_HARD)}};
static const uint16_t HAND_ROOTS[] = {0, 1};
static const char *const HAND_NAMES[] = {"gentle", "hard"};
static const insole_carry_forest_t HAND_FOREST = {HAND_NODES, HAND_ROOTS, HAND_NAMES, 1, 2};

typedef struct {
    uint64_t t_us;
    insole_rss_t readings[HAND_HEARD];
    uint32_t count;
} hand_scan_t;

static insole_imu_t samples[HAND_SAMPLES];
static double truth_x_m[HAND_SAMPLES], truth_y_m[HAND_SAMPLES], truth_rad[HAND_SAMPLES];
static insole_mag_t mags[HAND_SAMPLES];
static uint32_t sample_count, mag_count;
static hand_scan_t scans[HAND_SCANS];
static uint32_t scan_count;
static double walked_m;

static prints_t prints;

/** North is +y; a field of central Europe. */
static inline insole_mag_t field_at(const phone_t *p)
{
    insole_mag_t mag = {p->t_us, real_of(d33_apply(d33_transpose(p->R), d3(0.0, 20.0, -43.0)))};
    return mag;
}

/** A sample of a phone whose walker is there. */
static inline void note_sample(const phone_t *p, insole_imu_t imu, double x_m, double y_m,
                               double rad)
{
    ck_assert_uint_lt(sample_count, HAND_SAMPLES);
    samples[sample_count] = imu;
    truth_x_m[sample_count] = x_m;
    truth_y_m[sample_count] = y_m;
    truth_rad[sample_count] = rad;
    if (sample_count++ % HAND_MAG_EVERY == 0u) {
        mags[mag_count++] = field_at(p);
    }
}

static inline void walk_legs(const hand_t *hand, const leg_t *legs, int count)
{
    d33_t level = d33_mul(turn_x(hand->pitch_rad), turn_y(hand->roll_rad));
    phone_t p = phone(d33_mul(turn_z(hand->heading_rad - HAND_PI / 2.0), level), hand->seed);
    double x_m = hand->x_m, y_m = hand->y_m, rad = hand->heading_rad, dt = 1.0 / HAND_RATE_HZ;
    sample_count = mag_count = scan_count = 0u;
    walked_m = 0.0;
    p.gyro_noise = hand->gyro_noise;
    p.accel_noise = hand->accel_noise;
    for (int leg = 0; leg < count; leg++) {
        double radps = legs[leg].turn_rad / legs[leg].seconds;
        double way_m = legs[leg].walks ? 2.0 * HAND_STEP_M * dt : 0.0;
        p.shake = legs[leg].walks ? hand->shake_mps2 : 0.0;
        for (double t = 0.0; t < legs[leg].seconds - 0.5 * dt; t += dt) {
            rad += radps * dt;
            x_m += way_m * cos(rad);
            y_m += way_m * sin(rad);
            walked_m += way_m;
            d3_t rate = d33_apply(d33_transpose(p.R), d3(0.0, 0.0, radps));
            insole_imu_t imu = phone_sample(&p, rate, 1000000u / HAND_RATE_HZ);
            note_sample(&p, imu, x_m, y_m, rad);
        }
    }
}

/** What is heard in the hall of fingerprints.h, every `every_s`. */
static inline void hear_on_the_way(double every_s, double sigma_db)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 99u);
    prints_hall(&prints, HAND_APS, 0.0, 0.0);
    for (uint32_t i = 50u; i < sample_count; i += (uint32_t)(every_s * HAND_RATE_HZ)) {
        hand_scan_t *scan = &scans[scan_count++];
        ck_assert_uint_lt(scan_count, HAND_SCANS);
        scan->t_us = samples[i].t_us;
        scan->count = prints_listen(&rng, HAND_APS, truth_x_m[i], truth_y_m[i], sigma_db, 0.0,
                                    scan->readings);
    }
}

/* ---- the tracker and its parts ----------------------------------------------------------- */

/** A tracker and all that it points at. */
typedef struct {
    insole_magnetic_t magnetic;
    insole_phone_tracker_t phone;
    insole_step_fusion_t fusion;
    insole_ml_shift_t shift;
    insole_kde_fix_t kde;
    insole_walk_heading_t heading;
    insole_carry_t carry;
    insole_phone_gait_t gait;
} rig_t;

typedef struct {
    insole_phone_tracker_config_t config;
    insole_magnetic_config_t magnetic;
    insole_attitude_method_t *attitude;
    const insole_step_filter_calls_t *filter; /**< NULL: radio alone */
    const insole_carry_forest_t *forest;      /**< NULL: a step goes where the phone points */
    bool hears, sees;                         /**< scans, and the compass, are told */
    bool has_start;
    insole_start_t start;
    uint32_t slice; /**< of work */
} rig_case_t;

static insole_fix_t fixes[HAND_SAMPLES];
static uint32_t fix_count;

static inline insole_start_t start_of(const hand_t *hand, bool has_heading)
{
    insole_start_t start = {0u,
                            (insole_real_t)hand->x_m,
                            (insole_real_t)hand->y_m,
                            has_heading,
                            (insole_real_t)hand->heading_rad,
                            INSOLE_R(0.3),
                            INSOLE_R(0.05)};
    return start;
}

/** Steps alone, and all of the start is told. */
static inline rig_case_t usual_case(const hand_t *hand)
{
    rig_case_t c = {.config = insole_phone_tracker_defaults,
                    .magnetic = insole_magnetic_defaults,
                    .attitude = insole_attitude_ekf,
                    .filter = &insole_step_ekf_calls,
                    .has_start = true,
                    .start = start_of(hand, true),
                    .slice = UINT32_MAX};
    c.config.walk.step_length.model = INSOLE_STEP_LENGTH_CONSTANT;
    c.config.walk.step_length.constant_m = (insole_real_t)HAND_STEP_M;
    return c;
}

static inline insole_phone_parts_t parts_of(rig_t *r, const rig_case_t *c)
{
    insole_phone_parts_t parts = {.attitude = c->attitude,
                                  .magnetic = {insole_magnetic_push, &r->magnetic}};
    parts.filter.calls = c->filter;
    parts.filter.state = c->filter == &insole_ml_shift_calls ? (void *)&r->shift : &r->fusion;
    if (c->hears) {
        parts.solver.calls = &insole_kde_fix_calls;
        parts.solver.state = &r->kde;
    }
    if (c->forest) {
        parts.guide.calls = &insole_phone_gait_calls;
        parts.guide.state = &r->gait;
    }
    return parts;
}

/** Another place for the same state: what it points at is its own again. */
static inline void rig_move(rig_t *to, const rig_t *from, const rig_case_t *c)
{
    insole_phone_parts_t parts = parts_of(to, c);
    *to = *from;
    to->phone.parts = parts;
    to->phone.walk.guide = parts.guide;
    to->gait.heading = &to->heading;
    to->gait.carry = &to->carry;
    to->phone.radio.solver = parts.solver;
    to->phone.place.filter = c->filter ? parts.filter : from->phone.place.filter;
}

static inline void set_up(rig_t *r, const rig_case_t *c)
{
    insole_phone_parts_t parts = parts_of(r, c);
    memset(r, 0, sizeof *r);
    fix_count = 0u;
    ck_assert_int_eq(insole_magnetic_init(&r->magnetic, &c->magnetic), INSOLE_OK);
    ck_assert_int_eq(insole_step_fusion_init(&r->fusion, &insole_step_fusion_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_ml_shift_init(&r->shift, &insole_ml_shift_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_kde_fix_init(&r->kde, &insole_kde_fix_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_walk_heading_init(&r->heading, &insole_walk_heading_defaults),
                     INSOLE_OK);
    ck_assert_int_eq(insole_carry_init(&r->carry, &insole_carry_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_phone_gait_init(&r->gait, &insole_phone_gait_defaults, &r->heading,
                                            &r->carry, c->forest),
                     INSOLE_OK);
    ck_assert_int_eq(
        insole_phone_tracker_init(&r->phone, &c->config, &parts, c->hears ? &prints.map : NULL),
        INSOLE_OK);
    if (c->has_start) {
        ck_assert_int_eq(insole_phone_tracker_start(&r->phone, &c->start), INSOLE_OK);
    }
}

static inline void take_fixes(rig_t *r)
{
    while (insole_phone_tracker_next(&r->phone, &fixes[fix_count]) == INSOLE_OK) {
        ck_assert_uint_lt(++fix_count, HAND_SAMPLES);
    }
}

static inline void work(rig_t *r, const rig_case_t *c)
{
    for (uint32_t left = 100000u; insole_phone_tracker_work(&r->phone, c->slice); left--) {
        ck_assert_uint_gt(left, 0u);
    }
}

static inline void tell_radio(rig_t *r, const rig_case_t *c, uint64_t after_us, uint64_t until_us)
{
    for (uint32_t i = 0u; c->hears && i < scan_count; i++) {
        if (scans[i].t_us > after_us && scans[i].t_us <= until_us) {
            insole_scan_t scan = {scans[i].t_us, scans[i].readings, scans[i].count};
            (void)insole_phone_tracker_scan(&r->phone, &scan);
            work(r, c);
        }
    }
}

/** Samples from..to, each with its fix, then what the compass and the radio tell. */
static inline void run(rig_t *r, const rig_case_t *c, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        if (insole_phone_tracker_imu(&r->phone, &samples[i]) != INSOLE_OK) {
            ck_abort_msg("sample %u is not taken", i);
        }
        take_fixes(r);
        if (c->sees && i % HAND_MAG_EVERY == 0u) {
            (void)insole_phone_tracker_mag(&r->phone, &mags[i / HAND_MAG_EVERY]);
        }
        tell_radio(r, c, i > 0u ? samples[i - 1u].t_us : 0u, samples[i].t_us);
        work(r, c);
    }
}

static inline void finish(rig_t *r)
{
    ck_assert_int_eq(insole_phone_tracker_finish(&r->phone), INSOLE_OK);
    take_fixes(r);
}

static inline void run_case(rig_t *r, const rig_case_t *c)
{
    set_up(r, c);
    run(r, c, 0u, sample_count);
    finish(r);
}

/* ---- against the truth -------------------------------------------------------------------- */

static inline double error_of(uint32_t fix)
{
    return hypot((double)fixes[fix].position_m.x - truth_x_m[fix],
                 (double)fixes[fix].position_m.y - truth_y_m[fix]);
}

static inline double error_at_end(void)
{
    ck_assert_uint_eq(fix_count, sample_count);
    return error_of(fix_count - 1u);
}

static inline double worst_error(uint32_t from, uint32_t to)
{
    double most = 0.0;
    for (uint32_t i = from; i < to; i++) {
        most = fmax(most, error_of(i));
    }
    return most;
}

/** Longest way between two fixes. */
static inline worst_t longest_jump(uint32_t from, uint32_t to)
{
    worst_t jump = {0.0, 0.0};
    for (uint32_t i = from + 1u; i < to; i++) {
        worst_note(&jump,
                   hypot((double)(fixes[i].position_m.x - fixes[i - 1u].position_m.x),
                         (double)(fixes[i].position_m.y - fixes[i - 1u].position_m.y)),
                   0.01 * i);
    }
    return jump;
}

#endif
