/** @file forest_writer.h  A forest as constant C tables, ready for the flash of a device.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_FOREST_WRITER_H
#define INSOLE_HOST_FOREST_WRITER_H

#include <stdio.h>

#include "forest_grow.h"

/** Writes `const insole_carry_forest_t NAME_forest`. @param head  what to know, for its comment */
void forest_write(FILE *file, const grown_t *grown, const char *name, const char *head);

#endif
