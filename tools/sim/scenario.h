/** @file scenario.h  A scenario as written by its author: settings and orders to the walker.
 *
 *  The format is described in maps/README.md. Reading checks each line for itself; whether the
 *  orders make a walk is found out by route.h.
 *
 *      sim_scenario_t scenario;
 *      if (!sim_scenario_load("maps/demo/scenario", &scenario, &error)) ...  .file, .line, .text
 *      sim_scenario_free(&scenario);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_SCENARIO_H
#define INSOLE_SIM_SCENARIO_H

#include <stdio.h>

#include "sim/aps.h"
#include "sim/list.h"
#include "sim/plan.h"
#include "sim/settings.h"

typedef enum {
    SIM_ORDER_START,   /**< stand at x, y, z looking along heading */
    SIM_ORDER_WALK,    /**< go to x, y at a speed */
    SIM_ORDER_STAIRS,  /**< climb to x, y, z at a speed */
    SIM_ORDER_PAUSE,   /**< stand for some seconds */
    SIM_ORDER_TURN,    /**< turn on the spot to a heading */
    SIM_ORDER_ERRANDS, /**< go to some goals, one after the other */
    SIM_ORDER_SURVEY   /**< go to all points of a grid and stop at each */
} sim_order_kind_t;

/** What a kind does not name is 0. */
typedef struct {
    sim_order_kind_t kind;
    int line;
    double x_m, y_m, z_m;
    double heading_rad; /**< counter-clockwise from +x */
    double speed_mps;
    double seconds;
    double goals;     /**< a whole number */
    double spacing_m; /**< of the grid */
} sim_order_t;

/** A goal of errands. */
typedef struct {
    sim_point_t at;
    int line;
} sim_goal_t;

/** A line of reference points of a survey. */
typedef struct {
    sim_point_t from, to;
} sim_line_t;

/** From then on the phone is carried another way. */
typedef struct {
    double t_s;
    int32_t pose; /**< SIM_POSE_* */
    int line;
} sim_pose_change_t;

enum { SIM_FILE_BYTES = 128 };

typedef struct {
    sim_settings_t settings;
    sim_list_t orders;  /**< of sim_order_t; the first is the start */
    sim_list_t goals;   /**< of sim_goal_t; none: errands lead anywhere */
    sim_list_t lines;   /**< of sim_line_t; none: surveys go over a grid */
    sim_list_t changes; /**< of sim_pose_change_t */
    char plan_file[SIM_FILE_BYTES], aps_file[SIM_FILE_BYTES]; /**< empty: none is named */
    sim_plan_t plan;                                          /**< empty until loaded */
    sim_list_t aps; /**< of sim_ap_t; empty until loaded */
} sim_scenario_t;

/** Reads a file, and the plan and the access points beside it that it names. A refusal leaves
 *  nothing to free. */
bool sim_scenario_load(const char *path, sim_scenario_t *scenario, sim_error_t *error);

/** Opens a file in the folder of the scenario; NULL and a refusal that names it if it cannot. */
FILE *sim_scenario_open_beside(const char *path, const char *file, sim_error_t *error);

/** Reads the scenario alone, to the end of the stream. A refusal leaves nothing to free. */
bool sim_scenario_read(FILE *stream, sim_scenario_t *scenario, sim_error_t *error);

void sim_scenario_free(sim_scenario_t *scenario);

#endif
