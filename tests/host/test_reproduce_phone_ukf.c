/* SPDX-License-Identifier: MIT */
#include "reproduced.h"

#include "memory.h"
#include "reproduce_carry.h"
#include "reproduce_headings.h"
#include "reproduce_search.h"
#include "reproduce_walk.h"
#include "statistics.h"

static int row_of(const char *label)
{
    return row_in(&reproduce_phone_ukf, label);
}

/* The paper's table without what is measured beside it, and with a smaller survey: both take
 * longest. */
static reproduce_paper_t bare_table(void)
{
    reproduce_paper_t paper = reproduce_phone_ukf;
    paper.survey = "office/phone_ekf_survey";
    paper.more = NULL;
    return paper;
}

/* ---- the tables of the paper -------------------------------------------------------------- */

START_TEST(what_is_printed_is_the_papers)
{
    static const struct {
        const char *label;
        double mean_m, p75_m, p90_m, near_percent;
    } table[] = {{"proposed UKF", 0.76, 1.02, 1.46, 74.8},
                 {"UKF (empirical)", 1.01, 1.30, 1.88, 55.4},
                 {"EKF (empirical)", 1.09, 1.47, 2.26, 51.8},
                 {"KF (empirical)", 1.19, 1.61, 2.39, 48.4},
                 {"PDR", 1.83, 2.65, 3.81, 32.4},
                 {"Wi-Fi localization", 2.26, 3.20, 4.44, 21.2}};
    for (int i = 0; i < 6; i++) {
        const reproduce_row_t *row = &reproduce_phone_ukf.rows[row_of(table[i].label)];
        ck_assert(!row->is_ours && row->lacks_plan);
        ASSERT_NEAR(row->printed.m[REPRODUCE_MEAN], table[i].mean_m, 0.0, "m");
        ASSERT_NEAR(row->printed.m[REPRODUCE_75], table[i].p75_m, 0.0, "m");
        ASSERT_NEAR(row->printed.m[REPRODUCE_90], table[i].p90_m, 0.0, "m");
        ASSERT_NEAR(row->printed.m[REPRODUCE_NEAR], table[i].near_percent, 0.0, "%");
        ck_assert(!(row->printed.m[REPRODUCE_MAX] > 0.0));
    }
}
END_TEST

/* What the text of the paper claims follows from its own table. */
START_TEST(claims_of_the_paper_are_those_of_its_table)
{
    int found = 0;
    check_claims(&reproduce_phone_ukf);
    for (int i = 0; i < reproduce_phone_ukf.claim_count; i++) {
        const reproduce_claim_t *claim = &reproduce_phone_ukf.claims[i];
        char expected[64];
        double below = 1.0 - reproduce_phone_ukf.rows[claim->row].printed.m[claim->figure] /
                                 reproduce_phone_ukf.rows[claim->rival].printed.m[claim->figure];
        snprintf(expected, sizeof expected, "the paper: %.1f %% lower", 100.0 * below);
        if (strncmp(claim->claim, "the paper: ", 11u) == 0) {
            ck_assert_msg(strncmp(claim->claim, expected, strlen(expected)) == 0, "%s",
                          claim->claim);
            found++;
        }
    }
    ck_assert_int_eq(found, 5);
}
END_TEST

/* Rows of one table differ in the filter alone; only rivals have constants, and those are among
 * the values that were searched. */
START_TEST(rivals_have_constants_that_were_searched)
{
    static const char *const rivals[] = {"UKF (empirical)", "EKF (empirical)", "KF (empirical)"};
    for (int i = 0; i < 3; i++) {
        const reproduce_row_t *row = &reproduce_phone_ukf.rows[row_of(rivals[i])];
        bool is_found = false;
        ck_assert_ptr_nonnull(row->settings);
        ck_assert_int_ge(row->axis_count, 2);
        ck_assert_int_ge(reproduce_search_count(row), 50);
        for (int k = 0; !is_found && k < reproduce_search_count(row); k++) {
            char *settings = reproduce_search_settings(row, k);
            is_found = strcmp(settings, row->settings) == 0;
            free(settings);
        }
        ck_assert_msg(is_found, "%s: %s", row->label, row->settings);
    }
}
END_TEST

/* ---- walks ------------------------------------------------------------------------------- */

START_TEST(four_walks_in_a_row_are_carried_four_ways)
{
    static const char *const poses[] = {"pocket", "hand", "ear", "swing"};
    reproduce_paper_t paper = bare_table();
    reproduce_request_t request = request_of(4, 12u, NULL);
    ck_assert(reproduce_begin(&reproduction, &paper, &request, &failure));
    ck_assert_msg(reproduce_survey(&reproduction, &failure), "%s", failure.text);
    for (int i = 0; i < 4; i++) {
        ck_assert_msg(reproduce_open_walk(&reproduction, i, &failure), "%s", failure.text);
        char *path = platform_join(reproduction.folder, "pose.csv");
        char expected[40];
        snprintf(expected, sizeof expected, ",%s\n", poses[i]);
        ck_assert_int_eq(count_of(content_of(path), expected), 1);
        ck_assert_str_eq(reproduction.kind->name, poses[i]);
        free(path);
        reproduce_close_walk(&reproduction);
    }
    reproduce_free(&reproduction);
}
END_TEST

START_TEST(walks_do_not_depend_on_each_other)
{
    reproduce_paper_t paper = bare_table();
    measure_paper(&paper, 2, 7u, NULL);
    check_walk_alone(&paper, 1, 8u);
}
END_TEST

/* By hand from all errors. */
START_TEST(figures_are_those_of_all_errors)
{
    reproduce_paper_t paper = bare_table();
    measure_paper(&paper, 2, 3u, NULL);
    for (int row = 0; row < paper.row_count; row++) {
        const reproduce_result_t *result = &reproduction.results[row];
        reproduce_figures_t figures = reproduce_means(&reproduction, row);
        size_t below[3] = {0u, 0u, 0u}, count = result->error_count;
        double sum = 0.0;
        for (size_t i = 0u; i < count; i++) {
            sum += result->errors_m[i];
            below[0] += result->errors_m[i] <= figures.m[REPRODUCE_75] ? 1u : 0u;
            below[1] += result->errors_m[i] <= figures.m[REPRODUCE_90] ? 1u : 0u;
            below[2] += result->errors_m[i] < 1.0 ? 1u : 0u;
        }
        ck_assert_uint_gt(count, 200u);
        ASSERT_NEAR(figures.m[REPRODUCE_MEAN], sum / (double)count, 1e-9, "m");
        ASSERT_NEAR((double)below[0] / (double)count, 0.75, 0.005, "1");
        ASSERT_NEAR((double)below[1] / (double)count, 0.90, 0.005, "1");
        ASSERT_NEAR(figures.m[REPRODUCE_NEAR], 100.0 * (double)below[2] / (double)count, 1e-9, "%");
    }
    reproduce_free(&reproduction);
}
END_TEST

/* Without fingerprints a filter is dead reckoning; a row's settings are all taken. */
START_TEST(a_row_may_lack_fingerprints_and_have_settings)
{
    static const reproduce_row_t rows[] = {
        {.label = "whole", .method = METHOD_UKF, .start = REPRODUCE_START_BY_COMPASS},
        {.label = "deaf",
         .method = METHOD_UKF,
         .lacks_radio = true,
         .start = REPRODUCE_START_BY_COMPASS},
        {.label = "deaf, another fix",
         .method = METHOD_UKF,
         .lacks_radio = true,
         .start = REPRODUCE_START_BY_COMPASS,
         .settings = " kde_fix.sigma_db=20  step_fusion.gate=1"},
        {.label = "deaf, other steps",
         .method = METHOD_UKF,
         .lacks_radio = true,
         .start = REPRODUCE_START_BY_COMPASS,
         .settings = "step_length.model=constant step_length.constant_m=0.2"}};
    reproduce_paper_t paper = bare_table();
    paper.rows = rows;
    paper.row_count = 4;
    paper.claim_count = paper.drawing_count = 0;
    measure_paper(&paper, 1, 8u, NULL);
    double mean_m[4];
    for (int i = 0; i < 4; i++) {
        mean_m[i] = reproduction.results[i].walks[0].m[REPRODUCE_MEAN];
    }
    ck_assert(mean_m[0] != mean_m[1]);
    ASSERT_NEAR(mean_m[2], mean_m[1], 0.0, "m");
    ck_assert(mean_m[3] > mean_m[1] + 2.0);
    reproduce_free(&reproduction);
}
END_TEST

/* ---- the search --------------------------------------------------------------------------- */

static const double fixes_m[] = {0.5, 2.0, 8.0}, ways_m[] = {0.1, 0.8};
static const reproduce_axis_t axes[] = {{"step_fusion.sigma_fix_m", fixes_m, 3},
                                        {"step_fusion.sigma_way_m", ways_m, 2}};

/* What the search finds is the best of rows that have these settings each. */
START_TEST(the_search_finds_the_best_of_all_combinations)
{
    enum { ALL = 6 };
    reproduce_row_t rows[ALL];
    char *settings[ALL];
    reproduce_paper_t paper = bare_table();
    reproduce_row_t searched = {.label = "searched",
                                .method = METHOD_KF_CONST,
                                .start = REPRODUCE_START_BY_COMPASS,
                                .axes = axes,
                                .axis_count = 2};
    ck_assert_int_eq(reproduce_search_count(&searched), ALL);
    for (int i = 0; i < ALL; i++) {
        settings[i] = reproduce_search_settings(&searched, i);
        rows[i] = searched;
        rows[i].axis_count = 0;
        rows[i].settings = settings[i];
    }
    ck_assert_str_eq(settings[3], "step_fusion.sigma_fix_m=2 step_fusion.sigma_way_m=0.8");
    paper.claim_count = paper.drawing_count = 0;
    paper.rows = rows;
    paper.row_count = ALL;
    measure_paper(&paper, 2, 4u, NULL);
    double mean_m[ALL];
    int best = 0;
    for (int i = 0; i < ALL; i++) {
        mean_m[i] = reproduce_means(&reproduction, i).m[REPRODUCE_MEAN];
        best = mean_m[i] < mean_m[best] ? i : best;
    }
    reproduce_free(&reproduction);

    paper.rows = &searched;
    paper.row_count = 1;
    reproduce_request_t request = request_of(2, 4u, NULL);
    reproduce_search_t search;
    ck_assert(reproduce_begin(&reproduction, &paper, &request, &failure));
    reproduce_search_begin(&search, &reproduction);
    ck_assert_msg(reproduce_search_run(&search, &failure), "%s", failure.text);
    for (int i = 0; i < ALL; i++) {
        ASSERT_NEAR(search.sums_m[0][i] / (double)search.error_count, mean_m[i], 1e-9, "m");
        free(settings[i]);
    }
    ck_assert_int_eq(reproduce_search_best(&search, 0), best);
    FILE *file = tmpfile();
    reproduce_search_print(&search, file);
    const char *text = text_of(file);
    ck_assert_ptr_nonnull(strstr(text, "2 walks from seed 4 on"));
    ck_assert_ptr_nonnull(strstr(text, " m of 6 combinations\n"));
    ck_assert_int_eq(count_of(text, "["), 3);
    reproduce_search_free(&search);
    reproduce_free(&reproduction);
}
END_TEST

START_TEST(a_search_that_cannot_be_done_is_told)
{
    static const double values[] = {-1.0};
    static const reproduce_axis_t bad[] = {{"step_fusion.sigma_fix_m", values, 1}};
    static const reproduce_row_t row = {
        .label = "bad", .method = METHOD_KF_CONST, .axes = bad, .axis_count = 1};
    reproduce_paper_t paper = bare_table();
    paper.rows = &row;
    paper.row_count = 1;
    reproduce_request_t request = request_of(1, 4u, NULL);
    reproduce_search_t search;
    ck_assert(reproduce_begin(&reproduction, &paper, &request, &failure));
    reproduce_search_begin(&search, &reproduction);
    ck_assert(!reproduce_search_run(&search, &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "sigma_fix_m"));
    reproduce_search_free(&search);
    reproduce_free(&reproduction);
    ck_assert(reproduce_search_has_axes(&reproduce_phone_ukf));
    ck_assert(!reproduce_search_has_axes(&reproduce_phone_ekf));
}
END_TEST

/* ---- headings ----------------------------------------------------------------------------- */

/* A phone that points ahead tells the direction of each step; who takes the back for the front is
 * off by half a circle. */
START_TEST(headings_are_held_against_the_way_walked)
{
    static const reproduce_kind_t kind[] = {
        {"hand", "phone.pose=hand phone.mounting=told phone.hold_rad=0 imu.gyro_bias_radps=0",
         NULL}};
    static const reproduce_kind_t back[] = {
        {"hand",
         "phone.pose=hand phone.mounting=told phone.hold_rad=0 imu.gyro_bias_radps=0 "
         "phone.yaw_rad=3.1416",
         NULL}};
    static const reproduce_heading_row_t rows[] = {{{.label = "device",
                                                     .method = METHOD_UKF,
                                                     .lacks_radio = true,
                                                     .start = REPRODUCE_START_BY_COMPASS,
                                                     .settings = "phone_walk.faces=ahead"},
                                                    0.0}};
    for (int i = 0; i < 2; i++) {
        reproduce_headings_t headings = {.rows = rows, .row_count = 1};
        reproduce_paper_t paper = bare_table();
        reproduce_request_t request = request_of(1, 4u, NULL);
        paper.kinds = i == 0 ? kind : back;
        paper.kind_count = 1;
        ck_assert(reproduce_begin(&reproduction, &paper, &request, &failure));
        ck_assert_msg(reproduce_survey(&reproduction, &failure) &&
                          reproduce_open_walk(&reproduction, 0, &failure) &&
                          reproduce_headings_walk(&headings, &reproduction, &failure),
                      "%s", failure.text);
        ck_assert_uint_gt(headings.errors[0].count, 90u);
        double near = reproduce_headings_within(&headings, 0, 20.0);
        double far = reproduce_headings_within(&headings, 0, 160.0);
        ck_assert_msg(i == 0 ? near > 85.0 : far < 15.0, "%f %% within 20, %f %% within 160", near,
                      far);
        reproduce_headings_free(&headings);
        reproduce_close_walk(&reproduction);
        reproduce_free(&reproduction);
    }
}
END_TEST

START_TEST(shares_of_headings_are_counted)
{
    static const reproduce_heading_row_t rows[] = {{{.label = "made"}, 61.5}};
    double errors_deg[] = {40.0, 4.0, 15.0, 170.0};
    reproduce_headings_t headings = {
        .rows = rows, .row_count = 1, .errors = {{errors_deg, 4u, 4u}}};
    ASSERT_NEAR(reproduce_headings_within(&headings, 0, 3.0), 0.0, 0.0, "%");
    ASSERT_NEAR(reproduce_headings_within(&headings, 0, 15.0), 50.0, 0.0, "%");
    ASSERT_NEAR(reproduce_headings_within(&headings, 0, 180.0), 100.0, 0.0, "%");
    FILE *file = tmpfile();
    reproduce_headings_print(&headings, file);
    const char *text = text_of(file);
    ck_assert_ptr_nonnull(strstr(
        text, "\nmade                     25.0   25.0   50.0   50.0   50.0   75.0   75.0   57.3"));
    ck_assert_ptr_nonnull(strstr(text, "  61.5\n"));
    headings.errors[0].count = 0u;
    ck_assert(isnan(reproduce_headings_within(&headings, 0, 3.0)));
}
END_TEST

/* ---- all of it ---------------------------------------------------------------------------- */

START_TEST(tables_and_figures_are_made)
{
    static const char *const names[] = {"way.svg", "figure3.svg", "figure5.svg"};
    static const char *const pieces[] = {
        "\nproposed UKF ", "\nUKF (empirical) ",  "\nPDR ",     "table 1: share", "\npocket ",
        "figures 3 and 4", "\nRMPCA on the UKF ", "\nuDirect ", "\nright: "};
    char *out = platform_join(SCRATCH, "figures");
    measure_paper(&reproduce_phone_ukf, 4, 1u, out);
    for (int i = 0; i < 3; i++) {
        check_picture(out, names[i]);
    }
    const char *text = printed(reproduce_print);
    for (size_t i = 0u; i < sizeof pieces / sizeof pieces[0]; i++) {
        ck_assert_msg(strstr(text, pieces[i]) != NULL, "%s", pieces[i]);
    }
    const char *at = strstr(text, "\nright: ");
    ck_assert_msg(strtod(at + 8, NULL) > 70.0, "%.20s", at);
    const char *json = printed(reproduce_json);
    ck_assert_ptr_nonnull(strstr(json, "\"within_1m_percent\""));
    ck_assert_ptr_nonnull(strstr(json, "\"headings\""));
    ck_assert_ptr_nonnull(strstr(json, "\"carry\""));
    reproduce_free(&reproduction);
    free(out);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("reproduce_phone_ukf");
    suite_add(suite, "printed", what_is_printed_is_the_papers);
    suite_add(suite, "claims", claims_of_the_paper_are_those_of_its_table);
    suite_add(suite, "constants", rivals_have_constants_that_were_searched);
    suite_add(suite, "positions", four_walks_in_a_row_are_carried_four_ways);
    suite_add(suite, "walks", walks_do_not_depend_on_each_other);
    suite_add(suite, "figures", figures_are_those_of_all_errors);
    suite_add(suite, "rows", a_row_may_lack_fingerprints_and_have_settings);
    suite_add(suite, "search", the_search_finds_the_best_of_all_combinations);
    suite_add(suite, "no search", a_search_that_cannot_be_done_is_told);
    suite_add(suite, "headings", headings_are_held_against_the_way_walked);
    suite_add(suite, "shares", shares_of_headings_are_counted);
    suite_add(suite, "whole", tables_and_figures_are_made);
    return suite;
}
