/** @file forest_grow.h  Grows a random forest (bagging, Gini, a few features per node) of windows.
 *
 *  Each tree sees a bag of its own: of every class as many windows, drawn from random blocks of the
 *  logs, groups of equal person and position alike, so that no class and no person wins by count.
 *  Blocks that a tree did not draw judge it: out of bag. The same seed gives the same forest.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_FOREST_GROW_H
#define INSOLE_HOST_FOREST_GROW_H

#include "carry_windows.h"
#include "confusion.h"

enum { FOREST_MOST_TREES = 200, FOREST_MOST_DEPTH = 7 /**< 127 nodes: links fit */ };

typedef struct {
    int64_t trees, depth, min_leaf;
    int64_t bag;      /**< windows of each class in a tree's bag */
    int64_t features; /**< the first so many are used */
    uint64_t seed;
} forest_settings_t;

extern const forest_settings_t forest_defaults;

/** A forest and its memory. It points at the names of the windows' classes. */
typedef struct {
    insole_carry_forest_t forest;
    insole_carry_node_t *nodes;
    size_t node_count, room;
    uint16_t roots[FOREST_MOST_TREES + 1];
} grown_t;

/** @param is_used  per log: may the forest see it?
 *  @param[out] out_of_bag  of the windows as they were felt; NULL: nobody asks
 *  @return false when a class has no windows among those logs, or there are not two */
bool forest_grow(grown_t *grown, const carry_windows_t *windows, const bool *is_used,
                 const forest_settings_t *settings, confusion_t *out_of_bag, failure_t *failure);

/** Bytes of flash that the table takes. */
size_t forest_bytes(const grown_t *grown);

void forest_free(grown_t *grown);

#endif
