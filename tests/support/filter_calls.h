/** @file filter_calls.h  What every table of a filter's calls must do with nothing, and too soon.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_FILTER_CALLS_H
#define INSOLE_TESTS_FILTER_CALLS_H

#include <check.h>
#include <string.h>

#include "insole/fuse/step_filter.h"
#include "insole/fuse/step_fusion.h"
#include "near.h"

/** A start five metres north-east of the origin, turned by a quarter. */
static inline insole_step_filter_begin_t filter_begin(void)
{
    insole_step_filter_begin_t begin = {.t_us = 1000000u,
                                        .spot = {INSOLE_R(5.0), INSOLE_R(5.0)},
                                        .cov_m2 = {INSOLE_R(4.0), INSOLE_R(1.0), INSOLE_R(3.0)},
                                        .offset_rad = INSOLE_R(1.57),
                                        .var_offset_rad2 = INSOLE_R(0.04)};
    return begin;
}

/** @param state  set up and not started; left so but for its counters */
static inline void check_filter_calls(const insole_step_filter_calls_t *calls, void *state)
{
    insole_step_filter_begin_t begin = filter_begin();
    insole_step_filter_answer_t answer, untouched;
    insole_pace_t pace = {INSOLE_R(0.7), 0, INSOLE_R(0.01), INSOLE_R(0.01)};
    insole_spot_fix_t fix = {1000000u, {1, 1}, {4, 0, 4}, {0, 0}};
    memset(&answer, 0x5a, sizeof answer);
    untouched = answer;
    ck_assert_int_eq(calls->answer(state, &answer), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&answer, &untouched, sizeof answer);
    ck_assert_int_eq(calls->step(state, 1000000u, &pace), INSOLE_ERR_STATE);
    ck_assert_int_eq(calls->fix(state, &fix), INSOLE_ERR_STATE);
    ck_assert_int_eq(calls->start(NULL, &begin), INSOLE_ERR_NULL);
    ck_assert_int_eq(calls->start(state, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(calls->step(NULL, 1u, &pace), INSOLE_ERR_NULL);
    ck_assert_int_eq(calls->step(state, 1u, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(calls->fix(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(calls->fix(state, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(calls->answer(NULL, &answer), INSOLE_ERR_NULL);
    ck_assert_int_eq(calls->answer(state, NULL), INSOLE_ERR_NULL);
    begin.spot.x_m = INSOLE_R(1.0e9);
    ck_assert_int_eq(calls->start(state, &begin), INSOLE_ERR_VALUE);
    ck_assert_int_eq(calls->answer(state, &answer), INSOLE_ERR_STATE);
}

/** A step through the table goes the way that its method says. */
static inline void check_filter_steps_by(const insole_step_filter_calls_t *calls,
                                         const insole_pace_t *pace, const insole_step_way_t *way)
{
    const double eps = 4.0 * (double)INSOLE_REAL_EPSILON;
    insole_step_fusion_t fusion;
    insole_step_filter_begin_t begin = {.cov_m2 = {1, 0, 1}};
    ck_assert_int_eq(insole_step_fusion_init(&fusion, &insole_step_fusion_defaults), INSOLE_OK);
    ck_assert_int_eq(calls->start(&fusion, &begin), INSOLE_OK);
    ck_assert_int_eq(calls->step(&fusion, 1u, pace), INSOLE_OK);
    ASSERT_NEAR(fusion.spot.x_m, way->mean.x_m, eps, "m");
    ASSERT_NEAR(fusion.spot.y_m, way->mean.y_m, eps, "m");
    ASSERT_NEAR(fusion.P.xx, 1.0 + (double)way->Q.xx, eps, "m^2");
    ASSERT_NEAR(fusion.P.xy, (double)way->Q.xy, eps, "m^2");
    ASSERT_NEAR(fusion.P.yy, 1.0 + (double)way->Q.yy, eps, "m^2");
}

#endif
