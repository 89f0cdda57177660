/** @file plan_file.h  Floor plans as they are drawn: plan.csv.
 *
 *      floor,number,z,name          opens a floor; without one all is floor 0
 *      outline,x,y,x,y,...          ring around where one can walk
 *      hole,x,y,x,y,...             ring nobody can be in
 *      wall,loss_db,x,y,x,y,...     inner wall from point to point; doors are gaps
 *      loss,dB                      loss of the walls that the rings after it are
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PLAN_FILE_H
#define INSOLE_HOST_PLAN_FILE_H

#include <stdio.h>

#include "failure.h"
#include "insole/place/floor_plan_build.h"

/** Coordinates lie between -this and +this [m]. */
#define PLAN_FILE_LIMIT_M 100000.0

/** Largest loss of a wall [dB]. */
#define PLAN_FILE_LOSS_DB 200.0

typedef struct {
    double x_m, y_m;
} plan_point_t;

/** A ring or a wall. */
typedef struct {
    insole_line_kind_t kind;
    unsigned long number; /**< of the line in the file */
    size_t floor;         /**< index into the floors */
    plan_point_t *points; /**< of a ring that ends where it begins, the last is not here */
    size_t count, room;
    double loss_db; /**< NUMBER_UNKNOWN: the plan does not tell */
} plan_line_t;

typedef struct {
    int64_t number;
    double z_m;
    char *name;
    unsigned long line; /**< of the file; 0: no line opened it */
} plan_floor_t;

typedef struct {
    char *name;         /**< of the file, for messages */
    plan_line_t *lines; /**< in the order of the file; one at least */
    size_t count, room;
    plan_floor_t *floors; /**< one at least; the first is the one that is used */
    size_t floor_count, floor_room;
} plan_file_t;

/** @param path a file, or `-` for standard input. A refusal leaves nothing to free. */
bool plan_file_read(plan_file_t *plan, const char *path, failure_t *failure);

/** Reads from a file that is already open, and closes it. */
bool plan_file_take(plan_file_t *plan, FILE *file, const char *name, failure_t *failure);

/** Points from which the pieces of a line start: all of a ring, all but the last of a wall. */
size_t plan_line_pieces(const plan_line_t *line);

/** Where piece `i` ends; it begins at points[i]. */
plan_point_t plan_line_end(const plan_line_t *line, size_t i);

const char *plan_line_kind_name(insole_line_kind_t kind);

/** Has a floor, counted from 0, a ring around where one can walk? */
bool plan_file_has_outline(const plan_file_t *plan, size_t floor);

void plan_file_free(plan_file_t *plan);

#endif
