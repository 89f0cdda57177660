/** @file reproduce_carry.h  How well the carrying position is told: table 1 of [PhoneUKF].
 *
 *  The forest that comes with the library judges the windows of the walks.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPRODUCE_CARRY_H
#define INSOLE_HOST_REPRODUCE_CARRY_H

#include "carry_windows.h"
#include "confusion.h"
#include "reproduce.h"

/** Of the paper's table, in its order: hand, ear, swing, pocket. */
enum { REPRODUCE_POSITIONS = 4 };

/** Share of the windows of a position (row) that are taken for each (column). */
typedef double reproduce_carry_printed_t[REPRODUCE_POSITIONS][REPRODUCE_POSITIONS];

typedef struct {
    carry_windows_t windows; /**< of all walks */
    confusion_t confusion;   /**< position, answer */
} reproduce_carry_t;

bool reproduce_carry_begin(reproduce_carry_t *carry, failure_t *failure);

/** Judges the present walk: its kind is the position. */
bool reproduce_carry_walk(reproduce_carry_t *carry, const reproduction_t *reproduction,
                          failure_t *failure);

void reproduce_carry_print(const reproduce_carry_t *carry, const reproduce_carry_printed_t printed,
                           FILE *file);

void reproduce_carry_json(const reproduce_carry_t *carry, json_t *json);

void reproduce_carry_free(reproduce_carry_t *carry);

#endif
