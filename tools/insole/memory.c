/* SPDX-License-Identifier: MIT */
#include "memory.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "failure.h"

static void *insist(void *block)
{
    if (block == NULL) {
        fputs("insole: out of memory\n", stderr);
        exit(EXIT_BAD_INPUT);
    }
    return block;
}

void *memory_new(size_t count, size_t size)
{
    return insist(calloc(count > 0u ? count : 1u, size));
}

void *memory_room(void *block, size_t *room, size_t count, size_t size)
{
    if (count <= *room) {
        return block;
    }
    size_t larger = *room < 8u ? 16u : 2u * *room;
    larger = larger < count ? count : larger;
    if (larger > SIZE_MAX / size) {
        return insist(NULL);
    }
    *room = larger;
    return insist(realloc(block, larger * size));
}

char *memory_text(const char *text)
{
    size_t size = strlen(text) + 1u;
    return memcpy(memory_new(size, 1u), text, size);
}
