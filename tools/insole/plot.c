/* SPDX-License-Identifier: MIT */
#include "plot.h"

#include <math.h>
#include <string.h>

#include "number.h"
#include "output.h"
#include "plot_frame.h"
#include "plot_plan.h"
#include "svg.h"

enum { TIME_SHADES = 32, ELLIPSES = 12, STYLE_ROOM = 160 };

/* A point that moves less than this on the page adds nothing to a line. */
static const double visible_pixels = 0.7;

static const char *const track_colours[PLOT_COLOURS] = {"#2166ac", "#d6604d", "#1b7837",
                                                        "#7b3294", "#b8860b", "#4d4d4d"};

const char *plot_colour(size_t number)
{
    return track_colours[number % PLOT_COLOURS];
}

/* Of the stretches whose state is not track. */
static const char *const state_colours[] = {"#bdbdbd", "#9e9e9e", "", "#ff9f1c", "#e31a1c"};

/* Dark blue over violet and orange to yellow. */
static const double shades[][3] = {
    {13, 8, 135}, {126, 3, 168}, {204, 71, 120}, {248, 149, 64}, {240, 218, 36}};

typedef struct {
    FILE *file;
    const plot_t *plot;
    plot_frame_t frame;
    double legend_y; /* where the next line of the legend goes */
} page_t;

/* ---- colours ---------------------------------------------------------------------------- */

/* Colour of a time: `shade` runs from 0 to TIME_SHADES - 1. */
static void shade_colour(int shade, char colour[8])
{
    double place = 4.0 * shade / (TIME_SHADES - 1);
    int below = place >= 4.0 ? 3 : (int)place;
    double share = place - below;
    int rgb[3];
    for (int i = 0; i < 3; i++) {
        rgb[i] = (int)lround(shades[below][i] + share * (shades[below + 1][i] - shades[below][i]));
    }
    snprintf(colour, 8u, "#%02x%02x%02x", (unsigned)rgb[0] & 0xffu, (unsigned)rgb[1] & 0xffu,
             (unsigned)rgb[2] & 0xffu);
}

/* Number of the colour that a row is drawn in: a shade, or below 0 that of a state. */
static int row_shade(const track_t *track, size_t i)
{
    insole_fix_state_t state = track->rows[i].state;
    return state == INSOLE_FIX_TRACK ? (int)(i * TIME_SHADES / track->count) : -1 - (int)state;
}

static void row_colour(int shade, char colour[8])
{
    if (shade < 0) {
        memcpy(colour, state_colours[-1 - shade], 8u);
    } else {
        shade_colour(shade, colour);
    }
}

/* ---- lines ------------------------------------------------------------------------------ */

static bool is_visible_move(const page_t *page, const track_row_t *a, const track_row_t *b)
{
    return hypot(a->x_m - b->x_m, a->y_m - b->y_m) * page->frame.pixels_per_m > visible_pixels;
}

static void draw_point(const page_t *page, const track_row_t *row)
{
    svg_path_point(page->file, plot_x(&page->frame, row->x_m), plot_y(&page->frame, row->y_m));
}

/* A stretch of a track, thinned to what can be seen. */
static void draw_stretch(const page_t *page, const track_t *track, size_t from, size_t to,
                         const char *style)
{
    size_t drawn = from;
    svg_path_begin(page->file, style);
    draw_point(page, &track->rows[from]);
    for (size_t i = from + 1u; i <= to; i++) {
        if (i == to || is_visible_move(page, &track->rows[drawn], &track->rows[i])) {
            draw_point(page, &track->rows[i]);
            drawn = i;
        }
    }
    svg_path_end(page->file);
}

static void draw_whole(const page_t *page, const track_t *track, const char *style)
{
    if (track->count > 1u) {
        draw_stretch(page, track, 0u, track->count - 1u, style);
    }
}

static void draw_by_time(const page_t *page, const track_t *track)
{
    char colour[8], style[STYLE_ROOM];
    for (size_t from = 0u, to; from + 1u < track->count; from = to) {
        int shade = row_shade(track, from);
        for (to = from + 1u; to + 1u < track->count && row_shade(track, to) == shade; to++) {
        }
        row_colour(shade, colour);
        snprintf(style, sizeof style,
                 "stroke=\"%s\" stroke-width=\"2.4\" stroke-linejoin=\"round\" "
                 "stroke-linecap=\"round\"",
                 colour);
        draw_stretch(page, track, from, to, style);
    }
}

static void draw_truth(const page_t *page)
{
    const track_t *truth = page->plot->truth;
    draw_whole(page, truth, "stroke=\"#333333\" stroke-width=\"1.3\" stroke-dasharray=\"5 3\"");
    for (size_t i = 0u; truth->count <= 200u && i < truth->count; i++) {
        svg_circle(page->file, plot_x(&page->frame, truth->rows[i].x_m),
                   plot_y(&page->frame, truth->rows[i].y_m), 2.0, "fill=\"#333333\"");
    }
}

static void draw_tracks(const page_t *page)
{
    char style[STYLE_ROOM];
    if (page->plot->track_count == 1u) {
        draw_by_time(page, &page->plot->tracks[0]);
        return;
    }
    for (size_t i = 0u; i < page->plot->track_count; i++) {
        snprintf(style, sizeof style,
                 "stroke=\"%s\" stroke-width=\"2\" stroke-opacity=\"0.85\" "
                 "stroke-linejoin=\"round\"",
                 plot_colour(i));
        draw_whole(page, &page->plot->tracks[i], style);
    }
}

/* ---- marks ------------------------------------------------------------------------------ */

/* Half axes and direction of the ellipse of one sigma. */
static void draw_ellipse(const page_t *page, const track_row_t *row)
{
    double half_sum = 0.5 * (row->var_x_m2 + row->var_y_m2);
    double half_difference = 0.5 * (row->var_x_m2 - row->var_y_m2);
    double spread = hypot(half_difference, row->cov_xy_m2);
    double turn_rad = 0.5 * atan2(row->cov_xy_m2, half_difference);
    double scale = page->frame.pixels_per_m;
    if (!(half_sum > 0.0) || sqrt(half_sum + spread) * scale > 0.5 * page->frame.width) {
        return;
    }
    svg_ellipse(page->file, plot_x(&page->frame, row->x_m), plot_y(&page->frame, row->y_m),
                scale * sqrt(half_sum + spread), scale * sqrt(fmax(half_sum - spread, 0.0)),
                -57.29577951308232 * turn_rad,
                "fill=\"#2166ac\" fill-opacity=\"0.08\" stroke=\"#2166ac\" "
                "stroke-opacity=\"0.55\"");
}

static void draw_ellipses(const page_t *page)
{
    const track_t *track = &page->plot->tracks[0];
    for (size_t k = 1u; k <= ELLIPSES && page->plot->track_count == 1u; k++) {
        size_t i = k * track->count / ELLIPSES;
        if (i > 0u && track->rows[i - 1u].state != INSOLE_FIX_ALIGN) {
            draw_ellipse(page, &track->rows[i - 1u]);
        }
    }
}

static void draw_cloud(const page_t *page)
{
    const track_t *cloud = page->plot->cloud;
    for (size_t i = 0u; cloud != NULL && i < cloud->count; i++) {
        svg_circle(page->file, plot_x(&page->frame, cloud->rows[i].x_m),
                   plot_y(&page->frame, cloud->rows[i].y_m), 1.4,
                   "fill=\"#e66101\" fill-opacity=\"0.45\"");
    }
}

static void draw_start_mark(const page_t *page, double x, double y)
{
    svg_circle(page->file, x, y, 6.0, "fill=\"#1b9e4b\" stroke=\"#ffffff\" stroke-width=\"1.5\"");
}

static void draw_end_mark(const page_t *page, double x, double y)
{
    svg_rectangle(page->file, x - 5.5, y - 5.5, 11.0, 11.0,
                  "fill=\"#d7191c\" stroke=\"#ffffff\" stroke-width=\"1.5\"");
}

static void draw_marks(const page_t *page)
{
    for (size_t i = 0u; i < page->plot->track_count; i++) {
        const track_t *track = &page->plot->tracks[i];
        if (track->count > 0u) {
            const track_row_t *first = &track->rows[0], *last = &track->rows[track->count - 1u];
            draw_start_mark(page, plot_x(&page->frame, first->x_m),
                            plot_y(&page->frame, first->y_m));
            draw_end_mark(page, plot_x(&page->frame, last->x_m), plot_y(&page->frame, last->y_m));
        }
    }
}

/* ---- legend ----------------------------------------------------------------------------- */

static double legend_x(const page_t *page)
{
    return page->frame.right + 22.0;
}

static void write_legend(page_t *page, const char *text)
{
    svg_text(page->file, legend_x(page) + 34.0, page->legend_y + 4.0,
             "font-size=\"12\" fill=\"#333\"", text);
    page->legend_y += 22.0;
}

static void legend_line(page_t *page, const char *style, const char *text)
{
    svg_line(page->file, legend_x(page), page->legend_y, legend_x(page) + 26.0, page->legend_y,
             style);
    write_legend(page, text);
}

static void legend_tracks(page_t *page)
{
    char style[STYLE_ROOM];
    for (size_t i = 0u; i < page->plot->track_count; i++) {
        snprintf(style, sizeof style, "stroke=\"%s\" stroke-width=\"2.4\"", plot_colour(i));
        legend_line(page, style, page->plot->names[i]);
    }
}

/* The shades from the first to the last row, with their times. */
static void legend_time(page_t *page, const track_t *track)
{
    char colour[8], style[STYLE_ROOM], number[NUMBER_ROOM], label[NUMBER_ROOM + 4];
    double width = 130.0 / TIME_SHADES, y = page->legend_y - 6.0;
    for (int i = 0; i < TIME_SHADES; i++) {
        shade_colour(i, colour);
        snprintf(style, sizeof style, "fill=\"%s\"", colour);
        svg_rectangle(page->file, legend_x(page) + i * width, y, width + 0.3, 10.0, style);
    }
    snprintf(label, sizeof label, "%s s",
             number_fixed(number, 1e-6 * (double)track->rows[0].t_us, 1));
    svg_text(page->file, legend_x(page), y + 24.0, "font-size=\"11\" fill=\"#555\"", label);
    snprintf(label, sizeof label, "%s s",
             number_fixed(number, 1e-6 * (double)track->rows[track->count - 1u].t_us, 1));
    svg_text(page->file, legend_x(page) + 130.0, y + 24.0,
             "font-size=\"11\" fill=\"#555\" text-anchor=\"end\"", label);
    page->legend_y += 40.0;
}

static void legend_states(page_t *page, const track_t *track)
{
    bool seen[5] = {false};
    char style[STYLE_ROOM];
    for (size_t i = 0u; i < track->count; i++) {
        seen[track->rows[i].state] = true;
    }
    for (int state = 0; state < 5; state++) {
        if (seen[state] && state != INSOLE_FIX_TRACK) {
            snprintf(style, sizeof style, "stroke=\"%s\" stroke-width=\"2.4\"",
                     state_colours[state]);
            legend_line(page, style, track_state_name((insole_fix_state_t)state));
        }
    }
}

static bool has_plan(const plot_t *plot)
{
    return plot->site != NULL && plot->site->building.plan != NULL;
}

static bool has_aps(const plot_t *plot)
{
    return plot->site != NULL && plot->site->building.ap_count > 0u;
}

static void legend_building(page_t *page)
{
    if (has_aps(page->plot)) {
        plot_plan_mark(page->file, legend_x(page) + 13.0, page->legend_y);
        write_legend(page, "access point");
    }
    if (page->plot->cloud != NULL && page->plot->cloud->count > 0u) {
        svg_circle(page->file, legend_x(page) + 13.0, page->legend_y, 2.5, "fill=\"#e66101\"");
        write_legend(page, "particles at the end");
    }
}

static void draw_legend(page_t *page)
{
    const plot_t *plot = page->plot;
    page->legend_y = page->frame.top + 12.0;
    if (plot->track_count > 1u) {
        legend_tracks(page);
    } else if (plot->tracks[0].count > 0u) {
        legend_time(page, &plot->tracks[0]);
        legend_states(page, &plot->tracks[0]);
    }
    if (plot->truth != NULL) {
        legend_line(page, "stroke=\"#333333\" stroke-width=\"1.3\" stroke-dasharray=\"5 3\"",
                    "truth");
    }
    draw_start_mark(page, legend_x(page) + 13.0, page->legend_y);
    write_legend(page, "start");
    draw_end_mark(page, legend_x(page) + 13.0, page->legend_y);
    write_legend(page, "end");
    if (plot->track_count == 1u) {
        svg_ellipse(page->file, legend_x(page) + 13.0, page->legend_y, 11.0, 6.0, 0.0,
                    "fill=\"#2166ac\" fill-opacity=\"0.08\" stroke=\"#2166ac\" "
                    "stroke-opacity=\"0.55\"");
        write_legend(page, "one sigma");
    }
    legend_building(page);
}

/* ---- page ------------------------------------------------------------------------------- */

static plot_frame_t fit_frame(const plot_t *plot)
{
    plot_area_t area = plot_area_empty();
    for (size_t i = 0u; i < plot->track_count; i++) {
        plot_area_add(&area, &plot->tracks[i]);
    }
    if (plot->truth != NULL) {
        plot_area_add(&area, plot->truth);
    }
    if (has_plan(plot)) {
        plot_plan_area(&area, &plot->site->plan_file);
    }
    return plot_frame(area);
}

static void draw_building(const page_t *page)
{
    const plot_t *plot = page->plot;
    if (has_plan(plot)) {
        plot_plan_draw(page->file, &page->frame, &plot->site->plan_file);
    }
    if (has_aps(plot)) {
        plot_plan_draw_aps(page->file, &page->frame, &plot->site->plan_file, &plot->site->ap_file);
    }
}

void plot_draw(FILE *file, const plot_t *plot)
{
    page_t page = {file, plot, fit_frame(plot), 0.0};
    svg_begin(file, page.frame.width, page.frame.height);
    plot_frame_draw(file, &page.frame);
    draw_building(&page);
    svg_text(file, page.frame.left, 32.0, "font-size=\"19\" font-weight=\"bold\" fill=\"#222\"",
             plot->title);
    svg_text(file, page.frame.left, 54.0, "font-size=\"12.5\" fill=\"#666\"", plot->subtitle);
    draw_ellipses(&page);
    if (plot->truth != NULL) {
        draw_truth(&page);
    }
    draw_tracks(&page);
    draw_cloud(&page);
    draw_marks(&page);
    draw_legend(&page);
    svg_end(file);
}

bool plot_write(const plot_t *plot, const char *path, failure_t *failure)
{
    FILE *file;
    if (!output_open(&file, path, failure)) {
        return false;
    }
    svg_head(file);
    plot_draw(file, plot);
    return output_close(file, path, failure);
}
