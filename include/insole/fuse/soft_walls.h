/** @file soft_walls.h  A plan that may lack doors: who is deep in a closed area weighs less.
 *
 *  Source  ours, in the place of [TwoOrder (40)]: there a particle in the building structure dies.
 *  Frames  m: map.
 *
 *  A plan tells where people usually walk. A point counts as closed only when it lies deep in what
 *  is not walkable, each stride that ends there weighs less, and when nearly all particles would,
 *  the plan is taken to be wrong and says nothing of this stride. Hence two rounds.
 *  No cloud is drawn outside of the plan, though: who begins somewhere is where one walks.
 *
 *      insole_soft_walls_begin(&soft, 1, 0.2, 0.02);
 *      for each particle:
 *          insole_soft_walls_look(&soft, &plan, x, y);
 *      for each particle:
 *          log_weight += insole_soft_walls_weigh(&soft, &plan, x, y);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_SOFT_WALLS_H
#define INSOLE_FUSE_SOFT_WALLS_H

#include "insole/place/floor_plan.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_real_t depth_m;    /**< from the nearest edge of the walkable area on */
    insole_real_t log_weight; /**< of a stride that ends there */
    insole_real_t least_free; /**< share of the particles that must not */
    uint32_t seen, closed;    /**< particles */
} insole_soft_walls_t;

/** Nobody has been looked at.
 *  @param depth_m     >= 0
 *  @param weight      > 0 .. 1
 *  @param least_free  0 .. 1; 0: always counts */
void insole_soft_walls_begin(insole_soft_walls_t *soft, insole_real_t depth_m, insole_real_t weight,
                             insole_real_t least_free);

/** First round: sees whether a particle is in a closed area. */
void insole_soft_walls_look(insole_soft_walls_t *soft, const insole_floor_plan_t *plan,
                            insole_real_t x_m, insole_real_t y_m);

/** Whether the plan says anything of this stride. */
bool insole_soft_walls_count(const insole_soft_walls_t *soft);

/** Second round: logarithm of the weight. */
insole_real_t insole_soft_walls_weigh(const insole_soft_walls_t *soft,
                                      const insole_floor_plan_t *plan, insole_real_t x_m,
                                      insole_real_t y_m);

#ifdef __cplusplus
}
#endif

#endif
