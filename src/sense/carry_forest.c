/* SPDX-License-Identifier: MIT */
#include "insole/sense/carry_forest.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

enum { NO_CLASS = -1, NO_GYRO = -2 };

static bool is_sized(const insole_carry_forest_t *forest)
{
    return forest->tree_count > 0u && forest->class_count >= 2u &&
           forest->class_count <= INSOLE_CARRY_CLASSES;
}

static bool has_pointers(const insole_carry_forest_t *forest)
{
    return forest && forest->nodes && forest->roots && forest->names;
}

static uint32_t node_count(const insole_carry_forest_t *forest, uint32_t tree)
{
    uint16_t first = forest->roots[tree], end = forest->roots[tree + 1u];
    return end > first ? (uint32_t)end - first : 0u;
}

/* A link leads to a class, or to a node behind the one it comes from. */
static bool is_link(const insole_carry_forest_t *forest, uint32_t link, uint32_t from,
                    uint32_t count)
{
    return link >= INSOLE_CARRY_TREE_NODES
               ? link < (uint32_t)INSOLE_CARRY_TREE_NODES + forest->class_count
               : link > from && link < count;
}

static bool is_tree(const insole_carry_forest_t *forest, uint32_t tree)
{
    const insole_carry_node_t *nodes = &forest->nodes[forest->roots[tree]];
    uint32_t count = node_count(forest, tree);
    bool is_good = count > 0u && count <= INSOLE_CARRY_TREE_NODES;
    for (uint32_t i = 0u; i < count && is_good; i++) {
        is_good = nodes[i].feature < INSOLE_CARRY_FEATURES &&
                  insole_is_finite(nodes[i].threshold) &&
                  is_link(forest, nodes[i].at_most, i, count) &&
                  is_link(forest, nodes[i].above, i, count);
    }
    return is_good;
}

insole_status_t insole_carry_forest_check(const insole_carry_forest_t *forest)
{
    if (!has_pointers(forest)) {
        return INSOLE_ERR_NULL;
    }
    bool is_good = is_sized(forest) && forest->roots[0] == 0u;
    for (uint32_t tree = 0u; is_good && tree < forest->tree_count; tree++) {
        is_good = is_tree(forest, tree);
    }
    return is_good ? INSOLE_OK : INSOLE_ERR_DATA;
}

/* @return the class that the tree votes for, or NO_CLASS, or NO_GYRO where it would need one */
static int32_t walk(const insole_carry_forest_t *forest, uint32_t tree,
                    const insole_carry_features_t *features)
{
    uint32_t known = features->has_gyro ? INSOLE_CARRY_FEATURES : INSOLE_CARRY_ACCEL;
    const insole_carry_node_t *nodes = &forest->nodes[forest->roots[tree]];
    uint32_t count = node_count(forest, tree), at = 0u;
    while (at < count) {
        const insole_carry_node_t *node = &nodes[at];
        if (node->feature >= known) {
            return node->feature < INSOLE_CARRY_FEATURES ? NO_GYRO : NO_CLASS;
        }
        uint32_t link =
            features->value[node->feature] <= node->threshold ? node->at_most : node->above;
        if (!is_link(forest, link, at, count)) {
            return NO_CLASS;
        }
        if (link >= INSOLE_CARRY_TREE_NODES) {
            return (int32_t)link - INSOLE_CARRY_TREE_NODES;
        }
        at = link;
    }
    return NO_CLASS;
}

static bool are_finite(const insole_carry_features_t *features)
{
    bool is_good = true;
    for (uint32_t i = 0u; i < INSOLE_CARRY_FEATURES; i++) {
        is_good = is_good && insole_is_finite(features->value[i]);
    }
    return is_good;
}

static void count_up(const uint32_t *count, uint32_t trees, insole_carry_votes_t *votes)
{
    votes->winner = 0;
    for (int32_t k = 0; k < INSOLE_CARRY_CLASSES; k++) {
        votes->share[k] = (insole_real_t)count[k] / (insole_real_t)trees;
        votes->winner = count[k] > count[votes->winner] ? k : votes->winner;
    }
}

insole_status_t insole_carry_forest_vote(const insole_carry_forest_t *forest,
                                         const insole_carry_features_t *features,
                                         insole_carry_votes_t *votes)
{
    if (!has_pointers(forest) || !features || !votes) {
        return INSOLE_ERR_NULL;
    }
    if (!are_finite(features)) {
        return INSOLE_ERR_VALUE;
    }
    if (!is_sized(forest)) {
        return INSOLE_ERR_DATA;
    }
    uint32_t count[INSOLE_CARRY_CLASSES] = {0u};
    for (uint32_t tree = 0u; tree < forest->tree_count; tree++) {
        int32_t vote = walk(forest, tree, features);
        if (vote < 0) {
            return vote == NO_GYRO ? INSOLE_ERR_STATE : INSOLE_ERR_DATA;
        }
        count[vote]++;
    }
    count_up(count, forest->tree_count, votes);
    return INSOLE_OK;
}
