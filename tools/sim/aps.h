/** @file aps.h  The access points as their owner tells them: aps.csv.
 *
 *      sim_list_t aps;
 *      if (!sim_aps_read(stream, &aps, &error)) ...          error.line, error.text
 *      const sim_ap_t *first = sim_list_at(&aps, 0);
 *      sim_list_free(&aps);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_APS_H
#define INSOLE_SIM_APS_H

#include <stdio.h>

#include "sim/error.h"
#include "sim/list.h"

enum { SIM_AP_ID_BYTES = 64 };

/** What the file does not tell is not-a-number. */
typedef struct {
    char id[SIM_AP_ID_BYTES];
    double x_m, y_m, z_m;
    double p0_dbm;   /**< received at 1 m */
    double exponent; /**< of the path loss */
    double near_dbm; /**< mean received at 1.5 m */
} sim_ap_t;

/** Reads to the end of the stream into a list of sim_ap_t. A refusal leaves nothing to free. */
bool sim_aps_read(FILE *stream, sim_list_t *aps, sim_error_t *error);

#endif
