/** @file help.h  What `insole` says about itself.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_HELP_H
#define INSOLE_HOST_HELP_H

#include <stdio.h>

#include "command.h"

/** All commands of this build; ends with NULL. */
const command_t *const *help_commands(void);

void help_program(FILE *file);
void help_version(FILE *file);
void help_files(FILE *file);
void help_command(FILE *file, const command_t *command);

#endif
