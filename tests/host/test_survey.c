/* SPDX-License-Identifier: MIT */
#include "survey.h"

#include <math.h>

#include "files.h"
#include "near.h"
#include "suite.h"

static failure_t failure;

static survey_t survey_by(const survey_rule_t *rule, const char *text)
{
    survey_t survey;
    memset(&survey, 0, sizeof survey);
    survey.rule = *rule;
    const char *path = scratch_file("survey.csv", text);
    ck_assert_msg(survey_add(&survey, path, &failure), "%s", failure.text);
    return survey;
}

static survey_t survey_of(const char *text)
{
    const survey_rule_t each_for_itself = {false, 0.0, 0.0, 0.0};
    return survey_by(&each_for_itself, text);
}

START_TEST(readings_lie_where_they_were_heard)
{
    survey_t survey = survey_of("truth,0,0,0\nrss,1,b,-50\nrss,1,a,-60,0.5\ntruth,10,10,20\n"
                                "rss,4,a,-70,3.5\nrss,10,a,-71\n");
    static const double at[][2] = {{1.0, 2.0}, {0.5, 1.0}, {0.5, 1.0}, {10.0, 20.0}};
    ck_assert_uint_eq(survey.reading_count, 4u);
    ck_assert_uint_eq(survey.scan_count, 3u);
    ck_assert_uint_eq(survey.scans[0].count, 2u); /* of one time, though not of one age */
    for (size_t i = 0; i < 4; i++) {
        ASSERT_NEAR(survey.readings[i].x_m, at[i][0], 1e-9, "m");
        ASSERT_NEAR(survey.readings[i].y_m, at[i][1], 1e-9, "m");
    }
    ck_assert_str_eq(survey.ids.names[survey.readings[0].id], "b");
    ck_assert_str_eq(survey.ids.names[survey.readings[1].id], "a");
    ASSERT_NEAR(survey.readings[1].dbm, -60.0, 0.0, "dBm");
    survey_free(&survey);
}
END_TEST

START_TEST(what_is_outside_the_truth_or_no_number_is_counted)
{
    survey_t survey = survey_of("rss,0.9,a,-50\ntruth,1,0,0\nrss,1.5,a,-50,0.6\nrss,2,a,nan\n"
                                "rss,2,b,-50\ntruth,3,1,1\nrss,3.1,a,-50\nrss,3.1,a,-50,0.2\n");
    ck_assert_uint_eq(survey.outside, 3u);
    ck_assert_uint_eq(survey.unheard, 1u);
    ck_assert_uint_eq(survey.reading_count, 2u);
    survey_free(&survey);
}
END_TEST

START_TEST(a_walker_looks_where_they_go_and_nowhere_when_they_stand)
{
    survey_t survey = survey_of("truth,0,0,0\ntruth,10,0,10\ntruth,20,0,10\nrss,0.5,a,-50\n"
                                "rss,5,a,-50\nrss,15,a,-50\nrss,19.5,a,-50\n");
    static const double heading[][2] = {{0, 0}, {0, 1}, {0, 0}, {0, 0}};
    for (size_t i = 0; i < 4; i++) {
        ASSERT_NEAR(survey.readings[i].cos_heading, heading[i][0], 1e-9, "");
        ASSERT_NEAR(survey.readings[i].sin_heading, heading[i][1], 1e-9, "");
    }
    survey_free(&survey);
}
END_TEST

START_TEST(a_whole_scan_lies_where_its_youngest_reading_was_heard)
{
    const survey_rule_t rule = {true, 3.5, 0.0, 0.0};
    survey_t survey =
        survey_by(&rule, "truth,0,0,0\ntruth,10,10,0\nrss,6,a,-50,2\nrss,6,b,-51,1.5\n"
                         "rss,6,c,-52,5\nrss,6,d,-53,5.01\nrss,9,a,-54\n");
    ck_assert_uint_eq(survey.scan_count, 2u);
    ck_assert_uint_eq(survey.reading_count, 4u);
    ck_assert_uint_eq(survey.scans[0].count, 3u);
    ck_assert_uint_eq(survey.stale, 1u);
    for (size_t i = 0; i < 4; i++) {
        ASSERT_NEAR(survey.readings[i].x_m, i < 3 ? 4.5 : 9.0, 1e-9, "m");
    }
    survey_free(&survey);
}
END_TEST

/* Heard at 3 and told at 4: 0.4 s late it lies at 3.4, 2 s late at its arrival. */
START_TEST(late_radios_lie_later_but_not_after_their_arrival)
{
    static const struct {
        double late_s, x_m[2];
    } cases[] = {{0.0, {3.0, 3.5}}, {0.4, {3.4, 3.9}}, {0.8, {3.8, 4.0}}, {2.0, {4.0, 4.0}}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const survey_rule_t rule = {false, 0.0, cases[i].late_s, 0.0};
        survey_t survey =
            survey_by(&rule, "truth,0,0,0\ntruth,10,10,0\nrss,4,a,-50,1\nrss,4,b,-50,0.5\n");
        ASSERT_NEAR(survey.readings[0].x_m, cases[i].x_m[0], 1e-9, "m");
        ASSERT_NEAR(survey.readings[1].x_m, cases[i].x_m[1], 1e-9, "m");
        survey_free(&survey);
    }
}
END_TEST

START_TEST(what_is_heard_lies_ahead_of_who_walks_and_at_who_stands)
{
    const survey_rule_t rule = {true, 0.0, 0.0, 1.5};
    survey_t survey = survey_by(&rule, "truth,0,0,0\ntruth,10,0,10\ntruth,20,0,10\n"
                                       "rss,5,a,-50\nrss,15,a,-50\n");
    ASSERT_NEAR(survey.readings[0].x_m, 0.0, 1e-9, "m");
    ASSERT_NEAR(survey.readings[0].y_m, 6.5, 1e-9, "m");
    ASSERT_NEAR(survey.readings[1].y_m, 10.0, 1e-9, "m");
    survey_free(&survey);
}
END_TEST

START_TEST(sessions_stand_for_themselves)
{
    survey_t survey = survey_of("truth,0,0,0\ntruth,10,10,0\nrss,5,a,-50\nrss,5,b,-51\n");
    const char *other =
        scratch_file("other.csv", "truth,0,50,0\ntruth,10,60,0\nrss,5,c,-52\nrss,5,b,-53\n");
    ck_assert(survey_add(&survey, other, &failure));
    ck_assert_uint_eq(survey.sessions, 2u);
    ck_assert_uint_eq(survey.scan_count, 2u);
    ck_assert_uint_eq(survey.scans[1].session, 1u);
    ck_assert_uint_eq(survey.ids.count, 3u);
    for (size_t i = 0; i < 4; i++) {
        ASSERT_NEAR(survey.readings[i].x_m, i < 2 ? 5.0 : 55.0, 1e-9, "m");
    }
    /* One name is one number in all sessions. */
    uint32_t b = survey.readings[1].id;
    ck_assert(survey.readings[2].id == b || survey.readings[3].id == b);
    survey_free(&survey);
}
END_TEST

START_TEST(truth_may_come_in_any_order)
{
    survey_t survey = survey_of("truth,10,10,0\nrss,5,a,-50\ntruth,0,0,0\n");
    ASSERT_NEAR(survey.readings[0].x_m, 5.0, 1e-9, "m");
    survey_free(&survey);
}
END_TEST

static const struct {
    const char *text, *says;
} refusals[] = {
    {"rss,1,a,-50\n", "/refused.csv: no truth: a survey tells where it was made"},
    {"truth,1,0,0\ntruth,2,0,0\n", "/refused.csv: no signal strengths: expected rss records"},
    {"truth,1,0,0\nrss,1,a\n", "/refused.csv:2: "},
};

START_TEST(what_is_no_survey_is_refused)
{
    survey_t survey;
    memset(&survey, 0, sizeof survey);
    ck_assert(!survey_add(&survey, scratch_file("refused.csv", refusals[_i].text), &failure));
    ck_assert_msg(strstr(failure.text, refusals[_i].says) != NULL, "%s", failure.text);
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_uint_eq(survey.sessions, 0u);
    survey_free(&survey);
}
END_TEST

START_TEST(a_missing_file_is_told)
{
    survey_t survey;
    memset(&survey, 0, sizeof survey);
    ck_assert(!survey_add(&survey, SCRATCH "/absent.csv", &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "absent.csv: cannot open"));
    survey_free(&survey);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("host/survey");
    suite_add(suite, "places", readings_lie_where_they_were_heard);
    suite_add(suite, "places", what_is_outside_the_truth_or_no_number_is_counted);
    suite_add(suite, "places", a_walker_looks_where_they_go_and_nowhere_when_they_stand);
    suite_add(suite, "places", truth_may_come_in_any_order);
    suite_add(suite, "whole scans", a_whole_scan_lies_where_its_youngest_reading_was_heard);
    suite_add(suite, "late", late_radios_lie_later_but_not_after_their_arrival);
    suite_add(suite, "ahead", what_is_heard_lies_ahead_of_who_walks_and_at_who_stands);
    suite_add(suite, "sessions", sessions_stand_for_themselves);
    suite_add_loop(suite, "refusals", what_is_no_survey_is_refused,
                   (int)(sizeof refusals / sizeof refusals[0]));
    suite_add(suite, "refusals", a_missing_file_is_told);
    return suite;
}
