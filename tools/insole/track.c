/* SPDX-License-Identifier: MIT */
#include "track.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"

void track_add(track_t *track, const track_row_t *row)
{
    track->rows = memory_room(track->rows, &track->room, track->count + 1u, sizeof *track->rows);
    track->rows[track->count++] = *row;
}

void track_add_record(track_t *track, const record_t *record)
{
    track_row_t row;
    memset(&row, 0, sizeof row);
    row.t_us = record->t_us;
    row.x_m = record->value[0];
    row.y_m = record->value[1];
    row.z_m = record->value[2];
    row.state = INSOLE_FIX_TRACK;
    track_add(track, &row);
}

static int compare_times(const void *a, const void *b)
{
    int64_t t_a = ((const track_row_t *)a)->t_us, t_b = ((const track_row_t *)b)->t_us;
    return (t_a > t_b) - (t_a < t_b);
}

void track_sort(track_t *track)
{
    if (track->count > 1u) {
        qsort(track->rows, track->count, sizeof *track->rows, compare_times);
    }
}

/* Number of the first row after a time. */
static size_t first_after(const track_t *track, int64_t t_us)
{
    size_t low = 0u, high = track->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2u;
        if (track->rows[middle].t_us <= t_us) {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return low;
}

bool track_place(const track_t *track, int64_t t_us, double *x_m, double *y_m)
{
    size_t after = first_after(track, t_us);
    if (after == 0u || (after == track->count && track->rows[after - 1u].t_us < t_us)) {
        return false;
    }
    const track_row_t *a = &track->rows[after - 1u];
    const track_row_t *b = after < track->count ? a + 1 : a;
    double share = b == a ? 0.0 : (double)(t_us - a->t_us) / (double)(b->t_us - a->t_us);
    *x_m = a->x_m + share * (b->x_m - a->x_m);
    *y_m = a->y_m + share * (b->y_m - a->y_m);
    return true;
}

void track_free(track_t *track)
{
    free(track->rows);
    memset(track, 0, sizeof *track);
}

double track_length(const track_t *track, double leg_m)
{
    double length = 0.0;
    size_t from = 0u;
    for (size_t i = 1u; i < track->count; i++) {
        const track_row_t *a = &track->rows[from], *b = &track->rows[i];
        double leg = hypot(b->x_m - a->x_m, b->y_m - a->y_m);
        if (leg >= leg_m) {
            length += leg;
            from = i;
        }
    }
    return length;
}

const char *track_state_name(insole_fix_state_t state)
{
    static const char *const names[] = {"align", "search", "track", "coast", "lost"};
    return names[state];
}
