/* SPDX-License-Identifier: MIT */
#include "plot_frame.h"

#include <math.h>

#include "number.h"
#include "svg.h"

static const double page_width = 960.0;
static const double margin_left = 70.0, margin_right = 200.0, margin_top = 70.0;
static const double margin_bottom = 60.0;
static const double field_height_low = 320.0, field_height_high = 800.0;

/* Nobody wants to see the noise of a sensor that lay on a desk fill the page. */
static const double smallest_extent_m = 2.0;

plot_area_t plot_area_empty(void)
{
    plot_area_t area = {1.0, -1.0, 1.0, -1.0};
    return area;
}

void plot_area_add_place(plot_area_t *area, double x_m, double y_m)
{
    if (area->x_low > area->x_high) {
        area->x_low = area->x_high = x_m;
        area->y_low = area->y_high = y_m;
    }
    area->x_low = fmin(area->x_low, x_m);
    area->x_high = fmax(area->x_high, x_m);
    area->y_low = fmin(area->y_low, y_m);
    area->y_high = fmax(area->y_high, y_m);
}

void plot_area_add(plot_area_t *area, const track_t *track)
{
    for (size_t i = 0u; i < track->count; i++) {
        if (isfinite(track->rows[i].x_m) && isfinite(track->rows[i].y_m)) {
            plot_area_add_place(area, track->rows[i].x_m, track->rows[i].y_m);
        }
    }
}

/* Widens one side of the area about its middle. */
static void widen(double *low, double *high, double extent)
{
    double middle = 0.5 * (*low + *high);
    double half = 0.5 * fmax(extent, *high - *low);
    *low = middle - half;
    *high = middle + half;
}

plot_frame_t plot_frame(plot_area_t area)
{
    if (area.x_low > area.x_high) {
        plot_area_add_place(&area, 0.0, 0.0);
    }
    widen(&area.x_low, &area.x_high, fmax(1.1 * (area.x_high - area.x_low), smallest_extent_m));
    widen(&area.y_low, &area.y_high, fmax(1.1 * (area.y_high - area.y_low), smallest_extent_m));
    double field_width = page_width - margin_left - margin_right;
    double extent_x = area.x_high - area.x_low, extent_y = area.y_high - area.y_low;
    double height =
        fmin(fmax(field_width * extent_y / extent_x, field_height_low), field_height_high);
    plot_frame_t frame;
    frame.pixels_per_m = fmin(field_width / extent_x, height / extent_y);
    widen(&area.x_low, &area.x_high, field_width / frame.pixels_per_m);
    widen(&area.y_low, &area.y_high, height / frame.pixels_per_m);
    frame.area = area;
    frame.width = page_width;
    frame.height = margin_top + height + margin_bottom;
    frame.left = margin_left;
    frame.right = page_width - margin_right;
    frame.top = margin_top;
    frame.bottom = margin_top + height;
    return frame;
}

double plot_x(const plot_frame_t *frame, double x_m)
{
    return frame->left + (x_m - frame->area.x_low) * frame->pixels_per_m;
}

double plot_y(const plot_frame_t *frame, double y_m)
{
    return frame->bottom - (y_m - frame->area.y_low) * frame->pixels_per_m;
}

double plot_round(double limit)
{
    double power = pow(10.0, floor(log10(limit)));
    double share = limit / power;
    return power * (share >= 5.0 ? 5.0 : share >= 2.0 ? 2.0 : 1.0);
}

static void draw_x_ticks(FILE *file, const plot_frame_t *frame, double step)
{
    char number[NUMBER_ROOM];
    for (double n = ceil(frame->area.x_low / step); n * step <= frame->area.x_high; n += 1.0) {
        double x = plot_x(frame, n * step);
        svg_line(file, x, frame->top, x, frame->bottom, "stroke=\"#ececec\"");
        svg_text(file, x, frame->bottom + 18.0,
                 "font-size=\"11\" fill=\"#555\" text-anchor=\"middle\"",
                 number_short(number, n * step));
    }
}

static void draw_y_ticks(FILE *file, const plot_frame_t *frame, double step)
{
    char number[NUMBER_ROOM];
    for (double n = ceil(frame->area.y_low / step); n * step <= frame->area.y_high; n += 1.0) {
        double y = plot_y(frame, n * step);
        svg_line(file, frame->left, y, frame->right, y, "stroke=\"#ececec\"");
        svg_text(file, frame->left - 8.0, y + 4.0,
                 "font-size=\"11\" fill=\"#555\" text-anchor=\"end\"",
                 number_short(number, n * step));
    }
}

static void draw_scale_bar(FILE *file, const plot_frame_t *frame)
{
    char number[NUMBER_ROOM], label[NUMBER_ROOM + 4];
    double length_m = plot_round(120.0 / frame->pixels_per_m);
    double right = frame->right, y = frame->bottom + 42.0;
    double left = right - length_m * frame->pixels_per_m;
    const char *style = "stroke=\"#333\" stroke-width=\"2\"";
    svg_line(file, left, y, right, y, style);
    svg_line(file, left, y - 5.0, left, y + 5.0, style);
    svg_line(file, right, y - 5.0, right, y + 5.0, style);
    snprintf(label, sizeof label, "%s m", number_short(number, length_m));
    svg_text(file, 0.5 * (left + right), y - 7.0,
             "font-size=\"12\" fill=\"#333\" text-anchor=\"middle\"", label);
}

void plot_frame_draw(FILE *file, const plot_frame_t *frame)
{
    double step = plot_round(130.0 / frame->pixels_per_m);
    double middle_y = 0.5 * (frame->top + frame->bottom);
    svg_rectangle(file, 0.0, 0.0, frame->width, frame->height, "fill=\"#ffffff\"");
    draw_x_ticks(file, frame, step);
    draw_y_ticks(file, frame, step);
    svg_rectangle(file, frame->left, frame->top, frame->right - frame->left,
                  frame->bottom - frame->top, "fill=\"none\" stroke=\"#999\"");
    svg_text(file, 0.5 * (frame->left + frame->right), frame->bottom + 42.0,
             "font-size=\"13\" fill=\"#333\" text-anchor=\"middle\"", "x [m]");
    fprintf(file, "<g transform=\"translate(22 %d) rotate(-90)\">\n", (int)middle_y);
    svg_text(file, 0.0, 0.0, "font-size=\"13\" fill=\"#333\" text-anchor=\"middle\"", "y [m]");
    fputs("</g>\n", file);
    draw_scale_bar(file, frame);
}
