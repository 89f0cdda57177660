/** @file scenarios.h  Scenarios out of text, for the suites of the simulator.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_SCENARIOS_H
#define INSOLE_TESTS_SCENARIOS_H

#include <check.h>
#include <stdio.h>
#include <string.h>

#include "sim/scenario.h"

/** What reading `size` bytes of text says. */
static inline bool scenario_read_bytes(const char *text, size_t size, sim_scenario_t *scenario,
                                       sim_error_t *error)
{
    FILE *stream = tmpfile();
    ck_assert_ptr_nonnull(stream);
    ck_assert_uint_eq(fwrite(text, 1, size, stream), size);
    rewind(stream);
    bool done = sim_scenario_read(stream, scenario, error);
    fclose(stream);
    return done;
}

/** A scenario that must be right. */
static inline sim_scenario_t scenario_of(const char *text)
{
    sim_scenario_t scenario;
    sim_error_t error;
    bool done = scenario_read_bytes(text, strlen(text), &scenario, &error);
    ck_assert_msg(done, "line %d: %s", error.line, error.text);
    return scenario;
}

#endif
