/** @file error.h  Why something of the simulator was refused, in words.
 *
 *      return sim_fail(error, "speed %g m/s, expected 0.3 to 4", speed_mps);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_ERROR_H
#define INSOLE_SIM_ERROR_H

#include <stdbool.h>

typedef struct {
    char file[256]; /**< to blame; empty: the scenario */
    int line;       /**< of the file, from 1; 0 when no line is to blame */
    char text[512];
} sim_error_t;

/** Writes the text, blames no file and no line; always false, so that a refusal is one line of
 * code. */
#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
bool sim_fail(sim_error_t *error, const char *format, ...);

/** Blames a line; always false. */
bool sim_fail_on_line(sim_error_t *error, int line);

/** Blames a file; always false. */
bool sim_fail_in_file(sim_error_t *error, const char *file);

#endif
