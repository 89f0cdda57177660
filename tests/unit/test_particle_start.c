/* SPDX-License-Identifier: MIT */
#include "insole/fuse/particle_start.h"

#include "near.h"
#include "suite.h"

static const insole_particle_start_t known = {3, -4, 2, INSOLE_R(7.0), INSOLE_R(0.3)};
static const insole_particle_origin_t heard = {
    {5, {3, -4}, {9, INSOLE_R(1.5), 4}, {0, 0}}, true, INSOLE_R(7.0), INSOLE_R(0.3)};

static void expect(const insole_cloud_source_t *source, double xx, double xy, double yy)
{
    ASSERT_NEAR(source->x_m, 3.0, 0.0, "m");
    ASSERT_NEAR(source->y_m, -4.0, 0.0, "m");
    ASSERT_NEAR(source->var_x_m2, xx, 1e-6, "m2");
    ASSERT_NEAR(source->cov_xy_m2, xy, 1e-6, "m2");
    ASSERT_NEAR(source->var_y_m2, yy, 1e-6, "m2");
    ASSERT_NEAR(source->offset_rad, 7.0 - 6.283185307, 1e-6, "rad");
    ASSERT_NEAR(source->sigma_offset_rad, 0.3, 1e-7, "rad");
    ASSERT_NEAR(source->scale, 1.0, 0.0, "");
    ASSERT_NEAR(source->sigma_scale, 0.1, 1e-7, "");
}

START_TEST(a_circle)
{
    insole_cloud_source_t source = insole_particle_start_source(&known, INSOLE_R(0.1));
    expect(&source, 4.0, 0.0, 4.0);
}
END_TEST

/* Who starts at a fix by radio is as far off as the fix and its bias together. */
START_TEST(a_covariance_and_a_bias)
{
    insole_particle_origin_t origin = heard;
    insole_cloud_source_t source = insole_particle_origin_source(&origin, 3, INSOLE_R(0.1));
    expect(&source, 18.0, 1.5, 13.0);
    origin.by_radio = false;
    source = insole_particle_origin_source(&origin, 3, INSOLE_R(0.1));
    expect(&source, 9.0, 1.5, 4.0);
}
END_TEST

START_TEST(what_is_no_start_is_refused)
{
    const insole_real_t nan = (insole_real_t)(double)NAN, inf = (insole_real_t)(double)INFINITY;
    insole_particle_start_t s[] = {known, known, known, known, known, known, known, known};
    insole_particle_origin_t o[] = {heard, heard, heard, heard, heard, heard};
    s[0].x_m = nan;
    s[1].y_m = inf;
    s[2].sigma_m = -1;
    s[3].sigma_m = INSOLE_R(10001.0);
    s[4].sigma_m = nan;
    s[5].offset_rad = inf;
    s[6].sigma_offset_rad = -1;
    s[7].sigma_offset_rad = nan;
    for (int i = 0; i < 8; i++) {
        ck_assert_int_eq(insole_particle_start_check(&s[i]), INSOLE_ERR_VALUE);
    }
    o[0].at.spot.x_m = nan;
    o[1].at.cov_m2.xx = 0;
    o[2].at.cov_m2.xy = 7;
    o[3].offset_rad = nan;
    o[4].sigma_offset_rad = -1;
    o[5].sigma_offset_rad = nan;
    for (int i = 0; i < 6; i++) {
        ck_assert_int_eq(insole_particle_origin_check(&o[i]), INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_particle_start_check(&known), INSOLE_OK);
    ck_assert_int_eq(insole_particle_origin_check(&heard), INSOLE_OK);
    ck_assert_int_eq(insole_particle_start_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_particle_origin_check(NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("particle_start");
    suite_add(suite, "circle", a_circle);
    suite_add(suite, "covariance", a_covariance_and_a_bias);
    suite_add(suite, "bad input", what_is_no_start_is_refused);
    return suite;
}
