/** @file radio_solver.h  What a tracker asks of whatever makes a position of a scan and a map.
 *
 *  A solver is its functions and a state that the caller owns and has set up with the stem's own
 *  init. A tracker that holds such a pair links that one solver and no other.
 *
 *      static insole_kde_fix_t kde;
 *      insole_kde_fix_init(&kde, &insole_kde_fix_defaults);
 *      insole_radio_solver_t solver = {&insole_kde_fix_calls, &kde};
 *      solver.calls->begin(solver.state, &map, NULL, readings, count);
 *
 *  All return what the calls they stand for return.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_RADIO_SOLVER_H
#define INSOLE_PLACE_RADIO_SOLVER_H

#include "insole/place/radio_map.h"
#include "insole/place/spot_mixture.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_status_t (*begin)(void *state, const insole_radio_map_t *map,
                             const insole_trusted_area_t *area, const insole_rss_t *readings,
                             uint32_t count);
    bool (*work)(void *state, const insole_radio_map_t *map, uint32_t points);
    insole_status_t (*finish)(void *state, const insole_radio_map_t *map, insole_radio_fix_t *fix);
} insole_radio_solver_calls_t;

typedef struct {
    const insole_radio_solver_calls_t *calls; /**< NULL: there is no solver */
    void *state;                              /**< stays where it is */
} insole_radio_solver_t;

#ifdef __cplusplus
}
#endif

#endif
