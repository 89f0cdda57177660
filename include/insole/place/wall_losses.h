/** @file wall_losses.h  What walls cost the radio, around the walker, counted once.
 *
 *  Source  [TwoOrder] 2.4, k_w l_w of (10).
 *  Frames  m: map, x east, y north, metres.
 *
 *  A square lattice of nodes follows the walker by whole nodes. It is fixed to the map, so a loss
 *  that was counted holds for as long as its node stays: a walker's next stride brings in a few new
 *  nodes, and only for these walls are searched.
 *
 *      static insole_wall_losses_t losses;
 *      insole_wall_losses_init(&losses);
 *      insole_wall_losses_limit(&losses, config.walls_max_db);
 *      insole_wall_losses_move(&losses, spacing_m, x_m, y_m);
 *      insole_wall_losses_reserve(&losses, ids, count, slots);
 *      for all nodes, for all access points k heard:
 *          loss_db = insole_wall_losses_at(&losses, &plan, node, slots[k], ap);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_WALL_LOSSES_H
#define INSOLE_PLACE_WALL_LOSSES_H

#include "insole/base/types.h"
#include "insole/place/floor_plan.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    INSOLE_WALL_LOSSES_SIDE = 6, /**< nodes along a side of the lattice */
    INSOLE_WALL_LOSSES_NODES = INSOLE_WALL_LOSSES_SIDE * INSOLE_WALL_LOSSES_SIDE,
    INSOLE_WALL_LOSSES_SLOTS = 16 /**< access points whose losses are kept */
};

/** Largest coordinate and spacing [m]. */
#define INSOLE_WALL_LOSSES_REACH_M INSOLE_R(1e5)

/** Nothing is heard through walls that lose more [dB]. */
#define INSOLE_WALL_LOSSES_MOST_DB INSOLE_R(127.0)

/** Losses of one access point. A node keeps its place in the list for as long as it stays. */
typedef struct {
    uint32_t id;                             /**< of the access point; UINT32_MAX: of none */
    uint8_t steps[INSOLE_WALL_LOSSES_NODES]; /**< of `step_db`; 255: not counted yet */
} insole_wall_losses_slot_t;

typedef struct {
    insole_wall_losses_slot_t slot[INSOLE_WALL_LOSSES_SLOTS];
    insole_real_t limit_db;  /**< no loss is more */
    insole_real_t step_db;   /**< losses are kept in whole steps */
    insole_real_t spacing_m; /**< distance of nodes */
    int32_t column, row;     /**< map numbers of the lowest node: its x is column x spacing */
} insole_wall_losses_t;

/** Losses are limited to 31.75 dB.
 *  @return INSOLE_ERR_NULL */
insole_status_t insole_wall_losses_init(insole_wall_losses_t *losses);

/** What loses more counts as this limit: walls are counted until it is reached. Losses are kept to
 *  half a step: of 1/8 dB for limits up to 31.75 dB, of 1/4 dB up to 63.5 dB, beyond of 1/2 dB.
 * With another limit all losses are forgotten.
 *  @param limit_db  >= 0; more than INSOLE_WALL_LOSSES_MOST_DB counts as this
 *  @return INSOLE_ERR_VALUE for what is negative or no number */
insole_status_t insole_wall_losses_limit(insole_wall_losses_t *losses, insole_real_t limit_db);

/** Lays the lattice so that (x, y) lies within half a spacing of its centre. With another spacing
 *  all losses are forgotten.
 *  @return INSOLE_ERR_VALUE for coordinates beyond the reach, a spacing under 0.01 m */
insole_status_t insole_wall_losses_move(insole_wall_losses_t *losses, insole_real_t spacing_m,
                                        insole_real_t x_m, insole_real_t y_m);

/** Finds a slot for each of the access points, all different; those of others are given up when
 *  they are needed.
 *  @return INSOLE_ERR_ROOM for more access points than slots */
insole_status_t insole_wall_losses_reserve(insole_wall_losses_t *losses, const uint32_t *ids,
                                           uint32_t count, uint8_t *slots);

/** Where a node lies; nodes count row by row from the lowest. */
insole_spot_t insole_wall_losses_spot(const insole_wall_losses_t *losses, uint32_t node);

/** Loss of all walls between a node and an access point at (x, y), in dB, at most the limit.
 *  @param plan  NULL: no walls
 *  @return 0 for what makes no sense */
insole_real_t insole_wall_losses_at(insole_wall_losses_t *losses, const insole_floor_plan_t *plan,
                                    uint32_t node, uint32_t slot, insole_spot_t ap);

/** The same between any two places, neither kept nor in steps. */
insole_real_t insole_wall_losses_between(const insole_floor_plan_t *plan, insole_spot_t from,
                                         insole_spot_t to, insole_real_t limit_db);

#ifdef __cplusplus
}
#endif

#endif
