/* SPDX-License-Identifier: MIT */
#include "insole/fuse/walker_filter.h"

#include "filter_calls.h"
#include "near.h"
#include "plane.h"
#include "suite.h"
#include "walker.h"

static insole_rng_t rng;

/* Bit for bit what the calls themselves do with the same news. */
START_TEST(the_table_is_the_calls_it_names)
{
    const insole_step_filter_calls_t *calls = &insole_walker_filter_calls;
    insole_step_filter_begin_t at = filter_begin();
    at.from_radio = _i == 1;
    insole_walker_start_t start = {
        at.t_us, at.spot, at.cov_m2, at.offset_rad, at.var_offset_rad2, at.from_radio};
    insole_step_filter_answer_t named_answer;
    insole_walker_ekf_t direct = walker_begun(&insole_walker_ekf_defaults, &start), named = direct;
    ck_assert_int_eq(calls->start(&named, &at), INSOLE_OK);
    insole_rng_seed(&rng, 60u);
    for (uint32_t i = 1u; i < 100u; i++) {
        insole_real_t east = INSOLE_R(0.02) * (insole_real_t)i;
        insole_pace_t pace = {INSOLE_R(0.7), east, INSOLE_R(0.01), INSOLE_R(0.01)};
        insole_spot_fix_t fix = {1000000u + i, sample_spot(&rng, 9), {3, 0, 3}, {0, 0}};
        ck_assert_int_eq(insole_walker_ekf_bias(&direct, INSOLE_R(0.1) * east), INSOLE_OK);
        ck_assert_int_eq(calls->bias(&named, INSOLE_R(0.1) * east), INSOLE_OK);
        ck_assert_int_eq(insole_walker_ekf_step(&direct, &pace), INSOLE_OK);
        ck_assert_int_eq(calls->step(&named, i, &pace), INSOLE_OK);
        ck_assert_int_eq(insole_walker_ekf_fix(&direct, &fix), INSOLE_OK);
        ck_assert_int_eq(calls->fix(&named, &fix), INSOLE_OK);
        ck_assert_int_eq(insole_walker_ekf_compass(&direct, east, INSOLE_R(0.8)), INSOLE_OK);
        ck_assert_int_eq(calls->compass(&named, east, INSOLE_R(0.8)), INSOLE_OK);
    }
    ck_assert_mem_eq(&direct, &named, sizeof direct);
    insole_walker_answer_t answer;
    ck_assert_int_eq(insole_walker_ekf_answer(&direct, &answer), INSOLE_OK);
    ck_assert_int_eq(calls->answer(&named, &named_answer), INSOLE_OK);
    ck_assert_mem_eq(&named_answer.spot, &answer.spot, sizeof answer.spot);
    ck_assert_mem_eq(&named_answer.cov_m2, &answer.cov_m2, sizeof answer.cov_m2);
    ck_assert(named_answer.offset_rad == answer.offset_rad && named_answer.scale == answer.scale);
    ck_assert(named_answer.var_offset_rad2 == answer.var_offset_rad2 && !calls->work);
}
END_TEST

START_TEST(the_table_refuses_what_the_calls_refuse)
{
    insole_walker_ekf_t walker;
    ck_assert_int_eq(insole_walker_ekf_init(&walker, &insole_walker_ekf_defaults), INSOLE_OK);
    check_filter_calls(&insole_walker_filter_calls, &walker);
    ck_assert_int_eq(insole_walker_filter_calls.compass(NULL, 0, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_walker_filter_calls.compass(&walker, 0, 1), INSOLE_ERR_STATE);
    ck_assert_uint_eq(walker.refused, 4u);
    ck_assert_int_eq(insole_walker_filter_calls.bias(NULL, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_walker_filter_calls.bias(&walker, -1), INSOLE_ERR_VALUE);
    ck_assert_uint_eq(walker.refused, 5u);
}
END_TEST

/* What a start has in common with the next fixes is the filter's bias, and counts once; a filter
 * whose bias is less takes that much, one without a bias none. */
START_TEST(a_start_by_radio_has_its_covariance)
{
    static const double BIAS_M[] = {3.5, 2.0, 0.0};
    insole_walker_ekf_t walker;
    insole_walker_ekf_config_t config = insole_walker_ekf_defaults;
    config.bias_m = (insole_real_t)BIAS_M[_i];
    insole_step_filter_begin_t at = filter_begin();
    at.cov_m2 = insole_sym2(20, 2, 18);
    at.from_radio = true;
    at.shared_m2 = INSOLE_R(12.25);
    ck_assert_int_eq(insole_walker_ekf_init(&walker, &config), INSOLE_OK);
    ck_assert_int_eq(insole_walker_filter_calls.start(&walker, &at), INSOLE_OK);
    insole_step_filter_answer_t answer;
    ck_assert_int_eq(insole_walker_filter_calls.answer(&walker, &answer), INSOLE_OK);
    ASSERT_NEAR(answer.cov_m2.xx, 20.0, 1e-4, "m^2");
    ASSERT_NEAR(answer.cov_m2.xy, 2.0, 1e-4, "m^2");
    ASSERT_NEAR(answer.cov_m2.yy, 18.0, 1e-4, "m^2");
    at.from_radio = false; /* then nothing is shared */
    ck_assert_int_eq(insole_walker_filter_calls.start(&walker, &at), INSOLE_OK);
    ck_assert_int_eq(insole_walker_filter_calls.answer(&walker, &answer), INSOLE_OK);
    ASSERT_NEAR(answer.cov_m2.xx, 20.0, 1e-4, "m^2");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("walker_filter");
    suite_add_loop(suite, "table", the_table_is_the_calls_it_names, 2);
    suite_add(suite, "refuses", the_table_refuses_what_the_calls_refuse);
    suite_add_loop(suite, "covariance", a_start_by_radio_has_its_covariance, 3);
    return suite;
}
