/* SPDX-License-Identifier: MIT */
#include "forest_grow.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "forest_bag.h"
#include "insole/base/rng.h"
#include "memory.h"
#include "progress.h"

const forest_settings_t forest_defaults = {40,  FOREST_MOST_DEPTH,     10,
                                           300, INSOLE_CARRY_FEATURES, 1u};

enum { NUMBER_ROOM = 40, MOST_DIGITS = 17 };

/* A window at a node, by one feature. */
typedef struct {
    insole_real_t value;
    int class_number;
} item_t;

typedef struct {
    grown_t *grown;
    const carry_windows_t *windows;
    const forest_settings_t *settings;
    insole_rng_t rng;
    item_t *items;    /* room for a whole bag */
    size_t tree_root; /* first node of the tree that grows */
} grower_t;

/* A way to cut a node in two. */
typedef struct {
    uint8_t feature;
    insole_real_t threshold;
    double purity; /* sum over both sides of sum of squared counts / count: Gini turned round */
} cut_t;

static int class_of(const grower_t *grower, uint32_t row)
{
    const carry_windows_t *windows = grower->windows;
    return windows->logs[windows->rows[row].log].class_number;
}

/* ---- cuts ------------------------------------------------------------------------------- */

static double purity_of(const double *count, double total)
{
    double squares = 0.0;
    for (int k = 0; k < INSOLE_CARRY_CLASSES; k++) {
        squares += count[k] * count[k];
    }
    return squares / total;
}

static int by_value(const void *a, const void *b)
{
    const item_t *x = a, *y = b;
    return (x->value > y->value) - (x->value < y->value);
}

static void count_classes(const item_t *items, size_t count, double *classes)
{
    memset(classes, 0, INSOLE_CARRY_CLASSES * sizeof *classes);
    for (size_t i = 0u; i < count; i++) {
        classes[items[i].class_number] += 1.0;
    }
}

/* The shortest number near the middle of two values that differ: at least the lower one and below
 * the other. */
static insole_real_t between(insole_real_t low, insole_real_t high)
{
    char text[NUMBER_ROOM];
    insole_real_t middle = low + INSOLE_R(0.5) * (high - low);
    for (int digits = 2; digits <= MOST_DIGITS; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, (double)middle);
        insole_real_t value = (insole_real_t)strtod(text, NULL);
        if (value >= low && value < high) {
            return value;
        }
    }
    return low;
}

/* Tries all cuts of one feature. */
static void try_feature(const grower_t *grower, const uint32_t *rows, size_t count, uint8_t feature,
                        cut_t *best)
{
    item_t *items = grower->items;
    double low[INSOLE_CARRY_CLASSES] = {0.0}, high[INSOLE_CARRY_CLASSES];
    size_t least = (size_t)grower->settings->min_leaf;
    for (size_t i = 0u; i < count; i++) {
        items[i].value = grower->windows->rows[rows[i]].features.value[feature];
        items[i].class_number = class_of(grower, rows[i]);
    }
    qsort(items, count, sizeof *items, by_value);
    count_classes(items, count, high);
    for (size_t below = 1u; below < count; below++) {
        low[items[below - 1u].class_number] += 1.0;
        high[items[below - 1u].class_number] -= 1.0;
        if (below < least || count - below < least ||
            !(items[below].value > items[below - 1u].value)) {
            continue;
        }
        double purity = purity_of(low, (double)below) + purity_of(high, (double)(count - below));
        if (purity > best->purity) {
            best->purity = purity;
            best->feature = feature;
            best->threshold = between(items[below - 1u].value, items[below].value);
        }
    }
}

/* The best cut by one of a few features, drawn anew for each node. @return false: none helps */
static bool find_cut(grower_t *grower, const uint32_t *rows, size_t count, double purity,
                     cut_t *best)
{
    uint8_t features[INSOLE_CARRY_FEATURES] = {0u};
    uint32_t all = (uint32_t)grower->settings->features;
    uint32_t few = (uint32_t)(sqrt((double)all) + 0.5);
    best->purity = purity * (1.0 + 1.0e-9);
    for (uint32_t i = 0u; i < all; i++) {
        features[i] = (uint8_t)i;
    }
    for (uint32_t i = 0u; i < few; i++) {
        uint32_t other = i + forest_draw(&grower->rng, all - i);
        uint8_t feature = features[other];
        features[other] = features[i];
        features[i] = feature;
        try_feature(grower, rows, count, feature, best);
    }
    return best->purity > purity * (1.0 + 1.0e-9);
}

/* ---- trees ------------------------------------------------------------------------------ */

static size_t add_node(grown_t *grown)
{
    grown->nodes =
        memory_room(grown->nodes, &grown->room, grown->node_count + 1u, sizeof *grown->nodes);
    memset(&grown->nodes[grown->node_count], 0, sizeof *grown->nodes);
    return grown->node_count++;
}

/* Rows at most the threshold come first. @return how many they are */
static size_t part(const grower_t *grower, uint32_t *rows, size_t count, const cut_t *cut)
{
    size_t low = 0u;
    for (size_t i = 0u; i < count; i++) {
        uint32_t row = rows[i];
        if (grower->windows->rows[row].features.value[cut->feature] <= cut->threshold) {
            rows[i] = rows[low];
            rows[low++] = row;
        }
    }
    return low;
}

static uint8_t leaf(const double *classes)
{
    int most = 0;
    for (int k = 1; k < INSOLE_CARRY_CLASSES; k++) {
        most = classes[k] > classes[most] ? k : most;
    }
    return INSOLE_CARRY_LEAF(most);
}

/* @return the link that leads to what has grown: a node, or a class */
static uint8_t grow_branch(grower_t *grower, uint32_t *rows, size_t count, int64_t depth)
{
    double classes[INSOLE_CARRY_CLASSES] = {0.0};
    cut_t cut = {0u, INSOLE_R(0.0), 0.0};
    for (size_t i = 0u; i < count; i++) {
        classes[class_of(grower, rows[i])] += 1.0;
    }
    if (depth == 0 || !find_cut(grower, rows, count, purity_of(classes, (double)count), &cut)) {
        return leaf(classes);
    }
    size_t at = add_node(grower->grown);
    size_t low = part(grower, rows, count, &cut);
    uint8_t at_most = grow_branch(grower, rows, low, depth - 1);
    uint8_t above = grow_branch(grower, rows + low, count - low, depth - 1);
    insole_carry_node_t *node = &grower->grown->nodes[at];
    node->feature = cut.feature;
    node->threshold = cut.threshold;
    node->at_most = at_most;
    node->above = above;
    return (uint8_t)(at - grower->tree_root);
}

/* A tree without any cut is one node whose sides are the same class. */
static void grow_tree(grower_t *grower, forest_bag_t *bag)
{
    grown_t *grown = grower->grown;
    grower->tree_root = grown->node_count;
    uint8_t root = grow_branch(grower, bag->rows, bag->count, grower->settings->depth);
    if (grown->node_count == grower->tree_root) {
        size_t at = add_node(grown);
        grown->nodes[at].at_most = grown->nodes[at].above = root;
    }
}

/* ---- out of bag ------------------------------------------------------------------------- */

/* Votes of the newest tree on what it has not seen; `votes` counts per row and class. */
static void vote_out_of_bag(const grower_t *grower, const forest_bag_t *bag, const bool *is_used,
                            uint16_t *votes)
{
    const carry_windows_t *windows = grower->windows;
    const grown_t *grown = grower->grown;
    const uint16_t roots[2] = {0u, (uint16_t)(grown->node_count - grower->tree_root)};
    insole_carry_forest_t tree = grown->forest;
    insole_carry_votes_t said;
    tree.nodes = &grown->nodes[grower->tree_root];
    tree.roots = roots;
    tree.tree_count = 1u;
    for (size_t i = 0u; i < windows->row_count; i++) {
        const carry_row_t *row = &windows->rows[i];
        if (row->variant == 0u && is_used[row->log] && !bag->is_drawn[row->block] &&
            insole_carry_forest_vote(&tree, &row->features, &said) == INSOLE_OK) {
            votes[i * INSOLE_CARRY_CLASSES + (size_t)said.winner]++;
        }
    }
}

static void count_votes(const carry_windows_t *windows, const uint16_t *votes,
                        confusion_t *out_of_bag)
{
    memset(out_of_bag, 0, sizeof *out_of_bag);
    for (size_t i = 0u; i < windows->row_count; i++) {
        const uint16_t *said = &votes[i * INSOLE_CARRY_CLASSES];
        size_t most = 0u;
        for (size_t k = 1u; k < INSOLE_CARRY_CLASSES; k++) {
            most = said[k] > said[most] ? k : most;
        }
        if (said[most] > 0u) {
            out_of_bag->count[windows->logs[windows->rows[i].log].class_number][most]++;
        }
    }
}

/* ---- forest ----------------------------------------------------------------------------- */

static bool grow_trees(grower_t *grower, const bool *is_used, uint16_t *votes, failure_t *failure)
{
    progress_t progress;
    forest_bag_t bag;
    grown_t *grown = grower->grown;
    int64_t trees = grower->settings->trees;
    if (!forest_bag_open(&bag, grower->windows, is_used, (size_t)grower->settings->bag, failure)) {
        return false;
    }
    grower->items = memory_new(bag.room, sizeof *grower->items);
    progress_begin(&progress);
    for (int64_t tree = 0; tree < trees; tree++) {
        progress_step(&progress, (unsigned long long)tree, (unsigned long long)trees);
        forest_bag_draw(&bag, &grower->rng);
        grow_tree(grower, &bag);
        grown->roots[tree + 1] = (uint16_t)grown->node_count;
        if (votes != NULL) {
            vote_out_of_bag(grower, &bag, is_used, votes);
        }
    }
    progress_end(&progress);
    free(grower->items);
    forest_bag_close(&bag);
    return true;
}

bool forest_grow(grown_t *grown, const carry_windows_t *windows, const bool *is_used,
                 const forest_settings_t *settings, confusion_t *out_of_bag, failure_t *failure)
{
    memset(grown, 0, sizeof *grown);
    grower_t grower = {grown, windows, settings, {{0u}}, NULL, 0u};
    grown->forest.names = (const char *const *)windows->classes.names.names;
    grown->forest.class_count = (uint8_t)windows->classes.names.count;
    uint16_t *votes = out_of_bag == NULL ? NULL
                                         : memory_new(windows->row_count + 1u,
                                                      INSOLE_CARRY_CLASSES * sizeof *votes);
    insole_rng_seed(&grower.rng, settings->seed);
    bool is_good = grow_trees(&grower, is_used, votes, failure);
    grown->forest.nodes = grown->nodes;
    grown->forest.roots = grown->roots;
    grown->forest.tree_count = (uint16_t)settings->trees;
    if (is_good && votes != NULL) {
        count_votes(windows, votes, out_of_bag);
    }
    free(votes);
    return is_good;
}

size_t forest_bytes(const grown_t *grown)
{
    return grown->node_count * sizeof *grown->nodes +
           (grown->forest.tree_count + 1u) * sizeof *grown->roots;
}

void forest_free(grown_t *grown)
{
    free(grown->nodes);
    memset(grown, 0, sizeof *grown);
}
