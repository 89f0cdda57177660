/* SPDX-License-Identifier: MIT */
#include "plan_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"

static const double finest_m = 0.1, coarsest_m = 0.2;
static const double most_places = 8e6;
static const double smallest_part_m2 = 1.0;

/* What a place of the raster is; from FIRST_PART on the number of a part. */
enum { CLOSED = 0, FREE = 1, FIRST_PART = 2 };

typedef struct {
    const insole_floor_plan_t *plan;
    double step_m;
    size_t columns, rows;
    uint32_t *label;
    size_t *stack; /* places whose neighbours are still to be seen */
} raster_t;

static plan_point_t place_of(const raster_t *raster, size_t i)
{
    size_t columns = raster->columns > 0u ? raster->columns : 1u;
    plan_point_t place = {
        (double)raster->plan->origin_x_m + ((double)(i % columns) + 0.5) * raster->step_m,
        (double)raster->plan->origin_y_m + ((double)(i / columns) + 0.5) * raster->step_m};
    return place;
}

static raster_t make_raster(const insole_floor_plan_t *plan)
{
    double width_m = (double)plan->columns * (double)plan->cell_m;
    double height_m = (double)plan->rows * (double)plan->cell_m;
    raster_t raster = {plan, fmax(finest_m, sqrt(width_m * height_m / most_places)), 0u, 0u, NULL,
                       NULL};
    raster.columns = (size_t)(width_m / raster.step_m) + 1u;
    raster.rows = (size_t)(height_m / raster.step_m) + 1u;
    raster.label = memory_new(raster.columns * raster.rows, sizeof *raster.label);
    return raster;
}

static bool has_room_for_a_person(const raster_t *raster, plan_point_t place)
{
    insole_real_t clearance_m, body_m = (insole_real_t)PLAN_PARTS_BODY_M;
    insole_status_t status = insole_floor_plan_clearance(
        raster->plan, (insole_real_t)place.x_m, (insole_real_t)place.y_m, body_m, &clearance_m);
    return status == INSOLE_OK && clearance_m >= body_m;
}

/* @return places inside, with room for a person or without */
static size_t mark_free(raster_t *raster)
{
    size_t inside = 0u;
    for (size_t i = 0u; i < raster->columns * raster->rows; i++) {
        plan_point_t place = place_of(raster, i);
        if (insole_floor_plan_inside(raster->plan, (insole_real_t)place.x_m,
                                     (insole_real_t)place.y_m)) {
            inside++;
            raster->label[i] = has_room_for_a_person(raster, place) ? FREE : CLOSED;
        }
    }
    return inside;
}

/* Eight neighbours: each is nearer than a person is wide, so that no wall fits between. */
static size_t push_neighbours(raster_t *raster, size_t i, uint32_t label, size_t depth)
{
    size_t column = i % raster->columns, row = i / raster->columns;
    size_t left = column > 0u ? column - 1u : 0u, low = row > 0u ? row - 1u : 0u;
    for (size_t r = low; r <= row + 1u && r < raster->rows; r++) {
        for (size_t c = left; c <= column + 1u && c < raster->columns; c++) {
            size_t neighbour = r * raster->columns + c;
            if (raster->label[neighbour] == FREE) {
                raster->label[neighbour] = label;
                raster->stack[depth++] = neighbour;
            }
        }
    }
    return depth;
}

/* Labels all that can be reached from a free place. */
static plan_part_t flood(raster_t *raster, size_t start, uint32_t label)
{
    plan_point_t sum = {0.0, 0.0};
    size_t depth = 1u, count = 0u;
    raster->label[start] = label;
    raster->stack[0] = start;
    for (; depth > 0u; count++) {
        size_t i = raster->stack[--depth];
        plan_point_t place = place_of(raster, i);
        sum.x_m += place.x_m;
        sum.y_m += place.y_m;
        depth = push_neighbours(raster, i, label, depth);
    }
    plan_part_t part = {(double)count * raster->step_m * raster->step_m,
                        {sum.x_m / (double)count, sum.y_m / (double)count}};
    return part;
}

/* Moves the middle of a part, which may lie outside it, to the nearest of its places. */
static void settle(const raster_t *raster, plan_part_t *part, uint32_t label)
{
    double least_m = HUGE_VAL;
    plan_point_t middle = part->place;
    for (size_t i = 0u; i < raster->columns * raster->rows; i++) {
        if (raster->label[i] == label) {
            plan_point_t place = place_of(raster, i);
            double distance_m = hypot(place.x_m - middle.x_m, place.y_m - middle.y_m);
            if (distance_m < least_m) {
                least_m = distance_m;
                part->place = place;
            }
        }
    }
}

static void add_part(plan_parts_t *parts, const plan_part_t *part)
{
    parts->parts = memory_room(parts->parts, &parts->room, parts->count + 1u, sizeof *part);
    parts->parts[parts->count++] = *part;
}

static int by_falling_area(const void *a, const void *b)
{
    double area_a = ((const plan_part_t *)a)->area_m2, area_b = ((const plan_part_t *)b)->area_m2;
    return (area_a < area_b) - (area_a > area_b);
}

static void find_parts(plan_parts_t *parts, raster_t *raster)
{
    uint32_t label = FIRST_PART;
    for (size_t i = 0u; i < raster->columns * raster->rows; i++) {
        if (raster->label[i] == FREE) {
            plan_part_t part = flood(raster, i, label);
            if (part.area_m2 >= smallest_part_m2) {
                settle(raster, &part, label);
                add_part(parts, &part);
            }
            label++;
        }
    }
    if (parts->count > 1u) {
        qsort(parts->parts, parts->count, sizeof *parts->parts, by_falling_area);
    }
}

void plan_parts_find(plan_parts_t *parts, const insole_floor_plan_t *plan)
{
    memset(parts, 0, sizeof *parts);
    raster_t raster = make_raster(plan);
    size_t inside = mark_free(&raster);
    parts->walkable_m2 = (double)inside * raster.step_m * raster.step_m;
    parts->is_searched = raster.step_m <= coarsest_m;
    if (parts->is_searched && inside > 0u) {
        raster.stack = memory_new(inside, sizeof *raster.stack);
        find_parts(parts, &raster);
    }
    free(raster.label);
    free(raster.stack);
}

void plan_parts_free(plan_parts_t *parts)
{
    free(parts->parts);
    memset(parts, 0, sizeof *parts);
}
