/* SPDX-License-Identifier: MIT */
#include "reproduce_carry.h"

#include <stdlib.h>
#include <string.h>

#include "insole/sense/carry_table.h"
#include "number.h"
#include "platform.h"

static const char *const positions[REPRODUCE_POSITIONS] = {"hand", "ear", "swing", "pocket"};

/* The windows of a log that lies in the walk's folder. */
static bool add_log(reproduce_carry_t *carry, const reproduction_t *reproduction,
                    const char *position, failure_t *failure)
{
    carry_index_t index;
    char *path = platform_join(reproduction->folder, "carry.csv");
    FILE *file = fopen(path, "w");
    bool is_good = file != NULL;
    if (is_good) {
        fprintf(file, "file,person,position\nlog.csv,walker,%s\n", position);
        is_good = fclose(file) == 0;
    }
    if (!is_good) {
        failure_input(failure, "%s: cannot be written", path);
    }
    is_good = is_good && carry_index_read(&index, path, failure);
    if (is_good) {
        is_good = carry_windows_add(&carry->windows, &index, false, NULL, failure);
        carry_index_free(&index);
    }
    free(path);
    return is_good;
}

bool reproduce_carry_begin(reproduce_carry_t *carry, failure_t *failure)
{
    return carry_windows_init(&carry->windows, NULL, failure);
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
    const insole_carry_forest_t *forest = &insole_carry_table_forest;
    const carry_windows_t *windows = &carry->windows;
    size_t first = windows->row_count;
    int position = position_of(reproduction->kind->name);
    insole_carry_votes_t votes;
    if (!add_log(carry, reproduction, reproduction->kind->name, failure)) {
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
    carry_windows_free(&carry->windows);
}
