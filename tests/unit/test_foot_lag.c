/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_lag.h"

#include <string.h>

#include "fusion_walk.h"
#include "near.h"
#include "refusal.h"
#include "suite.h"

static insole_fix_t at_once[FUSION_SAMPLES];

/* So late, and no later. */
START_TEST(a_late_fix_is_as_late_as_told)
{
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.config.lag_s = 3;
    set_up(&c);
    run(&c, &fusion, 0u, 2000u);
    ck_assert_uint_gt(fix_count, 100);
    uint64_t newest = samples[1999].t_us, last = fixes[fix_count - 1u].t_us;
    ASSERT_AT_LEAST((double)(newest - last), 3.0e6, "us");
    ASSERT_AT_MOST((double)(newest - last), 3.6e6, "us"); /* and what the first order waits */
    c.late = 100; /* less room than the lag: as late as there is room */
    set_up(&c);
    run(&c, &fusion, 0u, 2000u);
    last = fixes[fix_count - 1u].t_us;
    ASSERT_AT_MOST((double)(newest - last), 1.6e6, "us");
    finish(&c, &fusion);
    ck_assert_uint_eq(fix_count, 2000);
}
END_TEST

/* Without a lag, and where radio alone answers, it is the fusion itself. */
START_TEST(without_a_lag_nothing_waits)
{
    insole_fix_t fix;
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.config.lag_s = _i == 0 ? 0 : 2;
    c.config.method = _i == 0 ? INSOLE_FUSION_BEST : INSOLE_FUSION_WIFI;
    set_up(&c);
    uint32_t count = 0u;
    for (uint32_t i = 0u; i < 1500u; i++) {
        tell_radio(&c, &fusion, i > 0u ? samples[i - 1u].t_us : 0u, samples[i].t_us);
        if (_i == 0) { /* radio alone has no use for it */
            ck_assert_int_eq(insole_foot_fusion_imu(&fusion, &samples[i]), INSOLE_OK);
        }
        insole_foot_fusion_t other = fusion;
        insole_foot_late_t before = waiting;
        insole_status_t status = insole_foot_fusion_next(&other, &at_once[0]);
        ck_assert_int_eq(insole_foot_lag_next(&waiting, &fusion, &fix), status);
        ck_assert_mem_eq(&waiting, &before, sizeof before);
        if (status == INSOLE_OK) {
            ck_assert_mem_eq(&fix.position_m, &at_once[0].position_m, sizeof fix.position_m);
            ck_assert_uint_eq(fix.t_us, at_once[0].t_us);
            count++;
        }
        work(&c, &fusion);
    }
    ck_assert_uint_ge(count, _i == 0 ? 1400u : 10u);
}
END_TEST

/* But for the place, and that is never far from where it was thought to be. */
START_TEST(a_late_fix_is_the_one_at_once_moved)
{
    walk_round(1u);
    fusion_case_t c = usual_case();
    run_case(&c);
    uint32_t count = fix_count, moved = 0u;
    memcpy(at_once, fixes, sizeof at_once);
    c.config.lag_s = 5;
    run_case(&c);
    ck_assert_uint_eq(fix_count, count);
    for (uint32_t i = 0u; i < count; i++) {
        const insole_fix_t *now = &fixes[i], *then = &at_once[i];
        ck_assert(now->t_us == then->t_us && now->state == then->state);
        ASSERT_NEAR(now->heading_rad, then->heading_rad, 0.0, "rad");
        ASSERT_NEAR(now->position_m.z, then->position_m.z, 0.0, "m");
        double off_m = hypot((double)(now->position_m.x - then->position_m.x),
                             (double)(now->position_m.y - then->position_m.y));
        moved += off_m > 0.0 ? 1u : 0u;
        ASSERT_AT_MOST(off_m, 2.5, "m");
    }
    ck_assert_uint_ge(moved, count / 2u);
}
END_TEST

/* At the end no late fix leaves before all that is known has been worked in. */
START_TEST(the_last_fixes_wait_for_the_work)
{
    insole_fix_t fix;
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.config.lag_s = 4;
    set_up(&c);
    run(&c, &fusion, 0u, 3000u);
    c.slice = 0;
    run(&c, &fusion, 3000u, 3300u); /* a stride comes, and nobody works it in */
    ck_assert(fusion.working);
    uint32_t count = fix_count;
    ck_assert_int_eq(insole_foot_fusion_finish(&fusion), INSOLE_OK);
    ck_assert_int_eq(insole_foot_lag_next(&waiting, &fusion, &fix), INSOLE_ERR_STATE);
    c.slice = WHOLE;
    finish(&c, &fusion);
    ck_assert_uint_ge(fix_count, count + 400u);
}
END_TEST

START_TEST(bad_calls_change_nothing)
{
    insole_fix_t fix;
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.config.lag_s = 2;
    set_up(&c);
    run(&c, &fusion, 0u, 900u);
    insole_foot_late_t before = waiting, rowless = waiting;
    rowless.rows = NULL;
    ASSERT_UNCHANGED(fusion, insole_foot_lag_next(NULL, &fusion, &fix), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(fusion, insole_foot_lag_next(&rowless, &fusion, &fix), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(fusion, insole_foot_lag_next(&waiting, &fusion, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_lag_next(&waiting, NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_mem_eq(&waiting, &before, sizeof before);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_lag");
    suite_add(suite, "how late", a_late_fix_is_as_late_as_told);
    suite_add_loop(suite, "no lag", without_a_lag_nothing_waits, 2);
    suite_add(suite, "moved", a_late_fix_is_the_one_at_once_moved);
    suite_add(suite, "last", the_last_fixes_wait_for_the_work);
    suite_add(suite, "bad calls", bad_calls_change_nothing);
    return suite;
}
