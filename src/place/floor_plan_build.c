/* SPDX-License-Identifier: MIT */
#include "insole/place/floor_plan_build.h"

#include <stddef.h>

#define ZERO               INSOLE_R(0.0)
#define COORDINATE_LIMIT_M INSOLE_R(1e5)
#define LOSS_LIMIT_DB      INSOLE_R(1000.0)

/* A wall is entered in all cells within this distance: more than every rounding on the way [m]. */
#define MARGIN_M   INSOLE_R(0.005)
#define CELL_MIN_M INSOLE_R(0.25)
#define COARSER    INSOLE_R(1.2)

enum {
    WALLS_MAX = 65535,
    CELLS_MAX = 65534,
    ENTRIES_MAX = 65535,
    CELLS_PER_WALL = 2,
    COARSER_TRIES = 100, /* by then the cell is 80 million times as wide: a grid of one */
    SPOT_TRIES = 8
};

/* The drawing as a whole. */
typedef struct {
    insole_real_t x_low_m, y_low_m, x_high_m, y_high_m;
    uint32_t edges; /* no more walls than these */
} extent_t;

/* The plan while its tables can still be written. */
typedef struct {
    insole_floor_plan_t plan;
    const insole_floor_plan_memory_t *memory;
} site_t;

static bool is_ring(const insole_floor_plan_line_t *line)
{
    return line->kind != INSOLE_LINE_WALL;
}

static const insole_real_t *point_of(const insole_floor_plan_line_t *line, uint32_t i)
{
    return &line->xy_m[2u * (size_t)i];
}

static bool is_good_point(const insole_real_t *xy_m)
{
    return insole_abs(xy_m[0]) <= COORDINATE_LIMIT_M && insole_abs(xy_m[1]) <= COORDINATE_LIMIT_M;
}

static bool is_good_line(const insole_floor_plan_line_t *line)
{
    if ((uint32_t)line->kind > (uint32_t)INSOLE_LINE_WALL ||
        line->points < (is_ring(line) ? 3u : 2u) ||
        !(line->loss_db >= ZERO && line->loss_db <= LOSS_LIMIT_DB)) {
        return false;
    }
    for (uint32_t i = 0; i < line->points; i++) {
        if (!is_good_point(point_of(line, i))) {
            return false;
        }
    }
    return true;
}

static void stretch(extent_t *extent, const insole_floor_plan_line_t *line)
{
    for (uint32_t i = 0; i < line->points; i++) {
        const insole_real_t *p = point_of(line, i);
        extent->x_low_m = insole_min(extent->x_low_m, p[0]);
        extent->x_high_m = insole_max(extent->x_high_m, p[0]);
        extent->y_low_m = insole_min(extent->y_low_m, p[1]);
        extent->y_high_m = insole_max(extent->y_high_m, p[1]);
    }
    extent->edges += is_ring(line) ? line->points : line->points - 1u;
}

/* Checks the drawing and takes its measure. */
static insole_status_t survey(const insole_floor_plan_line_t *lines, uint32_t count,
                              uint32_t wall_room, extent_t *extent)
{
    extent_t none = {INSOLE_REAL_MAX, INSOLE_REAL_MAX, -INSOLE_REAL_MAX, -INSOLE_REAL_MAX, 0u};
    *extent = none;
    for (uint32_t i = 0; i < count; i++) {
        if (lines[i].xy_m == NULL) {
            return INSOLE_ERR_NULL;
        }
        if (!is_good_line(&lines[i])) {
            return INSOLE_ERR_VALUE;
        }
        stretch(extent, &lines[i]);
        if (extent->edges > WALLS_MAX || extent->edges > wall_room) {
            return INSOLE_ERR_ROOM;
        }
    }
    return extent->edges > 0u ? INSOLE_OK : INSOLE_ERR_STATE;
}

/* The origin is of whole metres, so that coordinates lose next to nothing against it. */
static insole_real_t whole_metres_below(insole_real_t x_m)
{
    return (insole_real_t)((int32_t)x_m - 1);
}

/* ---- walls ---- */

static void add_wall(site_t *site, const insole_floor_plan_line_t *line, uint32_t from, uint32_t to)
{
    const insole_real_t *a = point_of(line, from), *b = point_of(line, to);
    insole_real_t x_m = site->plan.origin_x_m, y_m = site->plan.origin_y_m;
    insole_wall_t wall = {a[0] - x_m, a[1] - y_m, b[0] - x_m, b[1] - y_m, line->loss_db};
    if (wall.x0_m != wall.x1_m || wall.y0_m != wall.y1_m) {
        site->memory->walls[site->plan.wall_count++] = wall;
    }
}

/* Twice the area left of a ring that is walked in the order of its points. */
static insole_real_t area2_m2(const insole_floor_plan_line_t *ring)
{
    const insole_real_t *p = ring->xy_m;
    insole_real_t sum_m2 = ZERO;
    for (uint32_t i = 2; i < ring->points; i++) {
        const insole_real_t *a = point_of(ring, i - 1u), *b = point_of(ring, i);
        sum_m2 += (a[0] - p[0]) * (b[1] - p[1]) - (a[1] - p[1]) * (b[0] - p[0]);
    }
    return sum_m2;
}

static void add_line(site_t *site, const insole_floor_plan_line_t *line)
{
    uint32_t last = line->points - 1u;
    bool is_clockwise = is_ring(line) && area2_m2(line) < ZERO;
    for (uint32_t i = 0; i < last; i++) {
        add_wall(site, line, is_clockwise ? last - i : i, is_clockwise ? last - i - 1u : i + 1u);
    }
    if (is_ring(line)) {
        add_wall(site, line, is_clockwise ? 0u : last, is_clockwise ? last : 0u);
    }
}

static uint16_t add_lines(site_t *site, const insole_floor_plan_line_t *lines, uint32_t count,
                          insole_line_kind_t kind)
{
    for (uint32_t i = 0; i < count; i++) {
        if (lines[i].kind == kind) {
            add_line(site, &lines[i]);
        }
    }
    return site->plan.wall_count;
}

/* ---- grid ---- */

static int32_t index_of(const site_t *site, insole_real_t x_m, int32_t count)
{
    int32_t index = x_m > ZERO ? (int32_t)(x_m * site->plan.cells_per_m) : 0;
    return index < count ? index : count - 1;
}

/* Cells whose square, a margin around it, can hold a part of the wall: [low, high]. */
typedef struct {
    int32_t column_low, column_high, row_low, row_high;
} block_t;

static block_t block_of(const site_t *site, const insole_wall_t *wall)
{
    insole_real_t left_m = insole_min(wall->x0_m, wall->x1_m) - MARGIN_M;
    insole_real_t right_m = insole_max(wall->x0_m, wall->x1_m) + MARGIN_M;
    insole_real_t low_m = insole_min(wall->y0_m, wall->y1_m) - MARGIN_M;
    insole_real_t high_m = insole_max(wall->y0_m, wall->y1_m) + MARGIN_M;
    block_t block = {
        index_of(site, left_m, site->plan.columns), index_of(site, right_m, site->plan.columns),
        index_of(site, low_m, site->plan.rows), index_of(site, high_m, site->plan.rows)};
    return block;
}

/* Within the wall's block: does the wall's line meet the square of the cell and its margin? */
static bool is_near(const site_t *site, const insole_wall_t *wall, int32_t column, int32_t row)
{
    insole_real_t cell_m = site->plan.cell_m, half_m = INSOLE_R(0.5) * cell_m;
    insole_real_t x_m = (insole_real_t)column * cell_m + half_m;
    insole_real_t y_m = (insole_real_t)row * cell_m + half_m;
    return insole_abs(insole_wall_side(wall, x_m, y_m)) <=
           (half_m + MARGIN_M) *
               (insole_abs(wall->x1_m - wall->x0_m) + insole_abs(wall->y1_m - wall->y0_m));
}

static insole_floor_plan_cell_t *cell_at(const site_t *site, int32_t column, int32_t row)
{
    return &site->memory->cells[row * site->plan.columns + column];
}

/* First only counts the wall in each of its cells, then, with `fill`, enters it: `begin` holds the
 * count, then the end of the cell's entries, and moves down to their begin as they are entered. */
static void enter_wall(const site_t *site, uint16_t number, bool fill)
{
    const insole_wall_t *wall = &site->memory->walls[number];
    block_t block = block_of(site, wall);
    for (int32_t row = block.row_low; row <= block.row_high; row++) {
        for (int32_t column = block.column_low; column <= block.column_high; column++) {
            insole_floor_plan_cell_t *cell = cell_at(site, column, row);
            if (!is_near(site, wall, column, row)) {
                continue;
            }
            if (fill) {
                site->memory->entries[--cell->begin] = number;
            } else {
                cell->begin++;
            }
        }
    }
}

/* Sets up a grid of empty cells; false when there is no room for so many. */
static bool lay_cells(site_t *site, insole_real_t width_m, insole_real_t height_m,
                      insole_real_t cell_m)
{
    insole_real_t columns = width_m / cell_m + INSOLE_R(1.0);
    insole_real_t rows = height_m / cell_m + INSOLE_R(1.0);
    uint32_t room = site->memory->cell_room;
    if (!(columns * rows < (insole_real_t)(room < CELLS_MAX ? room : CELLS_MAX))) {
        return false;
    }
    site->plan.cell_m = cell_m;
    site->plan.cells_per_m = INSOLE_R(1.0) / cell_m;
    site->plan.columns = (uint16_t)columns;
    site->plan.rows = (uint16_t)rows;
    insole_floor_plan_cell_t empty = {0u, 0u, 0u};
    for (int32_t i = 0; i <= site->plan.columns * site->plan.rows; i++) {
        site->memory->cells[i] = empty;
    }
    return true;
}

/* Enters all walls; false when there is no room for the entries. */
static bool enter_walls(const site_t *site)
{
    int32_t cells = site->plan.columns * site->plan.rows;
    uint32_t end = 0, room = site->memory->entry_room;
    for (uint32_t i = 0; i < site->plan.wall_count; i++) {
        enter_wall(site, (uint16_t)i, false);
    }
    for (int32_t i = 0; i <= cells; i++) {
        end += site->memory->cells[i].begin;
        if (end > room || end > ENTRIES_MAX) {
            return false;
        }
        site->memory->cells[i].begin = (uint16_t)end;
    }
    for (uint32_t i = site->plan.wall_count; i > 0; i--) {
        enter_wall(site, (uint16_t)(i - 1u), true);
    }
    return true;
}

/* The finest grid of about CELLS_PER_WALL cells a wall that the memory holds. */
static bool lay_grid(site_t *site, insole_real_t width_m, insole_real_t height_m)
{
    insole_real_t cells = (insole_real_t)CELLS_PER_WALL * (insole_real_t)site->plan.wall_count;
    insole_real_t cell_m = insole_max(CELL_MIN_M, insole_sqrt(width_m * height_m / cells));
    for (int32_t i = 0; i < COARSER_TRIES; i++) {
        if (lay_cells(site, width_m, height_m, cell_m) && enter_walls(site)) {
            return true;
        }
        cell_m *= COARSER;
    }
    return false;
}

/* ---- reference points ---- */

static insole_real_t spot_x_m(const insole_floor_plan_t *plan, int32_t column)
{
    return ((insole_real_t)column + plan->spot_x) * plan->cell_m;
}

static insole_real_t spot_y_m(const insole_floor_plan_t *plan, int32_t row)
{
    return ((insole_real_t)row + plan->spot_y) * plan->cell_m;
}

/* Squared distance of the reference points from the nearest edge, each in its own cell. */
static insole_real_t spot_clearance2_m2(const site_t *site)
{
    insole_real_t least_m2 = INSOLE_REAL_MAX;
    for (int32_t i = 0; i < site->plan.columns * site->plan.rows; i++) {
        insole_real_t x_m = spot_x_m(&site->plan, i % site->plan.columns);
        insole_real_t y_m = spot_y_m(&site->plan, i / site->plan.columns);
        for (uint32_t k = site->plan.cells[i].begin; k < site->plan.cells[i + 1].begin; k++) {
            const insole_wall_t *wall = &site->plan.walls[site->plan.entries[k]];
            insole_real_t length2_m2 =
                insole_square(wall->x1_m - wall->x0_m) + insole_square(wall->y1_m - wall->y0_m);
            least_m2 =
                insole_min(least_m2, insole_square(insole_wall_side(wall, x_m, y_m)) / length2_m2);
        }
    }
    return least_m2;
}

/* Takes, of some spots spread evenly, the one that keeps farthest from walls: a reference point on
 * an edge would belong to neither side of it. */
static void choose_spot(site_t *site)
{
    insole_real_t best_x = ZERO, best_y = ZERO, best_m2 = INSOLE_R(-1.0);
    for (int32_t i = 0; i < SPOT_TRIES; i++) {
        insole_real_t a = INSOLE_R(0.7548777) * (insole_real_t)i;
        insole_real_t b = INSOLE_R(0.5698403) * (insole_real_t)i;
        site->plan.spot_x = INSOLE_R(0.26) + INSOLE_R(0.5) * (a - (insole_real_t)(int32_t)a);
        site->plan.spot_y = INSOLE_R(0.27) + INSOLE_R(0.5) * (b - (insole_real_t)(int32_t)b);
        insole_real_t clearance2_m2 = spot_clearance2_m2(site);
        if (clearance2_m2 > best_m2) {
            best_m2 = clearance2_m2;
            best_x = site->plan.spot_x;
            best_y = site->plan.spot_y;
        }
    }
    site->plan.spot_x = best_x;
    site->plan.spot_y = best_y;
}

/* What one edge adds to the winding around a point: whether it passes right of it, going up or
 * down. */
static int32_t winding_of(const insole_wall_t *edge, insole_real_t x_m, insole_real_t y_m)
{
    bool upwards = edge->y1_m > y_m;
    if ((edge->y0_m > y_m) == upwards) {
        return 0;
    }
    insole_real_t side = insole_wall_side(edge, x_m, y_m);
    return upwards ? (side > ZERO) : -(side < ZERO);
}

static void wind_edge(const site_t *site, uint16_t number)
{
    const insole_wall_t *edge = &site->memory->walls[number];
    block_t block = block_of(site, edge);
    for (int32_t row = block.row_low; row <= block.row_high; row++) {
        for (int32_t column = 0; column <= block.column_high; column++) {
            insole_floor_plan_cell_t *cell = cell_at(site, column, row);
            int32_t winding =
                winding_of(edge, spot_x_m(&site->plan, column), spot_y_m(&site->plan, row));
            uint8_t *sum = number < site->plan.outline_walls ? &cell->outlines : &cell->holes;
            *sum = (uint8_t)(*sum + winding);
        }
    }
}

insole_status_t insole_floor_plan_build(insole_floor_plan_t *plan,
                                        const insole_floor_plan_line_t *lines, uint32_t count,
                                        const insole_floor_plan_memory_t *memory)
{
    if (plan == NULL || lines == NULL || memory == NULL || memory->walls == NULL ||
        memory->cells == NULL || memory->entries == NULL) {
        return INSOLE_ERR_NULL;
    }
    extent_t extent;
    insole_status_t status = survey(lines, count, memory->wall_room, &extent);
    if (status != INSOLE_OK) {
        return status;
    }
    site_t site = {{0}, memory};
    site.plan.walls = memory->walls;
    site.plan.cells = memory->cells;
    site.plan.entries = memory->entries;
    site.plan.origin_x_m = whole_metres_below(extent.x_low_m);
    site.plan.origin_y_m = whole_metres_below(extent.y_low_m);
    site.plan.outline_walls = add_lines(&site, lines, count, INSOLE_LINE_OUTLINE);
    site.plan.ring_walls = add_lines(&site, lines, count, INSOLE_LINE_HOLE);
    if (add_lines(&site, lines, count, INSOLE_LINE_WALL) == 0u) {
        return INSOLE_ERR_STATE;
    }
    if (!lay_grid(&site, extent.x_high_m - site.plan.origin_x_m + INSOLE_R(1.0),
                  extent.y_high_m - site.plan.origin_y_m + INSOLE_R(1.0))) {
        return INSOLE_ERR_ROOM;
    }
    choose_spot(&site);
    for (uint32_t i = 0; i < site.plan.ring_walls; i++) {
        wind_edge(&site, (uint16_t)i);
    }
    *plan = site.plan;
    return INSOLE_OK;
}
