/* SPDX-License-Identifier: MIT */
#include "id_table.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"

void id_table_init(id_table_t *table)
{
    memset(table, 0, sizeof *table);
}

/* FNV-1a. */
static size_t hash(const char *name)
{
    uint32_t h = 2166136261u;
    for (; *name != '\0'; name++) {
        h = (h ^ (unsigned char)*name) * 16777619u;
    }
    return h;
}

/* The slot that holds the name, or the free one where it belongs. */
static size_t find_slot(const id_table_t *table, const char *name)
{
    size_t slot = hash(name) % table->slot_count;
    while (table->slots[slot] != 0u && strcmp(table->names[table->slots[slot] - 1u], name) != 0) {
        slot = (slot + 1u) % table->slot_count;
    }
    return slot;
}

static void make_slots(id_table_t *table, size_t slot_count)
{
    free(table->slots);
    table->slots = memory_new(slot_count, sizeof *table->slots);
    table->slot_count = slot_count;
    for (size_t i = 0u; i < table->count; i++) {
        table->slots[find_slot(table, table->names[i])] = (uint32_t)i + 1u;
    }
}

uint32_t id_table_number(id_table_t *table, const char *name)
{
    if (2u * table->count >= table->slot_count) {
        make_slots(table, table->slot_count == 0u ? 64u : 2u * table->slot_count);
    }
    size_t slot = find_slot(table, name);
    if (table->slots[slot] == 0u) {
        table->names =
            memory_room(table->names, &table->room, table->count + 1u, sizeof *table->names);
        table->names[table->count] = memory_text(name);
        table->slots[slot] = (uint32_t)++table->count;
    }
    return table->slots[slot] - 1u;
}

bool id_table_find(const id_table_t *table, const char *name, uint32_t *number)
{
    uint32_t found = table->slot_count == 0u ? 0u : table->slots[find_slot(table, name)];
    *number = found - 1u;
    return found != 0u;
}

void id_table_free(id_table_t *table)
{
    for (size_t i = 0u; i < table->count; i++) {
        free(table->names[i]);
    }
    free(table->names);
    free(table->slots);
    id_table_init(table);
}
