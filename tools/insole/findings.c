/* SPDX-License-Identifier: MIT */
#include "findings.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"

void findings_add(findings_t *findings, finding_weight_t weight, finding_file_t file,
                  unsigned long line, const char *format, ...)
{
    va_list values;
    findings->items =
        memory_room(findings->items, &findings->room, findings->count + 1u, sizeof(finding_t));
    finding_t *finding = &findings->items[findings->count];
    finding->weight = weight;
    finding->file = file;
    finding->line = line;
    finding->order = findings->count++;
    findings->errors += weight == FINDING_ERROR ? 1u : 0u;
    va_start(values, format);
    vsnprintf(finding->text, sizeof finding->text, format, values);
    va_end(values);
}

static int by_file_and_line(const void *a, const void *b)
{
    const finding_t *one = a, *other = b;
    if (one->file != other->file) {
        return one->file > other->file ? 1 : -1;
    }
    if (one->line != other->line) {
        return one->line > other->line ? 1 : -1;
    }
    return (one->order > other->order) - (one->order < other->order);
}

void findings_sort(findings_t *findings)
{
    if (findings->count > 1u) {
        qsort(findings->items, findings->count, sizeof *findings->items, by_file_and_line);
    }
}

void findings_print(const findings_t *findings, FILE *file, const char *plan_name,
                    const char *aps_name)
{
    for (size_t i = 0u; i < findings->count; i++) {
        const finding_t *finding = &findings->items[i];
        fputs(finding->file == FINDING_PLAN ? plan_name : aps_name, file);
        if (finding->line > 0u) {
            fprintf(file, ":%lu", finding->line);
        }
        fprintf(file, ": %s: %s\n", finding->weight == FINDING_ERROR ? "error" : "warning",
                finding->text);
    }
}

void findings_free(findings_t *findings)
{
    free(findings->items);
    memset(findings, 0, sizeof *findings);
}
