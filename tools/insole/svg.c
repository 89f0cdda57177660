/* SPDX-License-Identifier: MIT */
#include "svg.h"

#include "number.h"

static void write_attribute(FILE *file, const char *name, double value)
{
    char number[NUMBER_ROOM];
    fprintf(file, " %s=\"%s\"", name, number_fixed(number, value, 2));
}

void svg_head(FILE *file)
{
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", file);
}

void svg_begin(FILE *file, double width, double height)
{
    char w[NUMBER_ROOM], h[NUMBER_ROOM];
    number_fixed(w, width, 0);
    number_fixed(h, height, 0);
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%s\" height=\"%s\" "
            "viewBox=\"0 0 %s %s\" font-family=\"Helvetica, Arial, sans-serif\">\n",
            w, h, w, h);
}

void svg_end(FILE *file)
{
    fputs("</svg>\n", file);
}

void svg_line(FILE *file, double x1, double y1, double x2, double y2, const char *style)
{
    fputs("<line", file);
    write_attribute(file, "x1", x1);
    write_attribute(file, "y1", y1);
    write_attribute(file, "x2", x2);
    write_attribute(file, "y2", y2);
    fprintf(file, " %s/>\n", style);
}

void svg_rectangle(FILE *file, double x, double y, double width, double height, const char *style)
{
    fputs("<rect", file);
    write_attribute(file, "x", x);
    write_attribute(file, "y", y);
    write_attribute(file, "width", width);
    write_attribute(file, "height", height);
    fprintf(file, " %s/>\n", style);
}

void svg_circle(FILE *file, double x, double y, double radius, const char *style)
{
    fputs("<circle", file);
    write_attribute(file, "cx", x);
    write_attribute(file, "cy", y);
    write_attribute(file, "r", radius);
    fprintf(file, " %s/>\n", style);
}

void svg_ellipse(FILE *file, double x, double y, double radius_x, double radius_y, double turn_deg,
                 const char *style)
{
    char px[NUMBER_ROOM], py[NUMBER_ROOM], turn[NUMBER_ROOM];
    fprintf(file, "<ellipse transform=\"translate(%s %s) rotate(%s)\"", number_fixed(px, x, 2),
            number_fixed(py, y, 2), number_fixed(turn, turn_deg, 2));
    write_attribute(file, "rx", radius_x);
    write_attribute(file, "ry", radius_y);
    fprintf(file, " %s/>\n", style);
}

/* XML has no way to write most control characters. */
void svg_escape(FILE *file, const char *text)
{
    for (; *text != '\0'; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '<') {
            fputs("&lt;", file);
        } else if (c == '&') {
            fputs("&amp;", file);
        } else {
            putc(c < 0x20u ? '?' : c, file);
        }
    }
}

void svg_text(FILE *file, double x, double y, const char *style, const char *text)
{
    fputs("<text", file);
    write_attribute(file, "x", x);
    write_attribute(file, "y", y);
    fprintf(file, " %s>", style);
    svg_escape(file, text);
    fputs("</text>\n", file);
}

void svg_path_begin(FILE *file, const char *style)
{
    fprintf(file, "<polyline fill=\"none\" %s points=\"", style);
}

void svg_path_point(FILE *file, double x, double y)
{
    char number[NUMBER_ROOM];
    fputs(number_fixed(number, x, 1), file);
    putc(',', file);
    fputs(number_fixed(number, y, 1), file);
    putc(' ', file);
}

void svg_path_end(FILE *file)
{
    fputs("\"/>\n", file);
}

void svg_shape_begin(FILE *file, const char *style)
{
    fprintf(file, "<polygon %s points=\"", style);
}

void svg_hatch(FILE *file, const char *name, const char *ground, const char *colour)
{
    fprintf(file,
            "<defs><pattern id=\"%s\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
            "patternTransform=\"rotate(45)\">\n",
            name);
    fprintf(file, "<rect width=\"6\" height=\"6\" fill=\"%s\"/>\n", ground);
    fprintf(file, "<rect width=\"1.2\" height=\"6\" fill=\"%s\"/></pattern></defs>\n", colour);
}
