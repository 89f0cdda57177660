/* SPDX-License-Identifier: MIT
 * A day on the shoe: 1,440 laps of a minute at 200 Hz, each a loop of 48 strides between two rests.
 * Every sample must become a fix with its own stamp; whatever is said must be finite, the walk must
 * go on in every lap, and the errors at the ends of the laps must be as large as they are said to
 * be. Nothing but the shoe tells where it is: that it may at last call itself lost is honest. */
#include <math.h>
#include <stdio.h>

#include "insole/track/foot_tracker.h"
#include "near.h"
#include "suite.h"
#include "walk_samples.h"

enum { LAPS = 1440, RATE_HZ = 200, LAP_S = 60, LAP = LAP_S * RATE_HZ, STRIDES = 48 };
enum { STEP_US = 1000000 / RATE_HZ };

static insole_imu_t lap[LAP];
static insole_foot_tracker_t shoe;
static insole_rng_t rng;

static void make_lap(void)
{
    walk_t walk = WALK;
    walk.strides = STRIDES;
    walk.turn_rad = 6.283185307179586 / STRIDES;
    walk.rest_s = 0.5 * (LAP_S - STRIDES * (walk.swing_s + walk.stance_s) + walk.stance_s);
    walk.accel_noise_mps2 = walk.gyro_noise_radps = 0.0;
    for (uint32_t i = 0; i < LAP; i++) {
        lap[i] = walk_sample(&walk, (double)i / RATE_HZ, (double)(i + 1u) / RATE_HZ, NULL);
    }
}

static insole_vec3_t noise(double sigma)
{
    insole_real_t x = insole_rng_normal(&rng), y = insole_rng_normal(&rng);
    return insole_vec3_scale(insole_vec3(x, y, insole_rng_normal(&rng)), (insole_real_t)sigma);
}

static insole_imu_t sample(uint64_t number)
{
    insole_imu_t imu = lap[number % LAP];
    imu.t_us = (number + 1u) * STEP_US;
    imu.accel_mps2 = insole_vec3_add(imu.accel_mps2, noise(WALK.accel_noise_mps2));
    imu.gyro_radps = insole_vec3_add(imu.gyro_radps, noise(WALK.gyro_noise_radps));
    return imu;
}

/* What became of the fixes. */
typedef struct {
    uint64_t fixes, wrong_stamps, not_finite, not_tracking, lazy_laps;
    double farthest_m;           /**< from where the lap began, in this lap */
    double begin_x_m, begin_y_m; /**< of the lap, as told */
    double nees, worst_nees;     /**< of the ends of the laps: sum, largest */
    double error_m, sigma_m;     /**< at the end of the last lap */
} soak_t;

static void note_lap(soak_t *soak, const insole_fix_t *fix)
{
    double x = (double)fix->position_m.x, y = (double)fix->position_m.y;
    double xx = (double)fix->var_x_m2, xy = (double)fix->cov_xy_m2, yy = (double)fix->var_y_m2;
    double nees = (x * x * yy - 2.0 * x * y * xy + y * y * xx) / (xx * yy - xy * xy);
    soak->nees += nees;
    soak->worst_nees = fmax(soak->worst_nees, nees);
    soak->lazy_laps += soak->farthest_m < 20.0 ? 1u : 0u;
    soak->error_m = hypot(x, y);
    soak->sigma_m = sqrt(xx + yy);
    soak->farthest_m = 0.0;
    soak->begin_x_m = x;
    soak->begin_y_m = y;
}

static void note(soak_t *soak, const insole_fix_t *fix)
{
    double x = (double)fix->position_m.x - soak->begin_x_m;
    double y = (double)fix->position_m.y - soak->begin_y_m;
    soak->fixes++;
    soak->wrong_stamps += fix->t_us != soak->fixes * STEP_US ? 1u : 0u;
    bool finite = insole_vec3_is_finite(fix->position_m) && insole_is_finite(fix->heading_rad) &&
                  insole_is_finite(fix->var_x_m2 + fix->var_y_m2 + fix->var_z_m2) &&
                  insole_is_finite(fix->cov_xy_m2 + fix->var_heading_rad2);
    soak->not_finite += finite ? 0u : 1u;
    soak->not_tracking +=
        fix->state != INSOLE_FIX_TRACK && fix->state != INSOLE_FIX_LOST && fix->t_us > 5000000u
            ? 1u
            : 0u;
    soak->farthest_m = fmax(soak->farthest_m, hypot(x, y));
    if (soak->fixes % LAP == 0u) {
        note_lap(soak, fix);
    }
}

static void take(soak_t *soak)
{
    insole_fix_t fix;
    while (insole_foot_tracker_next(&shoe, &fix) == INSOLE_OK) {
        note(soak, &fix);
    }
}

START_TEST(walks_a_day)
{
    soak_t soak = {0};
    make_lap();
    insole_rng_seed(&rng, 1u);
    ck_assert_int_eq(insole_foot_tracker_init(&shoe, &insole_foot_tracker_defaults), INSOLE_OK);
    for (uint64_t i = 0; i < (uint64_t)LAPS * LAP; i++) {
        insole_imu_t imu = sample(i);
        ck_assert_int_eq(insole_foot_tracker_imu(&shoe, &imu), INSOLE_OK);
        take(&soak);
    }
    (void)insole_foot_tracker_finish(&shoe);
    take(&soak);
    printf("%.0f samples, %u strides, mean NEES %.3f, worst %.1f, at the end %.2f m off, 1-sigma "
           "%.2f m\n",
           (double)soak.fixes, shoe.strides.count, soak.nees / LAPS, soak.worst_nees, soak.error_m,
           soak.sigma_m);
    fflush(stdout);
    ck_assert_uint_eq(soak.fixes, (uint64_t)LAPS * LAP);
    ck_assert_uint_eq(soak.wrong_stamps, 0u);
    ck_assert_uint_eq(soak.not_finite, 0u);
    ck_assert_uint_eq(soak.not_tracking, 0u);
    ck_assert_uint_eq(soak.lazy_laps, 0u);
    ck_assert_uint_eq(shoe.counts.refused, 0u);
    ck_assert_uint_ge(shoe.strides.count, (uint32_t)(LAPS * STRIDES * 99 / 100));
    ck_assert_uint_le(shoe.strides.count, (uint32_t)(LAPS * STRIDES * 101 / 100));
    ASSERT_AT_MOST(soak.nees / LAPS, 6.0, "(two for each axis that is honest)");
    ASSERT_AT_MOST(soak.error_m, 3.0 * soak.sigma_m, "m");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("soak");
    TCase *day = tcase_create("day");
    tcase_set_timeout(day, 3600.0);
    tcase_add_test(day, walks_a_day);
    suite_add_tcase(suite, day);
    return suite;
}
