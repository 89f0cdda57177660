/** @file site_folder.h  Which plan, access points and radio map belong to a replay.
 *
 *  What --plan, --aps and --radiomap tell counts; of what they do not, a folder among the logs may
 *  hold it, as plan.csv, aps.csv and radiomap.csv.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SITE_FOLDER_H
#define INSOLE_HOST_SITE_FOLDER_H

#include "options.h"

/** Paths; NULL: there is none. */
typedef struct {
    char *plan, *aps, *radiomap;
} site_folder_t;

/** Fails when several folders have one. A failure leaves nothing to free. */
bool site_folder_find(site_folder_t *found, const arguments_t *arguments, failure_t *failure);

void site_folder_free(site_folder_t *found);

#endif
