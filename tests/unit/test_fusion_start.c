/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_start.h"

#include <math.h>
#include <string.h>

#include "insole/base/rng.h"
#include "near.h"
#include "refusal.h"
#include "suite.h"

#define PI   3.14159265358979323846
#define ZERO INSOLE_R(0.0)

static insole_fusion_start_t start;
static insole_fusion_radio_t radio;
static insole_particle_start_t where;

static void begin(int32_t fixes)
{
    const insole_fusion_radio_t blank = {.has_fix = false};
    radio = blank;
    memset(&where, 0, sizeof where);
    ck_assert_int_eq(insole_fusion_start_init(&start, fixes), INSOLE_OK);
}

/* The foot is at (x, y) in n, and radio finds it without an error. */
static void place(double t_s, double x, double y, double offset_rad)
{
    double c = cos(offset_rad), s = sin(offset_rad);
    radio.has_fix = true;
    radio.fix_us = (uint64_t)llround(1e6 * t_s);
    radio.fix_n_m = insole_spot((insole_real_t)x, (insole_real_t)y);
    radio.fix.x_m = (insole_real_t)(70.0 + c * x - s * y);
    radio.fix.y_m = (insole_real_t)(-30.0 + s * x + c * y);
    radio.fix.P = (insole_sym3_t){.xx = 4, .xy = 1, .yy = 2, .zz = 1};
}

static bool hear(void)
{
    return insole_fusion_start_hear(&start, &radio, &where);
}

/* The particles search for the direction. */
START_TEST(the_first_fix_is_a_start_in_any_direction)
{
    begin(1);
    ck_assert(!hear());
    place(1.0, 5.0, -2.0, 0.4);
    ck_assert(hear());
    ASSERT_NEAR(where.x_m, radio.fix.x_m, 0.0, "m");
    ASSERT_NEAR(where.y_m, radio.fix.y_m, 0.0, "m");
    ASSERT_NEAR(where.sigma_offset_rad, PI, 1e-6, "rad");
    ASSERT_AT_LEAST(where.sigma_m, sqrt(3.0), "m"); /* with what fixes share, and no less */
    ASSERT_AT_MOST(where.sigma_m, 2.5, "m");
    ck_assert_int_eq(insole_particle_start_check(&where), INSOLE_OK);
}
END_TEST

/* Whoever takes the first fix takes what the method of several makes of one, to the bit. */
START_TEST(the_first_fix_needs_no_method)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    for (int i = 0; i < 2000; i++) {
        begin(1);
        place(1.0 + i, 5.0, -2.0, 0.01 * i);
        insole_real_t sigma_m =
            insole_exp(INSOLE_R(12.0) * insole_rng_uniform(&rng) - INSOLE_R(6.0));
        insole_real_t share = INSOLE_R(0.9) * insole_rng_uniform(&rng);
        radio.fix.P = (insole_sym3_t){.xx = sigma_m, .xy = share * sigma_m, .yy = sigma_m};
        insole_particle_start_t first = {.x_m = ZERO};
        ck_assert(insole_fusion_start_first(&radio, &first));
        ck_assert(hear());
        ck_assert_mem_eq(&first, &where, sizeof first);
    }
}
END_TEST

START_TEST(no_fix_is_no_start)
{
    begin(1);
    const insole_particle_start_t before = where;
    ck_assert(!insole_fusion_start_first(&radio, &where));
    ck_assert(!insole_fusion_start_first(NULL, &where));
    place(1.0, 0.0, 0.0, 0.0);
    ck_assert(!insole_fusion_start_first(&radio, NULL));
    radio.fix.y_m = (insole_real_t)INFINITY;
    ck_assert(!insole_fusion_start_first(&radio, &where));
    ck_assert_mem_eq(&where, &before, sizeof where);
}
END_TEST

START_TEST(more_fixes_tell_a_direction)
{
    static const double OFFSETS[] = {0.0, 1.3, -2.8, PI};
    begin(5);
    for (int i = 0; i < 5; i++) {
        place(1.0 + i, 3.0 * i - 7.0, i > 2 ? 4.0 * (i - 2) : 1.0, OFFSETS[_i]);
        ck_assert(hear() == (i == 4));
    }
    ASSERT_NEAR(remainder((double)where.offset_rad - OFFSETS[_i], 2.0 * PI), 0.0, 1e-4, "rad");
    ASSERT_NEAR(where.x_m, radio.fix.x_m, 1e-3, "m");
    ASSERT_NEAR(where.y_m, radio.fix.y_m, 1e-3, "m");
    ASSERT_AT_MOST(where.sigma_offset_rad, 0.5, "rad");
    ASSERT_AT_LEAST(where.sigma_offset_rad, 0.05, "rad");
}
END_TEST

/* Whoever stands goes in no direction. */
START_TEST(a_foot_that_stands_has_none)
{
    begin(4);
    for (int i = 0; i < 4; i++) {
        place(1.0 + i, 2.0, 3.0, 0.7);
        ck_assert(hear() == (i == 3));
    }
    ASSERT_NEAR(where.sigma_offset_rad, PI, 1e-6, "rad");
}
END_TEST

START_TEST(a_fix_counts_once)
{
    begin(3);
    for (int i = 0; i < 3; i++) {
        place(1.0 + i, 1.0 * i, 0.0, 0.0);
        ck_assert(hear() == (i == 2));
        const insole_fusion_start_t before = start;
        ck_assert(!hear());
        ck_assert_mem_eq(&start, &before, sizeof start);
    }
    radio.has_fix = false;
    radio.fix_us += 1000000u;
    ck_assert(!hear());
    ck_assert_uint_eq(start.fixes.fixes, 3u);
}
END_TEST

START_TEST(what_is_no_fix_is_left_aside)
{
    begin(1);
    place(1.0, 0.0, 0.0, 0.0);
    radio.fix.x_m = (insole_real_t)NAN;
    const insole_particle_start_t before = where;
    ck_assert(!hear());
    ck_assert_mem_eq(&where, &before, sizeof where);
    place(2.0, 0.0, 0.0, 0.0);
    ck_assert(hear());
}
END_TEST

START_TEST(bad_input_is_refused)
{
    begin(1);
    place(1.0, 0.0, 0.0, 0.0);
    ck_assert_int_eq(insole_fusion_start_init(NULL, 1), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(start, insole_fusion_start_init(&start, 0), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(start, insole_fusion_start_init(&start, INSOLE_FUSION_START_MOST + 1),
                     INSOLE_ERR_VALUE);
    ck_assert(!insole_fusion_start_hear(NULL, &radio, &where));
    ck_assert(!insole_fusion_start_hear(&start, NULL, &where));
    ck_assert(!insole_fusion_start_hear(&start, &radio, NULL));
    ck_assert_uint_eq(start.fixes.fixes, 0u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("fusion_start");
    suite_add(suite, "first", the_first_fix_is_a_start_in_any_direction);
    suite_add(suite, "first alone", the_first_fix_needs_no_method);
    suite_add(suite, "none", no_fix_is_no_start);
    suite_add_loop(suite, "direction", more_fixes_tell_a_direction, 4);
    suite_add(suite, "stands", a_foot_that_stands_has_none);
    suite_add(suite, "once", a_fix_counts_once);
    suite_add(suite, "no fix", what_is_no_fix_is_left_aside);
    suite_add(suite, "bad input", bad_input_is_refused);
    return suite;
}
