/** @file floor_plan_build.h  Builds a floor plan with its grid from drawn lines.
 *
 *  Source  [TwoOrder] 3.2: the geometric profile of the building, made before the walk.
 *  Frames  m: map, x east, y north, metres.
 *
 *  Firmware whose plan lies packed in flash does not need this part.
 *
 *      static insole_wall_t walls[1000];
 *      static insole_floor_plan_cell_t cells[3000];
 *      static uint16_t entries[8000];
 *      insole_floor_plan_memory_t memory = {walls, 1000, cells, 3000, entries, 8000};
 *      insole_floor_plan_line_t lines[] = {{INSOLE_LINE_OUTLINE, outline_xy_m, 4, loss_db},
 *                                          {INSOLE_LINE_WALL, wall_xy_m, 2, loss_db}};
 *      insole_floor_plan_build(&plan, lines, 2, &memory);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_FLOOR_PLAN_BUILD_H
#define INSOLE_PLACE_FLOOR_PLAN_BUILD_H

#include "insole/place/floor_plan.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What a line of the plan is; every edge of a ring is a wall too. */
typedef enum {
    INSOLE_LINE_OUTLINE = 0, /**< ring around an area that can be walked; several may overlap */
    INSOLE_LINE_HOLE = 1,    /**< ring around an area where nobody can be; several may overlap */
    INSOLE_LINE_WALL = 2     /**< open line of walls; a door is a gap between two of them */
} insole_line_kind_t;

/** One line as it is drawn. */
typedef struct {
    insole_line_kind_t kind;
    const insole_real_t *xy_m; /**< x, y, x, y, ...; a ring closes by itself, either way round */
    uint32_t points;           /**< ring: at least 3, wall: at least 2 */
    insole_real_t loss_db;     /**< what radio loses at each of its walls, 0 .. 1000 */
} insole_floor_plan_line_t;

/** The caller's memory that a plan is built in. Enough for nearly any plan: as many walls as there
 *  are points, 2 cells and 8 entries a wall; with less, the grid is made coarser. */
typedef struct {
    insole_wall_t *walls;
    uint32_t wall_room;
    insole_floor_plan_cell_t *cells;
    uint32_t cell_room;
    uint16_t *entries;
    uint32_t entry_room;
} insole_floor_plan_memory_t;

/** Builds a plan. A point that repeats the one before adds no wall. `memory` is written to even
 *  when the plan is refused; `plan` is not.
 *  @return INSOLE_ERR_VALUE for a coordinate beyond 100 km, a loss out of range, a line of too few
 *          points or of unknown kind; INSOLE_ERR_ROOM when the memory is too small, or the plan too
 *          large for it (65535 walls, 65534 cells, 65535 entries); INSOLE_ERR_STATE without a wall
 */
insole_status_t insole_floor_plan_build(insole_floor_plan_t *plan,
                                        const insole_floor_plan_line_t *lines, uint32_t count,
                                        const insole_floor_plan_memory_t *memory);

#ifdef __cplusplus
}
#endif

#endif
