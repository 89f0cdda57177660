/* SPDX-License-Identifier: MIT */
#include "output.h"

#include <errno.h>
#include <string.h>

bool output_open(FILE **file, const char *path, failure_t *failure)
{
    *file = NULL;
    if (path == NULL) {
        return true;
    }
    *file = strcmp(path, "-") == 0 ? stdout : fopen(path, "wb");
    if (*file == NULL) {
        return failure_input(failure, "%s: cannot write: %s", path, strerror(errno));
    }
    return true;
}

static bool check(bool is_good, const char *path, failure_t *failure)
{
    if (!is_good) {
        return failure_input(failure, "%s: cannot write: %s",
                             strcmp(path, "-") == 0 ? "stdout" : path, strerror(errno));
    }
    return true;
}

bool output_flush(FILE *file, const char *path, failure_t *failure)
{
    return check(fflush(file) == 0 && !ferror(file), path, failure);
}

bool output_close(FILE *file, const char *path, failure_t *failure)
{
    if (file == NULL) {
        return true;
    }
    bool is_good = fflush(file) == 0 && !ferror(file);
    if (file != stdout) {
        is_good = fclose(file) == 0 && is_good;
    }
    return check(is_good, path, failure);
}
