/* SPDX-License-Identifier: MIT */
#include "report.h"

#include <stdlib.h>

#include "files.h"
#include "near.h"
#include "suite.h"
#include "xml.h"

static replay_facts_t facts;
static track_t track, truth;
static failure_t failure;

static void add(track_t *to, double t_s, double x_m, double sigma_m)
{
    track_row_t row;
    memset(&row, 0, sizeof row);
    row.t_us = (int64_t)(1e6 * t_s);
    row.x_m = x_m;
    row.var_x_m2 = sigma_m * sigma_m;
    row.state = INSOLE_FIX_TRACK;
    track_add(to, &row);
}

/* `rows` rows, ten a second, 1 m/s; they err by 0.5 m. */
static void make(size_t rows)
{
    memset(&facts, 0, sizeof facts);
    facts.method = METHOD_INS;
    facts.fixes = rows;
    for (size_t i = 0u; i < rows; i++) {
        add(&track, 0.1 * (double)i, 0.1 * (double)i, 0.25);
        add(&truth, 0.1 * (double)i, 0.1 * (double)i + 0.5, 0.0);
    }
}

static void clear(void)
{
    track_free(&track);
    track_free(&truth);
}

static const char *written(const char *title, bool has_truth)
{
    static const char *const names[] = {"track"};
    const char *path = scratch("page.html");
    const summary_t summary = {"foot <&>", "ins", &facts, NULL, NULL};
    plot_t plot;
    memset(&plot, 0, sizeof plot);
    plot.title = title;
    plot.subtitle = "";
    plot.tracks = &track;
    plot.names = names;
    plot.track_count = 1u;
    plot.truth = has_truth ? &truth : NULL;
    const report_t report = {&plot, &summary};
    ck_assert_msg(report_write(&report, path, &failure), "%s", failure.text);
    return content_of(path);
}

/* What follows the doctype is well-formed XML as well. */
static void expect_well_formed(const char *page)
{
    const char *const doctype = "<!DOCTYPE html>\n";
    ck_assert_int_eq(strncmp(page, doctype, strlen(doctype)), 0);
    const char *fault = xml_fault(page + strlen(doctype));
    ck_assert_msg(fault == NULL, "not well formed at: %.60s", fault);
}

START_TEST(a_page_tells_all)
{
    make(300u);
    const char *page = written("walk <1> & \"2\"", true);
    expect_well_formed(page);
    ck_assert_int_eq(count_of(page, "<svg "), 2);
    ck_assert_int_eq(count_of(page, "<?xml"), 0);
    ck_assert_ptr_nonnull(strstr(page, "<title>walk &lt;1> &amp; \"2\"</title>"));
    ck_assert_ptr_nonnull(strstr(page, "foot &lt;&amp;> tracker, method ins\n"));
    ck_assert_ptr_nonnull(strstr(page, ">one sigma</text>"));
    ck_assert_ptr_nonnull(strstr(page, ">error</text>"));
    clear();
}
END_TEST

START_TEST(without_truth_there_is_no_error_to_show)
{
    make(300u);
    const char *page = written("walk", false);
    expect_well_formed(page);
    ck_assert_ptr_null(strstr(page, ">error</text>"));
    ck_assert_ptr_nonnull(strstr(page, ">one sigma</text>"));
    clear();
}
END_TEST

/* Neither nothing nor a day of it spoils the page. */
START_TEST(any_length_has_its_page)
{
    static const size_t lengths[] = {0u, 1u, 2u, 100000u};
    make(lengths[_i]);
    const char *page = written("walk", lengths[_i] > 0u);
    expect_well_formed(page);
    ck_assert_int_eq(count_of(page, "<svg "), lengths[_i] < 2u ? 1 : 2);
    ASSERT_AT_MOST((double)strlen(page), 3e5, "bytes");
    clear();
}
END_TEST

START_TEST(a_file_that_cannot_be_written_is_told)
{
    static const char *const names[] = {"track"};
    const summary_t summary = {"foot", "ins", &facts, NULL, NULL};
    plot_t plot;
    make(10u);
    memset(&plot, 0, sizeof plot);
    plot.title = plot.subtitle = "";
    plot.tracks = &track;
    plot.names = names;
    plot.track_count = 1u;
    const report_t report = {&plot, &summary};
    ck_assert(!report_write(&report, "no such folder/page.html", &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "no such folder/page.html"));
    clear();
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("report");
    suite_add(suite, "page", a_page_tells_all);
    suite_add(suite, "no truth", without_truth_there_is_no_error_to_show);
    suite_add_loop(suite, "lengths", any_length_has_its_page, 4);
    suite_add(suite, "no file", a_file_that_cannot_be_written_is_told);
    return suite;
}
