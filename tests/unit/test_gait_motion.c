/* SPDX-License-Identifier: MIT */
#include "insole/move/gait_motion.h"

#include "insole/base/rng.h"
#include "motion.h"
#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define EPS ((double)INSOLE_REAL_EPSILON)

enum { MOST = 4000, MOST_SLOTS = 600 };

static insole_gait_motion_t motion;

/* All samples, kept, to look at them by brute force in double. */
static d3_t forces[MOST];
static uint64_t times_us[MOST];
static insole_gait_facing_t facings[MOST];
static int count;

static void begin(void)
{
    ck_assert_int_eq(insole_gait_motion_init(&motion), INSOLE_OK);
    count = 0;
}

static void push_facing(insole_vec3_t force, insole_gait_facing_t facing, uint64_t t_us)
{
    ck_assert_int_eq(insole_gait_motion_push(&motion, force, &facing, t_us), INSOLE_OK);
    forces[count] = d3_of(force);
    facings[count] = facing;
    times_us[count++] = t_us;
}

static void push(insole_vec3_t force, uint64_t t_us)
{
    insole_gait_facing_t ahead = {1, 0};
    push_facing(force, ahead, t_us);
}

/* What was said last before the end of a slot. */
static insole_gait_facing_t slow_facing(uint64_t slot)
{
    insole_gait_facing_t facing = {0, 0};
    for (int i = 0; i < count; i++) {
        facing = times_us[i] / 50000u <= slot ? facings[i] : facing;
    }
    return facing;
}

/* Mean of the samples of three slots. */
static bool slow_mean(uint64_t slot, d3_t *mean)
{
    double n = 0.0;
    *mean = d3(0.0, 0.0, 0.0);
    for (int i = 0; i < count; i++) {
        uint64_t k = times_us[i] / 50000u;
        if (k + 1u >= slot && k <= slot + 1u) {
            *mean = d3_add(*mean, 1.0, forces[i]);
            n += 1.0;
        }
    }
    *mean = d3_scale(*mean, 1.0 / n);
    return n > 0.0;
}

/* Moments by their definition. */
typedef struct {
    d33_t scatter;
    d3_t force, step_c, step_s, stride_c, stride_s, falling;
    double device, facing, turned;
} slow_t;

static double turned_at(uint64_t slot)
{
    return (double)slow_facing(slot).turned_rad;
}

static d3_t wave_of(const d3_t *a, int n, const insole_gait_window_t *w, double rate, bool is_sine)
{
    d3_t sum = d3(0.0, 0.0, 0.0);
    for (int i = 0; i < n; i++) {
        double t = 0.05 * (double)(w->begin_us / 50000u) + 0.05 * (i + 0.5);
        double phase = rate * (t - 1.0e-6 * (double)w->begin_us);
        sum = d3_add(sum, 2.0 / n * (is_sine ? sin(phase) : cos(phase)), a[i]);
    }
    return sum;
}

static void slow_waves(slow_t *s, const d3_t *a, int n, const insole_gait_window_t *w)
{
    double rate = 2.0 * PI * w->steps / (1.0e-6 * (double)(w->end_us - w->begin_us));
    s->step_c = wave_of(a, n, w, rate, false);
    s->step_s = wave_of(a, n, w, rate, true);
    s->stride_c = s->stride_s = d3(0.0, 0.0, 0.0);
    if (w->steps > 1u) {
        s->stride_c = wave_of(a, n, w, 0.5 * rate, false);
        s->stride_s = wave_of(a, n, w, 0.5 * rate, true);
    }
}

static void slow_facings(slow_t *s, uint64_t first, int n, uint32_t steps)
{
    uint64_t last = first + (uint64_t)n - 1u;
    int length = n / (int)steps > 0 ? n / (int)steps : 1;
    double sine = 0.0;
    for (int i = 0; i < length; i++) { /* angles near each other: their mean is that of the turns */
        sine += remainder(turned_at(last - (uint64_t)i) - turned_at(last), 2.0 * PI) / length;
    }
    s->facing = turned_at(last) + sine;
    s->turned = remainder(turned_at(last) - turned_at(first), 2.0 * PI);
    s->device = (double)slow_facing(last).device_rad;
}

static slow_t slow_look(const insole_gait_window_t *w)
{
    static d3_t a[MOST_SLOTS];
    uint64_t first = w->begin_us / 50000u, end = (w->end_us + 49999u) / 50000u;
    int n = (int)(end - first);
    slow_t s = {.force = d3(0.0, 0.0, 0.0)};
    slow_facings(&s, first, n, w->steps);
    for (int i = 0; i < n; i++) {
        ck_assert(slow_mean(first + (uint64_t)i, &a[i]));
        a[i] = d33_apply(turn_z(s.facing - turned_at(first + (uint64_t)i)), a[i]);
        s.force = d3_add(s.force, 1.0 / n, a[i]);
    }
    double speed = 0.0, lowest = 1.0e9;
    for (int i = 0; i < n; i++) {
        a[i] = d3_add(a[i], -1.0, s.force);
        speed += 0.05 * a[i].z;
        double middle = speed - 0.025 * a[i].z;
        s.falling = middle < lowest ? a[i] : s.falling;
        lowest = fmin(lowest, middle);
        s.scatter.r0 = d3_add(s.scatter.r0, a[i].x / n, a[i]);
        s.scatter.r1 = d3_add(s.scatter.r1, a[i].y / n, a[i]);
        s.scatter.r2 = d3_add(s.scatter.r2, a[i].z / n, a[i]);
    }
    slow_waves(&s, a, n, w);
    return s;
}

static double apart(insole_vec3_t v, d3_t expected)
{
    return d3_norm(d3_add(d3_of(v), -1.0, expected));
}

static double worst_difference(const insole_gait_moments_t *m, const slow_t *s)
{
    const insole_sym3_t *S = &m->scatter;
    double off[] = {apart(insole_vec3(S->xx, S->xy, S->xz), s->scatter.r0),
                    apart(insole_vec3(S->xy, S->yy, S->yz), s->scatter.r1),
                    apart(insole_vec3(S->xz, S->yz, S->zz), s->scatter.r2),
                    apart(m->force_mps2, s->force),
                    apart(m->step.c, s->step_c),
                    apart(m->step.s, s->step_s),
                    apart(m->stride.c, s->stride_c),
                    apart(m->stride.s, s->stride_s),
                    apart(m->falling_mps2, s->falling),
                    fabs((double)m->device_rad - s->device),
                    fabs(remainder((double)m->facing_rad - s->facing, 2.0 * PI)),
                    fabs(remainder((double)m->turned_rad - s->turned, 2.0 * PI))};
    double worst = 0.0;
    for (size_t i = 0; i < sizeof off / sizeof off[0]; i++) {
        worst = fmax(worst, off[i]);
    }
    return worst;
}

static const uint32_t intervals_us[] = {50000u, 20000u, 10000u, 2500u};

/* Any rate, uneven stamps; windows old and new, of one step and of four; a walker who turns past
 * the end of the angles. */
START_TEST(moments_are_those_by_brute_force)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t off = {0.0, 0.0};
    begin();
    uint64_t t_us = insole_rng_bits(&rng) % 1000000u;
    uint32_t samples = 8000000u / intervals_us[_i];
    for (uint32_t i = 0; i < samples; i++) {
        t_us += intervals_us[_i] * 3u / 4u + insole_rng_bits(&rng) % (intervals_us[_i] / 2u);
        double phase = 2.0 * PI * (double)t_us * 1.0e-6 / 0.55;
        insole_vec3_t a = insole_vec3((insole_real_t)sin(phase), (insole_real_t)cos(0.5 * phase),
                                      (insole_real_t)(9.81 + 2.0 * cos(phase)));
        insole_gait_facing_t facing = {
            sample_between(&rng, -3, 3),
            (insole_real_t)remainder(1.1e-6 * (double)t_us + 0.2 * sin(phase), 2.0 * PI)};
        push_facing(insole_vec3_add(a, sample_vec3(&rng, INSOLE_R(0.5))), facing, t_us);
    }
    for (uint32_t k = 0; k < 40; k++) {
        insole_gait_window_t w = {.steps = 1u + k % 4u};
        w.end_us = t_us - insole_rng_bits(&rng) % 3500000u;
        w.begin_us = w.end_us - w.steps * (400000u + insole_rng_bits(&rng) % 200000u);
        insole_gait_moments_t m;
        ck_assert_int_eq(insole_gait_motion_look(&motion, &w, &m), INSOLE_OK);
        slow_t s = slow_look(&w);
        worst_note(&off, worst_difference(&m, &s), k);
    }
    ASSERT_WORST(off, 2000.0 * EPS, "m^2/s^4");
}
END_TEST

/* Two waves, their sizes and phases as they were put in. */
START_TEST(waves_are_told_apart)
{
    const double step_s = 0.5;
    begin();
    for (int k = 1; k <= 500; k++) {
        double phase = 2.0 * PI * (k * 0.005 - 1.0025) / step_s;
        push(insole_vec3((insole_real_t)(2.0 * cos(phase)), (insole_real_t)(0.7 * sin(0.5 * phase)),
                         (insole_real_t)(9.81 + 3.0 * sin(phase) + cos(0.5 * phase))),
             (uint64_t)k * 5000u - 2500u);
    }
    insole_gait_window_t w = {1000000u, 2000000u, 2u};
    insole_gait_moments_t m;
    ck_assert_int_eq(insole_gait_motion_look(&motion, &w, &m), INSOLE_OK);
    const double passed = 0.858, passed_half = 0.963; /* by a mean over 0.15 s of 2 Hz, of 1 Hz */
    ASSERT_NEAR(apart(m.step.c, d3(2.0 * passed, 0.0, 0.0)), 0.0, 0.02, "m/s^2");
    ASSERT_NEAR(apart(m.step.s, d3(0.0, 0.0, 3.0 * passed)), 0.0, 0.02, "m/s^2");
    ASSERT_NEAR(apart(m.stride.c, d3(0.0, 0.0, passed_half)), 0.0, 0.02, "m/s^2");
    ASSERT_NEAR(apart(m.stride.s, d3(0.0, 0.7 * passed_half, 0.0)), 0.0, 0.02, "m/s^2");
    w.steps = 1u;
    w.end_us = 1500000u;
    ck_assert_int_eq(insole_gait_motion_look(&motion, &w, &m), INSOLE_OK);
    ck_assert(insole_vec3_max_abs(m.stride.c) + insole_vec3_max_abs(m.stride.s) <= 0);
    ASSERT_NEAR(m.force_mps2.z, 9.81, 0.5, "m/s^2");
}
END_TEST

/* Who goes round a bend moves as who goes straight, seen from where they face at last. */
START_TEST(a_turn_is_taken_out)
{
    insole_gait_moments_t straight, round_a_bend;
    for (int bends = 0; bends < 2; bends++) {
        begin();
        for (int k = 1; k <= 200; k++) {
            double t = k * 0.01, turned = bends ? 3.0 + 0.8 * (t - 1.0) : 0.0;
            d3_t a =
                d33_apply(turn_z(turned), d3(cos(4.0 * PI * t), 0.3 * sin(2.0 * PI * t), 9.81));
            insole_gait_facing_t facing = {0, (insole_real_t)remainder(turned, 2.0 * PI)};
            push_facing(real_of(a), facing, (uint64_t)k * 10000u);
        }
        insole_gait_window_t w = {1000000u, 1900000u, 2u};
        ck_assert_int_eq(insole_gait_motion_look(&motion, &w, bends ? &round_a_bend : &straight),
                         INSOLE_OK);
    }
    double facing = (double)round_a_bend.facing_rad;
    ASSERT_NEAR(facing, 3.0 + 0.8 * (0.9 - 0.225) - 2.0 * PI, 0.05, "rad");
    ASSERT_NEAR(round_a_bend.turned_rad, 0.8 * 0.85, 0.02, "rad");
    d3_t expected = d33_apply(turn_z(facing), d3_of(straight.step.c));
    ASSERT_NEAR(apart(round_a_bend.step.c, expected), 0.0, 0.03, "m/s^2");
    expected = d33_apply(turn_z(facing), d3_of(straight.stride.s));
    ASSERT_NEAR(apart(round_a_bend.stride.s, expected), 0.0, 0.03, "m/s^2");
}
END_TEST

static void push_evenly(int samples, uint64_t from_us)
{
    for (int k = 0; k < samples; k++) {
        push(insole_vec3((insole_real_t)(k % 5), 1, 9), from_us + (uint64_t)k * 20000u);
    }
}

START_TEST(what_is_forgotten_or_missing_is_not_looked_at)
{
    begin();
    push_evenly(400, 40000u); /* to 8.02 s */
    insole_gait_moments_t m, as_it_was;
    memset(&m, 7, sizeof m);
    as_it_was = m;
    uint64_t oldest_us = (8020000u / 50000u - 127u) * 50000u;
    ck_assert(insole_gait_motion_reaches(&motion, oldest_us));
    ck_assert(!insole_gait_motion_reaches(&motion, oldest_us - 1u));
    ck_assert(!insole_gait_motion_reaches(&motion, 8050000u));
    ck_assert(!insole_gait_motion_reaches(NULL, 8000000u));
    insole_gait_window_t old = {oldest_us - 1u, oldest_us + 500000u, 1u};
    ASSERT_UNCHANGED(motion, insole_gait_motion_look(&motion, &old, &m), INSOLE_ERR_STATE);
    ck_assert(memcmp(&m, &as_it_was, sizeof m) == 0);
    old.begin_us++;
    ck_assert_int_eq(insole_gait_motion_look(&motion, &old, &m), INSOLE_OK);
    push_evenly(50, 8020000u + 400000u); /* after a gap */
    insole_gait_window_t over_gap = {7900000u, 8600000u, 1u};
    ASSERT_UNCHANGED(motion, insole_gait_motion_look(&motion, &over_gap, &m), INSOLE_ERR_STATE);
    over_gap.begin_us = 8500000u;
    over_gap.end_us = 9000000u;
    ck_assert_int_eq(insole_gait_motion_look(&motion, &over_gap, &m), INSOLE_OK);
    push_evenly(30, 30000000u); /* longer than all that is remembered */
    over_gap.begin_us = 30050000u;
    over_gap.end_us = 30500000u;
    ck_assert_int_eq(insole_gait_motion_look(&motion, &over_gap, &m), INSOLE_OK);
    ck_assert(!insole_gait_motion_reaches(&motion, 9000000u));
    over_gap.begin_us = 29000000u; /* what was there before is not taken for it */
    over_gap.end_us = 29500000u;
    ASSERT_UNCHANGED(motion, insole_gait_motion_look(&motion, &over_gap, &m), INSOLE_ERR_STATE);
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    begin();
    push_evenly(100, 0u);
    const insole_vec3_t a = insole_vec3(0, 0, 9);
    const insole_gait_facing_t ahead = {0, 0};
    const insole_real_t odd[] = {(insole_real_t)NAN, (insole_real_t)INFINITY, INSOLE_R(1001.0)};
    uint64_t next_us = motion.t_us + 1u;
    insole_gait_window_t w = {100000u, 600000u, 1u}, bad;
    insole_gait_moments_t m;
    for (size_t i = 0; i < 3; i++) {
        insole_vec3_t wrong[] = {{odd[i], 0, 0}, {0, odd[i], 0}, {0, 0, odd[i]}};
        for (int k = 0; k < 3; k++) {
            ASSERT_UNCHANGED(motion, insole_gait_motion_push(&motion, wrong[k], &ahead, next_us),
                             INSOLE_ERR_VALUE);
        }
        insole_gait_facing_t odd_ways[] = {{odd[i], 0}, {0, odd[i]}};
        for (int k = 0; k < 2; k++) {
            ASSERT_UNCHANGED(motion, insole_gait_motion_push(&motion, a, &odd_ways[k], next_us),
                             INSOLE_ERR_VALUE);
        }
    }
    ASSERT_UNCHANGED(motion, insole_gait_motion_push(&motion, a, &ahead, motion.t_us),
                     INSOLE_ERR_TIME);
    bad = w;
    bad.steps = 0u;
    ASSERT_UNCHANGED(motion, insole_gait_motion_look(&motion, &bad, &m), INSOLE_ERR_VALUE);
    bad = w;
    bad.end_us = bad.begin_us;
    ASSERT_UNCHANGED(motion, insole_gait_motion_look(&motion, &bad, &m), INSOLE_ERR_TIME);
    bad.end_us = motion.t_us + 1u;
    ASSERT_UNCHANGED(motion, insole_gait_motion_look(&motion, &bad, &m), INSOLE_ERR_TIME);
    ASSERT_UNCHANGED(motion, insole_gait_motion_look(&motion, NULL, &m), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(motion, insole_gait_motion_look(&motion, &w, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_gait_motion_look(NULL, &w, &m), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_gait_motion_push(NULL, a, &ahead, next_us), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(motion, insole_gait_motion_push(&motion, a, NULL, next_us), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_gait_motion_init(NULL), INSOLE_ERR_NULL);
    begin();
    ck_assert_int_eq(insole_gait_motion_look(&motion, &w, &m), INSOLE_ERR_TIME);
}
END_TEST

/* 10 kHz: a slot's count does not wrap. */
START_TEST(a_full_slot_leaves_samples_out)
{
    const insole_gait_facing_t ahead = {0, 0};
    begin();
    for (uint64_t k = 0; k < 10000u; k++) {
        insole_vec3_t a = insole_vec3(k % 500u < 100u ? 1 : 0, 0, 9);
        ck_assert_int_eq(insole_gait_motion_push(&motion, a, &ahead, k * 100u), INSOLE_OK);
    }
    insole_gait_window_t w = {200000u, 800000u, 1u};
    insole_gait_moments_t m;
    ck_assert_int_eq(insole_gait_motion_look(&motion, &w, &m), INSOLE_OK);
    ASSERT_NEAR(m.scatter.xx, 0.0, 1.0e-6, "m^2/s^4"); /* every slot alike */
    ck_assert_uint_eq(motion.counts[5], 255u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("gait_motion");
    suite_add_loop(suite, "moments", moments_are_those_by_brute_force, 4);
    suite_add(suite, "waves", waves_are_told_apart);
    suite_add(suite, "turn", a_turn_is_taken_out);
    suite_add(suite, "memory", what_is_forgotten_or_missing_is_not_looked_at);
    suite_add(suite, "arguments", bad_arguments_are_refused);
    suite_add(suite, "full", a_full_slot_leaves_samples_out);
    return suite;
}
