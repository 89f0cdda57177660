/** @file command.h  What `insole` can do: one entry per command.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_COMMAND_H
#define INSOLE_HOST_COMMAND_H

#include "options.h"

typedef struct {
    const char *name;
    const char *operands; /**< as the usage line shows them */
    const char *purpose;  /**< one line */
    const char *text;     /**< what to know, in the help of the command */
    const option_t *options;
    bool (*run)(const arguments_t *arguments, failure_t *failure);
} command_t;

extern const command_t command_replay, command_score, command_compare, command_simulate,
    command_reproduce, command_calibrate, command_config, command_plan, command_pack,
    command_radiomap, command_stream, command_draw, command_train_carry;

#endif
