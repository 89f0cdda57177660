/* SPDX-License-Identifier: MIT */
#include "summary_states.h"

#include "files.h"
#include "suite.h"

static replay_facts_t facts;

static void make_facts(unsigned long align, unsigned long search, unsigned long track,
                       unsigned long coast, unsigned long lost)
{
    memset(&facts, 0, sizeof facts);
    facts.states[INSOLE_FIX_ALIGN] = align;
    facts.states[INSOLE_FIX_SEARCH] = search;
    facts.states[INSOLE_FIX_TRACK] = track;
    facts.states[INSOLE_FIX_COAST] = coast;
    facts.states[INSOLE_FIX_LOST] = lost;
    facts.fixes = align + search + track + coast + lost;
}

static const char *printed(void)
{
    FILE *file = tmpfile();
    ck_assert_ptr_nonnull(file);
    summary_states_print(file, &facts);
    return text_of(file);
}

static const char *as_json(void)
{
    json_t json;
    FILE *file = tmpfile();
    ck_assert_ptr_nonnull(file);
    json_begin(&json, file);
    json_object(&json, NULL);
    summary_states_json(&json, &facts);
    json_end(&json);
    return text_of(file);
}

START_TEST(people_read_shares_of_the_states_that_were)
{
    make_facts(1u, 2u, 1987u, 6u, 4u);
    ck_assert_str_eq(printed(), "  states         align 0.1 %, search 0.1 %, track 99.4 %, "
                                "coast 0.3 %, lost 0.2 %\n");
    make_facts(0u, 0u, 7u, 0u, 0u);
    ck_assert_str_eq(printed(), "  states         track 100.0 %\n");
    make_facts(0u, 1u, 0u, 0u, 2u);
    ck_assert_str_eq(printed(), "  states         search 33.3 %, lost 66.7 %\n");
}
END_TEST

START_TEST(programs_read_every_state)
{
    make_facts(1u, 2u, 1987u, 6u, 4u);
    ck_assert_str_eq(as_json(), "{\n"
                                "  \"states\": {\n"
                                "    \"align\": 0.0005,\n"
                                "    \"search\": 0.0010,\n"
                                "    \"track\": 0.9935,\n"
                                "    \"coast\": 0.0030,\n"
                                "    \"lost\": 0.0020\n"
                                "  }\n"
                                "}\n");
}
END_TEST

/* Nothing is divided by nothing. */
START_TEST(without_fixes_there_are_no_shares)
{
    make_facts(0u, 0u, 0u, 0u, 0u);
    ck_assert_ptr_null(strchr(printed(), '%'));
    const char *text = as_json();
    ck_assert_ptr_nonnull(strstr(text, "\"states\": {"));
    ck_assert_ptr_null(strstr(text, "track"));
    ck_assert_ptr_null(strstr(text, "nan"));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("summary_states");
    suite_add(suite, "text", people_read_shares_of_the_states_that_were);
    suite_add(suite, "json", programs_read_every_state);
    suite_add(suite, "nothing", without_fixes_there_are_no_shares);
    return suite;
}
