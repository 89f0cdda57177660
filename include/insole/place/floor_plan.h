/** @file floor_plan.h  Walls and walkable area of one floor, searched through a grid.
 *
 *  Source  [TwoOrder] 2.4 (walls between a point and an access point), 3.2 (40) (a particle that
 *          walks into the building structure).
 *  Frames  m: map, x east, y north, metres. The plan keeps its walls relative to an origin of its
 *          own, so that a floor 10 km from the map's zero is as sharp as one at it.
 *
 *  A plan is built once (floor_plan_build.h) and then only read: it is numbers and pointers to
 *  constant tables, and may as well lie in flash. A question walks the cells along its segment, so
 * it costs by the length of the segment and the density of walls, not by their number.
 *
 *      const insole_floor_plan_t plan = ...;   built by floor_plan_build.h, or packed in flash
 *      for each particle:
 *          if (insole_floor_plan_crosses(&plan, x, y, x + dx, y + dy)) weight = 0;
 *          if (!insole_floor_plan_inside(&plan, x, y)) weight = 0;
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_FLOOR_PLAN_H
#define INSOLE_PLACE_FLOOR_PLAN_H

#include "insole/base/real.h"
#include "insole/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Nearer to a wall than this is on the wall [m]. */
#define INSOLE_FLOOR_PLAN_TOUCH_M INSOLE_R(0.001)

/** Coordinates that add up to more than this are no place on any map [m]. */
#define INSOLE_FLOOR_PLAN_LIMIT_M INSOLE_R(1e6)

/** One straight wall, relative to the plan's origin. The area of a ring lies left of it. */
typedef struct {
    insole_real_t x0_m, y0_m, x1_m, y1_m;
    insole_real_t loss_db;
} insole_wall_t;

/** Twice the area between a wall and a point of the same frame: positive left of the wall. */
static inline insole_real_t insole_wall_side(const insole_wall_t *wall, insole_real_t x_m,
                                             insole_real_t y_m)
{
    return (wall->x1_m - wall->x0_m) * (y_m - wall->y0_m) -
           (wall->y1_m - wall->y0_m) * (x_m - wall->x0_m);
}

/** One cell of the grid; one more than there are cells closes the table. */
typedef struct {
    uint16_t begin;   /**< first of its entries; the next cell's `begin` ends them */
    uint8_t outlines; /**< how often outlines run around the cell's reference point, modulo 256 */
    uint8_t holes;    /**< how often holes do */
} insole_floor_plan_cell_t;

/** A plan that can be asked. Everything it points at is constant. */
typedef struct {
    insole_real_t origin_x_m, origin_y_m; /**< m-frame place of the grid's corner */
    insole_real_t cell_m;                 /**< side of a cell */
    insole_real_t cells_per_m;
    insole_real_t spot_x, spot_y; /**< reference point of a cell: share of its sides */
    uint16_t columns, rows;
    uint16_t outline_walls;                /**< the first walls are edges of outlines, ... */
    uint16_t ring_walls;                   /**< ... those up to here of holes, the rest inner */
    uint16_t wall_count;                   /**< walls in all */
    const insole_wall_t *walls;            /**< `wall_count` */
    const insole_floor_plan_cell_t *cells; /**< `columns` x `rows` + 1, row by row */
    const uint16_t *entries;               /**< numbers of the walls near each cell */
} insole_floor_plan_t;

/** What radio meets between two points. */
typedef struct {
    uint32_t count;        /**< k_w of [TwoOrder (10)] */
    insole_real_t loss_db; /**< their k_w l_w, each wall with its own loss */
} insole_walls_between_t;

/** Does the way from (x0, y0) to (x1, y1) meet a wall? [TwoOrder (40)]
 *
 *  Both ways and walls are closed: whatever comes within INSOLE_FLOOR_PLAN_TOUCH_M of a wall meets
 *  it, whatever keeps twice that distance does not, between the two either may be. Hence touching a
 *  corner, ending at a wall, running along one, and standing on one all count; a way through a door
 *  does not. A way outside the plan meets nothing.
 *  @return true also where the question has no answer: `plan` NULL, coordinates out of range */
bool insole_floor_plan_crosses(const insole_floor_plan_t *plan, insole_real_t x0_m,
                               insole_real_t y0_m, insole_real_t x1_m, insole_real_t y1_m);

/** Is the point in the walkable area: inside an outline and outside all holes? On an edge either
 *  may be.
 *  @return false also for `plan` NULL and coordinates out of range */
bool insole_floor_plan_inside(const insole_floor_plan_t *plan, insole_real_t x_m,
                              insole_real_t y_m);

/** The walls that radio passes from (x0, y0) to (x1, y1), k_w and l_w of [TwoOrder (10)].
 *
 *  A wall counts once, and only when the two points lie on different sides of it, both farther from
 *  its line than INSOLE_FLOOR_PLAN_TOUCH_M: an access point mounted on a wall is not behind it, and
 *  a ray along a wall meets nothing. A ray through the corner of two walls meets one of them if
 *  they lie on different sides of the ray, else both or none.
 *  @return INSOLE_ERR_VALUE for coordinates out of range */
insole_status_t insole_floor_plan_walls_between(const insole_floor_plan_t *plan, insole_real_t x0_m,
                                                insole_real_t y0_m, insole_real_t x1_m,
                                                insole_real_t y1_m,
                                                insole_walls_between_t *between);

/** The same for who asks of no more than `enough_db`: once the walls met lose so much, others may
 * be left out. */
insole_status_t insole_floor_plan_walls_until(const insole_floor_plan_t *plan, insole_real_t x0_m,
                                              insole_real_t y0_m, insole_real_t x1_m,
                                              insole_real_t y1_m, insole_real_t enough_db,
                                              insole_walls_between_t *between);

/** Distance to the nearest wall, at most `limit_m`; costs by the area of `limit_m`.
 *  @param[out] distance_m  0 .. limit_m
 *  @return INSOLE_ERR_VALUE for coordinates out of range or a limit that is not positive */
insole_status_t insole_floor_plan_clearance(const insole_floor_plan_t *plan, insole_real_t x_m,
                                            insole_real_t y_m, insole_real_t limit_m,
                                            insole_real_t *distance_m);

/** Does the point lie deep in a closed area: outside the walkable area, and farther than `depth_m`
 *  from each edge of it? Inner walls do not count. An edge that another outline or hole covers
 * does; all that lies far outside the plan is closed. Costs by the area of `depth_m` where the
 * point is not walkable, else as much as insole_floor_plan_inside().
 *  @param depth_m  >= 0
 *  @return false also for `plan` NULL; for coordinates out of range, or a depth that is no number,
 *          as if outside, and deep */
bool insole_floor_plan_is_closed(const insole_floor_plan_t *plan, insole_real_t x_m,
                                 insole_real_t y_m, insole_real_t depth_m);

#ifdef __cplusplus
}
#endif

#endif
