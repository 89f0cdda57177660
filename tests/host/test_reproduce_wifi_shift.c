/* SPDX-License-Identifier: MIT */
#include "reproduce_wifi_shift.h"

#include <math.h>
#include <stdlib.h>

#include "files.h"
#include "near.h"
#include "platform.h"
#include "reproduce_walk.h"
#include "suite.h"
#include "xml.h"

static failure_t failure;
static wifi_shift_t study;

/* ---- a small hall ------------------------------------------------------------------------- */

static void copy(const char *from, const char *to)
{
    char line[4096];
    FILE *source = fopen(from, "r"), *target = fopen(to, "w");
    ck_assert(source != NULL && target != NULL);
    while (fgets(line, sizeof line, source) != NULL) {
        fputs(line, target);
    }
    fclose(source);
    fclose(target);
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fputs(text, file);
    fclose(file);
}

#define RADIO                                                                                      \
    "radio.place = body\nradio.readings = 10\nradio.jitter_s = 0.01\nradio.late_share = 0\n"       \
    "radio.crowd_db = 6\n"
#define PHONE "plan,plan.csv\naps,aps.csv\nlog.sensor = phone\nlog.truth = body\n" RADIO

/* The same building, with a survey and paths that take no time. */
static const char *small_maps(void)
{
    static char maps[512];
    static const char *const walks[] = {"start,3,18.8,0\nwalk,23,18.8,1.2\n",
                                        "start,30,18.8,3.1416\nwalk,9,18.8,1.2\n",
                                        ("start,3.5,8.8,1.5708\nwalk,3.5,18.8,1.2\n"
                                         "walk,12,18.8,1.2\n")};
    snprintf(maps, sizeof maps, "%s", scratch("maps"));
    ck_assert(platform_make_folder(maps));
    ck_assert(platform_make_folder(scratch("maps/exhibition_hall")));
    copy(MAPS "/exhibition_hall/plan.csv", scratch("maps/exhibition_hall/plan.csv"));
    copy(MAPS "/exhibition_hall/aps.csv", scratch("maps/exhibition_hall/aps.csv"));
    write_text(scratch("maps/exhibition_hall/wifi_shift_survey"),
               "plan,plan.csv\naps,aps.csv\npoints,1.5,8.8,31.5,8.8\npoints,1.5,18.8,31.5,18.8\n"
               "start,3,18.8,0\nsurvey,3\nsurvey.pause_s = 1\nradio.place = body\n"
               "radio.period_s = 0.1\nradio.jitter_s = 0.01\nradio.late_share = 0\n"
               "radio.floor_dbm = -120\nlog.imu = none\nlog.truth = body\nimu.rate_hz = 50\n");
    for (int i = 0; i < WIFI_SHIFT_PATHS; i++) {
        char name[64], text[1024];
        snprintf(name, sizeof name, "maps/exhibition_hall/wifi_shift_%d.scenario", i + 1);
        snprintf(text, sizeof text, PHONE "%s", walks[i]);
        write_text(scratch(name), text);
    }
    return maps;
}

static bool measure(int runs, uint64_t seed, const char *out)
{
    const reproduce_request_t request = {small_maps(), out, runs, seed};
    bool is_good =
        wifi_shift_begin(&study, &request, &failure) && wifi_shift_measure(&study, &failure);
    ck_assert_msg(is_good, "%s", failure.text);
    return is_good;
}

static const char *printed(void (*print)(const wifi_shift_t *, FILE *))
{
    FILE *file = tmpfile();
    ck_assert_ptr_nonnull(file);
    print(&study, file);
    return text_of(file);
}

static int row_of(const char *label)
{
    for (int i = 0; i < WIFI_SHIFT_ROWS; i++) {
        if (strcmp(wifi_shift_rows[i].label, label) == 0) {
            return i;
        }
    }
    ck_abort_msg("no row %s", label);
    return -1;
}

/* ---- the tables of the paper -------------------------------------------------------------- */

START_TEST(what_is_printed_is_the_papers)
{
    static const struct {
        const char *label;
        double mean_m[3], std_m[3];
    } table[] = {{"proposed", {2.76, 2.57, 2.81}, {2.88, 2.51, 2.73}},
                 {"WPF, true start", {4.45, 4.63, 5.01}, {3.51, 4.68, 4.60}},
                 {"Zee", {6.52, 7.64, 9.15}, {3.58, 3.74, 4.23}},
                 {"fingerprint-ML", {6.56, 7.10, 7.66}, {4.53, 4.87, 4.82}}};
    static const struct {
        const char *label;
        double mean_m[2][3];
    } table_4[] = {{"proposed", {{3.36, 3.03, 3.25}, {4.76, 4.21, 4.35}}},
                   {"WPF, true start", {{5.25, 5.41, 5.91}, {7.65, 7.52, 8.05}}},
                   {"fingerprint-ML", {{7.98, 8.55, 9.15}, {11.68, 11.53, 12.26}}}};
    for (int i = 0; i < 4; i++) {
        const wifi_shift_row_t *row = &wifi_shift_rows[row_of(table[i].label)];
        for (int path = 0; path < WIFI_SHIFT_PATHS; path++) {
            ASSERT_NEAR(row->printed[0][path].mean_m, table[i].mean_m[path], 0.0, "m");
            ASSERT_NEAR(row->printed[0][path].std_m, table[i].std_m[path], 0.0, "m");
        }
    }
    for (int i = 0; i < 6; i++) {
        const wifi_shift_row_t *row = &wifi_shift_rows[row_of(table_4[i / 2].label)];
        ck_assert(row->is_in_table_4);
        for (int path = 0; path < WIFI_SHIFT_PATHS; path++) {
            ASSERT_NEAR(row->printed[1 + i % 2][path].mean_m, table_4[i / 2].mean_m[i % 2][path],
                        0.0, "m");
        }
    }
    ck_assert(isnan(wifi_shift_rows[row_of("best, by our defaults")].printed[0][0].mean_m));
}
END_TEST

START_TEST(who_is_told_the_start_is_as_in_the_paper)
{
    for (int i = 0; i < WIFI_SHIFT_ROWS; i++) {
        const wifi_shift_row_t *row = &wifi_shift_rows[i];
        bool knows = row->method == METHOD_WPF || row->method == METHOD_PHONE_PDR;
        ck_assert_int_eq(row->is_told, knows);
        settings_t settings;
        ck_assert_msg(reproduce_set(&settings, row->settings, &failure), "%s", failure.text);
    }
}
END_TEST

START_TEST(claims_name_rows_that_are_there)
{
    int count;
    const wifi_shift_claim_t *claims = wifi_shift_claims(&count);
    ck_assert_int_ge(count, 3);
    for (int i = 0; i < count; i++) {
        ck_assert(claims[i].row >= 0 && claims[i].row < WIFI_SHIFT_ROWS);
        ck_assert(claims[i].rival >= 0 && claims[i].rival < WIFI_SHIFT_ROWS);
        ck_assert_int_ne(claims[i].row, claims[i].rival);
        ck_assert(claims[i].at_most > 0.0 && claims[i].at_most < 1.0);
    }
}
END_TEST

/* ---- what is measured --------------------------------------------------------------------- */

START_TEST(every_row_is_measured_on_every_path)
{
    measure(1, 3u, NULL);
    for (int row = 0; row < WIFI_SHIFT_ROWS; row++) {
        for (int path = 0; path < WIFI_SHIFT_PATHS; path++) {
            wifi_shift_error_t error = wifi_shift_mean(&study, row, 0, path);
            ck_assert_msg(error.mean_m > 0.0 && error.mean_m < 200.0, "%s: %f",
                          wifi_shift_rows[row].label, error.mean_m);
            ck_assert(error.std_m > 0.0);
            for (int count = 1; count < WIFI_SHIFT_COUNTS; count++) {
                bool is_known = !isnan(wifi_shift_mean(&study, row, count, path).mean_m);
                ck_assert_int_eq(is_known, wifi_shift_rows[row].is_in_table_4);
            }
        }
    }
    double told_m = wifi_shift_mean(&study, row_of("WPF, true start"), 0, 0).mean_m;
    double lost_m = wifi_shift_mean(&study, row_of("Zee without radio"), 0, 0).mean_m;
    ck_assert_msg(told_m < 4.0 && lost_m > 2.0 * told_m, "%f %f", told_m, lost_m);
    wifi_shift_free(&study);
}
END_TEST

START_TEST(fewer_access_points_are_in_the_thinner_maps)
{
    const reproduce_request_t request = {small_maps(), NULL, 1, 3u};
    ck_assert_msg(wifi_shift_begin(&study, &request, &failure), "%s", failure.text);
    for (int count = 0; count < WIFI_SHIFT_COUNTS; count++) {
        const insole_radio_map_t *map = &study.sites[count].radiomap_file.map;
        ck_assert_uint_eq(map->ap_count, (unsigned)wifi_shift_counts[count]);
        ck_assert_uint_eq(map->point_count, study.sites[0].radiomap_file.map.point_count);
    }
    ck_assert(!site_has_radiomap(&study.bare));
    wifi_shift_free(&study);
}
END_TEST

/* lambda fixes: one is the first fix, of one the mean is itself, and circles of one begin there. */
START_TEST(starts_of_figure_7_grow_from_the_first_fix)
{
    measure(1, 3u, NULL);
    double first_m = wifi_shift_start_error(&study, WIFI_SHIFT_FIRST, 1);
    ck_assert(first_m >= 0.0 && first_m < 30.0);
    ASSERT_NEAR(wifi_shift_start_error(&study, WIFI_SHIFT_MEAN, 1), first_m, 1e-5, "m");
    for (int start = 0; start < WIFI_SHIFT_STARTS; start++) {
        for (int lambda = 1; lambda <= WIFI_SHIFT_LAMBDAS; lambda++) {
            ck_assert_uint_eq(study.starts[start][lambda - 1], WIFI_SHIFT_PATHS);
        }
        ck_assert(wifi_shift_start_error(&study, (wifi_shift_start_t)start, 8) < 30.0);
    }
    ASSERT_NEAR(wifi_shift_start_error(&study, WIFI_SHIFT_FIRST, 8), first_m, 1e-9, "m");
    wifi_shift_free(&study);
}
END_TEST

START_TEST(equal_seeds_give_equal_tables)
{
    static char table[16384], json[65536];
    measure(1, 5u, NULL);
    snprintf(table, sizeof table, "%s", printed(wifi_shift_print));
    snprintf(json, sizeof json, "%s", printed(wifi_shift_json));
    wifi_shift_free(&study);
    measure(1, 5u, NULL);
    ck_assert_str_eq(printed(wifi_shift_print), table);
    ck_assert_str_eq(printed(wifi_shift_json), json);
    wifi_shift_free(&study);
    measure(1, 6u, NULL);
    ck_assert_str_ne(printed(wifi_shift_print), table);
    wifi_shift_free(&study);
}
END_TEST

/* ---- what is told ------------------------------------------------------------------------- */

/* Two walks, with errors made up: each row twice as far off as the one before. */
static void make_up(void)
{
    memset(&study, 0, sizeof study);
    study.request.runs = 2;
    study.request.seed = 5u;
    double error_m = 1.0;
    for (int row = 0; row < WIFI_SHIFT_ROWS; row++, error_m *= 2.0) {
        for (int i = 0; i < WIFI_SHIFT_COUNTS * WIFI_SHIFT_PATHS; i++) {
            study.sums[row][i / WIFI_SHIFT_PATHS][i % WIFI_SHIFT_PATHS] =
                (wifi_shift_error_t){2.0 * error_m, error_m};
        }
    }
}

START_TEST(means_are_over_the_walks)
{
    make_up();
    ASSERT_NEAR(wifi_shift_mean(&study, 3, 0, 1).mean_m, 8.0, 0.0, "m");
    ASSERT_NEAR(wifi_shift_mean(&study, 3, 0, 1).std_m, 4.0, 0.0, "m");
    ck_assert(isnan(wifi_shift_start_error(&study, WIFI_SHIFT_FIRST, 3)));
    study.start_m[WIFI_SHIFT_FIRST][2] = 9.0;
    study.starts[WIFI_SHIFT_FIRST][2] = 6u;
    ASSERT_NEAR(wifi_shift_start_error(&study, WIFI_SHIFT_FIRST, 3), 1.5, 0.0, "m");
}
END_TEST

START_TEST(the_table_has_rows_prints_and_verdicts)
{
    make_up();
    const char *text = printed(wifi_shift_print);
    for (int i = 0; i < WIFI_SHIFT_ROWS; i++) {
        char label[64];
        snprintf(label, sizeof label, "\n%s ", wifi_shift_rows[i].label);
        ck_assert_msg(strstr(text, label) != NULL, "no row%s", label);
    }
    ck_assert_ptr_nonnull(strstr(text, "2 simulated walks of each path, seed 5 to 6\n"));
    ck_assert_ptr_nonnull(strstr(text, "  2.76 ( 2.88)  2.57 ( 2.51)  2.81 ( 2.73)\n"));
    ck_assert_ptr_nonnull(strstr(text, "  8.00 ( 4.00)  8.00 ( 4.00)  8.00 ( 4.00)  |"));
    ck_assert_ptr_nonnull(strstr(text, "   7.65   7.52   8.05\n"));
    ck_assert_ptr_nonnull(strstr(text, "  0.13  0.13  0.13   at most 0.65  met\n"));
    ck_assert_ptr_nonnull(strstr(text, "at most 0.65  missed\n")); /* best: the last row */
    ck_assert_ptr_nonnull(strstr(printed(wifi_shift_json), "\"access_points\": 15"));
}
END_TEST

START_TEST(figure_7_is_drawn)
{
    char *out = platform_join(SCRATCH, "figures");
    measure(1, 1u, out);
    char *path = platform_join(out, "figure7.svg");
    const char *fault = xml_fault(content_of(path));
    ck_assert_msg(fault == NULL, "not well formed at: %.60s", fault);
    wifi_shift_free(&study);
    free(path);
    free(out);
}
END_TEST

START_TEST(what_cannot_be_done_is_told)
{
    reproduce_request_t request = {"nowhere", NULL, 1, 1u};
    ck_assert(!wifi_shift_begin(&study, &request, &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_ptr_nonnull(strstr(failure.text, "nowhere/exhibition_hall"));
    wifi_shift_free(&study);
    request.out = scratch("absent/figures");
    ck_assert(!wifi_shift_begin(&study, &request, &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "absent/figures"));
    wifi_shift_free(&study);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("reproduce_wifi_shift");
    suite_add(suite, "printed", what_is_printed_is_the_papers);
    suite_add(suite, "told start", who_is_told_the_start_is_as_in_the_paper);
    suite_add(suite, "claims", claims_name_rows_that_are_there);
    suite_add(suite, "rows", every_row_is_measured_on_every_path);
    suite_add(suite, "thin maps", fewer_access_points_are_in_the_thinner_maps);
    suite_add(suite, "figure 7", starts_of_figure_7_grow_from_the_first_fix);
    suite_add(suite, "determinism", equal_seeds_give_equal_tables);
    suite_add(suite, "means", means_are_over_the_walks);
    suite_add(suite, "table", the_table_has_rows_prints_and_verdicts);
    suite_add(suite, "picture", figure_7_is_drawn);
    suite_add(suite, "refusals", what_cannot_be_done_is_told);
    return suite;
}
