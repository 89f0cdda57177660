/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>

#include "carry_people.h"
#include "files.h"
#include "forest_bag.h"
#include "forest_grow.h"
#include "forest_writer.h"
#include "near.h"
#include "suite.h"

/* Grown by the program, with these settings, when the suite was built. */
extern const insole_carry_forest_t people_forest;
static const forest_settings_t PEOPLE_SETTINGS = {12, 7, 4, 300, INSOLE_CARRY_ACCEL, 5u};

static failure_t failure;
static carry_index_t carry_index;
static carry_windows_t windows;
static bool is_used[64];
static grown_t grown;

static void load(const char *path, const char *classes, bool is_varied)
{
    ck_assert_msg(carry_windows_init(&windows, classes, &failure) &&
                      carry_index_read(&carry_index, path, &failure) &&
                      carry_windows_add(&windows, &carry_index, is_varied, NULL, &failure),
                  "%s", failure.text);
    for (size_t i = 0; i < 64; i++) {
        is_used[i] = true;
    }
}

static void load_people(bool is_varied)
{
    load(PEOPLE_FOLDER "/people.csv", NULL, is_varied);
}

static void unload(void)
{
    carry_windows_free(&windows);
    carry_index_free(&carry_index);
}

static void grow(const forest_settings_t *settings, confusion_t *out_of_bag)
{
    ck_assert_msg(forest_grow(&grown, &windows, is_used, settings, out_of_bag, &failure), "%s",
                  failure.text);
    ck_assert_int_eq(insole_carry_forest_check(&grown.forest), INSOLE_OK);
}

/* ---- the table answers as the trainer does ---------------------------------------------- */

START_TEST(the_table_is_the_forest_that_grew)
{
    load_people(true);
    grow(&PEOPLE_SETTINGS, NULL);
    ck_assert_int_eq(insole_carry_forest_check(&people_forest), INSOLE_OK);
    ck_assert_uint_eq(people_forest.tree_count, grown.forest.tree_count);
    ck_assert_uint_eq(people_forest.class_count, grown.forest.class_count);
    for (unsigned k = 0; k < people_forest.class_count; k++) {
        ck_assert_str_eq(people_forest.names[k], grown.forest.names[k]);
    }
    ck_assert_mem_eq(people_forest.roots, grown.roots,
                     (people_forest.tree_count + 1u) * sizeof *grown.roots);
    worst_t same = {0.0, 0.0};
    for (size_t i = 0; i < grown.node_count; i++) {
        const insole_carry_node_t *a = &people_forest.nodes[i], *b = &grown.nodes[i];
        worst_require(&same,
                      a->threshold == b->threshold && a->feature == b->feature &&
                          a->at_most == b->at_most && a->above == b->above,
                      (double)i);
    }
    for (size_t i = 0; i < windows.row_count; i++) {
        insole_carry_votes_t a, b;
        ck_assert(insole_carry_forest_vote(&people_forest, &windows.rows[i].features, &a) == 0 &&
                  insole_carry_forest_vote(&grown.forest, &windows.rows[i].features, &b) == 0);
        worst_require(&same, a.winner == b.winner && memcmp(a.share, b.share, sizeof a.share) == 0,
                      (double)i);
    }
    ASSERT_ALL_HELD(same);
    forest_free(&grown);
    unload();
}
END_TEST

/* The windows are those that a device computes which gets the samples of the log. */
START_TEST(windows_are_the_devices)
{
    load_people(false);
    size_t at = 0;
    for (size_t log = 0; log < carry_index.count; log++) {
        insole_carry_window_t device;
        insole_carry_features_t features;
        char line[128];
        double t, x, y, z;
        FILE *file = fopen(carry_index.logs[log].path, "rb");
        ck_assert_ptr_nonnull(file);
        insole_carry_window_init(&device, insole_carry_defaults.gravity_s);
        while (fgets(line, sizeof line, file)) {
            if (sscanf(line, "%lf,%lf,%lf,%lf", &t, &x, &y, &z) != 4) {
                continue;
            }
            insole_vec3_t a = insole_vec3((insole_real_t)x, (insole_real_t)y, (insole_real_t)z);
            insole_carry_window_push(&device, (uint64_t)(t * 1e6 + 0.5), a, NULL, NULL);
            if (insole_carry_window_next(&device, &features) == INSOLE_OK) {
                ck_assert_mem_eq(&windows.rows[at].features, &features, sizeof features);
                ck_assert_uint_eq(windows.rows[at].log, log);
                at++;
            }
        }
        fclose(file);
    }
    ck_assert_uint_eq(at, windows.row_count);
    ck_assert_uint_eq(at, 9 * (PEOPLE_SAMPLES / 50 - 1));
    unload();
}
END_TEST

START_TEST(a_seed_gives_the_same_forest)
{
    forest_settings_t settings = PEOPLE_SETTINGS;
    char first[TEXT_ROOM];
    load_people(true);
    for (int i = 0; i < 3; i++) {
        FILE *file = tmpfile();
        settings.seed = i < 2 ? 9u : 10u;
        grow(&settings, NULL);
        forest_write(file, &grown, "f", "head");
        const char *text = text_of(file);
        if (i == 0) {
            strcpy(first, text);
        } else {
            ck_assert((strcmp(first, text) == 0) == (i == 1));
        }
        forest_free(&grown);
    }
    unload();
}
END_TEST

/* ---- how it grows ----------------------------------------------------------------------- */

START_TEST(people_never_seen_are_known)
{
    forest_settings_t settings = PEOPLE_SETTINGS;
    confusion_t out_of_bag;
    insole_carry_votes_t votes;
    int right = 0, all = 0;
    load_people(true);
    settings.features = _i == 0 ? INSOLE_CARRY_PAPER : INSOLE_CARRY_ACCEL;
    for (size_t log = 0; log < 3; log++) {
        is_used[log] = false; /* the first person */
    }
    grow(&settings, &out_of_bag);
    for (size_t i = 0; i < windows.row_count; i++) {
        const carry_row_t *row = &windows.rows[i];
        if (!is_used[row->log] && row->variant == 0u) {
            insole_carry_forest_vote(&grown.forest, &row->features, &votes);
            right += votes.winner == windows.logs[row->log].class_number;
            all++;
        }
    }
    ck_assert_int_gt(all, 200);
    ASSERT_AT_LEAST((double)right / all, 0.97, "");
    ASSERT_AT_LEAST(confusion_accuracy(&out_of_bag), 0.97, "");
    unsigned long judged = confusion_total(&out_of_bag);
    ck_assert_uint_le(judged, 6u * (PEOPLE_SAMPLES / 50 - 1));
    ck_assert_uint_gt(judged, 300);
    for (size_t i = 0; i < grown.node_count; i++) {
        ck_assert_int_lt(grown.nodes[i].feature, (int)settings.features);
    }
    forest_free(&grown);
    unload();
}
END_TEST

/* Labels drawn by lot: nothing can be learned, and the windows out of bag say so. */
START_TEST(out_of_bag_does_not_flatter_noise)
{
    confusion_t out_of_bag;
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    load_people(false);
    for (size_t i = 0; i < windows.row_count; i++) {
        for (int k = 0; k < INSOLE_CARRY_FEATURES; k++) {
            windows.rows[i].features.value[k] = insole_rng_normal(&rng);
        }
    }
    grow(&PEOPLE_SETTINGS, &out_of_bag);
    ASSERT_NEAR(confusion_accuracy(&out_of_bag), 1.0 / 3.0, 0.09, "");
    forest_free(&grown);
    unload();
}
END_TEST

typedef struct {
    int deepest;
    size_t smallest;
} shape_t;

/* Follows the bag down a tree. */
static void look(const insole_carry_node_t *nodes, uint8_t link, const uint32_t *rows, size_t count,
                 int depth, shape_t *shape)
{
    if (link >= INSOLE_CARRY_TREE_NODES) {
        shape->deepest = depth > shape->deepest ? depth : shape->deepest;
        shape->smallest = count < shape->smallest ? count : shape->smallest;
        return;
    }
    uint32_t *part = malloc((count + 1) * sizeof *part);
    for (int side = 0; side < 2; side++) {
        const insole_carry_node_t *node = &nodes[link];
        size_t n = 0;
        for (size_t i = 0; i < count; i++) {
            bool is_above = windows.rows[rows[i]].features.value[node->feature] > node->threshold;
            if (is_above == (side == 1)) {
                part[n++] = rows[i];
            }
        }
        look(nodes, side == 0 ? node->at_most : node->above, part, n, depth + 1, shape);
    }
    free(part);
}

START_TEST(depth_and_leaves_are_bounded)
{
    static const forest_settings_t SETTINGS[] = {{1, 1, 1, 100, 20, 1u},
                                                 {1, 3, 30, 200, 20, 2u},
                                                 {1, 7, 1, 300, 20, 3u},
                                                 {1, 7, 12, 300, 15, 4u},
                                                 {1, 7, 5000, 300, 20, 5u}};
    const forest_settings_t *s = &SETTINGS[_i];
    forest_bag_t bag;
    insole_rng_t rng;
    shape_t shape = {0, SIZE_MAX};
    load_people(true);
    grow(s, NULL);
    insole_rng_seed(&rng, s->seed);
    ck_assert(forest_bag_open(&bag, &windows, is_used, (size_t)s->bag, &failure));
    forest_bag_draw(&bag, &rng);
    if (_i == 4) { /* too few for any cut: one node, both sides alike */
        ck_assert_uint_eq(grown.node_count, 1u);
        ck_assert_uint_eq(grown.nodes[0].at_most, grown.nodes[0].above);
    } else {
        look(grown.nodes, 0u, bag.rows, bag.count, 0, &shape);
        ck_assert_int_le(shape.deepest, (int)s->depth);
        ck_assert_uint_ge(shape.smallest, (size_t)s->min_leaf);
        ck_assert_uint_gt(grown.node_count, 0u);
    }
    forest_bag_close(&bag);
    forest_free(&grown);
    unload();
}
END_TEST

static double gini_after(const forest_bag_t *bag, int feature, double threshold)
{
    double count[2][3] = {{0}}, total[2] = {0}, gini = 0.0;
    for (size_t i = 0; i < bag->count; i++) {
        const carry_row_t *row = &windows.rows[bag->rows[i]];
        int side = (double)row->features.value[feature] > threshold;
        count[side][windows.logs[row->log].class_number] += 1.0;
        total[side] += 1.0;
    }
    for (int side = 0; side < 2; side++) {
        double squares = 0.0;
        for (int k = 0; k < 3 && total[side] > 0.0; k++) {
            squares += pow(count[side][k] / total[side], 2.0);
        }
        gini += total[side] * (1.0 - squares);
    }
    return gini;
}

START_TEST(the_first_cut_is_the_best_there_is)
{
    forest_settings_t settings = {1, 1, 1, 60, 1, 11u};
    forest_bag_t bag;
    insole_rng_t rng;
    settings.seed += (uint64_t)_i;
    load_people(true);
    grow(&settings, NULL);
    insole_rng_seed(&rng, settings.seed);
    ck_assert(forest_bag_open(&bag, &windows, is_used, 60, &failure));
    forest_bag_draw(&bag, &rng);
    ck_assert_uint_eq(grown.nodes[0].feature, 0u);
    double found = gini_after(&bag, 0, (double)grown.nodes[0].threshold);
    for (size_t i = 0; i < bag.count; i++) {
        double at = (double)windows.rows[bag.rows[i]].features.value[0];
        ASSERT_AT_LEAST(gini_after(&bag, 0, at), found - 1e-9, "");
    }
    forest_bag_close(&bag);
    forest_free(&grown);
    unload();
}
END_TEST

/* ---- bags ------------------------------------------------------------------------------- */

/* One person's pocket is told nine times as often as the other's: each counts half. */
START_TEST(bags_are_balanced)
{
    forest_bag_t bag;
    insole_rng_t rng;
    double of_class[3] = {0}, of_person[2] = {0}, left = 0, blocks = 0;
    insole_rng_seed(&rng, 4u);
    FILE *file = fopen(scratch("uneven.csv"), "wb");
    fputs("file,person,position\n", file);
    for (int i = 0; i < 9; i++) {
        fputs(PEOPLE_FOLDER "/walk1.csv,a,pocket\n", file);
    }
    fputs(PEOPLE_FOLDER "/walk4.csv,b,pocket\n" PEOPLE_FOLDER "/walk0.csv,a,hand\n" PEOPLE_FOLDER
                        "/walk2.csv,a,swing\n",
          file);
    fclose(file);
    load(scratch("uneven.csv"), NULL, true);
    ck_assert(forest_bag_open(&bag, &windows, is_used, 50, &failure));
    for (int n = 0; n < 400; n++) {
        forest_bag_draw(&bag, &rng);
        ck_assert_uint_eq(bag.count, 150u);
        for (size_t i = 0; i < bag.count; i++) {
            const carry_row_t *row = &windows.rows[bag.rows[i]];
            const carry_source_t *source = &windows.logs[row->log];
            of_class[source->class_number] += 1.0 / (400 * 150);
            of_person[source->person] += source->class_number == 0 ? 1.0 / (400 * 50) : 0.0;
            ck_assert(bag.is_drawn[row->block]);
        }
        for (size_t b = 0; b < windows.block_count; b++) {
            left += !bag.is_drawn[b];
            blocks += 1.0;
        }
    }
    for (int k = 0; k < 3; k++) {
        ASSERT_NEAR(of_class[k], 1.0 / 3.0, 1e-9, "");
    }
    ASSERT_NEAR(of_person[0], 0.5, 0.03, "");
    ASSERT_NEAR(of_person[1], 0.5, 0.03, "");
    ASSERT_NEAR(left / blocks, 0.5, 0.2, "");
    forest_bag_close(&bag);
    unload();
}
END_TEST

START_TEST(one_class_is_refused)
{
    load(PEOPLE_FOLDER "/people.csv", _i == 0 ? "all=hand+pocket+swing" : NULL, false);
    for (size_t log = 0; log < windows.log_count && _i == 1; log++) {
        is_used[log] = windows.logs[log].class_number != 1;
    }
    ck_assert(!forest_grow(&grown, &windows, is_used, &PEOPLE_SETTINGS, NULL, &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    const char *complaint = _i == 0 ? "only one position, all" : "no windows of pocket";
    ck_assert_msg(strstr(failure.text, complaint) != NULL, "%s", failure.text);
    forest_free(&grown);
    unload();
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("train_carry");
    suite_add(suite, "table", the_table_is_the_forest_that_grew);
    suite_add(suite, "windows", windows_are_the_devices);
    suite_add(suite, "seed", a_seed_gives_the_same_forest);
    suite_add_loop(suite, "held out", people_never_seen_are_known, 2);
    suite_add(suite, "noise", out_of_bag_does_not_flatter_noise);
    suite_add_loop(suite, "shape", depth_and_leaves_are_bounded, 5);
    suite_add_loop(suite, "cut", the_first_cut_is_the_best_there_is, 5);
    suite_add(suite, "bags", bags_are_balanced);
    suite_add_loop(suite, "one class", one_class_is_refused, 2);
    return suite;
}
