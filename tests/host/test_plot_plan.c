/* SPDX-License-Identifier: MIT */
#include "plot_plan.h"

#include <stdlib.h>

#include "files.h"
#include "near.h"
#include "number.h"
#include "plan_page.h"
#include "suite.h"
#include "xml.h"

static site_t site;
static failure_t failure;

static const char plan_text[] =
    "loss,12\noutline,0,0,20,0,20,10,0,10\nhole,4,4,6,4,6,6,4,6\nwall,5,10,0,10,4\n"
    "wall,5,10,5.2,10,10\nwall,2.5,12,3,18,3\n";

static void open_site(const char *plan, const char *aps)
{
    bool is_good = site_open(&site, scratch_file("plan.csv", plan),
                             aps == NULL ? NULL : scratch_file("aps.csv", aps), NULL,
                             &insole_propagation_defaults, &failure);
    ck_assert_msg(is_good, "%s", failure.text);
}

static const char *draw(const char *plan, const char *aps)
{
    const char *path = scratch("plan.svg");
    open_site(plan, aps);
    ck_assert_msg(plan_page_write(&site, "A <plan> & more", "20 x 10 m", path, &failure), "%s",
                  failure.text);
    site_free(&site);
    const char *text = content_of(path), *fault = xml_fault(text);
    ck_assert_msg(fault == NULL, "not well formed at: %.60s", fault);
    return text;
}

START_TEST(everything_is_drawn)
{
    const char *text = draw(plan_text, "id,x,y\na&b,1,1\nhall,15,8\n");
    ck_assert_int_eq(count_of(text, "<polyline"), 3);                 /* inner walls */
    ck_assert_int_eq(count_of(text, "<polygon fill=\"#fdf8ec\""), 1); /* floor */
    ck_assert_int_eq(count_of(text, "<polygon fill=\"url(#hole)\""), 1);
    ck_assert_int_eq(count_of(text, "<polygon fill=\"none\""), 2);    /* rings */
    ck_assert_int_eq(count_of(text, "<polygon fill=\"#c2410c\""), 3); /* and in the legend */
    ck_assert_int_eq(count_of(text, ">a&amp;b<"), 1);
    ck_assert_int_eq(count_of(text, ">hall<"), 1);
    ck_assert_int_eq(count_of(text, ">A &lt;plan> &amp; more<"), 1);
    ck_assert_int_eq(count_of(text, ">wall, 2.5 dB<"), 1);
    ck_assert_int_eq(count_of(text, ">wall, 5 dB<"), 1);
    ck_assert_int_eq(count_of(text, ">wall, 12 dB<"), 1);
    ck_assert_int_eq(count_of(text, ">hole<"), 1);
    ck_assert_int_eq(count_of(text, ">access point<"), 1);
    ck_assert_int_eq(count_of(text, ">2 m<"), 1); /* scale bar */
}
END_TEST

START_TEST(what_is_not_there_is_not_in_the_legend)
{
    const char *text = draw("outline,0,0,20,0,20,10,0,10\n", NULL);
    ck_assert_int_eq(count_of(text, ">hole<"), 0);
    ck_assert_int_eq(count_of(text, ">access point<"), 0);
    ck_assert_int_eq(count_of(text, " dB<"), 0);
    ck_assert_int_eq(count_of(text, ">wall, loss not told<"), 1);
}
END_TEST

START_TEST(walls_lie_where_the_frame_puts_them)
{
    open_site(plan_text, NULL);
    plot_area_t area = plot_area_empty();
    plot_plan_area(&area, &site.plan_file);
    ck_assert(area.x_low == 0.0 && area.x_high == 20.0 && area.y_low == 0.0 && area.y_high == 10.0);
    plot_frame_t frame = plot_frame(area);
    FILE *file = tmpfile();
    plot_plan_draw(file, &frame, &site.plan_file);
    const char *text = text_of(file), *wall = strstr(text, "<polyline");
    ck_assert_ptr_nonnull(wall);
    char *rest;
    double x0 = strtod(strstr(wall, "points=\"") + 8, &rest), y0 = strtod(rest + 1, &rest);
    double x1 = strtod(rest + 1, &rest), y1 = strtod(rest + 1, &rest);
    ASSERT_NEAR(x0, plot_x(&frame, 10.0), 0.06, "px");
    ASSERT_NEAR(y0, plot_y(&frame, 0.0), 0.06, "px");
    ASSERT_NEAR(x1, x0, 0.11, "px");
    ASSERT_NEAR(y0 - y1, 4.0 * frame.pixels_per_m, 0.11, "px");
    site_free(&site);
}
END_TEST

static double width_of(double loss_db)
{
    char style[PLOT_PLAN_STYLE];
    return strtod(strstr(plot_plan_wall_style(style, loss_db), "stroke-width=\"") + 14, NULL);
}

static int brightness_of(double loss_db)
{
    char style[PLOT_PLAN_STYLE];
    unsigned colour;
    ck_assert_int_eq(sscanf(plot_plan_wall_style(style, loss_db), "stroke=\"#%6x\"", &colour), 1);
    return (int)((colour >> 16) + (colour >> 8 & 0xffu) + (colour & 0xffu));
}

START_TEST(walls_that_cost_more_are_thicker_and_darker)
{
    for (double loss_db = 0.0; loss_db < 14.0; loss_db += 2.0) {
        ck_assert(width_of(loss_db + 2.0) > width_of(loss_db));
        ck_assert_int_lt(brightness_of(loss_db + 2.0), brightness_of(loss_db));
    }
    ck_assert(width_of(200.0) == width_of(15.0));
    ck_assert_int_eq(brightness_of(200.0), brightness_of(15.0));
    ck_assert_int_lt(brightness_of(NUMBER_UNKNOWN), brightness_of(0.0));
}
END_TEST

/* Of access points in one place, names stand only where nothing else does. */
START_TEST(names_do_not_cover_each_other)
{
    char aps[2000];
    size_t length = (size_t)sprintf(aps, "id,x,y\n");
    for (int i = 0; i < 30; i++) {
        length += (size_t)sprintf(aps + length, "crowd-%02d,15,7\n", i);
    }
    const char *text = draw(plan_text, aps);
    ck_assert_int_ge(count_of(text, ">crowd-"), 2);
    ck_assert_int_le(count_of(text, ">crowd-"), 8);
    ck_assert_int_eq(count_of(text, "<polygon fill=\"#c2410c\""), 31);
}
END_TEST

START_TEST(names_keep_off_walls_where_they_can)
{
    const char *text =
        draw("outline,0,0,20,0,20,10,0,10\nwall,5,5.6,2,5.6,8\n", "id,x,y\nname,5.3,5\n");
    const char *name = strstr(text, ">name<");
    while (strncmp(name, "<text", 5u) != 0) {
        name--;
    }
    open_site("outline,0,0,20,0,20,10,0,10\n", NULL);
    plot_area_t area = plot_area_empty();
    plot_plan_area(&area, &site.plan_file);
    plot_frame_t frame = plot_frame(area);
    double left = strtod(strstr(name, "x=\"") + 3, NULL);
    ck_assert(left + 20.0 < plot_x(&frame, 5.3)); /* left of its mark, not across the wall */
    site_free(&site);
}
END_TEST

START_TEST(access_points_out_of_the_frame_are_left_out)
{
    const char *text = draw(plan_text, "id,x,y\nfar,500,1\nnear,1,1\n");
    ck_assert_int_eq(count_of(text, ">far<"), 0);
    ck_assert_int_eq(count_of(text, ">near<"), 1);
    ck_assert_int_eq(count_of(text, "<polygon fill=\"#c2410c\""), 2);
}
END_TEST

START_TEST(only_the_first_floor_is_drawn)
{
    const char *text = draw("floor,1,0,a\noutline,0,0,20,0,20,10,0,10\nfloor,2,3,b\n"
                            "outline,0,0,90,0,90,90\nwall,7,1,1,2,2\n",
                            NULL);
    ck_assert_int_eq(count_of(text, "<polyline"), 0);
    ck_assert_int_eq(count_of(text, "<polygon fill=\"none\""), 1);
    ck_assert_int_eq(count_of(text, ">wall, 7 dB<"), 0);
}
END_TEST

START_TEST(of_many_losses_the_legend_shows_some)
{
    char plan[4000];
    size_t length = (size_t)sprintf(plan, "outline,0,0,20,0,20,10,0,10\n");
    for (int i = 0; i < 60; i++) {
        length += (size_t)sprintf(plan + length, "wall,%d,%d,1,%d,2\n", i, 1 + i % 18, 1 + i % 18);
    }
    const char *text = draw(plan, NULL);
    ck_assert_int_eq(count_of(text, " dB<"), 12);
    ck_assert_int_eq(count_of(text, ">wall, 0 dB<"), 1);
    ck_assert_int_eq(count_of(text, ">wall, 59 dB<"), 1);
}
END_TEST

START_TEST(a_picture_that_cannot_be_written_is_told)
{
    open_site(plan_text, NULL);
    ck_assert(!plan_page_write(&site, "t", "s", SCRATCH "/absent/plan.svg", &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    site_free(&site);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("plot_plan");
    suite_add(suite, "everything", everything_is_drawn);
    suite_add(suite, "legend", what_is_not_there_is_not_in_the_legend);
    suite_add(suite, "places", walls_lie_where_the_frame_puts_them);
    suite_add(suite, "styles", walls_that_cost_more_are_thicker_and_darker);
    suite_add(suite, "crowd", names_do_not_cover_each_other);
    suite_add(suite, "names and walls", names_keep_off_walls_where_they_can);
    suite_add(suite, "out of the frame", access_points_out_of_the_frame_are_left_out);
    suite_add(suite, "floors", only_the_first_floor_is_drawn);
    suite_add(suite, "losses", of_many_losses_the_legend_shows_some);
    suite_add(suite, "unwritable", a_picture_that_cannot_be_written_is_told);
    return suite;
}
