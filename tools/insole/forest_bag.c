/* SPDX-License-Identifier: MIT */
#include "forest_bag.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"

uint32_t forest_draw(insole_rng_t *rng, uint32_t limit)
{
    return (uint32_t)(((uint64_t)insole_rng_bits(rng) * limit) >> 32);
}

/* ---- runs ------------------------------------------------------------------------------- */

enum { NO_RUN = -1 };

/* Sorts the numbers 0..count-1 into runs. @param run_of  the run of each, or NO_RUN */
static runs_t make_runs(const int64_t *run_of, size_t count, size_t run_count)
{
    runs_t runs = {memory_new(count + 1u, sizeof *runs.at),
                   memory_new(run_count + 2u, sizeof *runs.from)};
    for (size_t i = 0u; i < count; i++) {
        if (run_of[i] != NO_RUN) {
            runs.from[run_of[i] + 2]++;
        }
    }
    for (size_t k = 1u; k <= run_count; k++) {
        runs.from[k + 1u] += runs.from[k];
    }
    for (size_t i = 0u; i < count; i++) {
        if (run_of[i] != NO_RUN) {
            runs.at[runs.from[run_of[i] + 1]++] = (uint32_t)i;
        }
    }
    return runs;
}

static uint32_t run_length(const runs_t *runs, size_t k)
{
    return runs->from[k + 1u] - runs->from[k];
}

static uint32_t draw_of_run(const runs_t *runs, size_t k, insole_rng_t *rng)
{
    return runs->at[runs->from[k] + forest_draw(rng, run_length(runs, k))];
}

static void free_runs(runs_t *runs)
{
    free(runs->at);
    free(runs->from);
}

/* ---- bag -------------------------------------------------------------------------------- */

static void sort_rows(forest_bag_t *bag, const bool *is_used)
{
    const carry_windows_t *windows = bag->windows;
    int64_t *run_of = memory_new(windows->row_count + 1u, sizeof *run_of);
    for (size_t i = 0u; i < windows->row_count; i++) {
        const carry_row_t *row = &windows->rows[i];
        run_of[i] = is_used[row->log] ? (int64_t)row->block : NO_RUN;
    }
    bag->rows_of_block = make_runs(run_of, windows->row_count, windows->block_count);
    free(run_of);
}

/* Blocks that have windows, by group; groups that have blocks, by class. */
static void sort_blocks(forest_bag_t *bag)
{
    const carry_windows_t *windows = bag->windows;
    size_t groups = windows->groups.count, classes = windows->classes.names.count;
    int64_t *group_of = memory_new(windows->block_count + 1u, sizeof *group_of);
    int64_t *class_of = memory_new(groups + 1u, sizeof *class_of);
    for (size_t g = 0u; g < groups; g++) {
        class_of[g] = NO_RUN;
    }
    for (size_t b = 0u; b < windows->block_count; b++) {
        const carry_source_t *log = &windows->logs[windows->log_of_block[b]];
        group_of[b] = run_length(&bag->rows_of_block, b) > 0u ? (int64_t)log->group : NO_RUN;
        if (group_of[b] != NO_RUN) {
            class_of[log->group] = log->class_number;
        }
    }
    bag->blocks_of_group = make_runs(group_of, windows->block_count, groups);
    bag->groups_of_class = make_runs(class_of, groups, classes);
    free(group_of);
    free(class_of);
}

static uint32_t blocks_of_class(const forest_bag_t *bag, size_t k)
{
    uint32_t blocks = 0u;
    for (uint32_t i = bag->groups_of_class.from[k]; i < bag->groups_of_class.from[k + 1u]; i++) {
        blocks += run_length(&bag->blocks_of_group, bag->groups_of_class.at[i]);
    }
    return blocks;
}

static bool check_classes(const forest_bag_t *bag, failure_t *failure)
{
    const id_table_t *names = &bag->windows->classes.names;
    if (names->count < 2u) {
        return failure_input(failure,
                             "insole train-carry: only one position, %.40s: expected two or more",
                             names->count == 1u ? names->names[0] : "none");
    }
    for (size_t k = 0u; k < names->count; k++) {
        if (blocks_of_class(bag, k) == 0u) {
            return failure_input(failure,
                                 "insole train-carry: no windows of %.40s to learn from: expected "
                                 "logs of every position",
                                 names->names[k]);
        }
    }
    return true;
}

bool forest_bag_open(forest_bag_t *bag, const carry_windows_t *windows, const bool *is_used,
                     size_t per_class, failure_t *failure)
{
    memset(bag, 0, sizeof *bag);
    bag->windows = windows;
    bag->per_class = per_class;
    bag->room = per_class * windows->classes.names.count;
    bag->drawn = memory_new(windows->block_count + 1u, sizeof *bag->drawn);
    bag->is_drawn = memory_new(windows->block_count + 1u, sizeof *bag->is_drawn);
    bag->rows = memory_new(bag->room + 1u, sizeof *bag->rows);
    sort_rows(bag, is_used);
    sort_blocks(bag);
    bool is_good = check_classes(bag, failure);
    if (!is_good) {
        forest_bag_close(bag);
    }
    return is_good;
}

/* As many draws as the class has blocks, groups alike: about a third of a group is left out. */
static void draw_class(forest_bag_t *bag, size_t k, insole_rng_t *rng)
{
    uint32_t blocks = blocks_of_class(bag, k);
    for (uint32_t i = 0u; i < blocks; i++) {
        uint32_t group = draw_of_run(&bag->groups_of_class, k, rng);
        bag->drawn[i] = draw_of_run(&bag->blocks_of_group, group, rng);
        bag->is_drawn[bag->drawn[i]] = true;
    }
    for (size_t i = 0u; i < bag->per_class; i++) {
        uint32_t block = bag->drawn[forest_draw(rng, blocks)];
        bag->rows[bag->count++] = draw_of_run(&bag->rows_of_block, block, rng);
    }
}

void forest_bag_draw(forest_bag_t *bag, insole_rng_t *rng)
{
    memset(bag->is_drawn, 0, bag->windows->block_count * sizeof *bag->is_drawn);
    bag->count = 0u;
    for (size_t k = 0u; k < bag->windows->classes.names.count; k++) {
        draw_class(bag, k, rng);
    }
}

void forest_bag_close(forest_bag_t *bag)
{
    free_runs(&bag->rows_of_block);
    free_runs(&bag->blocks_of_group);
    free_runs(&bag->groups_of_class);
    free(bag->drawn);
    free(bag->is_drawn);
    free(bag->rows);
    memset(bag, 0, sizeof *bag);
}
