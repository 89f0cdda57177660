/** @file recorded.h  Recordings stand beside the checkout, in ../shared/data, or nowhere.
 *
 *      char path[RECORDED_PATH];
 *      if (!recorded_is_there(recorded_path(path, "rtt/Laboratory/aps.csv"))) {
 *          return;                                                            it has said why
 *      }
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_RECORDED_H
#define INSOLE_TESTS_RECORDED_H

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { RECORDED_PATH = 512 };

/** Where a file or folder of the recordings is, by the place of this source. */
static inline const char *recorded_path(char path[RECORDED_PATH], const char *name)
{
    const char *tests = strstr(__FILE__, "tests/support/recorded.h");
    int root = tests ? (int)(tests - __FILE__) : 0;
    snprintf(path, RECORDED_PATH, "%.*s../shared/data/%s", root, __FILE__, name);
    return path;
}

/** @return false, with a message, where there is no such file */
static inline bool recorded_is_there(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        printf("SKIPPED: no %s\n", path);
        return false;
    }
    fclose(file);
    return true;
}

#endif
