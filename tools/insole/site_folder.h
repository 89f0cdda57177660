/** @file site_folder.h  Which plan and which access points belong to a replay.
 *
 *  What --plan and --aps tell counts; of what they do not, a folder among the logs may hold it, as
 *  plan.csv and aps.csv.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SITE_FOLDER_H
#define INSOLE_HOST_SITE_FOLDER_H

#include "options.h"

/** Paths; NULL: there is none. */
typedef struct {
    char *plan, *aps;
} site_folder_t;

/** Fails when several folders have one. A failure leaves nothing to free. */
bool site_folder_find(site_folder_t *found, const arguments_t *arguments, failure_t *failure);

void site_folder_free(site_folder_t *found);

#endif
