/* SPDX-License-Identifier: MIT */
#include "insole/place/floor_plan.h"

#include <stddef.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)

/* ---- a segment and a wall ---- */

/* The way that is asked about, relative to the plan's origin. */
typedef struct {
    insole_real_t x_m, y_m;   /* where it begins */
    insole_real_t dx_m, dy_m; /* where it goes from there */
} way_t;

/* A part of the plane. */
typedef struct {
    insole_real_t x_low_m, x_high_m, y_low_m, y_high_m;
} box_t;

/* For the side of a point as seen along a way or wall. */
static insole_real_t slack_m2(insole_real_t dx_m, insole_real_t dy_m)
{
    return INSOLE_FLOOR_PLAN_TOUCH_M * insole_sqrt(dx_m * dx_m + dy_m * dy_m);
}

static box_t box_around(const way_t *way, insole_real_t margin_m)
{
    insole_real_t x1_m = way->x_m + way->dx_m, y1_m = way->y_m + way->dy_m;
    box_t box = {insole_min(way->x_m, x1_m) - margin_m, insole_max(way->x_m, x1_m) + margin_m,
                 insole_min(way->y_m, y1_m) - margin_m, insole_max(way->y_m, y1_m) + margin_m};
    return box;
}

/* Twice the area between the way and a point: positive when the point lies left of the way. Walls
 * that share a corner get the same bits for it, so that no way slips between them. */
static insole_real_t side_of_point(const way_t *way, insole_real_t x_m, insole_real_t y_m)
{
    return way->dx_m * (y_m - way->y_m) - way->dy_m * (x_m - way->x_m);
}

static insole_real_t wall_slack_m2(const insole_wall_t *wall)
{
    return slack_m2(wall->x1_m - wall->x0_m, wall->y1_m - wall->y0_m);
}

static bool both_outside(insole_real_t low, insole_real_t high, insole_real_t a, insole_real_t b)
{
    return (a < low && b < low) || (a > high && b > high);
}

static bool is_beside(const box_t *box, const insole_wall_t *wall)
{
    return both_outside(box->x_low_m, box->x_high_m, wall->x0_m, wall->x1_m) ||
           both_outside(box->y_low_m, box->y_high_m, wall->y0_m, wall->y1_m);
}

/* Two segments are apart when a line along x, y or one of them separates them. */
static bool touches(const way_t *way, const box_t *reach, const insole_wall_t *wall)
{
    if (is_beside(reach, wall)) {
        return false;
    }
    insole_real_t slack = slack_m2(way->dx_m, way->dy_m);
    if (both_outside(-slack, slack, side_of_point(way, wall->x0_m, wall->y0_m),
                     side_of_point(way, wall->x1_m, wall->y1_m))) {
        return false;
    }
    slack = wall_slack_m2(wall);
    return !both_outside(-slack, slack, insole_wall_side(wall, way->x_m, way->y_m),
                         insole_wall_side(wall, way->x_m + way->dx_m, way->y_m + way->dy_m));
}

/* True when the ends of the wall lie on different sides of the endless line along the way; a point
 * on the line belongs to its right, for all walls that share the point. */
static bool straddles(const way_t *way, const insole_wall_t *wall)
{
    return (side_of_point(way, wall->x0_m, wall->y0_m) > ZERO) !=
           (side_of_point(way, wall->x1_m, wall->y1_m) > ZERO);
}

/* ---- the scan of the cells along a way, row by row ---- */

typedef struct {
    int32_t row, last_row;           /* the row being scanned, and the last */
    int32_t left, right;             /* its columns that the way can touch */
    int32_t block_left, block_right; /* those of the whole way */
    bool is_block;                   /* all columns in every row: nothing to be won by less */
    insole_real_t column, at_row;    /* where the way begins; row 0 is in its middle */
    insole_real_t columns_per_row;   /* where it goes from there, */
    insole_real_t columns_aside;     /* and how far it gets from its middle within a row */
} scan_t;

/* Coordinates in range, times at most four cells in a metre, fit. */
static int32_t index_of(insole_real_t x_m, insole_real_t cells_per_m, int32_t count)
{
    int32_t index = (int32_t)(x_m * cells_per_m);
    index = index < count ? index : count - 1;
    return index > 0 ? index : 0;
}

/* A row's cells lie side by side, and so do their entries. */
static const insole_floor_plan_cell_t *first_cell(const insole_floor_plan_t *plan, int32_t row)
{
    return plan->cells + (ptrdiff_t)row * plan->columns;
}

/* The columns in which the way can touch the cells of the scan's row. */
static inline void narrow_columns(scan_t *scan)
{
    insole_real_t first = (insole_real_t)scan->block_left, last = (insole_real_t)scan->block_right;
    insole_real_t rows = (insole_real_t)scan->row - scan->at_row;
    insole_real_t middle = scan->column + rows * scan->columns_per_row;
    insole_real_t left = middle - scan->columns_aside, right = middle + scan->columns_aside;
    scan->left = (int32_t)insole_max(first, insole_min(left, last));
    scan->right = (int32_t)insole_max(first, insole_min(right, last));
}

/* The columns of each row in which the way can touch cells, where they are not all of them. */
static inline void begin_columns(scan_t *scan, const insole_floor_plan_t *plan, const way_t *way)
{
    insole_real_t aslant = way->dx_m / way->dy_m, touch = INSOLE_FLOOR_PLAN_TOUCH_M;
    scan->column = way->x_m * plan->cells_per_m;
    scan->at_row = way->y_m * plan->cells_per_m - HALF;
    scan->columns_per_row = aslant;
    scan->columns_aside = HALF * insole_abs(aslant) +
                          touch * plan->cells_per_m * (INSOLE_R(1.0) + insole_abs(aslant));
    narrow_columns(scan);
}

/* Begins with the lowest row. */
static inline scan_t begin_scan(const insole_floor_plan_t *plan, const way_t *way, const box_t *box)
{
    scan_t scan;
    scan.row = index_of(box->y_low_m, plan->cells_per_m, plan->rows);
    scan.last_row = index_of(box->y_high_m, plan->cells_per_m, plan->rows);
    scan.left = scan.block_left = index_of(box->x_low_m, plan->cells_per_m, plan->columns);
    scan.right = scan.block_right = index_of(box->x_high_m, plan->cells_per_m, plan->columns);
    scan.is_block = scan.right - scan.left <= 1 || scan.row == scan.last_row ||
                    insole_abs(way->dy_m) < INSOLE_FLOOR_PLAN_TOUCH_M;
    scan.column = scan.at_row = scan.columns_per_row = scan.columns_aside = ZERO;
    if (!scan.is_block) {
        begin_columns(&scan, plan, way);
    }
    return scan;
}

/* Goes on to the next row; false after the last. */
static inline bool next_row(scan_t *scan)
{
    if (scan->row >= scan->last_row) {
        return false;
    }
    scan->row++;
    if (!scan->is_block) {
        narrow_columns(scan);
    }
    return true;
}

/* ---- questions ---- */

/* True when coordinates are numbers and none is far beyond any map. */
static bool in_range(insole_real_t x0_m, insole_real_t y0_m, insole_real_t x1_m, insole_real_t y1_m)
{
    return x0_m * x0_m + y0_m * y0_m + x1_m * x1_m + y1_m * y1_m <=
           INSOLE_FLOOR_PLAN_LIMIT_M * INSOLE_FLOOR_PLAN_LIMIT_M;
}

static way_t way_in(const insole_floor_plan_t *plan, insole_real_t x0_m, insole_real_t y0_m,
                    insole_real_t x1_m, insole_real_t y1_m)
{
    way_t way = {x0_m - plan->origin_x_m, y0_m - plan->origin_y_m, x1_m - x0_m, y1_m - y0_m};
    return way;
}

INSOLE_FLAT bool insole_floor_plan_crosses(const insole_floor_plan_t *plan, insole_real_t x0_m,
                                           insole_real_t y0_m, insole_real_t x1_m,
                                           insole_real_t y1_m)
{
    if (plan == NULL || !in_range(x0_m, y0_m, x1_m, y1_m)) {
        return true;
    }
    way_t way = way_in(plan, x0_m, y0_m, x1_m, y1_m);
    box_t reach = box_around(&way, INSOLE_FLOOR_PLAN_TOUCH_M);
    scan_t scan = begin_scan(plan, &way, &reach);
    do {
        const insole_floor_plan_cell_t *cells = first_cell(plan, scan.row);
        const uint16_t *end = &plan->entries[cells[scan.right + 1].begin];
        for (const uint16_t *i = &plan->entries[cells[scan.left].begin]; i < end; i++) {
            if (touches(&way, &reach, &plan->walls[*i])) { /* [TwoOrder (40)] */
                return true;
            }
        }
    } while (next_row(&scan));
    return false;
}

/* What changes in the winding on the way through one edge: 1 into its left, -1 out of it. */
static int32_t winding_through(const way_t *way, const insole_wall_t *edge)
{
    if (!straddles(way, edge)) {
        return 0;
    }
    bool before = insole_wall_side(edge, way->x_m, way->y_m) > ZERO;
    bool after = insole_wall_side(edge, way->x_m + way->dx_m, way->y_m + way->dy_m) > ZERO;
    return after - before;
}

static bool is_walkable(uint8_t outlines, uint8_t holes)
{
    return outlines != 0u && holes == 0u;
}

/* From the reference point of a cell, of which it is known, to a point in the cell. */
static bool leads_inside(const insole_floor_plan_t *plan, const way_t *way,
                         const insole_floor_plan_cell_t *cell)
{
    box_t box = box_around(way, ZERO);
    int32_t outlines = cell->outlines, holes = cell->holes;
    const uint16_t *end = &plan->entries[cell[1].begin];
    for (const uint16_t *i = &plan->entries[cell[0].begin]; i < end; i++) {
        if (*i < plan->ring_walls && !is_beside(&box, &plan->walls[*i])) {
            int32_t *windings = *i < plan->outline_walls ? &outlines : &holes;
            *windings += winding_through(way, &plan->walls[*i]);
        }
    }
    return is_walkable((uint8_t)outlines, (uint8_t)holes);
}

bool insole_floor_plan_inside(const insole_floor_plan_t *plan, insole_real_t x_m, insole_real_t y_m)
{
    if (plan == NULL) {
        return false;
    }
    insole_real_t x = x_m - plan->origin_x_m, y = y_m - plan->origin_y_m;
    insole_real_t column = x * plan->cells_per_m, row = y * plan->cells_per_m;
    if (!(column >= ZERO && column < (insole_real_t)plan->columns && row >= ZERO &&
          row < (insole_real_t)plan->rows)) {
        return false;
    }
    int32_t i = (int32_t)column, j = (int32_t)row;
    const insole_floor_plan_cell_t *cell = first_cell(plan, j) + i;
    if (cell[0].begin == cell[1].begin) {
        return is_walkable(cell->outlines, cell->holes); /* most have no walls */
    }
    way_t way = {((insole_real_t)i + plan->spot_x) * plan->cell_m,
                 ((insole_real_t)j + plan->spot_y) * plan->cell_m, ZERO, ZERO};
    way.dx_m = x - way.x_m;
    way.dy_m = y - way.y_m;
    return leads_inside(plan, &way, cell);
}

/* Share of the way at which it passes the wall to its other side; negative when it does not. */
static inline insole_real_t passing_share(const way_t *way, const insole_wall_t *wall)
{
    insole_real_t slack = wall_slack_m2(wall);
    insole_real_t from = insole_wall_side(wall, way->x_m, way->y_m);
    insole_real_t to = insole_wall_side(wall, way->x_m + way->dx_m, way->y_m + way->dy_m);
    bool passes = (from > slack && to < -slack) || (from < -slack && to > slack);
    return passes ? from / (from - to) : INSOLE_R(-1.0);
}

/* A wall stands in several cells; the cell in which the way passes it counts it. */
static inline bool owns(const insole_floor_plan_t *plan, const scan_t *scan, uint32_t entry,
                        insole_real_t x_m, insole_real_t y_m)
{
    const insole_floor_plan_cell_t *cell =
        first_cell(plan, scan->row) + index_of(x_m, plan->cells_per_m, plan->columns);
    return index_of(y_m, plan->cells_per_m, plan->rows) == scan->row && entry >= cell[0].begin &&
           entry < cell[1].begin;
}

/* In the scan's row. */
static inline void count_passed(const insole_floor_plan_t *plan, const way_t *way,
                                const scan_t *scan, insole_walls_between_t *between)
{
    const insole_floor_plan_cell_t *cells = first_cell(plan, scan->row);
    uint32_t end = cells[scan->right + 1].begin;
    for (uint32_t i = cells[scan->left].begin; i < end; i++) {
        const insole_wall_t *wall = &plan->walls[plan->entries[i]];
        if (!straddles(way, wall)) {
            continue;
        }
        insole_real_t share = passing_share(way, wall);
        if (share >= ZERO &&
            owns(plan, scan, i, way->x_m + share * way->dx_m, way->y_m + share * way->dy_m)) {
            between->count++;
            between->loss_db += wall->loss_db;
        }
    }
}

INSOLE_FLAT insole_status_t insole_floor_plan_walls_until(const insole_floor_plan_t *plan,
                                                          insole_real_t x0_m, insole_real_t y0_m,
                                                          insole_real_t x1_m, insole_real_t y1_m,
                                                          insole_real_t enough_db,
                                                          insole_walls_between_t *between)
{
    if (plan == NULL || between == NULL) {
        return INSOLE_ERR_NULL;
    }
    if (!in_range(x0_m, y0_m, x1_m, y1_m)) {
        return INSOLE_ERR_VALUE;
    }
    way_t way = way_in(plan, x0_m, y0_m, x1_m, y1_m);
    box_t box = box_around(&way, INSOLE_FLOOR_PLAN_TOUCH_M);
    scan_t scan = begin_scan(plan, &way, &box);
    insole_walls_between_t passed = {0, ZERO};
    do {
        count_passed(plan, &way, &scan, &passed);
    } while (passed.loss_db < enough_db && next_row(&scan));
    *between = passed;
    return INSOLE_OK;
}

insole_status_t insole_floor_plan_walls_between(const insole_floor_plan_t *plan, insole_real_t x0_m,
                                                insole_real_t y0_m, insole_real_t x1_m,
                                                insole_real_t y1_m, insole_walls_between_t *between)
{
    return insole_floor_plan_walls_until(plan, x0_m, y0_m, x1_m, y1_m, INSOLE_REAL_MAX, between);
}

/* Squared distance from a point to a wall. */
static insole_real_t distance2_m2(insole_real_t x_m, insole_real_t y_m, const insole_wall_t *wall)
{
    insole_real_t wx = wall->x1_m - wall->x0_m, wy = wall->y1_m - wall->y0_m;
    insole_real_t px = x_m - wall->x0_m, py = y_m - wall->y0_m;
    insole_real_t share = (px * wx + py * wy) / (wx * wx + wy * wy);
    share = insole_max(ZERO, insole_min(share, INSOLE_R(1.0)));
    return insole_square(px - share * wx) + insole_square(py - share * wy);
}

/* The least squared distance of a point, relative to the origin, to one of the first `walls` walls,
 * at most that of the limit. */
static insole_real_t nearest_m2(const insole_floor_plan_t *plan, const way_t *at,
                                insole_real_t limit_m, uint32_t walls)
{
    insole_real_t scale = plan->cells_per_m, nearest = limit_m * limit_m;
    int32_t left = index_of(at->x_m - limit_m, scale, plan->columns);
    int32_t right = index_of(at->x_m + limit_m, scale, plan->columns);
    int32_t top = index_of(at->y_m + limit_m, scale, plan->rows);
    for (int32_t row = index_of(at->y_m - limit_m, scale, plan->rows); row <= top; row++) {
        const insole_floor_plan_cell_t *cells = first_cell(plan, row);
        for (uint32_t i = cells[left].begin; i < cells[right + 1].begin; i++) {
            const insole_wall_t *wall = &plan->walls[plan->entries[i]];
            if (plan->entries[i] < walls) {
                nearest = insole_min(nearest, distance2_m2(at->x_m, at->y_m, wall));
            }
        }
    }
    return nearest;
}

INSOLE_COLD insole_status_t insole_floor_plan_clearance(const insole_floor_plan_t *plan,
                                                        insole_real_t x_m, insole_real_t y_m,
                                                        insole_real_t limit_m,
                                                        insole_real_t *distance_m)
{
    if (plan == NULL || distance_m == NULL) {
        return INSOLE_ERR_NULL;
    }
    if (!in_range(x_m, y_m, limit_m, ZERO) || !(limit_m > ZERO)) {
        return INSOLE_ERR_VALUE;
    }
    way_t at = way_in(plan, x_m, y_m, x_m, y_m);
    *distance_m = insole_sqrt(nearest_m2(plan, &at, limit_m, plan->wall_count));
    return INSOLE_OK;
}

INSOLE_COLD bool insole_floor_plan_is_closed(const insole_floor_plan_t *plan, insole_real_t x_m,
                                             insole_real_t y_m, insole_real_t depth_m)
{
    if (plan == NULL || insole_floor_plan_inside(plan, x_m, y_m)) {
        return false;
    }
    if (!in_range(x_m, y_m, depth_m, ZERO)) {
        return true;
    }
    way_t at = way_in(plan, x_m, y_m, x_m, y_m);
    return !(nearest_m2(plan, &at, depth_m, plan->ring_walls) < depth_m * depth_m);
}
