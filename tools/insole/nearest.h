/** @file nearest.h  What the user may have meant.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_NEAREST_H
#define INSOLE_HOST_NEAREST_H

#include <stdbool.h>
#include <stddef.h>

/** The best of the words offered so far. */
typedef struct {
    const char *wanted;
    const char *best; /**< NULL: nothing is near enough */
    size_t distance;  /**< of the best, in letters */
} nearest_t;

void nearest_begin(nearest_t *nearest, const char *wanted);

/** Offers a word: it is kept when it is nearer than those before and not too far: a third of
 *  its letters may differ, or all that the user left out. */
void nearest_offer(nearest_t *nearest, const char *word);

/** Letters to insert, drop, change or swap with their neighbour to get from one to the other. */
size_t nearest_distance(const char *a, const char *b);

#endif
