/** @file same_tables.h  Two radio maps that must hold the same bits.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HOST_SAME_TABLES_H
#define INSOLE_TESTS_HOST_SAME_TABLES_H

#include <check.h>

#include "insole/place/radio_map.h"

static inline void expect_same_tables(const insole_radio_map_t *a, const insole_radio_map_t *b)
{
    size_t points = a->point_count, entries = a->first[points];
    ck_assert_uint_eq(b->point_count, points);
    ck_assert_uint_eq(b->ap_count, a->ap_count);
    ck_assert_mem_eq(a->spots, b->spots, points * sizeof *a->spots);
    ck_assert_mem_eq(a->first, b->first, (points + 1u) * sizeof *a->first);
    ck_assert_mem_eq(a->visits, b->visits, points);
    ck_assert_mem_eq(a->aps, b->aps, entries * sizeof *a->aps);
    ck_assert_mem_eq(a->below, b->below, entries);
    ck_assert_mem_eq(a->spread, b->spread, entries);
    ck_assert_mem_eq(a->counts, b->counts, entries);
}

#endif
