/* SPDX-License-Identifier: MIT */
#include "sim/list.h"

#include <stdlib.h>
#include <string.h>

enum { FIRST_ROOM = 16 };

sim_list_t sim_list(size_t item_size)
{
    sim_list_t list = {NULL, 0, 0, item_size};
    return list;
}

static bool grow(sim_list_t *list)
{
    size_t room = list->room == 0 ? FIRST_ROOM : 2 * list->room;
    unsigned char *items = realloc(list->items, room * list->item_size);
    if (items == NULL) {
        return false;
    }
    list->items = items;
    list->room = room;
    return true;
}

bool sim_list_add(sim_list_t *list, const void *item)
{
    if (list->count == list->room && !grow(list)) {
        return false;
    }
    memcpy(list->items + list->count * list->item_size, item, list->item_size);
    list->count++;
    return true;
}

void *sim_list_at(const sim_list_t *list, size_t number)
{
    return number < list->count ? list->items + number * list->item_size : NULL;
}

void sim_list_free(sim_list_t *list)
{
    free(list->items);
    *list = sim_list(list->item_size);
}
