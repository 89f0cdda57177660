/* SPDX-License-Identifier: MIT */
#include "confusion.h"

#include "number.h"

static unsigned long row_total(const confusion_t *confusion, size_t row)
{
    unsigned long total = 0u;
    for (size_t k = 0u; k < INSOLE_CARRY_CLASSES; k++) {
        total += confusion->count[row][k];
    }
    return total;
}

unsigned long confusion_total(const confusion_t *confusion)
{
    unsigned long total = 0u;
    for (size_t row = 0u; row < INSOLE_CARRY_CLASSES; row++) {
        total += row_total(confusion, row);
    }
    return total;
}

static double share(unsigned long right, unsigned long all)
{
    return all > 0u ? (double)right / (double)all : 0.0;
}

double confusion_accuracy(const confusion_t *confusion)
{
    unsigned long right = 0u;
    for (size_t k = 0u; k < INSOLE_CARRY_CLASSES; k++) {
        right += confusion->count[k][k];
    }
    return share(right, confusion_total(confusion));
}

void confusion_print(FILE *file, const confusion_t *confusion, const char *const *names,
                     size_t classes)
{
    char number[NUMBER_ROOM];
    fprintf(file, "  %-14s", "is \\ taken for");
    for (size_t k = 0u; k < classes; k++) {
        fprintf(file, " %10.10s", names[k]);
    }
    fputs("      right\n", file);
    for (size_t row = 0u; row < classes; row++) {
        fprintf(file, "  %-14.14s", names[row]);
        for (size_t k = 0u; k < classes; k++) {
            fprintf(file, " %10lu", confusion->count[row][k]);
        }
        double right = 100.0 * share(confusion->count[row][row], row_total(confusion, row));
        fprintf(file, " %8s %%\n", number_fixed(number, right, 1));
    }
    fprintf(file, "  all: %s %% of %lu windows\n",
            number_fixed(number, 100.0 * confusion_accuracy(confusion), 1),
            confusion_total(confusion));
}
