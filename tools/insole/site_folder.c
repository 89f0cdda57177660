/* SPDX-License-Identifier: MIT */
#include "site_folder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "platform.h"

/* The file of this name in the folder, if it has one. */
static char *find_in(const char *folder, const char *name)
{
    char **paths, *found = NULL;
    size_t count;
    if (!platform_is_folder(folder) || !platform_list(folder, ".csv", &paths, &count)) {
        return NULL;
    }
    for (size_t i = 0u; i < count; i++) {
        if (strcmp(platform_base_name(paths[i]), name) == 0) {
            found = memory_text(paths[i]);
        }
    }
    platform_free_paths(paths, count);
    return found;
}

/* `what`, as the option is called; its file in a folder is called what.csv. */
static bool find(char **path, const char *what, const arguments_t *arguments, failure_t *failure)
{
    const char *told = options_value(arguments, what);
    char name[32];
    snprintf(name, sizeof name, "%s.csv", what);
    *path = told != NULL ? memory_text(told) : NULL;
    for (size_t i = 0u; i < arguments->operand_count && told == NULL; i++) {
        char *found = find_in(arguments->operands[i], name);
        if (found != NULL && *path != NULL) {
            failure_usage(failure, "insole %s: both %s and %s are there: choose by --%s FILE",
                          arguments->command, *path, found, what);
            free(found);
            return false;
        }
        *path = found != NULL ? found : *path;
    }
    return true;
}

bool site_folder_find(site_folder_t *found, const arguments_t *arguments, failure_t *failure)
{
    memset(found, 0, sizeof *found);
    bool is_good = find(&found->plan, "plan", arguments, failure) &&
                   find(&found->aps, "aps", arguments, failure) &&
                   find(&found->radiomap, "radiomap", arguments, failure);
    if (!is_good) {
        site_folder_free(found);
    }
    return is_good;
}

void site_folder_free(site_folder_t *found)
{
    free(found->plan);
    free(found->aps);
    free(found->radiomap);
    memset(found, 0, sizeof *found);
}
