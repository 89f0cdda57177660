/** @file output.h  Files that the program writes; a full disk does not go unnoticed.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_OUTPUT_H
#define INSOLE_HOST_OUTPUT_H

#include <stdio.h>

#include "failure.h"

/** @param path a file, or `-` for standard output; NULL gives a NULL file and success */
bool output_open(FILE **file, const char *path, failure_t *failure);

/** Hands on what is buffered. */
bool output_flush(FILE *file, const char *path, failure_t *failure);

/** Closes the file; standard output is flushed instead. Nothing happens to NULL. */
bool output_close(FILE *file, const char *path, failure_t *failure);

#endif
