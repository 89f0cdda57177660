/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_strides.h"

#include <math.h>

#include "near.h"
#include "refusal.h"
#include "suite.h"

static insole_fusion_strides_t strides;
static insole_evidence_t news;

static insole_spot_t spot(double x, double y)
{
    insole_spot_t s = {(insole_real_t)x, (insole_real_t)y};
    return s;
}

static void begin(void)
{
    insole_evidence_clear(&news);
    insole_fusion_strides_begin(&strides, spot(1.0, 2.0));
}

static void gather(double turn_rad, double model_m)
{
    insole_stride_t stride = {0};
    stride.turn_rad = (insole_real_t)turn_rad;
    stride.model_length_m = (insole_real_t)model_m;
    ck_assert_int_eq(insole_fusion_strides_gather(&strides, &stride), INSOLE_OK);
}

START_TEST(one_stride_is_told_as_it_is)
{
    begin();
    gather(0.3, 1.2);
    ck_assert_uint_eq(strides.waiting, 1);
    ck_assert_int_eq(insole_fusion_strides_tell(&strides, spot(4.0, 6.0), false, &news), INSOLE_OK);
    ck_assert(news.has_stride);
    ASSERT_NEAR(news.length_m, 5.0, 1e-5, "m");
    ASSERT_NEAR(news.heading_rad, atan2(4.0, 3.0), 1e-5, "rad");
    ASSERT_NEAR(news.turn_rad, 0.3, 1e-6, "rad");
    ck_assert_uint_eq(strides.waiting, 0);
    ASSERT_NEAR(strides.told_n_m.x_m, 4.0, 0.0, "m");
    ASSERT_NEAR(strides.done_n_m.x_m, 1.0, 0.0, "m"); /* not worked in yet */
    insole_fusion_strides_done(&strides);
    ASSERT_NEAR(strides.done_n_m.x_m, 4.0, 0.0, "m");
    ASSERT_NEAR(strides.done_n_m.y_m, 6.0, 0.0, "m");
}
END_TEST

/* Turns add up on the circle, the model's lengths as they are; each is told once. */
START_TEST(those_that_wait_are_told_as_one)
{
    begin();
    for (int i = 0; i < 5; i++) {
        gather(1.5, 1.1);
    }
    ck_assert_int_eq(insole_fusion_strides_tell(&strides, spot(1.0, 4.0), true, &news), INSOLE_OK);
    ASSERT_NEAR(news.length_m, 5.5, 1e-5, "m");
    ASSERT_NEAR(news.turn_rad, remainder(7.5, 2.0 * acos(-1.0)), 1e-5, "rad");
    ASSERT_NEAR(news.heading_rad, 0.5 * acos(-1.0), 1e-5, "rad");
    gather(0.1, 1.0);
    ck_assert_int_eq(insole_fusion_strides_tell(&strides, spot(1.0, 5.0), true, &news), INSOLE_OK);
    ASSERT_NEAR(news.length_m, 1.0, 1e-5, "m");
    ASSERT_NEAR(news.turn_rad, 0.1, 1e-5, "rad");
}
END_TEST

START_TEST(the_cloud_lags_behind_what_is_not_done)
{
    begin();
    ck_assert_uint_eq(insole_fusion_strides_behind(&strides), 0);
    gather(0.0, 1.0);
    gather(0.0, 1.0);
    ck_assert_uint_eq(insole_fusion_strides_behind(&strides), 2);
    (void)insole_fusion_strides_tell(&strides, spot(3.0, 2.0), false, &news);
    ck_assert_uint_eq(insole_fusion_strides_behind(&strides), 2);
    gather(0.0, 1.0);
    ck_assert_uint_eq(insole_fusion_strides_behind(&strides), 3);
    insole_fusion_strides_done(&strides);
    ck_assert_uint_eq(insole_fusion_strides_behind(&strides), 1);
    begin();
    ck_assert_uint_eq(insole_fusion_strides_behind(&strides), 0);
}
END_TEST

/* Farther than a stride may be: nothing is told, nothing forgotten. */
START_TEST(too_far_is_refused)
{
    begin();
    gather(0.2, 1.0);
    ASSERT_UNCHANGED(strides, insole_fusion_strides_tell(&strides, spot(102.0, 2.0), false, &news),
                     INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(strides,
                     insole_fusion_strides_tell(&strides, spot((double)NAN, 2.0), false, &news),
                     INSOLE_ERR_VALUE);
    ck_assert(!news.has_stride);
    ck_assert_int_eq(insole_fusion_strides_tell(&strides, spot(100.0, 2.0), false, &news),
                     INSOLE_OK);
}
END_TEST

START_TEST(bad_calls_change_nothing)
{
    begin();
    gather(0.2, 1.0);
    insole_stride_t stride = {0};
    ASSERT_UNCHANGED(strides, insole_fusion_strides_gather(&strides, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(strides, insole_fusion_strides_tell(&strides, spot(2.0, 2.0), false, NULL),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_strides_gather(NULL, &stride), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_strides_tell(NULL, spot(2.0, 2.0), false, &news),
                     INSOLE_ERR_NULL);
    insole_fusion_strides_begin(NULL, spot(0.0, 0.0));
    insole_fusion_strides_done(NULL);
    ck_assert_uint_eq(insole_fusion_strides_behind(NULL), 0);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("fusion_strides");
    suite_add(suite, "one", one_stride_is_told_as_it_is);
    suite_add(suite, "many", those_that_wait_are_told_as_one);
    suite_add(suite, "behind", the_cloud_lags_behind_what_is_not_done);
    suite_add(suite, "too far", too_far_is_refused);
    suite_add(suite, "bad calls", bad_calls_change_nothing);
    return suite;
}
