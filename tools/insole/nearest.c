/* SPDX-License-Identifier: MIT */
#include "nearest.h"

#include <string.h>

enum { LONGEST = 63 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Three rows of the table of distances between beginnings of the words: i - 2, i - 1 and i. */
typedef struct {
    size_t before[LONGEST + 1], last[LONGEST + 1], now[LONGEST + 1];
} rows_t;

static size_t cell(const rows_t *rows, const char *a, const char *b, size_t i, size_t j)
{
    size_t change = rows->last[j - 1u] + (a[i - 1u] == b[j - 1u] ? 0u : 1u);
    size_t best = least(change, least(rows->last[j], rows->now[j - 1u]) + 1u);
    if (i > 1u && j > 1u && a[i - 1u] == b[j - 2u] && a[i - 2u] == b[j - 1u]) {
        best = least(best, rows->before[j - 2u] + 1u);
    }
    return best;
}

size_t nearest_distance(const char *a, const char *b)
{
    size_t length_a = least(strlen(a), LONGEST), length_b = least(strlen(b), LONGEST);
    rows_t rows;
    memset(&rows, 0, sizeof rows);
    for (size_t j = 0u; j <= length_b; j++) {
        rows.last[j] = j;
    }
    for (size_t i = 1u; i <= length_a; i++) {
        rows.now[0] = i;
        for (size_t j = 1u; j <= length_b; j++) {
            rows.now[j] = cell(&rows, a, b, i, j);
        }
        memcpy(rows.before, rows.last, sizeof rows.before);
        memcpy(rows.last, rows.now, sizeof rows.last);
    }
    return rows.last[length_b];
}

void nearest_begin(nearest_t *nearest, const char *wanted)
{
    nearest->wanted = wanted;
    nearest->best = NULL;
    nearest->distance = 0u;
}

void nearest_offer(nearest_t *nearest, const char *word)
{
    bool is_part = strlen(nearest->wanted) >= 4u && strstr(word, nearest->wanted) != NULL;
    size_t distance = is_part ? 1u : nearest_distance(nearest->wanted, word);
    size_t limit = (strlen(word) + 2u) / 3u;
    if (distance <= limit && (nearest->best == NULL || distance < nearest->distance)) {
        nearest->best = word;
        nearest->distance = distance;
    }
}
