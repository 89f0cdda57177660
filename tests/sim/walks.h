/** @file walks.h  Walks out of text, for the suites of the simulator.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_WALKS_H
#define INSOLE_TESTS_WALKS_H

#include "scenarios.h"
#include "sim/walk.h"

/** A walk that must be possible. */
static inline sim_walk_t *walk_of(const char *text, uint64_t seed)
{
    sim_scenario_t scenario = scenario_of(text);
    sim_error_t error;
    sim_walk_t *walk = sim_walk_open(&scenario, seed, &error);
    ck_assert_msg(walk != NULL, "line %d: %s", error.line, error.text);
    sim_scenario_free(&scenario);
    return walk;
}

static inline size_t stride_count(const sim_walk_t *walk)
{
    return sim_walk_gait(walk)->strides.count;
}

static inline const sim_stride_t *stride_of(const sim_walk_t *walk, size_t number)
{
    const sim_stride_t *stride = sim_list_at(&sim_walk_gait(walk)->strides, number);
    ck_assert_ptr_nonnull(stride);
    return stride;
}

/** Nothing rings, settles or trembles. */
#define QUIET                                                                                      \
    "gait.wobble_rad = 0\ngait.still_rad = 0\ngait.settle_mps = 0\ngait.run_settle_mps = 0\n"      \
    "gait.shock_mps2 = 0\ngait.run_shock_mps2 = 0\ngait.shock_radps = 0\n"

/** No stride differs from the others. */
#define EQUAL                                                                                      \
    "gait.spread = 0\nwalk.length_spread = 0\nwalk.time_spread = 0\nwalk.place_spread_m = 0\n"     \
    "walk.toe_spread_rad = 0\n"

#endif
