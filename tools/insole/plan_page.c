/* SPDX-License-Identifier: MIT */
#include "plan_page.h"

#include <math.h>
#include <stdlib.h>

#include "memory.h"
#include "number.h"
#include "output.h"
#include "plot_plan.h"
#include "svg.h"

static const double row_height = 22.0, sample_width = 26.0;

enum { MOST_LOSSES = 12 }; /* in the legend */

typedef struct {
    FILE *file;
    double x, y; /* where its next row goes */
} legend_t;

static void write_row(legend_t *legend, const char *text)
{
    svg_text(legend->file, legend->x + sample_width + 8.0, legend->y + 4.0,
             "font-size=\"12\" fill=\"#333\"", text);
    legend->y += row_height;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The different losses of the first floor's walls, rising. @return how many */
static size_t collect_losses(const plan_file_t *plan, double *losses)
{
    size_t all = 0u, count = 0u;
    for (size_t i = 0u; i < plan->count; i++) {
        if (plan->lines[i].floor == 0u && !isnan(plan->lines[i].loss_db)) {
            losses[all++] = plan->lines[i].loss_db;
        }
    }
    qsort(losses, all, sizeof *losses, by_value);
    for (size_t i = 0u; i < all; i++) {
        if (count == 0u || losses[i] != losses[count - 1u]) {
            losses[count++] = losses[i];
        }
    }
    return count;
}

static void write_loss(legend_t *legend, double loss_db)
{
    char style[PLOT_PLAN_STYLE], number[NUMBER_ROOM], text[NUMBER_ROOM + 16];
    plot_plan_wall_style(style, loss_db);
    svg_line(legend->file, legend->x, legend->y, legend->x + sample_width, legend->y, style);
    snprintf(text, sizeof text, "wall, %s dB", number_short(number, loss_db));
    write_row(legend, isnan(loss_db) ? "wall, loss not told" : text);
}

static void write_losses(legend_t *legend, const plan_file_t *plan)
{
    double *losses = memory_new(plan->count, sizeof *losses);
    size_t count = collect_losses(plan, losses);
    size_t shown = count < MOST_LOSSES ? count : MOST_LOSSES;
    for (size_t i = 0u; i < shown; i++) { /* evenly of many, with the least and the largest */
        write_loss(legend, losses[shown > 1u ? i * (count - 1u) / (shown - 1u) : 0u]);
    }
    free(losses);
    for (size_t i = 0u; i < plan->count; i++) {
        if (plan->lines[i].floor == 0u && isnan(plan->lines[i].loss_db)) {
            write_loss(legend, NUMBER_UNKNOWN);
            return;
        }
    }
}

static bool has_hole(const plan_file_t *plan)
{
    for (size_t i = 0u; i < plan->count; i++) {
        if (plan->lines[i].kind == INSOLE_LINE_HOLE && plan->lines[i].floor == 0u) {
            return true;
        }
    }
    return false;
}

static void draw_legend(FILE *file, const plot_frame_t *frame, const site_t *site)
{
    legend_t legend = {file, frame->right + 22.0, frame->top + 12.0};
    write_losses(&legend, &site->plan_file);
    if (has_hole(&site->plan_file)) {
        svg_rectangle(file, legend.x, legend.y - 7.0, sample_width, 14.0,
                      PLOT_PLAN_HOLE " stroke=\"#8a94a0\"");
        write_row(&legend, "hole");
    }
    if (site->ap_file.count > 0u) {
        plot_plan_mark(file, legend.x + 0.5 * sample_width, legend.y);
        write_row(&legend, "access point");
    }
}

static void draw_page(FILE *file, const site_t *site, const char *title, const char *subtitle)
{
    plot_area_t area = plot_area_empty();
    plot_plan_area(&area, &site->plan_file);
    plot_frame_t frame = plot_frame(area);
    svg_head(file);
    svg_begin(file, frame.width, frame.height);
    plot_frame_draw(file, &frame);
    svg_text(file, frame.left, 32.0, "font-size=\"19\" font-weight=\"bold\" fill=\"#222\"", title);
    svg_text(file, frame.left, 54.0, "font-size=\"12.5\" fill=\"#666\"", subtitle);
    plot_plan_draw(file, &frame, &site->plan_file);
    plot_plan_draw_aps(file, &frame, &site->plan_file, &site->ap_file);
    draw_legend(file, &frame, site);
    svg_end(file);
}

bool plan_page_write(const site_t *site, const char *title, const char *subtitle, const char *path,
                     failure_t *failure)
{
    FILE *file;
    if (!output_open(&file, path, failure)) {
        return false;
    }
    draw_page(file, site, title, subtitle);
    return output_close(file, path, failure);
}
