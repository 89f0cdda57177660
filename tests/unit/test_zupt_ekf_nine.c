/* SPDX-License-Identifier: MIT
 * The filter that is compiled for nine states, against the one that is set to nine. */
#include "near.h"
#include "nine_walk.h"
#include "suite.h"

static nine_walk_t set_to_nine, made_of_nine;

START_TEST(same_bits_as_twelve_without_a_bias)
{
    int accepted = 0;
    nine_walk_through(&set_to_nine);
    nine_filter_walk(&made_of_nine);
    for (int call = 0; call < NINE_CALLS; call++) {
        ck_assert_int_eq(made_of_nine.status[call], set_to_nine.status[call]);
        accepted += set_to_nine.status[call] == INSOLE_OK;
        for (int i = 0; i < NINE_REALS; i++) {
            ck_assert_msg(memcmp(&made_of_nine.state[call][i], &set_to_nine.state[call][i],
                                 sizeof(insole_real_t)) == 0,
                          "call %d, number %d: %g, not %g", call, i,
                          (double)made_of_nine.state[call][i], (double)set_to_nine.state[call][i]);
        }
    }
    ck_assert_int_eq(accepted, NINE_CALLS - 1); /* one correction comes before any sample */
}
END_TEST

START_TEST(walk_goes_somewhere)
{
    nine_walk_through(&set_to_nine);
    const insole_real_t *after_stance = set_to_nine.state[NINE_CALLS - 25];
    for (int i = 0; i < NINE_REALS; i++) {
        ck_assert(insole_is_finite(after_stance[i]) && after_stance[i] != INSOLE_R(0.0));
    }
}
END_TEST

START_TEST(takes_no_bias)
{
    nine_facts_t facts = nine_filter_facts();
    ck_assert(facts.sigma_accel_bias_mps2 == INSOLE_R(0.0));
    ck_assert_int_eq(facts.by_default, INSOLE_OK);
    ck_assert_int_eq(facts.with_a_bias, INSOLE_ERR_VALUE);
    ck_assert(facts.is_unchanged);
}
END_TEST

START_TEST(keeps_no_bias)
{
    enum { BLOCKS = 3 * 9 + 6, BIAS = 3 };
    nine_facts_t facts = nine_filter_facts();
    ck_assert_uint_le(facts.state_bytes + (BLOCKS + BIAS) * facts.real_bytes,
                      sizeof(insole_zupt_ekf_t));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zupt_ekf of nine states");
    suite_add(suite, "same bits as twelve without a bias", same_bits_as_twelve_without_a_bias);
    suite_add(suite, "the walk goes somewhere", walk_goes_somewhere);
    suite_add(suite, "takes no bias", takes_no_bias);
    suite_add(suite, "keeps no bias", keeps_no_bias);
    return suite;
}
