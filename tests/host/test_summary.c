/* SPDX-License-Identifier: MIT */
#include "summary.h"

#include <math.h>

#include "files.h"
#include "near.h"
#include "notes.h"
#include "suite.h"

static replay_facts_t facts;
static notes_t notes;

/* Facts of a walk about which there is nothing to say. */
static void make_good_facts(void)
{
    memset(&facts, 0, sizeof facts);
    facts.method = METHOD_INS;
    facts.seen[RECORD_IMU] = 2001u;
    facts.seen[RECORD_START] = 1u;
    facts.readings = 2001u;
    facts.first_us = -1000000;
    facts.last_us = 9000000;
    facts.fixes = 2001u;
    facts.strides = 7u;
    facts.walked_m = 9.125;
    facts.fastest_radps = 6.0;
    facts.knows_place = true;
    facts.knows_heading = true;
    facts.gravity_mps2 = 9.81;
    facts.rests = 4u;
    facts.foot.fixes = 2000u;
    facts.foot.still = 500u;
    facts.foot.stances = 8u;
    facts.last.t_us = 9000000;
    facts.last.x_m = 1.5;
    facts.last.y_m = -2.25;
    facts.last.z_m = 0.0625;
    facts.last.var_x_m2 = 0.09;
    facts.last.var_y_m2 = 0.16;
    facts.last.state = INSOLE_FIX_TRACK;
}

START_TEST(a_good_walk_needs_no_notes)
{
    make_good_facts();
    notes_take(&notes, &facts);
    ck_assert_msg(notes.count == 0, "%s", notes.text[0]);
    ASSERT_NEAR(notes_rate_hz(&facts), 200.0, 1e-9, "Hz");
    ASSERT_NEAR(notes_still_share(&facts), 0.25, 1e-12, "");
}
END_TEST

/* One thing that is wrong, and the words that must be said about it. */
static void spoil(int what)
{
    make_good_facts();
    switch (what) {
    case 0:
        facts.foot.stances = 0u;
        break;
    case 1:
        facts.foot.aligned_moving = true;
        break;
    case 2:
        facts.strides = 0u;
        break;
    case 3:
        facts.readings = 501u;
        break;
    case 4:
        facts.screen.gaps = 3u;
        break;
    case 5:
        facts.screen.clipped = 12u;
        break;
    case 6:
        facts.fastest_radps = 0.1;
        break;
    case 7:
        facts.gravity_mps2 = 9.88;
        break;
    case 8:
        facts.knows_place = false;
        break;
    default:
        facts.knows_heading = false;
        break;
    }
}

static const char *const words[] = {"is the sensor on the shoe",
                                    "does not begin at rest",
                                    "did anybody walk?",
                                    "50 readings per second",
                                    "3 gaps",
                                    "cut off in 12 readings",
                                    "is its unit right",
                                    "the accelerometer reads 9.880",
                                    "no start is known",
                                    "the start tells no heading"};

START_TEST(what_is_wrong_is_told)
{
    spoil(_i);
    notes_take(&notes, &facts);
    ck_assert_int_eq(notes.count, 1);
    ck_assert_msg(strstr(notes.text[0], words[_i]) != NULL, "%s", notes.text[0]);
}
END_TEST

START_TEST(a_log_of_nothing_is_described)
{
    memset(&facts, 0, sizeof facts);
    ASSERT_NEAR(notes_rate_hz(&facts), 0.0, 0.0, "Hz");
    ASSERT_NEAR(notes_still_share(&facts), 0.0, 0.0, "");
    notes_take(&notes, &facts);
    ck_assert_int_ge(notes.count, 1);
}
END_TEST

START_TEST(the_summary_for_people)
{
    const summary_t summary = {"foot", "ins", &facts, NULL, NULL};
    make_good_facts();
    facts.screen.repeated = 2u;
    facts.screen.spikes = 3u;
    facts.screen.averaged = 40u;
    facts.screen.evened = 5u;
    FILE *file = tmpfile();
    summary_print(file, &summary);
    ck_assert_str_eq(
        text_of(file),
        "foot tracker, method ins\n"
        "  duration       10.0 s, 2001 readings at 200.0 Hz\n"
        "  distance       9.13 m in 7 strides\n"
        "  foot still     25.0 % of the time, in 8 stances\n"
        "  final position 1.500, -2.250, height 0.063 m, 1-sigma 0.500 m, state track\n"
        "  refused        2 repeated stamps\n"
        "  repaired       3 spikes, 5 stamps of bursts evened out, 40 averaged\n"
        "  the log lacks  mag, rss, range\n");
    for (int kind = 0; kind < RECORD_KINDS; kind++) {
        facts.seen[kind] = 1u;
    }
    memset(&facts.screen, 0, sizeof facts.screen);
    file = tmpfile();
    summary_print(file, &summary);
    const char *text = text_of(file);
    ck_assert_ptr_nonnull(strstr(text, "  refused        none\n  repaired       none\n"));
    ck_assert_ptr_nonnull(strstr(text, "  the log lacks  nothing\n"));
}
END_TEST

START_TEST(the_summary_for_programs)
{
    score_t score;
    const summary_t summary = {"foot", "ins", &facts, &score, NULL};
    make_good_facts();
    memset(&score, 0, sizeof score);
    facts.screen.gaps = 2u;
    score.rms_m = 0.125;
    FILE *file = tmpfile();
    summary_json(file, &summary);
    const char *text = text_of(file);
    static const char *const expected[] = {"\"tracker\": \"foot\",",
                                           "\"method\": \"ins\",",
                                           "\"duration_s\": 10.000000,",
                                           "\"readings\": 2001,",
                                           "\"rate_hz\": 200.000,",
                                           "\"distance_m\": 9.1250,",
                                           "\"strides\": 7,",
                                           "\"stances\": 8,",
                                           "\"still_share\": 0.2500,",
                                           "\"t_s\": 9.000000,",
                                           "\"x_m\": 1.5000,",
                                           "\"sigma_m\": 0.5000,",
                                           "\"state\": \"track\"",
                                           "\"gaps\": 2",
                                           "\"mag\",",
                                           "\"range\"\n",
                                           "\"notes\": [\n",
                                           "\"rms_m\": 0.1250,"};
    for (size_t i = 0u; i < sizeof expected / sizeof expected[0]; i++) {
        ck_assert_msg(strstr(text, expected[i]) != NULL, "no %s in:\n%s", expected[i], text);
    }
}
END_TEST

/* ---- second order ----------------------------------------------------------------------- */

static site_t site;

static void make_good_fusion(void)
{
    make_good_facts();
    facts.method = METHOD_BEST;
    facts.states[INSOLE_FIX_SEARCH] = 1u;
    facts.states[INSOLE_FIX_TRACK] = 2000u;
    facts.fusion.is_fused = true;
    facts.fusion.walls = 12u;
    facts.fusion.aps = 16u;
    facts.fusion.ids = 9u;
    facts.fusion.unknown_ids = 2u;
    facts.fusion.radio.scans = 30u;
    facts.fusion.radio.ranges = 4u;
    facts.fusion.radio.worked_in = 28u;
    facts.fusion.waits.unused = 3u;
    facts.fusion.waits.unknown = 1u;
    facts.fusion.starts = 1u;
    facts.fusion.particles.strides = 100u;
    facts.fusion.particles.resampled = 5u;
    facts.fusion.particles.redrawn = 6u;
    facts.fusion.particles.recovered = 7u;
    facts.fusion.has_offset = true;
    facts.fusion.offset_db = -3.25;
    site.plan_file.name = "some/plan.csv";
    site.ap_file.name = "aps.csv";
}

START_TEST(what_building_and_radio_did_is_told)
{
    const summary_t summary = {"foot", "best", &facts, NULL, &site};
    make_good_fusion();
    FILE *file = tmpfile();
    summary_print(file, &summary);
    const char *text = text_of(file);
    static const char *const expected[] = {
        "  building       plan.csv (12 walls), aps.csv (16 access points)\n",
        "  radio          30 scans, 4 ranges; worked in 28 times; 3 came too soon after another; "
        "1 of no use; 2 of 9 ids unknown\n",
        "  cloud          drawn 1 times, resampled 5, moved in part to where scans point 6, lost "
        "and found 7\n",
        "  receiver       hears 3.3 dB less than expected\n",
        "  states         search 0.0 %, track 100.0 %\n"};
    for (size_t i = 0u; i < sizeof expected / sizeof expected[0]; i++) {
        ck_assert_msg(strstr(text, expected[i]) != NULL, "no %s in:\n%s", expected[i], text);
    }
    ck_assert_ptr_null(strstr(text, "note: "));
}
END_TEST

START_TEST(programs_are_told_of_building_and_radio)
{
    const summary_t summary = {"foot", "best", &facts, NULL, &site};
    make_good_fusion();
    FILE *file = tmpfile();
    summary_json(file, &summary);
    const char *text = text_of(file);
    static const char *const expected[] = {"\"plan\": \"some/plan.csv\",",
                                           "\"walls\": 12,",
                                           "\"access_points\": 16\n",
                                           "\"scans\": 30,",
                                           "\"worked_in\": 28,",
                                           "\"too_soon\": 3,",
                                           "\"of_no_use\": 1,",
                                           "\"unknown_ids\": 2\n",
                                           "\"drawn\": 1,",
                                           "\"resampled\": 5,",
                                           "\"redrawn\": 6,",
                                           "\"recovered\": 7,",
                                           "\"receiver_offset_db\": -3.250\n",
                                           "\"search\": 0.0005,"};
    for (size_t i = 0u; i < sizeof expected / sizeof expected[0]; i++) {
        ck_assert_msg(strstr(text, expected[i]) != NULL, "no %s in:\n%s", expected[i], text);
    }
}
END_TEST

START_TEST(nothing_known_of_the_building_is_said)
{
    const summary_t summary = {"foot", "best", &facts, NULL, NULL};
    make_good_facts();
    facts.method = METHOD_BEST;
    FILE *file = tmpfile();
    summary_print(file, &summary);
    const char *text = text_of(file);
    ck_assert_ptr_nonnull(strstr(text, "  building       nothing known (--plan, --aps)\n"));
    ck_assert_ptr_null(strstr(text, "  radio "));
    ck_assert_ptr_null(strstr(text, "  cloud "));
}
END_TEST

/* Of radio alone nobody looked at the foot. */
START_TEST(radio_alone_tells_no_strides)
{
    const summary_t summary = {"foot", "wifi", &facts, NULL, &site};
    make_good_fusion();
    facts.method = METHOD_WIFI;
    facts.foot.stances = 0u;
    FILE *file = tmpfile();
    summary_print(file, &summary);
    const char *text = text_of(file);
    ck_assert_ptr_null(strstr(text, "strides"));
    ck_assert_ptr_null(strstr(text, "note: "));
    ck_assert_ptr_null(strstr(text, "  cloud "));
    ck_assert_ptr_nonnull(strstr(text, "  radio          30 scans"));
}
END_TEST

static void spoil_fusion(int what)
{
    make_good_fusion();
    switch (what) {
    case 0:
        facts.fusion.aps = 0u;
        break;
    case 1:
        facts.fusion.unknown_ids = 9u;
        break;
    case 2:
        facts.fusion.radio.wild = 4u;
        break;
    case 3:
        facts.fusion.particles.recovered = 11u;
        break;
    case 4:
        facts.fusion.starts_outside = true;
        facts.fusion.start_distance_m = 3.25;
        break;
    case 5:
        facts.fusion.starts_outside = true;
        facts.fusion.start_distance_m = REPLAY_FAR_M;
        break;
    default:
        facts.fusion.outside = facts.fixes / 4u;
        break;
    }
}

static const char *const fusion_words[] = {"the log hears 9 access points",
                                           "are the ids the same?",
                                           "radio was left out 4 times",
                                           "went astray 11 times",
                                           "outside the plan, 3.3 m from",
                                           "outside the plan, more than 1000.0 m from",
                                           "25 % of the track lie outside the plan"};

START_TEST(what_is_wrong_with_building_and_radio_is_told)
{
    spoil_fusion(_i);
    notes_take(&notes, &facts);
    ck_assert_int_eq(notes.count, 1);
    ck_assert_msg(strstr(notes.text[0], fusion_words[_i]) != NULL, "%s", notes.text[0]);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("summary");
    suite_add(suite, "good", a_good_walk_needs_no_notes);
    suite_add_loop(suite, "notes", what_is_wrong_is_told, (int)(sizeof words / sizeof words[0]));
    suite_add(suite, "nothing", a_log_of_nothing_is_described);
    suite_add(suite, "text", the_summary_for_people);
    suite_add(suite, "json", the_summary_for_programs);
    suite_add(suite, "fusion", what_building_and_radio_did_is_told);
    suite_add(suite, "fusion json", programs_are_told_of_building_and_radio);
    suite_add(suite, "no building", nothing_known_of_the_building_is_said);
    suite_add(suite, "wifi", radio_alone_tells_no_strides);
    suite_add_loop(suite, "fusion notes", what_is_wrong_with_building_and_radio_is_told,
                   (int)(sizeof fusion_words / sizeof fusion_words[0]));
    return suite;
}
