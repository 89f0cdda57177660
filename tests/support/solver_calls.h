/** @file solver_calls.h  What every table of a radio solver's calls must do: in slices the same
 * bits as at once, and nothing with what is wrong.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_SOLVER_CALLS_H
#define INSOLE_TESTS_SOLVER_CALLS_H

#include <check.h>
#include <string.h>

#include "insole/place/radio_solver.h"

/** A scan that can be solved on the map. */
typedef struct {
    const insole_radio_map_t *map;
    const insole_rss_t *readings;
    uint32_t count;
} solver_scan_t;

/** A state of at most this size is held against its copy. */
enum { SOLVER_STATE_MOST = 16384 };

#define ASSERT_SAME_STATE(call, expected)                                                          \
    do {                                                                                           \
        memcpy(before, state, size);                                                               \
        ck_assert_int_eq((call), (expected));                                                      \
        ck_assert_msg(memcmp(before, state, size) == 0, "%s changed the state", #call);            \
    } while (0)

/** @param state  set up, with no scan begun; left so */
static inline void check_solver_refusals(const insole_radio_solver_calls_t *calls, void *state,
                                         size_t size, const solver_scan_t *scan)
{
    static unsigned char before[SOLVER_STATE_MOST];
    insole_trusted_area_t bad = {{0, 0}, -1};
    const insole_radio_map_t *map = scan->map;
    const insole_rss_t *readings = scan->readings;
    insole_radio_fix_t fix, untouched;
    ck_assert_uint_le(size, sizeof before);
    memset(&fix, 0x5a, sizeof fix);
    untouched = fix;
    ASSERT_SAME_STATE(calls->begin(state, map, &bad, readings, scan->count), INSOLE_ERR_VALUE);
    ASSERT_SAME_STATE(calls->begin(state, NULL, NULL, readings, scan->count), INSOLE_ERR_NULL);
    ASSERT_SAME_STATE(calls->begin(state, map, NULL, NULL, scan->count), INSOLE_ERR_NULL);
    ASSERT_SAME_STATE(calls->finish(state, map, &fix), INSOLE_ERR_STATE);
    ASSERT_SAME_STATE(calls->finish(state, map, NULL), INSOLE_ERR_NULL);
    ASSERT_SAME_STATE(calls->finish(state, NULL, &fix), INSOLE_ERR_NULL);
    ASSERT_SAME_STATE(calls->work(state, NULL, 1u), false);
    ASSERT_SAME_STATE(calls->work(state, map, 1u), false);
    ck_assert_int_eq(calls->begin(NULL, map, NULL, readings, scan->count), INSOLE_ERR_NULL);
    ck_assert_int_eq(calls->finish(NULL, map, &fix), INSOLE_ERR_NULL);
    ck_assert(!calls->work(NULL, map, 7u));
    ck_assert_mem_eq(&fix, &untouched, sizeof fix);
}

/** @param direct  what the solver's own call makes of the scan in that area */
static inline void check_solver_slices(const insole_radio_solver_calls_t *calls, void *state,
                                       const solver_scan_t *scan, const insole_trusted_area_t *area,
                                       const insole_radio_fix_t *direct)
{
    insole_radio_fix_t named;
    ck_assert_int_eq(calls->begin(state, scan->map, area, scan->readings, scan->count), INSOLE_OK);
    while (calls->work(state, scan->map, 7u)) {
        ck_assert_int_eq(calls->finish(state, scan->map, &named), INSOLE_ERR_STATE);
    }
    ck_assert_int_eq(calls->finish(state, scan->map, &named), INSOLE_OK);
    ck_assert_mem_eq(&named.spot, &direct->spot, sizeof named.spot);
    ck_assert(named.var_x_m2 == direct->var_x_m2 && named.cov_xy_m2 == direct->cov_xy_m2);
    ck_assert(named.var_y_m2 == direct->var_y_m2);
    ck_assert_int_eq(calls->finish(state, scan->map, &named), INSOLE_ERR_STATE);
}

#endif
