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
static double headings[MOST];
static int count;

static void begin(void)
{
    ck_assert_int_eq(insole_gait_motion_init(&motion), INSOLE_OK);
    count = 0;
}

static void push(insole_vec3_t force, insole_real_t heading, uint64_t t_us)
{
    ck_assert_int_eq(insole_gait_motion_push(&motion, force, heading, t_us), INSOLE_OK);
    forces[count] = d3_of(force);
    headings[count] = (double)heading;
    times_us[count++] = t_us;
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

/* Moments by their definition: the reference slot by slot, the vertical velocity by trapezoids over
 * halves of slots, less its mean. */
typedef struct {
    double xx, xy, xz, yy, yz, zz, reference, heading;
    d3_t in_phase, falling;
} slow_t;

static slow_t slow_look(const insole_gait_window_t *w)
{
    static d3_t a[MOST_SLOTS];
    static double v[MOST_SLOTS];
    uint64_t first = w->begin_us / 50000u, end = (w->end_us + 49999u) / 50000u;
    int n = (int)(end - first), lowest = 0;
    d3_t mean = d3(0.0, 0.0, 0.0);
    for (int i = 0; i < n; i++) {
        ck_assert(slow_mean(first + (uint64_t)i, &a[i]));
        mean = d3_add(mean, 1.0 / n, a[i]);
    }
    double speed = 0.0, mean_v = 0.0;
    for (int i = 0; i < n; i++) {
        a[i] = d3_add(a[i], -1.0, mean);
        v[i] = speed + 0.025 * a[i].z;
        speed += 0.05 * a[i].z;
        mean_v += v[i] / n;
        lowest = v[i] < v[lowest] ? i : lowest;
    }
    double step_s = (double)(w->end_us - w->begin_us) * 1.0e-6 / w->steps;
    slow_t s = {.falling = a[lowest], .in_phase = d3(0.0, 0.0, 0.0)};
    for (int i = 0; i < n; i++) {
        double r = cos((double)w->lead_rad) * a[i].z;
        r -= sin((double)w->lead_rad) * 2.0 * PI / step_s * (v[i] - mean_v);
        s.xx += a[i].x * a[i].x / n;
        s.xy += a[i].x * a[i].y / n;
        s.xz += a[i].x * a[i].z / n;
        s.yy += a[i].y * a[i].y / n;
        s.yz += a[i].y * a[i].z / n;
        s.zz += a[i].z * a[i].z / n;
        s.in_phase = d3_add(s.in_phase, r / n, a[i]);
        s.reference += r * r / n;
    }
    for (int i = 0; i < count; i++) {
        s.heading = times_us[i] / 50000u < end ? headings[i] : s.heading;
    }
    return s;
}

static double worst_difference(const insole_gait_moments_t *m, const slow_t *s)
{
    const insole_sym3_t *S = &m->scatter;
    double off[] = {(double)S->xx - s->xx,
                    (double)S->xy - s->xy,
                    (double)S->xz - s->xz,
                    (double)S->yy - s->yy,
                    (double)S->yz - s->yz,
                    (double)S->zz - s->zz,
                    (double)m->reference - s->reference,
                    d3_norm(d3_add(d3_of(m->in_phase), -1.0, s->in_phase)),
                    d3_norm(d3_add(d3_of(m->falling_mps2), -1.0, s->falling)),
                    (double)m->device_rad - s->heading};
    double worst = 0.0;
    for (size_t i = 0; i < sizeof off / sizeof off[0]; i++) {
        worst = fmax(worst, fabs(off[i]));
    }
    return worst;
}

static const uint32_t intervals_us[] = {50000u, 20000u, 10000u, 2500u};

/* Any rate, uneven stamps; windows old and new, of one step and of four. */
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
        push(insole_vec3_add(a, sample_vec3(&rng, INSOLE_R(0.5))), sample_between(&rng, -3, 3),
             t_us);
    }
    for (uint32_t k = 0; k < 40; k++) {
        insole_gait_window_t w = {.steps = 1u + k % 4u, .lead_rad = sample_between(&rng, -3, 3)};
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

/* A forward acceleration that leads the vertical one by `lead` goes wholly with the reference that
 * does, not at all with one a quarter period apart, and is against the one half a period apart. */
START_TEST(reference_leads_by_its_phase)
{
    const double leads[] = {0.0, 0.6, 0.5 * PI, -1.0, 2.5};
    const double step_s = 0.5;
    for (size_t i = 0; i < sizeof leads / sizeof leads[0]; i++) {
        begin();
        for (int k = 1; k <= 500; k++) {
            double phase = 2.0 * PI * k * 0.005 / step_s;
            insole_vec3_t a = insole_vec3((insole_real_t)cos(phase + leads[i]), 0,
                                          (insole_real_t)(9.81 + 3.0 * cos(phase)));
            push(a, 0, (uint64_t)k * 5000u);
        }
        for (int quarter = -1; quarter <= 2; quarter++) {
            insole_gait_window_t w = {1000000u, 2000000u, 2u,
                                      (insole_real_t)(leads[i] + 0.5 * PI * quarter)};
            insole_gait_moments_t m;
            ck_assert_int_eq(insole_gait_motion_look(&motion, &w, &m), INSOLE_OK);
            double match = (double)(m.in_phase.x / insole_sqrt(m.reference * m.scatter.xx));
            ASSERT_NEAR(match, cos(0.5 * PI * quarter), 0.02, "");
        }
    }
}
END_TEST

static void push_evenly(int samples, uint64_t from_us)
{
    for (int k = 0; k < samples; k++) {
        push(insole_vec3((insole_real_t)(k % 5), 1, 9), 1, from_us + (uint64_t)k * 20000u);
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
    insole_gait_window_t old = {oldest_us - 1u, oldest_us + 500000u, 1u, 0};
    ASSERT_UNCHANGED(motion, insole_gait_motion_look(&motion, &old, &m), INSOLE_ERR_STATE);
    ck_assert(memcmp(&m, &as_it_was, sizeof m) == 0);
    old.begin_us++;
    ck_assert_int_eq(insole_gait_motion_look(&motion, &old, &m), INSOLE_OK);
    push_evenly(50, 8020000u + 400000u); /* after a gap */
    insole_gait_window_t over_gap = {7900000u, 8600000u, 1u, 0};
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
    const insole_real_t odd[] = {(insole_real_t)NAN, (insole_real_t)INFINITY, INSOLE_R(1001.0)};
    uint64_t next_us = motion.t_us + 1u;
    insole_gait_window_t w = {100000u, 600000u, 1u, 0}, bad;
    insole_gait_moments_t m;
    for (size_t i = 0; i < 3; i++) {
        insole_vec3_t wrong[] = {{odd[i], 0, 0}, {0, odd[i], 0}, {0, 0, odd[i]}};
        for (int k = 0; k < 3; k++) {
            ASSERT_UNCHANGED(motion, insole_gait_motion_push(&motion, wrong[k], 0, next_us),
                             INSOLE_ERR_VALUE);
        }
        ASSERT_UNCHANGED(motion, insole_gait_motion_push(&motion, a, odd[i], next_us),
                         INSOLE_ERR_VALUE);
        bad = w;
        bad.lead_rad = odd[i];
        ASSERT_UNCHANGED(motion, insole_gait_motion_look(&motion, &bad, &m), INSOLE_ERR_VALUE);
    }
    ASSERT_UNCHANGED(motion, insole_gait_motion_push(&motion, a, 0, motion.t_us), INSOLE_ERR_TIME);
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
    ck_assert_int_eq(insole_gait_motion_push(NULL, a, 0, next_us), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_gait_motion_init(NULL), INSOLE_ERR_NULL);
    begin();
    ck_assert_int_eq(insole_gait_motion_look(&motion, &w, &m), INSOLE_ERR_TIME);
}
END_TEST

/* 10 kHz: a slot's count does not wrap. */
START_TEST(a_full_slot_leaves_samples_out)
{
    begin();
    for (uint64_t k = 0; k < 10000u; k++) {
        insole_vec3_t a = insole_vec3(k % 500u < 100u ? 1 : 0, 0, 9);
        ck_assert_int_eq(insole_gait_motion_push(&motion, a, 0, k * 100u), INSOLE_OK);
    }
    insole_gait_window_t w = {200000u, 800000u, 1u, 0};
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
    suite_add(suite, "reference", reference_leads_by_its_phase);
    suite_add(suite, "memory", what_is_forgotten_or_missing_is_not_looked_at);
    suite_add(suite, "arguments", bad_arguments_are_refused);
    suite_add(suite, "full", a_full_slot_leaves_samples_out);
    return suite;
}
