/** @file buildings.h  Plans and access points out of text, for the suites of the simulator.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_BUILDINGS_H
#define INSOLE_TESTS_BUILDINGS_H

#include "scenarios.h"

/** The text as a file to read; the caller closes it. */
static inline FILE *stream_of(const char *text)
{
    FILE *stream = tmpfile();
    ck_assert_ptr_nonnull(stream);
    fputs(text, stream);
    rewind(stream);
    return stream;
}

/** A plan that must be right. */
static inline sim_plan_t plan_of(const char *text)
{
    sim_plan_t plan;
    sim_error_t error;
    FILE *stream = stream_of(text);
    bool done = sim_plan_read(stream, &plan, &error);
    fclose(stream);
    ck_assert_msg(done, "line %d: %s", error.line, error.text);
    return plan;
}

/** Access points that must be right. */
static inline sim_list_t aps_of(const char *text)
{
    sim_list_t aps;
    sim_error_t error;
    FILE *stream = stream_of(text);
    bool done = sim_aps_read(stream, &aps, &error);
    fclose(stream);
    ck_assert_msg(done, "line %d: %s", error.line, error.text);
    return aps;
}

/** A scenario in a building; either text may be empty. */
static inline sim_scenario_t scenario_in(const char *text, const char *plan, const char *aps)
{
    sim_scenario_t scenario = scenario_of(text);
    if (*plan != '\0') {
        scenario.plan = plan_of(plan);
    }
    if (*aps != '\0') {
        scenario.aps = aps_of(aps);
    }
    return scenario;
}

/** A scenario of maps/, which must be right. */
static inline sim_scenario_t scenario_of_map(const char *name)
{
    char path[600];
    sim_scenario_t scenario;
    sim_error_t error;
    snprintf(path, sizeof path, "%s/maps/%s", SIM_SOURCE_DIR, name);
    bool done = sim_scenario_load(path, &scenario, &error);
    ck_assert_msg(done, "%s: %s:%d: %s", name, error.file, error.line, error.text);
    return scenario;
}

/** Do two straight ways meet? Solved for the shares of both, unlike in the simulator. */
static inline bool ways_meet(sim_point_t a, sim_point_t b, sim_point_t p, sim_point_t q)
{
    double ux = b.x_m - a.x_m, uy = b.y_m - a.y_m, vx = q.x_m - p.x_m, vy = q.y_m - p.y_m;
    double determinant = ux * vy - uy * vx;
    if (determinant == 0.0) {
        return false;
    }
    double s = ((p.x_m - a.x_m) * vy - (p.y_m - a.y_m) * vx) / determinant;
    double t = ((p.x_m - a.x_m) * uy - (p.y_m - a.y_m) * ux) / determinant;
    return s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0;
}

/** Walls that a straight way meets. */
static inline int walls_met(const sim_plan_t *plan, sim_point_t p, sim_point_t q)
{
    int met = 0;
    for (size_t i = 0; i < plan->walls.count; i++) {
        const sim_wall_t *wall = sim_plan_wall(plan, i);
        met += ways_meet(wall->a, wall->b, p, q) ? 1 : 0;
    }
    return met;
}

#endif
