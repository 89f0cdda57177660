/** @file carry_forest.h  A random forest in flash: trees vote on the class of a few features.
 *
 *  Source  [PhoneUKF] 4: a random forest tells the carrying position. Tables are grown by
 *          `insole train-carry`.
 *
 *      extern const insole_carry_forest_t people_forest;           of the table's own file
 *      if (insole_carry_forest_check(&people_forest) != INSOLE_OK) refuse it;
 *      insole_carry_forest_vote(&people_forest, &features, &votes);
 *      name = people_forest.names[votes.winner];
 *
 *  A class is a number, and which position it is, the table alone knows: 0 is the first of its
 *  names. A node asks whether a feature is at most a threshold and leads to one of two others,
 *  which stand behind it in the same tree, or to a class. Hence a walk through a tree ends, and one
 *  through a damaged table too.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_CARRY_FOREST_H
#define INSOLE_SENSE_CARRY_FOREST_H

#include "insole/sense/carry_window.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    INSOLE_CARRY_CLASSES = 8,     /**< most classes of a table */
    INSOLE_CARRY_TREE_NODES = 240 /**< most nodes of a tree; greater links are classes */
};

/** Where a node leads to: a node of the tree, counted from its root, or a class. */
#define INSOLE_CARRY_LEAF(number) ((uint8_t)(INSOLE_CARRY_TREE_NODES + (number)))

typedef struct {
    insole_real_t threshold;
    uint8_t feature;
    uint8_t at_most; /**< link when the feature is at most the threshold */
    uint8_t above;   /**< link when it is above */
} insole_carry_node_t;

/** A table. Its trees stand one after the other. */
typedef struct {
    const insole_carry_node_t *nodes;
    const uint16_t *roots; /**< `tree_count` + 1: first node of each tree, then the node count */
    const char *const *names;
    uint16_t tree_count;
    uint8_t class_count;
} insole_carry_forest_t;

/** What the trees say. */
typedef struct {
    insole_real_t share[INSOLE_CARRY_CLASSES]; /**< of the trees; sums to 1 */
    int32_t winner;                            /**< class with the most; of equals the first */
} insole_carry_votes_t;

/** Reads a whole table.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_DATA: no trees, fewer than two classes or more than there
 *          may be, a tree without nodes or with too many, a link or feature that is none, a
 *          threshold that is no number */
insole_status_t insole_carry_forest_check(const insole_carry_forest_t *forest);

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE: a feature is not finite; INSOLE_ERR_DATA: the table
 *          is damaged where the features lead; INSOLE_ERR_STATE: it asks there about the turn rate,
 *          and there was no gyroscope */
insole_status_t insole_carry_forest_vote(const insole_carry_forest_t *forest,
                                         const insole_carry_features_t *features,
                                         insole_carry_votes_t *votes);

#ifdef __cplusplus
}
#endif

#endif
