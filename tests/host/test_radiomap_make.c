/* SPDX-License-Identifier: MIT */
#include "radiomap_make.h"

#include <math.h>

#include "files.h"
#include "near.h"
#include "suite.h"

static failure_t failure;
static survey_t survey;
static radiomap_file_t file;
static unsigned long weird;

static const radiomap_options_t two_metres = {2.0, UINT32_MAX, false};

static void add_session(const char *text)
{
    static int number;
    char name[32];
    snprintf(name, sizeof name, "walk%d.csv", number++);
    ck_assert_msg(survey_add(&survey, scratch_file(name, text), &failure), "%s", failure.text);
}

static void make(const radiomap_options_t *options)
{
    bool is_good = radiomap_make(&file, &survey, options, &weird, &failure);
    ck_assert_msg(is_good, "%s", failure.text);
    ck_assert_int_eq(insole_radio_map_check(&file.map), INSOLE_OK);
}

static void finish(void)
{
    radiomap_file_free(&file);
    survey_free(&survey);
}

static bool find(uint32_t point, const char *name, uint32_t *entry)
{
    uint32_t ap;
    return id_table_find(&file.ids, name, &ap) &&
           insole_radio_map_find(&file.map, point, ap, entry);
}

/* Standing at two places, 10 m apart: means, spreads and counts by hand. */
START_TEST(points_know_what_was_heard_there)
{
    uint32_t entry;
    add_session("truth,0,1,1\ntruth,10,1,1\nrss,1,b,-60\nrss,1,a,-70\nrss,2,b,-64\nrss,3,b,-62\n");
    add_session("truth,0,11,1\ntruth,10,11,1\nrss,1,b,-80\nrss,1,c,-50\n");
    make(&two_metres);
    ck_assert_uint_eq(file.map.point_count, 2u);
    ck_assert_uint_eq(file.map.visits[0], 3u);
    ck_assert(file.map.spots[0].x_m == 1 && file.map.spots[1].x_m == 11);
    ck_assert(find(0, "b", &entry));
    ASSERT_NEAR((double)insole_radio_map_mean_dbm(&file.map, entry), -62.0, 0.0, "dBm");
    ASSERT_NEAR((double)insole_radio_map_std_db(&file.map, entry), sqrt(8.0 / 3.0), 1.0 / 16.0,
                "dB");
    ck_assert_uint_eq(insole_radio_map_heard(&file.map, entry), 3u);
    ck_assert(find(0, "a", &entry));
    ck_assert_uint_eq(insole_radio_map_heard(&file.map, entry), 1u);
    ck_assert(!find(0, "c", &entry));
    ck_assert(find(1, "c", &entry));
    ASSERT_NEAR((double)insole_radio_map_mean_dbm(&file.map, entry), -50.0, 0.0, "dBm");
    ck_assert_uint_eq(weird, 0u);
    finish();
}
END_TEST

START_TEST(access_points_are_numbered_by_their_names)
{
    add_session("truth,0,1,1\ntruth,10,1,1\nrss,1,delta,-60\nrss,1,alpha,-70\nrss,2,carol,-64\n");
    make(&two_metres);
    ck_assert_uint_eq(file.ids.count, 3u);
    ck_assert_str_eq(file.ids.names[0], "alpha");
    ck_assert_str_eq(file.ids.names[1], "carol");
    ck_assert_str_eq(file.ids.names[2], "delta");
    ck_assert_uint_eq(file.map.ap_count, 3u);
    finish();
}
END_TEST

START_TEST(the_strongest_are_kept_and_what_nobody_kept_is_forgotten)
{
    const radiomap_options_t one_each = {2.0, 1u, false};
    uint32_t entry;
    add_session("truth,0,1,1\ntruth,10,1,1\nrss,1,a,-60\nrss,1,b,-70\nrss,1,z,-50\n");
    add_session("truth,0,9,1\ntruth,10,9,1\nrss,1,a,-80\nrss,1,b,-50\n");
    make(&one_each);
    ck_assert_uint_eq(file.map.first[2], 2u);
    ck_assert_uint_eq(file.ids.count, 2u); /* nobody has kept a */
    ck_assert_uint_eq(file.map.ap_count, 2u);
    ck_assert(find(0, "z", &entry) && find(1, "b", &entry));
    finish();
}
END_TEST

START_TEST(strengths_that_cannot_be_are_left_out_and_counted)
{
    add_session("truth,0,1,1\ntruth,10,1,1\nrss,1,a,-60\nrss,1,b,3\nrss,1,c,-128\nrss,1,d,-127\n");
    make(&two_metres);
    ck_assert_uint_eq(weird, 2u);
    ck_assert_uint_eq(file.map.first[1], 2u);
    finish();
}
END_TEST

/* Places of two squares that the millimetre makes one stay two, and the file can be read. */
START_TEST(what_was_made_comes_back_from_its_file)
{
    static char text[TEXT_ROOM];
    radiomap_file_t again;
    add_session("truth,0,1.9998,1\ntruth,1,1.9998,1\nrss,0.5,a,-60\nrss,0.5,b,-61\n");
    add_session("truth,0,2.0001,1\ntruth,1,2.0001,1\nrss,0.5,a,-70\n");
    add_session("truth,0,7.12345,-3.3333\ntruth,1,7.12345,-3.3333\nrss,0.5,c,-71.3\n");
    make(&two_metres);
    ck_assert_uint_eq(file.map.point_count, 3u);
    FILE *stream = tmpfile();
    radiomap_file_write(stream, &file);
    strcpy(text, text_of(stream));
    bool is_good = radiomap_file_take(&again, file_of(text), "again", &failure);
    ck_assert_msg(is_good, "%s", failure.text);
    const insole_radio_map_t *a = &file.map, *b = &again.map;
    ck_assert_uint_eq(b->point_count, 3u);
    ck_assert_mem_eq(a->spots, b->spots, 3u * sizeof *a->spots);
    ck_assert_mem_eq(a->first, b->first, 4u * sizeof *a->first);
    ck_assert_mem_eq(a->aps, b->aps, 4u * sizeof *a->aps);
    ck_assert_mem_eq(a->below, b->below, 4u);
    ck_assert_mem_eq(a->spread, b->spread, 4u);
    ck_assert_mem_eq(a->counts, b->counts, 4u);
    radiomap_file_free(&again);
    finish();
}
END_TEST

START_TEST(histograms_are_made_where_wanted)
{
    const radiomap_options_t with_bins = {2.0, UINT32_MAX, true};
    add_session("truth,0,1,1\ntruth,9,1,1\nrss,1,a,-60\nrss,2,a,-61\nrss,3,a,-90\n");
    make(&with_bins);
    uint32_t sum = 0u;
    for (uint32_t i = 0u; i < INSOLE_RADIO_BINS; i++) {
        sum += file.map.bins[i];
    }
    ck_assert_uint_eq(sum, 3u);
    ck_assert_uint_eq(file.map.bins[0], 1u);
    ck_assert_uint_eq(radiomap_file_bytes(&file.map),
                      sizeof(insole_spot_t) + 2u * sizeof(uint32_t) + 1u + 13u);
    finish();
}
END_TEST

START_TEST(scans_lie_as_wholes_by_the_rule_of_maps)
{
    survey_rule_t rule = radiomap_rule(0.5, 0.25);
    ck_assert(rule.whole_scans);
    ASSERT_NEAR(rule.late_s, 0.5, 0.0, "s");
    ASSERT_NEAR(rule.ahead_m, 0.25, 0.0, "m");
    ASSERT_NEAR(rule.oldest_s, 3.5, 0.0, "s");
}
END_TEST

static const struct {
    const char *text, *says;
} refusals[] = {
    {"truth,0,1,1\ntruth,1,1,1\nrss,2,a,-50\nrss,2,b,-50\n",
     "insole radiomap: none of the 2 readings lies within the times of its truth"},
    {"truth,0,1,1\ntruth,1,1,1\nrss,0.5,a,50\n",
     "insole radiomap: no signal strength lies in -127 to 0 dBm"},
    {"truth,0,200000,1\ntruth,1,200000,1\nrss,0.5,a,-50\n",
     "insole radiomap: the truth is farther than 100 km from the map's origin"},
};

START_TEST(what_makes_no_map_is_refused)
{
    add_session(refusals[_i].text);
    ck_assert(!radiomap_make(&file, &survey, &two_metres, &weird, &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_msg(strstr(failure.text, refusals[_i].says) != NULL, "%s", failure.text);
    ck_assert_ptr_null(file.memory.spots);
    ck_assert_ptr_null(file.ids.names);
    survey_free(&survey);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("host/radiomap_make");
    suite_add(suite, "points", points_know_what_was_heard_there);
    suite_add(suite, "names", access_points_are_numbered_by_their_names);
    suite_add(suite, "keep", the_strongest_are_kept_and_what_nobody_kept_is_forgotten);
    suite_add(suite, "left out", strengths_that_cannot_be_are_left_out_and_counted);
    suite_add(suite, "round trip", what_was_made_comes_back_from_its_file);
    suite_add(suite, "histograms", histograms_are_made_where_wanted);
    suite_add(suite, "rule", scans_lie_as_wholes_by_the_rule_of_maps);
    suite_add_loop(suite, "refusals", what_makes_no_map_is_refused,
                   (int)(sizeof refusals / sizeof refusals[0]));
    return suite;
}
