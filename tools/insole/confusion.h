/** @file confusion.h  What was taken for what.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_CONFUSION_H
#define INSOLE_HOST_CONFUSION_H

#include <stdio.h>

#include "insole/sense/carry_forest.h"

typedef struct {
    unsigned long count[INSOLE_CARRY_CLASSES][INSOLE_CARRY_CLASSES]; /**< true class, answer */
} confusion_t;

/** Share of the windows that were right; 0 when there are none. */
double confusion_accuracy(const confusion_t *confusion);

/** Windows in it. */
unsigned long confusion_total(const confusion_t *confusion);

/** Prints the matrix, the share of each class that was right, and of all. */
void confusion_print(FILE *file, const confusion_t *confusion, const char *const *names,
                     size_t classes);

#endif
