/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200112L /* setenv */
#include "reproduced.h"

#include "memory.h"

static void measure(int runs, uint64_t seed, const char *out)
{
    measure_paper(&reproduce_two_order, runs, seed, out);
}

static int row_of(const char *label)
{
    return row_in(&reproduce_two_order, label);
}

/* ---- the table of the paper --------------------------------------------------------------- */

START_TEST(what_is_printed_is_the_papers)
{
    static const struct {
        const char *label;
        double printed_m[4];
    } table[] = {{"INS+EKF", {7.21, 0.02, 2.86, 3.88}},
                 {"PDR-only", {11.59, 0.02, 3.04, 5.73}},
                 {"two-order", {4.83, 0.01, 1.85, 2.19}}};
    for (int i = 0; i < 3; i++) {
        const reproduce_row_t *row = &reproduce_two_order.rows[row_of(table[i].label)];
        ck_assert(!row->is_ours);
        for (int k = 0; k < 4; k++) {
            reproduce_figure_t column = reproduce_two_order.columns[k];
            ASSERT_NEAR(row->printed.m[column], table[i].printed_m[k], 0.0, "m");
        }
    }
    ck_assert_int_eq(reproduce_two_order.column_count, 4);
    ck_assert(!(reproduce_two_order.rows[row_of("Wi-Fi only")].printed.m[REPRODUCE_MEAN] > 0.0));
}
END_TEST

START_TEST(claims_name_rows_that_are_there)
{
    check_claims(&reproduce_two_order);
}
END_TEST

/* ---- what is measured ---------------------------------------------------------------------- */

/* By hand from the errors, walk by walk; all walks have about as many points. */
START_TEST(figures_are_those_of_the_errors)
{
    measure(2, 3u, NULL);
    for (int row = 0; row < reproduce_two_order.row_count; row++) {
        const reproduce_result_t *result = &reproduction.results[row];
        reproduce_figures_t means = reproduce_means(&reproduction, row);
        double sum = 0.0, high = 0.0, low = 1e9;
        for (size_t i = 0u; i < result->error_count; i++) {
            ck_assert(result->errors_m[i] >= 0.0 && result->errors_m[i] < 60.0);
            sum += result->errors_m[i];
            high = fmax(high, result->errors_m[i]);
            low = fmin(low, result->errors_m[i]);
        }
        const double *of_first = result->walks[0].m, *of_second = result->walks[1].m;
        ASSERT_NEAR(means.m[REPRODUCE_MEAN], sum / (double)result->error_count,
                    0.02 * means.m[REPRODUCE_MEAN], "m");
        ASSERT_NEAR(fmax(of_first[REPRODUCE_MAX], of_second[REPRODUCE_MAX]), high, 0.0, "m");
        ASSERT_NEAR(fmin(of_first[REPRODUCE_MIN], of_second[REPRODUCE_MIN]), low, 0.0, "m");
        ASSERT_NEAR(hypot(of_first[REPRODUCE_MEAN], of_first[REPRODUCE_STD]),
                    of_first[REPRODUCE_RMS], 1e-9, "m");
        ASSERT_NEAR(means.m[REPRODUCE_MAX],
                    0.5 * (of_first[REPRODUCE_MAX] + of_second[REPRODUCE_MAX]), 1e-9, "m");
        ck_assert(means.m[REPRODUCE_MIN] <= means.m[REPRODUCE_MEAN] &&
                  means.m[REPRODUCE_MEAN] <= means.m[REPRODUCE_RMS] &&
                  means.m[REPRODUCE_RMS] <= means.m[REPRODUCE_MAX]);
        ck_assert_uint_eq(result->error_count, reproduction.results[0].error_count);
    }
    reproduce_free(&reproduction);
}
END_TEST

START_TEST(walks_do_not_depend_on_each_other)
{
    measure(2, 7u, NULL);
    check_walk_alone(&reproduce_two_order, 1, 8u);
}
END_TEST

START_TEST(equal_seeds_give_equal_tables)
{
    measure(1, 1u, NULL);
    char *table = memory_text(printed(reproduce_print)),
         *json = memory_text(printed(reproduce_json));
    reproduce_free(&reproduction);
    measure(1, 1u, NULL);
    ck_assert_str_eq(printed(reproduce_print), table);
    ck_assert_str_eq(printed(reproduce_json), json);
    reproduce_free(&reproduction);
    measure(1, 2u, NULL);
    ck_assert_str_ne(printed(reproduce_print), table);
    ck_assert_str_ne(printed(reproduce_json), json);
    reproduce_free(&reproduction);
    free(table);
    free(json);
}
END_TEST

START_TEST(particles_alone_begin_where_radio_says)
{
    measure(1, 1u, NULL);
    int by_radio = row_of("two-order"), told = row_of("two-order, true start");
    const double *vague_m = reproduction.results[by_radio].errors_m;
    const double *true_m = reproduction.results[told].errors_m;
    ck_assert_msg(vague_m[0] > 1.0, "%f", vague_m[0]);
    ck_assert_msg(true_m[0] < 0.5, "%f", true_m[0]);
    reproduce_free(&reproduction);
}
END_TEST

/* ---- what is told ---------------------------------------------------------------------------- */

START_TEST(the_table_has_all_rows_and_claims)
{
    measure(1, 4u, NULL);
    const char *text = printed(reproduce_print);
    for (int i = 0; i < reproduce_two_order.row_count; i++) {
        char label[64];
        snprintf(label, sizeof label, "\n%s ", reproduce_two_order.rows[i].label);
        ck_assert_msg(strstr(text, label) != NULL, "no row%s", label);
    }
    for (int i = 0; i < reproduce_two_order.claim_count; i++) {
        ck_assert_ptr_nonnull(strstr(text, reproduce_two_order.claims[i].claim));
    }
    ck_assert_ptr_nonnull(strstr(text, "  11.59   0.02   3.04   5.73\n"));
    ck_assert_ptr_nonnull(strstr(text, "\nby our defaults, on the same logs\nins "));
    reproduce_free(&reproduction);
}
END_TEST

/* Two walks with errors made up: 1 - 3 / 2 = -50 %. */
START_TEST(claims_say_lower_and_higher)
{
    static const reproduce_row_t rows[] = {
        {.label = "slow", .method = METHOD_INS, .printed = {{9.0, 0.0, 6.0, 7.0, 8.0}}},
        {.label = "quick", .method = METHOD_BEST, .is_ours = true}};
    static const reproduce_claim_t claims[] = {{1, 0, REPRODUCE_MEAN, false, "first"},
                                               {1, 0, REPRODUCE_MEAN, true, "second"},
                                               {0, 1, REPRODUCE_MEAN, false, "third"},
                                               {1, 0, REPRODUCE_STD, true, "fourth"}};
    static const reproduce_figure_t columns[] = {REPRODUCE_MEAN, REPRODUCE_STD, REPRODUCE_MAX};
    static const char *const notes[] = {"a note", NULL};
    static const reproduce_paper_t paper = {.name = "Made",
                                            .table = "table 9",
                                            .scenario = "up",
                                            .columns = columns,
                                            .column_count = 3,
                                            .notes = notes,
                                            .rows = rows,
                                            .row_count = 2,
                                            .claims = claims,
                                            .claim_count = 4};
    reproduce_figures_t slow[] = {{{1.0, 0.0, 1.0, 1.0, 0.5}}, {{5.0, 0.0, 3.0, 4.0, 2.5}}};
    reproduce_figures_t quick[] = {{{4.0, 0.0, 2.0, 3.0, 2.0}}, {{4.0, 0.0, 4.0, 4.0, 2.0}}};
    reproduction.paper = &paper;
    reproduction.request = request_of(2, 5u, NULL);
    reproduction.results[0].walks = slow;
    reproduction.results[1].walks = quick;
    const char *text = printed(reproduce_print);
    ck_assert_ptr_nonnull(strstr(text, "[Made] table 9, 2 simulated walks of up, seed 5 to 6\n"));
    ck_assert_ptr_nonnull(strstr(text, "quick against slow: mean 50.0 % higher (first)\n"));
    ck_assert_ptr_nonnull(
        strstr(text, "quick against slow as printed: mean 50.0 % lower (second)\n"));
    ck_assert_ptr_nonnull(strstr(text, "slow against quick: mean 33.3 % lower (third)\n"));
    ck_assert_ptr_nonnull(
        strstr(text, "   2.00   1.50   3.00   1.00   3.00     6.00   8.00   9.00\n"));
    ck_assert_ptr_nonnull(
        strstr(text, "quick against slow as printed: std 75.0 % lower (fourth)\n"));
    ck_assert_ptr_nonnull(
        strstr(text, "   mean    std    max    low   high     mean    std    max\n"));
    ck_assert_ptr_nonnull(strstr(text, "\na note\n"));
    ck_assert_ptr_nonnull(strstr(printed(reproduce_json), "\"share_lower\": -0.5000"));
}
END_TEST

/* ---- files ------------------------------------------------------------------------------------
 */

START_TEST(figures_are_drawn)
{
    static const char *const names[] = {"figure5.svg", "figure6a.svg", "figure6b.svg",
                                        "figure7.svg"};
    char *out = platform_join(SCRATCH, "figures");
    measure(1, 1u, out);
    for (int i = 0; i < 4; i++) {
        check_picture(out, names[i]);
    }
    reproduce_free(&reproduction);
    free(out);
}
END_TEST

START_TEST(walks_leave_nothing_behind)
{
    measure(1, 1u, NULL);
    char *folder = platform_join(reproduction.folder, "");
    char *log = platform_join(reproduction.folder, "log.csv");
    ck_assert(platform_is_folder(folder));
    ck_assert_uint_gt(platform_file_size(log), 100000u);
    reproduce_free(&reproduction);
    ck_assert(!platform_is_folder(folder));
    free(folder);
    free(log);
}
END_TEST

START_TEST(what_cannot_be_done_is_told)
{
    reproduce_request_t request = request_of(1, 1u, NULL);
    request.maps = "nowhere";
    ck_assert(reproduce_begin(&reproduction, &reproduce_two_order, &request, &failure));
    ck_assert(!reproduce_measure(&reproduction, &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_ptr_nonnull(strstr(failure.text, "nowhere/student_centre"));
    reproduce_free(&reproduction);

    request = request_of(1, 1u, scratch("absent/figures"));
    ck_assert(!reproduce_begin(&reproduction, &reproduce_two_order, &request, &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "absent/figures"));
    reproduce_free(&reproduction);

    ck_assert_int_eq(setenv("TMPDIR", scratch("absent"), 1), 0);
    request = request_of(1, 1u, NULL);
    ck_assert(!reproduce_begin(&reproduction, &reproduce_two_order, &request, &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "TMPDIR"));
    reproduce_free(&reproduction);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("reproduce");
    suite_add(suite, "printed", what_is_printed_is_the_papers);
    suite_add(suite, "claims", claims_name_rows_that_are_there);
    suite_add(suite, "figures", figures_are_those_of_the_errors);
    suite_add(suite, "walks", walks_do_not_depend_on_each_other);
    suite_add(suite, "determinism", equal_seeds_give_equal_tables);
    suite_add(suite, "start", particles_alone_begin_where_radio_says);
    suite_add(suite, "table", the_table_has_all_rows_and_claims);
    suite_add(suite, "ratios", claims_say_lower_and_higher);
    suite_add(suite, "pictures", figures_are_drawn);
    suite_add(suite, "scratch", walks_leave_nothing_behind);
    suite_add(suite, "refusals", what_cannot_be_done_is_told);
    return suite;
}
