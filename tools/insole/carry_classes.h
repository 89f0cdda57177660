/** @file carry_classes.h  Which positions of an index are one class of a forest.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_CARRY_CLASSES_H
#define INSOLE_HOST_CARRY_CLASSES_H

#include "failure.h"
#include "id_table.h"
#include "insole/sense/carry_forest.h"

/** A position in no class. */
enum { CARRY_LEFT_OUT = -1 };

typedef struct {
    id_table_t names;     /**< of the classes */
    id_table_t positions; /**< that are in a class */
    int *class_of;        /**< per position */
    bool are_told;        /**< by --classes; else each position is a class of its own */
    size_t room;
} carry_classes_t;

/** @param text  `hand=hand+inhand,pocket=frontpocket+backpocket,swing`: what a name does not say is
 *               itself; NULL: each position is a class */
bool carry_classes_init(carry_classes_t *classes, const char *text, failure_t *failure);

/** Class of a position. A new one is made where classes are not told. @return CARRY_LEFT_OUT when
 *  it is in none. */
bool carry_classes_of(carry_classes_t *classes, const char *position, int *number,
                      failure_t *failure);

void carry_classes_free(carry_classes_t *classes);

#endif
