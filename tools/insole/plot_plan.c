/* SPDX-License-Identifier: MIT */
#include "plot_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "number.h"
#include "plan_shape.h"
#include "svg.h"

static const double darkest_db = 15.0; /* walls that cost more look no darker */
static const double font = 10.0, letter = 5.6, mark = 4.5;

/* From light to dark: 0 dB and `darkest_db`. */
static const double wall_shades[2][3] = {{168, 178, 190}, {31, 41, 55}};

void plot_plan_area(plot_area_t *area, const plan_file_t *plan)
{
    for (size_t i = 0u; i < plan->count; i++) {
        const plan_line_t *line = &plan->lines[i];
        for (size_t k = 0u; k < line->count && line->floor == 0u; k++) {
            plot_area_add_place(area, line->points[k].x_m, line->points[k].y_m);
        }
    }
}

/* ---- walls ------------------------------------------------------------------------------ */

const char *plot_plan_wall_style(char buffer[PLOT_PLAN_STYLE], double loss_db)
{
    double share = isnan(loss_db) ? 0.4 : fmin(loss_db / darkest_db, 1.0);
    unsigned rgb[3];
    char width[NUMBER_ROOM];
    for (int i = 0; i < 3; i++) {
        rgb[i] =
            (unsigned)lround(wall_shades[0][i] + share * (wall_shades[1][i] - wall_shades[0][i]));
    }
    snprintf(buffer, PLOT_PLAN_STYLE,
             "stroke=\"#%02x%02x%02x\" stroke-width=\"%s\" stroke-linejoin=\"round\" "
             "stroke-linecap=\"round\"",
             rgb[0] & 0xffu, rgb[1] & 0xffu, rgb[2] & 0xffu,
             number_fixed(width, 1.4 + 2.4 * share, 1));
    return buffer;
}

static void draw_points(FILE *file, const plot_frame_t *frame, const plan_line_t *line)
{
    for (size_t i = 0u; i < line->count; i++) {
        svg_path_point(file, plot_x(frame, line->points[i].x_m),
                       plot_y(frame, line->points[i].y_m));
    }
    svg_path_end(file);
}

static void fill_rings(FILE *file, const plot_frame_t *frame, const plan_file_t *plan,
                       insole_line_kind_t kind, const char *style)
{
    for (size_t i = 0u; i < plan->count; i++) {
        if (plan->lines[i].kind == kind && plan->lines[i].floor == 0u) {
            svg_shape_begin(file, style);
            draw_points(file, frame, &plan->lines[i]);
        }
    }
}

static void draw_wall(FILE *file, const plot_frame_t *frame, const plan_line_t *line)
{
    char style[PLOT_PLAN_STYLE], shape[PLOT_PLAN_STYLE + 16];
    plot_plan_wall_style(style, line->loss_db);
    if (line->kind == INSOLE_LINE_WALL) {
        svg_path_begin(file, style);
    } else {
        snprintf(shape, sizeof shape, "fill=\"none\" %s", style);
        svg_shape_begin(file, shape);
    }
    draw_points(file, frame, line);
}

void plot_plan_draw(FILE *file, const plot_frame_t *frame, const plan_file_t *plan)
{
    char number[4][NUMBER_ROOM];
    svg_hatch(file, "hole", "#eceff2", "#b4bcc6");
    fprintf(file,
            "<defs><clipPath id=\"field\"><rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\"/>"
            "</clipPath></defs>\n<g clip-path=\"url(#field)\">\n",
            number_fixed(number[0], frame->left, 2), number_fixed(number[1], frame->top, 2),
            number_fixed(number[2], frame->right - frame->left, 2),
            number_fixed(number[3], frame->bottom - frame->top, 2));
    fill_rings(file, frame, plan, INSOLE_LINE_OUTLINE, "fill=\"#fdf8ec\" fill-opacity=\"0.75\"");
    fill_rings(file, frame, plan, INSOLE_LINE_HOLE, PLOT_PLAN_HOLE);
    for (size_t i = 0u; i < plan->count; i++) {
        if (plan->lines[i].floor == 0u) {
            draw_wall(file, frame, &plan->lines[i]);
        }
    }
    fputs("</g>\n", file);
}

/* ---- access points ---------------------------------------------------------------------- */

void plot_plan_mark(FILE *file, double x, double y)
{
    svg_shape_begin(file, "fill=\"#c2410c\" stroke=\"#ffffff\" stroke-width=\"1.2\"");
    svg_path_point(file, x, y - 1.3 * mark);
    svg_path_point(file, x + 1.2 * mark, y + 0.9 * mark);
    svg_path_point(file, x - 1.2 * mark, y + 0.9 * mark);
    svg_path_end(file);
}

/* Where a name may stand by its mark. */
enum { SPOTS = 8 };

/* Part of the page, in pixels. */
typedef struct {
    double left, right, top, bottom;
} box_t;

typedef struct {
    FILE *file;
    const plot_frame_t *frame;
    const plan_file_t *plan;
    box_t *taken; /* by marks, then by the names that have found a place */
    size_t count;
} names_t;

static bool is_taken(const names_t *names, box_t box)
{
    const plot_frame_t *frame = names->frame;
    if (box.left < frame->left || box.right > frame->right || box.top < frame->top ||
        box.bottom > frame->bottom) {
        return true;
    }
    for (size_t i = 0u; i < names->count; i++) {
        const box_t *other = &names->taken[i];
        if (box.left < other->right && other->left < box.right && box.top < other->bottom &&
            other->top < box.bottom) {
            return true;
        }
    }
    return false;
}

static plan_point_t on_page(const plot_frame_t *frame, plan_point_t place)
{
    plan_point_t pixels = {plot_x(frame, place.x_m), plot_y(frame, place.y_m)};
    return pixels;
}

/* A wall that goes through a box crosses one of its diagonals; one that ends in it may not. */
static bool is_on_line(const names_t *names, const plan_line_t *line, box_t box)
{
    const plan_point_t corner[4] = {
        {box.left, box.top}, {box.right, box.bottom}, {box.left, box.bottom}, {box.right, box.top}};
    plan_point_t where;
    for (size_t i = 0u; i < plan_line_pieces(line); i++) {
        plan_point_t a = on_page(names->frame, line->points[i]);
        plan_point_t b = on_page(names->frame, plan_line_end(line, i));
        if (plan_pieces_cross(corner[0], corner[1], a, b, &where) ||
            plan_pieces_cross(corner[2], corner[3], a, b, &where)) {
            return true;
        }
    }
    return false;
}

static bool is_on_wall(const names_t *names, box_t box)
{
    for (size_t i = 0u; i < names->plan->count; i++) {
        const plan_line_t *line = &names->plan->lines[i];
        if (line->floor == 0u && is_on_line(names, line, box)) {
            return true;
        }
    }
    return false;
}

static size_t letters(const char *name)
{
    size_t count = 0u;
    for (; *name != '\0'; name++) {
        count += ((unsigned char)*name & 0xc0u) != 0x80u; /* not a later byte of a UTF-8 letter */
    }
    return count;
}

static void write_name(names_t *names, box_t box, const char *name)
{
    names->taken[names->count++] = box;
    svg_text(names->file, box.left, 0.5 * (box.top + box.bottom) + 0.35 * font,
             "font-size=\"10\" fill=\"#7c2d12\" stroke=\"#ffffff\" stroke-width=\"2.5\" "
             "stroke-opacity=\"0.8\" paint-order=\"stroke\"",
             name);
}

/* Writes a name beside, above or below its mark, rather not across a wall, or not at all. */
static void place_name(names_t *names, double x, double y, const char *name)
{
    double width = letter * (double)letters(name), away = 1.5 * mark;
    double up = y - away - 0.6 * font, down = y + away + 0.5 * font;
    const double left[SPOTS] = {x + away, x - away - width, x - 0.5 * width,  x - 0.5 * width,
                                x - away, x - away,         x + away - width, x + away - width};
    const double middle[SPOTS] = {y, y, up, down, up, down, up, down};
    box_t best = {0.0, 0.0, 0.0, 0.0};
    bool has_best = false;
    for (int i = 0; i < SPOTS; i++) {
        box_t box = {left[i], left[i] + width, middle[i] - 0.5 * font, middle[i] + 0.5 * font};
        if (is_taken(names, box)) {
            continue;
        }
        if (!is_on_wall(names, box)) {
            write_name(names, box, name);
            return;
        }
        best = has_best ? best : box;
        has_best = true;
    }
    if (has_best) {
        write_name(names, best, name);
    }
}

static bool is_in_frame(const plot_frame_t *frame, const insole_ap_t *ap)
{
    return (double)ap->x_m >= frame->area.x_low && (double)ap->x_m <= frame->area.x_high &&
           (double)ap->y_m >= frame->area.y_low && (double)ap->y_m <= frame->area.y_high;
}

void plot_plan_draw_aps(FILE *file, const plot_frame_t *frame, const plan_file_t *plan,
                        const ap_file_t *aps)
{
    names_t names = {file, frame, plan, memory_new(2u * aps->count, sizeof *names.taken), 0u};
    for (size_t i = 0u; i < aps->count; i++) {
        double x = plot_x(frame, (double)aps->aps[i].x_m);
        double y = plot_y(frame, (double)aps->aps[i].y_m);
        if (is_in_frame(frame, &aps->aps[i])) {
            const box_t box = {x - mark, x + mark, y - mark, y + mark};
            names.taken[names.count++] = box;
            plot_plan_mark(file, x, y);
        }
    }
    for (size_t i = 0u; i < aps->count; i++) {
        if (is_in_frame(frame, &aps->aps[i])) {
            place_name(&names, plot_x(frame, (double)aps->aps[i].x_m),
                       plot_y(frame, (double)aps->aps[i].y_m), aps->ids.names[i]);
        }
    }
    free(names.taken);
}
