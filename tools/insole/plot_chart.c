/* SPDX-License-Identifier: MIT */
#include "plot_chart.h"

#include <math.h>
#include <stdlib.h>

#include "memory.h"
#include "number.h"
#include "output.h"
#include "plot.h"
#include "plot_frame.h"
#include "svg.h"

enum { STYLE_ROOM = 160 };

static const double page_width = 960.0, page_height = 520.0;
static const double left = 70.0, right = 740.0, top = 70.0, bottom = 460.0;

void chart_add(chart_line_t *line, double x, double y)
{
    line->points = memory_room(line->points, &line->room, line->count + 1u, sizeof *line->points);
    line->points[line->count].x = x;
    line->points[line->count++].y = y;
}

void chart_free(chart_line_t *line)
{
    free(line->points);
    line->points = NULL;
    line->count = line->room = 0u;
}

static double share(double value, double low, double high)
{
    return fmin(fmax((value - low) / (high - low), 0.0), 1.0);
}

static double pixel_x(const chart_t *chart, double x)
{
    return left + share(x, chart->x_low, chart->x_high) * (right - left);
}

static double pixel_y(const chart_t *chart, double y)
{
    return bottom - share(y, chart->y_low, chart->y_high) * (bottom - top);
}

static void draw_x_axis(FILE *file, const chart_t *chart)
{
    char number[NUMBER_ROOM];
    double step = plot_round(0.2 * (chart->x_high - chart->x_low));
    for (double n = ceil(chart->x_low / step); n * step <= chart->x_high; n += 1.0) {
        double x = pixel_x(chart, n * step);
        svg_line(file, x, top, x, bottom, "stroke=\"#ececec\"");
        svg_text(file, x, bottom + 18.0, "font-size=\"11\" fill=\"#555\" text-anchor=\"middle\"",
                 number_short(number, n * step));
    }
    svg_text(file, 0.5 * (left + right), bottom + 42.0,
             "font-size=\"13\" fill=\"#333\" text-anchor=\"middle\"", chart->x_name);
}

static void draw_y_axis(FILE *file, const chart_t *chart)
{
    char number[NUMBER_ROOM];
    double step = plot_round(0.25 * (chart->y_high - chart->y_low));
    for (double n = ceil(chart->y_low / step); n * step <= chart->y_high; n += 1.0) {
        double y = pixel_y(chart, n * step);
        svg_line(file, left, y, right, y, "stroke=\"#ececec\"");
        svg_text(file, left - 8.0, y + 4.0, "font-size=\"11\" fill=\"#555\" text-anchor=\"end\"",
                 number_short(number, n * step));
    }
    fprintf(file, "<g transform=\"translate(22 %d) rotate(-90)\">\n", (int)(0.5 * (top + bottom)));
    svg_text(file, 0.0, 0.0, "font-size=\"13\" fill=\"#333\" text-anchor=\"middle\"",
             chart->y_name);
    fputs("</g>\n", file);
}

static void draw_line(FILE *file, const chart_t *chart, size_t number)
{
    const chart_line_t *line = &chart->lines[number];
    double legend_x = right + 22.0, legend_y = top + 12.0 + 22.0 * (double)number;
    char style[STYLE_ROOM];
    snprintf(style, sizeof style, "stroke=\"%s\" stroke-width=\"2\" stroke-linejoin=\"round\"",
             plot_colour(number));
    svg_path_begin(file, style);
    for (size_t i = 0u; i < line->count; i++) {
        svg_path_point(file, pixel_x(chart, line->points[i].x), pixel_y(chart, line->points[i].y));
    }
    svg_path_end(file);
    svg_line(file, legend_x, legend_y, legend_x + 26.0, legend_y, style);
    svg_text(file, legend_x + 34.0, legend_y + 4.0, "font-size=\"12\" fill=\"#333\"", line->name);
}

void chart_draw(FILE *file, const chart_t *chart)
{
    svg_begin(file, page_width, page_height);
    svg_rectangle(file, 0.0, 0.0, page_width, page_height, "fill=\"#ffffff\"");
    draw_x_axis(file, chart);
    draw_y_axis(file, chart);
    svg_rectangle(file, left, top, right - left, bottom - top, "fill=\"none\" stroke=\"#999\"");
    svg_text(file, left, 32.0, "font-size=\"19\" font-weight=\"bold\" fill=\"#222\"", chart->title);
    svg_text(file, left, 54.0, "font-size=\"12.5\" fill=\"#666\"", chart->subtitle);
    for (size_t i = 0u; i < chart->line_count; i++) {
        draw_line(file, chart, i);
    }
    svg_end(file);
}

bool chart_write(const chart_t *chart, const char *path, failure_t *failure)
{
    FILE *file;
    if (!output_open(&file, path, failure)) {
        return false;
    }
    svg_head(file);
    chart_draw(file, chart);
    return output_close(file, path, failure);
}
