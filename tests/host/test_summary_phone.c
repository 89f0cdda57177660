/* SPDX-License-Identifier: MIT */
#include "summary_phone.h"

#include "files.h"
#include "near.h"
#include "notes.h"
#include "suite.h"

static replay_facts_t facts;
static site_t site;
static notes_t notes;

/* A walk of two minutes with radio and compass about which there is nothing to say. */
static void make_good_facts(method_t method)
{
    memset(&facts, 0, sizeof facts);
    memset(&site, 0, sizeof site);
    facts.method = method;
    facts.seen[RECORD_IMU] = facts.readings = 12001u;
    facts.last_us = 120000000;
    facts.fixes = 12001u;
    facts.states[INSOLE_FIX_SEARCH] = 1u;
    facts.states[INSOLE_FIX_TRACK] = 12000u;
    facts.strides = 200u;
    facts.walked_m = 140.25;
    facts.knows_place = facts.knows_heading = true;
    facts.gravity_mps2 = 9.81;
    facts.last.x_m = 1.5;
    facts.last.y_m = -2.25;
    facts.last.var_x_m2 = 0.09;
    facts.last.var_y_m2 = 0.16;
    facts.last.state = INSOLE_FIX_TRACK;
    facts.phone.points = 120u;
    facts.phone.aps = 34u;
    facts.phone.magnetic = 6000u;
    facts.phone.starts = 1u;
    facts.fusion.radio.scans = 40u;
    facts.fusion.radio.worked_in = 38u;
    facts.fusion.ids = 33u;
    site.radiomap_file.name = "some/radiomap.csv";
}

static summary_t summary_of(const char *method)
{
    const summary_t summary = {"phone", method, &facts, NULL, &site};
    return summary;
}

static const char *printed(const char *method)
{
    const summary_t summary = summary_of(method);
    FILE *file = tmpfile();
    ck_assert_ptr_nonnull(file);
    summary_phone_print(file, &summary);
    return text_of(file);
}

static const char *as_json(const char *method)
{
    const summary_t summary = summary_of(method);
    json_t json;
    FILE *file = tmpfile();
    ck_assert_ptr_nonnull(file);
    json_begin(&json, file);
    json_object(&json, NULL);
    summary_phone_json(&json, &summary);
    json_end(&json);
    return text_of(file);
}

static void expect_all(const char *text, const char *const *expected, size_t count)
{
    for (size_t i = 0u; i < count; i++) {
        ck_assert_msg(strstr(text, expected[i]) != NULL, "no %s in:\n%s", expected[i], text);
    }
}

START_TEST(people_read_of_map_radio_and_compass)
{
    make_good_facts(METHOD_PHONE_BEST);
    ck_assert_str_eq(printed("best"),
                     "  fingerprints   radiomap.csv (120 points, 34 access points)\n"
                     "  radio          40 scans; 38 gave a position\n"
                     "  compass        6000 readings\n"
                     "  states         search 0.0 %, track 100.0 %\n");
    facts.phone.unplaced = 2u;
    facts.fusion.unknown_ids = 5u;
    ck_assert_ptr_nonnull(strstr(printed("best"),
                                 "  radio          40 scans; 38 gave a position; 2 heard too "
                                 "little; 5 of 33 ids unknown\n"));
}
END_TEST

START_TEST(people_read_where_the_phone_was_carried)
{
    make_good_facts(METHOD_PHONE_BEST);
    ck_assert_ptr_null(strstr(printed("best"), "carried"));
    facts.phone.carried[INSOLE_CARRY_EAR] = 30u;
    facts.phone.carried[INSOLE_CARRY_SWING] = 90u;
    ck_assert_ptr_nonnull(
        strstr(printed("best"), "  carried        ear 25 %, swing 75 % of 120 steps\n"));
}
END_TEST

START_TEST(people_read_of_plan_and_particles)
{
    make_good_facts(METHOD_PHONE_BEST);
    facts.fusion.walls = 52u;
    facts.phone.particles = 500u;
    site.plan_file.name = "some/plan.csv";
    ck_assert_ptr_nonnull(strstr(printed("best"), "  building       plan.csv (52 walls)\n"
                                                  "  cloud          500 particles, drawn 1 times\n"
                                                  "  fingerprints   radiomap.csv"));
    const char *json = as_json("best");
    ck_assert_ptr_nonnull(strstr(json, "\"plan\": \"some/plan.csv\""));
    ck_assert_ptr_nonnull(strstr(json, "\"walls\": 52"));
    ck_assert_ptr_nonnull(strstr(json, "\"particles\": 500"));
}
END_TEST

/* Whoever uses radio is told that there is no map; whoever does not, is not. */
START_TEST(without_a_map_only_those_who_need_it_are_told)
{
    static const struct {
        method_t method;
        const char *name;
        bool needs;
    } CASES[] = {{METHOD_PHONE_BEST, "best", true},
                 {METHOD_EKF, "ekf", true},
                 {METHOD_WIFI_KDE, "wifi-kde", true},
                 {METHOD_PHONE_PDR, "pdr", false},
                 {METHOD_PDR_GYRO, "pdr-gyro", false}};
    for (size_t i = 0u; i < sizeof CASES / sizeof CASES[0]; i++) {
        make_good_facts(CASES[i].method);
        facts.phone.points = 0u;
        site.radiomap_file.name = NULL;
        const char *text = printed(CASES[i].name);
        bool told = strstr(text, "  fingerprints   none (--radiomap)\n") != NULL;
        ck_assert_msg(told == CASES[i].needs, "%s: %s", CASES[i].name, text);
        ck_assert_ptr_null(strstr(text, "  radio  "));
        ck_assert_ptr_nonnull(strstr(text, "  compass        6000 readings\n"));
        ck_assert_ptr_null(strstr(as_json(CASES[i].name), "\"radiomap\""));
    }
}
END_TEST

START_TEST(programs_read_all_of_it)
{
    make_good_facts(METHOD_PHONE_BEST);
    facts.phone.unplaced = 2u;
    facts.phone.gaps = 3u;
    facts.phone.carried[INSOLE_CARRY_HAND] = 90u;
    facts.phone.carried[INSOLE_CARRY_POCKET] = 30u;
    facts.fusion.unknown_ids = 5u;
    ck_assert_str_eq(as_json("best"), "{\n"
                                      "  \"states\": {\n"
                                      "    \"align\": 0.0000,\n"
                                      "    \"search\": 0.0001,\n"
                                      "    \"track\": 0.9999,\n"
                                      "    \"coast\": 0.0000,\n"
                                      "    \"lost\": 0.0000\n"
                                      "  },\n"
                                      "  \"phone\": {\n"
                                      "    \"radiomap\": \"some/radiomap.csv\",\n"
                                      "    \"walls\": 0,\n"
                                      "    \"particles\": 0,\n"
                                      "    \"points\": 120,\n"
                                      "    \"access_points\": 34,\n"
                                      "    \"scans\": 40,\n"
                                      "    \"placed\": 38,\n"
                                      "    \"unplaced\": 2,\n"
                                      "    \"ids\": 33,\n"
                                      "    \"unknown_ids\": 5,\n"
                                      "    \"magnetic\": 6000,\n"
                                      "    \"starts\": 1,\n"
                                      "    \"gaps\": 3,\n"
                                      "    \"carried\": {\n"
                                      "      \"hand\": 90,\n"
                                      "      \"ear\": 0,\n"
                                      "      \"swing\": 0,\n"
                                      "      \"pocket\": 30\n"
                                      "    }\n"
                                      "  }\n"
                                      "}\n");
}
END_TEST

/* ---- as a part of the whole --------------------------------------------------------------- */

START_TEST(the_whole_speaks_of_a_phone)
{
    make_good_facts(METHOD_PHONE_BEST);
    const summary_t summary = summary_of("best");
    FILE *file = tmpfile();
    summary_print(file, &summary);
    const char *text = text_of(file);
    ck_assert_str_eq(text, "phone tracker, method best\n"
                           "  duration       120.0 s, 12001 readings at 100.0 Hz\n"
                           "  distance       140.25 m in 200 steps\n"
                           "  fingerprints   radiomap.csv (120 points, 34 access points)\n"
                           "  radio          40 scans; 38 gave a position\n"
                           "  compass        6000 readings\n"
                           "  states         search 0.0 %, track 100.0 %\n"
                           "  final position 1.500, -2.250, height 0.000 m, 1-sigma 0.500 m, "
                           "state track\n"
                           "  refused        none\n"
                           "  repaired       none\n"
                           "  the log lacks  start, mag, rss, range\n");
}
END_TEST

START_TEST(a_program_reads_steps_and_no_stances)
{
    static const char *const expected[] = {"\"tracker\": \"phone\",", "\"steps\": 200,",
                                           "\"distance_m\": 140.2500,", "\"phone\": {",
                                           "\"placed\": 38,"};
    make_good_facts(METHOD_EKF);
    const summary_t summary = summary_of("ekf");
    FILE *file = tmpfile();
    summary_json(file, &summary);
    const char *text = text_of(file);
    expect_all(text, expected, sizeof expected / sizeof expected[0]);
    ck_assert_ptr_null(strstr(text, "\"stances\""));
    ck_assert_ptr_null(strstr(text, "\"strides\""));
    ck_assert_ptr_null(strstr(text, "still_share"));
}
END_TEST

/* Radio alone has looked at no step. */
START_TEST(radio_alone_tells_no_steps)
{
    make_good_facts(METHOD_WIFI_ML);
    facts.strides = 0u;
    const summary_t summary = summary_of("wifi-ml");
    FILE *file = tmpfile();
    summary_print(file, &summary);
    const char *text = text_of(file);
    ck_assert_ptr_null(strstr(text, "steps"));
    ck_assert_ptr_null(strstr(text, "note: "));
    ck_assert_ptr_nonnull(strstr(text, "  radio          40 scans"));
}
END_TEST

/* ---- notes -------------------------------------------------------------------------------- */

static void spoil(int what)
{
    make_good_facts(METHOD_PHONE_BEST);
    switch (what) {
    case 0:
        facts.strides = 0u;
        break;
    case 1:
        facts.phone.gaps = 1u;
        break;
    case 2:
        facts.phone.gaps = 3u;
        break;
    case 3:
        facts.knows_place = false;
        break;
    case 4:
        facts.knows_heading = false;
        facts.phone.magnetic = 0u;
        break;
    case 5:
        facts.phone.points = 0u;
        break;
    case 6:
        facts.fusion.unknown_ids = 33u;
        break;
    case 7:
        facts.fusion.radio.wild = 4u;
        break;
    default:
        facts.fusion.walls = 52u;
        facts.fusion.outside = 6000u;
        break;
    }
}

static const char *const words[] = {"no step was seen",
                                    "1 long gap, in which",
                                    "3 long gaps, in which",
                                    "the track begins at (0, 0)",
                                    "until the direction is known",
                                    "the log hears 33 access points",
                                    "is it of this building?",
                                    "radio was left out 4 times",
                                    "50 % of the track lie outside the plan"};

START_TEST(what_is_wrong_is_told)
{
    make_good_facts(METHOD_PHONE_BEST);
    notes_take(&notes, &facts);
    ck_assert_msg(notes.count == 0, "%s", notes.text[0]);
    spoil(_i);
    notes_take(&notes, &facts);
    ck_assert_int_eq(notes.count, 1);
    ck_assert_msg(strstr(notes.text[0], words[_i]) != NULL, "%s", notes.text[0]);
}
END_TEST

/* Nobody used the plan, or the track left it for a moment only. */
START_TEST(not_all_that_is_outside_is_told)
{
    make_good_facts(METHOD_EKF);
    facts.fusion.outside = facts.fixes;
    notes_take(&notes, &facts);
    ck_assert_int_eq(notes.count, 0);
    facts.fusion.walls = 52u;
    facts.fusion.outside = 1200u;
    notes_take(&notes, &facts);
    ck_assert_int_eq(notes.count, 0);
}
END_TEST

/* A compass or a start is enough for a direction. */
START_TEST(one_source_of_direction_is_enough)
{
    make_good_facts(METHOD_PHONE_BEST);
    facts.knows_heading = false;
    notes_take(&notes, &facts);
    ck_assert_int_eq(notes.count, 0);
    facts.knows_heading = true;
    facts.phone.magnetic = 0u;
    notes_take(&notes, &facts);
    ck_assert_int_eq(notes.count, 0);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("summary_phone");
    suite_add(suite, "carried", people_read_where_the_phone_was_carried);
    suite_add(suite, "text", people_read_of_map_radio_and_compass);
    suite_add(suite, "plan", people_read_of_plan_and_particles);
    suite_add(suite, "no map", without_a_map_only_those_who_need_it_are_told);
    suite_add(suite, "json", programs_read_all_of_it);
    suite_add(suite, "whole", the_whole_speaks_of_a_phone);
    suite_add(suite, "whole json", a_program_reads_steps_and_no_stances);
    suite_add(suite, "radio alone", radio_alone_tells_no_steps);
    suite_add_loop(suite, "notes", what_is_wrong_is_told, (int)(sizeof words / sizeof words[0]));
    suite_add(suite, "inside", not_all_that_is_outside_is_told);
    suite_add(suite, "direction", one_source_of_direction_is_enough);
    return suite;
}
