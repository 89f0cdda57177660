/* SPDX-License-Identifier: MIT */
#include "plot.h"

#include <math.h>
#include <stdlib.h>

#include "files.h"
#include "json.h"
#include "near.h"
#include "plot_frame.h"
#include "suite.h"
#include "svg.h"
#include "xml.h"

static track_t track, truth, other;
static failure_t failure;

static void add(track_t *to, int64_t t_us, double x, double y, insole_fix_state_t state)
{
    const track_row_t row = {t_us, x, y, 0.0, 0.0, 0.04, 0.01, 0.09, 0.0, 0.0, state};
    track_add(to, &row);
}

static void make_spiral(track_t *to, int count)
{
    for (int i = 0; i < count; i++) {
        double angle = 0.02 * i, radius = 1.0 + 0.01 * i;
        add(to, 100000 * i, radius * cos(angle), radius * sin(angle),
            i < 20          ? INSOLE_FIX_ALIGN
            : i % 400 > 350 ? INSOLE_FIX_COAST
                            : INSOLE_FIX_TRACK);
    }
}

static const char *draw(size_t tracks, const track_t *with_truth, const char *title)
{
    static const char *const names[] = {"ins", "pdr <&>"};
    static track_t both[2];
    const char *path = scratch("plot.svg");
    both[0] = track;
    both[1] = other;
    plot_t plot = {title, "a & b < c > d \"e\"", both, names, tracks, with_truth, NULL, NULL};
    ck_assert_msg(plot_write(&plot, path, &failure), "%s", failure.text);
    return content_of(path);
}

static void expect_well_formed(const char *text)
{
    const char *fault = xml_fault(text);
    ck_assert_msg(fault == NULL, "not well formed at: %.60s", fault);
}

/* ---- the checker itself ----------------------------------------------------------------- */

START_TEST(the_checker_finds_faults)
{
    static const char *const good[] = {"<a/>",
                                       "<?xml version=\"1.0\"?>\n<a b=\"c\"><d/>x&lt;</a>\n"};
    static const char *const bad[] = {"",           "<a>",      "<a></b>",      "</a>",
                                      "<a/><b/>",   "<a b=c/>", "<a b=\"<\"/>", "<a>&x;</a>",
                                      "<a b=\"c/>", "text<a/>", "<a>\x01</a>",  "<a b=\"&\"/>"};
    for (size_t i = 0u; i < sizeof good / sizeof good[0]; i++) {
        expect_well_formed(good[i]);
    }
    for (size_t i = 0u; i < sizeof bad / sizeof bad[0]; i++) {
        ck_assert_msg(xml_fault(bad[i]) != NULL, "%s", bad[i]);
    }
}
END_TEST

/* ---- pictures --------------------------------------------------------------------------- */

START_TEST(a_plot_is_well_formed)
{
    make_spiral(&track, 2000);
    make_spiral(&truth, 300);
    expect_well_formed(draw(1u, NULL, "walk"));
    expect_well_formed(draw(1u, &truth, "<walk> & \"more\" \x01\x1b"));
    make_spiral(&other, 77);
    expect_well_formed(draw(2u, &truth, "both"));
}
END_TEST

START_TEST(a_plot_shows_what_there_is)
{
    make_spiral(&track, 2000);
    const char *text = draw(1u, NULL, "walk");
    ck_assert_int_eq(count_of(text, ">align<"), 1);
    ck_assert_int_eq(count_of(text, ">coast<"), 1);
    ck_assert_int_eq(count_of(text, ">lost<"), 0);
    ck_assert_int_eq(count_of(text, ">truth<"), 0);
    ck_assert_int_eq(count_of(text, ">start<"), 1);
    ck_assert_int_eq(count_of(text, ">x [m]<"), 1);
    ck_assert_int_eq(count_of(text, "<ellipse"), 13); /* twelve, and that of the legend */
    ck_assert_int_ge(count_of(text, "<polyline"), 32);
    make_spiral(&truth, 30);
    text = draw(1u, &truth, "walk");
    ck_assert_int_eq(count_of(text, ">truth<"), 1);
    ck_assert_int_eq(count_of(text, "stroke-dasharray"), 2);
    make_spiral(&other, 50);
    text = draw(2u, NULL, "both");
    ck_assert_int_eq(count_of(text, ">ins<"), 1);
    ck_assert_int_eq(count_of(text, ">pdr &lt;&amp;><"), 1);
    ck_assert_int_eq(count_of(text, "<polyline"), 2);
}
END_TEST

START_TEST(hardly_anything_can_be_drawn_too)
{
    expect_well_formed(draw(1u, NULL, "nothing"));
    add(&track, 0, 5.0, -7.0, INSOLE_FIX_TRACK);
    expect_well_formed(draw(1u, NULL, "a point"));
    add(&truth, 0, 5.0, -7.0, INSOLE_FIX_TRACK);
    expect_well_formed(draw(1u, &truth, "two points"));
    add(&track, 1, (double)NAN, 0.0, INSOLE_FIX_LOST);
    add(&track, 2, 1e6, 1e6, INSOLE_FIX_LOST);
    const char *text = draw(1u, &truth, "far away");
    expect_well_formed(text);
    ck_assert_int_le(count_of(text, "<text"), 60);
}
END_TEST

START_TEST(long_walks_do_not_make_large_files)
{
    for (int i = 0; i < 200000; i++) { /* 5.5 hours round and round */
        add(&track, 100000 * (int64_t)i, 10.0 * cos(1e-4 * i), 10.0 * sin(1e-4 * i),
            INSOLE_FIX_TRACK);
    }
    ck_assert_uint_lt(strlen(draw(1u, NULL, "long")), 150000u);
}
END_TEST

/* ---- the frame -------------------------------------------------------------------------- */

START_TEST(both_axes_have_one_scale_and_all_is_inside)
{
    srand(19);
    for (int trial = 0; trial < 200; trial++) {
        plot_area_t area = plot_area_empty();
        track_free(&track);
        for (int i = 0; i < 5; i++) {
            add(&track, i, (rand() % 20001 - 10000) * 0.01, (rand() % 2001 - 1000) * 0.1,
                INSOLE_FIX_TRACK);
        }
        plot_area_add(&area, &track);
        plot_frame_t frame = plot_frame(area);
        ASSERT_NEAR(plot_x(&frame, 1.0) - plot_x(&frame, 0.0), frame.pixels_per_m, 1e-6, "px");
        ASSERT_NEAR(plot_y(&frame, 0.0) - plot_y(&frame, 1.0), frame.pixels_per_m, 1e-6, "px");
        ASSERT_AT_MOST(frame.bottom - frame.top, 800.0, "px");
        ASSERT_AT_LEAST(frame.bottom - frame.top, 319.9, "px");
        for (size_t i = 0u; i < track.count; i++) {
            double x = plot_x(&frame, track.rows[i].x_m), y = plot_y(&frame, track.rows[i].y_m);
            ck_assert(x >= frame.left && x <= frame.right && y >= frame.top && y <= frame.bottom);
        }
    }
    track_free(&track);
}
END_TEST

/* What is known of the building lies under the track, and all of it is on the page. */
START_TEST(a_plot_shows_the_building)
{
    static site_t site;
    static const char *const name = "best";
    insole_propagation_config_t propagation = insole_propagation_defaults;
    const char *plan = scratch_file("plan.csv", "outline,-40,-40,40,-40,40,40,-40,40\n");
    const char *aps = scratch_file("aps.csv", "id,x,y\nnorth & south,3,4\nB,-5,6\n");
    ck_assert_msg(site_open(&site, plan, aps, NULL, &propagation, &failure), "%s", failure.text);
    make_spiral(&track, 100);
    make_spiral(&other, 7);
    plot_t plot = {"a", "b", &track, &name, 1u, NULL, &site, &other};
    ck_assert(plot_write(&plot, scratch("building.svg"), &failure));
    char with[TEXT_ROOM];
    strcpy(with, content_of(scratch("building.svg")));
    expect_well_formed(with);
    ck_assert_ptr_nonnull(strstr(with, ">north &amp; south<"));
    ck_assert_ptr_nonnull(strstr(with, ">access point<"));
    ck_assert_ptr_nonnull(strstr(with, ">particles at the end<"));
    ck_assert_int_eq(count_of(with, " r=\"1.40\""), 7);
    plot.site = NULL;
    plot.cloud = NULL;
    ck_assert(plot_write(&plot, scratch("building.svg"), &failure));
    const char *without = content_of(scratch("building.svg"));
    ck_assert_ptr_null(strstr(without, ">access point<"));
    ck_assert_ptr_null(strstr(without, ">particles at the end<"));
    track_free(&track);
    track_free(&other);
    site_free(&site);
}
END_TEST

START_TEST(plots_that_cannot_be_written_are_told)
{
    static const char *const name = "ins";
    plot_t plot = {"a", "b", &track, &name, 1u, NULL, NULL, NULL};
    ck_assert(!plot_write(&plot, SCRATCH "/no/such/plot.svg", &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
}
END_TEST

/* ---- JSON ------------------------------------------------------------------------------- */

START_TEST(json_is_written)
{
    FILE *file = tmpfile();
    json_t json;
    json_begin(&json, file);
    json_object(&json, NULL);
    json_text(&json, "text", "a \"b\" \\ \n c");
    json_number(&json, "half", 0.5, 2);
    json_number(&json, "unknown", (double)NAN, 2);
    json_whole(&json, "whole", -3);
    json_flag(&json, "flag", true);
    json_array(&json, "empty");
    json_end(&json);
    json_array(&json, "list");
    json_whole(&json, NULL, 1);
    json_object(&json, NULL);
    json_end(&json);
    json_end(&json);
    json_end(&json);
    ck_assert_str_eq(text_of(file), "{\n"
                                    "  \"text\": \"a \\\"b\\\" \\\\ \\u000a c\",\n"
                                    "  \"half\": 0.50,\n"
                                    "  \"unknown\": null,\n"
                                    "  \"whole\": -3,\n"
                                    "  \"flag\": true,\n"
                                    "  \"empty\": [],\n"
                                    "  \"list\": [\n"
                                    "    1,\n"
                                    "    {}\n"
                                    "  ]\n"
                                    "}\n");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("plot");
    suite_add(suite, "checker", the_checker_finds_faults);
    suite_add(suite, "well formed", a_plot_is_well_formed);
    suite_add(suite, "content", a_plot_shows_what_there_is);
    suite_add(suite, "hardly anything", hardly_anything_can_be_drawn_too);
    suite_add(suite, "size", long_walks_do_not_make_large_files);
    suite_add(suite, "frame", both_axes_have_one_scale_and_all_is_inside);
    suite_add(suite, "building", a_plot_shows_the_building);
    suite_add(suite, "unwritable", plots_that_cannot_be_written_are_told);
    suite_add(suite, "json", json_is_written);
    return suite;
}
