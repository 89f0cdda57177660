/* SPDX-License-Identifier: MIT */
#include "insole/sense/carry_forest.h"

#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

enum { TREES = 40, MOST_NODES = TREES * INSOLE_CARRY_TREE_NODES, DEEPEST = 9 };

static insole_carry_node_t nodes[MOST_NODES];
static uint16_t roots[TREES + 1];
static const char *const names[INSOLE_CARRY_CLASSES] = {"a", "b", "c", "d", "e", "f", "g", "h"};
static insole_carry_forest_t forest;
static insole_carry_features_t features;
static insole_carry_votes_t votes;
static insole_rng_t rng;

/* A tree as the oracle knows it: by regions of the features, not by links. */
typedef struct {
    insole_real_t low[INSOLE_CARRY_FEATURES], high[INSOLE_CARRY_FEATURES];
    int tree, class_number;
} region_t;

static region_t regions[2 * MOST_NODES];
static int region_count;

static uint8_t grow(int tree, uint16_t *end, region_t region, int depth)
{
    uint16_t first = roots[tree];
    bool is_leaf = depth > 0 && (depth == DEEPEST || insole_rng_bits(&rng) % 5u == 0u ||
                                 *end - first > INSOLE_CARRY_TREE_NODES - DEEPEST - 1);
    if (is_leaf) {
        region.class_number = (int)(insole_rng_bits(&rng) % forest.class_count);
        regions[region_count++] = region;
        return INSOLE_CARRY_LEAF(region.class_number);
    }
    uint8_t link = (uint8_t)(*end - first);
    insole_carry_node_t *node = &nodes[(*end)++];
    region_t less = region, more = region;
    node->feature = (uint8_t)(insole_rng_bits(&rng) % INSOLE_CARRY_FEATURES);
    node->threshold = sample_between(&rng, INSOLE_R(-1.0), INSOLE_R(1.0));
    less.high[node->feature] = insole_min(region.high[node->feature], node->threshold);
    more.low[node->feature] = insole_max(region.low[node->feature], node->threshold);
    node->at_most = grow(tree, end, less, depth + 1);
    node->above = grow(tree, end, more, depth + 1);
    return link;
}

static void grow_forest(int trees, int classes)
{
    uint16_t end = 0u;
    region_t all;
    insole_rng_seed(&rng, (uint64_t)trees * 100u + (uint64_t)classes);
    region_count = 0;
    forest.nodes = nodes;
    forest.roots = roots;
    forest.names = names;
    forest.tree_count = (uint16_t)trees;
    forest.class_count = (uint8_t)classes;
    for (int tree = 0; tree < trees; tree++) {
        roots[tree] = end;
        for (int k = 0; k < INSOLE_CARRY_FEATURES; k++) {
            all.low[k] = -INSOLE_REAL_MAX;
            all.high[k] = INSOLE_REAL_MAX;
        }
        all.tree = tree;
        all.class_number = 0;
        (void)grow(tree, &end, all, 0);
    }
    roots[trees] = end;
}

static void draw_features(void)
{
    features.has_gyro = true;
    for (int k = 0; k < INSOLE_CARRY_FEATURES; k++) {
        features.value[k] = sample_between(&rng, INSOLE_R(-1.2), INSOLE_R(1.2));
    }
}

static bool is_inside(const region_t *region)
{
    bool is_in = true;
    for (int k = 0; k < INSOLE_CARRY_FEATURES; k++) {
        is_in = is_in && features.value[k] > region->low[k] && features.value[k] <= region->high[k];
    }
    return is_in;
}

START_TEST(votes_are_those_of_the_regions)
{
    static const int CLASSES[] = {2, 3, 5, INSOLE_CARRY_CLASSES};
    grow_forest(TREES, CLASSES[_i]);
    ck_assert_int_eq(insole_carry_forest_check(&forest), INSOLE_OK);
    worst_t worst = {0.0, 0.0}, sums = {0.0, 0.0};
    for (int n = 0; n < 400; n++) {
        int count[INSOLE_CARRY_CLASSES] = {0}, winner = 0;
        draw_features();
        for (int i = 0; i < region_count; i++) {
            count[regions[i].class_number] += is_inside(&regions[i]);
        }
        for (int k = 1; k < INSOLE_CARRY_CLASSES; k++) {
            winner = count[k] > count[winner] ? k : winner;
        }
        ck_assert(insole_carry_forest_vote(&forest, &features, &votes) == INSOLE_OK);
        worst_require(&worst, votes.winner == winner, n);
        double sum = 0.0;
        for (int k = 0; k < INSOLE_CARRY_CLASSES; k++) {
            worst_note(&worst, fabs((double)votes.share[k] - (double)count[k] / TREES) / 1e6, n);
            sum += (double)votes.share[k];
        }
        worst_note(&sums, fabs(sum - 1.0), n);
    }
    ASSERT_WORST(worst, 1e-12, "(1 = wrong winner)");
    ASSERT_WORST(sums, 1e-6, "");
}
END_TEST

/* One node: what is at the threshold belongs to the first side. */
START_TEST(one_node_by_hand)
{
    grow_forest(1, 2);
    nodes[0] = (insole_carry_node_t){INSOLE_R(0.5), 19, INSOLE_CARRY_LEAF(1), INSOLE_CARRY_LEAF(0)};
    roots[1] = 1u;
    draw_features();
    static const double VALUES[] = {-3.0, 0.5, 0.50001, 7.0};
    for (int i = 0; i < 4; i++) {
        features.value[19] = (insole_real_t)VALUES[i];
        ck_assert_int_eq(insole_carry_forest_vote(&forest, &features, &votes), INSOLE_OK);
        ck_assert_int_eq(votes.winner, i < 2 ? 1 : 0);
        ASSERT_NEAR(votes.share[votes.winner], 1.0, 0.0, "");
    }
}
END_TEST

START_TEST(of_equals_the_first_wins)
{
    grow_forest(4, 3);
    for (uint8_t i = 0u; i < 4u; i++) {
        uint8_t leaf = INSOLE_CARRY_LEAF(i % 2 == 0 ? 2 : 1);
        nodes[i] = (insole_carry_node_t){0, 0, leaf, leaf};
        roots[i] = i;
    }
    roots[4] = 4u;
    draw_features();
    ck_assert_int_eq(insole_carry_forest_vote(&forest, &features, &votes), INSOLE_OK);
    ck_assert_int_eq(votes.winner, 1);
    ASSERT_NEAR(votes.share[2], 0.5, 0.0, "");
}
END_TEST

/* What the accelerometer tells suffices where the forest asks no more. */
START_TEST(without_a_gyroscope_some_tables_are_no_use)
{
    grow_forest(1, 2);
    nodes[0] = (insole_carry_node_t){0, INSOLE_CARRY_ACCEL - 1, 1, INSOLE_CARRY_LEAF(0)};
    nodes[1] =
        (insole_carry_node_t){0, INSOLE_CARRY_ACCEL, INSOLE_CARRY_LEAF(0), INSOLE_CARRY_LEAF(1)};
    roots[1] = 2u;
    draw_features();
    features.value[INSOLE_CARRY_ACCEL - 1] = (insole_real_t)(_i == 0 ? 1 : -1);
    features.has_gyro = false;
    votes.winner = 5;
    ck_assert_int_eq(insole_carry_forest_vote(&forest, &features, &votes),
                     _i == 0 ? INSOLE_OK : INSOLE_ERR_STATE);
    ck_assert_int_eq(votes.winner, _i == 0 ? 0 : 5);
    features.has_gyro = true;
    ck_assert_int_eq(insole_carry_forest_vote(&forest, &features, &votes), INSOLE_OK);
}
END_TEST

/* ---- damage ----------------------------------------------------------------------------- */

static void damage(int how)
{
    insole_carry_node_t *node = &nodes[roots[2] + 3];
    uint8_t self = 3u, beyond = (uint8_t)(roots[3] - roots[2]);
    switch (how) {
    case 0:
        node->feature = INSOLE_CARRY_FEATURES;
        break;
    case 1:
        node->threshold = (insole_real_t)NAN;
        break;
    case 2:
        node->threshold = (insole_real_t)INFINITY;
        break;
    case 3:
        node->at_most = self;
        break;
    case 4:
        node->above = 0u;
        break;
    case 5:
        node->at_most = beyond;
        break;
    case 6:
        node->above = INSOLE_CARRY_LEAF(forest.class_count);
        break;
    case 7:
        roots[3] = roots[2];
        break;
    case 8:
        roots[3] = (uint16_t)(roots[2] + INSOLE_CARRY_TREE_NODES + 1);
        break;
    case 9:
        roots[0] = 1u;
        break;
    case 10:
        forest.tree_count = 0u;
        break;
    case 11:
        forest.class_count = 1u;
        break;
    default:
        forest.class_count = INSOLE_CARRY_CLASSES + 1;
        break;
    }
}

START_TEST(damage_is_found)
{
    grow_forest(10, 4);
    damage(_i);
    ck_assert_int_eq(insole_carry_forest_check(&forest), INSOLE_ERR_DATA);
}
END_TEST

/* Random bytes: each walk ends, with a class or a refusal that leaves the answer alone. */
START_TEST(no_damage_leads_astray)
{
    int refused = 0;
    grow_forest(TREES, 5);
    for (int n = 0; n < 3000; n++) {
        insole_carry_node_t *node = &nodes[insole_rng_bits(&rng) % roots[TREES]];
        node->at_most = (uint8_t)insole_rng_bits(&rng);
        node->above = (uint8_t)insole_rng_bits(&rng);
        node->feature = (uint8_t)(insole_rng_bits(&rng) % (INSOLE_CARRY_FEATURES + 2));
        draw_features();
        insole_carry_votes_t before = votes;
        insole_status_t status = insole_carry_forest_vote(&forest, &features, &votes);
        if (status != INSOLE_OK) {
            refused++;
            ck_assert(status == INSOLE_ERR_DATA && before.winner == votes.winner &&
                      memcmp(before.share, votes.share, sizeof votes.share) == 0);
        }
    }
    ck_assert_int_gt(refused, 1000);
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    grow_forest(3, 3);
    draw_features();
    ck_assert_int_eq(insole_carry_forest_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_carry_forest_vote(NULL, &features, &votes), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_carry_forest_vote(&forest, NULL, &votes), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_carry_forest_vote(&forest, &features, NULL), INSOLE_ERR_NULL);
    for (int i = 0; i < 3; i++) {
        insole_carry_forest_t part = forest;
        part.nodes = i == 0 ? NULL : part.nodes;
        part.roots = i == 1 ? NULL : part.roots;
        part.names = i == 2 ? NULL : part.names;
        ck_assert_int_eq(insole_carry_forest_check(&part), INSOLE_ERR_NULL);
        ck_assert_int_eq(insole_carry_forest_vote(&part, &features, &votes), INSOLE_ERR_NULL);
    }
    memset(&votes, 0x5a, sizeof votes);
    for (int k = 0; k < INSOLE_CARRY_FEATURES; k++) {
        insole_real_t value = features.value[k];
        features.value[k] = (insole_real_t)(k % 2 == 0 ? NAN : INFINITY);
        ASSERT_UNCHANGED(votes, insole_carry_forest_vote(&forest, &features, &votes),
                         INSOLE_ERR_VALUE);
        features.value[k] = value;
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("carry_forest");
    suite_add_loop(suite, "regions", votes_are_those_of_the_regions, 4);
    suite_add(suite, "by hand", one_node_by_hand);
    suite_add(suite, "equals", of_equals_the_first_wins);
    suite_add_loop(suite, "no gyroscope", without_a_gyroscope_some_tables_are_no_use, 2);
    suite_add_loop(suite, "damage", damage_is_found, 13);
    suite_add(suite, "random damage", no_damage_leads_astray);
    suite_add(suite, "arguments", bad_arguments_are_refused);
    return suite;
}
