/* SPDX-License-Identifier: MIT */
#include "plot_chart.h"

#include "files.h"
#include "near.h"
#include "plot.h"
#include "suite.h"
#include "xml.h"

static failure_t failure;
static chart_line_t lines[2] = {{.name = "a < b & c"}, {.name = "empty"}};

static const char *draw(size_t count)
{
    const char *path = scratch("chart.svg");
    const chart_t chart = {.title = "<title> & more",
                           .subtitle = "\"quoted\"",
                           .x_name = "t [s]",
                           .y_name = "y < 1 & > 0",
                           .x_low = 2.0,
                           .x_high = 4.0,
                           .y_low = -1.0,
                           .y_high = 1.0,
                           .lines = lines,
                           .line_count = count};
    ck_assert_msg(chart_write(&chart, path, &failure), "%s", failure.text);
    return content_of(path);
}

/* Pixels of the points of the first line. */
static int read_points(const char *svg, double x[8], double y[8])
{
    const char *at = strstr(svg, "points=\"");
    int count = 0, length = 0;
    ck_assert_ptr_nonnull(at);
    for (at += strlen("points=\""); count < 8; count++, at += length) {
        if (sscanf(at, "%lf,%lf %n", &x[count], &y[count], &length) != 2) {
            break;
        }
    }
    return count;
}

START_TEST(points_are_added)
{
    for (int i = 0; i < 1000; i++) {
        chart_add(&lines[0], 0.5 * i, -0.25 * i);
    }
    ck_assert_uint_eq(lines[0].count, 1000u);
    for (int i = 0; i < 1000; i++) {
        ASSERT_NEAR(lines[0].points[i].x, 0.5 * i, 0.0, "");
        ASSERT_NEAR(lines[0].points[i].y, -0.25 * i, 0.0, "");
    }
    chart_free(&lines[0]);
    ck_assert_ptr_null(lines[0].points);
    ck_assert_uint_eq(lines[0].count, 0u);
    chart_add(&lines[0], 1.0, 2.0);
    ck_assert_uint_eq(lines[0].count, 1u);
    chart_free(&lines[0]);
}
END_TEST

START_TEST(a_chart_is_well_formed)
{
    chart_add(&lines[0], 2.0, 0.0);
    chart_add(&lines[0], 4.0, 1.0);
    for (size_t count = 0u; count <= 2u; count++) {
        const char *fault = xml_fault(draw(count));
        ck_assert_msg(fault == NULL, "not well formed at: %.60s", fault);
    }
    const char *svg = draw(2u);
    ck_assert_ptr_nonnull(strstr(svg, "a &lt; b &amp; c"));
    ck_assert_ptr_nonnull(strstr(svg, "y &lt; 1 &amp; > 0"));
    ck_assert_ptr_nonnull(strstr(svg, plot_colour(0u)));
    ck_assert_ptr_nonnull(strstr(svg, plot_colour(1u)));
    chart_free(&lines[0]);
}
END_TEST

START_TEST(both_axes_are_linear_and_end_at_the_edges)
{
    double x[8], y[8];
    const double at[5] = {2.0, 2.5, 3.0, 4.0, 9.0}, value[5] = {-1.0, 0.5, 0.0, 1.0, -7.0};
    for (int i = 0; i < 5; i++) {
        chart_add(&lines[0], at[i], value[i]);
    }
    ck_assert_int_eq(read_points(draw(1u), x, y), 5);
    ASSERT_NEAR(x[1], x[0] + 0.25 * (x[3] - x[0]), 0.06, "pixels");
    ASSERT_NEAR(x[2], 0.5 * (x[0] + x[3]), 0.06, "pixels");
    ASSERT_NEAR(x[4], x[3], 0.0, "pixels");
    ASSERT_NEAR(y[1], y[0] + 0.75 * (y[3] - y[0]), 0.06, "pixels");
    ASSERT_NEAR(y[2], 0.5 * (y[0] + y[3]), 0.06, "pixels");
    ASSERT_NEAR(y[4], y[0], 0.0, "pixels");
    ck_assert(x[3] > x[0] && y[3] < y[0]);
    chart_free(&lines[0]);
}
END_TEST

START_TEST(a_chart_that_cannot_be_written_is_told)
{
    const chart_t chart = {.title = "", .subtitle = "", .x_name = "", .y_name = ""};
    ck_assert(!chart_write(&chart, scratch("absent/chart.svg"), &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "absent/chart.svg"));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("plot_chart");
    suite_add(suite, "points", points_are_added);
    suite_add(suite, "well formed", a_chart_is_well_formed);
    suite_add(suite, "axes", both_axes_are_linear_and_end_at_the_edges);
    suite_add(suite, "unwritable", a_chart_that_cannot_be_written_is_told);
    return suite;
}
