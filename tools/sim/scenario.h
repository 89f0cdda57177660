/** @file scenario.h  A scenario as written by its author: settings and orders to the walker.
 *
 *  The format is described in maps/README.md. Reading checks each line for itself; whether the
 *  orders make a walk is found out by route.h.
 *
 *      sim_scenario_t scenario;
 *      if (!sim_scenario_read(stream, &scenario, &error)) ...   error.line, error.text
 *      sim_scenario_free(&scenario);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_SCENARIO_H
#define INSOLE_SIM_SCENARIO_H

#include <stdio.h>

#include "sim/list.h"
#include "sim/settings.h"

typedef enum {
    SIM_ORDER_START,  /**< stand at x, y, z looking along heading */
    SIM_ORDER_WALK,   /**< go to x, y at a speed */
    SIM_ORDER_STAIRS, /**< climb to x, y, z at a speed */
    SIM_ORDER_PAUSE,  /**< stand for some seconds */
    SIM_ORDER_TURN    /**< turn on the spot to a heading */
} sim_order_kind_t;

/** What a kind does not name is 0. */
typedef struct {
    sim_order_kind_t kind;
    int line;
    double x_m, y_m, z_m;
    double heading_rad; /**< counter-clockwise from +x */
    double speed_mps;
    double seconds;
} sim_order_t;

typedef struct {
    sim_settings_t settings;
    sim_list_t orders; /**< of sim_order_t; the first is the start */
} sim_scenario_t;

/** Reads to the end of the stream. A refusal leaves nothing to free. */
bool sim_scenario_read(FILE *stream, sim_scenario_t *scenario, sim_error_t *error);

void sim_scenario_free(sim_scenario_t *scenario);

#endif
