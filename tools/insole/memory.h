/** @file memory.h  Heap for the program: it is there, or the program says so and ends (exit 1).
 *
 *      points = memory_room(points, &room, count + 1, sizeof *points);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_MEMORY_H
#define INSOLE_HOST_MEMORY_H

#include <stddef.h>

/** A zeroed block, to be freed with free(). */
void *memory_new(size_t count, size_t size);

/** The same block, or a larger one in its place, with room for at least `count` items.
 *  @param[in,out] room items that fit now; 0 for a NULL block */
void *memory_room(void *block, size_t *room, size_t count, size_t size);

/** A copy of a string. */
char *memory_text(const char *text);

#endif
