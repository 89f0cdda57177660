/* SPDX-License-Identifier: MIT */
#include "insole/move/gait_evidence.h"

#include <complex.h>

#include "insole/base/rng.h"
#include "motion.h"
#include "near.h"
#include "sample.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define EPS ((double)INSOLE_REAL_EPSILON)

static insole_gait_moments_t moments;

static insole_gait_wave_t any_wave(insole_rng_t *rng)
{
    insole_gait_wave_t wave = {sample_vec3(rng, 3), sample_vec3(rng, 3)};
    return wave;
}

/* The real part of it times exp(i w t) is the wave. */
static double complex amplitude(insole_real_t c, insole_real_t s)
{
    return (double)c - csqrt(-1.0) * (double)s;
}

static void part_of(const insole_gait_wave_t *w, double lead, double *x, double *y, double *size)
{
    double complex ax = amplitude(w->c.x, w->s.x), ay = amplitude(w->c.y, w->s.y);
    double complex az = amplitude(w->c.z, w->s.z);
    *x = creal(ax * conj(az) * cexp(-csqrt(-1.0) * lead));
    *y = creal(ay * conj(az) * cexp(-csqrt(-1.0) * lead));
    *size = cabs(az) * sqrt(creal(ax * conj(ax) + ay * conj(ay)));
}

/* By complex numbers, without any tilt to fear. */
START_TEST(products_are_those_of_complex_amplitudes)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t off = {0.0, 0.0}, length = {0.0, 0.0};
    for (int i = 0; i < 1000; i++) {
        double lead = (double)sample_between(&rng, -3, 3), x, y, size, x2, y2, size2;
        moments.step = any_wave(&rng);
        moments.stride = any_wave(&rng);
        part_of(&moments.step, lead, &x, &y, &size);
        part_of(&moments.stride, 0.0, &x2, &y2, &size2);
        insole_vec3_t ahead = insole_gait_ahead(&moments, (insole_real_t)lead, 0);
        worst_note(&off, fabs((double)ahead.x - (x + x2) / (size + size2)), i);
        worst_note(&off, fabs((double)ahead.y - (y + y2) / (size + size2)), i);
        worst_note(&length, (double)insole_vec3_level(ahead), i);
    }
    ASSERT_WORST(off, 30.0 * EPS, "");
    ASSERT_WORST(length, 1.0 + 4.0 * EPS, "");
}
END_TEST

/* Turned with its waves about the vertical. */
START_TEST(evidence_turns_with_the_motion)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 300; i++) {
        moments.step = any_wave(&rng);
        moments.stride = any_wave(&rng);
        d3_t ahead = d3_of(insole_gait_ahead(&moments, INSOLE_R(0.8), INSOLE_R(0.01)));
        d33_t turn = turn_z(i * 0.1);
        insole_vec3_t *v[] = {&moments.step.c, &moments.step.s, &moments.stride.c,
                              &moments.stride.s};
        for (int k = 0; k < 4; k++) {
            *v[k] = real_of(d33_apply(turn, d3_of(*v[k])));
        }
        d3_t turned = d3_of(insole_gait_ahead(&moments, INSOLE_R(0.8), INSOLE_R(0.01)));
        worst_note(&off, d3_norm(d3_add(turned, -1.0, d33_apply(turn, ahead))), i);
    }
    ASSERT_WORST(off, 30.0 * EPS, "");
}
END_TEST

/* A trunk, a quarter of a step ahead; a thigh that rises with its way ahead, seen both ways. */
START_TEST(what_walks_points_ahead)
{
    const insole_gait_moments_t none = {.device_rad = 0};
    moments = none;
    moments.step.c.z = 3;
    moments.step.s.x = -1; /* cos(wt + pi/2) */
    insole_vec3_t trunk = insole_gait_ahead(&moments, INSOLE_R(1.1), 0);
    ASSERT_NEAR(trunk.x, sin(1.1), 4.0 * EPS, "");
    ASSERT_NEAR(trunk.y, 0.0, 4.0 * EPS, "");
    for (int sign = -1; sign <= 1; sign += 2) {
        moments = none;
        moments.stride.s = insole_vec3((insole_real_t)(2 * sign), 0, 1);
        insole_vec3_t thigh = insole_gait_ahead(&moments, INSOLE_R(1.1), 0);
        ASSERT_NEAR(thigh.x, sign, 4.0 * EPS, "");
    }
    moments = none;
    ck_assert(insole_vec3_max_abs(insole_gait_ahead(&moments, 1, 0)) <= 0);
}
END_TEST

/* A bounce of 4 seen at a slant of 0.1, as likely as not: half of what is level is feigned. The
 * same of a swing that hardly rises. */
START_TEST(what_a_tilt_feigns_counts_less)
{
    const insole_gait_moments_t none = {.device_rad = 0};
    moments = none;
    moments.step.c = insole_vec3(INSOLE_R(0.4), 0, 4);
    ASSERT_NEAR(insole_gait_ahead(&moments, 0, INSOLE_R(0.01)).x, 0.5, 4.0 * EPS, "");
    moments = none;
    moments.stride.s = insole_vec3(4, 0, INSOLE_R(0.4));
    ASSERT_NEAR(insole_gait_ahead(&moments, 0, INSOLE_R(0.01)).x, 0.5, 4.0 * EPS, "");
    moments.stride.s.z = 4;
    ASSERT_NEAR(insole_gait_ahead(&moments, 0, INSOLE_R(0.01)).x, 1.0 / 1.01, 4.0 * EPS, "");
}
END_TEST

/* Weight 1 is the scatter itself; weight 0 is that of the step's wave alone, by its mean square. */
START_TEST(a_sway_counts_its_weight)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    for (int i = 0; i < 100; i++) {
        moments.step = any_wave(&rng);
        moments.scatter = sample_sym3(&rng, 2);
        insole_sym3_t whole = insole_gait_ahead_scatter(&moments, 1);
        ck_assert(memcmp(&whole, &moments.scatter, sizeof whole) == 0);
        double xy = 0.0, zz = 0.0;
        for (int k = 0; k < 100; k++) {
            double c = cos(2.0 * PI * k / 100.0), s = sin(2.0 * PI * k / 100.0);
            d3_t a = d3_add(d3_scale(d3_of(moments.step.c), c), s, d3_of(moments.step.s));
            xy += a.x * a.y / 100.0;
            zz += a.z * a.z / 100.0;
        }
        insole_sym3_t own = insole_gait_ahead_scatter(&moments, 0);
        ASSERT_NEAR(own.xy, xy, 40.0 * EPS, "m^2/s^4");
        ASSERT_NEAR(own.zz, zz, 40.0 * EPS, "m^2/s^4");
        insole_sym3_t quarter = insole_gait_ahead_scatter(&moments, INSOLE_R(0.25));
        ASSERT_NEAR(quarter.xy, 0.75 * xy + 0.25 * (double)whole.xy, 40.0 * EPS, "m^2/s^4");
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("gait_evidence");
    suite_add(suite, "products", products_are_those_of_complex_amplitudes);
    suite_add(suite, "products", evidence_turns_with_the_motion);
    suite_add(suite, "ahead", what_walks_points_ahead);
    suite_add(suite, "tilt", what_a_tilt_feigns_counts_less);
    suite_add(suite, "sway", a_sway_counts_its_weight);
    return suite;
}
