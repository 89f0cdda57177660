/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_filter.h"

#include "filter_calls.h"
#include "insole/fuse/ml_shift.h"
#include "insole/fuse/step_ekf.h"
#include "insole/fuse/step_fusion.h"
#include "insole/fuse/step_ukf.h"
#include "insole/fuse/walker_filter.h"
#include "near.h"
#include "suite.h"

/* Room for the state of any filter. */
typedef union {
    insole_step_fusion_t fusion;
    insole_ml_shift_t shift;
    insole_walker_ekf_t walker;
} any_t;

static const insole_step_filter_calls_t *const CALLS[] = {
    &insole_step_kf_calls, &insole_step_ekf_calls, &insole_step_ukf_calls, &insole_ml_shift_calls,
    &insole_walker_filter_calls};

static any_t state;

static void set_up(int row)
{
    insole_status_t status =
        row == 3   ? insole_ml_shift_init(&state.shift, &insole_ml_shift_defaults)
        : row == 4 ? insole_walker_ekf_init(&state.walker, &insole_walker_ekf_defaults)
                   : insole_step_fusion_init(&state.fusion, &insole_step_fusion_defaults);
    ck_assert_int_eq(status, INSOLE_OK);
}

START_TEST(every_table_refuses_nothing_and_what_comes_too_soon)
{
    set_up(_i);
    check_filter_calls(CALLS[_i], &state);
}
END_TEST

/* Right after the start it answers the start; a step goes on from there, turned by the offset. */
START_TEST(every_filter_starts_and_steps_alike)
{
    insole_step_filter_begin_t begin = filter_begin();
    insole_step_filter_t filter = {CALLS[_i], &state};
    insole_step_filter_answer_t answer;
    insole_pace_t pace = {INSOLE_R(0.7), INSOLE_R(0.5), INSOLE_R(0.01), INSOLE_R(0.01)};
    set_up(_i);
    ck_assert_int_eq(filter.calls->start(filter.state, &begin), INSOLE_OK);
    ck_assert_int_eq(filter.calls->answer(filter.state, &answer), INSOLE_OK);
    ASSERT_NEAR(answer.spot.x_m, 5.0, 1e-5, "m");
    ASSERT_NEAR(answer.spot.y_m, 5.0, 1e-5, "m");
    ASSERT_NEAR(answer.offset_rad, 1.57, 1e-5, "rad");
    ASSERT_NEAR(answer.scale, 1.0, 1e-5, "");
    ASSERT_AT_LEAST(answer.cov_m2.xx, 3.99, "m^2");
    ck_assert_int_eq(filter.calls->step(filter.state, 2000000u, &pace), INSOLE_OK);
    ck_assert_int_eq(filter.calls->answer(filter.state, &answer), INSOLE_OK);
    ASSERT_NEAR(answer.spot.x_m, 5.0 + 0.7 * cos(2.07), 0.02, "m");
    ASSERT_NEAR(answer.spot.y_m, 5.0 + 0.7 * sin(2.07), 0.02, "m");
    ASSERT_AT_LEAST(answer.cov_m2.xx, 4.0, "m^2");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("step_filter");
    suite_add_loop(suite, "refusals", every_table_refuses_nothing_and_what_comes_too_soon, 5);
    suite_add_loop(suite, "start and step", every_filter_starts_and_steps_alike, 5);
    return suite;
}
