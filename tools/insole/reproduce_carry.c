/* SPDX-License-Identifier: MIT */
#include "reproduce_carry.h"

#ifdef INSOLE_HOST_HAS_SIMULATOR

#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "number.h"
#include "platform.h"
#include "reproduce_walk.h"

/* Walks per position that the forest grows on, and their seeds: no walk that is judged has them. */
enum { LEARNT = 6 };
static const uint64_t first_learnt = UINT64_C(1) << 41;

static const char *const positions[REPRODUCE_POSITIONS] = {"hand", "ear", "swing", "pocket"};

/* Other people than the one who walks the paper's way. */
#define PEOPLE                                                                                     \
    " person.leg_spread=0.05 person.step_spread=0.08 person.bounce_spread=0.15 "                   \
    "phone.rock_spread=0.3"

/* The windows of a log that lies in the walk's folder. */
static bool add_log(reproduce_carry_t *carry, const reproduction_t *reproduction,
                    const char *position, bool is_varied, failure_t *failure)
{
    carry_index_t index;
    char *path = platform_join(reproduction->folder, "carry.csv");
    FILE *file = fopen(path, "w");
    bool is_good = file != NULL;
    if (is_good) {
        fprintf(file, "file,person,position\nlog.csv,%s,%s\n", is_varied ? "many" : "one",
                position);
        is_good = fclose(file) == 0;
    }
    if (!is_good) {
        failure_input(failure, "%s: cannot be written", path);
    }
    is_good = is_good && carry_index_read(&index, path, failure);
    if (is_good) {
        is_good = carry_windows_add(&carry->windows, &index, is_varied, NULL, failure);
        carry_index_free(&index);
    }
    free(path);
    return is_good;
}

static bool learn_walk(reproduce_carry_t *carry, const reproduction_t *reproduction,
                       const reproduce_kind_t *kind, uint64_t seed, failure_t *failure)
{
    char set[400];
    snprintf(set, sizeof set, "%s%s", kind->scenario, PEOPLE);
    return reproduce_simulate(reproduction->request.maps, reproduction->paper->scenario,
                              reproduction->folder, seed, set, failure) &&
           add_log(carry, reproduction, kind->name, true, failure);
}

static bool grow(reproduce_carry_t *carry, failure_t *failure)
{
    bool *is_used = memory_new(carry->windows.log_count, sizeof *is_used);
    for (size_t i = 0u; i < carry->windows.log_count; i++) {
        is_used[i] = true;
    }
    carry->is_grown =
        forest_grow(&carry->grown, &carry->windows, is_used, &forest_defaults, NULL, failure);
    free(is_used);
    return carry->is_grown;
}

bool reproduce_carry_begin(reproduce_carry_t *carry, const reproduction_t *reproduction,
                           failure_t *failure)
{
    const reproduce_paper_t *paper = reproduction->paper;
    bool is_good = carry_windows_init(&carry->windows, NULL, failure);
    for (int i = 0; is_good && i < LEARNT * paper->kind_count; i++) {
        uint64_t seed = first_learnt + (uint64_t)i;
        is_good =
            learn_walk(carry, reproduction, &paper->kinds[i % paper->kind_count], seed, failure);
    }
    return is_good && grow(carry, failure);
}

/* Number of a position; a class that is none of them counts as the first. */
static int position_of(const char *name)
{
    int position = REPRODUCE_POSITIONS - 1;
    while (position > 0 && strcmp(positions[position], name) != 0) {
        position--;
    }
    return position;
}

bool reproduce_carry_walk(reproduce_carry_t *carry, const reproduction_t *reproduction,
                          failure_t *failure)
{
    const insole_carry_forest_t *forest = &carry->grown.forest;
    const carry_windows_t *windows = &carry->windows;
    size_t first = windows->row_count;
    int position = position_of(reproduction->kind->name);
    insole_carry_votes_t votes;
    if (!add_log(carry, reproduction, reproduction->kind->name, false, failure)) {
        return false;
    }
    for (size_t i = first; i < windows->row_count; i++) {
        if (insole_carry_forest_vote(forest, &windows->rows[i].features, &votes) == INSOLE_OK) {
            int answer = position_of(forest->names[votes.winner]);
            carry->confusion.count[position][answer]++;
        }
    }
    return true;
}

/* ---- out -------------------------------------------------------------------------------- */

static double share_of(const confusion_t *confusion, int position, int answer)
{
    unsigned long all = 0u;
    for (int i = 0; i < REPRODUCE_POSITIONS; i++) {
        all += confusion->count[position][i];
    }
    return all > 0u ? (double)confusion->count[position][answer] / (double)all : NUMBER_UNKNOWN;
}

static void print_row(const reproduce_carry_t *carry, const reproduce_carry_printed_t printed,
                      int row, FILE *file)
{
    char number[NUMBER_ROOM];
    fprintf(file, "%-22s", positions[row]);
    for (int i = 0; i < REPRODUCE_POSITIONS; i++) {
        fprintf(file, " %6s", number_fixed(number, share_of(&carry->confusion, row, i), 3));
    }
    fputs("  ", file);
    for (int i = 0; i < REPRODUCE_POSITIONS; i++) {
        fprintf(file, " %6s", number_fixed(number, printed[row][i], 3));
    }
    fputc('\n', file);
}

void reproduce_carry_print(const reproduce_carry_t *carry, const reproduce_carry_printed_t printed,
                           FILE *file)
{
    char number[NUMBER_ROOM];
    fprintf(file,
            "table 1: share of the %lu windows of 2 s that are taken for each position, by the\n"
            "features free of orientation; measured and printed\n%-22s",
            confusion_total(&carry->confusion), "");
    for (int twice = 0; twice < 2; twice++) {
        for (int i = 0; i < REPRODUCE_POSITIONS; i++) {
            fprintf(file, " %6s", positions[i]);
        }
        fputs(twice == 0 ? "  " : "\n", file);
    }
    for (int row = 0; row < REPRODUCE_POSITIONS; row++) {
        print_row(carry, printed, row, file);
    }
    fprintf(file, "right: %s %%; the paper: 98.5 %%\n",
            number_fixed(number, 100.0 * confusion_accuracy(&carry->confusion), 1));
}

void reproduce_carry_json(const reproduce_carry_t *carry, json_t *json)
{
    json_object(json, "carry");
    json_whole(json, "windows", (long long)confusion_total(&carry->confusion));
    json_number(json, "right", confusion_accuracy(&carry->confusion), 4);
    for (int row = 0; row < REPRODUCE_POSITIONS; row++) {
        json_object(json, positions[row]);
        for (int i = 0; i < REPRODUCE_POSITIONS; i++) {
            json_number(json, positions[i], share_of(&carry->confusion, row, i), 4);
        }
        json_end(json);
    }
    json_end(json);
}

void reproduce_carry_free(reproduce_carry_t *carry)
{
    if (carry->is_grown) {
        forest_free(&carry->grown);
    }
    carry_windows_free(&carry->windows);
}

#endif
