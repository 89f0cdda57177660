/* SPDX-License-Identifier: MIT */
#include "reproduced.h"

static void measure(int runs, uint64_t seed, const char *out)
{
    measure_paper(&reproduce_phone_ekf, runs, seed, out);
}

static int row_of(const char *label)
{
    return row_in(&reproduce_phone_ekf, label);
}

static double mean_of(const char *label)
{
    return reproduce_means(&reproduction, row_of(label)).m[REPRODUCE_MEAN];
}

/* ---- the table of the paper --------------------------------------------------------------- */

START_TEST(what_is_printed_is_the_papers)
{
    static const struct {
        const char *label;
        double mean_m, std_m;
    } table[] = {{"proposed EKF", 0.71, 0.37},    {"PDR (gyro + acc)", 1.24, 0.53},
                 {"PDR (gyro)", 1.56, 1.07},      {"Wi-Fi localization", 2.83, 2.79},
                 {"particle filter", 0.81, 0.40}, {"improved PF", 0.65, 0.33}};
    for (int i = 0; i < 6; i++) {
        const reproduce_row_t *row = &reproduce_phone_ekf.rows[row_of(table[i].label)];
        ck_assert(!row->is_ours && row->lacks_plan && row->start == REPRODUCE_START_TOLD);
        ASSERT_NEAR(row->printed.m[REPRODUCE_MEAN], table[i].mean_m, 0.0, "m");
        ASSERT_NEAR(row->printed.m[REPRODUCE_STD], table[i].std_m, 0.0, "m");
        ck_assert(!(row->printed.m[REPRODUCE_MAX] > 0.0));
    }
    for (int i = 6; i < reproduce_phone_ekf.row_count; i++) {
        ck_assert(reproduce_phone_ekf.rows[i].is_ours);
        ck_assert(!(reproduce_phone_ekf.rows[i].printed.m[REPRODUCE_MEAN] > 0.0));
    }
}
END_TEST

/* What the text of the paper claims follows from its own table. */
START_TEST(claims_of_the_paper_are_those_of_its_table)
{
    int found = 0;
    check_claims(&reproduce_phone_ekf);
    for (int i = 0; i < reproduce_phone_ekf.claim_count; i++) {
        const reproduce_claim_t *claim = &reproduce_phone_ekf.claims[i];
        char expected[64];
        double below = 1.0 - reproduce_phone_ekf.rows[claim->row].printed.m[claim->figure] /
                                 reproduce_phone_ekf.rows[claim->rival].printed.m[claim->figure];
        snprintf(expected, sizeof expected, "the paper: %.1f %% %s", 100.0 * fabs(below),
                 below < 0.0 ? "higher" : "lower");
        if (strncmp(claim->claim, "the paper: ", 11u) == 0) {
            ck_assert_str_eq(claim->claim, expected);
            found++;
        }
    }
    ck_assert_int_eq(found, 10);
}
END_TEST

/* ---- what is measured ---------------------------------------------------------------------- */

START_TEST(errors_are_taken_at_the_footfalls_of_the_walk)
{
    measure(1, 3u, NULL);
    char *path = platform_join(reproduction.folder, "steps.csv");
    const char *steps = content_of(path);
    int walked = count_of(steps, ",walk\n");
    ck_assert_int_gt(walked, 100);
    ck_assert_int_gt(count_of(steps, ",shuffle\n"), 0);
    for (int row = 0; row < reproduce_phone_ekf.row_count; row++) {
        const reproduce_result_t *result = &reproduction.results[row];
        ck_assert_uint_eq(result->error_count, (size_t)walked);
        for (size_t i = 0u; i < result->error_count; i++) {
            ck_assert(result->errors_m[i] >= 0.0 && result->errors_m[i] < 45.0);
        }
    }
    free(path);
    reproduce_free(&reproduction);
}
END_TEST

/* 50 points, the nearest of each 1.2 or 1.34 m away, each heard some hundred times. */
START_TEST(the_survey_is_that_of_the_paper)
{
    radiomap_file_t file;
    measure(1, 3u, NULL);
    char *path = platform_join(reproduction.folder, "radiomap.csv");
    ck_assert_msg(radiomap_file_read(&file, path, &failure), "%s", failure.text);
    ck_assert_uint_eq(file.map.point_count, 50u);
    ck_assert_uint_eq(file.ids.count, 8u);
    for (uint32_t i = 0u; i < file.map.point_count; i++) {
        double nearest_m = 1e9;
        for (uint32_t k = 0u; k < file.map.point_count; k++) {
            double x_m = (double)(file.map.spots[k].x_m - file.map.spots[i].x_m);
            double y_m = (double)(file.map.spots[k].y_m - file.map.spots[i].y_m);
            nearest_m = k != i ? fmin(nearest_m, hypot(x_m, y_m)) : nearest_m;
        }
        ck_assert_msg(nearest_m > 1.19 && nearest_m < 1.35, "point %u: %f m", (unsigned)i,
                      nearest_m);
        ck_assert_uint_ge(file.map.visits[i], 90u);
    }
    radiomap_file_free(&file);
    free(path);
    reproduce_free(&reproduction);
}
END_TEST

/* A walk is the same among others as alone, and has a survey of its own. */
START_TEST(walks_do_not_depend_on_each_other)
{
    measure(2, 7u, NULL);
    for (int row = 0; row < reproduce_phone_ekf.row_count; row++) {
        const reproduce_figures_t *walks = reproduction.results[row].walks;
        ck_assert(walks[1].m[REPRODUCE_MEAN] != walks[0].m[REPRODUCE_MEAN]);
    }
    ck_assert(mean_of("proposed EKF") < mean_of("PDR (gyro)"));
    ck_assert(mean_of("proposed EKF") < mean_of("Wi-Fi localization"));
    ck_assert(mean_of("improved PF") < mean_of("particle filter"));
    ck_assert(mean_of("best") < mean_of("Wi-Fi localization"));
    check_walk_alone(&reproduce_phone_ekf, 1, 8u);
}
END_TEST

/* A row as it is and told the plan, another as it is and with a setting of its own. */
START_TEST(a_row_has_its_own_plan_and_setting)
{
    static const reproduce_row_t rows[] = {
        {.label = "bare", .method = METHOD_PHONE_BEST, .is_ours = true, .lacks_plan = true},
        {.label = "plan", .method = METHOD_PHONE_BEST, .is_ours = true},
        {.label = "steps", .method = METHOD_PHONE_PDR, .is_ours = true},
        {.label = "long steps",
         .method = METHOD_PHONE_PDR,
         .is_ours = true,
         .settings = "step_length.root_scale=0.6"},
        {.label = "steps again", .method = METHOD_PHONE_PDR, .is_ours = true}};
    reproduce_paper_t paper = reproduce_phone_ekf;
    paper.rows = rows;
    paper.row_count = 5;
    paper.claim_count = 0;
    ck_assert_msg(try_paper(&paper, 1, 2u, NULL), "%s", failure.text);
    double mean_m[5];
    for (int i = 0; i < 5; i++) {
        mean_m[i] = reproduction.results[i].walks[0].m[REPRODUCE_MEAN];
    }
    ck_assert(mean_m[1] != mean_m[0]);
    ck_assert(mean_m[3] > mean_m[2] + 2.0);
    ASSERT_NEAR(mean_m[4], mean_m[2], 0.0, "m");
    reproduce_free(&reproduction);
}
END_TEST

START_TEST(a_row_that_cannot_be_set_is_told)
{
    static const reproduce_row_t rows[] = {
        {.label = "wrong", .method = METHOD_EKF, .settings = "step_length.no_such=1"}};
    reproduce_paper_t paper = reproduce_phone_ekf;
    paper.rows = rows;
    paper.row_count = 1;
    ck_assert(!try_paper(&paper, 1, 2u, NULL));
    ck_assert_ptr_nonnull(strstr(failure.text, "no_such"));
    reproduce_free(&reproduction);
    paper = reproduce_phone_ekf;
    paper.survey = "office/no_survey";
    ck_assert(!try_paper(&paper, 1, 2u, NULL));
    ck_assert_ptr_nonnull(strstr(failure.text, "office/no_survey"));
    reproduce_free(&reproduction);
}
END_TEST

/* ---- pictures ------------------------------------------------------------------------------- */

START_TEST(figures_are_drawn)
{
    static const char *const names[] = {"figure5.svg", "figure6.svg", "figure7.svg", "figure7b.svg",
                                        "figure8.svg"};
    char *out = platform_join(SCRATCH, "figures");
    measure(1, 1u, out);
    for (int i = 0; i < 5; i++) {
        check_picture(out, names[i]);
    }
    char *path = platform_join(out, names[0]);
    ck_assert_int_eq(count_of(content_of(path), ">leg "), 7);
    free(path);
    reproduce_free(&reproduction);
    free(out);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("reproduce_phone_ekf");
    suite_add(suite, "printed", what_is_printed_is_the_papers);
    suite_add(suite, "claims", claims_of_the_paper_are_those_of_its_table);
    suite_add(suite, "footfalls", errors_are_taken_at_the_footfalls_of_the_walk);
    suite_add(suite, "survey", the_survey_is_that_of_the_paper);
    suite_add(suite, "walks", walks_do_not_depend_on_each_other);
    suite_add(suite, "rows", a_row_has_its_own_plan_and_setting);
    suite_add(suite, "refusals", a_row_that_cannot_be_set_is_told);
    suite_add(suite, "pictures", figures_are_drawn);
    return suite;
}
