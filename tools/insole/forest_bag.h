/** @file forest_bag.h  The windows that a tree sees: as many of each class, from random blocks.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_FOREST_BAG_H
#define INSOLE_HOST_FOREST_BAG_H

#include "carry_windows.h"
#include "insole/base/rng.h"

/** Runs of numbers: those of run k are at[from[k]] to at[from[k + 1] - 1]. */
typedef struct {
    uint32_t *at, *from;
} runs_t;

typedef struct {
    const carry_windows_t *windows;
    size_t per_class;
    runs_t rows_of_block, blocks_of_group, groups_of_class;
    uint32_t *drawn; /**< blocks drawn for a class */
    bool *is_drawn;  /**< per block, by any class */
    uint32_t *rows;  /**< the bag */
    size_t count, room;
} forest_bag_t;

/** A number below `limit`. */
uint32_t forest_draw(insole_rng_t *rng, uint32_t limit);

/** @param is_used  per log: may its windows be drawn?
 *  @return false when there are not two classes or one has no windows; nothing to close then */
bool forest_bag_open(forest_bag_t *bag, const carry_windows_t *windows, const bool *is_used,
                     size_t per_class, failure_t *failure);

/** Fills the bag anew. */
void forest_bag_draw(forest_bag_t *bag, insole_rng_t *rng);

void forest_bag_close(forest_bag_t *bag);

#endif
