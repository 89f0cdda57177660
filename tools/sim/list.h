/** @file list.h  An array on the heap that grows.
 *
 *      sim_list_t steps = sim_list(sizeof(sim_step_t));
 *      if (!sim_list_add(&steps, &step)) ...              out of memory
 *      const sim_step_t *first = sim_list_at(&steps, 0);
 *      sim_list_free(&steps);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_LIST_H
#define INSOLE_SIM_LIST_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    unsigned char *items;
    size_t count, room, item_size;
} sim_list_t;

sim_list_t sim_list(size_t item_size);

/** Copies an item to the end; false, and the list as before, when there is no memory. */
bool sim_list_add(sim_list_t *list, const void *item);

/** The item of that number, valid until the next add; NULL past the end. */
void *sim_list_at(const sim_list_t *list, size_t number);

void sim_list_free(sim_list_t *list);

#endif
