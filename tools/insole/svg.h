/** @file svg.h  SVG elements, written as they are told. Coordinates in pixels, y down.
 *
 *      svg_head(file);
 *      svg_begin(file, 800.0, 600.0);
 *      svg_circle(file, 100.0, 50.0, 4.0, "fill=\"#1b7837\"");
 *      svg_text(file, 10.0, 20.0, "font-size=\"12\"", "x & y");
 *      svg_end(file);
 *
 *  `style` is written into the element as it is; text is escaped.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SVG_H
#define INSOLE_HOST_SVG_H

#include <stdio.h>

/** Before the picture, where it is a file of its own. */
void svg_head(FILE *file);

void svg_begin(FILE *file, double width, double height);
void svg_end(FILE *file);

void svg_line(FILE *file, double x1, double y1, double x2, double y2, const char *style);
void svg_rectangle(FILE *file, double x, double y, double width, double height, const char *style);
void svg_circle(FILE *file, double x, double y, double radius, const char *style);

/** @param turn_deg clockwise on the screen */
void svg_ellipse(FILE *file, double x, double y, double radius_x, double radius_y, double turn_deg,
                 const char *style);

void svg_text(FILE *file, double x, double y, const char *style, const char *text);

/** Text as XML and HTML take it. */
void svg_escape(FILE *file, const char *text);

/** A line of many points: begin, point by point, end. */
void svg_path_begin(FILE *file, const char *style);
void svg_path_point(FILE *file, double x, double y);
void svg_path_end(FILE *file);

/** A closed shape, which may be filled: begin, corner by corner by svg_path_point, svg_path_end. */
void svg_shape_begin(FILE *file, const char *style);

/** Makes `fill="url(#name)"` fill with slanted lines. */
void svg_hatch(FILE *file, const char *name, const char *ground, const char *colour);

#endif
