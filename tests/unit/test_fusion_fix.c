/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_fix.h"

#include <math.h>

#include "near.h"
#include "refusal.h"
#include "suite.h"

static insole_fix_t fix;
static insole_cloud_fix_t cloud;
static const insole_spot_t then_n = {10, 20}, now_n = {13, 24};

static void begin(void)
{
    insole_cloud_fix_t c = {.x_m = 100,
                            .y_m = 50,
                            .var_x_m2 = 1,
                            .cov_xy_m2 = INSOLE_R(0.5),
                            .var_y_m2 = 2,
                            .offset_rad = INSOLE_R(1.0),
                            .var_offset_rad2 = INSOLE_R(0.04),
                            .scale = INSOLE_R(1.1)};
    insole_fix_t f = {7, {1, 2, 3}, INSOLE_R(3.0), 9, 8, 7, 6, 5, INSOLE_FIX_COAST};
    cloud = c;
    fix = f;
}

/* The way in n, turned and stretched as the cloud's mean goes, by complex numbers. */
START_TEST(it_goes_on_as_the_cloud_would)
{
    begin();
    ck_assert_int_eq(insole_fusion_fix_by_cloud(&cloud, then_n, now_n, INSOLE_R(0.5), &fix),
                     INSOLE_OK);
    double angle = atan2(4.0, 3.0) + 1.0, way_m = 5.0 * 1.1;
    ASSERT_NEAR(fix.position_m.x, 100.0 + way_m * cos(angle), 1e-4, "m");
    ASSERT_NEAR(fix.position_m.y, 50.0 + way_m * sin(angle), 1e-4, "m");
    ASSERT_NEAR(fix.position_m.z, 3.0, 0.0, "m");
    ASSERT_NEAR(fix.heading_rad, remainder(3.5, 2.0 * acos(-1.0)), 1e-5, "rad");
    ASSERT_NEAR(fix.var_heading_rad2, 0.04, 1e-7, "rad2");
    ASSERT_NEAR(fix.var_x_m2, 1.0, 0.0, "m2");
    ASSERT_NEAR(fix.cov_xy_m2, 0.5, 0.0, "m2");
    ASSERT_NEAR(fix.var_y_m2, 2.0, 0.0, "m2");
    ASSERT_NEAR(fix.var_z_m2, 6.0, 0.0, "m2");
    ck_assert(fix.t_us == 7 && fix.state == INSOLE_FIX_COAST);
}
END_TEST

START_TEST(where_the_cloud_is_told_it_is_the_cloud)
{
    begin();
    (void)insole_fusion_fix_by_cloud(&cloud, now_n, now_n, 0, &fix);
    ASSERT_NEAR(fix.position_m.x, 100.0, 0.0, "m");
    ASSERT_NEAR(fix.position_m.y, 50.0, 0.0, "m");
}
END_TEST

START_TEST(bad_calls_change_nothing)
{
    begin();
    ASSERT_UNCHANGED(fix, insole_fusion_fix_by_cloud(NULL, then_n, now_n, 0, &fix),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_fix_by_cloud(&cloud, then_n, now_n, 0, NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("fusion_fix");
    suite_add(suite, "goes on", it_goes_on_as_the_cloud_would);
    suite_add(suite, "same place", where_the_cloud_is_told_it_is_the_cloud);
    suite_add(suite, "bad calls", bad_calls_change_nothing);
    return suite;
}
